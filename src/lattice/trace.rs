//! The stored upward invariant `p` at the ground, piece by piece.

use std::cmp::Ordering;

use crate::motion::{EventKind, Side, partition};
use crate::number::{Bounded, Open, is_exact_zero};
use crate::problem::Top;

/// A line `intercept + slope·f` in the age `f`.
///
/// A round trip changes only the intercept: it flips the sign or subtracts gravity. Events therefore leave no rounding
/// in the intercept, and it remains a fraction between events at irrational times.
#[derive(Clone, Debug)]
pub struct Line<N> {
    /// The value at age 0, extrapolated.
    pub intercept: N,
    /// The rate of change.
    pub slope: N,
}

impl<N: Bounded> Line<N> {
    /// Returns the value at `age`.
    pub fn value_at(&self, age: &N) -> N {
        if is_exact_zero(&self.slope) {
            return self.intercept.clone();
        }
        self.slope.clone() * age + &self.intercept
    }

    /// Returns the value at the stored `age`, without the error of the age.
    pub(crate) fn value_at_stored(&self, age: &N) -> N {
        self.slope.clone().times_stored(age) + &self.intercept
    }

    /// Merges two lines that agree within their bounds.
    pub(super) fn joined(self, other: &Self) -> Self {
        Line { intercept: self.intercept.joined(&other.intercept), slope: self.slope.joined(&other.slope) }
    }

    /// Returns whether both lines are proved equal, or agree within their bounds.
    pub(crate) fn same(&self, other: &Self) -> bool {
        self.slope.same(&other.slope) && self.intercept.same(&other.intercept)
    }
}

impl<N: Bounded> std::ops::Neg for Line<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Line { intercept: -self.intercept, slope: -self.slope }
    }
}

/// A stretch of the ground trace on which `p` is linear, without break or event.
#[derive(Clone, Debug)]
pub struct Piece<N> {
    /// Its beginning, as an age in its round trip.
    pub age: N,
    /// `p`.
    pub line: Line<N>,
    /// `v(0,·)` at its stored beginning.
    pub height: N,
    /// Whether the end is in contact with the ground.
    pub contact: bool,
    /// `p` at its beginning as an exact multiple of gravity; `None` for other breaks. It is known of a break that a
    /// release between two rays sends out: there `p` was zero, and reflections have only added gravity and turned its
    /// sign. The value of the line at the age is not exact, as line and age have separate errors.
    pub(super) knot: Option<i64>,
}

/// A change between contact and flight, in lattice units.
#[derive(Clone, Debug)]
pub struct GroundEvent<N> {
    /// Impact or release.
    pub kind: EventKind,
    /// The round trip in which it happens.
    pub trip: usize,
    /// The age in it.
    pub age: N,
    /// The index of the piece of this trip that begins with it.
    pub piece: usize,
    /// The index of the piece of the trip before that returns at this age.
    pub incoming: usize,
    /// `v_t(0,·)` just before an impact, just after a release; see [`crate::motion::Event`].
    pub end_velocity: N,
}

/// The trace of `p` at the ground from one round trip before the start to the end of the march.
#[derive(Clone, Debug)]
pub struct Trace<N> {
    pieces: Vec<Piece<N>>,
    /// The stored round trips; the first is the one before the start.
    slots: Vec<Slot<N>>,
    /// The index after the last trip.
    end: usize,
    top: Top,
    gravity: N,
}

/// A stored round trip, and the later trips that repeat it.
///
/// In flight under gravity `q` falls by `g = 1` from each trip to the next and nothing else changes. With `D = ∫ q dt`
/// over the stored trip, `j` trips later `p` is lower by `j` and `v(0,·)` at age `f` higher by `j (D − f − (j − 1)/2)`.
#[derive(Clone, Debug)]
struct Slot<N> {
    /// The index of the trip; 0 is the one before the start.
    first: usize,
    /// The index of its first piece.
    start: usize,
    /// `D`, if repeating trips follow.
    rise: Option<N>,
}

/// An age in a trip, with the piece of that trip that contains it.
#[derive(Clone, Debug)]
pub(super) struct Place<N> {
    /// Index of the trip; 0 is the trip before the start.
    pub(super) index: usize,
    pub(super) piece: usize,
    pub(super) age: N,
}

/// The part of a piece inside a window, `offset` after its start: `p = value + slope·s` for `0 ≤ s ≤ width`.
pub(super) struct Part<N> {
    pub(super) offset: N,
    pub(super) width: N,
    pub(super) value: N,
    pub(super) slope: N,
    /// `[p]` at its beginning and the deviation of that age, if a break of uncertain age lies there.
    pub(super) shift: Option<(N, N)>,
    /// The deviation in age of its end.
    pub(super) late_end: Option<N>,
}

