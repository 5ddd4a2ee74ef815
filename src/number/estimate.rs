//! Rounded numbers with a bound of their own error.

use std::cmp::Ordering;
use std::ops::Neg;

use super::spelling::spelling;
use super::{Analytic, Number, Open, Rounded, Scalar, Spelling};

/// Returns the bound, in roundings, that marks a number as spelled; its true error is at most one. No operation on a
/// spelled number gives such a bound, except for negation: a rounding adds at least one, halving and doubling add the
/// least part that a double holds.
fn roundings(spelling: Spelling) -> f64 {
    match spelling {
        Spelling::Decimal => 1.25,
        Spelling::Fraction => 1.75,
        Spelling::Near => 1.5,
    }
}

/// A rounded number with a bound of its distance from the true number, carried through every operation.
///
/// The error is counted in roundoffs `u` of the number system, so that it neither underflows nor overflows for numbers
/// with thousands of bits: the true number lies within `error · u` of the value.
///
/// **Accuracy**: *within its own bound*. Each operation propagates the errors of its operands, products of two errors
/// included, and adds one rounding of its result; an elementary function adds two.
///
/// ```
/// use dalembert::Estimate;
/// use dalembert::number::Scalar;
/// let tenth = Estimate::rounded(0.1, 1.0);
/// let sum = tenth.clone() + &tenth + &tenth;
/// // 0.1 + 0.1 + 0.1 is no double, and not the double 0.3 either; within the bound it is.
/// assert_ne!(*sum.value(), 0.3);
/// assert!((sum - Estimate::rounded(0.3, 1.0)).vanishes()?);
/// # Ok::<(), dalembert::number::Open>(())
/// ```
#[derive(Clone, Debug)]
pub struct Estimate<S> {
    value: S,
    error: f64,
}

impl<S> Estimate<S> {
    /// Returns `value` with a bound of `error` roundoffs.
    #[inline]
    pub fn new(value: S, error: f64) -> Self {
        Estimate { value, error }
    }

    /// Returns `value` as an exact number.
    #[inline]
    pub fn exact(value: S) -> Self {
        Estimate { value, error: 0.0 }
    }

    /// Returns the value.
    #[inline]
    pub fn value(&self) -> &S {
        &self.value
    }

    /// Adds this many roundoffs to the bound.
    #[inline]
    pub(super) fn widen(&mut self, roundoffs: f64) {
        self.error += roundoffs;
    }

    /// Returns the value without its bound.
    pub fn into_value(self) -> S {
        self.value
    }

    /// Returns the error bound in roundoffs.
    #[inline]
    pub fn error(&self) -> f64 {
        self.error
    }
}

impl<S: Rounded> Estimate<S> {
    /// Returns `value` with a bound of this many roundings of itself.
    #[inline]
    pub fn rounded(value: S, roundings: f64) -> Self {
        let error = roundings * size(&value);
        Estimate { value, error }
    }

    /// Returns the error bound as a double.
    #[inline]
    pub fn bound(&self) -> f64 {
        self.error * self.value.unit()
    }

    /// Returns the error bound in roundoffs if zero replaces the number.
    #[inline]
    pub(super) fn error_of_zero(&self) -> f64 {
        self.error + self.value.in_roundoffs()
    }

    /// Returns `value` with the propagated `error` of the operands plus one rounding.
    #[inline]
    fn once(value: S, error: f64) -> Self {
        let error = error + size(&value);
        Estimate { value, error }
    }

    /// Returns `f(x)` with two roundings, where `|f′| ≤ slope` within the error of x.
    fn function(&self, value: S, slope: f64) -> Self {
        let error = if self.error == 0.0 { 0.0 } else { self.error * slope };
        Estimate { error: error + 2.0 * size(&value), value }
    }

    /// Returns `√(e u)` in roundoffs: the error of the square root of a number that may be zero.
    fn root_of_error(&self) -> f64 {
        (self.error.log2() / 2.0 - self.value.log2_roundoff() / 2.0).exp2()
    }

