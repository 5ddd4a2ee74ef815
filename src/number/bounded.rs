//! Numbers that answer for their own error.

use super::{Estimate, Interval, Rational, Rounded, Scalar};

/// A number that answers for its own error: by having none, by enclosing it, or by carrying a bound of it.
///
/// Three kinds of algorithm are written once on it, and each of its methods is the part in which they differ: exact
/// numbers and enclosures take part in formulas as they are (the defaults), while an [`Estimate`] is a stored value,
/// for which a formula may be evaluated, and a bound of how far the number meant lies from it, which may be counted
/// where it matters.
pub trait Bounded: Scalar {
    /// The bound of the error in roundoffs; zero where the number is exact or an enclosure.
    fn roundoffs(&self) -> f64 {
        0.0
    }

    /// The stored value, without the error: for formulas that count it elsewhere.
    fn nominal(self) -> Self {
        self
    }

    /// The difference of the stored values.
    fn minus_stored(self, other: &Self) -> Self {
        self - other
    }

    /// The product with the stored value of `other`.
    fn times_stored(self, other: &Self) -> Self {
        self * other
    }

    /// Zero, within the error of this number; `None` where it answers for that in its value.
    fn deviation(&self) -> Option<Self> {
        None
    }

    /// Zero, within what this number may differ from zero: for a number that has been taken for zero.
    fn taken_for_zero(&self) -> Self {
        self.zero()
    }

    /// One number for two that are the same within their bounds.
    fn joined(self, other: &Self) -> Self {
        let _ = other;
        self
    }

    /// Whether both are surely the same number, or the same within their bounds; false also where that is not known.
    fn same(&self, other: &Self) -> bool {
        self.compare(other).is_ok_and(std::cmp::Ordering::is_eq)
    }

    /// For the value of a function at the stored `place` of a break, where its rate and bend change from `before` to
    /// `after`: counts what it is off where the break lies elsewhere in its bound.
    fn cross_break(&mut self, place: &Self, before: [&Self; 2], after: [&Self; 2]) {
        let _ = (place, before, after);
    }

    /// Zero, within how far a root of `self + rate·s + bend·s²/2` may lie from `s = 0`, where `self` is zero within its
    /// bound; `None` where it is zero.
    fn root_deviation(&self, rate: &Self, bend: &Self) -> Option<Self> {
        let _ = (rate, bend);
        None
    }

    /// `self/2`.
    fn halved(self) -> Self {
        let two = self.int(2);
        self / two
    }

    /// `2 self`.
    fn doubled(self) -> Self {
        self.clone() + &self
    }

    /// With a symbol for the exact number where nothing else is known of it, so that it equals itself. For enclosures.
    fn with_identity(self) -> Self {
        self
    }

    /// The same number by a formula that keeps the exact number, or the ends, where this one has lost them. For
    /// enclosures.
    fn or_exactly(self, other: impl FnOnce() -> Self) -> Self {
        let _ = other;
        self
    }

    /// Without the exact number, which outgrows any use in long sums. For enclosures.
    fn without_exact(self) -> Self {
        self
    }
}

/// A number system of answers, with the one that computations carry beside it: the bound of a rounded number, nothing
/// for exact numbers and enclosures.
pub trait Answer: Scalar {
    /// What computations are done in.
    type Carried: Bounded<Precision = Self::Precision>;

    /// The number in the carried system. A rounded number stands for all that round to it: `0.6` is 6/10 and meets a
    /// ray that comes at 3 · 0.2.
    fn carry(&self) -> Self::Carried;

    /// The number in the carried system, taken for exact.
    fn exactly(&self) -> Self::Carried {
        self.carry()
    }

    /// The number without what is carried beside it.
    fn strip(carried: Self::Carried) -> Self;
}

/// Exact numbers and enclosures, which carry nothing beside themselves.
macro_rules! carried_as_they_are {
    ($($type:ty),*) => {$(
        impl Answer for $type {
            type Carried = $type;

            fn carry(&self) -> $type {
                self.clone()
            }

            fn strip(carried: $type) -> $type {
                carried
            }
        }
    )*};
}
carried_as_they_are!(Rational, Interval);

impl<S: Rounded> Answer for S {
    type Carried = Estimate<S>;

    fn carry(&self) -> Estimate<S> {
        Estimate::rounded(self.clone(), 1.0)
    }

    fn exactly(&self) -> Estimate<S> {
        Estimate::exact(self.clone())
    }

    fn strip(carried: Estimate<S>) -> S {
        carried.into_value()
    }
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
    fn minus_stored(self, other: &Self) -> Self {
        Estimate::rounded(self.into_value() - other.value(), 1.0)
    }

    /// `|a b − a′ b| = |a − a′| |b|`.
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

    /// The bound of the first is widened by how far the second lies off, and by the bound of that.
    fn joined(self, other: &Self) -> Self {
        let error = other.error() + (self.clone() - other).nominal().error_of_zero();
        let error = error.max(self.error());
        Estimate::new(self.into_value(), error)
    }

    /// With the break at `b + δ` the value at b is off by `∫ (after − before)` from b to b + δ, which is at most
    /// `|[rate]| |δ| + |[bend]| δ²/2`.
    #[inline]
    fn cross_break(&mut self, place: &Self, before: [&Self; 2], after: [&Self; 2]) {
        let late = place.error();
        if late == 0.0 {
            return;
        }
        let unit = self.value().unit();
        // The jumps are differences of doubles, whose own rounding is counted with the errors of what they are taken
        // of.
        let jump = |k: usize| {
            let (a, b) = (before[k].to_f64(), after[k].to_f64());
            let error = (before[k].error() + after[k].error()) * unit;
            (a - b).abs() + error + f64::EPSILON * (a.abs() + b.abs())
        };
        self.widen(late * (jump(0) + jump(1) * late * unit / 2.0));
    }

    /// With `|self| ≤ e` the root next to zero lies within `2e/|rate|` where `rate² ≥ 2 |bend| e`, and a double root
    /// within `√(2e/|bend|)`; where the first does not hold, the second is the smaller one.
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
        let (two, error) = (self.value().int(2), self.error() / 2.0);
        Estimate::new(self.into_value() / two, error)
    }

    #[inline]
    fn doubled(self) -> Self {
        let error = 2.0 * self.error();
        let value = self.into_value();
        Estimate::new(value.clone() + &value, error)
    }
}

#[cfg(test)]
#[path = "tests/bounded.rs"]
mod tests;