/// Number of roundings, besides its own error, within which a queried age counts as the age of a ray.
const ON_A_RAY: f64 = 64.0;

/// Compares a queried age with the age of a ray.
///
/// **Errors**: [`Open`] if only the error of the ray's own age leaves the order undecided.
pub(crate) fn place_to<N: Bounded>(age: &N, ray: &N) -> Result<Ordering, Open> {
    let order = age.compare(ray)?;
    let own = age.roundoffs() + ON_A_RAY;
    if order.is_ne() || ray.roundoffs() <= own {
        return Ok(order);
    }
    let apart = (age.clone() - ray).nominal().magnitude();
    let roundings = (apart.clone() / apart.roundoff()).to_f64();
    if roundings > own { Err(Open) } else { Ok(order) }
}

/// Returns a value at a place that may deviate by `late`: it adds `slope · late` to the error.
pub(super) fn at_deviating<N: Bounded>(value: &N, slope: &N, late: Option<&N>) -> N {
    late.map_or_else(|| value.clone(), |late| late.clone() * slope + value)
}

impl<N: Bounded> Part<N> {
    /// Returns `p` at both ends, within the deviations of their ages.
    pub(super) fn ends(&self) -> [N; 2] {
        let late = self.shift.as_ref().map(|(_, late)| late);
        let end = self.slope.clone() * &self.width + &self.value;
        [at_deviating(&self.value, &self.slope, late), at_deviating(&end, &self.slope, self.late_end.as_ref())]
    }

    pub(super) fn after(self, width: &N) -> Self {
        let value = self.slope.clone() * width + &self.value;
        Part { width: self.width - width, value, shift: None, ..self }
    }

    /// Returns `∫ p ds`.
    pub(super) fn integral(&self) -> N {
        let mean = self.value.clone() + (self.slope.clone() * &self.width).halved();
        let integral = mean * &self.width;
        match &self.shift {
            Some((jump, late)) => integral + jump.clone() * late,
            None => integral,
        }
    }

    /// Returns `∫ s p ds`.
    pub(super) fn moment(&self) -> N {
        let rise = self.slope.clone() * &self.width;
        let three = rise.int(3);
        (self.value.clone().halved() + rise / three) * self.width.square()
    }

    /// Computes `∫ p² ds` as a sum of squares about the middle.
    pub(super) fn square_integral(&self) -> N {
        let rise = self.slope.clone() * &self.width;
        let middle = self.value.clone() + rise.clone().halved();
        let twelve = rise.int(12);
        let integral = (middle.square() + rise.square() / twelve) * &self.width;
        match &self.shift {
            // [p²] = [p] (p₊ + p₋)
            Some((jump, late)) => integral + (self.value.clone().doubled() - jump) * jump * late,
            None => integral,
        }
    }

    /// Drops the exact numbers inside the enclosures.
    pub(super) fn without_exact(self) -> Self {
        let Part { offset, width, value, slope, .. } = self;
        let [offset, width, value, slope] = [offset, width, value, slope].map(N::without_exact);
        Part { offset, width, value, slope, ..self }
    }
}

impl<N: Bounded> Trace<N> {
    pub(super) fn new(before: &[(N, N, N)], top: Top, gravity: N) -> Self {
        let piece = |(age, value, slope): &(N, N, N)| {
            let intercept = value.clone() - slope.clone() * age;
            let line = Line { intercept, slope: slope.clone() };
            Piece { age: age.clone(), line, height: age.zero(), contact: false, knot: None }
        };
        // The reserve holds a first contact and its flight without reallocation.
        let mut pieces = Vec::with_capacity(before.len() + 64);
        pieces.extend(before.iter().map(piece));
        Trace { pieces, slots: vec![Slot { first: 0, start: 0, rise: None }], end: 1, top, gravity }
    }

    /// Returns all stored pieces, the round trip before the start included.
    pub fn pieces(&self) -> &[Piece<N>] {
        &self.pieces
    }

    /// Returns the stored round trips after the start: number (from 0) and pieces. The trips missing between them are
    /// flights that repeat the previous stored trip up to gravity.
    pub fn stored(&self) -> impl Iterator<Item = (usize, &[Piece<N>])> {
        let after_start = self.slots.iter().enumerate().filter(|(_, slot)| slot.first > 0);
        after_start.map(|(k, slot)| (slot.first - 1, self.pieces_of(k)))
    }

    /// Returns the number of round trips; the last may be incomplete.
    pub fn trips(&self) -> usize {
        self.end - 1
    }

    /// Returns the number of stored pieces after the start.
    pub fn count(&self) -> usize {
        let before = match self.slots.first() {
            Some(slot) if slot.first == 0 => self.slots.get(1).map_or(self.pieces.len(), |slot| slot.start),
            _ => 0,
        };
        self.pieces.len() - before
    }

