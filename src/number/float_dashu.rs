//! Floats of any number of bits in pure Rust: the part of `rug::Float` that this library uses.
//!
//! Sums, products, quotients and roots are integers of `dashu_int`, elementary functions those of `dashu_float`. All
//! are cut off behind at least two bits more than are asked for, and the last of these is 1 if anything was cut off:
//! it decides nothing but that. [`round`] alone rounds.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Shl, Shr, ShrAssign, Sub, SubAssign};

use dashu_base::Approximation;
use dashu_float::round::Rounding;
use dashu_float::round::mode::Zero;
use dashu_float::{Context, FBig, FpError, Repr};
use dashu_int::ops::{BitTest, DivRem, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, Sign, UBig};

use super::rational::{Integer, Rational};

/// Greatest binary exponent, as in MPFR; its negative is the least one.
const MOST_EXPONENT: i64 = (1 << 30) - 1;
/// Greatest binary exponent of an angle whose sine and cosine are computed.
const MOST_ANGLE: i64 = 1 << 16;

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

/// The result of a function, not rounded yet; a function of one number has it twice.
#[derive(Clone, Copy, Debug)]
pub struct Operation<'a>(Function, &'a Float, &'a Float);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Function {
    Add,
    Sub,
    Mul,
    Div,
    Recip,
    Sqrt,
    Exp,
    ExpM1,
    Ln,
    Ln1p,
    Sin,
    Cos,
}

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

    pub(crate) fn square_ref(&self) -> Operation<'_> {
        Operation(Function::Mul, self, self)
    }
}

macro_rules! functions {
    ($($name:ident $function:ident),*) => {
        impl Float {
            $(pub(crate) fn $name(&self) -> Operation<'_> {
                Operation(Function::$function, self, self)
            })*
        }
    };
}
functions!(recip_ref Recip, sqrt_ref Sqrt, exp_ref Exp, exp_m1_ref ExpM1, ln_ref Ln, ln_1p_ref Ln1p);
functions!(sin_ref Sin, cos_ref Cos);

impl Unrounded for Operation<'_> {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        match self.cut(bits) {
            Ok((mantissa, exponent)) => round(mantissa, exponent, bits, direction),
            Err(value) => value.rounded(bits, direction),
        }
    }
}

impl Operation<'_> {
    /// Computes the value, cut off; a double if that is exact, infinite or no number.
    fn cut(self, bits: u32) -> Result<(IBig, i64), f64> {
        let Operation(function, x, y) = self;
        let in_doubles = || function.in_doubles(x.kind(), y.kind());
        let ((m, e), (n, f)) = x.finite().zip(y.finite()).ok_or_else(in_doubles)?;
        let room = bits as usize + 2;
        Ok(match function {
            Function::Add | Function::Sub => {
                let minus = if function == Function::Add { Sign::Positive } else { Sign::Negative };
                add((m, e, x.top(), Sign::Positive), (n, f, y.top(), minus), bits)
            }
            Function::Mul => (m * n, e + f),
            _ if n.is_zero() => return Err(in_doubles()),
            Function::Div => quotient((m, e), (n, f), room),
            Function::Recip => quotient((&IBig::ONE, 0), (m, e), room),
            Function::Sqrt | Function::Ln if m.sign() == Sign::Negative => return Err(f64::NAN),
            Function::Sqrt => {
                let by = (2 * room).saturating_sub(m.bit_len());
                let by = by + usize::from((e - by as i64) % 2 != 0);
                let (root, rest) = (m.unsigned_abs() << by).sqrt_rem();
                (marked(root, &rest).into(), (e - by as i64) / 2)
            }
            _ => return function.elementary((m, e), x.top(), bits),
        })
    }
}

/// Returns a magnitude with its last bit set unless the rest is zero.
fn marked(mut size: UBig, rest: &UBig) -> UBig {
    if !rest.is_zero() {
        size.set_bit(0);
    }
    size
}

