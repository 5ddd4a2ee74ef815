//! Data beside a history: norms, contacts and audit.

use serde::Serialize;

use super::audit::{Audit, Books};
use super::norms::{Compared, Grid, norms};
use super::options::Options;
use super::ours::Ours;
use super::samples::Samples;
use super::touch::{Touch, matched, touches};
use dalembert::Error;
use dalembert::number::Number;
use dalembert::problem::Top;
use dalembert::quantity::Quantity;

#[derive(Debug, Default)]
pub struct Agreement {
    pub grid: Grid,
    pub quantities: Vec<Compared>,
    /// Ours and theirs; either may be missing.
    pub contacts: Vec<(Option<Touch>, Option<Touch>)>,
    pub audit: Audit,
    pub coverage: Coverage,
    pub step: f64,
    /// How far from a jump a sample counts as away from it.
    pub window: f64,
    /// How many rows are before `t = 0` and are not compared.
    pub outside: usize,
    /// What is to be said of how the file was read.
    pub notes: Vec<String>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Coverage {
    /// Where the data end, and where the run of the scene does.
    pub time: [f64; 2],
    /// Whole contacts of ours that the data reach the end of, and all of the run.
    pub contacts: [usize; 2],
    pub breaks_off: bool,
}

impl Coverage {
    pub fn share(&self) -> f64 {
        if self.time[1] > 0.0 { (self.time[0] / self.time[1]).min(1.0) } else { 1.0 }
    }
}

/// Round trips that a sample is away from a jump where nothing else is said.
const WINDOW: f64 = 0.02;
/// A sample pushes where its force is above this share of our greatest.
const PUSHES: f64 = 1e-6;

impl Agreement {
    /// Compares `samples` with `ours`; they should go up to `until`.
    ///
    /// **Source**: each sample of a quantity that jumps is scored against the nearer of its two limits where its time
    /// is that of the jump, as well as the times tell, or against the limit that its row is said to hold.
    ///
    /// **Accuracy**: that of the history, in doubles.
    pub(super) fn of(ours: &Ours<'_>, samples: Samples, options: &Options, until: Option<f64>) -> Result<Self, Error> {
        let Samples { grid, mut quantities, step, outside, notes, rounding, sides } = samples;
        let trip = ours.history.scales().time;
        options.apply(ours, &mut quantities, grid.points.as_deref())?;
        let window = options.window.as_ref().map(|trips| Number::to_f64(trips) * trip);
        let window = window.unwrap_or((2.0 * step).max(WINDOW * trip));
        let whats: Vec<Quantity> = quantities.iter().map(|(what, _)| *what).collect();
        let values = ours.values(&whats, &grid)?;
        let mut compared = Vec::new();
        for ((what, theirs), mut values) in quantities.into_iter().zip(values) {
            let passing = ours.passing(what, &grid);
            let on_jumps = ours.nearer(what, &grid, (&passing, &rounding, &sides), &theirs, &mut values)?;
            let away = |k: usize| passing.get(k).is_none_or(|jump| (jump - grid.times[k]).abs() > window);
            let norms = norms(&grid, &values, &theirs, ours.scale(what), on_jumps, away);
            compared.push(Compared { what, ours: values, theirs, norms });
        }
        let mut agreement =
            Agreement { grid, quantities: compared, step, window, outside, notes, ..Agreement::default() };
        agreement.coverage = agreement.covered(ours, until);
        if agreement.grid.points.is_none() {
            let start = agreement.grid.times.iter().take_while(|time| **time <= rounding.at(**time)).count();
            agreement.keep_books(ours, until, start);
        }
        Ok(agreement)
    }

    fn covered(&self, ours: &Ours<'_>, until: Option<f64>) -> Coverage {
        let last = self.grid.times.last().copied().unwrap_or_default();
        let end = until.unwrap_or(last);
        let ends = || ours.history.contacts().iter().filter_map(|contact| contact.release);
        let count = |to: f64| ends().filter(|end| *end <= to + self.step).count();
        Coverage { time: [last, end], contacts: [count(last.min(end)), count(end)], breaks_off: end - last > self.step }
    }

