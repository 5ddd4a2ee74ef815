//! Floats of any number of bits in pure Rust: the part of `rug::Float` that this library uses.
//!
//! Sums, products, quotients and roots are integers of `dashu_int`, cut off with a mark of whether anything was cut
//! off; elementary functions are those of `dashu_float`, cut off in the same way. [`round`] alone rounds.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Shl, Shr, ShrAssign, Sub, SubAssign};

use dashu_base::Approximation;
use dashu_float::round::mode::Zero;
use dashu_float::{Context, FBig, FpError, FpResult, Repr};
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

/// A value that is no number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Special {
    /// No number.
    Nan,
    Infinity,
    NegInfinity,
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

/// The result of an operation, not rounded yet.
#[derive(Clone, Copy, Debug)]
pub enum Operation<'a> {
    #[doc(hidden)]
    Sum(&'a Float, &'a Float, Sign),
    #[doc(hidden)]
    Product(&'a Float, &'a Float),
    #[doc(hidden)]
    Quotient(&'a Float, &'a Float),
    #[doc(hidden)]
    Reciprocal(&'a Float),
    #[doc(hidden)]
    Root(&'a Float),
    #[doc(hidden)]
    Elementary(Function, &'a Float),
}

#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
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

/// A magnitude `mantissa · 2^exponent`, and whether more was cut off, less than a unit of it.
struct Cut {
    sign: Sign,
    mantissa: UBig,
    exponent: i64,
    more: bool,
}

impl Cut {
    fn exact(mantissa: IBig, exponent: i64) -> Self {
        let (sign, mantissa) = mantissa.into_parts();
        Cut { sign, mantissa, exponent, more: false }
    }

    /// Rounds the number. The mantissa is extended first if what was cut off is to be seen behind its last bit.
    fn round(mut self, bits: u32, round: Round) -> Float {
        let (room, negative) = (bits as usize, self.sign == Sign::Negative);
        if self.more && self.mantissa.bit_len() < room + 2 {
            let by = room + 2 - self.mantissa.bit_len();
            self.mantissa <<= by;
            self.exponent -= by as i64;
        }
        let drop = self.mantissa.bit_len().saturating_sub(room);
        if drop > 0 {
            let below = self.more || drop > 1 && self.mantissa.trailing_zeros().is_some_and(|zeros| zeros < drop - 1);
            let half = self.mantissa.bit(drop - 1);
            let away = match round {
                Round::Nearest => half && (below || self.mantissa.bit(drop)),
                Round::Down => negative && (half || below),
                Round::Up => !negative && (half || below),
                Round::AwayZero => half || below,
            };
            self.mantissa >>= drop;
            self.exponent += drop as i64;
            if away {
                self.mantissa += 1u8;
            }
        }
        let top = self.exponent.saturating_add(self.mantissa.bit_len() as i64);
        if self.mantissa.is_zero() || top.abs() <= MOST_EXPONENT {
            return Float { bits, value: Finite(IBig::from_parts(self.sign, self.mantissa), self.exponent) };
        }
        let outwards = match round {
            Round::Nearest => top > 0,
            Round::Down => negative,
            Round::Up => !negative,
            Round::AwayZero => true,
        };
        let value = match (top > 0, outwards) {
            (true, true) => Infinite(self.sign),
            (true, false) => Finite(IBig::from_parts(self.sign, UBig::ones(room)), MOST_EXPONENT - room as i64),
            (false, true) => Finite(IBig::from_parts(self.sign, UBig::ONE), -MOST_EXPONENT - 1),
            (false, false) => Finite(IBig::ZERO, 0),
        };
        Float { bits, value }
    }
}

/// Returns a value beyond all exponents, or one below them.
fn beyond(sign: Sign, great: bool) -> Cut {
    Cut { sign, mantissa: UBig::ONE, exponent: if great { 4 } else { -4 } * MOST_EXPONENT, more: false }
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
        let sign = match &self.value {
            Nan => return None,
            Infinite(sign) => *sign,
            Finite(mantissa, _) if mantissa.is_zero() => return Some(Ordering::Equal),
            Finite(mantissa, _) => mantissa.sign(),
        };
        Some(if sign == Sign::Negative { Ordering::Less } else { Ordering::Greater })
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
        let mantissa = match &self.value {
            Nan => return f64::NAN,
            Infinite(sign) => return f64::INFINITY * unit(*sign),
            Finite(mantissa, _) => mantissa,
        };
        let (top, sign) = (self.top(), unit(mantissa.sign()));
        let outwards = match round {
            Round::Nearest => top != -1074 || mantissa.unsigned_abs().trailing_zeros() == Some(mantissa.bit_len() - 1),
            Round::Down => sign < 0.0,
            Round::Up => sign > 0.0,
            Round::AwayZero => true,
        };
        if mantissa.is_zero() {
            return 0.0;
        } else if top < -1073 {
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

    pub(crate) fn factorial(n: u32) -> IBig {
        (1..=n).fold(IBig::ONE, |product, k| product * k)
    }

    /// Returns the square root in the bits of the number.
    pub fn sqrt(self) -> Self {
        Float::with_val(self.bits, self.sqrt_ref())
    }

    /// Returns the exponential in the bits of the number.
    pub fn exp(self) -> Self {
        Float::with_val(self.bits, self.exp_ref())
    }

    pub(crate) fn recip_ref(&self) -> Operation<'_> {
        Operation::Reciprocal(self)
    }

    pub(crate) fn sqrt_ref(&self) -> Operation<'_> {
        Operation::Root(self)
    }

    pub(crate) fn square_ref(&self) -> Operation<'_> {
        Operation::Product(self, self)
    }
}

