//! Placeholder for long numbers and enclosures in a build without the feature `mp`: the error that names it.

use super::asked::Longer;
use super::derivative::{Asked, Derivatives};
use super::ladder::{Engined, Target};
use super::plan::{Plan, Rung};
use super::question::Observer;
use crate::error::Error;
use crate::first_contact::Bounce;
use crate::number::{Estimate, Float, Interval};
use crate::problem::Problem;

impl Target for Float {}
impl Target for Interval {}

pub(super) fn in_doubles(_: &Problem, _: &Plan, _: (Rung, Longer<f64>), _: &Observer) -> Result<Engined<f64>, Error> {
    Err(Error::NoMultiprecision)
}

pub(super) fn read(_: &Problem, _: &Plan, _: Rung, _: &Observer) -> Result<Engined<f64>, Error> {
    Err(Error::NoMultiprecision)
}

/// Returns `None`: without the feature `mp`, the value of `h′` in doubles is used.
pub(super) fn rate_after(_: &Problem, _: &Bounce<Estimate<f64>>, _: u32) -> Option<Estimate<f64>> {
    None
}

pub(super) fn quotients(asked: &Asked<'_>, _: u32) -> Result<Derivatives<Estimate<Float>>, Error> {
    // The field is read only with the feature `mp`.
    let _ = &asked.want;
    Err(Error::NoMultiprecision)
}
