//! Data beside an exact history: norms, contacts and audit.

use schemars::JsonSchema;
use serde::Serialize;

use super::audit::{Audit, AuditInput, MomentumTerms};
use super::contacts::{ContactPair, ContactRecord, find_contacts, match_contacts};
use super::norms::{ComparedColumn, Grid, Norms, WEIGHTS};
use super::options::Options;
use super::reference::{NearRays, Reference};
use super::samples::Samples;
use dalembert::Error;
use dalembert::chain::End;
use dalembert::number::Number;
use dalembert::problem::Top;
use dalembert::quantity::{Quantity, Units};

/// The samples of a source beside the exact values, and what differs.
#[derive(Debug, Default, JsonSchema, Serialize)]
pub struct Agreement {
    /// The times of the samples, and their points for a field.
    #[serde(skip)]
    pub grid: Grid,
    /// The definition of the norms.
    pub(crate) weights: &'static str,
    /// The median step of the samples.
    pub(crate) step: f64,
    /// The distance from a jump, in time, from which on a sample counts as away from it.
    pub(crate) window: f64,
    /// The number of rows before `t = 0`, which are not compared.
    pub(crate) outside: usize,
    /// Remarks on how the file was read.
    pub(crate) notes: Vec<String>,
    pub(crate) coverage: Coverage,
    /// The columns of the data that were compared.
    pub quantities: Vec<ComparedColumn>,
    pub(crate) contacts: Vec<ContactPair>,
    pub(crate) audit: Audit,
}

/// The part of the run that the data cover.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Coverage {
    /// The end of the data, and the end of the run of the scene.
    pub time: [f64; 2],
    /// The number of whole exact contacts up to the end of the data, and of the run.
    pub contacts: [usize; 2],
    pub breaks_off: bool,
}

impl Coverage {
    /// Returns the share of the time of the run that the data cover.
    pub(crate) fn share(&self) -> f64 {
        if self.time[1] > 0.0 { (self.time[0] / self.time[1]).min(1.0) } else { 1.0 }
    }
}

/// Default distance from a jump, in round trips, from which on a sample counts as away from it.
const WINDOW: f64 = 0.02;
/// Multiple of the median force in flight, which is noise, that is a force of a contact.
const ABOVE_NOISE: f64 = 8.0;

/// Largest share of the greatest force that counts as noise.
const MOST_NOISE: f64 = 0.1;

/// Least force of a sample in contact, as a share of the greatest exact force.
const LEAST_FORCE: f64 = 1e-6;

impl Agreement {
    /// Compares `samples` with `reference`, in `units`; they should go up to `until`.
    ///
    /// **Source**: a sample on a jump is compared with the limit that its row is said to hold, otherwise with the
    /// nearer of the two limits; its time is that of the jump within the rounding of the times.
    ///
    /// **Accuracy**: that of the history, in doubles.
    pub(super) fn new(
        reference: &Reference<'_>,
        units: &Units,
        samples: Samples,
        options: &Options,
        until: Option<f64>,
    ) -> Result<Self, Error> {
        let Samples { grid, mut quantities, step, outside, notes, rounding, sides } = samples;
        let trip = reference.history.scales().time;
        options.apply(reference, &mut quantities, grid.points.as_deref())?;
        let window = options.window.as_ref().map(|trips| Number::to_f64(trips) * trip);
        let window = window.unwrap_or((2.0 * step).max(WINDOW * trip));
        let whats: Vec<Quantity> = quantities.iter().map(|(what, _)| *what).collect();
        let values = reference.values(&whats, &grid)?;
        let mut compared = Vec::new();
        for ((what, theirs), mut ours) in quantities.into_iter().zip(values) {
            let times = reference.nearest_rays(what, &grid);
            let near = NearRays { times: &times, rounding: &rounding, sides: &sides };
            let on_jumps = reference.choose_limits(what, &grid, near, &theirs, &mut ours)?;
            let away = |k: usize| times.get(k).is_none_or(|jump| (jump - grid.times[k]).abs() > window);
            let norms = Norms::new(&grid, &ours, &theirs, reference.scale(what), on_jumps, away);
            compared.push(ComparedColumn { what, unit: what.unit(units), ours, theirs, norms });
        }
        let mut agreement = Agreement { grid, weights: WEIGHTS, step, window, outside, notes, ..Agreement::default() };
        agreement.quantities = compared;
        agreement.coverage = agreement.coverage_of(reference, until);
        if agreement.grid.points.is_none() {
            let start = agreement.grid.times.iter().take_while(|time| **time <= rounding.at(**time)).count();
            agreement.audit_contacts(reference, until, start);
        }
        Ok(agreement)
    }

    fn coverage_of(&self, reference: &Reference<'_>, until: Option<f64>) -> Coverage {
        let last = self.grid.times.last().copied().unwrap_or_default();
        let end = until.unwrap_or(last);
        let ends = || reference.history.contacts().iter().filter_map(|contact| contact.release);
        let count = |to: f64| ends().filter(|end| *end <= to + self.step).count();
        Coverage { time: [last, end], contacts: [count(last.min(end)), count(end)], breaks_off: end - last > self.step }
    }

    pub(super) fn column(&self, what: Quantity) -> Option<&ComparedColumn> {
        self.quantities.iter().find(|compared| compared.what == what)
    }

