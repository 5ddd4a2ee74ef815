//! Numbers in six systems; exact text in and rounded text out.
//!
//! | type | system | guarantee |
//! |---|---|---|
//! | `f64` | double precision | each operation correctly rounded |
//! | [`Wide`] | two to six machine words | each operation correctly rounded; elementary functions within 0.51 ulp |
//! | [`Float`] (`rug::Float`, without the feature `mp` our own) | any number of bits | each operation correctly rounded |
//! | [`Rational`] (`rug::Rational`, without the feature `mp` `dashu_ratio::RBig`) | fractions | exact; square roots only where they are rational |
//! | [`Interval`] | enclosures | ends rounded outwards, with the exact number where it has a root form |
//! | [`Estimate`] | a rounded number and its error | the bound is carried through every operation |
//!
//! `Dual`, a number with a derivative, is for internal computations.
//!
//! Formulas are written once. [`Scalar`] provides the field operations and the square root, [`Analytic`] the elementary
//! functions; [`Rounded`] numbers round, and [`Bounded`] numbers account for their own error.

/// Implements the operators, with the right operand by reference and by value, by the methods `plus`, `minus`, `times`
/// and `over`.
macro_rules! operators {
    ([$($bound:tt)*] $type:ty) => {
        operators!(@ [$($bound)*] $type, Add add plus);
        operators!(@ [$($bound)*] $type, Sub sub minus);
        operators!(@ [$($bound)*] $type, Mul mul times);
        operators!(@ [$($bound)*] $type, Div div over);
    };
    (@ [$($bound:tt)*] $type:ty, $trait:ident $method:ident $own:ident) => {
        impl<$($bound)*> std::ops::$trait<&$type> for $type {
            type Output = Self;
            #[inline]
            fn $method(self, other: &Self) -> Self {
                self.$own(other)
            }
        }

        impl<$($bound)*> std::ops::$trait for $type {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                self.$own(&other)
            }
        }
    };
}

mod answer;
mod bounded;
mod decimal;
mod double;
mod dual;
mod estimate;
#[cfg_attr(feature = "mp", path = "float_gmp.rs")]
#[cfg_attr(not(feature = "mp"), path = "float_dashu.rs")]
pub(crate) mod float;
mod float_system;
mod fraction;
mod interval;
mod list;
mod literal;
mod radical;
#[cfg_attr(feature = "mp", path = "rational_gmp.rs")]
#[cfg_attr(not(feature = "mp"), path = "rational_dashu.rs")]
pub(crate) mod rational;
mod scalar;
mod spelling;
mod text;
mod value;
mod wide;

pub use answer::Answer;
pub use bounded::Bounded;
pub(crate) use bounded::is_exact_zero;
pub use decimal::decimal;
pub(crate) use double::shortest;
pub(crate) use dual::Dual;
pub use estimate::Estimate;
pub use float::Float;
pub use interval::{Interval, IntervalPrecision};
pub use list::{List, ListError};
pub use literal::short;
pub use literal::{Number, NumberError};
pub use rational::Rational;
pub use scalar::{Analytic, Open, Reads, Rounded, Scalar};
pub use spelling::Spelling;
pub(crate) use spelling::spelled_as;
pub use text::{DOUBLE_DIGITS, bits_for_digits, bound_of_log2, double_bound, show, show_beside, shown_bound};
pub use value::{Bound, IntoValue, Value};
pub use wide::Wide;
pub(crate) use wide::guarded;

/// The numbers of the build in pure Rust, held against those of MPFR.
#[cfg(all(test, feature = "mp"))]
#[allow(dead_code, unreachable_pub, clippy::panic, clippy::unwrap_used)]
#[path = "tests"]
mod pure {
    #[path = "../float_dashu.rs"]
    mod float;
    #[path = "../rational_dashu.rs"]
    mod rational;
    #[path = "float.rs"]
    mod tests;
}
