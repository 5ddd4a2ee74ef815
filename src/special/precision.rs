//! What a number's precision means for a sum.

use crate::number::Scalar;

/// Bits of the significand, as far as sums are to be carried.
pub(super) fn bits<S: Scalar>(like: &S) -> f64 {
    (-like.log2_roundoff()).clamp(1.0, 1e6)
}

/// `2^{−n}` for the whole part of n, zero below the normal doubles.
#[inline]
pub(super) fn negative_power(n: f64) -> f64 {
    if (0.0..1022.0).contains(&n) { f64::from_bits((1023 - n as u64) << 52) } else { 0.0 }
}
