//! The wording of hints.

use super::cause::Cause;
use super::cause_fits::{CauseFits, Fitted, LEFT, NO_GRAVITY};
use super::hint::Hint;
use super::reference::Reference;
use dalembert::Quantity;
use dalembert::number::Scalar;
use dalembert::problem::Parameter;

/// Time by which a contact with a spring ground lasts longer than `2L/c`, in units of `EA/k` over the wave speed.
///
/// **Source**: for a free rod without gravity that hits a stiff spring, the root of `e^x = 2 + 2x`.
const EXTENSION: f64 = 1.678_346_990_016_660_7;

fn percent(p: f64, error: f64) -> String {
    format!("{:+.2} ± {:.2} %", 100.0 * p, 100.0 * error).replace('-', "−")
}

impl CauseFits<'_> {
    /// Returns the hint at a cause.
    pub(super) fn hint(&self, kind: &'static str, fitted: &Fitted, reference: &Reference<'_>) -> Hint {
        let Fitted { value: p, error, cause, .. } = *fitted;
        let (off, column) = (percent(p, error), |place: usize| self.model.signals[place].column);
        let mut hint = Hint { error, ..Hint::new(kind, p, String::new()) };
        hint.text = match cause {
            Cause::Value(Parameter::WaveSpeed) => {
                let modulus = percent((1.0 + p) * (1.0 + p) - 1.0, 2.0 * error);
                format!("wave speed off by {off}, as by a modulus off by {modulus}")
            }
            Cause::Value(Parameter::Density) => format!("mass off by {off}: check density and mass matrix"),
            Cause::Value(Parameter::ImpactSpeed) => format!("velocity at the start off by {off}"),
            Cause::Value(Parameter::Gravity) if p < -1.0 + 3.0 * error.max(NO_GRAVITY) => {
                hint.value = -1.0;
                "no gravity: is the weight missing?".into()
            }
            Cause::Value(Parameter::Stiffness) => format!("contact stiffness off by {off}"),
            Cause::Value(parameter) => format!("{parameter} off by {off}"),
            Cause::Damping => {
                let (scene, error) = (self.damping(), error / self.trip);
                (hint.value, hint.error) = (scene + p / self.trip, error);
                let (found, error) = (hint.value.decimal(4), error.decimal(2));
                let instead = if scene == 0.0 { "none".into() } else { scene.decimal(4) };
                format!("damping r = {found} ± {error} where the scene has {instead}")
            }
            Cause::SoftContact(node) => soft_contact((p, error), node, reference),
            Cause::EndMass => format!("the ends carry {off} of the mass of the rod besides: check end masses"),
            Cause::Clock => format!("clock off by {off}: check the step of time"),
            Cause::TimeShift => {
                let (late, error) = (p * self.trip, error * self.trip);
                (hint.value, hint.error) = (late, error);
                let (side, steps) = (if late > 0.0 { "late" } else { "early" }, late.abs() / self.model.step);
                let (by, error, shift) = (late.abs().decimal(4), error.decimal(2), (-late).decimal(4));
                let gap = gap_instead(late, reference).unwrap_or_default();
                format!(
                    "{by} ± {error} {side}, {steps:.2} steps: is it on the same clock{gap}? A shift of {shift} undoes it"
                )
            }
            Cause::Factor(place) => {
                let (what, factor) = (column(place), 1.0 + p);
                hint.quantity = what.name();
                if (factor + 1.0).abs() < (2.0 * error).max(LEFT * LEFT) {
                    (hint.kind, hint.value) = ("sign", -1.0);
                    format!("{} has the other sign", what.name())
                } else {
                    hint.value = factor;
                    let question = factor_question(what, factor, error, reference);
                    format!("{} × {} ± {}: {question}", what.name(), factor.decimal(4), error.decimal(2))
                }
            }
            Cause::Offset(place) => {
                let unit = self.trip * self.model.signals[place].rate;
                let (offset, error) = (p * unit, error * unit);
                (hint.quantity, hint.value, hint.error) = (column(place).name(), offset, error);
                let (name, offset, error) = (hint.quantity, offset.decimal(4), error.decimal(2));
                format!("{name} off by {offset} ± {error} everywhere: is it measured from elsewhere?")
            }
        };
        hint
    }
}

/// Returns the hint at a contact, or that at a node, whose softness is this share of that of the rod, within the error.
fn soft_contact((share, error): (f64, f64), node: Option<usize>, reference: &Reference<'_>) -> String {
    let rod = reference.rod();
    let chain = reference.history.problem().chain();
    let place = node.zip(chain.as_ref()).map(|(node, (chain, _))| format!(", {}", chain.node_name(node)));
    let (softness, error) = (share * rod.length, error * rod.length);
    let after = match chain {
        // The contact of a chain ends by the waves of all of its bodies.
        Some(_) => String::new(),
        None => format!(", and the contact lasts longer by {}", (EXTENSION * softness / rod.wave_speed).decimal(3)),
    };
    let (place, softness, error) = (place.unwrap_or_default(), softness.decimal(4), error.decimal(2));
    format!(
        "contact too soft (penalty{place}): stiffness k with EA/k = {softness} ± {error}; the end penetrates{after}"
    )
}

/// Returns the question whether another gap of the scene makes the impact `late`; `None` for a start without a gap.
fn gap_instead(late: f64, reference: &Reference<'_>) -> Option<String> {
    let (gap, rod) = (reference.history.problem().gap()?.to_f64(), reference.rod());
    let more = late * (rod.speed.powi(2) + 2.0 * rod.gravity * gap).sqrt();
    Some(format!(", or is the gap {} by {}", if more > 0.0 { "longer" } else { "shorter" }, more.abs().decimal(3)))
}

/// Returns the questions about the known factors of a quantity that are near `factor`.
pub(super) fn factor_question(what: Quantity, factor: f64, error: f64, reference: &Reference<'_>) -> String {
    let is_near = |known: f64| {
        let ratio = factor / known;
        ratio > 0.0 && ratio.max(1.0 / ratio) - 1.0 < (2.0 * error / factor.abs()).max(0.02)
    };
    let known = reference.known_factors(what).into_iter().filter(|known| is_near(known.value));
    let known: Vec<&str> = known.map(|known| known.question).collect();
    if known.is_empty() { "which unit?".to_string() } else { known.join(" ") }
}
