//! Gauss–Legendre nodes and weights between proved bounds.

use std::any::Any;
use std::cmp::Ordering;

use rug::Float;

use super::gauss::{gauss_legendre, legendre};
use crate::number::{Analytic, Interval, Scalar};

/// The rule for a system of intervals; `None` for all others.
pub(super) fn rule<S: Analytic>(like: &S, n: usize) -> Option<Vec<(S, S)>> {
    let like = (like as &dyn Any).downcast_ref::<Interval>()?;
    let rule: Box<dyn Any> = Box::new(enclosures(like, n));
    rule.downcast().ok().map(|rule| *rule)
}

/// Each node between two numbers at which `P_n` has different signs. As these brackets are disjoint and as many as `P_n` has
/// roots, each holds exactly one; the weight `2/((1−x²) P_n′(x)²)` is evaluated on the whole bracket.
///
/// The recurrence for `P_n` in intervals grows by less than `2|x| + 1` with each step, by `3ⁿ` together: as many bits more are
/// carried, once for the signs and once for the width of the bracket. Where a bracket cannot be shown, node and weight are everything, and so is every integral by this rule.
fn enclosures(like: &Interval, n: usize) -> Vec<(Interval, Interval)> {
    let bits = like.lo().prec();
    let grown = (1.6 * n as f64) as u32 + 16;
    let work = bits + 2 * grown + 32;
    let near = gauss_legendre(&Float::with_val(work, 1), n);
    let delta = Float::with_val(work, 1) >> (bits + grown);
    let mut rule: Vec<(Interval, Interval)> = Vec::with_capacity(n);
    let mut proved = true;
    for (x, _) in near {
        let (lo, hi) = (Float::with_val(work, &x - &delta), Float::with_val(work, &x + &delta));
        let sign = |x: &Float| legendre(&Interval::between(x.clone(), x.clone()), n).0.sign();
        let signs = (sign(&lo), sign(&hi));
        let apart = rule.last().is_none_or(|(before, _)| *before.hi() < lo);
        proved &= apart
            && matches!(
                signs,
                (Some(Ordering::Less), Some(Ordering::Greater)) | (Some(Ordering::Greater), Some(Ordering::Less))
            );
        let node = Interval::between(lo, hi);
        let (_, slope) = legendre(&node, n);
        let one = node.one();
        let weight = one.int(2) / ((one.clone() - &node) * &(one + &node) * &slope.square());
        rule.push((node, weight));
    }
    let everything = like.zero().widened(&like.double(f64::INFINITY));
    let rounded = |x: Interval| if proved { like.zero() + &x } else { everything.clone() };
    rule.into_iter().map(|(x, w)| (rounded(x), rounded(w))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::IntervalPrecision;
    use rug::Rational;

    #[test]
    fn moments_are_enclosed() {
        for n in [1usize, 2, 7, 40, 151] {
            let one = Interval::rational(&Rational::from(1), IntervalPrecision::bits(200));
            let rule = gauss_legendre(&one, n);
            for power in [0, n - 1 + (n - 1) % 2, 2 * n - 2].into_iter().filter(|power| *power <= 2 * n - 2) {
                let sum = rule
                    .iter()
                    .fold(one.zero(), |sum, (x, w)| sum + (0..power).fold(w.clone(), |product, _| product * x));
                let exact = Rational::from((2, power as u32 + 1));
                assert!(sum.contains(&exact), "{n} {power} {}", sum.text());
                assert!(sum.radius() < 1e-50, "{n} {power} {}", sum.radius());
            }
        }
    }
}
