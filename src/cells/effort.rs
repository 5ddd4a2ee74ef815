//! What is followed, and how much is computed of it.

use std::ops::ControlFlow;

use crate::number::Scalar;
use crate::problem::Problem;

/// How much is computed of a run at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Decimal digits of the natural scales that cells are marched to.
    pub(crate) digits: f64,
    /// Cells that are crossed.
    pub(crate) cells: u64,
    /// Whether the run is given up where its bounds no longer tell the events apart.
    pub(crate) until_lost: bool,
}

impl Effort {
    /// So many digits, however many cells they take.
    pub(super) fn of(digits: f64) -> Self {
        Effort { digits, cells: u64::MAX, until_lost: false }
    }
}

/// Digits beyond which nothing is marched.
pub(crate) const MOST_DIGITS: f64 = 300.0;
/// A first contact of up to so many round trips is marched over; one of up to the second of them is if the march knows
/// it better than the closed form.
pub(crate) const MARCHED_TRIPS: [f64; 2] = [4.0, 64.0];

/// What is followed: a problem in numbers of a precision, how much may be computed, and who is told how far a run is.
pub(crate) struct Task<'a, S: Scalar> {
    pub(crate) problem: &'a Problem,
    pub(crate) precision: &'a S::Precision,
    pub(crate) effort: Effort,
    pub(crate) observe: &'a dyn Fn(usize, usize) -> ControlFlow<()>,
}

/// The most strips that are followed: some hundred megabytes.
pub(super) const MOST_PIECES: usize = 400_000;
/// The most segments of a round trip.
pub(super) const MOST_SEGMENTS: usize = 4096;
/// The fewest round trips that are leapt over: a leap costs about as much as two of them.
pub(super) const LEAST_LEAP: f64 = 3.0;
