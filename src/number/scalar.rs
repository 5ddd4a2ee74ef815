//! What a formula may ask of a number.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Number;

/// A comparison that what is known of its operands does not settle: an enclosure reaches to both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a comparison of enclosures is not settled by their ends")]
pub struct Open;

/// A field with an order: all that the undamped rod needs.
///
/// Neither `Copy` nor a nullary `zero()` is offered, because an arbitrary-precision number carries its precision with
/// it: constants are lifted from a neighbour, `t.int(2)`. Binary operations take the right operand by value or by
/// reference and the result has the precision of the left one: `a.clone() * &b + &c`.
pub trait Scalar:
    Clone
    + Debug
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + for<'a> Div<&'a Self, Output = Self>
    + Send
    + Sync
    + 'static
{
    /// What it takes to make a first number: nothing for `f64` and fractions, the number of bits for a `Float`.
    type Precision: Clone + Debug + Send + Sync;

    /// The number that a person wrote. **Accuracy**: correctly rounded (exact for fractions).
    fn from_number(number: &Number, precision: &Self::Precision) -> Self;

    /// The number that a person wrote, as a time that is asked for: it stands for exactly what it spells, and
    /// [`Scalar::spelled_as`] tells it from one that was computed.
    ///
    /// **Accuracy**: that of [`Scalar::from_number`].
    fn spelling(number: &Number, precision: &Self::Precision) -> Self {
        Self::from_number(number, precision)
    }

    /// How this is a [`Scalar::spelling`] that no computation has changed. Exact numbers and enclosures do not need it.
    fn spelled_as(&self) -> Option<Spelling> {
        None
    }

    /// The precision of this number.
    fn precision(&self) -> Self::Precision;

    /// An integer, in the precision of `self`.
    fn int(&self, n: i64) -> Self;

    /// A double, in the precision of `self` (exact if that is at least 53 bits).
    fn double(&self, x: f64) -> Self;

    /// `√self` where this system has it: `None` for a fraction that is no square and for negative numbers.
    fn try_sqrt(&self) -> Option<Self>;

    /// The nearest double. **Accuracy**: correctly rounded.
    fn to_f64(&self) -> f64;

    /// The unit roundoff `u` of this number's precision: `2⁻⁵³` for `f64`, zero for exact systems.
    fn roundoff(&self) -> Self {
        self.zero()
    }

    /// Bits of the significand; `None` for exact systems.
    fn bits(&self) -> Option<u32> {
        None
    }

    /// Whether the number is negative, zero or positive. A number that carries a bound is zero within it.
    ///
    /// **Errors**: [`Open`] where an enclosure does not tell.
    fn sign(&self) -> Result<Ordering, Open>;

    /// The sign of `self − other`.
    ///
    /// **Errors**: [`Open`], as [`Scalar::sign`].
    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Scalar::sign(&(self.clone() - other))
    }

    /// `self > 0`. Decided for an enclosure that touches zero from below. **Errors**: [`Open`].
    fn positive(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_gt())
    }

    /// `self < 0`. Decided for an enclosure that touches zero from above. **Errors**: [`Open`].
    fn negative(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_lt())
    }

    /// `self = 0`. **Errors**: [`Open`].
    fn vanishes(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_eq())
    }

    /// `self < other`. Decided for enclosures that only touch. **Errors**: [`Open`].
    fn below(&self, other: &Self) -> Result<bool, Open> {
        (self.clone() - other).negative()
    }

    /// `log₂` of how far the number meant may lie from the stored one: −∞ where it is exact.
    fn log2_error(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// The largest integer `≤ self`. **Errors**: `None` if it does not fit an `i64` or `self` is not finite.
    fn floor_int(&self) -> Option<i64>;

    /// Whether the number is finite (fractions always are).
    fn is_finite(&self) -> bool {
        true
    }

    /// The number to so many significant digits, correctly rounded; exact numbers as they are.
    fn decimal(&self, digits: u32) -> String {
        let _ = digits;
        self.text()
    }

    /// Both ends of an enclosure to ten digits more, rounded outwards; `None` for all other numbers.
    fn ends(&self, digits: u32) -> Option<[String; 2]> {
        let _ = digits;
        None
    }

    /// Whether both are stored alike. Two enclosures that were computed alike are, although no comparison says that the
    /// numbers in them are equal.
    fn alike(&self, other: &Self) -> bool {
        self.compare(other).is_ok_and(std::cmp::Ordering::is_eq)
    }

    /// How many of so many significant digits are proved: those of an enclosure in which both of its ends agree, one or
    /// two more where they agree in these only; all of other numbers.
    fn proved(&self, digits: u32) -> u32 {
        digits
    }

    /// The number, if it is a double.
    fn as_double(&self) -> Option<f64> {
        None
    }

    /// The shortest faithful text: `0.1` for a double, `3/2` for a fraction, all digits for a `Float`.
    fn text(&self) -> String;

    /// `log₂ u` of the unit roundoff `u`: −53 for `f64`, −∞ for exact systems.
    fn log2_roundoff(&self) -> f64 {
        self.bits().map_or(f64::NEG_INFINITY, |bits| -f64::from(bits))
    }

    /// The text of `self ± √square`, simplified where the system can: `3 + √2`.
    fn surd(&self, plus: bool, square: &Self) -> String {
        format!("{} {} √({})", self.text(), if plus { '+' } else { '−' }, square.text())
    }

    /// `p/q` in the precision of `self`, for formulas with fractional constants.
    fn ratio(&self, p: i64, q: i64) -> Self {
        self.int(p) / self.int(q)
    }

    /// The same number, known only up to `by` in either direction. Only enclosures hold that in themselves; elsewhere
    /// the caller counts it among the roundings.
    fn widened(self, by: &Self) -> Self {
        let _ = by;
        self
    }

    /// How far the number meant may lie from [`Scalar::to_f64`], but for the rounding of that: the width of an
    /// enclosure, zero elsewhere.
    fn width(&self) -> Self {
        self.zero()
    }

    /// Zero, in the precision of `self`.
    fn zero(&self) -> Self {
        self.int(0)
    }

    /// One, in the precision of `self`.
    fn one(&self) -> Self {
        self.int(1)
    }

    /// `self²`.
    fn square(&self) -> Self {
        self.clone() * self
    }

    /// `|self|`.
    fn magnitude(&self) -> Self {
        if self.negative() == Ok(true) { -self.clone() } else { self.clone() }
    }

    /// The greater of both.
    fn larger(self, other: Self) -> Self {
        if self.below(&other) == Ok(true) { other } else { self }
    }
}

