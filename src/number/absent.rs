//! Empty types in place of long numbers and enclosures in a build without the feature `mp`.
//!
//! They let all other modules name these number systems without a `cfg`. No plan chooses them, because
//! [`Plan`](crate::Plan) refuses with [`Error::NoMultiprecision`](crate::Error::NoMultiprecision) first.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Analytic, Bounded, Estimate, Number, Open, Reads, Rounded, Scalar};

macro_rules! absent {
    ($(#[$doc:meta] $name:ident),*) => {$(
        #[$doc]
        #[derive(Clone, Debug, PartialEq, PartialOrd)]
        pub enum $name {}

        absent!(@operator $name, Add add, Sub sub, Mul mul, Div div);
        by_value!([] $name);

        impl Neg for $name {
            type Output = Self;
            fn neg(self) -> Self {
                self
            }
        }

        impl Scalar for $name {
            type Precision = $name;

            fn from_number(_: &Number, precision: &Self) -> Self {
                match *precision {}
            }
            absent!(@none precision() -> Self, int(_: i64) -> Self, double(_: f64) -> Self, try_sqrt() -> Option<Self>,
                to_f64() -> f64, sign() -> Result<Ordering, Open>, floor_int() -> Option<i64>, text() -> String);
        }

        impl Analytic for $name {
            absent!(@none sqrt() -> Self, exp() -> Self, exp_m1() -> Self, ln() -> Self, ln_1p() -> Self, cos() -> Self,
                sin() -> Self, pi() -> Self);
        }
    )*};
    // Uncallable methods: the type has no value.
    (@none $($method:ident($($_:tt: $of:ty)?) -> $answer:ty),*) => {$(
        fn $method(&self $(, $_: $of)?) -> $answer {
            match *self {}
        }
    )*};
    (@operator $name:ident, $($trait:ident $method:ident),*) => {$(
        impl $trait<&$name> for $name {
            type Output = Self;
            fn $method(self, _: &Self) -> Self {
                self
            }
        }
    )*};
}

absent!(
    /// Placeholder for `rug::Float`, which needs the feature `mp`.
    Float,
    /// Placeholder for an enclosure, which needs the feature `mp`.
    Interval
);

impl Rounded for Float {
    absent!(@none unit() -> f64, in_roundoffs() -> f64);
}

impl Bounded for Interval {}

impl Reads<Estimate<Float>> for Estimate<f64> {
    fn read(number: Estimate<Float>) -> Self {
        match *number.value() {}
    }
    fn give(&self, precision: &Float) -> Estimate<Float> {
        match *precision {}
    }
}
