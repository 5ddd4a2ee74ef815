//! Bessel functions of long numbers with few long multiplications; the rest is arithmetic with machine words.

use super::bessel::expansion;
use crate::number::Float;
use crate::number::float::{Pow, down};
use crate::number::rational::{self, Integer};

/// Bits of precision beyond the requested ones.
const GUARD_BITS: u32 = 16;

/// A number with 16 spare bits, and its error in roundings of this longer precision.
pub(super) struct Spare {
    pub(super) long: Float,
    small: f64,
}

impl Spare {
    /// Rounds to p bits and returns the roundings: one for this step, plus the earlier error in units of `2^{−p−16}`.
    pub(super) fn rounded(&self, p: u32) -> (Float, f64) {
        if self.long.is_zero() {
            return (Float::new(p), 0.0);
        }
        (Float::with_val(p, &self.long), 1.0 + 1.01 * self.small / f64::from(1u32 << GUARD_BITS))
    }
}

/// Rounds to p bits and returns the roundings; infinitely many if there is no value.
pub(super) fn finish(value: Option<Spare>, p: u32) -> (Float, f64) {
    value.map_or_else(|| (Float::with_val(p, f64::NAN), f64::INFINITY), |value| value.rounded(p))
}

/// Computes `e^{−z} I_n(z)` for the exact number z ≥ 0, and a bound of the relative error in units of `2^{−p}`, where p
/// is the precision of z.
///
/// **Source**: `(z/2)ⁿ/n! ₀F₁(; n+1; z²/4)`; the expansion at infinity, for n = 0, 1, if it reaches the precision.
///
/// **Accuracy**: within the second value, which is less than 1.1. It is infinite for `z ≥ 2²⁴` with n ≥ 2, for z < 0,
/// and for z that is not finite.
pub(super) fn in_scaled_bounded(z: &Float, n: u32) -> (Float, f64) {
    let p = z.prec();
    if n <= 1 && z.is_finite() && *z > f64::from(p) + 64.0 {
        // Term k has 4k roundings, all terms after the first sum to less than 1/8, and the rest is below one rounding:
        // the total is less than 8p + 512, and 32 bits suffice for that.
        let long = expansion(&Float::with_val(p + 64, z), i64::from(n));
        return finish(Some(Spare { long, small: 0.25 }), p);
    }
    let half = z.clone() >> 1u32;
    let y = Float::with_val(2 * p, half.square_ref());
    finish(with_power(&half, &y, n, &-z.clone()), p)
}

/// Computes `(base)ⁿ/n! ₀F₁(; n+1; y) e^{exponent}` with 16 bits more than base, and its roundings there: one each for
/// the power, n!, the quotient, the exponential and two products.
fn with_power(base: &Float, y: &Float, n: u32, exponent: &Float) -> Option<Spare> {
    let bits = base.prec() + GUARD_BITS;
    let (mut value, error) = hypergeometric(y, n, bits)?;
    if n > 0 {
        value *= Float::with_val(bits, base.pow(n)) / Float::with_val(bits, Float::factorial(n));
    }
    value *= Float::with_val(bits, exponent.exp_ref());
    Some(Spare { long: value, small: error + 6.0 })
}

