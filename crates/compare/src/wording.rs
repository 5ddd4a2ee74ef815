//! A hypothesis that holds, in words.

use super::ours::Ours;
use super::unfitted::{LEFT, Verdict};
use super::verdict::{Fitted, Hypothesis, Judge, NO_GRAVITY};
use dalembert::number::Scalar;
use dalembert::problem::Parameter;

impl Judge<'_> {
    pub(super) fn verdict(
        &self,
        kind: &'static str,
        hypothesis: Hypothesis,
        fitted: &Fitted,
        ours: &Ours<'_>,
    ) -> Verdict {
        let Fitted { value: p, error, .. } = *fitted;
        let percent = |p: f64, error: f64| format!("{:+.2} ± {:.2} %", 100.0 * p, 100.0 * error).replace('-', "−");
        let (off, column) = (percent(p, error), |place: usize| self.model.signals[place].what);
        let mut verdict = Verdict { kind, quantity: "all", value: p, error, text: String::new() };
        verdict.text = match hypothesis {
            Hypothesis::Value(Parameter::WaveSpeed) => {
                let modulus = percent((1.0 + p) * (1.0 + p) - 1.0, 2.0 * error);
                format!("wave speed off by {off}, as by a modulus off by {modulus}")
            }
            Hypothesis::Value(Parameter::Density) => format!("mass off by {off}: check density and mass matrix"),
            Hypothesis::Value(Parameter::ImpactSpeed) => format!("velocity at the start off by {off}"),
            Hypothesis::Value(Parameter::Gravity) if p < -1.0 + 3.0 * error.max(NO_GRAVITY) => {
                verdict.value = -1.0;
                "no gravity: is the weight missing?".into()
            }
            Hypothesis::Value(parameter) => format!("{} off by {off}", parameter.name()),
            Hypothesis::EndMass => format!("the ends carry {off} of the mass of the rod besides: check end masses"),
            Hypothesis::Clock => format!("clock off by {off}: check the step of time"),
            Hypothesis::Late => {
                let (late, error) = (p * self.trip, error * self.trip);
                (verdict.value, verdict.error) = (late, error);
                let (side, steps) = (if late > 0.0 { "late" } else { "early" }, late.abs() / self.model.step);
                let (by, error, shift) = (late.abs().decimal(4), error.decimal(2), (-late).decimal(4));
                format!(
                    "{by} ± {error} {side}, {steps:.2} steps: is it on the same clock? A shift of {shift} undoes it"
                )
            }
            Hypothesis::Factor(place) => {
                let (what, factor) = (column(place), 1.0 + p);
                (verdict.quantity, verdict.value) = (what.name(), factor);
                if (factor + 1.0).abs() < (2.0 * error).max(LEFT * LEFT) {
                    (verdict.kind, verdict.value) = ("sign", -1.0);
                    format!("{} has the other sign", what.name())
                } else {
                    let near = |known: f64| (factor / known - 1.0).abs() < (2.0 * error / factor.abs()).max(0.02);
                    let known = ours.factors(what).into_iter().filter(|(value, _)| near(*value));
                    let known: Vec<&str> = known.map(|(_, question)| question).collect();
                    let ask = if known.is_empty() { "which unit?".to_string() } else { known.join(" ") };
                    format!("{} × {} ± {}: {ask}", what.name(), factor.decimal(4), error.decimal(2))
                }
            }
            Hypothesis::Origin(place) => {
                let unit = self.trip * self.model.signals[place].rate;
                let (offset, error) = (p * unit, error * unit);
                (verdict.quantity, verdict.value, verdict.error) = (column(place).name(), offset, error);
                let (name, offset, error) = (verdict.quantity, offset.decimal(4), error.decimal(2));
                format!("{name} off by {offset} ± {error} everywhere: is it measured from elsewhere?")
            }
        };
        verdict
    }
}