macro_rules! elementary {
    ($($name:ident $function:ident),*) => {
        impl Float {
            $(pub(crate) fn $name(&self) -> Operation<'_> {
                Operation::Elementary(Function::$function, self)
            })*
        }
    };
}
elementary!(exp_ref Exp, exp_m1_ref ExpM1, ln_ref Ln, ln_1p_ref Ln1p, sin_ref Sin, cos_ref Cos);

impl Unrounded for Operation<'_> {
    fn rounded(self, bits: u32, round: Round) -> Float {
        match self {
            Operation::Sum(a, b, sign) => add(a, b, sign, bits, round),
            Operation::Product(a, b) => match (&a.value, &b.value) {
                (Finite(m, e), Finite(n, f)) => Cut::exact(m * n, e + f).round(bits, round),
                _ => special(bits, signs(a, b)),
            },
            Operation::Quotient(a, b) => match (&a.value, &b.value) {
                (Finite(m, e), Finite(n, f)) if !n.is_zero() => {
                    let sign = m.sign() * n.sign();
                    let by = (bits as usize + 2 + n.bit_len()).saturating_sub(m.bit_len());
                    let (mantissa, rest) = (m.unsigned_abs() << by).div_rem(n.unsigned_abs());
                    Cut { sign, mantissa, exponent: e - f - by as i64, more: !rest.is_zero() }.round(bits, round)
                }
                (Finite(..), Infinite(_)) => Float::new(bits),
                (Infinite(_), Infinite(_)) => special(bits, None),
                (Finite(m, _), Finite(..)) if m.is_zero() => special(bits, None),
                (_, Finite(n, _)) if n.is_zero() => special(bits, sign(a)),
                _ => special(bits, signs(a, b)),
            },
            Operation::Reciprocal(x) => (&Float::with_val(1, 1) / x).rounded(bits, round),
            Operation::Root(x) => match &x.value {
                Finite(m, e) if m.sign() == Sign::Positive => {
                    let by = (2 * bits as usize + 4).saturating_sub(m.bit_len());
                    let by = by + usize::from((e - by as i64) % 2 != 0);
                    let (mantissa, rest) = (m.unsigned_abs() << by).sqrt_rem();
                    let exponent = (e - by as i64) / 2;
                    Cut { sign: Sign::Positive, mantissa, exponent, more: !rest.is_zero() }.round(bits, round)
                }
                Infinite(Sign::Positive) => special(bits, Some(Sign::Positive)),
                _ => special(bits, None),
            },
            Operation::Elementary(function, x) => function.rounded(x, bits, round),
        }
    }
}

