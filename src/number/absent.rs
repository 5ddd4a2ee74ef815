//! What stands for fractions, long numbers and enclosures in a build without the feature `mp`: types without a value.
//!
//! They let every other room name the four number systems without asking for the feature. No plan chooses them, because
//! [`Plan`](crate::Plan) refuses with [`Error::NoMultiprecision`](crate::Error::NoMultiprecision) first.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Analytic, Bounded, Number, Open, Rounded, Scalar};

macro_rules! absent {
    ($(#[$doc:meta] $name:ident),*) => {$(
        #[$doc]
        #[derive(Clone, Debug, PartialEq, PartialOrd)]
        pub enum $name {}

        absent!(@operator $name, Add add, Sub sub, Mul mul, Div div);

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
            fn precision(&self) -> Self {
                match *self {}
            }
            fn int(&self, _: i64) -> Self {
                match *self {}
            }
            fn double(&self, _: f64) -> Self {
                match *self {}
            }
            fn try_sqrt(&self) -> Option<Self> {
                match *self {}
            }
            fn to_f64(&self) -> f64 {
                match *self {}
            }
            fn roundoff(&self) -> Self {
                match *self {}
            }
            fn bits(&self) -> Option<u32> {
                match *self {}
            }
            fn sign(&self) -> Result<Ordering, Open> {
                match *self {}
            }
            fn floor_int(&self) -> Option<i64> {
                match *self {}
            }
            fn is_finite(&self) -> bool {
                match *self {}
            }
            fn text(&self) -> String {
                match *self {}
            }
        }

        impl Analytic for $name {
            fn sqrt(&self) -> Self {
                match *self {}
            }
            fn exp(&self) -> Self {
                match *self {}
            }
            fn exp_m1(&self) -> Self {
                match *self {}
            }
            fn ln(&self) -> Self {
                match *self {}
            }
            fn ln_1p(&self) -> Self {
                match *self {}
            }
            fn cos(&self) -> Self {
                match *self {}
            }
            fn sin(&self) -> Self {
                match *self {}
            }
            fn pi(&self) -> Self {
                match *self {}
            }
        }

        impl Rounded for $name {
            fn unit(&self) -> f64 {
                match *self {}
            }
            fn in_roundoffs(&self) -> f64 {
                match *self {}
            }
        }

        impl Bounded for $name {}
    )*};
    (@operator $name:ident, $($trait:ident $method:ident),*) => {$(
        impl $trait for $name {
            type Output = Self;
            fn $method(self, _: Self) -> Self {
                self
            }
        }
        impl $trait<&$name> for $name {
            type Output = Self;
            fn $method(self, _: &Self) -> Self {
                self
            }
        }
    )*};
}

absent!(
    /// In a build with the feature `mp`, `rug::Float`.
    Float,
    /// In a build with the feature `mp`, `rug::Rational`.
    Rational,
    /// In a build with the feature `mp`, an enclosure.
    Interval
);
