//! Numbers that account for their own error.

use super::{Estimate, Rounded, Scalar};

/// A number that accounts for its own error: it is exact, encloses the true number, or carries an error bound.
///
/// Algorithms are written once for all three kinds, and the methods of this trait are the steps in which the kinds
/// differ. Exact numbers and enclosures enter formulas as they are (the defaults). An [`Estimate`] is a stored value
/// with a bound of its distance from the true number: a formula can be evaluated on the stored values alone, and the
/// bound added only where it matters.
pub trait Bounded: Scalar {
    /// Returns the error bound in roundoffs; zero for exact numbers and enclosures.
    fn roundoffs(&self) -> f64 {
        0.0
    }

    /// Returns the stored value without the error, for formulas that account for it elsewhere.
    fn nominal(self) -> Self {
        self
    }

    /// Returns the stored value, or the middle of an enclosure, as an exact number, with a bound of its distance from
    /// the true number. A number without a bound of its own is returned as it is.
    fn centred(&self) -> (Self, Self) {
        (self.clone(), self.zero())
    }

    /// Returns the difference of the stored values.
    fn minus_stored(self, other: &Self) -> Self {
        self - other
    }

    /// Returns the number with this rate of change, if its kind has one.
    fn with_rate(self, rate: &Self) -> Self {
        let _ = rate;
        self
    }

    /// Returns the product with the stored value of `other`.
    fn times_stored(self, other: &Self) -> Self {
        self * other
    }

    /// Returns zero within the error of this number; `None` if its value contains the error already or is exact.
    fn deviation(&self) -> Option<Self> {
        None
    }

    /// Returns zero within the possible distance of this number from zero, for a number that is replaced by zero.
    fn taken_for_zero(&self) -> Self {
        self.zero()
    }

    /// Merges two numbers that agree within their bounds.
    fn joined(self, other: &Self) -> Self {
        let _ = other;
        self
    }

    /// Returns whether both numbers are proved equal, or agree within their bounds; false also if this is unknown.
    fn same(&self, other: &Self) -> bool {
        self.compare(other).is_ok_and(std::cmp::Ordering::is_eq)
    }

    /// Widens `self`, a function value at the stored `place` of a break, by the error from the true place of the break.
    /// Rate and bend of the function change from `before` to `after` at the break.
    fn cross_break(&mut self, place: &Self, before: [&Self; 2], after: [&Self; 2]) {
        let _ = (place, before, after);
    }

    /// Returns zero within the possible distance of a root of `self + rate·s + bend·s²/2` from `s = 0`, where `self` is
    /// zero within its bound; `None` if `self` is exactly zero.
    fn root_deviation(&self, rate: &Self, bend: &Self) -> Option<Self> {
        let _ = (rate, bend);
        None
    }

    /// Returns `self/2`.
    fn halved(self) -> Self {
        let two = self.int(2);
        self / two
    }

    /// Returns `2 self`.
    fn doubled(self) -> Self {
        self.clone() + &self
    }

    /// Adds a symbol for the exact number, so that it equals itself, if it has no exact form. For enclosures.
    fn with_identity(self) -> Self {
        self
    }

    /// Evaluates another formula for the same enclosure if this one has lost its exact number or its ends.
    fn or_exactly(self, other: impl FnOnce() -> Self) -> Self {
        let _ = other;
        self
    }

    /// Drops the exact number, which becomes too long in long sums. For enclosures.
    fn without_exact(self) -> Self {
        self
    }
}

/// Returns whether a number is zero without any error.
pub(crate) fn is_exact_zero<N: Bounded>(x: &N) -> bool {
    x.roundoffs() == 0.0 && x.vanishes() == Ok(true)
}

impl<S: Rounded> Bounded for Estimate<S> {
    #[inline]
    fn roundoffs(&self) -> f64 {
        self.error()
    }

    #[inline]
    fn nominal(self) -> Self {
        Estimate::exact(self.into_value())
    }

    #[inline]
    fn centred(&self) -> (Self, Self) {
        let value = self.value();
        let radius = if self.error() == 0.0 { value.zero() } else { value.double(self.error()) * &value.roundoff() };
        (Estimate::exact(value.clone()), Estimate::exact(radius))
    }

    #[inline]
    fn minus_stored(self, other: &Self) -> Self {
        Estimate::rounded(self.into_value() - other.value(), 1.0)
    }

    /// Multiplies with the error `|a b − a′ b| = |a − a′| |b|`.
    #[inline]
    fn times_stored(self, other: &Self) -> Self {
        let error = self.error() * other.to_f64().abs();
        let value = self.into_value() * other.value();
        let rounding = value.to_f64().abs();
        Estimate::new(value, error + rounding)
    }

    #[inline]
    fn deviation(&self) -> Option<Self> {
        (self.error() > 0.0).then(|| Estimate::new(self.value().zero(), self.error()))
    }

    #[inline]
    fn taken_for_zero(&self) -> Self {
        Estimate::new(self.value().zero(), self.error_of_zero())
    }

    /// Widens the bound of the first number by the distance to the second and the bound of the second.
    fn joined(self, other: &Self) -> Self {
        let error = other.error() + (self.clone() - other).nominal().error_of_zero();
        // An unknown error stays unknown.
        let own = self.error();
        let error = if own >= error || own.is_nan() { own } else { error };
        Estimate::new(self.into_value(), error)
    }

    /// Widens the value at b by `|[rate]| |δ| + |[bend]| δ²/2`, an upper bound of its error `∫ (after − before)` from b
    /// to b + δ if the break is at `b + δ`.
    #[inline]
    fn cross_break(&mut self, place: &Self, before: [&Self; 2], after: [&Self; 2]) {
        let late = place.error();
        if late == 0.0 {
            return;
        }
        let unit = self.value().unit();
        // The jumps are differences of doubles; their rounding is added to the errors of both operands.
        let jump = |k: usize| {
            let (a, b) = (before[k].to_f64(), after[k].to_f64());
            let error = (before[k].error() + after[k].error()) * unit;
            (a - b).abs() + error + f64::EPSILON * (a.abs() + b.abs())
        };
        self.widen(late * (jump(0) + jump(1) * late * unit / 2.0));
    }

    /// Computes the deviation of the root next to zero. With `|self| ≤ e` it is within `2e/|rate|` if
    /// `rate² ≥ 2 |bend| e`, and a double root is within `√(2e/|bend|)`. Otherwise the second bound is smaller.
    fn root_deviation(&self, rate: &Self, bend: &Self) -> Option<Self> {
        let twice = 2.0 * self.error_of_zero();
        let least = |x: &Self| (x.to_f64().abs() - x.bound()).max(0.0);
        let (simple, bend) = (twice / least(rate), least(bend));
        let bound = if simple * simple * bend * self.value().unit() <= twice {
            simple
        } else {
            ((twice / bend).log2() / 2.0 - self.value().log2_roundoff() / 2.0).exp2()
        };
        (twice > 0.0).then(|| Estimate::new(self.value().zero(), bound))
    }

    #[inline]
    fn halved(self) -> Self {
        let (two, error) = (self.value().int(2), self.error() / 2.0 * (1.0 + f64::EPSILON));
        Estimate::new(self.into_value() / two, error)
    }

    #[inline]
    fn doubled(self) -> Self {
        let error = 2.0 * self.error() * (1.0 + f64::EPSILON);
        let value = self.into_value();
        Estimate::new(value.clone() + &value, error)
    }
}

#[cfg(test)]
#[path = "tests/bounded.rs"]
mod tests;