/// Computes `e^{−rt} ψ₀` for exact r/2, ξ, η; `None` if a number is not finite.
///
/// The series serves small `z = r√(ξη)`. Beyond its reach the result is `e^{−λ} · e^{−z} I₀(z)` with
/// `λ = r(t − √(ξη)) = (r/2)(η − ξ)²/(η + ξ + 2√(ξη))`. Each of the ten operations before the exponential adds a
/// rounding of λ or of z, and both functions amplify these by at most λ and one; the expansion has fewer than 8p + 512.
/// With `64 + log₂(1 + λ)` bits beyond p the total is far less than one unit of `2^{−p−16}`.
pub(super) fn damped_start(half: &Float, xi: &Float, eta: &Float) -> Option<Spare> {
    let p = xi.prec();
    let square = Float::with_val(2 * half.prec(), half.square_ref());
    let product = Float::with_val(xi.prec() + eta.prec(), xi * eta);
    let y = Float::with_val(square.prec() + product.prec(), &square * &product);
    let near = f64::from(p) + 64.0;
    if y.is_nan() || y.is_infinite() {
        return None;
    }
    if y.to_f64() > 0.25 * near * near {
        let lag = |bits: u32| {
            let root = Float::with_val(bits, product.sqrt_ref());
            let apart = Float::with_val(bits, eta - xi);
            let both = Float::with_val(bits, eta + xi) + (root.clone() << 1u32);
            let square = Float::with_val(bits, apart.square_ref());
            let lag = Float::with_val(bits, half * &square) / both;
            (root, lag)
        };
        let (_, size) = lag(64);
        let bits = p + 64 + size.get_exp().unwrap_or(0).clamp(0, 64) as u32;
        let (root, lag) = lag(bits);
        let z = Float::with_val(bits, half) * 2u32 * root;
        let value = expansion(&z, 0) * (-lag).exp();
        return Some(Spare { long: value, small: 1.0 });
    }
    // The sum is exact if both are of similar size; otherwise the error is far below a rounding of the exponential.
    let bits = p + GUARD_BITS + 64;
    let time = Float::with_val(bits, xi + eta);
    let damped = -Float::with_val(bits, half * &time);
    if damped.is_nan() || damped < -1e15 {
        return None;
    }
    let one = Float::with_val(p, 1);
    with_power(&one, &y, 0, &damped).map(|value| Spare { small: value.small + 1.0, ..value })
}

/// A number y ≥ 0 rounded down to `mantissa · 2^{−shift}`; short numbers stay short.
#[derive(Clone)]
struct Factor {
    mantissa: Integer,
    shift: u32,
}

impl Factor {
    /// Rounds y down to a multiple of `2^{−scale}`; `None` for infinity and NaN.
    fn of(y: &Float, scale: u32) -> Option<Self> {
        let (mut mantissa, exponent) = y.to_integer_exp()?;
        let zeros = rational::trailing_zeros(&mantissa);
        mantissa >>= zeros as usize;
        let exponent = i64::from(exponent) + i64::from(zeros);
        if exponent >= 0 {
            return Some(Factor { mantissa: mantissa << usize::try_from(exponent).ok()?, shift: 0 });
        }
        let mut factor = Factor { mantissa, shift: u32::try_from(-exponent).ok()? };
        factor.cut(scale);
        Some(factor)
    }

    fn cut(&mut self, scale: u32) {
        if self.shift > scale {
            self.mantissa >>= (self.shift - scale) as usize;
            self.shift = scale;
        }
    }

    /// Returns the product, rounded down.
    fn times(&self, other: &Factor, scale: u32) -> Self {
        let mantissa = self.mantissa.clone() * &other.mantissa;
        let mut result = Factor { mantissa, shift: self.shift + other.shift };
        result.cut(scale);
        result
    }

    /// Computes `yᵏ`, k ≥ 1.
    fn power(&self, k: u32, scale: u32) -> Self {
        let mut result = self.clone();
        for bit in (0..k.ilog2()).rev() {
            result = result.times(&result, scale);
            if k >> bit & 1 == 1 {
                result = result.times(self, scale);
            }
        }
        result
    }

    /// Replaces t by `⌊t y⌋` within two units; only the bits of the mantissa that matter enter.
    fn apply(&self, t: &mut Integer) {
        let skip = self.shift.saturating_sub(rational::bits(t));
        if skip < 64 {
            *t *= &self.mantissa;
            *t >>= self.shift as usize;
        } else {
            *t *= self.mantissa.clone() >> skip as usize;
            *t >>= (self.shift - skip) as usize;
        }
    }
}

