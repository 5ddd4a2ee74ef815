//! What the march stores: the upward invariant `p` at the ground, piece by piece.

use crate::history::EventKind;
use crate::number::Scalar;
use crate::rod::Top;

/// A stretch of the ground trace on which `p` is linear and nothing happens.
///
/// The line is kept by its intercept, `p = slope·f + intercept` at age `f`, because that is all that a round trip changes: it
/// only ever turns its sign and falls by gravity, so events leave no rounding in it, and it stays a fraction between events
/// at irrational times.
///
/// The errors are bounds in units of the roundoff `u` of the number system, zero in exact ones: the true line lies within
/// `value_error · u` of the stored one, the true height within `height_error · u`.
#[derive(Clone, Debug)]
pub struct Piece<S> {
    /// Where it begins, as an age in its round trip.
    pub fraction: S,
    /// `p` where its line passes age 0.
    pub intercept: S,
    /// `dp/dt`.
    pub slope: S,
    /// `v(0,·)` at its beginning.
    pub height: S,
    /// Whether the end stands on the ground.
    pub contact: bool,
    /// Bound on the error of the line, in roundoffs.
    pub value_error: f64,
    /// Bound on the error of `height`, in roundoffs.
    pub height_error: f64,
    /// Bound on the error of `fraction`, in roundoffs.
    pub fraction_error: f64,
}

impl<S: Scalar> Piece<S> {
    /// `p` at age `fraction`.
    pub fn at(&self, fraction: &S) -> S {
        self.slope.clone() * fraction + &self.intercept
    }
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
    /// The round trips that are stored, the first being the one before the start.
    slots: Vec<Slot<S>>,
    /// The index after the last trip.
    end: usize,
    top: Top,
    gravity: S,
}

