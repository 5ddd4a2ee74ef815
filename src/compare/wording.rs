//! A hypothesis that holds, in words.

use super::judgement::{LEFT, Verdict};
use super::verdict::{Fitted, Hypothesis, Judge, NO_GRAVITY};
use crate::number::Scalar;
use crate::problem::Parameter;
use crate::quantity::Quantity;

impl Judge<'_> {
    pub(super) fn verdict(
        &self,
        kind: &'static str,
        hypothesis: Hypothesis,
        fitted: &Fitted,
        factors: &impl Fn(Quantity) -> Vec<(f64, &'static str)>,
    ) -> Verdict {
        let Fitted { value: p, error, .. } = *fitted;
        let percent = |p: f64, error: f64| format!("{:+.2} ± {:.2} %", 100.0 * p, 100.0 * error).replace('-', "−");
        let column = |place: usize| self.model.signals[place].what;
        let name = |place: usize| column(place).name().to_string();
        let of_all =
            |value: f64, error: f64, text: String| Verdict { kind, quantity: "all".into(), value, error, text };
        match hypothesis {
            Hypothesis::Value(Parameter::WaveSpeed) => {
                let modulus = percent((1.0 + p) * (1.0 + p) - 1.0, 2.0 * error);
                of_all(p, error, format!("wave speed off by {}, as by a modulus off by {modulus}", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Density) => {
                of_all(p, error, format!("mass off by {}: check density and mass matrix", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Speed) => {
                of_all(p, error, format!("velocity at the start off by {}", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Gravity) if p < -1.0 + 3.0 * error.max(NO_GRAVITY) => {
                of_all(-1.0, error, "no gravity: is the weight missing?".into())
            }
            Hypothesis::Value(parameter) => {
                of_all(p, error, format!("{} off by {}", parameter.name(), percent(p, error)))
            }
            Hypothesis::EndMass => {
                let text =
                    format!("the ends carry {} of the mass of the rod besides: check end masses", percent(p, error));
                of_all(p, error, text)
            }
            Hypothesis::Clock => {
                of_all(p, error, format!("clock off by {}: check the step of time", percent(p, error)))
            }
            Hypothesis::Late => {
                let (late, error) = (p * self.trip, error * self.trip);
                let side = if late > 0.0 { "late" } else { "early" };
                let steps = late.abs() / self.model.step;
                let (by, shift) = (late.abs().decimal(4), (-late).decimal(4));
                let text = format!(
                    "{by} ± {} {side}, {steps:.2} steps: is it on the same clock? A shift of {shift} undoes it",
                    error.decimal(2)
                );
                of_all(late, error, text)
            }
            Hypothesis::Factor(place) => {
                let (quantity, factor) = (name(place), 1.0 + p);
                if (factor + 1.0).abs() < (2.0 * error).max(LEFT * LEFT) {
                    let text = format!("{quantity} has the other sign");
                    return Verdict { kind: "sign", quantity, value: -1.0, error, text };
                }
                let near = |known: f64| (factor / known - 1.0).abs() < (2.0 * error / factor.abs()).max(0.02);
                let known: Vec<&str> = factors(column(place))
                    .into_iter()
                    .filter(|(value, _)| near(*value))
                    .map(|(_, name)| name)
                    .collect();
                let ask = if known.is_empty() { "which unit?".to_string() } else { known.join(" ") };
                let text = format!("{quantity} × {} ± {}: {ask}", factor.decimal(4), error.decimal(2));
                Verdict { kind, quantity, value: factor, error, text }
            }
            Hypothesis::Origin(place) => {
                let unit = self.trip * self.model.signals[place].rate;
                let (offset, error) = (p * unit, error * unit);
                let quantity = name(place);
                let text = format!(
                    "{quantity} off by {} ± {} everywhere: is it measured from elsewhere?",
                    offset.decimal(4),
                    error.decimal(2)
                );
                Verdict { kind, quantity, value: offset, error, text }
            }
        }
    }
}
