//! What a run leaves behind: what the ground felt, strip by strip, events, and states to start again from.

use super::account::Proof;
use super::budget::AtEvent;
use super::flight::Flight;
use super::march::State;
use super::uncertainty::Uncertainty;
use crate::motion::{Ending, EventKind};
use crate::reason::Warning;
use crate::special::RoundedSpecial;

/// What happened at the ground during one strip, or during a flight that was leapt over, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Piece<S> {
    pub(super) from: S,
    pub(super) len: S,
    pub(super) contact: bool,
    /// The flight that it belongs to, where centre of mass and vibration are apart.
    pub(super) flight: Option<usize>,
    /// Whether the first segment was cut for this strip.
    pub(super) cut: bool,
    /// Whether the rod is at rest: nothing was marched.
    pub(super) still: bool,
    /// Round trips that were leapt over; zero for a strip.
    pub(super) leap: i64,
    /// `v_t + c v_x` in Chebyshev coefficients; empty in a leap.
    pub(super) trace: Vec<S>,
    /// `v(0,·)`; empty in contact and in a leap.
    pub(super) height: Vec<S>,
}

impl<S: RoundedSpecial> Piece<S> {
    /// A strip of which the ground has felt nothing.
    pub(super) fn new(from: S, len: S, contact: bool, flight: Option<usize>) -> Self {
        let (trace, height) = (Vec::new(), Vec::new());
        Piece { from, len, contact, flight, cut: false, still: false, leap: 0, trace, height }
    }

    pub(super) fn to(&self) -> S {
        self.from.clone() + &self.len
    }
}

/// A state that is kept.
#[derive(Clone, Debug)]
pub(super) struct Checkpoint<S> {
    /// How many pieces came before it.
    pub(super) index: usize,
    /// The flight whose vibration it holds; the deviation from the static state without one.
    pub(super) flight: Option<usize>,
    pub(super) state: State<S>,
    /// `z(0,b)` in such a flight.
    pub(super) ground: S,
}

/// An event, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Mark<S> {
    pub(super) kind: EventKind,
    pub(super) time: S,
    /// `v_t(0,·)`, just before or just after.
    pub(super) velocity: S,
    pub(super) time_error: f64,
    /// How far values may be off then, where flights are taken apart.
    pub(super) at: Option<AtEvent>,
    /// How far they may be off from then to the next event.
    pub(super) after: Uncertainty,
}

impl<S> Mark<S> {
    /// With nothing known of how far it is off.
    pub(super) fn new(kind: EventKind, time: S, velocity: S) -> Self {
        Mark { kind, time, velocity, time_error: f64::INFINITY, at: None, after: Uncertainty::default() }
    }
}

/// What a run has found.
pub(super) struct Found<S> {
    pub(super) pieces: Vec<Piece<S>>,
    pub(super) checkpoints: Vec<Checkpoint<S>>,
    pub(super) flights: Vec<Flight<S>>,
    pub(super) marks: Vec<Mark<S>>,
    pub(super) warnings: Vec<Warning>,
    pub(super) unresolved: Option<Warning>,
    pub(super) before: Uncertainty,
    pub(super) ending: Ending,
    /// How far its time may be off where it is an event.
    pub(super) end_error: f64,
    pub(super) proof: Option<Proof<S>>,
}
