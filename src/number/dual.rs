//! Fractions with a derivative.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Bounded, Number, Open, Rational, Scalar};

/// A fraction and how fast it grows with a value of the problem that becomes a little greater: `a + b ε`, `ε > 0` and
/// `ε² = 0`.
///
/// Comparisons are those of the problem with the greater value: where the fractions are equal, their rates decide. So
/// events come in the order that they have beside a threshold, and the derivative is that from the right.
///
/// What first order does not tell, such as a quotient by `b ε` or the root of one, is open in every comparison.
#[derive(Clone, Debug)]
pub(crate) struct Dual {
    value: Rational,
    rate: Rational,
    known: bool,
}

impl Dual {
    /// `value + rate ε`.
    pub(crate) fn new(value: Rational, rate: Rational) -> Self {
        Dual { value, rate, known: true }
    }

    /// A number that does not change.
    pub(crate) fn constant(value: Rational) -> Self {
        Dual::new(value, Rational::default())
    }

    /// `b`; `None` where first order does not tell.
    pub(crate) fn rate(&self) -> Option<&Rational> {
        Some(&self.rate).filter(|_| self.known)
    }

    /// `a`.
    pub(crate) fn value(&self) -> &Rational {
        &self.value
    }

    fn unknown() -> Self {
        Dual { known: false, ..Dual::constant(Rational::default()) }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, rate: -self.rate, known: self.known }
    }
}

impl Add<&Dual> for Dual {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Dual { value: self.value + &other.value, rate: self.rate + &other.rate, known: self.known && other.known }
    }
}

impl Sub<&Dual> for Dual {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Dual { value: self.value - &other.value, rate: self.rate - &other.rate, known: self.known && other.known }
    }
}

impl Mul<&Dual> for Dual {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        let rate = self.rate * &other.value + other.rate.clone() * &self.value;
        Dual { value: self.value * &other.value, rate, known: self.known && other.known }
    }
}

impl Div<&Dual> for Dual {
    type Output = Self;
    fn div(self, other: &Self) -> Self {
        if !other.known || other.value.vanishes() == Ok(true) {
            return Dual::unknown();
        }
        let value = self.value / &other.value;
        Dual { rate: (self.rate - other.rate.clone() * &value) / &other.value, value, known: self.known }
    }
}

by_value!([] Dual);

impl Scalar for Dual {
    type Precision = ();

    fn from_number(number: &Number, (): &()) -> Self {
        Dual::constant(number.to_rational())
    }

    fn precision(&self) {}

    fn int(&self, n: i64) -> Self {
        Dual::constant(n.into())
    }

    fn double(&self, x: f64) -> Self {
        Dual::constant(self.value.double(x))
    }

    /// `√(a + b ε) = √a + b ε/2√a`: a step of Newton's method.
    fn try_sqrt(&self) -> Option<Self> {
        let root = self.value.try_sqrt()?;
        if root.vanishes() == Ok(true) {
            return Some(Dual::unknown());
        }
        Some(Dual { rate: (self.rate.clone() / &root).halved(), value: root, known: self.known })
    }

    fn to_f64(&self) -> f64 {
        Scalar::to_f64(&self.value)
    }

    fn sign(&self) -> Result<Ordering, Open> {
        if self.known { Ok(Scalar::sign(&self.value)?.then(Scalar::sign(&self.rate)?)) } else { Err(Open) }
    }

    fn floor_int(&self) -> Option<i64> {
        let floor = self.value.floor_int()?;
        let whole = self.value.compare(&Rational::from(floor)) == Ok(Ordering::Equal);
        let just_below = self.known && whole && self.rate.negative() == Ok(true);
        self.known.then_some(floor - i64::from(just_below))
    }

    fn is_finite(&self) -> bool {
        self.known
    }

    fn text(&self) -> String {
        self.value.text()
    }
}

impl Bounded for Dual {
    fn halved(self) -> Self {
        Dual { value: self.value.halved(), rate: self.rate.halved(), known: self.known }
    }
}

#[cfg(test)]
#[path = "tests/dual.rs"]
mod tests;