    /// Returns the force of the ground in the data, from the force itself, the stress or the strain. Where its impulse
    /// has the other sign, which is a hint of its own, the sign is reversed.
    fn force(&self, reference: &Reference<'_>) -> Option<Vec<f64>> {
        let columns = [Quantity::Force, Quantity::Stress, Quantity::Strain];
        let column = columns.into_iter().find_map(|what| self.column(what))?;
        let sum = |values: &[f64]| values.iter().zip(&self.grid.weights).map(|(x, weight)| x * weight).sum::<f64>();
        let sign = if sum(&column.theirs) * sum(&column.ours) < 0.0 { -1.0 } else { 1.0 };
        let factor = sign * reference.force_factor(column.what);
        Some(column.theirs.iter().map(|value| value * factor).collect())
    }

    /// Finds the contacts and audits the columns. The first `start` samples are at `t = 0`, where the ground does not
    /// act yet. A body of a chain has contacts where its lower end is one, and no balances of its own: its neighbours
    /// act on it, and it may move below its place at the start. A single bar on a ground that yields has balances.
    fn audit_contacts(&mut self, reference: &Reference<'_>, until: Option<f64>, start: usize) {
        let times = &self.grid.times;
        let (Some(first), Some(last)) = (times.first().copied(), times.last().copied()) else { return };
        let theirs = |what: Quantity| self.column(what).map(|compared| compared.theirs.as_slice());
        let force = self.force(reference);
        let chain = reference.history.problem().chain();
        let chain = chain.as_ref().map(|(chain, body)| (chain, *body));
        let lands = chain.is_none_or(|(chain, body)| chain.is_contact(body));
        let is_alone = chain.is_none_or(|(chain, _)| chain.is_on_ground());
        let is_rigid = chain.is_none_or(|(chain, _)| !chain.has_springs());
        let is_top_free = chain.map_or_else(
            || reference.history.problem().top() == Top::Free,
            |(chain, _)| matches!(chain.ends(), [_, End::Free]),
        );
        let force = force.as_deref().filter(|_| lands);
        let flags = theirs(Quantity::Contact).filter(|_| lands);
        let end = theirs(Quantity::EndDisplacement).filter(|_| is_alone);
        let exact = reference.contacts();
        let most = exact.iter().filter_map(|contact| contact.peak_force).fold(0.0, f64::max);
        let height = self.column(Quantity::EndDisplacement).into_iter().flat_map(|end| &end.ours);
        let height = height.fold(0.0f64, |most, v| most.max(v.abs()));
        let least_force = force.map_or(0.0, |force| {
            let flies = |t: f64| !exact.iter().any(|it| it.impact <= t && it.release.is_none_or(|to| t <= to));
            let in_flight = force.iter().zip(times).filter(|(_, t)| flies(**t)).map(|(force, _)| force.abs());
            (LEAST_FORCE * most).max((ABOVE_NOISE * median(in_flight.collect())).min(MOST_NOISE * most))
        });
        let is_down = |k: usize| match (flags, force, end) {
            (Some(flags), ..) => flags[k] > 0.5,
            (_, Some(force), _) => force[k] > least_force,
            (.., Some(v)) => v[k] <= LEAST_FORCE * height,
            _ => false,
        };
        let touches = |k: usize| is_down(k) && (k >= start || (start < times.len() && is_down(start)));
        let mut contacts = Vec::new();
        if flags.is_some() || force.is_some() || end.is_some() {
            // An exact contact just after the last sample may have begun in the data; otherwise it is not missing.
            let separation = reference.shortest_separation(last);
            let found = find_contacts(times, touches, force, separation);
            let is_within = |contact: &ContactRecord| {
                contact.impact < last + separation && contact.release.is_none_or(|to| to > first)
            };
            let exact: Vec<_> = exact.into_iter().filter(is_within).map(|contact| contact.sampled_at(times)).collect();
            contacts = match_contacts(&exact, &found);
            let is_later = |contact: &ContactRecord| contact.impact > last - 2.0 * self.step;
            contacts.retain(|pair| pair.theirs.is_some() || !pair.ours.as_ref().is_some_and(is_later));
        }
        let momentum = (is_alone && is_top_free).then(|| {
            let rod = reference.rod();
            MomentumTerms { mass: reference.mass(), gravity: rod.gravity, damping: rod.damping }
        });
        let input = AuditInput {
            times,
            start,
            displacement: end,
            force,
            energy: self
                .column(Quantity::Energy)
                .filter(|_| is_alone)
                .map(|energy| [energy.ours.as_slice(), energy.theirs.as_slice()]),
            centre_velocity: theirs(Quantity::CentreVelocity),
            momentum,
        };
        let mut audit = Audit {
            not_covered: input.not_covered(self.step, until.unwrap_or(last)),
            of_body: !is_alone,
            ..input.audit()
        };
        if !is_rigid {
            audit.complementarity = None;
            audit.indentation =
                self.column(Quantity::EndDisplacement).filter(|_| is_alone).map(|end| input.greatest(|k| -end.ours[k]));
        }
        for pair in &contacts {
            let (contact, count) = match pair {
                ContactPair { ours: Some(contact), theirs: None } => (contact, &mut audit.missed),
                ContactPair { ours: None, theirs: Some(contact) } => (contact, &mut audit.invented),
                _ => continue,
            };
            *(if contact.below_step { &mut audit.below_step } else { count }) += 1;
        }
        (self.audit, self.contacts) = (audit, contacts);
    }
}
/// Returns the median; 0 of nothing.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
