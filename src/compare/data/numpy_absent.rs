//! NumPy's files in a build without the feature `npz`: refused by that name.

use super::error::{Arrays, DataErrorKind};

pub(super) fn read(_: Vec<u8>, _: bool) -> Result<Arrays, DataErrorKind> {
    let why = "found an array of NumPy in a build without the feature `npz`, expected text";
    Err(DataErrorKind::Unreadable(why.into()))
}
