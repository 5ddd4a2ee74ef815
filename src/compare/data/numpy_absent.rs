//! NumPy's files in a build without the feature `npz`: refused by that name.

use std::io::Read;

use super::arrays::Arrays;
use super::error::{DataError, DataErrorKind};

pub(super) fn read(_: impl Read, file: &str) -> Result<Arrays, DataError> {
    let why = "found an array of NumPy in a build without the feature `npz`, expected text";
    Err(DataErrorKind::Unreadable(why.into()).at(file, None))
}