/// Returns 1 or −1.
fn unit(sign: Sign) -> f64 {
    if sign == Sign::Negative { -1.0 } else { 1.0 }
}

/// Returns an infinity with this sign, or no number.
fn special(bits: u32, sign: Option<Sign>) -> Float {
    Float { bits, value: sign.map_or(Nan, Infinite) }
}

fn sign(x: &Float) -> Option<Sign> {
    match x.cmp0()? {
        Ordering::Less => Some(Sign::Negative),
        Ordering::Equal => None,
        Ordering::Greater => Some(Sign::Positive),
    }
}

/// Returns the sign of a product; `None` if a factor is zero or no number.
fn signs(a: &Float, b: &Float) -> Option<Sign> {
    Some(sign(a)? * sign(b)?)
}

/// Returns `a + b` or `a − b`.
fn add(a: &Float, b: &Float, minus: Sign, bits: u32, round: Round) -> Float {
    let (m, e, n, f) = match (&a.value, &b.value) {
        (Finite(m, e), Finite(n, f)) => (m, *e, n, *f),
        (Nan, _) | (_, Nan) => return special(bits, None),
        (Infinite(a), Infinite(b)) => return special(bits, (*a == *b * minus).then_some(*a)),
        (Infinite(a), _) => return special(bits, Some(*a)),
        (_, Infinite(b)) => return special(bits, Some(*b * minus)),
    };
    if n.is_zero() {
        return Cut::exact(m.clone(), e).round(bits, round);
    } else if m.is_zero() {
        return Cut::exact(n.clone() * minus, f).round(bits, round);
    }
    let (great, low, small, sign, other) = match a.top() >= b.top() {
        true => (m, e, b.top(), m.sign(), n.sign() * minus),
        false => (n, f, a.top(), n.sign() * minus, m.sign()),
    };
    // The lesser number is below the last bit, of so many that it does not matter how far.
    let room = (bits as usize + 3).saturating_sub(great.bit_len());
    if small < low - room as i64 {
        let mantissa = great.unsigned_abs() << room;
        let mantissa = if sign == other { mantissa } else { mantissa - UBig::ONE };
        return Cut { sign, mantissa, exponent: low - room as i64, more: true }.round(bits, round);
    }
    let exponent = e.min(f);
    let total = (m << (e - exponent) as usize) + (n << (f - exponent) as usize) * minus;
    Cut::exact(total, exponent).round(bits, round)
}

