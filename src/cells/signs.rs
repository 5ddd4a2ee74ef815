//! Signs of a series on parts of its interval, shown by its coefficients: `|c₀| > Σ_{k≥1}|c_k|`, on halves where the
//! whole does not tell.

use super::series::{Basis, bound};
use crate::number::Rounded;

/// Parts of a strip that are looked at before a question is left open.
const MOST_PARTS: usize = 400;

/// The least and the greatest that a series may be, whose coefficients are off by so much of `size`.
pub(super) fn range<T: Rounded>(c: &[T], size: f64) -> (f64, f64) {
    let (middle, spread) = (c[0].to_f64(), bound(c, 1));
    let terms = c.len() as f64;
    let rounding = 1e-12 * (middle.abs() + spread) + 320.0 * terms.powi(3) * c[0].unit() * size;
    (middle - spread - rounding, middle + spread + rounding)
}

/// A part of a series, and the size of the whole.
pub(super) struct Part<'a, T> {
    basis: &'a Basis<T>,
    whole: &'a [T],
    size: f64,
}

impl<'a, T: Rounded> Part<'a, T> {
    pub(super) fn of(basis: &'a Basis<T>, whole: &'a [T]) -> Self {
        Part { basis, whole, size: bound(whole, 0) }
    }

    pub(super) fn range(&self, from: f64, to: f64) -> (f64, f64) {
        if from == 0.0 && to == 1.0 {
            return range(self.whole, self.size);
        }
        let zero = self.whole[0].zero();
        let part = self.basis.restrict(self.whole, &zero.double(from), &zero.double(to), self.basis.size());
        range(&part, self.size)
    }
}

/// Goes over parts, the earlier first, until each is settled; those that are not are halved.
fn settle((from, to): (f64, f64), mut settled: impl FnMut(f64, f64) -> bool) -> bool {
    let mut parts = vec![(from, to)];
    let mut count = 0;
    while let Some((from, to)) = parts.pop() {
        if settled(from, to) {
            continue;
        }
        count += 1;
        let middle = 0.5 * (from + to);
        if count > MOST_PARTS || middle <= from || middle >= to {
            return false;
        }
        parts.extend([(middle, to), (from, middle)]);
    }
    true
}

/// Whether a series is below `−off` on a part.
pub(super) fn below<T: Rounded>(basis: &Basis<T>, c: &[T], part: (f64, f64), off: f64) -> bool {
    let c = Part::of(basis, c);
    // Where it surely is not, halves are of no use.
    let mut not = false;
    settle(part, |from, to| {
        let (low, high) = c.range(from, to);
        not = not || low > -off;
        not || high < -off
    }) && !not
}

/// Whether the end surely does not touch the ground on a part: it is clear of it, or still only rises.
pub(super) fn clear<T: Rounded>(
    basis: &Basis<T>,
    (height, trace): (&[T], &[T]),
    part: (f64, f64),
    (high, fast): (f64, f64),
    rising: &mut bool,
) -> bool {
    let (height, trace) = (Part::of(basis, height), Part::of(basis, trace));
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

/// A stretch `x ± δ` on which `sign · g` is positive: δ, and the least and the greatest of it there.
pub(super) fn steep<T: Rounded>(basis: &Basis<T>, g: &[T], x: f64, sign: f64) -> Option<(f64, f64, f64)> {
    let g = Part::of(basis, g);
    (1..160).find_map(|k| {
        let delta = (-f64::from(k)).exp2();
        let (from, to) = (x - delta, x + delta);
        if from < 0.0 || to > 1.0 {
            return None;
        }
        let (low, high) = g.range(from, to);
        let (least, most) = if sign > 0.0 { (low, high) } else { (-high, -low) };
        (least > 0.0).then_some((delta, least, most))
    })
}

pub(super) fn doubles<S: Rounded>(c: &[S]) -> Vec<f64> {
    c.iter().map(S::to_f64).collect()
}
