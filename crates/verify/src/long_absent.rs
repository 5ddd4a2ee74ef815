//! What stands for `long` in a build without multiple precision: differences of fractions and doubles, and formulas in
//! doubles.

use super::account::unbounded;
use super::quantity::Question;
use super::value::{NoAnswer, Value};
use dalembert::Error;
use dalembert::number::{Rational, Scalar};

pub const AVAILABLE: bool = false;

pub type Formula = fn(&dyn Fn(i32, i32) -> f64) -> f64;

/// `log₁₀ |a − b|`. **Accuracy**: the difference is rounded once.
pub fn log10_apart(a: &Value, b: &Value) -> f64 {
    let exact = |value: &Value| match value {
        Value::Fraction(value) => Some(value.clone()),
        value => Some(value.to_f64()).filter(|value| value.is_finite()).map(|value| Rational::default().double(value)),
    };
    let (Some(a), Some(b)) = (exact(a), exact(b)) else { return f64::INFINITY };
    Scalar::to_f64(&(a - b)).abs().log10()
}

pub fn holds(_: &Value, _: &Value, _: f64) -> bool {
    false
}

pub fn formula(_: u32, formula: Formula) -> Value {
    unbounded(formula(&|p, q| f64::from(p) / f64::from(q))).into()
}

pub fn closed_form(_: &Question, _: u32) -> Result<Value, NoAnswer> {
    Err(Error::NoMultiprecision.into())
}
