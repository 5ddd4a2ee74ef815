//! How far values may be off between events, and numbers that carry such bounds.

use crate::motion::Event;
use crate::number::{Estimate, Rounded, Scalar};

/// What either account says of an error.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Off {
    /// The account that takes `v` as one.
    pub(super) fixed: f64,
    /// The account of flights that are taken apart.
    pub(super) apart: f64,
}

impl Off {
    pub(super) fn max(self, other: Off) -> Off {
        Off { fixed: self.fixed.max(other.fixed), apart: self.apart.max(other.apart) }
    }
}

/// How far the values of a run may be off between two events, in natural scales, away from rays that are off in time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Uncertainty {
    /// Displacements, in `V t₁`, as far as the events are in time.
    pub(super) rise: f64,
    /// Velocities and `c v_x`, in `V`, as far as the events are in time.
    pub(super) speed: f64,
    /// `h′`, in `V`, as far as the events are in time.
    pub(super) rate: f64,
    /// How early or late the events may be, in `t₁`.
    pub(super) late: f64,
    /// `|dv_t/dt|` between rays, in `V/t₁`: what lateness makes of velocities.
    pub(super) slope: f64,
    /// The most of `|v_t|` and `|c v_x|`, in `V`: what lateness makes of displacements and of integrals along the rod.
    pub(super) most: f64,
    /// The most of `v_t ± c v_x` about the centre of mass, in `V`: what a ray that is off in time makes of energies.
    pub(super) peak: f64,
    /// `Σ` of the jumps of `v_t ± c v_x` at rays, in `V`; of a proof alone.
    pub(super) jumps: f64,
    /// How far rays may be off, in `t₁`: what the limits next to them, and peaks, are off by is that times the slope.
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

/// So many roundings of a time, or of a round trip: how close to a ray or a lattice time it is taken to be on it.
pub(super) fn slack<S: Rounded>(t: &S, roundings: i64) -> S {
    (t.magnitude() + t.one()) * &t.roundoff() * &t.int(roundings)
}

/// `value` within `bound`.
pub(super) fn within<S: Rounded>(value: &S, bound: f64) -> Estimate<S> {
    Estimate::new(value.clone(), bound / value.unit() + value.to_f64().abs())
}

/// `value` with so much more in its bound.
pub(super) fn wider<S: Rounded>(value: Estimate<S>, bound: f64) -> Estimate<S> {
    Estimate::new(value.value().clone(), value.error() + bound / value.value().unit())
}

/// In roundings of its time, how far the time of an event is off for a spelled one to stand for it.
const MOST_ROUNDINGS: f64 = 64.0;

/// The time that is asked about: that of the nearest event, where roundings alone set it apart, and the event is where
/// it is meant to be or the time was computed.
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
