//! What a file of NumPy gives, and how one is told from a text.

use super::error::DataErrorKind;

/// The columns of an array or an archive, with their names where they have any. A column that is no column of numbers
/// has the reason in its place: it may not be asked for.
pub(super) type Arrays = (Vec<String>, Vec<Result<Vec<f64>, DataErrorKind>>);

/// Whether a file that starts so is an array of NumPy.
pub(super) fn is_array(start: &[u8]) -> bool {
    start.starts_with(b"\x93NUMPY")
}

/// What the columns of an array `name` are called: as it, where there is one.
pub(super) fn called(name: &str, columns: usize) -> impl Iterator<Item = String> {
    (0..columns).map(move |k| if columns == 1 { name.to_string() } else { format!("{name}[{k}]") })
}
