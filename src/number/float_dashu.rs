//! Floats of any number of bits in pure Rust: the part of `rug::Float` that this library uses.
//!
//! Sums, products, quotients and roots are integers of `dashu_int`, elementary functions those of `dashu_float`. All
//! are cut off behind at least two bits more than are asked for, and the last of these is 1 if anything was cut off:
//! it decides nothing but that. [`round`] alone rounds.

#[path = "float_dashu/operation.rs"]
mod operation;
#[path = "float_dashu/operators.rs"]
mod operators;

use std::cmp::Ordering;

use dashu_float::round::mode::Zero;
use dashu_float::{Context, Repr};
use dashu_int::ops::{BitTest, DivRem, UnsignedAbs};
use dashu_int::{IBig, Sign, UBig};

use super::rational::{Integer, Rational};
use operation::{parts, quotient};

/// Greatest binary exponent, as in MPFR; its negative is the least one.
const MOST_EXPONENT: i64 = (1 << 30) - 1;
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Round {
    /// The nearest number; the even one in the middle between two.
    Nearest,
    /// Towards −∞.
    Down,
    /// Towards ∞.
    Up,
    AwayZero,
}

/// A number that is no fraction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Constant {
    Pi,
}

/// A binary floating-point number with any number of bits, infinite, or no number.
///
/// **Accuracy**: every operation is *correctly rounded*. Exponents are those of MPFR.
#[derive(Clone, Debug)]
pub struct Float {
    bits: u32,
    value: Content,
}

#[derive(Clone, Debug)]
enum Content {
    Nan,
    Infinite(Sign),
    /// `mantissa · 2^exponent`, with no more bits than the number has.
    Finite(IBig, i64),
}

use Content::{Finite, Infinite, Nan};

/// A value that is rounded to a [`Float`].
pub trait Unrounded {
    fn rounded(self, bits: u32, round: Round) -> Float;
}

/// Returns `value` in this many bits, rounded in one direction.
pub(crate) fn rounded<T: Unrounded>(bits: u32, value: T, round: Round) -> Float {
    value.rounded(bits, round)
}

pub(crate) fn down<T: Unrounded>(bits: u32, value: T) -> Float {
    value.rounded(bits, Round::Down)
}

pub(crate) fn up<T: Unrounded>(bits: u32, value: T) -> Float {
    value.rounded(bits, Round::Up)
}

/// Returns the sum in the bits of `a`, rounded in one direction.
pub(super) fn sum(a: Float, b: &Float, round: Round) -> Float {
    (&a + b).rounded(a.bits, round)
}

/// Returns the difference in the bits of `a`, rounded in one direction.
pub(super) fn difference(a: Float, b: &Float, round: Round) -> Float {
    (&a - b).rounded(a.bits, round)
}

/// Returns the greatest integer `≤ x`; `None` if it does not fit.
pub(super) fn floor(x: &Float) -> Option<i64> {
    let (mantissa, exponent) = x.finite().filter(|_| x.top() <= 64)?;
    let shift = exponent.unsigned_abs() as usize;
    // A shift of a negative integer to the right rounds down.
    i64::try_from(if exponent < 0 { mantissa >> shift } else { mantissa << shift }).ok()
}

/// Rounds `mantissa · 2^exponent`.
fn round(mantissa: IBig, mut exponent: i64, bits: u32, round: Round) -> Float {
    let (sign, mut mantissa) = mantissa.into_parts();
    let (room, negative) = (bits as usize, sign == Sign::Negative);
    let drop = mantissa.bit_len().saturating_sub(room);
    if drop > 0 {
        let below = drop > 1 && mantissa.trailing_zeros().is_some_and(|zeros| zeros < drop - 1);
        let half = mantissa.bit(drop - 1);
        let away = match round {
            Round::Nearest => half && (below || mantissa.bit(drop)),
            Round::Down => negative && (half || below),
            Round::Up => !negative && (half || below),
            Round::AwayZero => half || below,
        };
        mantissa >>= drop;
        exponent += drop as i64;
        if away {
            mantissa += 1u8;
        }
    }
    let top = exponent.saturating_add(mantissa.bit_len() as i64);
    let outwards = match round {
        Round::Nearest => top > 0,
        Round::Down => negative,
        Round::Up => !negative,
        Round::AwayZero => true,
    };
    let value = match (top > 0, outwards) {
        _ if mantissa.is_zero() || top.abs() <= MOST_EXPONENT => Finite(IBig::from_parts(sign, mantissa), exponent),
        (true, true) => Infinite(sign),
        (true, false) => Finite(IBig::from_parts(sign, UBig::ones(room)), MOST_EXPONENT - room as i64),
        (false, true) => Finite(IBig::from_parts(sign, UBig::ONE), -MOST_EXPONENT - 1),
        (false, false) => Finite(IBig::ZERO, 0),
    };
    Float { bits, value }
}