impl Function {
    /// Rounds the function, by [`Function::near`] or cut off by `dashu_float`.
    fn rounded(self, x: &Float, bits: u32, round: Round) -> Float {
        use Function::{Cos, Exp, ExpM1, Ln, Ln1p, Sin};
        let one = || Float::with_val(bits, 1);
        let (mantissa, exponent) = match &x.value {
            Finite(mantissa, exponent) => (mantissa, *exponent),
            Infinite(Sign::Positive) if matches!(self, Exp | ExpM1 | Ln | Ln1p) => return special(bits, sign(x)),
            Infinite(Sign::Negative) if self == Exp => return Float::new(bits),
            Infinite(Sign::Negative) if self == ExpM1 => return -one(),
            _ => return special(bits, None),
        };
        let (top, negative) = (x.top(), mantissa.sign() == Sign::Negative);
        let exact = match self {
            Exp | Cos if mantissa.is_zero() => Some(one()),
            ExpM1 | Ln1p | Sin if mantissa.is_zero() => Some(Float::new(bits)),
            Ln if mantissa.is_zero() => Some(special(bits, Some(Sign::Negative))),
            Ln if *x == 1 => Some(Float::new(bits)),
            Ln1p if *x == -1 => Some(special(bits, Some(Sign::Negative))),
            _ => None,
        };
        if let Some(exact) = exact {
            return exact;
        }
        let cut = match self {
            Exp | ExpM1 if top > 34 && !negative => beyond(Sign::Positive, true),
            Exp if top > 34 => beyond(Sign::Positive, false),
            ExpM1 if top > 34 => next_to(&IBig::NEG_ONE, 0, false, bits),
            Sin | Cos if top > MOST_ANGLE => return special(bits, None),
            _ if self != Ln && top < -i64::from(bits.max(mantissa.bit_len() as u32)) - 8 => match self {
                Exp => next_to(&IBig::ONE, 0, !negative, bits),
                Cos => next_to(&IBig::ONE, 0, false, bits),
                ExpM1 => next_to(mantissa, exponent, !negative, bits),
                Ln1p => next_to(mantissa, exponent, negative, bits),
                _ => next_to(mantissa, exponent, false, bits),
            },
            _ => match self.cut(&Repr::new(mantissa.clone(), exponent as isize), bits as usize + 2) {
                Ok(value) => {
                    let (value, more) = match value {
                        Approximation::Exact(value) => (value, false),
                        Approximation::Inexact(value, _) => (value, true),
                    };
                    let (mantissa, exponent) = value.into_repr().into_parts();
                    Cut { more, ..Cut::exact(mantissa, exponent as i64) }
                }
                Err(FpError::Overflow(sign)) => beyond(sign, true),
                Err(FpError::Underflow(sign)) => beyond(sign, false),
                Err(_) => return special(bits, None),
            },
        };
        cut.round(bits, round)
    }

    fn cut(self, x: &Repr<2>, bits: usize) -> FpResult<FBig<Zero, 2>> {
        let context = Context::<Zero>::new(bits);
        match self {
            Function::Exp => context.exp(x, None),
            Function::ExpM1 => context.exp_m1(x, None),
            Function::Ln => context.ln(x, None),
            Function::Ln1p => context.ln_1p(x, None),
            Function::Sin => context.sin(x, None),
            Function::Cos => context.cos(x, None),
        }
    }
}

/// Returns a number slightly farther from zero, or slightly nearer, than `mantissa · 2^exponent`: by less than a unit
/// of its last bit, and of the third bit beyond `bits`.
fn next_to(mantissa: &IBig, exponent: i64, farther: bool, bits: u32) -> Cut {
    let by = (bits as usize + 3).saturating_sub(mantissa.bit_len());
    let (sign, size) = (mantissa.sign(), mantissa.unsigned_abs() << by);
    let mantissa = if farther { size } else { size - UBig::ONE };
    Cut { sign, mantissa, exponent: exponent - by as i64, more: true }
}

macro_rules! from_integers {
    ($($type:ty),*) => {$(
        impl Unrounded for $type {
            fn rounded(self, bits: u32, round: Round) -> Float {
                Cut::exact(IBig::from(self), 0).round(bits, round)
            }
        }
    )*};
}
from_integers!(i32, i64, u32, u64, IBig);

impl Unrounded for &IBig {
    fn rounded(self, bits: u32, round: Round) -> Float {
        self.clone().rounded(bits, round)
    }
}

impl Unrounded for f64 {
    fn rounded(self, bits: u32, round: Round) -> Float {
        match Repr::<2>::try_from(self) {
            Ok(value) if value.is_finite() => {
                let (mantissa, exponent) = value.into_parts();
                Cut::exact(mantissa, exponent as i64).round(bits, round)
            }
            _ if self.is_nan() => special(bits, None),
            _ => special(bits, Some(if self < 0.0 { Sign::Negative } else { Sign::Positive })),
        }
    }
}

impl Unrounded for &f64 {
    fn rounded(self, bits: u32, round: Round) -> Float {
        (*self).rounded(bits, round)
    }
}

