//! Placeholder for difference quotients in a build without the feature `mp`: the error that names it.

use super::derivative::{Asked, Derivatives};
use crate::error::Error;
use crate::number::{Estimate, Float};

pub(super) fn of(asked: &Asked<'_>, _: u32) -> Result<Derivatives<Estimate<Float>>, Error> {
    // The field is read only with the feature `mp`.
    let _ = &asked.want;
    Err(Error::NoMultiprecision)
}
