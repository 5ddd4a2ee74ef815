//! Signals that are linear between breaks, and waves with their integral.

use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::sync::Arc;

use super::curve::{Curve, Signal};
use super::exact::Exact;
use super::interface::Moment;
use super::onset::Taylor;
use crate::lattice::{Line, place_to};
use crate::motion::Side;
use crate::number::{Bounded, Open, is_exact_zero};

/// A stretch of a wave without a break.
#[derive(Clone, Debug)]
pub(super) struct Piece<N> {
    /// Its beginning.
    pub(super) from: N,
    /// Its value over time.
    pub(super) signal: Signal<N>,
    /// Integral of the wave up to the stored beginning.
    pub(super) sum: N,
    /// Exact form of the beginning, if it is known. In chains with springs, dashpots or masses.
    pub(super) exact: Exact,
    /// The Taylor series at the beginning, if the signal is known to be exactly zero there.
    pub(super) taylor: Option<Arc<Taylor<N>>>,
}

impl<N> Piece<N> {
    /// Returns the beginning and the signal.
    fn begun(&self) -> (&N, &Signal<N>) {
        (&self.from, &self.signal)
    }
}

/// The wave that leaves one end of a body, from one travel time before the start.
#[derive(Clone, Debug)]
pub(super) struct Wave<N> {
    pub(super) pieces: Vec<Piece<N>>,
    /// Number of pieces before the start.
    pub(super) given: usize,
}

/// Returns whether `new` needs no break after `old`: it is proved equal, or is stored alike with no larger error.
fn continues<N: Bounded>(old: &N, new: &N) -> bool {
    match new.compare(old) {
        Ok(order) if old.roundoffs() == 0.0 && new.roundoffs() == 0.0 => order.is_eq(),
        _ => new.alike(old) && new.roundoffs() <= old.roundoffs(),
    }
}

/// Returns the product with a number that may be zero without any error, which costs no rounding.
fn times<N: Bounded>(x: &N, by: &N) -> N {
    if is_exact_zero(x) { x.clone() } else { x.clone() * by }
}

impl<N: Bounded> Line<N> {
    /// Returns the line that arrives after the time `delay`.
    pub(super) fn delayed(&self, delay: &N) -> Self {
        if is_exact_zero(&self.slope) {
            return self.clone();
        }
        Line { intercept: self.intercept.clone() - self.slope.clone() * delay, slope: self.slope.clone() }
    }

    pub(super) fn scaled(&self, by: &N) -> Self {
        Line { intercept: times(&self.intercept, by), slope: times(&self.slope, by) }
    }

    pub(super) fn plus(self, other: &Self) -> Self {
        let sum = |a: N, b: &N| if is_exact_zero(b) { a } else { a + b };
        Line { intercept: sum(self.intercept, &other.intercept), slope: sum(self.slope, &other.slope) }
    }

    pub(super) fn minus(self, other: &Self) -> Self {
        let difference = |a: N, b: &N| if is_exact_zero(b) { a } else { a - b };
        Line { intercept: difference(self.intercept, &other.intercept), slope: difference(self.slope, &other.slope) }
    }

    /// Returns the integral between the stored values of two times.
    pub(super) fn integral(&self, from: &N, to: &N) -> N {
        let width = to.clone().minus_stored(from);
        if is_exact_zero(&self.slope) {
            return width * &self.intercept;
        }
        let middle = (from.clone().nominal() + to.clone().nominal()).halved();
        self.value_at(&middle) * width
    }
}

