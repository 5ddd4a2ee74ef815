//! What needs numbers longer than doubles: differences of any two values, and the formulas in such numbers.

use rug::ops::Pow;
use rug::{Float, Rational};

use super::account::{ByClosedForm, unbounded};
use super::quantity::Question;
use super::value::{NoAnswer, Value};
use dalembert::number::{Estimate, bits_for_digits};
use dalembert::problem::Parameters;

/// Whether this build has such numbers.
pub const AVAILABLE: bool = true;
/// Bits beyond the digits that the closed form is asked for.
const SPARE_BITS: u32 = 16;

/// A formula in many digits; its argument makes `p/q` in that many.
pub type Formula = fn(&dyn Fn(i32, i32) -> Float) -> Float;

fn middle(value: &Value) -> Option<Rational> {
    match value {
        Value::Double(value) => Rational::from_f64(*value.value()),
        Value::Float(value) => value.value().to_rational(),
        Value::Fraction(value) => Some(value.clone()),
        Value::Enclosure(value) => value.mid().to_rational(),
    }
}

/// `log₁₀ |a − b|`, with the middle of an enclosure: −∞ where the two are equal, ∞ where one is not finite. An error of
/// a thousand digits has no double.
///
/// **Accuracy**: the difference is rounded once, to 64 bits.
pub fn log10_apart(a: &Value, b: &Value) -> f64 {
    let (Some(a), Some(b)) = (middle(a), middle(b)) else { return f64::INFINITY };
    let apart = Float::with_val(64, a - b).abs();
    if apart.is_zero() { f64::NEG_INFINITY } else { apart.log10().to_f64() }
}

/// Whether an enclosure holds a number that is within `10^place` of `truth`, a whole place or −∞.
pub fn holds(value: &Value, truth: &Value, place: f64) -> bool {
    let (Value::Enclosure(value), Some(truth)) = (value, middle(truth)) else { return false };
    let slack = if place.is_finite() { Rational::from(10).pow(place as i32) } else { Rational::new() };
    *value.lo() <= truth.clone() + &slack && *value.hi() >= truth - slack
}

pub fn formula(digits: u32, formula: Formula) -> Value {
    let bits = bits_for_digits(digits) + SPARE_BITS;
    unbounded(formula(&|p, q| Float::with_val(bits, Rational::from((p, q))))).into()
}

pub fn closed_form(question: &Question, digits: u32) -> Result<Value, NoAnswer> {
    let bits = bits_for_digits(digits) + SPARE_BITS;
    let rod = Parameters::<Estimate<Float>>::of(&question.problem, &bits)?;
    question.ask(&rod, &ByClosedForm::new(&rod))
}
