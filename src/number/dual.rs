//! Numbers with a derivative, for sensitivities.

use std::cmp::Ordering;
use std::ops::Neg;

use super::{Bounded, Number, Open, Scalar};

/// A number with its rate of change with respect to one value of the problem: `a + b ε`, with `ε > 0` and `ε² = 0`.
///
/// Comparisons are those of the problem with a slightly greater value: the rates decide between equal numbers. Events
/// therefore occur in the order beyond a threshold, and the derivative is the right-hand one. Rounded numbers are equal
/// only within their bounds, so rates cannot decide between them: the comparison is open.
///
/// Results beyond first order, such as a quotient by `b ε` or its root, are open in every comparison.
///
/// Error terms that a number system adds beside a formula apply to `a` and `b` alike: each is a stored number plus its
/// deviation, and the formula holds for the sums `a + b ε` of both.
#[derive(Clone, Debug)]
pub(crate) struct Dual<S> {
    value: S,
    rate: S,
    known: bool,
}

impl<S: Bounded> Dual<S> {
    pub(crate) fn new(value: S, rate: S) -> Self {
        Dual { value, rate, known: true }
    }

    pub(crate) fn constant(value: S) -> Self {
        Dual { rate: value.zero(), value, known: true }
    }

    /// Returns `b`; `None` if first order does not determine it.
    pub(crate) fn rate(&self) -> Option<&S> {
        Some(&self.rate).filter(|_| self.known)
    }

    pub(crate) fn scaled_rate(self, factor: &S) -> Self {
        Dual { rate: self.rate * factor, ..self }
    }

    pub(crate) fn value(&self) -> &S {
        &self.value
    }

    fn unknown(near: &S) -> Self {
        Dual { known: false, ..Dual::constant(near.zero()) }
    }

    fn each(self, f: impl Fn(S) -> S) -> Self {
        Dual { value: f(self.value), rate: f(self.rate), known: self.known }
    }

    /// Applies `f` to the components of `self` and `other`, pair by pair.
    fn with(self, other: &Self, f: impl Fn(S, &S) -> S) -> Self {
        let known = self.known && other.known;
        Dual { value: f(self.value, &other.value), rate: f(self.rate, &other.rate), known }
    }

    fn plus(self, other: &Self) -> Self {
        self.with(other, |a, b| a + b)
    }

    fn minus(self, other: &Self) -> Self {
        self.with(other, |a, b| a - b)
    }

    fn times(self, other: &Self) -> Self {
        let rate = self.rate * &other.value + other.rate.clone() * &self.value;
        Dual { value: self.value * &other.value, rate, known: self.known && other.known }
    }

    fn over(self, other: &Self) -> Self {
        if !other.known || other.value.vanishes() != Ok(false) {
            return Dual::unknown(&self.value);
        }
        let value = self.value / &other.value;
        Dual { rate: (self.rate - other.rate.clone() * &value) / &other.value, value, known: self.known }
    }
}

operators!([S: Bounded] Dual<S>);

impl<S: Bounded> Neg for Dual<S> {
    type Output = Self;
    fn neg(self) -> Self {
        self.each(S::neg)
    }
}

impl<S: Bounded> Scalar for Dual<S> {
    type Precision = S::Precision;

    fn from_number(number: &Number, precision: &S::Precision) -> Self {
        Dual::constant(S::from_number(number, precision))
    }

    fn precision(&self) -> S::Precision {
        self.value.precision()
    }

    fn int(&self, n: i64) -> Self {
        Dual::constant(self.value.int(n))
    }

    fn double(&self, x: f64) -> Self {
        Dual::constant(self.value.double(x))
    }

    /// Computes `√(a + b ε) = √a + b ε/2√a`: a step of Newton's method.
    fn try_sqrt(&self) -> Option<Self> {
        let root = self.value.try_sqrt()?;
        if root.vanishes() != Ok(false) {
            return Some(Dual::unknown(&root));
        }
        Some(Dual { rate: (self.rate.clone() / &root).halved(), value: root, known: self.known })
    }

    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    fn roundoff(&self) -> Self {
        Dual::constant(self.value.roundoff())
    }