fn quotient((m, e): (&IBig, i64), (n, f): (&IBig, i64), room: usize) -> (IBig, i64) {
    let by = (room + n.bit_len()).saturating_sub(m.bit_len());
    let (size, rest) = (m.unsigned_abs() << by).div_rem(n.unsigned_abs());
    (m.sign() * n.sign() * marked(size, &rest), e - f - by as i64)
}

/// Returns the sum of two numbers, each with the exponent of its magnitude and the sign that it is multiplied by.
fn add(x: (&IBig, i64, i64, Sign), y: (&IBig, i64, i64, Sign), bits: u32) -> (IBig, i64) {
    let ((m, e, _, plus), (n, f, top, minus)) = if x.2 < y.2 { (y, x) } else { (x, y) };
    if n.is_zero() {
        return (m.clone() * plus, e);
    } else if top < e - (i64::from(bits) + 3 - m.bit_len() as i64).max(0) {
        // The lesser number is below the last bit, of so many that it does not matter how far.
        let (sum, exponent) = beside(m, e, m.sign() * plus == n.sign() * minus, bits);
        return (sum * plus, exponent);
    }
    let least = e.min(f);
    ((m << (e - least) as usize) * plus + (n << (f - least) as usize) * minus, least)
}

impl Function {
    fn in_doubles(self, x: f64, y: f64) -> f64 {
        match self {
            Function::Add => x + y,
            Function::Sub => x - y,
            Function::Mul => x * y,
            Function::Div => x / y,
            Function::Recip => x.recip(),
            Function::Sqrt => x.sqrt(),
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Ln => x.ln(),
            Function::Ln1p => x.ln_1p(),
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
        }
    }

    /// Computes an elementary function as [`Operation::cut`].
    fn elementary(self, (m, e): (&IBig, i64), top: i64, bits: u32) -> Result<(IBig, i64), f64> {
        let negative = m.sign() == Sign::Negative;
        if self != Function::Ln && top < -i64::from(bits.max(m.bit_len() as u32)) - 8 {
            return Ok(match self {
                Function::Exp => beside(&IBig::ONE, 0, !negative, bits),
                Function::Cos => beside(&IBig::ONE, 0, false, bits),
                Function::ExpM1 => beside(m, e, !negative, bits),
                Function::Ln1p => beside(m, e, negative, bits),
                _ => beside(m, e, false, bits),
            });
        }
        let (context, x) = (Context::<Zero>::new(bits as usize + 2), Repr::new(m.clone(), e as isize));
        let value = match self {
            Function::Exp if top > 34 && negative => Err(FpError::Underflow(Sign::Positive)),
            Function::Exp | Function::ExpM1 if top > 34 && !negative => Err(FpError::Overflow(Sign::Positive)),
            Function::Exp => context.exp(&x, None),
            Function::ExpM1 => context.exp_m1(&x, None),
            Function::Ln => context.ln(&x, None),
            Function::Ln1p => context.ln_1p(&x, None),
            _ if top > MOST_ANGLE => Err(FpError::OutOfDomain),
            Function::Cos => context.cos(&x, None),
            _ => context.sin(&x, None),
        };
        match value {
            // The logarithm of zero.
            Ok(value) if value.value_ref().repr().is_infinite() => Err(f64::NEG_INFINITY),
            Ok(value) => Ok(parts(value, bits)),
            Err(FpError::Overflow(sign)) => Ok((sign * IBig::ONE, 4 * MOST_EXPONENT)),
            Err(FpError::Underflow(sign)) => Ok((sign * IBig::ONE, -4 * MOST_EXPONENT)),
            Err(_) => Err(f64::NAN),
        }
    }
}

