//! Columns of NumPy's arrays.

use std::io::Cursor;

use ndarray::{ArrayD, Axis, IxDyn, OwnedRepr};
use ndarray_npy::{NpzReader, ReadNpyError, ReadNpyExt, ReadNpzError, ReadableElement};

use super::error::{Arrays, Column, DataErrorKind};
use dalembert::number::short;

/// Reads an array, or an archive of arrays with their names. An array of one axis is a column, one of two axes has a
/// column for each index of its second, and a single number has none.
pub(super) fn read(bytes: Vec<u8>, is_array: bool) -> Result<Arrays, DataErrorKind> {
    if is_array {
        let array = numbers(ArrayPlace::Array(&bytes))?;
        let shape = array.shape().to_vec();
        let columns = columns(array);
        let none = columns.is_empty() || columns.iter().any(Result::is_err);
        return if none { Err(DataErrorKind::Shape(shape)) } else { Ok(vec![(None, columns)]) };
    }
    let unreadable = |error: ReadNpzError| DataErrorKind::Unreadable(error.to_string());
    let mut archive = NpzReader::new(Cursor::new(bytes)).map_err(unreadable)?;
    let names = archive.names().map_err(unreadable)?;
    let read = |name: String| {
        let columns = numbers(ArrayPlace::Entry(&mut archive, &name)).map_or_else(|kind| vec![Err(kind)], columns);
        (Some(name), columns)
    };
    // A golden file has its header as bytes of text.
    Ok(names.into_iter().filter(|name| name != "header").map(read).collect())
}

fn columns(array: ArrayD<f64>) -> Vec<Column> {
    match array.shape() {
        [] => Vec::new(),
        [_] => vec![Ok(array.into_iter().collect())],
        [_, _] => array.axis_iter(Axis(1)).map(|column| Ok(column.iter().copied().collect())).collect(),
        shape => vec![Err(DataErrorKind::Shape(shape.to_vec()))],
    }
}

/// The place of an array: a file of its own, or an archive, where it has a name.
enum ArrayPlace<'a> {
    Array(&'a [u8]),
    Entry(&'a mut NpzReader<Cursor<Vec<u8>>>, &'a str),
}

impl ArrayPlace<'_> {
    fn read<T: ReadableElement>(&mut self) -> Result<ArrayD<T>, ReadNpyError> {
        match self {
            ArrayPlace::Array(bytes) => ArrayD::read_npy(*bytes),
            ArrayPlace::Entry(archive, name) => {
                archive.by_name::<OwnedRepr<T>, IxDyn>(name).map_err(|error| match error {
                    ReadNpzError::Npy(error) => error,
                    ReadNpzError::Zip(error) => ReadNpyError::Io(std::io::Error::other(error.to_string())),
                })
            }
        }
    }
}

/// Reads the elements, of any of the common types, as doubles.
fn numbers(mut array: ArrayPlace<'_>) -> Result<ArrayD<f64>, DataErrorKind> {
    macro_rules! of {
        ($($element:ty),*) => {$(
            if let Ok(found) = array.read::<$element>() {
                return Ok(found.mapv(|x| x as f64));
            }
        )*};
    }
    let refused = match array.read::<f64>() {
        Err(ReadNpyError::WrongDescriptor(found)) => DataErrorKind::ElementType { found: short(&found.to_string()) },
        read => return read.map_err(|error| DataErrorKind::Unreadable(error.to_string())),
    };
    of!(f32, i64, i32, i16, i8, u64, u32, u16, u8);
    array.read::<bool>().map(|flags| flags.mapv(|flag| f64::from(u8::from(flag)))).map_err(|_| refused)
}
