//! What stands for `long` in a build without multiple precision: differences of doubles, and routes that are not there.

use super::quantity::Question;
use super::value::{Answer, NoAnswer, Value};
use crate::error::Error;
use crate::number::Number;

pub(crate) const AVAILABLE: bool = false;

pub(crate) type Digits = f64;

pub(crate) type Formula = fn(&dyn Fn(i32, i32) -> Digits) -> Digits;

pub(super) fn exact(number: &Number) -> Value {
    Value::Double(number.to_f64())
}

pub(super) fn log10_apart(a: &Value, b: &Value) -> f64 {
    let apart = (a.to_f64() - b.to_f64()).abs();
    if apart.is_finite() { apart.log10() } else { f64::INFINITY }
}

pub(super) fn holds(_: &Value, _: &Value, _: Option<i32>) -> bool {
    false
}

pub(super) fn formula(_: u32, formula: Formula) -> Value {
    Value::Double(formula(&|p, q| f64::from(p) / f64::from(q)))
}

pub(super) fn closed_form(_: &Question, _: u32) -> Result<Answer, NoAnswer> {
    Err(Error::NoMultiprecision.into())
}

pub(super) fn lattice(_: &Question) -> Result<Answer, NoAnswer> {
    Err(Error::NoMultiprecision.into())
}

pub(super) fn printed_forms(_: &Question) -> Result<Answer, NoAnswer> {
    Err(Error::NoMultiprecision.into())
}
