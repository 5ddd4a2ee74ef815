//! Errors in data, with their place.

/// An error in data, with its source and the place in it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}{}: {kind}", place.as_ref().map_or_else(String::new, |place| format!(", {place}")))]
pub struct DataError {
    file: String,
    place: Option<String>,
    kind: DataErrorKind,
}

/// The kind of an error in data.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
pub enum DataErrorKind {
    #[error("cannot be read: {0}")]
    Unreadable(String),
    #[error("found no row of numbers, expected at least two")]
    Empty,
    #[error("found {found} columns, expected {expected} as in the first row")]
    Ragged { found: usize, expected: usize },
    #[error("found `{0}`, expected a number")]
    NotANumber(String),
    #[error("found `{0}`, expected a number with a point, not a comma, before its decimals")]
    DecimalComma(String),
    #[error("found {0}, expected a finite number")]
    NotFinite(f64),
    #[error("found text that is not UTF-8, expected text, .npy or .npz")]
    NotText,
    #[error("found time {found} after {before}, expected times that increase, or two rows at a jump, left and right")]
    NotIncreasing { before: f64, found: f64 },
    #[error("found `{0}`, expected left, right or both (−1, 1 or 0 as numbers): the limit that the row holds")]
    Side(String),
    #[error("found point {found}, expected one between 0 and {length}, the rod's length")]
    PointOutside { found: f64, length: f64 },
    #[error("found point {found} after {before} at the same time, expected points that increase")]
    PointsNotIncreasing { before: f64, found: f64 },
    #[error("found an array of type {found}, expected numbers: float64, float32, integers or bool")]
    ElementType { found: String },
    #[error("found an array of shape {0:?}, expected one column, or rows and columns")]
    Shape(Vec<usize>),
    #[error("found {found} rows, expected {expected} as in `{first}`")]
    Lengths { found: usize, first: String, expected: usize },
    #[error("found times up to {last}, expected some after 0, where the history begins")]
    NoOverlap { last: f64 },
    #[error("found one time from 0 on, {0}, expected at least two")]
    OneTime(f64),
}

impl DataErrorKind {
    /// Builds the error of this kind at a place.
    pub(crate) fn at(self, file: &str, place: Option<String>) -> DataError {
        DataError { file: file.into(), place, kind: self }
    }
}

/// A column of an array, or the reason why it holds no numbers, which matters only if the column is read.
pub type Column = Result<Vec<f64>, DataErrorKind>;

/// The columns of each array, and its name in an archive.
pub(super) type Arrays = Vec<(Option<String>, Vec<Column>)>;