/// Returns a number slightly farther from zero, or slightly nearer, than `mantissa · 2^exponent`: by less than a unit
/// of its last bit, and of the third bit beyond `bits`.
fn beside(mantissa: &IBig, exponent: i64, farther: bool, bits: u32) -> (IBig, i64) {
    let by = (bits as usize + 3).saturating_sub(mantissa.bit_len()) + 1;
    let unit = IBig::from_parts(mantissa.sign(), UBig::ONE);
    let size = mantissa << by;
    (if farther { size + unit } else { size - unit }, exponent - by as i64)
}

impl Float {
    /// Returns zero in this many bits.
    pub fn new(bits: u32) -> Self {
        Float { bits, value: Finite(IBig::ZERO, 0) }
    }

    /// Returns the nearest number to `value` in this many bits.
    pub fn with_val<T: Unrounded>(bits: u32, value: T) -> Self {
        value.rounded(bits, Round::Nearest)
    }

    /// Returns the number of bits of the significand.
    pub fn prec(&self) -> u32 {
        self.bits
    }

    /// Rounds the number to this many bits.
    pub fn set_prec(&mut self, bits: u32) {
        *self = Float::with_val(bits, &*self);
    }

    fn finite(&self) -> Option<(&IBig, i64)> {
        match &self.value {
            Finite(mantissa, exponent) => Some((mantissa, *exponent)),
            _ => None,
        }
    }

    /// Returns the exponent of a magnitude in `[½, 1)`; the least of all for zero, the greatest if it is not finite.
    fn top(&self) -> i64 {
        match &self.value {
            Finite(mantissa, _) if mantissa.is_zero() => i64::MIN,
            Finite(mantissa, exponent) => exponent + mantissa.bit_len() as i64,
            _ => i64::MAX,
        }
    }

    /// Returns whether the number is no number.
    pub fn is_nan(&self) -> bool {
        matches!(self.value, Nan)
    }

    /// Returns whether the number is ±∞.
    pub fn is_infinite(&self) -> bool {
        matches!(self.value, Infinite(_))
    }

    /// Returns whether the number is finite.
    pub fn is_finite(&self) -> bool {
        matches!(self.value, Finite(..))
    }

    /// Returns whether the number is zero.
    pub fn is_zero(&self) -> bool {
        matches!(&self.value, Finite(mantissa, _) if mantissa.is_zero())
    }

    /// Returns whether the number is below zero.
    pub fn is_sign_negative(&self) -> bool {
        self.cmp0() == Some(Ordering::Less)
    }

    /// Returns the sign; `None` for no number.
    pub fn cmp0(&self) -> Option<Ordering> {
        self.kind().partial_cmp(&0.0)
    }

    /// Returns a double of the same kind: −1, 0, 1, infinite or no number.
    fn kind(&self) -> f64 {
        match &self.value {
            Nan => f64::NAN,
            Infinite(sign) => *sign * f64::INFINITY,
            Finite(mantissa, _) if mantissa.is_zero() => 0.0,
            Finite(mantissa, _) => mantissa.sign() * 1.0,
        }
    }

    /// Compares the magnitudes.
    pub fn cmp_abs(&self, other: &Self) -> Option<Ordering> {
        self.clone().abs().partial_cmp(&other.clone().abs())
    }

    /// Returns the magnitude.
    pub fn abs(self) -> Self {
        if self.is_sign_negative() { -self } else { self }
    }

    /// Returns the greater number; the other one if one is no number.
    pub fn max(self, other: &Self) -> Self {
        if self.is_nan() || *other > self { other.clone() } else { self }
    }

