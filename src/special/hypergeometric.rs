//! Bessel functions of long numbers by their series, in which later terms have fewer bits.

use super::bessel::expansion;
use crate::number::Float;
use crate::number::float::Pow;

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
    let mut value = hypergeometric(y, n, bits)?;
    if n > 0 {
        value *= Float::with_val(bits, base.pow(n)) / Float::with_val(bits, Float::factorial(n));
    }
    value *= Float::with_val(bits, exponent.exp_ref());
    Some(Spare { long: value, small: SERIES + 6.0 })
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

/// Bound of the error of [`hypergeometric`], in units of `2^{−bits}`.
const SERIES: f64 = 0.5;

/// Computes `V = ₀F₁(; n+1; y) = Σ_m T_m`, `T_m = y^m/(m!(n+1)_m)`, to this many bits; `None` for y not finite,
/// negative, or at least `2⁴⁸`.
///
/// **Accuracy**: within [`SERIES`] units of `2^{−bits}` relatively. As `T_m ≤ (e²y/m²)^m`, at most `N = q + 2 + 4√y`
/// terms matter to `2^{−q}`; `q = bits + 2 log₂ N + 4`. Term m has the bits that keep its four roundings (of y, the
/// product, the quotient and the bits) to `2^{1−q} S_m/T_m` of itself, for the sum `S_m` so far, and all later terms
/// inherit them: `4·2^{1−q} S_m Σ_{k≥m} T_k/T_m`. The ratios of terms decrease, so `T_i T_k ≤ T_m T_{i+k−m}` for
/// `i ≤ m ≤ k`, and that is at most `4·2^{1−q} (m + 1) V`. The sum over m is below `5N² 2^{−q} V`, with the roundings of
/// the sum and the rest.
fn hypergeometric(y: &Float, n: u32, bits: u32) -> Option<Float> {
    if !y.is_finite() || y.is_sign_negative() || *y >= 281_474_976_710_656_u64 {
        return None;
    }
    let size = y.to_f64();
    let most = f64::from(bits) + 100.0 + 4.0 * size.sqrt();
    let bits = bits + (2.0 * most.log2()).ceil() as u32 + 4;
    let mut factor = Float::with_val(bits, y);
    let (mut term, mut sum, mut m) = (Float::with_val(bits, 1), Float::with_val(bits, 1), 0i64);
    loop {
        m += 1;
        term *= &factor;
        term /= m * (m + i64::from(n));
        sum += &term;
        let (Some(top), Some(of_sum)) = (term.get_exp(), sum.get_exp()) else { return Some(sum) };
        let left = bits as i32 + top - of_sum;
        if left < 0 && 2.0 * size <= (m * m) as f64 {
            return Some(sum);
        }
        // Precision in whole words.
        let left = left.max(64) as u32;
        if left.next_multiple_of(64) < term.prec() {
            term.set_prec(left.next_multiple_of(64));
            factor = Float::with_val(term.prec(), y);
        }
    }
}