impl<N: Bounded> Wave<N> {
    /// Returns where lines begin and curves jump, with the jumps: curves are continued by others without one.
    pub(super) fn rays(&self) -> impl Iterator<Item = (&N, N)> {
        let ray = |pair: &'_ [Piece<N>]| {
            let from = &pair[1].from;
            pair[1].signal.value_at(from) - pair[0].signal.value_at(from)
        };
        let rays = self.pieces.windows(2).map(move |pair| (&pair[1], ray(pair)));
        let is_ray = |(piece, jump): &(&Piece<N>, N)| {
            matches!(piece.signal, Signal::Line(_)) || jump.positive() == Ok(true) || jump.negative() == Ok(true)
        };
        rays.filter(is_ray).map(|(piece, jump)| (&piece.from, jump))
    }

    /// Continues the wave with `line` from `time` on. `off` is zero within the error of the integral that the uncertain
    /// place of the break causes.
    pub(super) fn push(&mut self, time: &N, line: Line<N>, off: N) {
        let last = self.pieces.len() - 1;
        let last = &mut self.pieces[last];
        if let Signal::Line(own) = &last.signal
            && continues(&own.intercept, &line.intercept)
            && continues(&own.slope, &line.slope)
        {
            last.sum = last.sum.clone() + off;
            return;
        }
        let sum = (last.signal.integral(&last.from, time) + &last.sum + off).without_exact();
        self.pieces.push(Piece { from: time.clone(), signal: Signal::Line(line), sum, exact: None, taylor: None });
    }

    /// Continues the wave with `curve` from a time on, where it may leave zero with a known Taylor series.
    pub(super) fn push_curve(
        &mut self,
        Moment { time, late, exact, .. }: &Moment<N>,
        curve: Curve<N>,
        taylor: Option<Arc<Taylor<N>>>,
    ) {
        let last = &self.pieces[self.pieces.len() - 1];
        let is_same = |old: &N| is_exact_zero(&(old.clone() - &curve.terms[0]));
        if curve.terms.len() == 1 && is_exact_zero(&curve.error) {
            let continued = match &last.signal {
                Signal::Line(line) => {
                    is_exact_zero(&line.slope) && line.intercept.roundoffs() == 0.0 && is_same(&line.intercept)
                }
                Signal::Curve(old) => old.terms.len() == 1 && is_exact_zero(&old.error) && is_same(&old.terms[0]),
            };
            if continued {
                return;
            }
        }
        let begun = match &last.signal {
            Signal::Line(_) => &last.from,
            Signal::Curve(old) => &old.origin,
        };
        let mut sum = last.signal.integral(begun, &curve.origin) + &last.sum;
        if !is_exact_zero(late) {
            let jump = last.signal.value_at(&curve.origin) - &curve.terms[0];
            sum = sum.widened(&(jump.magnitude().widened(&curve.error) * late));
        }
        self.pieces.push(Piece {
            from: time.clone(),
            signal: Signal::Curve(Box::new(curve)),
            sum: sum.without_exact(),
            exact: exact.clone(),
            taylor,
        });
    }

    /// Returns whether the wave has left a node of a chain with springs, dashpots or masses.
    pub(super) fn is_curved(&self) -> bool {
        self.pieces.iter().any(|piece| matches!(piece.signal, Signal::Curve(_)))
    }

    /// Returns the index of the piece at a time, as the limit from `side`.
    pub(super) fn piece_at(&self, time: &N, side: Side) -> Result<usize, Open> {
        index_at(&self.pieces, |piece| &piece.from, time, side)
    }

    /// Returns the indices of the pieces that a time may lie in, as the limit from `side`.
    pub(super) fn pieces_at(&self, time: &N, side: Side) -> RangeInclusive<usize> {
        indices_at(&self.pieces, |piece| &piece.from, time, Limit::at(side))
    }

    /// Returns value and integral of the wave at a time, as the limit from `side`.
    ///
    /// **Errors**: [`Open`] if the error of a jump leaves undecided on which side of it the time is.
    pub(super) fn at(&self, time: &N, side: Side) -> Result<(N, N), Open> {
        let near = self.pieces_at(time, side);
        let pieces = &self.pieces[near.clone()];
        Ok((smooth_value(pieces.iter().map(Piece::begun), time)?, self.sum_within(near, time)))
    }

    /// Returns value and integral of the wave at a time, as [`Wave::at`] does: a value that covers both limits where it
    /// is undecided on which side of a jump the time is.
    pub(super) fn within(&self, time: &N, limit: Limit) -> (N, N) {
        let near = indices_at(&self.pieces, |piece| &piece.from, time, limit);
        let values = self.pieces[near.clone()].iter().map(|piece| piece.signal.value_at(time));
        (either(values).unwrap_or_else(|| time.zero()), self.sum_within(near, time))
    }

    /// Returns whether the wave, or its slope, may have two limits at a time.
    pub(super) fn may_jump(&self, time: &N) -> Result<bool, Open> {
        may_jump(&self.pieces, Piece::begun, time)
    }

    /// Returns the integral of the wave up to a time that lies in one of the pieces with these indices.
    pub(super) fn sum_within(&self, near: RangeInclusive<usize>, time: &N) -> N {
        either(near.map(|k| self.sum_at(k, time))).unwrap_or_else(|| time.zero())
    }

    /// Returns the value of the wave at a time, as the limit from `side`. Breaks that agree with the time within their
    /// bounds are at the time.
    pub(super) fn value_beside(&self, time: &N, side: Side) -> N {
        let piece = last_begun(&self.pieces, |piece| &piece.from, (time, side), side == Side::Right);
        self.pieces[piece].signal.value_at(time)
    }

    /// Returns the integral of the wave up to a time in the piece with this index.
    pub(super) fn sum_at(&self, piece: usize, time: &N) -> N {
        let Piece { from, signal, sum, .. } = &self.pieces[piece];
        match signal {
            Signal::Line(line) => {
                let width = time.clone() - from.clone().nominal();
                let middle = (from.clone().nominal() + time).halved();
                line.value_at(&middle) * width + sum
            }
            Signal::Curve(curve) => {
                let (stored, late) = time.centred();
                let off = (curve.value_at(time).magnitude() + curve.value_at(&stored).magnitude()) * late;
                (curve.integral(&curve.origin, &stored) + sum).widened(&off)
            }
        }
    }
}