    #[inline]
    fn plus(self, other: &Self) -> Self {
        Estimate::once(self.value + &other.value, self.error + other.error)
    }

    #[inline]
    fn minus(self, other: &Self) -> Self {
        Estimate::once(self.value - &other.value, self.error + other.error)
    }

    #[inline]
    fn times(self, other: &Self) -> Self {
        let (a, b) = (self.value.to_f64().abs(), other.value.to_f64().abs());
        // This order keeps a product of errors in the range of doubles.
        let both = self.error * self.value.unit() * other.error;
        Estimate::once(self.value * &other.value, a * other.error + b * self.error + both)
    }

    /// Divides with the bound `|a/b − a′/b′| ≤ (|a − a′| + |a/b| |b − b′|)/|b′|`.
    #[inline]
    fn over(self, other: &Self) -> Self {
        let least = other.value.to_f64().abs() - other.bound();
        let value = self.value / &other.value;
        let error = self.error + value.to_f64().abs() * other.error;
        // An exact divisor contributes no error, whatever its value.
        let error = if least > 0.0 {
            error / least
        } else if other.error == 0.0 && error == 0.0 {
            0.0
        } else {
            f64::INFINITY
        };
        Estimate::once(value, error)
    }
}

operators!([S: Rounded] Estimate<S>);

/// Returns the size of one rounding of `value`, in roundoffs: `|value|`, but at least the least normal double unless
/// the value is zero. Below that, doubles round more coarsely, and a long number has no size as a double.
#[inline]
fn size<S: Rounded>(value: &S) -> f64 {
    let size = value.to_f64().abs();
    if size >= f64::MIN_POSITIVE || value.sign() == Ok(Ordering::Equal) { size } else { f64::MIN_POSITIVE }
}

impl<S: Rounded> Neg for Estimate<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Estimate { value: -self.value, error: self.error }
    }
}

impl<S: Rounded> Scalar for Estimate<S> {
    type Precision = S::Precision;

    fn from_number(number: &Number, precision: &S::Precision) -> Self {
        Estimate::rounded(S::from_number(number, precision), 1.0)
    }

    fn spelling(number: &Number, precision: &S::Precision) -> Self {
        let value = S::from_number(number, precision);
        let spelling = value.as_double().map_or(Spelling::Decimal, |double| spelling(double, number));
        Estimate::rounded(value, roundings(spelling))
    }

    fn spelled_as(&self) -> Option<Spelling> {
        let size = size(&self.value);
        let as_this = |spelling: &Spelling| self.error == roundings(*spelling) * size;
        [Spelling::Decimal, Spelling::Fraction, Spelling::Near].into_iter().find(as_this).filter(|_| size > 0.0)
    }

    fn precision(&self) -> S::Precision {
        self.value.precision()
    }

    #[inline]
    fn int(&self, n: i64) -> Self {
        let value = self.value.int(n);
        if n.unsigned_abs() < 1 << 53 { Estimate::exact(value) } else { Estimate::rounded(value, 1.0) }
    }

    #[inline]
    fn double(&self, x: f64) -> Self {
        Estimate::exact(self.value.double(x))
    }

