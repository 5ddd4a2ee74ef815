//! Error bounds of the values between events, and numbers that carry them.

use crate::motion::Event;
use crate::number::{Estimate, Rounded, Scalar};

/// Error in each of the two accounts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Off {
    /// Error in the account at equal times, which treats `v` as a whole.
    pub(super) fixed: f64,
    /// Error in the account of separated flights.
    pub(super) apart: f64,
}

impl Off {
    /// Returns both errors with `more` added.
    pub(super) fn plus(self, more: f64) -> Off {
        Off { fixed: self.fixed + more, apart: self.apart + more }
    }

    pub(super) fn max(self, other: Off) -> Off {
        Off { fixed: self.fixed.max(other.fixed), apart: self.apart.max(other.apart) }
    }
}

/// Error bounds of the values between two events, in natural scales, away from rays that are displaced in time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Uncertainty {
    /// Bound for displacements, in `V t₁`, apart from the time error of events.
    pub(super) rise: f64,
    /// Bound for velocities and `c v_x`, in `V`, apart from the time error of events.
    pub(super) speed: f64,
    /// Bound for `h′`, in `V`, apart from the time error of events.
    pub(super) rate: f64,
    /// Bound for the time error of the events, in `t₁`.
    pub(super) late: f64,
    /// Greatest `|dv_t/dt|` between rays, in `V/t₁`: the factor from time errors to velocity errors.
    pub(super) slope: f64,
    /// Greatest `|v_t|` and `|c v_x|`, in `V`: the factor from time errors to errors of displacements and integrals.
    pub(super) most: f64,
    /// Greatest `|v_t ± c v_x|` about the centre of mass, in `V`: the factor from displaced rays to errors of energies.
    pub(super) peak: f64,
    /// Sum of the jumps of `v_t ± c v_x` at rays, in `V`.
    pub(super) jumps: f64,
    /// Bound for the displacement of rays, in `t₁`; times the slope, it bounds the error of one-sided limits and peaks.
    pub(super) rays: f64,
}

impl Uncertainty {
    pub(super) fn max(self, other: Self) -> Self {
        Uncertainty {
            rise: self.rise.max(other.rise),
            speed: self.speed.max(other.speed),
            rate: self.rate.max(other.rate),
            late: self.late.max(other.late),
            slope: self.slope.max(other.slope),
            most: self.most.max(other.most),
            peak: self.peak.max(other.peak),
            jumps: self.jumps.max(other.jumps),
            rays: self.rays.max(other.rays),
        }
    }
}

/// Returns the distance from a ray or lattice time, in so many roundings of `t` or a round trip, that counts as zero.
pub(super) fn slack<S: Rounded>(t: &S, roundings: i64) -> S {
    (t.magnitude() + t.one()) * &t.roundoff() * &t.int(roundings)
}

pub(super) fn within<S: Rounded>(value: &S, bound: f64) -> Estimate<S> {
    Estimate::new(value.clone(), bound / value.unit() + value.to_f64().abs())
}

pub(super) fn wider<S: Rounded>(value: Estimate<S>, bound: f64) -> Estimate<S> {
    Estimate::new(value.value().clone(), value.error() + bound / value.value().unit())
}

/// Largest error of an event's time, in roundings, for which a time given as text may stand for the event.
const MOST_ROUNDINGS: f64 = 64.0;

/// Returns the time of the nearest event if `time` differs from it by roundings alone and either the event is known
/// that well or the time was computed; otherwise returns `time`.
pub(super) fn meant<'a, S: Rounded>(events: &'a [Event<Estimate<S>>], time: &'a Estimate<S>) -> &'a Estimate<S> {
    let next = events.partition_point(|event| event.t.value() < time.value());
    let near = events[next.saturating_sub(1)..].iter().take(2).map(|event| &event.t);
    let roundings = 4.0 * time.value().unit() * time.value().to_f64().abs();
    let apart = |event: &&Estimate<S>| (event.value().clone() - time.value()).to_f64().abs();
    let nearest = near.min_by(|a, b| apart(a).total_cmp(&apart(b)));
    let known = |event: &Estimate<S>| event.bound() <= MOST_ROUNDINGS / 4.0 * roundings;
    let met = |event: &&Estimate<S>| {
        apart(event) <= time.bound() + event.bound().min(roundings) && (time.spelled_as().is_none() || known(event))
    };
    nearest.filter(met).unwrap_or(time)
}