/// Returns mantissa and exponent of a value that `dashu_float` has cut off.
fn parts(value: Approximation<FBig<Zero, 2>, Rounding>, bits: u32) -> (IBig, i64) {
    let exact = matches!(value, Approximation::Exact(_));
    let (mantissa, exponent) = value.value().into_repr().into_parts();
    if exact { (mantissa, exponent as i64) } else { beside(&mantissa, exponent as i64, true, bits) }
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

impl Neg for Float {
    type Output = Float;
    fn neg(self) -> Float {
        let value = match self.value {
            Nan => Nan,
            Infinite(sign) => Infinite(-sign),
            Finite(mantissa, exponent) => Finite(-mantissa, exponent),
        };
        Float { value, ..self }
    }
}

impl Neg for &Float {
    type Output = Float;
    fn neg(self) -> Float {
        -self.clone()
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident),*) => {$(
        impl<'a> $trait<&'a Float> for &'a Float {
            type Output = Operation<'a>;
            fn $method(self, other: &'a Float) -> Operation<'a> {
                Operation(Function::$trait, self, other)
            }
        }

        impl $trait<&Float> for Float {
            type Output = Float;
            fn $method(self, other: &Float) -> Float {
                Float::with_val(self.bits, $trait::$method(&self, other))
            }
        }

        impl $assign<&Float> for Float {
            fn $assign_method(&mut self, other: &Float) {
                *self = Float::with_val(self.bits, $trait::$method(&*self, other));
            }
        }

        operators!(@value $trait $method $assign $assign_method, Float |other| other);
        operators!(@value $trait $method $assign $assign_method, u32 |other| Float::with_val(32, other));
        operators!(@value $trait $method $assign $assign_method, i64 |other| Float::with_val(64, other));
    )*};
    (@value $trait:ident $method:ident $assign:ident $assign_method:ident, $type:ty |$value:ident| $float:expr) => {
        impl $trait<$type> for Float {
            type Output = Float;
            fn $method(self, $value: $type) -> Float {
                $trait::$method(self, &$float)
            }
        }

        impl $assign<$type> for Float {
            fn $assign_method(&mut self, $value: $type) {
                $assign::$assign_method(self, &$float);
            }
        }
    };
}
operators!(Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign);
operators!(Div div DivAssign div_assign);

macro_rules! shifts {
    ($($trait:ident $method:ident $type:ty: |$by:ident| $change:expr),*) => {$(
        impl $trait<$type> for Float {
            type Output = Float;
            fn $method(self, $by: $type) -> Float {
                match self.value {
                    Finite(mantissa, exponent) => {
                        round(mantissa, exponent.saturating_add($change), self.bits, Round::Nearest)
                    }
                    value => Float { value, ..self },
                }
            }
        }
    )*};
}
shifts!(Shl shl u32: |by| i64::from(by), Shr shr u32: |by| -i64::from(by), Shl shl i32: |by| i64::from(by));

impl ShrAssign<u32> for Float {
    fn shr_assign(&mut self, by: u32) {
        *self = self.clone() >> by;
    }
}

impl PartialEq for Float {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Float {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let (ours, theirs) = (self.kind(), other.kind());
        match (self.finite(), other.finite()) {
            (Some((m, e)), Some((n, f))) if ours == theirs && ours != 0.0 => {
                let (a, b) = if ours < 0.0 { (other, self) } else { (self, other) };
                let least = e.min(f);
                let in_full = || (m << (e - least) as usize).cmp(&(n << (f - least) as usize));
                Some(a.top().cmp(&b.top()).then_with(in_full))
            }
            _ => ours.partial_cmp(&theirs),
        }
    }
}

macro_rules! comparable {
    ($($type:ty: |$value:ident| $float:expr),*) => {$(
        impl PartialEq<$type> for Float {
            fn eq(&self, $value: &$type) -> bool {
                *self == $float
            }
        }

        impl PartialOrd<$type> for Float {
            fn partial_cmp(&self, $value: &$type) -> Option<Ordering> {
                self.partial_cmp(&$float)
            }
        }
    )*};
}
comparable!(i32: |n| Float::with_val(32, *n), u64: |n| Float::with_val(64, *n), f64: |x| Float::with_val(53, *x));

impl PartialEq<Rational> for Float {
    fn eq(&self, other: &Rational) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd<Rational> for Float {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        let infinite = || self.partial_cmp(&0);
        self.to_rational().map_or_else(infinite, |own| own.partial_cmp(other))
    }
}

impl fmt::Display for Float {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_string_radix(10, None))
    }
}
