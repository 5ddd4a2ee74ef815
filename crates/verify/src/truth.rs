//! What answers are held against: a number that the catalogue spells, or one that the best route computes.

use super::long;
use super::quantity::Question;
use super::route::{Numbers, Route};
use super::value::{NoAnswer, Value};
use dalembert::number::Number;

/// A number and how far it may be from the truth.
#[derive(Clone, Debug)]
pub struct Truth {
    pub value: Value,
    /// `log₁₀` of what it may be off, −∞ where it is exact. Where that is not proved it is twice what separates two
    /// computations with different precision, one far beyond the other.
    pub log10_half_width: f64,
    /// Whether the value is exact or enclosed, not estimated.
    pub proved: bool,
}

impl Truth {
    /// The truth that `text` spells: an integer or a fraction is exact, a decimal is right to a unit of its last digit.
    /// `None` for what is no number.
    pub fn spelt(text: &str) -> Option<Self> {
        let number: Number = text.parse().ok()?;
        let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
        // A whole unit: the last digit may have been cut instead of rounded.
        let last_place = |after: &str| exponent.parse().unwrap_or(0.0) - after.len() as f64;
        let log10_half_width = mantissa.split_once('.').map_or(f64::NEG_INFINITY, |(_, after)| last_place(after));
        Some(Truth { value: number.to_rational().into(), log10_half_width, proved: true })
    }

    /// The answer to `question` with `digits` decimal digits or more: a fraction where the undamped run stays in
    /// fractions, else an enclosure where there is one, else twice in long numbers by the planned engine. A build
    /// without long numbers has its best doubles where fractions end.
    pub fn computed(question: &Question, digits: u32) -> Result<Self, NoAnswer> {
        let of = |value: Value, log10_half_width: f64, proved: bool| Ok(Truth { value, log10_half_width, proved });
        let run = |route: Route| route.run(question, f64::INFINITY);
        if question.problem.rod.damping.is_none()
            && let Ok(value) = run(Route::Lattice(Numbers::Exact))
        {
            return of(value, f64::NEG_INFINITY, true);
        }
        if !long::AVAILABLE {
            let value = run(Route::Planned(Numbers::Double(None)))?;
            let log10_half_width = (value.to_f64().abs() * 1e-13).log10();
            return of(value, log10_half_width, false);
        }
        if let Ok(value) = run(Route::Planned(Numbers::Certified(digits)))
            && let Some(log10_half_width) = value.log10_radius()
        {
            return of(value, log10_half_width, true);
        }
        let run = |digits: u32| run(Route::Planned(Numbers::Digits(digits)));
        // Rays that cancel, or a root that is double, take digits: each attempt has more of them.
        let mut more = 0;
        loop {
            let (near, value) = (run(digits + more)?, run(digits + more + more / 4 + 12)?);
            let log10_half_width = long::log10_apart(&near, &value) + std::f64::consts::LOG10_2;
            let scale = value.to_f64().abs().log10().max(-290.0);
            // Equal to the last bit: no better than the shorter of the two.
            let log10_half_width = log10_half_width.max(scale - f64::from(digits + more) - 12.0);
            if log10_half_width <= scale - f64::from(digits) || more >= 4 * digits.max(50) {
                return of(value, log10_half_width, false);
            }
            more = (2 * more).max(digits / 2 + 20);
        }
    }

    /// `log₁₀` of what errors are relative to: the truth itself, or 1 where that is zero.
    pub fn log10_scale(&self) -> f64 {
        let scale = self.value.to_f64().abs().log10();
        if scale.is_finite() { scale } else { 0.0 }
    }

    /// `log₁₀` of the relative error of `value`, −∞ where there is none.
    pub fn log10_error(&self, value: &Value) -> f64 {
        long::log10_apart(value, &self.value) - self.log10_scale()
    }

    /// Digits to which an answer can be compared with it.
    pub fn most_digits(&self) -> f64 {
        self.log10_scale().floor() - self.log10_half_width
    }

    /// How many digits of `value` are right, `−log₁₀` of the relative error as far as the truth is known: of an
    /// enclosure those that both ends have in common with the truth, none where it lies outside; infinite for the truth
    /// itself.
    pub fn right_digits(&self, value: &Value) -> f64 {
        let log10_error = match value.log10_radius() {
            None => self.log10_error(value),
            Some(_) if !long::holds(value, &self.value, self.log10_half_width) => f64::INFINITY,
            Some(radius) => radius - self.log10_scale(),
        };
        (-log10_error).clamp(0.0, self.most_digits())
    }
}

#[cfg(test)]
#[path = "tests/truth.rs"]
mod tests;