/// Roundoff, as `log₂`, above which numbers are doubles: spelled times are not much longer than their roundings.
const DOUBLE_ROUNDOFF: f64 = -60.0;

/// Compares a time with that of a break, or a point with that of a ray. In longer numbers a time within some roundings
/// of a break is at the break, since times of more digits are asked of still longer numbers.
///
/// **Errors**: [`Open`] if the error of the break leaves the order undecided, or in doubles that of either.
pub(super) fn order<N: Bounded>(time: &N, from: &N) -> Result<Ordering, Open> {
    if time.log2_roundoff() < DOUBLE_ROUNDOFF {
        return place_to(time, from);
    }
    match time.compare(from)? {
        Ordering::Equal if time.roundoffs() + from.roundoffs() > 0.0 => Err(Open),
        order => Ok(order),
    }
}

/// Returns the number of pieces that left the nodes after the start.
pub(super) fn left<N>(waves: &[[Wave<N>; 2]]) -> usize {
    waves.iter().flatten().map(|wave| wave.pieces.len() - wave.given).sum()
}

/// The limit of a value at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    /// The side of a jump at the time.
    pub(super) side: Side,
    /// Whether the time is that of an event.
    pub(super) is_event: bool,
}

impl Limit {
    /// Returns the limit from `side` at a time that is asked for.
    pub(super) fn at(side: Side) -> Self {
        Limit { side, is_event: false }
    }
}

/// Greatest distance of a break that counts as at an event, as `log₂` of its share of the time.
const AT_EVENT: f64 = -64.0;

/// Returns the index of the last item that has begun at a time, as the limit from a side. `undecided` is the answer
/// where the errors of a beginning leave it open. Each item lasts until the next begins, and the first has begun.
fn last_begun<T, N: Bounded>(items: &[T], from: impl Fn(&T) -> &N, (time, side): (&N, Side), undecided: bool) -> usize {
    let begun = items.partition_point(|item| match order(time, from(item)) {
        Ok(order) if side == Side::Left => order.is_gt(),
        Ok(order) => order.is_ge(),
        Err(Open) => undecided,
    });
    begun.max(1) - 1
}