/// A stored round trip, and those after it that only repeat it.
///
/// In flight under gravity `q` falls by `g = 1` from one trip to the next and nothing else changes. With `D = ∫ q dt` over
/// the stored trip, `j` trips later `p` is lower by `j` and `v(0,·)` at age `f` higher by `j (D − f − (j − 1)/2)`.
#[derive(Clone, Debug)]
struct Slot<S> {
    /// The index of the trip, 0 being the one before the start.
    first: usize,
    /// Where it begins in the pieces.
    start: usize,
    /// `D`, if trips that repeat this one follow it, and a bound on its error in roundoffs.
    rise: Option<(S, f64)>,
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
        let mut pieces: Vec<Piece<S>> = before
            .into_iter()
            .map(|(fraction, value, slope)| {
                // A few roundings stand behind each datum of the start.
                let value_error = if S::RIGOROUS { 0.0 } else { 10.0 * (value.to_f64().abs() + slope.to_f64().abs()) };
                let fraction_error = if S::RIGOROUS { 0.0 } else { 4.0 * fraction.to_f64() };
                let (height, intercept) = (fraction.zero(), value - slope.clone() * &fraction);
                Piece {
                    fraction,
                    intercept,
                    slope,
                    height,
                    contact: false,
                    value_error,
                    height_error: 0.0,
                    fraction_error,
                }
            })
            .collect();
        // A first contact and its flight fit without growing.
        pieces.reserve(64);
        Trace { pieces, slots: vec![Slot { first: 0, start: 0, rise: None }], end: 1, top, gravity }
    }

    /// All pieces that are stored, the round trip before the start included.
    pub fn pieces(&self) -> &[Piece<S>] {
        &self.pieces
    }

    /// The stored round trips after the start: number (from 0) and pieces. Between them lie flights that repeat the trip
    /// before them but for gravity.
    pub fn stored(&self) -> impl Iterator<Item = (usize, &[Piece<S>])> {
        let after_start = self.slots.iter().enumerate().filter(|(_, slot)| slot.first > 0);
        after_start.map(|(k, slot)| (slot.first - 1, self.pieces_of(k)))
    }

    /// How many round trips there are, the last perhaps in part.
    pub fn trips(&self) -> usize {
        self.end - 1
    }

    /// How many pieces are stored after the start.
    pub fn count(&self) -> usize {
        let before = match self.slots.first() {
            Some(slot) if slot.first == 0 => self.slots.get(1).map_or(self.pieces.len(), |slot| slot.start),
            _ => 0,
        };
        self.pieces.len() - before
    }

    /// The first trip with another stored before it, which is what questions about it need.
    pub(crate) fn begin(&self) -> usize {
        self.slots.first().map_or(0, |slot| slot.first) + 1
    }

    /// Forgets all but the last two trips that are stored.
    pub(crate) fn forget(&mut self) {
        let old = self.slots.len().saturating_sub(2);
        let from = self.slots[old].start;
        self.slots.drain(..old);
        for slot in &mut self.slots {
            slot.start -= from;
        }
        self.pieces.drain(..from);
    }

    fn pieces_of(&self, slot: usize) -> &[Piece<S>] {
        let to = self.slots.get(slot + 1).map_or(self.pieces.len(), |next| next.start);
        &self.pieces[self.slots[slot].start..to]
    }

    /// The slot that stands for trip `index`, and how many trips after its own that is.
    fn slot(&self, index: usize) -> (usize, usize) {
        // The march asks for the last two trips only.
        let last = self.slots.len() - 1;
        let slot = (last.saturating_sub(1)..=last)
            .rev()
            .find(|k| self.slots[*k].first <= index)
            .unwrap_or_else(|| self.slots.partition_point(|slot| slot.first <= index).max(1) - 1);
        (slot, index - self.slots[slot].first)
    }

    /// The pieces that stand for trip `index`: its own, or those of the trip that it repeats.
    pub(crate) fn slice(&self, index: usize) -> &[Piece<S>] {
        self.pieces_of(self.slot(index).0)
    }

    /// A piece of [`Trace::slice`] as it is in trip `index`.
    fn piece(&self, index: usize, piece: &Piece<S>) -> Piece<S> {
        let (slot, later) = self.slot(index);
        let mut piece = piece.clone();
        if let (Some((rise, rise_error)), true) = (&self.slots[slot].rise, later > 0) {
            let (j, two) = (rise.int(later as i64), rise.int(2));
            let lift = (rise.clone() - &piece.fraction - (j.clone() - rise.one()) / two) * &j;
            if !S::RIGOROUS {
                piece.value_error += piece.intercept.to_f64().abs() + later as f64;
                let (trips, size) = (later as f64, rise.to_f64().abs() + later as f64);
                piece.height_error += trips * (rise_error + 8.0 * size) + piece.height.to_f64().abs();
            }
            piece.intercept = piece.intercept - j;
            piece.height = piece.height + lift;
        }
        piece
    }

    /// Where the pieces that stand for trip `index` begin, and how far `p` has fallen since.
    pub(crate) fn start_of(&self, index: usize) -> (usize, S) {
        let (slot, later) = self.slot(index);
        (self.slots[slot].start, self.gravity.int(later as i64) * &self.gravity)
    }

    pub(crate) fn begin_trip(&mut self) {
        self.slots.push(Slot { first: self.end, start: self.pieces.len(), rise: None });
        self.end += 1;
    }

    /// Whether a flight repeats itself but for the fall: gravity and a free top.
    pub(crate) fn falls_freely(&self) -> bool {
        self.top == Top::Free && !self.gravity.is_zero()
    }

    /// Where the pieces of the last trip begin.
    pub(crate) fn last_start(&self) -> usize {
        self.slots.last().map_or(0, |slot| slot.start)
    }

    /// Lets `trips` trips that repeat the last one follow it; `rise` is `∫ q dt` over that one, within `error` roundoffs.
    pub(crate) fn repeat(&mut self, rise: S, error: f64, trips: usize) {
        if let Some(slot) = self.slots.last_mut() {
            slot.rise = Some((rise, error));
            self.end += trips;
        }
    }

    pub(crate) fn push(&mut self, piece: Piece<S>) {
        self.pieces.push(piece);
    }

    /// Forgets all pieces but the first `count`, and the last trip if nothing is left of it.
    pub(crate) fn truncate(&mut self, count: usize) {
        self.pieces.truncate(count);
        if self.slots.last().is_some_and(|slot| slot.start >= count && slot.rise.is_none()) {
            self.slots.pop();
            self.end -= 1;
        }
    }

    /// How far apart two solutions may be that both go on from here as it is known, in `v(0,·)` and within a round trip: as far
    /// as the enclosures are wide in which `height`, the lines and the jumps between them lie. The reflection at zero does not
    /// take two paths further apart than what drives them.
    pub(crate) fn apart(&self, height: &S) -> f64 {
        // What has left the ground in this trip, and what the one before still brings.
        let trips = [self.end.saturating_sub(2), self.end - 1].map(|index| self.slice(index));
        let lines = trips.into_iter().flatten().map(|piece| piece.intercept.width().to_f64()).fold(0.0, f64::max);
        let jump = |pair: &[Piece<S>]| {
            let at = &pair[1].fraction;
            (pair[1].at(at) - pair[0].at(at)).to_f64().abs() * at.width().to_f64()
        };
        let jumps: f64 = trips.into_iter().flat_map(|pieces| pieces.windows(2).map(jump)).sum();
        // Doubles that were added without looking where they round to.
        (height.width().to_f64() + lines + jumps) * (1.0 + 1e-9)
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
    pub(crate) fn find(&self, index: usize, fraction: &S, before: bool) -> (usize, Piece<S>) {
        let pieces = self.slice(index);
        let behind = pieces
            .partition_point(|piece| if before { piece.fraction < *fraction } else { piece.fraction <= *fraction });
        match (behind, index) {
            (0, 0) => (0, pieces[0].clone()),
            (0, _) => {
                let earlier = self.slice(index - 1);
                (index - 1, self.piece(index - 1, &earlier[earlier.len() - 1]))
            }
            _ => (index, self.piece(index, &pieces[behind - 1])),
        }
    }

    /// `p` at age `fraction` of trip `index` (0: before the start), from the asked side.
    pub(crate) fn value(&self, index: usize, fraction: &S, before: bool) -> S {
        let (found, piece) = self.find(index, fraction, before);
        let age = if found == index { fraction.clone() } else { fraction.clone() + fraction.one() };
        piece.at(&age)
    }

    /// `p` from one trip and age to another (0: the trip before the start), in parts.
    pub(crate) fn window(&self, from: (usize, &S), until: (usize, &S), mut visit: impl FnMut(Part<S>)) {
        let (mut index, mut from, mut offset) = (from.0, from.1.clone(), from.1.zero());
        let mut pieces = self.slice(index);
        let mut at = pieces.partition_point(|piece| piece.fraction <= from).saturating_sub(1);
        let mut fallen = self.start_of(index).1;
        loop {
            let piece = &pieces[at];
            let to = pieces.get(at + 1).map_or_else(|| from.one(), |next| next.fraction.clone());
            // Ages are compared, never widths: with themselves they agree in every number system.
            let done = index > until.0 || (index == until.0 && to >= *until.1);
            let to = if done { until.1.clone() } else { to };
            if to > from {
                let (width, value) = (to.clone() - &from, piece.at(&from) - &fallen);
                visit(Part { offset: offset.clone(), width: width.clone(), value, slope: piece.slope.clone() });
                offset = offset + width;
            }
            if done || (at + 1 == pieces.len() && index + 1 == self.end) {
                return;
            }
            if at + 1 < pieces.len() {
                (at, from) = (at + 1, to);
            } else {
                (index, at, from) = (index + 1, 0, to.zero());
                (pieces, fallen) = (self.slice(index), self.start_of(index).1);
            }
        }
    }
}