    pub(super) fn column(&self, what: Quantity) -> Option<&Compared> {
        self.quantities.iter().find(|compared| compared.what == what)
    }

    /// Contacts and audit. The first `start` samples are at `t = 0`: what is given, before it or after it, and none of
    /// the ground's doing.
    fn keep_books(&mut self, ours: &Ours<'_>, until: Option<f64>, start: usize) {
        let times = &self.grid.times;
        let (Some(first), Some(last)) = (times.first().copied(), times.last().copied()) else { return };
        let theirs = |what: Quantity| self.column(what).map(|compared| compared.theirs.as_slice());
        // Whatever shows the force: it, or stress or strain with the factor that makes them one.
        let shown =
            [Quantity::Force, Quantity::Stress, Quantity::Strain].into_iter().find_map(|what| self.column(what));
        let force: Option<Vec<f64>> = shown.map(|shown| {
            let factor = ours.force_per(shown.what);
            // Of the other sign, which is a hint, it is the force that is meant.
            let sum = |values: &[f64]| values.iter().zip(&self.grid.weights).map(|(x, weight)| x * weight).sum::<f64>();
            let factor = if sum(&shown.theirs) * sum(&shown.ours) < 0.0 { -factor } else { factor };
            shown.theirs.iter().map(|value| value * factor).collect()
        });
        let (force, flags, end) = (force.as_deref(), theirs(Quantity::Contact), theirs(Quantity::EndDisplacement));
        let exact = ours.touches();
        let most = exact.iter().filter_map(|touch| touch.peak).fold(0.0, f64::max);
        let height = self.column(Quantity::EndDisplacement).into_iter().flat_map(|end| &end.ours);
        let height = height.fold(0.0f64, |most, v| most.max(v.abs()));
        let on_it = |k: usize| match (flags, force, end) {
            (Some(flags), ..) => flags[k] > 0.5,
            (_, Some(force), _) => force[k] > PUSHES * most,
            (.., Some(v)) => v[k] <= PUSHES * height,
            _ => false,
        };
        let touching = |k: usize| on_it(k) && (k >= start || (start < times.len() && on_it(start)));
        let mut contacts = Vec::new();
        if flags.is_some() || force.is_some() || end.is_some() {
            // One that begins just after the last sample may have begun in theirs; it is not missing if not.
            let separation = ours.shortest_separation();
            let found = touches(times, touching, force, separation);
            let within = |touch: &Touch| touch.from < last + separation && touch.to.is_none_or(|to| to > first);
            let exact: Vec<Touch> = exact.into_iter().filter(within).map(|touch| touch.beside(times)).collect();
            contacts = matched(&exact, &found);
            let later = |touch: &Touch| touch.from > last - 2.0 * self.step;
            contacts.retain(|(a, b)| b.is_some() || !a.as_ref().is_some_and(later));
        }
        let books = Books {
            times,
            start,
            displacement: end,
            force,
            energy: self.column(Quantity::Energy).map(|energy| [energy.ours.as_slice(), energy.theirs.as_slice()]),
            centre_velocity: theirs(Quantity::CentreVelocity),
            momentum: (ours.history.problem().rod.top == Top::Free).then(|| ours.momentum()),
        };
        let mut audit = Audit { not_covered: books.not_covered(self.step, until.unwrap_or(last)), ..books.audit() };
        for row in &contacts {
            let (touch, count) = match row {
                (Some(touch), None) => (touch, &mut audit.missed),
                (None, Some(touch)) => (touch, &mut audit.invented),
                _ => continue,
            };
            *(if touch.below_step { &mut audit.below_step } else { count }) += 1;
        }
        (self.audit, self.contacts) = (audit, contacts);
    }
}
