//! Operations that formulas require of a number.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Number, Spelling};

/// A comparison that remains undecided: an enclosure extends to both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a comparison of enclosures is not settled by their ends")]
pub struct Open;

/// An ordered field: the operations that the undamped rod needs.
///
/// The trait offers neither `Copy` nor a nullary `zero()`, because an arbitrary-precision number carries its precision:
/// constants are lifted from a neighbour, `t.int(2)`. Binary operations take the right operand by value or by
/// reference; the result has the precision of the left operand: `a.clone() * &b + &c`.
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
    /// The precision of a new number: nothing for `f64` and fractions, the number of bits for a `Float`.
    type Precision: Clone + Debug + Send + Sync;

    /// Converts a number that a person wrote. **Accuracy**: correctly rounded (exact for fractions).
    fn from_number(number: &Number, precision: &Self::Precision) -> Self;

    /// Converts a number that a person wrote as a time of a query: it represents exactly the number that it spells, and
    /// [`Scalar::spelled_as`] distinguishes it from a computed number.
    ///
    /// **Accuracy**: that of [`Scalar::from_number`].
    fn spelling(number: &Number, precision: &Self::Precision) -> Self {
        Self::from_number(number, precision)
    }

    /// Returns the kind of spelling if this is a [`Scalar::spelling`] that no computation has changed. Exact numbers
    /// and enclosures do not need it.
    fn spelled_as(&self) -> Option<Spelling> {
        None
    }

    /// Returns the precision of this number.
    fn precision(&self) -> Self::Precision;

    /// Converts an integer to the precision of `self`.
    fn int(&self, n: i64) -> Self;

    /// Converts a double to the precision of `self` (exact with at least 53 bits). Fractions have no infinities.
    fn double(&self, x: f64) -> Self;

    /// Returns `√self` if this system has it: `None` for a fraction that is not a square and for negative numbers.
    fn try_sqrt(&self) -> Option<Self>;

    /// Returns the nearest double; of an interval, that of the end farther from zero, rounded away from zero.
    ///
    /// **Accuracy**: correctly rounded.
    fn to_f64(&self) -> f64;

    /// Returns the unit roundoff `u` of this number's precision: `2⁻⁵³` for `f64`, zero for exact systems.
    fn roundoff(&self) -> Self {
        self.zero()
    }

    /// Returns the number of bits of the significand; `None` for exact systems.
    fn bits(&self) -> Option<u32> {
        None
    }

    /// Returns whether the number is negative, zero or positive. A number with a bound counts as zero within the bound.
    ///
    /// **Errors**: [`Open`] if an enclosure does not decide.
    fn sign(&self) -> Result<Ordering, Open>;

    /// Returns the sign of `self − other`.
    ///
    /// **Errors**: [`Open`], as [`Scalar::sign`].
    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Scalar::sign(&(self.clone() - other))
    }

    /// Returns `self > 0`; also decided for an enclosure that touches zero from below. **Errors**: [`Open`].
    fn positive(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_gt())
    }

    /// Returns `self < 0`; also decided for an enclosure that touches zero from above. **Errors**: [`Open`].
    fn negative(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_lt())
    }

    /// Returns `self = 0`. **Errors**: [`Open`].
    fn vanishes(&self) -> Result<bool, Open> {
        Ok(Scalar::sign(self)?.is_eq())
    }

    /// Returns `self < other`; also decided for enclosures that only touch. **Errors**: [`Open`].
    fn below(&self, other: &Self) -> Result<bool, Open> {
        (self.clone() - other).negative()
    }

    /// Returns `log₂` of the bound of the distance between the stored and the true number: −∞ if it is exact.
    fn log2_error(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// Returns the largest integer `≤ self`. **Errors**: `None` if it does not fit an `i64` or `self` is not finite.
    fn floor_int(&self) -> Option<i64>;

    /// Returns whether the number is finite (fractions always are).
    fn is_finite(&self) -> bool {
        true
    }

    /// Returns the number to this many significant digits, correctly rounded; an exact number in full.
    fn decimal(&self, digits: u32) -> String {
        let _ = digits;
        self.text()
    }

    /// Returns both ends of an enclosure with ten more digits, rounded outwards; `None` for all other numbers.
    fn ends(&self, digits: u32) -> Option<[String; 2]> {
        let _ = digits;
        None
    }

    /// Returns whether both are stored alike. Two enclosures from the same computation are, although no comparison
    /// proves the numbers in them equal.
    fn alike(&self, other: &Self) -> bool {
        self.compare(other).is_ok_and(std::cmp::Ordering::is_eq)
    }

    /// Returns the number of proved significant digits, out of `digits`. For an enclosure these are the digits in which
    /// both ends agree, or one or two more than `digits` if the ends agree only there; other numbers prove all digits.
    fn proved(&self, digits: u32) -> u32 {
        digits
    }

    /// Returns the number if it is a double.
    fn as_double(&self) -> Option<f64> {
        None
    }

    /// Returns the shortest faithful text: `0.1` for a double, `3/2` for a fraction, all digits for a `Float`.
    fn text(&self) -> String;

    /// Returns `log₂ u` of the unit roundoff `u`: −53 for `f64`, −∞ for exact systems.
    fn log2_roundoff(&self) -> f64 {
        self.bits().map_or(f64::NEG_INFINITY, |bits| -f64::from(bits))
    }

    /// Returns the text of `self ± √square`, simplified if the system can: `3 + √2`.
    fn surd(&self, plus: bool, square: &Self) -> String {
        format!("{} {} √({})", self.text(), if plus { '+' } else { '−' }, square.text())
    }

    /// Returns the square root of a positive number within `2⁻¹⁰⁰` of itself, if the system holds as many bits: one
    /// Newton step doubles the 53 correct bits of a double. Zero below the range of doubles.
    ///
    /// ```
    /// use dalembert::Rational;
    /// use dalembert::number::Scalar;
    /// let root = Rational::from(2).near_sqrt();
    /// assert!(Scalar::to_f64(&(Scalar::square(&root) - Rational::from(2))).abs() < 1e-29);
    /// let small = (0..5).fold(root.ratio(1, 10_i64.pow(18)), |x, _| Scalar::square(&x));
    /// assert_eq!(small.near_sqrt(), Rational::from(0));
    /// ```
    fn near_sqrt(&self) -> Self {
        let root = self.double(self.to_f64().sqrt());
        if root.to_f64() == 0.0 { root } else { (self.clone() / &root + &root) / self.int(2) }
    }

    /// Returns `p/q` in the precision of `self`, for formulas with fractional constants.
    fn ratio(&self, p: i64, q: i64) -> Self {
        self.int(p) / self.int(q)
    }

    /// Returns the number with an uncertainty of `by` in either direction. Enclosures and estimates hold the
    /// uncertainty; in other systems the caller adds it to the roundings.
    fn widened(self, by: &Self) -> Self {
        let _ = by;
        self
    }

    /// Returns the bound of the distance of the true number from [`Scalar::to_f64`], apart from the rounding of that
    /// double: the width of an enclosure, zero for other numbers.
    fn width(&self) -> Self {
        self.zero()
    }

    /// Returns zero in the precision of `self`.
    fn zero(&self) -> Self {
        self.int(0)
    }

    /// Returns one in the precision of `self`.
    fn one(&self) -> Self {
        self.int(1)
    }

    /// Returns `self²`.
    fn square(&self) -> Self {
        self.clone() * self
    }

    /// Returns `|self|`.
    fn magnitude(&self) -> Self {
        if self.negative() == Ok(true) { -self.clone() } else { self.clone() }
    }

    /// Returns the greater of both.
    fn larger(self, other: Self) -> Self {
        if self.below(&other) == Ok(true) { other } else { self }
    }
}

