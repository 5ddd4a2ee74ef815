//! The first time at which a smooth function turns negative, with earlier times excluded.

use super::series::{Basis, at_one, at_zero, bound, derivative, evaluate, smaller, spread};
use crate::number::Rounded;

/// Smallest part of a segment that is still halved.
const SMALLEST: f64 = 1e-300;

/// Finds the first `x` in `0 … 1` where a series turns negative, given that it is not negative at 0.
///
/// The interval is halved until each part is decided: `|c₀| > Σ_{k≥1}|c_k|` fixes the sign on a part; the same for the
/// derivative makes the function monotone there, so that its end decides. Parts are decided from left to right, so the
/// root found is the first. A part with `Σ|c_k| ≤ noise` is undecided and is skipped: if the function turns negative in
/// it, the next part is negative from its left end on, and that end is the result. The second value is true in this
/// case, and also where a descent begins within the noise: the function is then within the noise at the result, not
/// zero.
pub(super) fn first_descent<S: Rounded>(basis: &Basis<S>, c: &[S], noise: f64) -> Option<(S, bool)> {
    let first = c.first()?;
    let zero = first.zero();
    let width = first.one();
    let mut parts = vec![(zero.clone(), width, c.to_vec())];
    while let Some((from, width, c)) = parts.pop() {
        let centre = c[0].to_f64();
        let reach = spread(&c);
        if centre > reach || centre.abs() + reach <= noise {
            continue;
        }
        if centre < -reach {
            return Some((from, true));
        }
        let slope = derivative(&c);
        let (mean, variation) = (slope[0].to_f64(), spread(&slope));
        if mean > variation {
            // The function rises from a value that is not negative within the noise.
            if at_zero(&c, &zero).to_f64() < -noise {
                return Some((from, true));
            }
            continue;
        }
        if mean < -variation {
            let start = at_zero(&c, &zero);
            if start.is_negative() {
                return Some((from, true));
            }
            // An end within the noise is left to the next part, and at the end of the segment to the caller.
            if at_one(&c, &zero).to_f64() < -noise {
                let vague = start.to_f64() <= noise;
                return Some((from + width * descend(&c, &slope), vague));
            }
            continue;
        }
        if width.to_f64() < SMALLEST {
            continue;
        }
        let (half, one) = (width.ratio(1, 2), width.one());
        let width = width * &half;
        let size = c.len();
        parts.push((from.clone() + &width, width.clone(), basis.restrict(&c, &half, &one, size)));
        parts.push((from, width, basis.restrict(&c, &zero, &half, size)));
    }
    None
}

/// Computes the root of a decreasing series that is not negative at 0 and negative at 1, by bracketed Newton steps.
fn descend<S: Rounded>(c: &[S], slope: &[S]) -> S {
    let (mut low, mut high) = (c[0].zero(), c[0].one());
    let half = c[0].ratio(1, 2);
    let unit = c[0].log2_roundoff().exp2().max(f64::MIN_POSITIVE);
    let mut x = half.clone();
    for _ in 0..(60 - 2 * c[0].log2_roundoff() as i64).clamp(60, 20_000) {
        let value = evaluate(c, &x);
        if value.is_negative() {
            high = x.clone();
        } else {
            low = x.clone();
        }
        let newton = x.clone() - value / evaluate(slope, &x);
        let next = if newton > low && newton < high { newton } else { (low.clone() + &high) * &half };
        let step = (next.clone() - &x).to_f64().abs();
        x = next;
        if step <= 2.0 * unit || (high.clone() - &low).to_f64() <= 2.0 * unit {
            break;
        }
    }
    x
}

/// Computes the smallest value on `0 … 1`.
///
/// **Accuracy**: within `tolerance` and `16u Σ|c_k|`. Parts are halved until they are monotone, convex or concave,
/// cannot fall below the least value found by more than that, or are shorter than `√u`, where an end is within a few
/// `u` of the least value. A convex part has its least value at the root of its slope or at an end.
pub(super) fn smallest<S: Rounded>(basis: &Basis<S>, c: &[S], tolerance: f64) -> Option<S> {
    let zero = c.first()?.zero();
    let unit = zero.log2_roundoff();
    let allowed = tolerance + 16.0 * unit.exp2() * bound(c, 0);
    let mut least = at_zero(c, &zero);
    let mut parts = vec![(0.0, c.to_vec())];
    while let Some((log2_width, c)) = parts.pop() {
        for value in [at_zero(&c, &zero), at_one(&c, &zero)] {
            least = smaller(least, value);
        }
        let slope = derivative(&c);
        // Largest amount by which the part can fall below the least value found.
        let above = bound(&c, 1) - (c[0].clone() - &least).to_f64() <= allowed;
        if above || slope[0].to_f64().abs() >= bound(&slope, 1) || log2_width < unit / 2.0 {
            continue;
        }
        let bend = derivative(&slope);
        if bend[0].to_f64().abs() >= bound(&bend, 1) {
            let [fall, curve] = [&slope, &bend].map(|c| c.iter().map(|c| -c.clone()).collect::<Vec<_>>());
            if !bend[0].is_negative() && !at_zero(&fall, &zero).is_negative() && at_one(&fall, &zero).is_negative() {
                least = smaller(least, evaluate(&c, &descend(&fall, &curve)));
            }
            continue;
        }
        let (half, one) = (zero.ratio(1, 2), zero.one());
        parts.push((log2_width - 1.0, basis.restrict(&c, &half, &one, c.len())));
        parts.push((log2_width - 1.0, basis.restrict(&c, &zero, &half, c.len())));
    }
    Some(least)
}

#[cfg(test)]
#[path = "tests/root.rs"]
mod tests;
