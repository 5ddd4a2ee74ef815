//! What a number's precision means for a sum.

use crate::number::{Analytic, Scalar};

/// Bits of the significand, as far as sums are to be carried.
pub(super) fn bits<S: Scalar>(like: &S) -> f64 {
    (-like.log2_roundoff()).clamp(1.0, 1e6)
}

/// The unit roundoff as a number of its own system, which may be below the least double.
pub(crate) fn roundoff<S: Analytic>(like: &S) -> S {
    let mut left = bits(like) as u32;
    let (mut power, mut square) = (like.one(), like.ratio(1, 2));
    while left > 0 {
        if left % 2 == 1 {
            power = power * &square;
        }
        square = square.square();
        left /= 2;
    }
    power
}

/// `2^{−n}` for the whole part of n, zero below the normal doubles.
#[inline]
pub(crate) fn negative_power(n: f64) -> f64 {
    if (0.0..1022.0).contains(&n) { f64::from_bits((1023 - n as u64) << 52) } else { 0.0 }
}