/// A number system that rounds and carries no bound of it: `f64`, `Float`. [`Estimate`](super::Estimate) adds the
/// bound.
pub trait Rounded: Analytic + PartialOrd {
    /// Whether both are the same number but for eight roundings: `3 · 0.2` is `0.6`.
    fn meets(&self, other: &Self) -> bool {
        (self.clone() - other).magnitude() <= other.magnitude() * &self.roundoff() * &self.int(8)
    }

    /// `self < 0`.
    fn is_negative(&self) -> bool {
        *self < self.zero()
    }

    /// `self > 0`.
    fn is_positive(&self) -> bool {
        *self > self.zero()
    }

    /// `self = 0`.
    fn is_zero(&self) -> bool {
        *self == self.zero()
    }

    /// The unit roundoff `u` as a double, no less than the least normal one.
    fn unit(&self) -> f64;

    /// `|self|/u`.
    fn in_roundoffs(&self) -> f64;
}

/// A number system in which the numbers of another can be read: each stays within the bound that it carries.
pub trait Reads<N: Scalar>: Scalar {
    /// The number in this system, rounded once, its bound with it.
    fn read(number: N) -> Self;

    /// A number of this system in the other one, where a question about it is answered. A double stands for the
    /// shortest decimal that spells it, or for a simple fraction.
    fn give(&self, precision: &N::Precision) -> N;
}

/// How a rounded number was spelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spelling {
    /// As the shortest decimal that is rounded to it, or, in longer numbers, anyhow.
    Decimal,
    /// As a simple fraction.
    Fraction,
    /// As another number that is rounded to it.
    Near,
}

/// A `Scalar` with the elementary functions: what the damped rod needs. Where a signature asks for it, exactness ends.
///
/// **Accuracy**: correctly rounded for `rug::Float`; within an ulp or two for `f64`.
pub trait Analytic: Scalar {
    /// `√self`.
    fn sqrt(&self) -> Self;
    /// `eˣ`.
    fn exp(&self) -> Self;
    /// `eˣ − 1` without cancellation near zero.
    fn exp_m1(&self) -> Self;
    /// `ln x`.
    fn ln(&self) -> Self;
    /// `ln(1 + x)` without cancellation near zero.
    fn ln_1p(&self) -> Self;
    /// `cos x`.
    fn cos(&self) -> Self;
    /// `sin x`.
    fn sin(&self) -> Self;
    /// `π`, in the precision of `self`.
    fn pi(&self) -> Self;
}