    /// Returns the first trip that can be queried: a query needs the trip and a stored trip before it.
    pub(super) fn begin(&self) -> usize {
        self.slots.first().map_or(0, |slot| slot.first) + 1
    }

    /// Drops all but the last two stored trips.
    pub(super) fn forget(&mut self) {
        let old = self.slots.len().saturating_sub(2);
        let from = self.slots[old].start;
        self.slots.drain(..old);
        for slot in &mut self.slots {
            slot.start -= from;
        }
        self.pieces.drain(..from);
    }

    fn pieces_of(&self, slot: usize) -> &[Piece<N>] {
        let to = self.slots.get(slot + 1).map_or(self.pieces.len(), |next| next.start);
        &self.pieces[self.slots[slot].start..to]
    }

    /// Returns the slot of trip `index`, and the number of trips between the slot's own trip and `index`.
    fn slot(&self, index: usize) -> (usize, usize) {
        let slot = self.slots.partition_point(|slot| slot.first <= index).max(1) - 1;
        (slot, index - self.slots[slot].first)
    }

    /// Returns the pieces of trip `index`: its own, or those of the trip that it repeats.
    pub(super) fn slice(&self, index: usize) -> &[Piece<N>] {
        self.pieces_of(self.slot(index).0)
    }

    /// Returns the index of the first piece of the slot of trip `index`.
    pub(super) fn start_of(&self, index: usize) -> usize {
        self.slots[self.slot(index).0].start
    }

    /// Returns the distance of `p` in trip `index` below the stored pieces, if the trip repeats an earlier one.
    pub(super) fn fallen(&self, index: usize) -> Option<N> {
        let later = self.slot(index).1;
        (later > 0).then(|| self.gravity.int(later as i64))
    }

    /// Returns the piece at `place`, with the fall of a repeated trip applied.
    pub(super) fn piece(&self, place: &Place<N>) -> Piece<N> {
        let (slot, later) = self.slot(place.index);
        let mut piece = self.pieces_of(slot)[place.piece].clone();
        if let (Some(rise), true) = (&self.slots[slot].rise, later > 0) {
            let j = rise.int(later as i64);
            let lift = (rise.clone().minus_stored(&piece.age) - (j.clone() - rise.one()).halved()) * &j;
            piece.line.intercept = piece.line.intercept - j;
            piece.height = piece.height + lift;
        }
        piece
    }

    pub(super) fn begin_trip(&mut self) {
        self.slots.push(Slot { first: self.end, start: self.pieces.len(), rise: None });
        self.end += 1;
    }

    /// Returns whether a flight repeats up to its fall: gravity and a free top.
    pub(super) fn falls_freely(&self) -> bool {
        self.top == Top::Free && self.gravity.to_f64() > 0.0
    }

    pub(super) fn last_start(&self) -> usize {
        self.slots.last().map_or(0, |slot| slot.start)
    }

    /// Appends `trips` trips that repeat the last one; `rise` is `∫ q dt` over the last one.
    pub(super) fn repeat(&mut self, rise: N, trips: usize) {
        if let Some(slot) = self.slots.last_mut() {
            slot.rise = Some(rise);
            self.end += trips;
        }
    }

    pub(super) fn push(&mut self, piece: Piece<N>) {
        self.pieces.push(piece);
    }

    /// Drops all pieces but the first `count`, and the last trip if no piece of it remains.
    pub(super) fn truncate(&mut self, count: usize) {
        self.pieces.truncate(count);
        if self.slots.last().is_some_and(|slot| slot.start >= count && slot.rise.is_none()) {
            self.slots.pop();
            self.end -= 1;
        }
    }

    /// Bounds the distance, in `v(0,·)` and within one round trip, of two solutions that both continue from the known
    /// state. It is the width of the enclosures of `height` and of the lines, plus the jumps times the widths of their
    /// ages: reflection at zero does not increase the distance of two paths beyond that of their driving functions.
    pub(super) fn spread(&self, height: &N) -> f64 {
        // The trip before still returns; the last trip will.
        let (mut lines, mut jumps) = (0.0f64, 0.0);
        for index in [self.end.saturating_sub(2), self.end - 1] {
            let pieces = self.slice(index);
            for (k, Piece { age, line, .. }) in pieces.iter().enumerate() {
                lines = lines.max(line.intercept.width().to_f64());
                if let Some(before) = k.checked_sub(1) {
                    let jump = line.value_at(age) - pieces[before].line.value_at(age);
                    jumps += jump.to_f64().abs() * age.width().to_f64();
                }
            }
        }
        // The factor covers the rounding of these sums of doubles.
        (height.width().to_f64() + lines + jumps) * (1.0 + 1e-9)
    }

    /// Returns `q`, the line that returns one round trip after `p` = `line` has left.
    pub(super) fn returned(&self, line: Line<N>) -> Line<N> {
        match self.top {
            Top::Free => Line { intercept: line.intercept - &self.gravity, ..line },
            Top::Fixed => -line,
        }
    }

