//! The way to floats of any number of bits and to enclosures of them.

use super::float::Wide;
use crate::number::rational::{from_limbs, limbs};
use crate::number::{Estimate, Float, Interval, Reads};

/// A [`Float`] of as many bits. **Accuracy**: *exact*.
fn to_float<const N: usize>(x: &Wide<N>) -> Float {
    let bits = 64 * N as u32;
    if x.is_zero() || !x.finite() {
        return Float::with_val(bits, x.nearest_double());
    }
    let size = Float::with_val(bits, from_limbs(&x.limbs)) << (x.exponent - bits as i32);
    if x.negative { -size } else { size }
}

/// The nearest number. **Accuracy**: *exact* where it fits, otherwise *correctly rounded* to `64 N` bits.
fn from_float<const N: usize>(x: &Float) -> Wide<N> {
    let x = Float::with_val(64 * N as u32, x);
    let Some((mantissa, exponent)) = x.to_integer_exp() else { return Wide::from(x.to_f64()) };
    // The integer has all bits of the significand.
    let found = limbs(&mantissa);
    let mut own = [0; N];
    own.iter_mut().rev().zip(found.iter().rev()).for_each(|(own, found)| *own = *found);
    if found.is_empty() {
        return Wide::ZERO;
    }
    Wide::normalised(own, 0, i64::from(exponent) + 64 * found.len() as i64, x.is_sign_negative())
}

/// Both have the same roundoff: number and bound stay as they are.
impl<const N: usize> Reads<Estimate<Wide<N>>> for Estimate<Float> {
    fn read(number: Estimate<Wide<N>>) -> Self {
        Estimate::new(to_float(number.value()), number.error())
    }

    /// A number of more bits is rounded, and its bound counts that.
    fn give(&self, (): &()) -> Estimate<Wide<N>> {
        let (bits, own) = (64 * N as u32, self.value().prec());
        let (value, error) = (from_float(self.value()), self.error());
        if own == bits {
            return Estimate::new(value, error);
        }
        let error = error * (f64::from(bits) - f64::from(own)).exp2();
        let exact = own < bits || to_float(&value) == *self.value();
        let rounding = if exact { 0.0 } else { self.value().to_f64().abs().max(f64::MIN_POSITIVE) };
        Estimate::new(value, error + rounding)
    }
}

/// The numbers within the bound.
impl<const N: usize> Reads<Estimate<Wide<N>>> for Interval {
    fn read(number: Estimate<Wide<N>>) -> Self {
        Interval::read(Estimate::<Float>::read(number))
    }

    fn give(&self, (): &()) -> Estimate<Wide<N>> {
        let middle: Estimate<Float> = self.give(&(64 * N as u32));
        middle.give(&())
    }
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/long.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
