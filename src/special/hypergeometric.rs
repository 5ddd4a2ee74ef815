//! Modified Bessel functions in numbers with bits to spare, in which their own roundings do not count: by their series,
//! and by the expansion at infinity.

use super::bessel::expansion;
use super::bits;
use super::ray::Ray;
use crate::number::rational::Integer;
use crate::number::{Analytic, Float, Rounded, Scalar, Wide};

/// A number in which these functions are computed.
pub(super) trait Spare: Rounded {
    /// Computes `₀F₁(; n+1; y) = Σ_m y^m/(m!(n+1)_m)` for finite `y ≥ 0`, and its roundings.
    fn hypergeometric(y: &Self, n: u32) -> (Self, f64);

    /// Computes `eˣ`, and its roundings for an argument with ten roundings.
    fn exponential(&self) -> (Self, f64);
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

    /// Computes the exponential within `2³⁴` roundings; beyond `2³¹` there is nothing left of the value.
    fn exponential(&self) -> (Self, f64) {
        (self.raw_exp(), 68_719_476_736.0)
    }
}

impl Spare for Float {
    /// Keeps one sum for each residue of m modulo 8, so that only every eighth step multiplies by a long number, `y⁸`;
    /// Horner's rule in y combines the sums.
    ///
    /// **Source**: concurrent summation (Smith 1989).
    ///
    /// All are integers of the unit `u = 2^{−p−32} β^{−7}`, rounded down, `β = max(1,y)`. The ratios of terms decrease,
    /// so an error e of a term without its last powers of y changes the result by at most `e β⁷` of itself. A division
    /// adds u, and a product with `y⁸` adds u and fewer than 15u for the error of `y⁸`, absolutely for y < 1 and
    /// relatively for y ≥ 1; Horner's rule adds 4u in each step. For N terms that is `(3N + 32) β⁷ u`, less than a
    /// sixteenth of a rounding up to `N = 2²⁶`, and the result is rounded once.
    fn hypergeometric(y: &Self, n: u32) -> (Self, f64) {
        let (bits, grown) = (y.prec(), y.get_exp().unwrap_or(0).max(0).unsigned_abs());
        let scale = (bits + 32 + 7 * grown) as usize;
        let Some((mantissa, exponent)) = y.to_integer_exp() else { return (y.clone(), f64::INFINITY) };
        let by = i64::from(exponent) + scale as i64;
        let size = by.unsigned_abs() as usize;
        let y = if by < 0 { mantissa >> size } else { mantissa << size };
        let step = (0..3).fold(y.clone(), |power, _| (power.clone() * &power) >> scale);
        let mut sums: [Integer; 8] = std::array::from_fn(|_| Integer::from(0));
        let (mut term, mut m) = (Integer::from(1) << scale, 0u64);
        while !term.is_zero() {
            for sum in &mut sums {
                *sum += &term;
                m += 1;
                term /= m * (m + u64::from(n));
            }
            term *= &step;
            term >>= scale;
        }
        let sum = sums.iter().rev().fold(Integer::from(0), |total, sum| ((total * &y) >> scale) + sum);
        (Float::with_val(bits, &sum) >> scale as u32, 1.1)
    }

    /// Computes the exponential, but no number where it would vanish.
    fn exponential(&self) -> (Self, f64) {
        let value = if *self < -1e15 { self.double(f64::NAN) } else { Analytic::exp(self) };
        (value, 10.0 * self.to_f64().abs() + 2.0)
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

/// Computes `e^{−z} I_n(z)`, `I_n = (z/2)ⁿ/n! ₀F₁(; n+1; z²/4)`, and its roundings, for `z ≥ 0`. y, rounded once,
/// passes on at most z of them, and n factors add two each.
pub(super) fn in_scaled<S: Spare>(z: &S, n: u32) -> (S, f64) {
    if n <= 1 && z.to_f64() > far(z) {
        return (expansion(z, i64::from(n)), expansion_roundings(z));
    }
    let half = z.clone() / z.int(2);
    let (value, roundings) = S::hypergeometric(&half.square(), n);
    let value = (1..=i64::from(n)).fold(value, |product, k| product * &half / z.int(k));
    let (decay, more) = (-z.clone()).exponential();
    (value * &decay, roundings + 2.0 * f64::from(n) + z.to_f64() + more)
}

/// Computes `e^{−rt} ψ₀` and its roundings, for `ξ ≥ 0`.
///
/// The series serves small `z = r√(ξη)`. Beyond its reach the result is `e^{−λ} · e^{−z} I₀(z)` with
/// `λ = r(t − √(ξη)) = (r/2)(η − ξ)²/(η + ξ + 2√(ξη))`. `y = (r/2)² ξη` has three roundings, and passes on at most
/// `z/2` times as many; the expansion passes on fewer than it has. Either exponent has at most ten roundings.
pub(super) fn start<S: Spare>(ray: &Ray<S>) -> (S, f64) {
    let (half, product) = (ray.half(), ray.xi.clone() * &ray.eta);
    let y = half.square() * &product;
    if !y.is_finite() || y.is_negative() {
        return (y.double(f64::NAN), f64::INFINITY);
    }
    let (z, sum) = (2.0 * y.to_f64().sqrt(), ray.eta.clone() + &ray.xi);
    if z <= far(&y) {
        let (value, roundings) = S::hypergeometric(&y, 0);
        let (decay, more) = (-(half * &sum)).exponential();
        return (value * &decay, roundings + 2.0 * z + more);
    }
    let root = product.sqrt();
    let lag = half * &(ray.eta.clone() - &ray.xi).square() / (sum + &root + &root);
    let (decay, more) = (-lag).exponential();
    (expansion(&(ray.damping.clone() * &root), 0) * &decay, 2.0 * expansion_roundings(&y) + more)
}

/// Returns the ray in longer numbers, with ξ ≥ 0: a ray that arrives now may do so a rounding later.
pub(super) fn arrived<S: Rounded, L: Rounded>(ray: &Ray<S>, longer: impl Fn(&S) -> L) -> Ray<L> {
    let ray = ray.map(longer);
    let xi = if ray.xi.is_negative() { ray.xi.zero() } else { ray.xi };
    Ray { xi, ..ray }
}
