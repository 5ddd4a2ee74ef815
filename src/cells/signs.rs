//! Signs of a series on parts of its interval, proved by its coefficients: `|c₀| > Σ_{k≥1}|c_k|`, on halves where the
//! whole part is undecided.

use super::series::{Basis, bound};
use crate::number::Rounded;

/// Maximum number of parts of a strip tested before a sign is left open.
const MOST_PARTS: usize = 400;
/// Maximum number of halvings of a strip in the search for a stretch around an event.
const MOST_HALVINGS: i32 = 300;

/// Bounds the values of a series from below and above, if its coefficients carry rounding errors relative to `size`.
pub(super) fn range<T: Rounded>(c: &[T], size: f64) -> (f64, f64) {
    let (middle, spread) = (c[0].to_f64(), bound(c, 1));
    let terms = c.len() as f64;
    let rounding = 1e-12 * (middle.abs() + spread) + 320.0 * terms.powi(3) * c[0].unit() * size;
    (middle - spread - rounding, middle + spread + rounding)
}

/// A series restricted to parts of its interval. The ends of a part are numbers `S` of the run, since an event may be
/// closer to the end of a strip than doubles resolve. A series in doubles rounds them, which changes its values by
/// `2N²u` of its size: less than [`range`] counts.
pub(super) struct Part<'a, S, T> {
    basis: &'a Basis<T>,
    whole: &'a [T],
    size: f64,
    place: fn(&S) -> T,
}

impl<'a, S: Rounded> Part<'a, S, S> {
    pub(super) fn of(basis: &'a Basis<S>, whole: &'a [S]) -> Self {
        Part { basis, whole, size: bound(whole, 0), place: S::clone }
    }
}

impl<'a, S: Rounded> Part<'a, S, f64> {
    pub(super) fn in_doubles(basis: &'a Basis<f64>, whole: &'a [f64]) -> Self {
        Part { basis, whole, size: bound(whole, 0), place: S::to_f64 }
    }
}

impl<S: Rounded, T: Rounded> Part<'_, S, T> {
    pub(super) fn range(&self, from: &S, to: &S) -> (f64, f64) {
        if from.is_zero() && *to == to.one() {
            return range(self.whole, self.size);
        }
        let part = self.basis.restrict(self.whole, &(self.place)(from), &(self.place)(to), self.basis.size());
        range(&part, self.size)
    }

    /// Returns whether the series is proved to be below `−off` on a part.
    pub(super) fn below(&self, part: (S, S), off: f64) -> bool {
        // Halving is of no use once some part is proved not to be below.
        let mut not = false;
        settle(part, |from, to| {
            let (low, high) = self.range(from, to);
            not = not || low > -off;
            not || high < -off
        }) && !not
    }

    /// Finds a stretch `x ± δ` on which `sign` times the series is positive; returns δ and its extreme values there.
    pub(super) fn steep(&self, x: &S, sign: f64) -> Option<(f64, f64, f64)> {
        (1..MOST_HALVINGS).find_map(|k| {
            let delta = (-f64::from(k)).exp2();
            let (from, to) = (x.clone() - x.double(delta), x.clone() + x.double(delta));
            if from.is_negative() || to > to.one() {
                return None;
            }
            let (low, high) = self.range(&from, &to);
            let (least, most) = if sign > 0.0 { (low, high) } else { (-high, -low) };
            (least > 0.0).then_some((delta, least, most))
        })
    }
}

/// Tests parts in order of time until each is settled; halves those that are not.
fn settle<S: Rounded>((from, to): (S, S), mut settled: impl FnMut(&S, &S) -> bool) -> bool {
    let half = from.ratio(1, 2);
    let mut parts = vec![(from, to)];
    let mut count = 0;
    while let Some((from, to)) = parts.pop() {
        if settled(&from, &to) {
            continue;
        }
        count += 1;
        let middle = (from.clone() + &to) * &half;
        if count > MOST_PARTS || middle <= from || middle >= to {
            return false;
        }
        parts.extend([(middle.clone(), to), (from, middle)]);
    }
    true
}

/// Returns whether the end is proved not to touch the ground on a part: it is clear of it, or has only risen so far.
pub(super) fn clear<S: Rounded, T: Rounded>(
    (height, trace): (&Part<'_, S, T>, &Part<'_, S, T>),
    part: (S, S),
    (high, fast): (f64, f64),
    rising: &mut bool,
) -> bool {
    let (mut rises, mut not) = (*rising, false);
    let shown = settle(part, |from, to| {
        let (low, most) = height.range(from, to);
        if low > high {
            rises = false;
            return true;
        }
        not = not || most < -high;
        not || rises && trace.range(from, to).0 > fast
    }) && !not;
    *rising = rises;
    shown
}

pub(super) fn doubles<S: Rounded>(c: &[S]) -> Vec<f64> {
    c.iter().map(S::to_f64).collect()
}
