//! Modified Bessel functions in numbers with a word to spare, in which their own roundings do not count: by their
//! series, and by the expansion at infinity.

use super::bessel::expansion;
use super::bits;
use super::ray::Ray;
use crate::number::{Analytic, Float, Rounded, Scalar, Wide};

/// A number in which these functions are computed.
pub(super) trait Spare: Rounded {
    /// Computes `₀F₁(; n+1; y) = Σ_m T_m`, `T_m = y^m/(m!(n+1)_m)`, for finite `y ≥ 0`, and its roundings.
    fn hypergeometric(y: &Self, n: u32) -> (Self, f64);

    /// Computes `eˣ` within `2³⁴` roundings.
    fn exponential(&self) -> Self;
}

impl<const M: usize> Spare for Wide<M> {
    /// All terms are positive. The m-th has two roundings more than the one before, and a sum of m terms has m: fewer
    /// than `3m`. The terms fall by half at least where the sum ends, so that the rest is less than a rounding.
    fn hypergeometric(y: &Self, n: u32) -> (Self, f64) {
        let (mut term, mut sum, mut m) = (y.one(), y.one(), 0);
        loop {
            m += 1;
            let next = term * y / y.int(m * (m + i64::from(n)));
            sum = sum + next;
            let falls = next + next < term || next.is_zero();
            term = next;
            if falls && term <= sum * y.roundoff() {
                return (sum, 3.0 * m as f64 + 2.0);
            }
        }
    }

    fn exponential(&self) -> Self {
        self.raw_exp()
    }
}

impl Spare for Float {
    /// Sums the series so that later terms have fewer bits.
    ///
    /// For p bits, `T_m ≤ (e²y/m²)^m`, so at most `N = q + 2 + 4√y` terms matter to `2^{−q}`; `q = p + 2 log₂ N + 4`.
    /// Term m has the bits that keep its four roundings (of y, the product, the quotient and the bits) to
    /// `2^{1−q} S_m/T_m` of itself, for the sum `S_m` so far, and all later terms inherit them:
    /// `4·2^{1−q} S_m Σ_{k≥m} T_k/T_m`. The ratios of terms decrease, so `T_i T_k ≤ T_m T_{i+k−m}` for `i ≤ m ≤ k`, and
    /// that is at most `4·2^{1−q} (m + 1)` of the whole. The sum over m is below `5N² 2^{−q}`, with the roundings of the
    /// sum and the rest: half a rounding.
    fn hypergeometric(y: &Self, n: u32) -> (Self, f64) {
        let size = y.to_f64();
        let most = f64::from(y.prec()) + 100.0 + 4.0 * size.sqrt();
        let bits = y.prec() + (2.0 * most.log2()).ceil() as u32 + 4;
        let (mut factor, mut m) = (y.clone(), 0i64);
        let (mut term, mut sum) = (Float::with_val(bits, 1), Float::with_val(bits, 1));
        loop {
            m += 1;
            term *= &factor;
            term /= m * (m + i64::from(n));
            sum += &term;
            let (Some(top), Some(of_sum)) = (term.get_exp(), sum.get_exp()) else { break };
            let left = bits as i32 + top - of_sum;
            if left < 0 && 2.0 * size <= (m * m) as f64 {
                break;
            }
            // Whole words.
            let left = (left.max(64) as u32).next_multiple_of(64);
            if left < term.prec() {
                term.set_prec(left);
                factor = Float::with_val(left, y);
            }
        }
        (sum, 1.0)
    }

    /// Computes the exponential, but no number where it would vanish.
    fn exponential(&self) -> Self {
        if *self < -1e15 { self.double(f64::NAN) } else { Analytic::exp(self) }
    }
}

/// Returns the argument up to which the series serves; the expansion at infinity serves those beyond it.
pub(super) fn far<S: Scalar>(like: &S) -> f64 {
    bits(like) + 64.0
}

/// Roundings of the expansion, which has fewer than four in term k, and `2p + 128` terms that are below 1/8 together.
fn expansion_roundings<S: Scalar>(like: &S) -> f64 {
    8.0 * bits(like) + 512.0
}

/// Roundings of an exponential, of its argument and of the product with it.
const EXP: f64 = 68_719_476_736.0;

/// Computes `e^{−z} I_n(z)`, `I_n = (z/2)ⁿ/n! ₀F₁(; n+1; z²/4)`, and its roundings, for `z ≥ 0`. The exponential has
/// `2³⁴`, y, rounded once, passes on at most z of them, and n factors add two each.
pub(super) fn in_scaled<S: Spare>(z: &S, n: u32) -> (S, f64) {
    if n <= 1 && z.to_f64() > far(z) {
        return (expansion(z, i64::from(n)), expansion_roundings(z));
    }
    let half = z.clone() / z.int(2);
    let (value, roundings) = S::hypergeometric(&half.square(), n);
    let value = (1..=i64::from(n)).fold(value, |product, k| product * &half / z.int(k));
    (value * (-z.clone()).exponential(), roundings + 2.0 * f64::from(n) + z.to_f64() + EXP)
}

/// Computes `e^{−rt} ψ₀` and its roundings, for `ξ ≥ 0`.
///
/// The series serves small `z = r√(ξη)`. Beyond its reach the result is `e^{−λ} · e^{−z} I₀(z)` with
/// `λ = r(t − √(ξη)) = (r/2)(η − ξ)²/(η + ξ + 2√(ξη))`. `y = (r/2)² ξη` has three roundings, and passes on at most `z/2`
/// times as many; the expansion passes on fewer than it has. Either exponent has at most ten roundings of itself;
/// beyond `2³¹` there is nothing left of the value.
pub(super) fn start<S: Spare>(ray: &Ray<S>) -> (S, f64) {
    let (half, product) = (ray.half(), ray.xi.clone() * &ray.eta);
    let y = half.square() * &product;
    let Some(root) = product.try_sqrt().filter(|_| y.is_finite() && !y.is_negative()) else {
        return (y.double(f64::NAN), f64::INFINITY);
    };
    let (z, sum) = (2.0 * y.to_f64().sqrt(), ray.eta.clone() + &ray.xi);
    if z <= far(&y) {
        let (value, roundings) = S::hypergeometric(&y, 0);
        return (value * (-(half * &sum)).exponential(), roundings + 2.0 * z + EXP);
    }
    let lag = half * &(ray.eta.clone() - &ray.xi).square() / (sum + &root + &root);
    let value = expansion(&(ray.damping.clone() * &root), 0) * (-lag).exponential();
    (value, 2.0 * expansion_roundings(&y) + EXP)
}

/// Returns the ray in longer numbers, with ξ ≥ 0: a ray that arrives now may do so a rounding later.
pub(super) fn arrived<S: Rounded, L: Rounded>(ray: &Ray<S>, longer: impl Fn(&S) -> L) -> Ray<L> {
    let ray = ray.map(longer);
    let xi = if ray.xi.is_negative() { ray.xi.zero() } else { ray.xi };
    Ray { xi, ..ray }
}
