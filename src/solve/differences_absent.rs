//! Difference quotients in a build without the feature `mp`: an error that names it.

use super::derivative::{Asked, Derivatives};
use crate::error::Error;
use crate::number::{Estimate, Float};

pub(super) fn of(asked: &Asked<'_>, _: u32) -> Result<Derivatives<Estimate<Float>>, Error> {
    // No other run answers it.
    let _ = &asked.want;
    Err(Error::NoMultiprecision)
}
