//! The diagnosis of data: the causes that fit, and symptoms that need no fit.

use schemars::JsonSchema;
use serde::Serialize;

use super::agreement::Agreement;
use super::audit::Audit;
use super::cause::{Cause, GENERAL};
use super::cause_fits::{Candidate, CauseFits, Fitted, LEFT_BY_DAMPING};
use super::hint::{Detectable, Hint};
use super::model::Model;
use super::reference::Reference;
use super::symptoms::{
    FEWEST, empty_column, fronts_spread, half_step, is_empty, lost_start, no_potential, other_body, other_units,
    other_way, turned_axis, unlike_mass, unstable_energy,
};
use dalembert::Error;
use dalembert::chain::{ChainParameter, ChainValue};
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::Measure;

/// Largest number of times of a model.
const SAMPLES: usize = 150;
/// Largest number of round trips over which a damped run is tried for an undamped rod.
const DAMPED_TRIPS: f64 = 200.0;

/// The result of a diagnosis.
#[derive(Debug, Default, JsonSchema, Serialize)]
pub(crate) struct Diagnosis {
    pub(crate) hints: Vec<Hint>,
    /// The values from which on a wrong number would be named; empty where one is, or where that is not known.
    #[serde(rename = "told_from")]
    pub(crate) detectable: Vec<Detectable>,
    /// The time over which the fronts of the data are spread; null where that is not known, within a step, or more than
    /// a quarter of a round trip.
    pub(crate) spread: Option<f64>,
}

impl Diagnosis {
    /// Finds the causes of the misfit of data; for a field, none.
    pub(super) fn new(reference: &Reference<'_>, agreement: &Agreement) -> Result<Self, Error> {
        if agreement.grid.points.is_some() {
            return Ok(Diagnosis::default());
        }
        let mut diagnosis = Diagnosis { spread: fronts_spread(reference, agreement)?, ..Diagnosis::default() };
        diagnosis.find(reference, agreement)?;
        Ok(diagnosis)
    }

    fn find(&mut self, reference: &Reference<'_>, agreement: &Agreement) -> Result<(), Error> {
        let (history, columns) = (reference.history, agreement.quantities.as_slice());
        if let Some(alone) =
            lost_start(columns).or_else(|| turned_axis(columns)).or_else(|| other_way(columns, reference))
        {
            self.hints = vec![alone];
            return Ok(());
        }
        self.hints = other_units(columns, reference);
        if self.hints.is_empty() {
            self.hints.extend(no_potential(reference, agreement)?);
        }
        if !self.hints.is_empty() {
            return Ok(());
        }
        self.hints = columns.iter().filter(|column| is_empty(column)).map(empty_column).collect();
        if agreement.grid.times.len() < FEWEST || columns.iter().all(is_empty) {
            return Ok(());
        }
        // Up to the end of the flight after the first contact.
        let release = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
        let until = history.events().iter().map(|event| event.t).find(|time| *time > release);
        let model = Model::new(reference, agreement, until.unwrap_or(f64::INFINITY), SAMPLES)?;
        let Some(last) = model.times.last().copied().filter(|_| model.times.len() >= FEWEST) else { return Ok(()) };
        if let Some(hint) = other_body(&model) {
            self.hints.push(hint);
            return Ok(());
        }
        let trip = history.scales().time;
        let first = history.contacts().first().map_or(0.0, |contact| contact.impact);
        let exact = model.values(model.problem, |time| time)?;
        let part_ends = [first, first + trip / 2.0, release].into_iter().filter(|end| *end > 0.0).collect();
        let base = model.errors(&exact);
        let mut fits = CauseFits { model, base, exact, candidates: Vec::new(), part_ends, trip };
        let unstable = unstable_energy(columns);
        let mut causes = GENERAL.to_vec();
        causes.extend(causes_of_chain(fits.model.problem));
        // Damped rods are followed round trip by round trip.
        causes.retain(|(_, cause)| *cause != Cause::Damping || fits.damping() > 0.0 || last < DAMPED_TRIPS * trip);
        if unstable.is_none() {
            causes.extend(causes_of_columns(&fits.model));
        }
        let candidate = |(kind, cause)| Some(Candidate { kind, cause, slope: fits.slopes(cause, 0.0, &fits.base)? });
        fits.candidates = causes.into_iter().filter_map(candidate).collect();
        // A cause is asserted where no other one explains the data about as well. A scheme that takes up energy looks
        // like damping that is too strong, but for errors of its own.
        let hints = |fits: &CauseFits<'_>, best: &[Fitted]| -> Vec<Hint> {
            let is_like_scheme =
                |fit: &&Fitted| fit.cause == Cause::Damping && fit.value > 0.0 && fit.share_left > LEFT_BY_DAMPING;
            let scheme = best.iter().find(is_like_scheme);
            let asserted = best.len() == 1 && scheme.is_none();
            let hints = best.iter().map(|fit| fits.hint(fit.kind, fit, reference));
            let scheme = scheme.map(|fit| Hint {
                text:
                    "a scheme that takes up energy by itself: halve mesh and step, and see whether the damping halves"
                        .into(),
                ..fits.hint("numerical_damping", fit, reference)
            });
            hints.chain(scheme).map(|hint| Hint { asserted, ..hint }).collect()
        };
        if !fits.is_resolved(&fits.base) {
            self.hints.extend(hints(&fits, &fits.best_unresolved()));
            if self.hints.is_empty() {
                self.detectable = fits.detectable();
            }
            return Ok(());
        }
        // A column that is wrong by itself is corrected before the others are looked at.
        while self.hints.len() <= columns.len() {
            let best = fits.best();
            if best.is_empty() || fits.is_soft_mesh(&best) {
                break;
            }
            self.hints.extend(hints(&fits, &best));
            if best.len() > 1 || !fits.correct(&best[0]) {
                break;
            }
        }
        if self.hints.is_empty() {
            if unstable.is_none() {
                self.detectable = fits.detectable();
            }
            let symptom = unstable.or_else(|| half_step(reference, agreement));
            self.hints.extend(symptom.or_else(|| unlike_mass(reference, agreement)));
        }
        self.hints.extend(unpaired_hints(&agreement.audit));
        Ok(())
    }
}

