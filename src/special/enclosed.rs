//! The same series for numbers that answer for their own error: where a sum is cut, its rest is added as a width.
//!
//! Nothing here compares one number with another: how many terms are taken is decided on doubles that bound them, and
//! any choice would give an enclosure.

use super::bits;
use crate::number::Analytic;

/// No sum has more terms than this.
const MOST_TERMS: i64 = 4_000_000;

/// `Σ_m yᵐ n!/(m!(m+n)!)`, the function ₀F₁(; n+1; y).
///
/// **Accuracy**: *enclosure*. The ratio of terms, `|y|/(m(m+n))`, falls with m: once it is below 1/2, all terms from m on are
/// less than the one before them.
pub(crate) fn confluent<S: Analytic>(y: &S, n: i64) -> S {
    let size = y.to_f64().abs();
    let goal = -(bits(y) + 4.0);
    let (mut term, mut sum, mut log) = (y.one(), y.one(), 0.0f64);
    for m in 1..=MOST_TERMS {
        let divisor = m * (m + n);
        let step = size / divisor as f64;
        log += step.log2();
        term = term * y / y.int(divisor);
        if step < 0.499 && log < goal {
            return sum.widened(&(term * &y.int(2)));
        }
        sum = sum + &term;
    }
    sum.widened(&y.double(f64::INFINITY))
}

/// `e^{−z} I_n(z) = e^{−z} (z/2)ⁿ/n! ₀F₁(; n+1; z²/4)`. **Accuracy**: *enclosure*.
pub(super) fn bessel_scaled<S: Analytic>(z: &S, n: i64) -> S {
    let half = z.clone() / z.int(2);
    let head = (1..=n).fold((-z.clone()).exp(), |head, k| head * &half / z.int(k));
    head * &confluent(&half.square(), n)
}

/// `e^{−rt} ψ₀ = e^{−rt} ₀F₁(; 1; r²ξη/4)`, with `r/2` given. **Accuracy**: *enclosure*, without a root of ξ, which would
/// cost half of its digits where the ray has just arrived.
pub(super) fn ray_start<S: Analytic>(half: &S, xi: &S, eta: &S) -> S {
    let fade = (-(half.clone() * &(xi.clone() + eta))).exp();
    fade * &confluent(&(half.square() * xi * eta), 0)
}

/// Where the sums over one ray are cut.
pub(super) struct Cut<S> {
    /// The last term N.
    pub(super) terms: i64,
    /// A bound of `σ_{N+1} ≥ 0`, `σ_n = (r/2) ψ_n/ψ_{n−1}`.
    pub(super) ratio: S,
    /// A bound of `Σ_{n>N} c_n σ_{N+2} ⋯ σ_n` for weights `0 ≤ c_n ≤ n³`.
    pub(super) rest: S,
}

/// Where to cut the sums over the ray `ξ`, `η`, damping `2 half`, that need the terms up to `first`.
///
/// `σ_n < rξ/(n−½+√((n−½)²+z²)) ≤ rξ/(2n−1)` with `z = r√(ξη)` (Amos 1974, Segura 2011), and both bounds fall with n. With
/// `γ = σ (1 + 1/n)³` at `n = N+1`, `Σ_{n>N} n³ σ_{N+2} ⋯ σ_n ≤ (N+1)³/(1−γ)`. The numbers here are known to some roundings of
/// doubles, against which γ ≤ 0.9 and the bound `16 (N+1)³` have room. What the rest weighs in the sum, a product of all σ, is
/// carried by the enclosures of these.
pub(super) fn cut<S: Analytic>(half: &S, xi: &S, eta: &S, first: i64) -> Cut<S> {
    let size = |x: &S| x.to_f64().abs();
    let reach = 2.0 * size(half) * size(xi) * (1.0 + 1e-12);
    let z = 2.0 * size(half) * (size(xi) * size(eta)).sqrt() * (1.0 + 1e-12);
    let goal = -(bits(xi) + 6.0);
    let (mut product, mut square, mut terms) = (0.0f64, 0.0f64, first);
    let mut bounded = false;
    while !bounded && terms < MOST_TERMS && z.is_finite() {
        terms += 1;
        let m = terms as f64;
        // The ratio of the next index is smaller: it is taken for that of N+1.
        let below = (m - 0.5) + ((m - 0.5) * (m - 0.5) + z * z).sqrt();
        product += (reach / below).log2();
        square += 2.0 * (z / below).log2();
        let growth = reach / below * (1.0 + 1.0 / m).powi(3);
        bounded = growth <= 0.9 && product + 3.0 * m.log2() < goal && square < goal;
    }
    let ratio = half.int(2) * half * &xi.clone().magnitude() / half.int(2 * terms + 1);
    let rest = if bounded { 16.0 * (terms as f64 + 1.0).powi(3) } else { f64::INFINITY };
    Cut { terms, ratio, rest: xi.double(rest) }
}

#[cfg(all(test, feature = "mp"))]
mod tests {
    use rug::{Float, Rational};

    use crate::number::{Interval, IntervalPrecision, Scalar};
    use crate::special::{Ray, i0_scaled, i1_scaled, in_scaled};

    /// From few bits, where every cut is coarse, to many; the truth has twice as many.
    #[test]
    fn sums_in_many_bits_lie_inside() {
        let fraction = |p: i64| Rational::from((p, 1000));
        let holds = |found: &Interval, truth: &Float, bits: u32| {
            let narrow = found.width().hi().to_f64() <= truth.to_f64().abs() * 2f64.powi(18 - bits as i32);
            assert!(found.lo() <= truth && truth <= found.hi(), "{} {truth}", found.text());
            narrow
        };
        for bits in [24u32, 53, 200, 700] {
            for z in [0, 1, 300, 3000, 77_777, 900_000] {
                let (few, many) = (
                    Interval::rational(&fraction(z), IntervalPrecision::bits(bits)),
                    Float::with_val(2 * bits + 300, fraction(z)),
                );
                assert!(holds(&i0_scaled(&few), &i0_scaled(&many), bits), "{z} {bits}");
                assert!(holds(&i1_scaled(&few), &i1_scaled(&many), bits), "{z} {bits}");
                assert!(holds(&in_scaled(&few, 5), &in_scaled(&many, 5), bits), "{z} {bits}");
                for (travel, time) in [(0, 700), (1000, 1000), (1000, 1001), (2300, 5000)] {
                    let few = Ray::new(
                        &few,
                        &Interval::rational(&fraction(travel), few.precision()),
                        &Interval::rational(&fraction(time), few.precision()),
                    );
                    let wide = 2 * bits + 300;
                    let many = Ray::new(
                        &many,
                        &Float::with_val(wide, fraction(travel)),
                        &Float::with_val(wide, fraction(time)),
                    );
                    let weights = |n: i64| [n, n * (n * n - 1)];
                    let (few, many) = (few.sums([1, 2], weights), many.sums([1, 2], weights));
                    for (few, many) in few.sums.iter().zip(&many.sums).chain([(&few.start, &many.start)]) {
                        assert!(
                            few.lo() <= many && many <= few.hi(),
                            "{z} {bits} {travel} {time} {} {many}",
                            few.text()
                        );
                    }
                }
            }
        }
    }
}