impl Unrounded for &Float {
    fn rounded(self, bits: u32, round: Round) -> Float {
        match &self.value {
            Finite(mantissa, exponent) => Cut::exact(mantissa.clone(), *exponent).round(bits, round),
            value => Float { bits, value: value.clone() },
        }
    }
}

impl Unrounded for Float {
    fn rounded(self, bits: u32, round: Round) -> Float {
        (&self).rounded(bits, round)
    }
}

impl Unrounded for &Rational {
    fn rounded(self, bits: u32, round: Round) -> Float {
        let whole = |n: IBig| Float { bits, value: Finite(n, 0) };
        (&whole(self.numerator().clone()) / &whole(self.denominator().clone().into())).rounded(bits, round)
    }
}

impl Unrounded for Rational {
    fn rounded(self, bits: u32, round: Round) -> Float {
        (&self).rounded(bits, round)
    }
}

impl Unrounded for Constant {
    fn rounded(self, bits: u32, round: Round) -> Float {
        let (mantissa, exponent) =
            Context::<Zero>::new(bits as usize + 2).pi::<2>(None).value().into_repr().into_parts();
        Cut { more: true, ..Cut::exact(mantissa, exponent as i64) }.round(bits, round)
    }
}

impl Unrounded for Special {
    fn rounded(self, bits: u32, _: Round) -> Float {
        match self {
            Special::Nan => special(bits, None),
            Special::Infinity => special(bits, Some(Sign::Positive)),
            Special::NegInfinity => special(bits, Some(Sign::Negative)),
        }
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
            _ => Float::with_val(self.bits, Special::Nan),
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
    ($($trait:ident $method:ident $assign:ident $assign_method:ident, |$a:ident, $b:ident| $operation:expr;)*) => {$(
        impl<'a> $trait<&'a Float> for &'a Float {
            type Output = Operation<'a>;
            fn $method(self, other: &'a Float) -> Operation<'a> {
                let ($a, $b) = (self, other);
                $operation
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
operators! {
    Add add AddAssign add_assign, |a, b| Operation::Sum(a, b, Sign::Positive);
    Sub sub SubAssign sub_assign, |a, b| Operation::Sum(a, b, Sign::Negative);
    Mul mul MulAssign mul_assign, |a, b| Operation::Product(a, b);
    Div div DivAssign div_assign, |a, b| Operation::Quotient(a, b);
}

impl Shl<u32> for Float {
    type Output = Float;
    fn shl(self, by: u32) -> Float {
        self.scaled(i64::from(by))
    }
}

impl Shr<u32> for Float {
    type Output = Float;
    fn shr(self, by: u32) -> Float {
        self.scaled(-i64::from(by))
    }
}

impl Shl<i32> for Float {
    type Output = Float;
    fn shl(self, by: i32) -> Float {
        self.scaled(i64::from(by))
    }
}

impl ShrAssign<u32> for Float {
    fn shr_assign(&mut self, by: u32) {
        *self = self.clone() >> by;
    }
}

impl Float {
    fn scaled(self, by: i64) -> Float {
        match self.value {
            Finite(mantissa, exponent) => Cut::exact(mantissa, exponent + by).round(self.bits, Round::Nearest),
            value => Float { value, ..self },
        }
    }
}

impl PartialEq for Float {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Float {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let (ours, theirs) = (self.cmp0()?, other.cmp0()?);
        if ours != theirs || ours.is_eq() {
            return Some(ours.cmp(&theirs));
        }
        let (Some((m, e)), Some((n, f))) = (self.finite(), other.finite()) else {
            let order = self.is_infinite().cmp(&other.is_infinite());
            return Some(if ours.is_lt() { order.reverse() } else { order });
        };
        let tops = self.top().cmp(&other.top());
        if tops.is_ne() {
            return Some(if ours.is_lt() { tops.reverse() } else { tops });
        }
        let exponent = e.min(f);
        Some((m << (e - exponent) as usize).cmp(&(n << (f - exponent) as usize)))
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