    /// Returns the smaller number; the other one if one is no number.
    pub fn min(self, other: &Self) -> Self {
        if self.is_nan() || *other < self { other.clone() } else { self }
    }

    /// Returns the exponent of a magnitude in `[½, 1)`; `None` for zero and where the number is not finite.
    pub fn get_exp(&self) -> Option<i32> {
        i32::try_from(self.top()).ok()
    }

    /// Returns `(m, e)` with `self = m · 2^e`; `None` if the number is not finite.
    pub fn to_integer_exp(&self) -> Option<(Integer, i32)> {
        let (mantissa, exponent) = self.finite()?;
        Some((mantissa.clone(), i32::try_from(exponent).ok()?))
    }

    /// Returns the fraction that the number is; `None` if it is not finite.
    pub fn to_rational(&self) -> Option<Rational> {
        let (mantissa, exponent) = self.finite()?;
        let size = usize::try_from(exponent.unsigned_abs()).ok()?;
        Some(match exponent < 0 {
            true => Rational::from_parts(mantissa.clone(), UBig::ONE << size),
            false => Rational::from(mantissa << size),
        })
    }

    /// Returns the nearest double.
    pub fn to_f64(&self) -> f64 {
        self.to_f64_round(Round::Nearest)
    }

    /// Returns the double next to the number in one direction.
    pub fn to_f64_round(&self, round: Round) -> f64 {
        let (top, sign) = (self.top(), self.kind());
        let Some((mantissa, _)) = self.finite().filter(|_| sign != 0.0) else { return sign };
        let outwards = match round {
            Round::Nearest => top != -1074 || mantissa.unsigned_abs().trailing_zeros() == Some(mantissa.bit_len() - 1),
            Round::Down => sign < 0.0,
            Round::Up => sign > 0.0,
            Round::AwayZero => true,
        };
        if top < -1073 {
            // Below the least double; the nearest is zero up to its half.
            let least = if round == Round::Nearest { !outwards } else { outwards };
            return if least { sign * f64::from_bits(1) } else { 0.0 };
        }
        let near = rounded((top + 1074).min(53) as u32, self, round);
        let Some((mantissa, exponent)) = near.finite() else { return f64::INFINITY * sign };
        if near.top() > 1024 {
            return if outwards { f64::INFINITY * sign } else { f64::MAX * sign };
        }
        // The double is exact, and so is a half of the power of two that has twice the exponent.
        let half = exponent / 2;
        let mantissa = i64::try_from(mantissa).unwrap_or_default() as f64;
        mantissa * (half as f64).exp2() * ((exponent - half) as f64).exp2()
    }

    /// Returns `(m, e)` with `self ≈ m · 2^e` and m in `[½, 1)`, rounded in one direction.
    pub fn to_f64_exp_round(&self, round: Round) -> (f64, i32) {
        match (&self.value, self.get_exp()) {
            (Finite(mantissa, _), Some(top)) => {
                let size = Float { bits: self.bits, value: Finite(mantissa.clone(), -(mantissa.bit_len() as i64)) };
                let size = size.to_f64_round(round);
                if size.abs() < 1.0 { (size, top) } else { (size / 2.0, top + 1) }
            }
            _ => (self.to_f64(), 0),
        }
    }