/// Returns the indices of the items that a time may lie in: several where the errors of beginnings leave it undecided.
/// A beginning within `2^AT_EVENT` of the time of an event, as none is in doubles, is at the event.
pub(super) fn indices_at<T, N: Bounded>(
    items: &[T],
    from: impl Fn(&T) -> &N + Copy,
    time: &N,
    Limit { side, is_event }: Limit,
) -> RangeInclusive<usize> {
    let [first, last] = [false, true].map(|undecided| last_begun(items, from, (time, side), undecided));
    let is_at = |item: &T| {
        let apart = (time.clone() - from(item)).magnitude();
        (apart.to_f64() + apart.log2_error().exp2()).log2() <= AT_EVENT + time.to_f64().log2()
    };
    if is_event && first < last && items[first + 1..=last].iter().all(is_at) {
        let at = if side == Side::Left { first } else { last };
        return at..=at;
    }
    first..=last
}

/// Returns the index of the item that a time lies in, as the limit from `side`.
///
/// **Errors**: [`Open`] if the error of a beginning leaves it undecided.
pub(super) fn index_at<T, N: Bounded>(
    items: &[T],
    from: impl Fn(&T) -> &N + Copy,
    time: &N,
    side: Side,
) -> Result<usize, Open> {
    let near = indices_at(items, from, time, Limit::at(side));
    if near.start() == near.end() { Ok(*near.start()) } else { Err(Open) }
}

/// Returns a number that is one of `values`: their middle, widened to all of them; `None` if there are none.
pub(super) fn either<N: Bounded>(mut values: impl Iterator<Item = N>) -> Option<N> {
    let first = values.next()?;
    Some(values.fold(first, |all, value| {
        let off = (value.clone() - &all).magnitude();
        if is_exact_zero(&off) { all } else { (all + value).halved().widened(&off.halved()) }
    }))
}

/// Returns the value at a time that may lie in each of these signals, which follow each other and come with their
/// beginnings.
///
/// **Errors**: [`Open`] if a signal jumps where the next begins, and the time may lie on either side.
pub(super) fn smooth_value<'a, N: Bounded + 'a>(
    signals: impl Iterator<Item = (&'a N, &'a Signal<N>)> + Clone,
    time: &N,
) -> Result<N, Open> {
    // Signals that continue each other at the true beginning differ at the stored one, by their slopes.
    for ((_, before), (from, after)) in signals.clone().zip(signals.clone().skip(1)) {
        if before.value_at(from).compare(&after.value_at(from)).is_ok_and(Ordering::is_ne) {
            return Err(Open);
        }
    }
    either(signals.map(|(_, signal)| signal.value_at(time))).ok_or(Open)
}

/// Returns whether the signal of `items`, each of which comes with its beginning, may have two limits at a time:
/// whether it jumps there, or a new line begins.
///
/// **Errors**: [`Open`] if the error of a jump leaves undecided whether it is at the time.
pub(super) fn may_jump<T, N: Bounded>(
    items: &[T],
    part: impl for<'a> Fn(&'a T) -> (&'a N, &'a Signal<N>),
    time: &N,
) -> Result<bool, Open> {
    let [before, after] =
        [Side::Left, Side::Right].map(|side| indices_at(items, |item| part(item).0, time, Limit::at(side)));
    let near = &items[*before.start()..=*after.end()];
    if near.len() == 1 {
        return Ok(false);
    }
    let parts = near.iter().map(&part);
    let is_smooth = smooth_value(parts.clone(), time).is_ok();
    if before.start() == before.end() && after.start() == after.end() {
        return Ok(!is_smooth || parts.clone().any(|(_, signal)| matches!(signal, Signal::Line(_))));
    }
    if is_smooth { Ok(false) } else { Err(Open) }
}
