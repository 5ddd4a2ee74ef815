//! Numbers in six systems; exact text in and rounded text out.
//!
//! | type | system | guarantee |
//! |---|---|---|
//! | `f64` | double precision | each operation correctly rounded |
//! | [`Wide`] | two to six machine words | each operation correctly rounded; elementary functions within 0.51 ulp |
//! | `rug::Float` (feature `mp`) | any number of bits | each operation correctly rounded |
//! | [`Rational`] (`rug::Rational`, without the feature `mp` `dashu_ratio::RBig`) | fractions | exact; square roots only where they are rational |
//! | [`Interval`] (feature `mp`) | enclosures | ends rounded outwards, with the exact number where it has a root form |
//! | [`Estimate`] | a rounded number and its error | the bound is carried through every operation |
//!
//! `Dual`, a number with a derivative, is for internal computations.
//!
//! Formulas are written once. [`Scalar`] provides the field operations and the square root, [`Analytic`] the elementary
//! functions; [`Rounded`] numbers round, and [`Bounded`] numbers account for their own error.

/// Implements the operators with the right operand by value on top of those by reference.
macro_rules! by_value {
    ([$($bound:tt)*] $type:ty) => {
        by_value!(@ [$($bound)*] $type, Add add);
        by_value!(@ [$($bound)*] $type, Sub sub);
        by_value!(@ [$($bound)*] $type, Mul mul);
        by_value!(@ [$($bound)*] $type, Div div);
    };
    (@ [$($bound:tt)*] $type:ty, $trait:ident $method:ident) => {
        impl<$($bound)*> $trait for $type {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                $trait::$method(self, &other)
            }
        }
    };
}

#[cfg(not(feature = "mp"))]
mod absent;
mod bounded;
mod decimal;
mod double;
mod dual;
mod estimate;
#[cfg(feature = "mp")]
mod float;
mod fraction;
#[cfg(feature = "mp")]
mod interval;
mod list;
mod literal;
#[cfg(feature = "mp")]
mod radical;
#[cfg_attr(feature = "mp", path = "rational_gmp.rs")]
#[cfg_attr(not(feature = "mp"), path = "rational_dashu.rs")]
mod rational;
mod scalar;
mod text;
mod value;
mod wide;

#[cfg(not(feature = "mp"))]
pub use absent::{Float, Interval};
pub use bounded::{Answer, Bounded};
pub use decimal::decimal;
pub(crate) use double::shortest;
pub(crate) use dual::Dual;
pub use estimate::Estimate;
#[cfg(feature = "mp")]
pub(crate) use float::{down, up};
pub(crate) use fraction::spelled_as;
#[cfg(feature = "mp")]
pub use interval::{Interval, IntervalPrecision};
pub use list::{List, ListError};
pub use literal::short;
pub use literal::{Number, NumberError};
pub use rational::Rational;
#[cfg(feature = "mp")]
pub use rug::Float;
pub use scalar::{Analytic, Open, Reads, Rounded, Scalar, Spelling};
pub use text::{DOUBLE_DIGITS, bits_for_digits, bound_of_log2, double_bound, show, shown_bound};
pub use value::{Bound, IntoValue, Value};
pub use wide::Wide;
pub(crate) use wide::guarded;
