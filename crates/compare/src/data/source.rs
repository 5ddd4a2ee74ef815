//! A source of columns, and the columns that are read from it.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::error::{Arrays, Column, DataError, DataErrorKind};
use super::numpy;
use super::text::{Head, Text};

/// A source of columns, opened far enough to know their number and names.
pub struct Source {
    pub(crate) file: String,
    pub(crate) head: Head,
    pub(super) body: Body,
}

pub(super) enum Body {
    Text(Text),
    Arrays(Vec<Column>),
}

/// The columns that were read, in the order of the request, all of one length.
#[derive(Debug)]
pub(crate) struct Columns {
    file: String,
    pub(crate) values: Vec<Vec<f64>>,
    /// The line number of each row of a text.
    lines: Vec<usize>,
}

/// Reads the arrays of a file of NumPy, with their names in an archive.
fn arrays(mut reader: impl Read, file: &str) -> Result<Arrays, DataError> {
    let mut bytes = Vec::new();
    let read = reader.read_to_end(&mut bytes).map_err(|error| DataErrorKind::Unreadable(error.to_string()));
    let is_array = bytes.starts_with(ARRAY);
    read.and_then(|_| numpy::read(bytes, is_array)).map_err(|kind| kind.at(file, None))
}

/// The first bytes of an array of NumPy.
const ARRAY: &[u8] = b"\x93NUMPY";
/// The first bytes of an archive of arrays.
const ARCHIVE: &[u8] = b"PK\x03\x04";

impl Source {
    /// Opens a file, or standard input for `-`: `.npy` and `.npz` by their first bytes, text otherwise. In a folder,
    /// each `.npy` is a quantity with the name of the file.
    ///
    /// **Errors**: [`DataError`], for an empty file too.
    pub fn open(path: &Path) -> Result<Self, DataError> {
        if path.is_dir() {
            return Self::folder(path);
        }
        let piped = path == Path::new("-");
        let file = if piped { "standard input".to_string() } else { path.display().to_string() };
        let read = |error: std::io::Error| DataErrorKind::Unreadable(error.to_string()).at(&file, None);
        let opened: Box<dyn Read + Send> =
            if piped { Box::new(std::io::stdin()) } else { Box::new(File::open(path).map_err(read)?) };
        let mut reader = BufReader::with_capacity(1 << 16, opened);
        let start = reader.fill_buf().map_err(read)?;
        if start.starts_with(ARRAY) || start.starts_with(ARCHIVE) {
            let found = arrays(reader, &file)?;
            return Ok(Self::from_arrays(&file, found));
        }
        let (text, head) = Text::open(reader, &file)?;
        Ok(Source { file, head, body: Body::Text(text) })
    }

    fn folder(path: &Path) -> Result<Self, DataError> {
        let file = path.display().to_string();
        let unreadable = |why: String, file: &str| DataErrorKind::Unreadable(why).at(file, None);
        let entries = std::fs::read_dir(path).map_err(|error| unreadable(error.to_string(), &file))?;
        let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        paths.retain(|path| path.extension().is_some_and(|extension| extension == "npy"));
        paths.sort();
        if paths.is_empty() {
            let none = "found no .npy in the folder, expected one for each quantity, such as t.npy and u.npy";
            return Err(unreadable(none.into(), &file));
        }
        let mut all = Vec::new();
        for path in paths {
            let shown = path.display().to_string();
            let opened = File::open(&path).map_err(|error| unreadable(error.to_string(), &shown))?;
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            all.extend(arrays(opened, &shown)?.into_iter().map(|(_, columns)| (Some(stem.to_string()), columns)));
        }
        Ok(Self::from_arrays(&file, all))
    }

    /// Builds a source from arrays, whose columns have their name, or `name[k]` where there are several.
    fn from_arrays(file: &str, arrays: Arrays) -> Self {
        let (mut names, mut all) = (Vec::new(), Vec::new());
        for (name, columns) in arrays {
            let several = columns.len() > 1;
            let called = |(name, k)| if several { format!("{name}[{k}]") } else { name };
            names.extend(name.into_iter().flat_map(|name| vec![name; columns.len()].into_iter().zip(0..).map(called)));
            all.extend(columns);
        }
        Self::from_columns(file, names, all)
    }

    /// Builds a source from columns in memory, with names or without; a column that holds no numbers has the reason in
    /// its place.
    pub fn from_columns(file: &str, names: Vec<String>, columns: Vec<Column>) -> Self {
        let (width, body) = (columns.len(), Body::Arrays(columns));
        Source { file: file.into(), head: Head { names, width, misnamed: None, is_sized: false }, body }
    }

    /// Reads the columns at these places, counted from 0. The column at `side` may hold words for −1, 0 and 1.
    pub(crate) fn columns(self, which: &[usize], side: Option<usize>) -> Result<Columns, DataError> {
        let (values, lines) = match self.body {
            Body::Text(text) => text.read(which, side, &self.file)?,
            Body::Arrays(all) => {
                let called = |place: usize| self.head.names.get(place).cloned().unwrap_or_else(|| place.to_string());
                let mut values: Vec<Vec<f64>> = Vec::with_capacity(which.len());
                for place in which {
                    let named = |kind: DataErrorKind| kind.at(&self.file, Some(format!("`{}`", called(*place))));
                    let column = all[*place].clone().map_err(named)?;
                    if let Some(expected) = values.first().map(Vec::len).filter(|rows| *rows != column.len()) {
                        let (found, first) = (column.len(), called(which[0]));
                        return Err(named(DataErrorKind::Lengths { found, first, expected }));
                    }
                    values.push(column);
                }
                (values, Vec::new())
            }
        };
        let columns = Columns { file: self.file, values, lines };
        for (values, place) in columns.values.iter().zip(which) {
            if let Some(row) = values.iter().position(|value| !value.is_finite()) {
                return Err(columns.refuse(row, *place, DataErrorKind::NotFinite(values[row])));
            }
        }
        Ok(columns)
    }
}

impl Columns {
    pub(crate) fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Builds the error of this kind for the whole file.
    pub(crate) fn whole(&self, kind: DataErrorKind) -> DataError {
        kind.at(&self.file, None)
    }

    /// Builds the error of this kind at a row and a column, both counted from 0.
    pub(crate) fn refuse(&self, row: usize, column: usize, kind: DataErrorKind) -> DataError {
        let place = match self.lines.get(row) {
            Some(line) => format!("line {line}, column {}", column + 1),
            None => format!("row {}, column {}", row + 1, column + 1),
        };
        kind.at(&self.file, Some(place))
    }
}
