//! Fractions on GMP.

use std::cmp::Ordering;

use rug::Float;
pub(crate) use rug::Integer;
pub use rug::Rational;
use rug::float::Round;
use rug::integer::Order;
use rug::ops::DivRounding;

pub(super) fn quotient(p: Integer, q: Integer) -> Rational {
    Rational::from((p, q))
}

/// Returns numerator and denominator.
pub(super) fn parts(x: &Rational) -> (Integer, Integer) {
    (x.numer().clone(), x.denom().clone())
}

/// Returns the nearest double. `Rational::to_f64` truncates; a `Float` rounds to nearest.
pub(super) fn nearest_double(x: &Rational) -> f64 {
    Float::with_val_round(53, x, Round::Nearest).0.to_f64()
}

/// Returns the greatest integer `≤ x`; `None` if it does not fit.
pub(super) fn floor(x: &Rational) -> Option<i64> {
    Integer::from(x.numer().div_floor(x.denom())).to_i64()
}

pub(super) fn sign(x: &Rational) -> Ordering {
    x.cmp0()
}

pub(super) fn half(x: Rational) -> Rational {
    x >> 1u32
}

/// Returns the number of bits of numerator and denominator together.
pub(super) fn size(x: &Rational) -> u32 {
    x.numer().significant_bits() + x.denom().significant_bits()
}

/// Returns the number of bits of the magnitude.
pub(crate) fn bits(n: &Integer) -> u32 {
    n.significant_bits()
}

/// Returns the greatest common divisor.
pub(super) fn gcd(a: Integer, b: &Integer) -> Integer {
    a.gcd(b)
}

/// Returns `√n` of a perfect square; `None` for any other integer.
pub(super) fn exact_root(n: &Integer) -> Option<Integer> {
    n.is_perfect_square().then(|| n.clone().sqrt())
}

/// Returns the limbs of the magnitude, the least significant first; none for zero.
pub(super) fn limbs(n: &Integer) -> Vec<u64> {
    n.to_digits(Order::Lsf)
}

/// Builds the integer from its limbs, the least significant first.
pub(super) fn from_limbs(limbs: &[u64]) -> Integer {
    Integer::from_digits(limbs, Order::Lsf)
}
