//! A source of columns, and the columns that are asked of it.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::arrays::{called, is_array};
use super::error::{DataError, DataErrorKind};
use super::numpy;
use super::text::{Lines, Text};

/// A source of columns, opened far enough to know how many there are and what they are called.
#[derive(Debug)]
pub struct Source {
    file: String,
    names: Vec<String>,
    width: usize,
    body: Body,
}

#[derive(Debug)]
enum Body {
    Text(Box<Text>),
    Arrays(Vec<Result<Vec<f64>, DataErrorKind>>),
}

/// The columns that were asked for, in that order, all of one length.
#[derive(Debug)]
pub(crate) struct Columns {
    file: String,
    pub(crate) values: Vec<Vec<f64>>,
    lines: Lines,
}

impl Source {
    /// Opens a file, or standard input for `-`: `.npy` and `.npz` by their first bytes, text otherwise. Of a folder each
    /// `.npy` is a quantity, called as the file is.
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
        let (names, width, body) = if is_array(start) || start.starts_with(b"PK\x03\x04") {
            let (names, columns) = numpy::read(reader, &file)?;
            (names, columns.len(), Body::Arrays(columns))
        } else {
            let text = Text::open(reader, &file)?;
            (text.names.clone(), text.width(), Body::Text(Box::new(text)))
        };
        Ok(Source { file, names, width, body })
    }

    fn folder(path: &Path) -> Result<Self, DataError> {
        let file = path.display().to_string();
        let unreadable =
            |why: &dyn std::fmt::Display, file: &str| DataErrorKind::Unreadable(why.to_string()).at(file, None);
        let entries = std::fs::read_dir(path).map_err(|error| unreadable(&error, &file))?;
        let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        paths.retain(|path| path.extension().is_some_and(|extension| extension == "npy"));
        paths.sort();
        if paths.is_empty() {
            let none = "found no .npy in the folder, expected one for each quantity, such as t.npy and u.npy";
            return Err(unreadable(&none, &file));
        }
        let (mut names, mut all) = (Vec::new(), Vec::new());
        for path in paths {
            let shown = path.display().to_string();
            let opened = File::open(&path).map_err(|error| unreadable(&error, &shown))?;
            let columns = numpy::read(opened, &shown)?.1;
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            names.extend(called(&stem, columns.len()));
            all.extend(columns);
        }
        Ok(Self::arrays(&file, names, all))
    }

    /// The names of the columns; empty where they have none.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// How many names a header has, where they are not as many as the columns.
    pub(crate) fn misnamed(&self) -> Option<usize> {
        match &self.body {
            Body::Text(text) => text.misnamed,
            Body::Arrays(_) => None,
        }
    }

    /// Whether a first line `rows columns` was skipped.
    pub(crate) fn is_sized(&self) -> bool {
        matches!(&self.body, Body::Text(text) if text.sized)
    }

    /// What it is called.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// How many columns there are.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Columns that are held in memory, with their names or without; one that is no column of numbers has the reason in
    /// its place.
    pub fn arrays(file: &str, names: Vec<String>, columns: Vec<Result<Vec<f64>, DataErrorKind>>) -> Self {
        Source { file: file.into(), names, width: columns.len(), body: Body::Arrays(columns) }
    }

    /// Reads the columns of these places, counted from 0; in that at `side` a text has words for −1, 0 and 1.
    ///
    /// **Errors**: [`DataError`] for a ragged row, and for what is no finite number in one of these columns.
    pub(crate) fn columns(self, which: &[usize], side: Option<usize>) -> Result<Columns, DataError> {
        let (values, lines) = match self.body {
            Body::Text(text) => text.read(which, side, &self.file)?,
            Body::Arrays(all) => {
                let called = |place: usize| self.names.get(place).cloned().unwrap_or_else(|| place.to_string());
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
                (values, Lines::default())
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
    /// How many rows there are.
    pub(crate) fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// `kind`, of the file as a whole.
    pub(crate) fn whole(&self, kind: DataErrorKind) -> DataError {
        kind.at(&self.file, None)
    }

    /// `kind` at a row and a column, both counted from 0.
    pub(crate) fn refuse(&self, row: usize, column: usize, kind: DataErrorKind) -> DataError {
        let place = match self.lines.of(row) {
            Some(line) => format!("line {line}, column {}", column + 1),
            None => format!("row {}, column {}", row + 1, column + 1),
        };
        kind.at(&self.file, Some(place))
    }
}
