//! The first time at which a smooth function turns negative, with earlier times excluded.

use super::series::{Basis, at_one, at_zero, bound, derivative, evaluate, spread};
use crate::number::Rounded;

/// Intervals shorter than this part of a segment are not cut any further.
const SMALLEST: f64 = 1e-300;

/// The first `x` in `0 … 1` where the series turns negative, given that it is not negative at 0; `None` if it does not.
///
/// The interval is halved until a part is settled: `|c₀| > Σ_{k≥1}|c_k|` fixes the sign on a part, the same for the
/// derivative makes the function monotone there, and then its end decides. Parts are settled from left to right, so
/// what is found is the first. A part on which `Σ|c_k| ≤ noise` says nothing and is passed over: if the function does
/// turn negative in it, the next part is negative from its left end on, and that is the answer; the second value says
/// so, and also where a descent begins within the noise: the root is then where the function is within the noise, not
/// where it vanishes.
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
            // Rising from a value that is not negative, as far as can be told.
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
            // An end within the noise is left to the next part, and at the end of all to whoever goes on there.
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

/// The root of a decreasing series that is not negative at 0 and negative at 1: Newton's method inside of a bracket.
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

/// The smallest value on `0 … 1`. **Accuracy**: within `16u Σ|c_k|`: parts are halved until they are monotone, bend one
/// way, can't fall below what was found by more than that, or are shorter than `√u`, where the ends are within a few
/// `u` of the least value. Where a part bends upwards its least value is where the slope vanishes, or at an end.
pub(super) fn smallest<S: Rounded>(basis: &Basis<S>, c: &[S]) -> Option<S> {
    let zero = c.first()?.zero();
    let unit = zero.log2_roundoff();
    let roundoff = 16.0 * unit.exp2() * bound(c, 0);
    let mut least = at_zero(c, &zero);
    let mut parts = vec![(0.0, c.to_vec())];
    while let Some((log2_width, c)) = parts.pop() {
        for value in [at_zero(&c, &zero), at_one(&c, &zero)] {
            if value < least {
                least = value;
            }
        }
        let slope = derivative(&c);
        // What the part can still fall below the least value found.
        let above = bound(&c, 1) - (c[0].clone() - &least).to_f64() <= roundoff;
        if above || slope[0].to_f64().abs() >= bound(&slope, 1) || log2_width < unit / 2.0 {
            continue;
        }
        let bend = derivative(&slope);
        if bend[0].to_f64().abs() >= bound(&bend, 1) {
            let [fall, curve] = [&slope, &bend].map(|c| c.iter().map(|c| -c.clone()).collect::<Vec<_>>());
            if !bend[0].is_negative() && !at_zero(&fall, &zero).is_negative() && at_one(&fall, &zero).is_negative() {
                let value = evaluate(&c, &descend(&fall, &curve));
                if value < least {
                    least = value;
                }
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
