//! The truth that answers are compared with: a number that the catalogue spells, or one that the best route computes.

use super::route::{Question, Route};
use super::value::{encloses, log10_distance, log10_radius};
use crate::error::VerifyError;
use dalembert::Value;
use dalembert::number::Number;
use dalembert::solve::Numbers;

/// A number and the distance that it may have from the truth.
#[derive(Clone, Debug)]
pub struct Truth {
    pub(crate) value: Value,
    /// `log₁₀` of the greatest distance from the truth, −∞ where the number is exact. Where it is not proved, it is
    /// twice the distance of two computations, one in far more digits than the other.
    pub log10_half_width: f64,
    /// Whether the value is exact or enclosed, not estimated.
    pub proved: bool,
}

impl Truth {
    /// Reads a truth: an integer or a fraction is exact, a decimal is right to a unit of its last digit. `None` for a
    /// text that is no number.
    pub(crate) fn from_text(text: &str) -> Option<Self> {
        let number: Number = text.parse().ok()?;
        let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
        // A whole unit, not half of one: the last digit may have been cut instead of rounded.
        let last_place = |after: &str| exponent.parse().unwrap_or(0.0) - after.len() as f64;
        let log10_half_width = mantissa.split_once('.').map_or(f64::NEG_INFINITY, |(_, after)| last_place(after));
        Some(Truth { value: number.to_rational().into(), log10_half_width, proved: true })
    }

    /// Computes the answer to `question` with at least `digits` decimal digits: a fraction where the undamped run stays
    /// in fractions, else an enclosure where there is one, else twice in long numbers by the planned engine.
    pub(crate) fn compute(question: &impl Question, digits: u32) -> Result<Self, VerifyError> {
        let run = |route: Route| question.answer(route, f64::INFINITY);
        if let Some(Ok(value)) = question.exact_route().map(run) {
            return Ok(Truth { value, log10_half_width: f64::NEG_INFINITY, proved: true });
        }
        if let Ok(value) = run(Route::Planned(Numbers::Certified(digits)))
            && let Some(log10_half_width) = log10_radius(&value)
        {
            return Ok(Truth { value, log10_half_width, proved: true });
        }
        let run = |digits: u32| run(Route::Planned(Numbers::Digits(digits)));
        // Rays that cancel, or a double root, take digits: each attempt has more of them.
        let mut more = 0;
        loop {
            let (near, value) = (run(digits + more)?, run(digits + more + more / 4 + 12)?);
            let scale = value.to_f64().abs().log10().max(-290.0);
            // Two values that are equal to the last bit are no better than the shorter of them.
            let rounding = scale - f64::from(digits + more) - 12.0;
            let log10_half_width = (log10_distance(&near, &value) + std::f64::consts::LOG10_2).max(rounding);
            if log10_half_width <= scale - f64::from(digits) || more >= 4 * digits.max(50) {
                return Ok(Truth { value, log10_half_width, proved: false });
            }
            more = (2 * more).max(digits / 2 + 20);
        }
    }

    /// Returns the nearest double.
    pub fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    /// Returns `log₁₀` of the scale of relative errors: the truth itself, or 1 where that is zero.
    pub(crate) fn log10_scale(&self) -> f64 {
        let scale = self.value.to_f64().abs().log10();
        if scale.is_finite() { scale } else { 0.0 }
    }

    /// Returns `log₁₀` of the relative error of `value`, −∞ where there is none.
    pub(crate) fn log10_error(&self, value: &Value) -> f64 {
        log10_distance(value, &self.value) - self.log10_scale()
    }

    /// Returns the number of digits to which the truth is known.
    pub(crate) fn most_digits(&self) -> f64 {
        self.log10_scale().floor() - self.log10_half_width
    }

    /// Returns the number of right digits of `value`: `−log₁₀` of the relative error, as far as the truth is known.
    /// Those of an enclosure are the digits that both ends share with the truth, none where it lies outside. The truth
    /// itself has infinitely many.
    pub(crate) fn right_digits(&self, value: &Value) -> f64 {
        let log10_error = match log10_radius(value) {
            None => self.log10_error(value),
            Some(_) if !encloses(value, &self.value, self.log10_half_width) => f64::INFINITY,
            Some(radius) => radius - self.log10_scale(),
        };
        (-log10_error).clamp(0.0, self.most_digits())
    }
}

#[cfg(test)]
#[path = "tests/truth.rs"]
mod tests;
