//! A number as a route gives it, in the number system of that route, with its bound; or why there is none.

use dalembert::Error;
use dalembert::number::{Analytic, Bounded, Estimate, Float, Interval, Rational, Scalar, show};

#[derive(Clone, Debug)]
pub enum Value {
    Double(Estimate<f64>),
    Float(Estimate<Float>),
    Fraction(Rational),
    Enclosure(Box<Interval>),
}

impl Value {
    /// The nearest double; of an enclosure, that of its middle.
    pub fn to_f64(&self) -> f64 {
        match self {
            Value::Double(value) => *value.value(),
            Value::Float(value) => Scalar::to_f64(value),
            Value::Fraction(value) => Scalar::to_f64(value),
            Value::Enclosure(value) => value.decimal(25).parse().unwrap_or(f64::NAN),
        }
    }

    /// The bound of its error, in the number's own unit; infinite where the route gives none.
    pub fn bound(&self) -> f64 {
        match self {
            Value::Double(value) => value.bound(),
            Value::Float(value) => value.log2_error().exp2(),
            Value::Fraction(_) => 0.0,
            Value::Enclosure(value) => value.log2_error().exp2(),
        }
    }

    /// `log₁₀` of half the width of an enclosure; `None` for what is none.
    pub fn log10_radius(&self) -> Option<f64> {
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
            Value::Double(value) => match *value.value() {
                0.0 => f.write_str("0"),
                value if (1e-4..1e9).contains(&value.abs()) || !value.is_finite() => write!(f, "{value}"),
                value => write!(f, "{value:e}"),
            },
            Value::Float(value) => f.write_str(&value.decimal(18)),
            Value::Fraction(value) => f.write_str(&value.text()),
            Value::Enclosure(value) => f.write_str(&show(&**value, 18)),
        }
    }
}

/// A number system that a route may answer in.
pub(crate) trait System: Bounded + Into<Value> {
    /// `eˣ` where the system has it.
    fn exponential(&self) -> Option<Self>;
}

macro_rules! systems {
    ($($name:ty: $variant:ident, $exponential:expr;)*) => {$(
        impl From<$name> for Value {
            #[allow(clippy::useless_conversion, reason = "an enclosure is boxed")]
            fn from(value: $name) -> Self {
                Value::$variant(value.into())
            }
        }

        impl System for $name {
            fn exponential(&self) -> Option<Self> {
                let exponential: fn(&Self) -> Option<Self> = $exponential;
                exponential(self)
            }
        }
    )*};
}
systems! {
    Interval: Enclosure, |x| Some(Analytic::exp(x));
    Estimate<f64>: Double, |x| Some(Analytic::exp(x));
    Estimate<Float>: Float, |x| Some(Analytic::exp(x));
    // No fraction but zero has a rational exponential.
    Rational: Fraction, |x| (x.vanishes() == Ok(true)).then(|| x.one());
}

/// Why there is no answer, or nothing can be asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoAnswer {
    #[error(transparent)]
    Solve(#[from] Error),
    #[error("found {quantity} asked of a scene that has none: {why}; expected another quantity")]
    NoSuchQuantity { quantity: &'static str, why: String },
    #[error("{0}")]
    GaveUp(String),
}

impl NoAnswer {
    /// The rod has no such quantity; which one, the question adds.
    pub fn none(why: impl Into<String>) -> Self {
        NoAnswer::NoSuchQuantity { quantity: "", why: why.into() }
    }

    pub fn gave_up(why: impl std::fmt::Display) -> Self {
        NoAnswer::GaveUp(why.to_string())
    }
}

impl From<dalembert::number::NumberError> for NoAnswer {
    fn from(error: dalembert::number::NumberError) -> Self {
        NoAnswer::gave_up(error)
    }
}