/// Returns the hints at contacts without a partner.
fn unpaired_hints(audit: &Audit) -> impl Iterator<Item = Hint> {
    let unpaired = [
        (audit.missed, "missed", "of ours that are not in theirs"),
        (audit.invented, "invented", "of theirs that are not in ours"),
    ];
    unpaired.into_iter().filter(|(count, ..)| *count > 0).map(|(count, kind, whose)| {
        let text = format!("contacts {whose}: {count}; see the table of contacts");
        Hint { quantity: "contact", ..Hint::new(kind, count as f64, text) }
    })
}

/// Returns the values of a chain that may be wrong, and the contacts that may be soft, beside those of every rod.
fn causes_of_chain(problem: &Problem) -> Vec<(&'static str, Cause)> {
    let Some((chain, body)) = problem.chain() else { return Vec::new() };
    let is_of_rod = |parameter: &ChainParameter| {
        use ChainValue::{Density, Length, Modulus, Stiffness, WaveSpeed};
        let is_own = parameter.body() == Some(body) || parameter.node(&chain) == Some(body);
        is_own && matches!(parameter.value(), Length | Modulus | Density | WaveSpeed | Stiffness)
    };
    let is_zero = |parameter: &ChainParameter| chain.value(*parameter).is_none_or(|value| value.is_zero());
    let parameters = chain.parameters().filter(|parameter| !is_of_rod(parameter) && !is_zero(parameter));
    let values = parameters.map(Parameter::OfChain).map(|parameter| (parameter.path(), Cause::Value(parameter)));
    // A single contact is what all of them are.
    let soft: Vec<usize> = chain.rigid_contacts().collect();
    let soft = soft.iter().filter(|_| soft.len() > 1).map(|node| ("soft_contact", Cause::SoftContact(Some(*node))));
    values.chain(soft).collect()
}

/// Returns the causes that concern one column each.
fn causes_of_columns(model: &Model<'_>) -> Vec<(&'static str, Cause)> {
    let mut causes = Vec::new();
    for (k, signal) in model.signals.iter().enumerate().filter(|(_, signal)| !signal.is_zero) {
        let kind = match signal.column.measure() {
            Some(Measure::Energy) => "energy_factor",
            Some(Measure::Force | Measure::Stress | Measure::Strain | Measure::Impulse) => "force_factor",
            _ => "factor",
        };
        causes.push((kind, Cause::Factor(k)));
        if signal.column.measure() == Some(Measure::Length) {
            causes.push(("origin", Cause::Offset(k)));
        }
    }
    causes
}
