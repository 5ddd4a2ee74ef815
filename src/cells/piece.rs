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
    /// Its beginning.
    pub(super) from: S,
    /// Its length.
    pub(super) len: S,
    /// Whether the ground end is in contact.
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
    /// Its end.
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
    /// Landing or leaving.
    pub(super) kind: EventKind,
    /// Its time.
    pub(super) time: S,
    /// `v_t(0,·)`, just before or just after.
    pub(super) velocity: S,
    /// How far the time may be off.
    pub(super) time_error: f64,
    /// How far values may be off then, where flights are taken apart.
    pub(super) at: Option<AtEvent>,
    /// How far they may be off from then to the next event.
    pub(super) after: Uncertainty,
}

/// Hops that are not told apart from contact.
///
/// Where events lie on rays exactly, as they often do without damping, there are none in truth: nothing but the bound
/// says that there may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Unresolved<S> {
    /// From this time on.
    pub from: S,
    /// How many landings they may belong to.
    pub count: usize,
    /// How long each of them may be at most.
    pub longest: f64,
}

impl<S: RoundedSpecial> Unresolved<S> {
    /// The same for a user.
    pub(super) fn warning(&self) -> Warning {
        Warning::HopsUnresolved { from: self.from.to_f64(), longest: self.longest, landings: self.count }
    }
}

/// What a run has found.
pub(super) struct Found<S> {
    pub(super) pieces: Vec<Piece<S>>,
    pub(super) checkpoints: Vec<Checkpoint<S>>,
    pub(super) flights: Vec<Flight<S>>,
    pub(super) marks: Vec<Mark<S>>,
    pub(super) warnings: Vec<Warning>,
    pub(super) unresolved: Option<Unresolved<S>>,
    pub(super) before: Uncertainty,
    pub(super) ending: Ending,
    /// How far its time may be off where it is an event.
    pub(super) end_error: f64,
    pub(super) proof: Option<Proof<S>>,
}
