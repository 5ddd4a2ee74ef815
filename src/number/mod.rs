//! Numbers: two small traits, four number systems, exact text in and rounded text out.
//!
//! | type | system | what it promises |
//! |---|---|---|
//! | `f64` | double precision | each operation correctly rounded |
//! | `rug::Float` (feature `mp`) | any number of bits | each operation correctly rounded |
//! | `rug::Rational` (feature `mp`) | fractions | exact; square roots only where they are rational |
//! | [`Interval`] (feature `mp`) | enclosures | ends rounded outwards; with them, the exact number where fractions and square roots make it |
//!
//! Formulas are written once: undamped code is `impl<S: Scalar>`, damped code is `impl<S: Analytic>`.

#[cfg(not(feature = "mp"))]
mod absent;
mod bounded;
mod double;
mod estimate;
#[cfg(feature = "mp")]
mod float;
#[cfg(feature = "mp")]
mod fraction;
#[cfg(feature = "mp")]
mod interval;
mod literal;
#[cfg(feature = "mp")]
mod radical;
mod scalar;
mod text;

#[cfg(not(feature = "mp"))]
pub use absent::{Float, Interval, Rational};
pub use bounded::{Answer, Bounded};
pub use estimate::Estimate;
#[cfg(feature = "mp")]
pub use float::{bits_for_digits, decimal};
#[cfg(feature = "mp")]
pub use interval::{Interval, IntervalPrecision};
pub use literal::{Number, NumberError};
#[cfg(feature = "mp")]
pub use rug::{Float, Rational};
pub use scalar::{Analytic, Open, Reads, Rounded, Scalar};
#[doc(hidden)]
pub use text::{DOUBLE_DIGITS, bound_text, double_bound_text, show, shown_bound_text};
