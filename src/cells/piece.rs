//! Results of a run: the motion of the ground end strip by strip, events, and checkpoints to march from again.

use super::account::Proof;
use super::budget::AtEvent;
use super::flight::Flight;
use super::march::State;
use super::uncertainty::Uncertainty;
use crate::motion::{Ending, EventKind};
use crate::reason::Warning;
use crate::special::RoundedSpecial;

/// Motion of the ground end during one strip or one leap, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Piece<S> {
    pub(super) from: S,
    pub(super) len: S,
    pub(super) contact: bool,
    /// Index of its flight, if centre of mass and vibration are separated.
    pub(super) flight: Option<usize>,
    /// Whether the first segment was cut for this strip.
    pub(super) cut: bool,
    /// Whether the rod is at rest: nothing was marched.
    pub(super) still: bool,
    /// Number of round trips of a leap; zero for a strip.
    pub(super) leap: i64,
    /// `v_t + c v_x` in Chebyshev coefficients; empty in a leap.
    pub(super) trace: Vec<S>,
    /// `v(0,·)`; empty in contact and in a leap.
    pub(super) height: Vec<S>,
}

impl<S: RoundedSpecial> Piece<S> {
    /// Builds a strip without trace and height.
    pub(super) fn new(from: S, len: S, contact: bool, flight: Option<usize>) -> Self {
        let (trace, height) = (Vec::new(), Vec::new());
        Piece { from, len, contact, flight, cut: false, still: false, leap: 0, trace, height }
    }

    pub(super) fn to(&self) -> S {
        self.from.clone() + &self.len
    }
}

/// A stored state.
#[derive(Clone, Debug)]
pub(super) struct Checkpoint<S> {
    /// Number of pieces before it.
    pub(super) index: usize,
    /// Index of the flight whose vibration it holds; without one it holds the deviation from the static state.
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
    /// `v_t(0,·)` just before or just after the event.
    pub(super) velocity: S,
    pub(super) time_error: f64,
    /// Error bounds of values at the event, if flights are separated.
    pub(super) at: Option<AtEvent>,
    /// Error bounds of values between this event and the next.
    pub(super) after: Uncertainty,
}

impl<S> Mark<S> {
    /// Builds an event whose errors are not yet known.
    pub(super) fn new(kind: EventKind, time: S, velocity: S) -> Self {
        Mark { kind, time, velocity, time_error: f64::INFINITY, at: None, after: Uncertainty::default() }
    }
}

/// Result of a run.
pub(super) struct Found<S> {
    pub(super) pieces: Vec<Piece<S>>,
    pub(super) checkpoints: Vec<Checkpoint<S>>,
    pub(super) flights: Vec<Flight<S>>,
    pub(super) marks: Vec<Mark<S>>,
    pub(super) warnings: Vec<Warning>,
    pub(super) unresolved: Option<Warning>,
    pub(super) before: Uncertainty,
    pub(super) ending: Ending,
    /// Time error of the end of the run, if it is an event.
    pub(super) end_error: f64,
    pub(super) proof: Option<Proof<S>>,
}
