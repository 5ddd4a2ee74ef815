//! Limits of the computation, and the task of a run.

use std::ops::ControlFlow;

use crate::number::Scalar;
use crate::problem::Problem;

/// Limits of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Decimal digits, relative to the natural scales, to which cells are marched.
    pub(crate) digits: f64,
    /// Maximum number of cells crossed.
    pub(crate) cells: u64,
    /// Whether the run stops once its bounds no longer separate the events.
    pub(crate) until_lost: bool,
}

impl Effort {
    /// Returns the effort for `digits` digits without a limit of cells.
    pub(super) fn of(digits: f64) -> Self {
        Effort { digits, cells: u64::MAX, until_lost: false }
    }
}

/// Maximum number of digits of a march.
pub(crate) const MOST_DIGITS: f64 = 300.0;

/// Input of a run: the problem, the precision of its numbers, the limits, and an observer of its progress.
pub(crate) struct Task<'a, S: Scalar> {
    pub(crate) problem: &'a Problem,
    pub(crate) precision: &'a S::Precision,
    pub(crate) effort: Effort,
    pub(crate) observe: &'a dyn Fn(usize, usize) -> ControlFlow<()>,
}

/// Maximum number of strips of a run: some hundred megabytes.
pub(super) const MOST_PIECES: usize = 400_000;
/// Maximum number of segments of a round trip.
pub(super) const MOST_SEGMENTS: usize = 4096;
/// Minimum number of round trips of a leap, which costs about as much as two of them.
pub(super) const LEAST_LEAP: f64 = 3.0;