    /// Returns [`Piece::knot`] of the piece that returns one round trip later, in trip `index`.
    pub(super) fn knot_returned(&self, knot: i64, index: usize) -> i64 {
        match self.top {
            Top::Free if self.falls_freely() => knot - 1 - self.slot(index).1 as i64,
            Top::Free => knot,
            Top::Fixed => -knot,
        }
    }

    /// Returns the place of `age` in trip `index` (0: before the start): in the piece that begins there, or, from the
    /// left, in the previous piece, which may be the last of the trip before.
    pub(super) fn place(&self, index: usize, age: &N, side: Side) -> Result<Place<N>, Open> {
        let begun = partition(self.slice(index), |piece| {
            let order = place_to(age, &piece.age)?;
            Ok(order.is_gt() || side == Side::Right && order.is_eq())
        })?;
        Ok(self.place_before(index, begun, age))
    }

    /// Returns the place of the `age` at which a piece begins, as the limit from the left.
    pub(super) fn place_before(&self, index: usize, piece: usize, age: &N) -> Place<N> {
        match (piece, index) {
            (0, 0) => Place { index, piece, age: age.clone() },
            (0, _) => Place { index: index - 1, piece: self.slice(index - 1).len() - 1, age: age.clone() + age.one() },
            _ => Place { index, piece: piece - 1, age: age.clone() },
        }
    }

    /// Returns the possible error of a window that ends or begins at `place` if a break is indistinguishable from that
    /// place: zero on one side of the break, on the other `[p]` times the possible distance of the two.
    pub(super) fn edge(&self, place: &Place<N>, side: Side) -> Option<Part<N>> {
        let (mut index, mut piece, mut age) = (place.index, place.piece, place.age.clone());
        if side == Side::Left {
            piece += 1;
            if piece == self.slice(index).len() {
                (index, piece, age) = (index + 1, 0, age.clone() - age.one());
            }
        }
        // The trace before the first stored trip is unknown.
        let first = self.slots.first().map_or(0, |slot| slot.first);
        if index >= self.end || (index, piece) <= (first, 0) {
            return None;
        }
        let Piece { age: begins, line, .. } = self.piece(&Place { index, piece, age: age.clone() });
        let apart = age - &begins;
        let late = if apart.vanishes() == Ok(true) { apart.taken_for_zero().deviation()? } else { return None };
        let left = self.place_before(index, piece, &begins);
        let (value, zero) = (line.value_at(&begins), begins.zero());
        let jump = value.clone() - self.piece(&left).line.value_at(&left.age);
        let (offset, width, slope) = (zero.clone(), zero, line.slope);
        Some(Part { offset, width, value, slope, shift: Some((jump, late)), late_end: None })
    }

    pub(super) fn window_from(
        &self,
        from: &Place<N>,
        until: &Place<N>,
        edge: Option<Part<N>>,
        visit: &mut dyn FnMut(Part<N>),
    ) {
        let mut first = edge.and_then(|edge| edge.shift);
        self.window(from, until, &mut |part| visit(Part { shift: part.shift.or_else(|| first.take()), ..part }));
    }

    /// Visits `p` from one place to another, part by part.
    pub(super) fn window(&self, from: &Place<N>, until: &Place<N>, visit: &mut dyn FnMut(Part<N>)) {
        let (mut index, mut k) = (from.index, from.piece);
        let (mut start, mut offset, mut shift) = (from.age.clone(), from.age.zero(), None);
        let (mut pieces, mut fallen) = (self.slice(index), self.fallen(index));
        while (index, k) <= (until.index, until.piece) {
            let (line, next) = (&pieces[k].line, pieces.get(k + 1));
            let last = (index, k) == (until.index, until.piece);
            let to = match next {
                _ if last => until.age.clone(),
                Some(next) => next.age.clone().nominal(),
                None => start.one(),
            };
            let (width, value) = (to.clone() - &start, line.value_at(&start));
            let value = match &fallen {
                Some(fallen) => value - fallen,
                None => value,
            };
            let late_end = if last { None } else { next.and_then(|next| next.age.deviation()) };
            let next_shift =
                late_end.clone().zip(next).map(|(late, next)| (next.line.value_at(&to) - line.value_at(&to), late));
            let slope = line.slope.clone();
            visit(Part { offset: offset.clone(), width: width.clone(), value, slope, shift, late_end });
            if last {
                return;
            }
            (offset, shift) = (offset + width, next_shift);
            if next.is_some() {
                (k, start) = (k + 1, to);
            } else {
                (index, k, start) = (index + 1, 0, to.zero());
                if index == self.end {
                    return;
                }
                (pieces, fallen) = (self.slice(index), self.fallen(index));
            }
        }
    }
}
