//! Fractions and texts.

use super::float::Wide;
use crate::number::rational::{self, Integer, Rational};
use crate::number::{decimal, text};

/// Numbers beyond `2^{±EXPANDED}` are not written out.
const EXPANDED: i32 = 1 << 22;

impl<const N: usize> Wide<N> {
    /// The nearest number. **Accuracy**: *correctly rounded*: of the quotient `64 (N + 1)` bits or one more are exact,
    /// rounded down.
    pub(super) fn nearest(x: &Rational) -> Self {
        let (p, q) = rational::parts(x);
        let bits = |n: &Integer| i64::from(rational::bits(n));
        let shift = 64 * (N as i64 + 1) + bits(&q) - bits(&p);
        let size = shift.unsigned_abs() as usize;
        let quotient = if shift < 0 { p / (q << size) } else { (p << size) / q };
        let found = rational::limbs(&quotient);
        let Some(least) = found.len().checked_sub(N + 1) else { return Wide::ZERO };
        let mut limbs = [0; N];
        limbs.copy_from_slice(&found[least + 1..]);
        let exponent = 64 * found.len() as i64 - shift;
        Wide::normalised(limbs, found[least], exponent, rational::sign(x).is_lt())
    }

    /// The fraction that the number is, where it is finite and of a size that is written out.
    pub fn to_rational(self) -> Option<Rational> {
        if self.is_zero() {
            return Some(Rational::from(0));
        }
        if self.exponent.abs() > EXPANDED {
            return None;
        }
        let mantissa = rational::from_limbs(&self.limbs);
        let mantissa = if self.negative { -mantissa } else { mantissa };
        let shift = i64::from(self.exponent) - 64 * N as i64;
        let size = shift.unsigned_abs() as usize;
        Some(match shift < 0 {
            true => rational::quotient(mantissa, Integer::from(1) << size),
            false => Rational::from(mantissa << size),
        })
    }

    /// Digits that spell every number.
    pub(super) const DIGITS: u32 = text::digits_for_bits(64 * N as u32);

    /// The number to so many significant digits. **Accuracy**: *correctly rounded*; beyond `2^{±2²²}` a double times a
    /// power of two.
    pub(super) fn in_decimal(&self, digits: u32) -> String {
        if !self.finite() {
            return self.nearest_double().to_string();
        }
        let beyond = || {
            let mantissa = Wide { exponent: 0, ..*self }.nearest_double();
            format!("{mantissa}·2^{}", self.exponent)
        };
        self.to_rational().map_or_else(beyond, |value| decimal(&value, digits))
    }
}
