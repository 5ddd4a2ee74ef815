//! Number systems of answers, and the systems that computations carry for them.

use super::{Bounded, Estimate, Interval, Rational, Rounded, Scalar};

/// A number system of answers, with the system that computations carry for it: rounded numbers are carried with their
/// bound, exact numbers and enclosures as they are.
pub trait Answer: Scalar {
    /// Number system of the computations.
    type Carried: Bounded<Precision = Self::Precision>;

    /// Converts the number to the carried system. A rounded number represents all numbers that round to it: `0.6` is
    /// 6/10 and meets a ray that arrives at 3 · 0.2.
    fn carry(&self) -> Self::Carried;

    /// Converts the number to the carried system as an exact number.
    fn exactly(&self) -> Self::Carried {
        self.carry()
    }

    /// Returns the number without its bound.
    fn strip(carried: Self::Carried) -> Self;
}

/// Implements [`Answer`] for exact numbers and enclosures, which carry no separate bound.
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