    /// Returns the number to so many significant digits, all of its own by default, rounded in one direction.
    pub(super) fn to_string_radix_round(&self, _: i32, digits: Option<usize>, round: Round) -> String {
        let all = || 1 + (f64::from(self.bits) * std::f64::consts::LOG10_2).ceil() as usize;
        let (Some((mantissa, exponent)), false) = (self.finite(), self.is_zero()) else {
            return self.to_f64().to_string();
        };
        if self.top().abs() > 1 << 22 {
            let (size, exponent) = self.to_f64_exp_round(round);
            return format!("{size}·2^{exponent}");
        }
        let digits = digits.unwrap_or_else(all).max(2);
        let mut power = ((self.top() as f64 - 1.0) * std::f64::consts::LOG10_2).floor() as i64;
        let (text, power) = loop {
            // The digits before the point are those of the mantissa.
            let scale = digits as i64 - 1 - power;
            let ten = UBig::from(10u8).pow(scale.unsigned_abs() as usize);
            let (above, below) = if scale < 0 { (UBig::ONE, ten) } else { (ten, UBig::ONE) };
            let (above, below) = match exponent < 0 {
                true => (above, below << exponent.unsigned_abs() as usize),
                false => (above << exponent as usize, below),
            };
            let (sign, size) = mantissa.clone().into_parts();
            let (whole, rest) = (size * above).div_rem(&below);
            let away = match round {
                Round::Nearest => {
                    (&rest << 1usize).cmp(&below).then(whole.bit(0).cmp(&true)).is_ge() && !rest.is_zero()
                }
                Round::Down => sign == Sign::Negative && !rest.is_zero(),
                Round::Up => sign == Sign::Positive && !rest.is_zero(),
                Round::AwayZero => !rest.is_zero(),
            };
            let text = (if away { whole + 1u8 } else { whole }).to_string();
            match text.len() {
                length if length > digits => power += 1,
                length if length < digits => power -= 1,
                _ => break (text, power),
            }
        };
        let sign = if self.is_sign_negative() { "-" } else { "" };
        match usize::try_from(power + 1) {
            Ok(before) if before == digits => format!("{sign}{text}"),
            Ok(before @ 1..) if before < digits => format!("{sign}{}.{}", &text[..before], &text[before..]),
            _ => format!("{sign}{}.{}e{power}", &text[..1], &text[1..]),
        }
    }

    /// Returns the number with all digits of its own.
    pub(super) fn to_string_radix(&self, radix: i32, digits: Option<usize>) -> String {
        self.to_string_radix_round(radix, digits, Round::Nearest)
    }

    /// Returns the square root in the bits of the number.
    pub fn sqrt(self) -> Self {
        Float::with_val(self.bits, self.sqrt_ref())
    }

    /// Returns the exponential in the bits of the number.
    pub fn exp(self) -> Self {
        Float::with_val(self.bits, self.exp_ref())
    }
}

macro_rules! from_integers {
    ($($type:ty),*) => {$(
        impl Unrounded for $type {
            fn rounded(self, bits: u32, direction: Round) -> Float {
                round(IBig::from(self), 0, bits, direction)
            }
        }
    )*};
}
from_integers!(i32, i64, u32, u64, IBig);

impl Unrounded for f64 {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        let value = match Repr::<2>::try_from(self).map(Repr::into_parts) {
            Ok((mantissa, exponent)) if self.is_finite() => return round(mantissa, exponent as i64, bits, direction),
            Ok(_) => Infinite(if self < 0.0 { Sign::Negative } else { Sign::Positive }),
            Err(_) => Nan,
        };
        Float { bits, value }
    }
}

impl Unrounded for Float {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        match self.value {
            Finite(mantissa, exponent) => round(mantissa, exponent, bits, direction),
            value => Float { bits, value },
        }
    }
}

impl Unrounded for Rational {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        let (numerator, denominator) = self.into_parts();
        let (mantissa, exponent) = quotient((&numerator, 0), (&denominator.into(), 0), bits as usize + 2);
        round(mantissa, exponent, bits, direction)
    }
}

macro_rules! from_references {
    ($($type:ty),*) => {$(
        impl Unrounded for &$type {
            fn rounded(self, bits: u32, direction: Round) -> Float {
                self.clone().rounded(bits, direction)
            }
        }
    )*};
}
from_references!(IBig, f64, Float, Rational);

impl Unrounded for Constant {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        let (mantissa, exponent) = parts(Context::<Zero>::new(bits as usize + 2).pi(None), bits);
        round(mantissa, exponent, bits, direction)
    }
}

/// Powers with whole exponents.
pub(crate) trait Pow {
    /// Returns the power, not rounded.
    fn pow(self, n: u32) -> Float;
}

impl Pow for &Float {
    fn pow(self, n: u32) -> Float {
        match &self.value {
            Finite(mantissa, exponent) => {
                let value = Finite(mantissa.pow(n as usize), exponent * i64::from(n));
                Float { bits: self.bits.saturating_mul(n.max(1)), value }
            }
            _ => Float { value: Nan, ..self.clone() },
        }
    }
}