/// A number system that rounds without an error bound: `f64`, `Float`. [`Estimate`](super::Estimate) adds it.
pub trait Rounded: Analytic + PartialOrd {
    /// Returns whether both numbers are equal within eight roundings: `3 · 0.2` is `0.6`.
    fn meets(&self, other: &Self) -> bool {
        (self.clone() - other).magnitude() <= other.magnitude() * &self.roundoff() * &self.int(8)
    }

    /// Returns `self < 0`.
    fn is_negative(&self) -> bool {
        *self < self.zero()
    }

    /// Returns `self > 0`.
    fn is_positive(&self) -> bool {
        *self > self.zero()
    }

    /// Returns `self = 0`.
    fn is_zero(&self) -> bool {
        *self == self.zero()
    }

    /// Returns the unit roundoff `u` as a double, but at least the least normal double.
    fn unit(&self) -> f64;

    /// Returns `|self|/u`.
    fn in_roundoffs(&self) -> f64;
}

/// A number system that can read the numbers of another: each stays within the bound that it carries.
pub trait Reads<N: Scalar>: Scalar {
    /// Converts the number to this system, rounded once, together with its bound.
    fn read(number: N) -> Self;

    /// Converts a number of this system to the other one, which answers a question about it. A double represents the
    /// shortest decimal that rounds to it, or a simple fraction.
    fn give(&self, precision: &N::Precision) -> N;
}

/// A `Scalar` with the elementary functions that the damped rod needs. A signature with this trait is not exact.
///
/// **Accuracy**: correctly rounded for `rug::Float`; within an ulp or two for `f64`.
pub trait Analytic: Scalar {
    /// Returns `√self`.
    fn sqrt(&self) -> Self;
    /// Returns `eˣ`.
    fn exp(&self) -> Self;
    /// Returns `eˣ − 1` without cancellation near zero.
    fn exp_m1(&self) -> Self;
    /// Returns `ln x`.
    fn ln(&self) -> Self;
    /// Returns `ln(1 + x)` without cancellation near zero.
    fn ln_1p(&self) -> Self;
    /// Returns `cos x`.
    fn cos(&self) -> Self;
    /// Returns `sin x`.
    fn sin(&self) -> Self;
    /// Returns `π` in the precision of `self`.
    fn pi(&self) -> Self;
}