/// Computes `V = ₀F₁(; n+1; y) = Σ_m y^m/(m!(n+1)_m)` from below, and a bound of its relative error in units of
/// `2^{−bits}`: little more than 1 if the number of terms is as expected. `None` for y not finite, negative, or at
/// least `2⁴⁸`.
///
/// **Source**: concurrent summation (Smith 1989). It keeps one sum for each residue of m modulo B, so that only every
/// B-th step multiplies by a long number, `y^B`, and Horner's rule in y combines the sums. Small divisors `m(m+n)` are
/// grouped as far as a word holds their product.
///
/// **Accuracy**: the sums are integers of unit `2^{−F}`, all rounded down. Let `β = max(1,y)`, and let `T_m` be the
/// exact term without the powers of y below B that are applied last. An error e in `T_m` changes the result by
/// `e y^{m mod B} Σ_{k≥m} c_k y^k/(c_m y^m) ≤ e β^{B−1} V`, because the ratios of terms decrease with m.
/// - A division by the product D < 2⁶⁴ of a group has an error below 1 in the last of its terms and below
///   `D/(d₁ ⋯ d_i)` in the others, which sum to less than 2·2⁶⁴: `(2⁶⁵ + V) β^{B−1} ≤ 2⁶⁶ V β^{B−1}`.
/// - Each product with `y^B` has an error of two from its own roundings, plus the error of `y^B`. An addition chain
///   computes `y^B` with an error below `2B β^B`: for y ≥ 1 that is the fraction `2B·2^{−F}` of all that follows; for
///   y < 1, where T ≤ 1, it is at most 2B, times V.
/// - Horner's rule errs by 1 in each step, times β^{B−1}, and y itself by 1: together 2B β^{B−1} V.
///
/// A term that has become zero stays zero, so the truncation adds nothing beyond these roundings. For N terms the total
/// is at most `N·2⁶⁶ + 2N + 2N + 2B ≤ N·2⁶⁷` units, times `β^{B−1} V`.
fn hypergeometric(y: &Float, n: u32, bits: u32) -> Option<(Float, f64)> {
    if !y.is_finite() || y.is_sign_negative() || *y >= 281_474_976_710_656_u64 {
        return None;
    }
    let size = y.get_exp().map_or(0.0, |exponent| f64::from(exponent.max(0)));
    let expected = expected_terms(y, n, bits);
    let short = y
        .to_integer_exp()
        .is_some_and(|(mantissa, _)| rational::bits(&mantissa) - rational::trailing_zeros(&mantissa) <= 24);
    let block = if short { 8 } else { ((0.45 * expected).sqrt() as u32).clamp(1, 64) };
    let lost = 67.0 + expected.log2() + f64::from(block - 1) * size;
    let scale = bits + lost.ceil() as u32 + 1;
    let first = Factor::of(y, scale)?;
    let step = first.power(block, scale);

    let mut term = Integer::from(1) << scale as usize;
    let mut sums = vec![Integer::from(0); block as usize];
    sums[0].clone_from(&term);
    let (mut m, mut at) = (0u64, 1usize);
    loop {
        while at < sums.len() {
            let from = at;
            let mut product = 1u64;
            let next = |m: u64| (m + 1) * (m + 1 + u64::from(n));
            let start = m;
            while at < sums.len() {
                let Some(more) = product.checked_mul(next(m)) else { break };
                product = more;
                (m, at) = (m + 1, at + 1);
            }
            term /= product;
            for (place, sum) in sums[from..at].iter_mut().enumerate() {
                product /= next(start + place as u64);
                *sum += &term * product;
            }
        }
        if term.is_zero() {
            break;
        }
        step.apply(&mut term);
        at = 0;
    }
    let mut value = Integer::from(0);
    for sum in sums.iter().rev() {
        value *= &first.mantissa;
        value >>= first.shift as usize;
        value += sum;
    }
    // The error before the value is rounded to the bits that are returned.
    let error = 67.0 + (m as f64 + 1.0).log2() + f64::from(block - 1) * size - f64::from(scale);
    let value = down(bits + 8, &value);
    Some((value >> scale, (error + f64::from(bits)).exp2() + 2f64.powi(-7)))
}

/// Estimates the number of terms of `₀F₁` above `2^{−bits}`.
fn expected_terms(y: &Float, n: u32, bits: u32) -> f64 {
    let (y, n) = (y.to_f64(), f64::from(n));
    let (mut m, mut log) = (0.0, 0.0);
    while log > -f64::from(bits) - 70.0 {
        m += 1.0;
        log += (y / (m * (m + n))).log2();
    }
    m + 1.0
}
