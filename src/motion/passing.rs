//! Passages of rays at a point, and the errors of their times.

use crate::number::Scalar;

/// A ray at a point.
#[derive(Clone, Debug)]
pub struct Passing<S> {
    /// Time of the passage.
    pub time: S,
    /// Time since the ray began: under damping its jump has faded by `e^{−r·age}`.
    pub age: f64,
    /// Whether the ray may carry a jump (otherwise only a kink).
    pub jump: bool,
}

/// Maximum error of a displaced ray in round trips; rays with a greater error are left out, because the run already
/// warns that its events are in doubt.
const MAX_LATE: f64 = 0.01;

/// Difference of times, in round trips, below which rays are compared in the numbers of the run: doubles hold the
/// fraction of a million round trips to 1e-10.
pub(super) const NEAR: f64 = 1e-6;

/// Returns whether the error of a time is small enough for a displaced ray.
pub(super) fn is_displaced<S: Scalar>(time: &S, round_trip: &S) -> bool {
    time.log2_error() < (round_trip.to_f64() * MAX_LATE).log2()
}

/// Returns the greatest finite bound of some times; zero if there is none.
pub(super) fn widest_bound<'a, S: Scalar>(times: impl Iterator<Item = &'a S>) -> f64 {
    times.map(|time| time.log2_error().exp2()).filter(|bound| bound.is_finite()).fold(0.0, f64::max)
}

/// Returns whether the error of a time is at most `roundings` of its roundings.
pub(super) fn is_rounded<S: Scalar>(time: &S, roundings: f64) -> bool {
    time.log2_error() <= time.to_f64().abs().log2() + time.log2_roundoff() + roundings.log2()
}

/// Returns whether the time of a ray is indistinguishable from `time` within both bounds.
pub(super) fn is_open<S: Scalar>(met: &S, time: &S) -> bool {
    met.log2_error() < f64::INFINITY && (met.clone() - time).vanishes() != Ok(false)
}
