//! A number as a route gives it, in the number system of that route, and what two such numbers have in common.

use super::long::{self, Long};
use crate::error::Error;
use crate::number::{Analytic, Estimate, Scalar};

/// A number in any number system.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// In double precision.
    Double(f64),
    /// In more bits, as a fraction, or enclosed.
    #[cfg_attr(not(feature = "mp"), expect(dead_code, reason = "there is no such number then"))]
    Long(Long),
}

impl Value {
    /// The nearest double; of an enclosure, that of its middle.
    pub(crate) fn to_f64(&self) -> f64 {
        match self {
            Value::Double(value) => *value,
            Value::Long(value) => value.to_f64(),
        }
    }

    /// `log₁₀ |self − other|`, with the middle of an enclosure: −∞ where the two are equal, ∞ where one is not finite.
    /// An error of a thousand digits has no double.
    ///
    /// **Accuracy**: the difference is rounded once, to 53 bits or more.
    pub(crate) fn log10_apart(&self, other: &Value) -> f64 {
        match (self, other) {
            (Value::Double(a), Value::Double(b)) if (a - b).is_finite() => (a - b).abs().log10(),
            _ => long::log10_apart(self, other),
        }
    }

    /// `log₁₀` of half the width of an enclosure; `None` for what is none.
    pub(crate) fn log10_radius(&self) -> Option<f64> {
        match self {
            Value::Double(_) => None,
            Value::Long(value) => value.log10_radius(),
        }
    }
}

impl std::fmt::Display for Value {
    /// To at most eighteen digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Double(value) if *value == 0.0 || (1e-4..1e9).contains(&value.abs()) || !value.is_finite() => {
                write!(f, "{value}")
            }
            Value::Double(value) => write!(f, "{value:e}"),
            Value::Long(value) => write!(f, "{value}"),
        }
    }
}

/// A number system that a route may answer in.
pub(crate) trait System: Scalar {
    /// The number as a value.
    fn value(self) -> Value;

    /// `eˣ` where the system has it.
    fn exponential(&self) -> Option<Self>;
}

impl System for f64 {
    fn value(self) -> Value {
        Value::Double(self)
    }

    fn exponential(&self) -> Option<f64> {
        Some(self.exp())
    }
}

impl System for Estimate<f64> {
    fn value(self) -> Value {
        Value::Double(self.into_value())
    }

    fn exponential(&self) -> Option<Self> {
        Some(Analytic::exp(self))
    }
}

/// A number with the bound that its route gives for its error, in the number's own unit; zero where the route claims to
/// be exact.
#[derive(Clone, Debug)]
pub(crate) struct Bounded<S> {
    pub(crate) value: S,
    pub(crate) bound: f64,
}

impl<S> Bounded<S> {
    pub(crate) fn new(value: S, bound: f64) -> Self {
        Bounded { value, bound }
    }

    /// The value of a route that gives no bound.
    pub(crate) fn unbounded(value: S) -> Self {
        Bounded { value, bound: f64::INFINITY }
    }
}

impl<S: System> Bounded<S> {
    pub(crate) fn exact(value: S) -> Self {
        Bounded { value, bound: 0.0 }
    }

    /// The value with the error of 64 roundings.
    pub(crate) fn rounded(value: S) -> Self {
        let bound = value.to_f64().abs() * 2f64.powf(value.log2_roundoff() + 6.0);
        Bounded { value, bound }
    }

    /// `self / other`, for `|self| ≤ |other|` or nearly so.
    pub(crate) fn over(self, other: Bounded<S>) -> Self {
        let bound = (self.bound + other.bound) / other.value.to_f64().abs();
        Bounded { value: self.value / &other.value, bound }
    }

    /// `self − other`.
    pub(crate) fn minus(self, other: Bounded<S>) -> Self {
        Bounded { value: self.value - &other.value, bound: self.bound + other.bound }
    }

    /// `self · factor`, for a factor whose own error is of no account.
    pub(crate) fn times(self, factor: &S) -> Self {
        Bounded { bound: self.bound * factor.to_f64().abs(), value: self.value * factor }
    }

    /// The same in any number system.
    pub(crate) fn answer(self) -> Answer {
        Bounded { value: self.value.value(), bound: self.bound }
    }
}

/// A route's answer in its number system.
pub(crate) type Answer = Bounded<Value>;

/// Why there is no answer, or nothing can be asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub(crate) enum NoAnswer {
    /// The solver refuses.
    #[error(transparent)]
    Solve(#[from] Error),
    /// The rod has no such quantity.
    #[error("found {quantity} asked of a scene that has none: {why}; expected another --quantity")]
    NoSuchQuantity { quantity: &'static str, why: String },
    /// A time makes no sense here.
    #[error("found time {found}, expected {expected}")]
    Time { found: String, expected: String },
    /// A budget that is no time.
    #[error("found {found} seconds, expected more than 0 and at most 86400")]
    Seconds { found: f64 },
    /// This route has no answer.
    #[error("{0}")]
    GaveUp(String),
}

impl NoAnswer {
    /// The rod has no such quantity; which one, [`super::quantity::Question::ask`] adds.
    pub(crate) fn none(why: impl Into<String>) -> Self {
        NoAnswer::NoSuchQuantity { quantity: "", why: why.into() }
    }

    /// This route has no answer.
    pub(crate) fn gave_up(why: impl std::fmt::Display) -> Self {
        NoAnswer::GaveUp(why.to_string())
    }
}

impl From<crate::number::NumberError> for NoAnswer {
    fn from(error: crate::number::NumberError) -> Self {
        NoAnswer::gave_up(error)
    }
}