    /// Computes the square root; zero within its bound for a negative value that is zero within its bound.
    ///
    /// The error bound follows from `|√a − √b| = |a − b|/(√a + √b)`, which is at most `√|a − b|`.
    fn try_sqrt(&self) -> Option<Self> {
        match self.sign() {
            Ok(Ordering::Less) => None,
            _ if self.value.is_negative() => Some(Estimate::new(self.value.zero(), self.root_of_error())),
            _ => {
                let value = self.value.try_sqrt()?;
                let least = self.value.to_f64() - self.bound();
                // Once the value exceeds its bound, the first of both expressions is the smaller one.
                let error = if self.error == 0.0 {
                    0.0
                } else if least > 0.0 {
                    self.error / (value.to_f64() + least.sqrt())
                } else {
                    self.root_of_error()
                };
                Some(Estimate::once(value, error))
            }
        }
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    #[inline]
    fn roundoff(&self) -> Self {
        Estimate::exact(self.value.roundoff())
    }

    fn bits(&self) -> Option<u32> {
        self.value.bits()
    }

    #[inline]
    fn sign(&self) -> Result<Ordering, Open> {
        let size = self.value.to_f64();
        // One comparison of doubles decides almost all cases.
        let size_of_error = 2.0 * self.bound();
        if size.abs() > size_of_error && size.abs() > f64::MIN_POSITIVE {
            return Ok(if size < 0.0 { Ordering::Less } else { Ordering::Greater });
        }
        let error = self.value.double(self.error) * &self.value.roundoff();
        if self.value.magnitude() <= error || self.error.is_nan() {
            return Ok(Ordering::Equal);
        }
        self.value.sign()
    }

    /// Squares with the error bound from `|a² − a′²| = |a − a′| |a + a′|`.
    #[inline]
    fn square(&self) -> Self {
        let value = self.value.square();
        let error = if self.error == 0.0 { 0.0 } else { self.error * (2.0 * self.value.to_f64().abs() + self.bound()) };
        Estimate::once(value, error)
    }

    fn log2_error(&self) -> f64 {
        self.error.log2() + self.value.log2_roundoff()
    }

    /// Returns the floor; an integer that equals the number within its bound counts as the number.
    #[inline]
    fn floor_int(&self) -> Option<i64> {
        let floor = self.value.floor_int()?;
        let past = (self.value.clone() - self.value.int(floor)).to_f64();
        // Two comparisons of doubles decide almost all cases.
        if past.min(1.0 - past) > 2.0 * self.bound() && past.is_normal() {
            return Some(floor);
        }
        let meets =
            |n: i64| Estimate::new(self.value.clone() - self.value.int(n), self.error).sign() == Ok(Ordering::Equal);
        let near = if past < 0.5 { floor } else { floor.checked_add(1)? };
        Some(if meets(near) { near } else { floor })
    }

    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }

    fn decimal(&self, digits: u32) -> String {
        self.value.decimal(digits)
    }

    fn as_double(&self) -> Option<f64> {
        self.value.as_double()
    }

    fn text(&self) -> String {
        self.value.text()
    }

    #[inline]
    fn magnitude(&self) -> Self {
        Estimate { value: self.value.magnitude(), error: self.error }
    }

    fn alike(&self, other: &Self) -> bool {
        self.value == other.value
    }

    fn widened(self, by: &Self) -> Self {
        Estimate { error: self.error + by.error_of_zero(), value: self.value }
    }
}

impl<S: Rounded> Analytic for Estimate<S> {
    fn sqrt(&self) -> Self {
        self.try_sqrt().unwrap_or_else(|| Estimate::new(self.value.sqrt(), f64::INFINITY))
    }
    /// Computes `eˣ`; the slope within the error is at most `eˣ⁺ᵉ`.
    fn exp(&self) -> Self {
        let value = self.value.exp();
        let slope = value.to_f64() * self.bound().exp();
        self.function(value, slope)
    }
    fn exp_m1(&self) -> Self {
        let value = self.value.exp_m1();
        let slope = (value.to_f64() + 1.0) * self.bound().exp();
        self.function(value, slope)
    }
    fn ln(&self) -> Self {
        let least = self.value.to_f64() - self.bound();
        self.function(self.value.ln(), if least > 0.0 { 1.0 / least } else { f64::INFINITY })
    }
    fn ln_1p(&self) -> Self {
        let least = 1.0 + self.value.to_f64() - self.bound();
        self.function(self.value.ln_1p(), if least > 0.0 { 1.0 / least } else { f64::INFINITY })
    }
    fn cos(&self) -> Self {
        self.function(self.value.cos(), 1.0)
    }
    fn sin(&self) -> Self {
        self.function(self.value.sin(), 1.0)
    }
    fn pi(&self) -> Self {
        Estimate::rounded(self.value.pi(), 1.0)
    }
}

#[cfg(test)]
#[path = "tests/estimate.rs"]
mod tests;
