//! What the march stores: the upward invariant `p` at the ground, piece by piece.

use crate::history::EventKind;
use crate::number::Scalar;
use crate::rod::Top;

/// A stretch of the ground trace on which `p` is linear and nothing happens.
///
/// The errors are bounds in units of the roundoff `u` of the number system, zero in exact ones: the true line lies within
/// `value_error · u` of the stored one, the true height within `height_error · u`.
#[derive(Clone, Debug)]
pub struct Piece<S> {
    /// Where it begins, as an age in its round trip.
    pub fraction: S,
    /// `p` at its beginning.
    pub value: S,
    /// `dp/dt`.
    pub slope: S,
    /// `v(0,·)` at its beginning.
    pub height: S,
    /// Whether the end stands on the ground.
    pub contact: bool,
    /// Bound on the error of `p`, in roundoffs.
    pub value_error: f64,
    /// Bound on the error of `height`, in roundoffs.
    pub height_error: f64,
    /// Bound on the error of `fraction`, in roundoffs.
    pub fraction_error: f64,
}

/// A change between contact and flight, in lattice units.
#[derive(Clone, Debug)]
pub struct Occurrence<S> {
    /// Landing or leaving.
    pub kind: EventKind,
    /// The round trip in which it happens.
    pub trip: usize,
    /// The age in it.
    pub fraction: S,
    /// `v_t(0,·)` just before an impact, just after a release; see [`crate::history::Event`].
    pub end_velocity: S,
    /// Bound on the error of `fraction`, in roundoffs.
    pub error: f64,
}

/// The trace of `p` at the ground from one round trip before the start to the end of the march.
#[derive(Clone, Debug)]
pub struct Trace<S> {
    pieces: Vec<Piece<S>>,
    /// Where each round trip begins in `pieces`; the first is the one before the start.
    starts: Vec<usize>,
    top: Top,
    gravity: S,
}

/// A part of a piece that lies in a window: `p = value + slope·s` for `0 ≤ s ≤ width`, `offset` after the window's start.
pub(crate) struct Part<S> {
    pub(crate) offset: S,
    pub(crate) width: S,
    pub(crate) value: S,
    pub(crate) slope: S,
}

impl<S: Scalar> Trace<S> {
    pub(crate) fn new(before: Vec<(S, S, S)>, top: Top, gravity: S) -> Self {
        let pieces = before
            .into_iter()
            .map(|(fraction, value, slope)| {
                // A few roundings stand behind each datum of the start.
                let value_error = if S::EXACT { 0.0 } else { 8.0 * (value.to_f64().abs() + slope.to_f64().abs()) };
                let fraction_error = if S::EXACT { 0.0 } else { 4.0 * fraction.to_f64() };
                let height = fraction.zero();
                Piece { fraction, value, slope, height, contact: false, value_error, height_error: 0.0, fraction_error }
            })
            .collect();
        Trace { pieces, starts: vec![0], top, gravity }
    }

    /// All pieces, the round trip before the start included.
    pub fn pieces(&self) -> &[Piece<S>] {
        &self.pieces
    }

    /// The pieces of round trip `trip`, 0 being the first after the start.
    pub fn trip(&self, trip: usize) -> &[Piece<S>] {
        self.slice(trip + 1)
    }

    /// How many round trips are stored, the last perhaps in part.
    pub fn trips(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many pieces there are after the start.
    pub fn count(&self) -> usize {
        self.pieces.len() - self.starts.get(1).copied().unwrap_or(self.pieces.len())
    }

    fn slice(&self, index: usize) -> &[Piece<S>] {
        let from = self.starts[index];
        let to = self.starts.get(index + 1).copied().unwrap_or(self.pieces.len());
        &self.pieces[from..to]
    }

    pub(crate) fn begin_trip(&mut self) {
        self.starts.push(self.pieces.len());
    }

    pub(crate) fn push(&mut self, piece: Piece<S>) {
        self.pieces.push(piece);
    }

    pub(crate) fn start_of(&self, index: usize) -> usize {
        self.starts[index]
    }

    /// `p → q`: what comes back a round trip later.
    pub(crate) fn returned(&self, p: &S) -> S {
        match self.top {
            Top::Free => p.clone() - &self.gravity,
            Top::Fixed => -p.clone(),
        }
    }

    /// The slope of what comes back.
    pub(crate) fn returned_slope(&self, slope: &S) -> S {
        match self.top {
            Top::Free => slope.clone(),
            Top::Fixed => -slope.clone(),
        }
    }

    /// The piece of `index` (0: before the start) in which `fraction` lies; at its very beginning the earlier one if
    /// `before` is asked for, which may be the last of the round trip before.
    pub(crate) fn find(&self, index: usize, fraction: &S, before: bool) -> (usize, &Piece<S>) {
        let pieces = self.slice(index);
        let behind = pieces
            .partition_point(|piece| if before { piece.fraction < *fraction } else { piece.fraction <= *fraction });
        match (behind, index) {
            (0, 0) => (0, &pieces[0]),
            (0, _) => {
                let earlier = self.slice(index - 1);
                (index - 1, &earlier[earlier.len() - 1])
            }
            _ => (index, &pieces[behind - 1]),
        }
    }

    /// `p` at age `fraction` of trip `index` (0: before the start), from the asked side.
    pub(crate) fn value(&self, index: usize, fraction: &S, before: bool) -> S {
        let (found, piece) = self.find(index, fraction, before);
        let age = if found == index { fraction.clone() } else { fraction.clone() + fraction.one() };
        piece.value.clone() + piece.slope.clone() * (age - &piece.fraction)
    }

    /// `p` over `width` after age `from` of trip `index` (0: before the start), in parts.
    pub(crate) fn window(&self, index: usize, from: &S, width: &S, mut visit: impl FnMut(Part<S>)) {
        let zero = width.zero();
        if !width.is_positive() {
            return;
        }
        let (mut index, mut from, mut left, mut offset) = (index, from.clone(), width.clone(), zero);
        let mut at = self.slice(index).partition_point(|piece| piece.fraction <= from).saturating_sub(1);
        loop {
            let pieces = self.slice(index);
            let piece = &pieces[at];
            let to = pieces.get(at + 1).map_or_else(|| from.one(), |next| next.fraction.clone());
            let room = to.clone() - &from;
            let done = room >= left;
            let width = if done { left.clone() } else { room };
            if width.is_positive() {
                let value = piece.value.clone() + piece.slope.clone() * (from.clone() - &piece.fraction);
                visit(Part { offset: offset.clone(), width: width.clone(), value, slope: piece.slope.clone() });
            }
            if done || (at + 1 == pieces.len() && index + 1 == self.starts.len()) {
                return;
            }
            (left, offset) = (left - &width, offset + &width);
            if at + 1 < pieces.len() {
                (at, from) = (at + 1, to);
            } else {
                (index, at, from) = (index + 1, 0, to.zero());
            }
        }
    }
}