    fn bits(&self) -> Option<u32> {
        self.value.bits()
    }

    fn sign(&self) -> Result<Ordering, Open> {
        let sign = if self.known { self.value.sign()? } else { return Err(Open) };
        if sign.is_ne() {
            return Ok(sign);
        }
        let sign = self.rate.sign()?;
        if sign.is_ne() && self.bits().is_some() { Err(Open) } else { Ok(sign) }
    }

    fn floor_int(&self) -> Option<i64> {
        let floor = self.value.floor_int()?;
        let past = self.clone() - self.int(floor);
        Some(floor - i64::from(past.negative().ok()?))
    }

    fn alike(&self, other: &Self) -> bool {
        self.known && other.known && self.value.alike(&other.value) && self.rate.alike(&other.rate)
    }

    fn is_finite(&self) -> bool {
        self.known && self.value.is_finite()
    }

    fn text(&self) -> String {
        self.value.text()
    }

    fn widened(self, by: &Self) -> Self {
        self.with(by, S::widened)
    }
}

impl<S: Bounded> Bounded for Dual<S> {
    /// Returns a number above zero even for exact numbers: they may be equal in first order only.
    fn roundoffs(&self) -> f64 {
        self.value.roundoffs().max(f64::MIN_POSITIVE)
    }

    fn with_rate(self, rate: &Self) -> Self {
        Dual { rate: rate.value.clone(), ..self }
    }

    fn nominal(self) -> Self {
        self.each(S::nominal)
    }

    fn minus_stored(self, other: &Self) -> Self {
        self.with(other, S::minus_stored)
    }

    fn times_stored(self, other: &Self) -> Self {
        let rate = self.rate.times_stored(&other.value) + self.value.clone().times_stored(&other.rate);
        Dual { value: self.value.times_stored(&other.value), rate, known: self.known && other.known }
    }

    fn deviation(&self) -> Option<Self> {
        let [value, rate] = [&self.value, &self.rate].map(S::deviation);
        let zero = || self.value.zero();
        (value.is_some() || rate.is_some()).then(|| Dual::new(value.unwrap_or_else(zero), rate.unwrap_or_else(zero)))
    }

    fn taken_for_zero(&self) -> Self {
        Dual { value: self.value.taken_for_zero(), rate: self.rate.taken_for_zero(), known: self.known }
    }

    fn joined(self, other: &Self) -> Self {
        self.with(other, S::joined)
    }

    /// Widens the rate by the rate of `[rate] δ + [bend] δ²/2`, where δ is the deviation of the place.
    fn cross_break(&mut self, place: &Self, before: [&Self; 2], after: [&Self; 2]) {
        let values = |line: [&Self; 2]| line.map(|number| number.value.clone());
        self.value.cross_break(&place.value, values(before).each_ref(), values(after).each_ref());
        let Some(late) = place.deviation() else { return };
        let [rate, bend] = [0, 1].map(|k| after[k].clone() - before[k]);
        let by = (bend * &late).halved() + &rate;
        self.rate = self.rate.clone().widened(&(by * &late).rate);
    }

    /// Computes the root s of `a + b s + c s²/2`, whose rate is `−(ȧ + ḃ s + ċ s²/2)/(b + c s)`. The result is never
    /// `None`, because root and break may coincide in first order only.
    fn root_deviation(&self, rate: &Self, bend: &Self) -> Option<Self> {
        let zero = || self.value.zero();
        let root = self.value.root_deviation(&rate.value, &bend.value).unwrap_or_else(zero);
        let slope = bend.value.clone() * &root + &rate.value;
        let rise = ((bend.rate.clone() * &root).halved() + &rate.rate) * &root + &self.rate;
        let rate = match slope.vanishes() {
            Ok(false) => rise / slope,
            _ if self.bits().is_some() => zero().widened(&self.value.double(f64::INFINITY)),
            _ => zero(),
        };
        Some(Dual::new(root, rate))
    }

    fn halved(self) -> Self {
        self.each(S::halved)
    }

    fn doubled(self) -> Self {
        self.each(S::doubled)
    }
}

#[cfg(test)]
#[path = "tests/dual.rs"]
mod tests;
