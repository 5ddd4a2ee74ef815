//! A number as a route gives it, in the number system of that route, with its bound; or why there is none.

use crate::error::Error;
use crate::number::{Analytic, Estimate, Float, Interval, Rational, Scalar, show};

/// A number in any number system.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// In double precision.
    Double(f64),
    /// In more bits.
    Float(Float),
    /// Without any error.
    Fraction(Rational),
    /// Between two bounds.
    Enclosure(Box<Interval>),
}

impl Value {
    /// The nearest double; of an enclosure, that of its middle.
    pub(crate) fn to_f64(&self) -> f64 {
        match self {
            Value::Double(value) => *value,
            Value::Float(value) => Scalar::to_f64(value),
            Value::Fraction(value) => Scalar::to_f64(value),
            Value::Enclosure(value) => value.decimal(25).parse().unwrap_or(f64::NAN),
        }
    }

    /// `log₁₀` of half the width of an enclosure; `None` for what is none.
    pub(crate) fn log10_radius(&self) -> Option<f64> {
        match self {
            Value::Enclosure(value) => Some(value.log2_error() * std::f64::consts::LOG10_2),
            _ => None,
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
            Value::Float(value) => f.write_str(&value.decimal(18)),
            Value::Fraction(value) => f.write_str(&value.text()),
            Value::Enclosure(value) => f.write_str(&show(&**value, 18)),
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

macro_rules! systems {
    ($($name:ty: $self:ident => $value:expr),*) => {$(
        #[allow(unreachable_code, reason = "without `mp` there are only doubles")]
        impl System for $name {
            fn value($self) -> Value {
                $value
            }

            fn exponential(&self) -> Option<Self> {
                Some(Analytic::exp(self))
            }
        }
    )*};
}
systems!(
    f64: self => Value::Double(self),
    Float: self => Value::Float(self),
    Interval: self => Value::Enclosure(Box::new(self)),
    Estimate<f64>: self => self.into_value().value(),
    Estimate<Float>: self => self.into_value().value()
);

impl System for Rational {
    fn value(self) -> Value {
        Value::Fraction(self)
    }

    /// Only at zero: no other fraction has a rational exponential.
    fn exponential(&self) -> Option<Self> {
        (self.vanishes() == Ok(true)).then(|| self.one())
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
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
