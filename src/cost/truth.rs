//! The reference that every error is measured against.

use super::value::Value;
use super::{CostError, Question};
use crate::scene::Plan;

/// A value and how far it may be from the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// The value.
    pub value: Value,
    /// `log₁₀` of what it may be off, −∞ where it is exact. Where that is not proved it is twice what separates two computations with
    /// different precision, one far beyond the other.
    pub log10_half_width: f64,
    /// Whether the value is exact or enclosed, not estimated.
    pub proved: bool,
}

/// The answer to `question` with `digits` decimal digits or more: a fraction where the undamped run stays in fractions, else an
/// enclosure where there is one, else twice in long numbers, by the closed form where it reaches and by the planned engine elsewhere.
///
/// **Accuracy**: see [`Truth::log10_half_width`].
///
/// **Errors**: those of the solver; [`CostError::NoSuchQuantity`].
///
/// ```
/// use dalembert::{Ask, Plan, Scene, cost::{Quantity, Question, truth}};
/// let scene = Scene::parse("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 3 }\ngravity = { acceleration = 1 }")?;
/// let question = Question::of(&scene, Some(Quantity::BounceTime), None)?;
/// let truth = truth(&question, &Plan::of(&scene, Ask::default())?, 30)?;
/// assert_eq!(truth.value.to_f64(), 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "mp")]
pub fn truth(question: &Question, plan: &Plan, digits: u32) -> Result<Truth, CostError> {
    use super::routes::{closed_in_bits, enclosed, fractions, to_digits};
    use crate::number::bits_for_digits;
    if let Some(value) = fractions(question, plan).and_then(Result::ok) {
        return Ok(Truth { value, log10_half_width: f64::NEG_INFINITY, proved: true });
    }
    if let Ok(Value::Enclosed(value)) = enclosed(question, digits) {
        let log10_half_width = value.radius().log10().to_f64();
        return Ok(Truth { value: Value::Enclosed(value), log10_half_width, proved: true });
    }
    let by_closed_form = question.of_first_contact().is_ok();
    let run = |digits: u32| {
        if by_closed_form {
            closed_in_bits(question, bits_for_digits(digits) + 64)
        } else {
            to_digits(question, plan, digits)
        }
    };
    // Rays that cancel, or a root that is double, take digits: each attempt has more of them.
    let mut more = 0;
    loop {
        let (near, value) = (run(digits + more)?, run(digits + more + more / 4 + 12)?);
        let log10_half_width = near.log10_apart(&value) + std::f64::consts::LOG10_2;
        let scale = value.to_f64().abs().log10().max(-290.0);
        // Equal to the last bit: no better than the shorter of the two.
        let log10_half_width = log10_half_width.max(scale - f64::from(digits + more) - 12.0);
        if log10_half_width <= scale - f64::from(digits) || more >= 4 * digits.max(50) {
            return Ok(Truth { value, log10_half_width, proved: false });
        }
        more = (2 * more).max(digits / 2 + 20);
    }
}

/// The answer to `question` in doubles, which is the best that a build without long numbers has.
///
/// **Accuracy**: see [`Truth::log10_half_width`]: the error estimate of the run.
///
/// **Errors**: those of the solver; [`CostError::NoSuchQuantity`].
#[cfg(not(feature = "mp"))]
pub fn truth(question: &Question, plan: &Plan, _digits: u32) -> Result<Truth, CostError> {
    let value = super::routes::planned(question, plan)?;
    let log10_half_width = (value.to_f64().abs() * 1e-13).log10();
    Ok(Truth { value, log10_half_width, proved: false })
}
