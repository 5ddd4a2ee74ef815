//! Data beside a history: norms, contacts, audit and hints.

use serde::Serialize;

use super::audit::{Audit, Books};
use super::conventions::Conventions;
use super::judgement::{Known, ToldFrom, Verdict};
use super::map::Location;
use super::norms::{Compared, Grid, norms};
use super::ours::Ours;
use super::samples::Samples;
use super::touch::{Touch, matched, touches};
use super::unfitted::spread;
use super::verdict::verdicts;
use crate::error::Error;
use crate::problem::{Problem, Top};
use crate::quantity::{Quantity, Rays};
use crate::solve::History;

/// Data beside a history.
#[derive(Debug)]
pub(crate) struct Agreement {
    pub(crate) grid: Grid,
    pub(crate) quantities: Vec<Compared>,
    /// Ours and theirs; either may be missing.
    pub(crate) contacts: Vec<(Option<Touch>, Option<Touch>)>,
    pub(crate) audit: Audit,
    pub(crate) coverage: Coverage,
    pub(crate) hints: Vec<Verdict>,
    /// From what value on a number that is wrong would be said, where none is.
    pub(crate) told_from: Vec<ToldFrom>,
    /// Over how long a time the fronts are spread.
    pub(crate) spread: Option<f64>,
    /// The median step of the samples.
    pub(crate) step: f64,
    /// How far from a jump a sample counts as away from it.
    pub(crate) window: f64,
    /// How many rows are before `t = 0` and are not compared.
    pub(crate) outside: usize,
    /// What is to be said of how the file was read.
    pub(crate) notes: Vec<String>,
}

/// How much of the scene the data cover.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Coverage {
    /// Where the data end, and where the run of the scene does.
    pub(crate) time: [f64; 2],
    /// Whole contacts of ours that the data reach the end of, and all of the run.
    pub(crate) contacts: [usize; 2],
    /// Whether the data end before the run.
    pub(crate) breaks_off: bool,
}

impl Coverage {
    /// The share of the time.
    pub(crate) fn share(&self) -> f64 {
        if self.time[1] > 0.0 { (self.time[0] / self.time[1]).min(1.0) } else { 1.0 }
    }
}

/// What a comparison may be told besides the data.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub(crate) conventions: Conventions,
    /// How far the data should go: the end of the scene's own run, where that is a time.
    pub(crate) until: Option<f64>,
    /// Whether it is asked which number is wrong.
    pub(crate) judge: bool,
    /// In round trips; by default [`WINDOW`], or two steps where that is more.
    pub(crate) window: Option<f64>,
}

/// Round trips that a sample is away from a jump where nothing else is said.
const WINDOW: f64 = 0.02;
/// A sample pushes where its force is above this share of our greatest.
const PUSHES: f64 = 1e-6;

impl Agreement {
    /// Compares `samples` with `history` of `problem`.
    ///
    /// **Source**: each sample of a quantity that jumps is scored against the nearer of its two limits where its time
    /// is that of the jump, as well as the times tell, or against the limit that its row is said to hold. Norms,
    /// contacts, audit and hints as in `quantity`.
    ///
    /// **Accuracy**: that of the history, in doubles.
    ///
    /// **Errors**: what the history cannot answer.
    pub(crate) fn of(
        problem: &Problem,
        history: &History<f64>,
        samples: Samples,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let ours = Ours::of(problem, history)?;
        let Samples { grid, mut quantities, step, outside, notes, rounding, sides } = samples;
        let trip = history.scales().time;
        settings.conventions.apply(&ours, &mut quantities, grid.points.as_deref())?;
        let narrow = 2.0 * step;
        let window = settings.window.map_or_else(|| narrow.max(WINDOW * trip), |trips| trips * trip);
        let whats: Vec<Quantity> = quantities.iter().map(|(what, _)| *what).collect();
        let values = ours.values(&whats, &grid)?;
        let mut compared = Vec::new();
        let mut passing = (Location::Ground, ours.passing(Location::Ground, &grid));
        for ((what, theirs), mut values) in quantities.into_iter().zip(values) {
            let location = Location::of(what);
            if location != passing.0 {
                passing = (location, ours.passing(location, &grid));
            }
            let on_jumps = ours.nearer(what, &grid, (&passing.1, &rounding, &sides), &theirs, &mut values)?;
            let away = |k: usize, window: f64| (passing.1[k] - grid.times[k]).abs() > window;
            let scale = ours.scale(what);
            let norms =
                norms(&grid, &values, &theirs, scale, on_jumps, |k| what.rays() != Rays::Jump || away(k, window));
            compared.push(Compared { what, ours: values, theirs, norms });
        }
        let mut agreement = Agreement {
            grid,
            quantities: compared,
            contacts: Vec::new(),
            audit: Audit::default(),
            coverage: Coverage::default(),
            hints: Vec::new(),
            told_from: Vec::new(),
            spread: None,
            step,
            window,
            outside,
            notes,
        };
        agreement.coverage = agreement.covered(history, settings);
        if agreement.grid.points.is_none() {
            let start = agreement.grid.times.iter().take_while(|time| **time <= rounding.at(**time)).count();
            agreement.keep_books(problem, &ours, settings.until, start);
            if settings.judge {
                let contacts = [agreement.audit.missed, agreement.audit.invented];
                let (grid, columns) = (&agreement.grid, agreement.quantities.as_slice());
                let known = Known { problem, history, grid, columns, step, contacts };
                let judged = verdicts(&known, |what| ours.force_per(what), |what| ours.factors(what))?;
                (agreement.hints, agreement.told_from) = (judged.said, judged.told_from);
                agreement.spread = spread(history, grid, columns)?.filter(|width| *width > step);
            }
        }
        Ok(agreement)
    }

    fn covered(&self, history: &History<f64>, settings: &Settings) -> Coverage {
        let last = self.grid.times.last().copied().unwrap_or_default();
        let end = settings.until.unwrap_or(last);
        let ends = || history.contacts().iter().filter_map(|contact| contact.to);
        let count = |to: f64| ends().filter(|end| *end <= to + self.step).count();
        Coverage { time: [last, end], contacts: [count(last.min(end)), count(end)], breaks_off: end - last > self.step }
    }

    fn theirs(&self, column: Quantity) -> Option<&Compared> {
        self.quantities.iter().find(|compared| compared.what == column)
    }

    /// Contacts and audit. The first `start` samples are at `t = 0`: what is given, before it or after it, and none of
    /// the ground's doing.
    fn keep_books(&mut self, problem: &Problem, ours: &Ours<'_>, until: Option<f64>, start: usize) {
        let times = &self.grid.times;
        let (Some(first), Some(last)) = (times.first().copied(), times.last().copied()) else { return };
        // Whatever shows the force: it, or stress or strain with the factor that makes them one. Where its sign is the
        // other one, which is a hint, contacts are read from the force that is meant.
        let shown =
            [Quantity::Force, Quantity::Stress, Quantity::Strain].into_iter().find_map(|column| self.theirs(column));
        let force: Option<Vec<f64>> = shown.map(|shown| {
            let factor = ours.force_per(shown.what);
            // Of the other sign, which is a hint, it is the force that is meant.
            let sum = |values: &[f64]| {
                values.iter().zip(&self.grid.weights).map(|(value, weight)| value * weight).sum::<f64>()
            };
            let factor = if sum(&shown.theirs) * sum(&shown.ours) < 0.0 { -factor } else { factor };
            shown.theirs.iter().map(|value| value * factor).collect()
        });
        let force = force.as_deref();
        let end = self.theirs(Quantity::EndDisplacement).map(|compared| compared.theirs.as_slice());
        let on_ground = self.theirs(Quantity::Contact).map(|compared| compared.theirs.as_slice());
        let exact = ours.touches();
        let most = exact.iter().filter_map(|touch| touch.peak).fold(0.0, f64::max);
        let height = self.theirs(Quantity::EndDisplacement);
        let height = height.map_or(0.0, |end| end.ours.iter().fold(0.0f64, |most, v| most.max(v.abs())));
        let on_it = |k: usize| match (on_ground, force, end) {
            (Some(flag), ..) => flag[k] > 0.5,
            (_, Some(force), _) => force[k] > PUSHES * most,
            (.., Some(v)) => v[k] <= PUSHES * height,
            _ => false,
        };
        let touching = |k: usize| on_it(k) && (k >= start || (start < times.len() && on_it(start)));
        let mut contacts = Vec::new();
        if on_ground.is_some() || force.is_some() || end.is_some() {
            // One that begins just after the last sample may have begun in theirs; it is not missing if not.
            let separation = ours.shortest_separation();
            let found = touches(times, touching, force, separation);
            let within = |touch: &Touch| touch.from < last + separation && touch.to.is_none_or(|to| to > first);
            let exact: Vec<Touch> = exact.into_iter().filter(within).map(|touch| touch.beside(times)).collect();
            contacts = matched(&exact, &found);
            let later = |touch: &Touch| touch.from > last - 2.0 * self.step;
            contacts.retain(|(a, b)| b.is_some() || !a.as_ref().is_some_and(later));
        }
        let energy = self.theirs(Quantity::Energy);
        let books = Books {
            times,
            start,
            displacement: end,
            force,
            energy: energy.map(|energy| [energy.ours.as_slice(), energy.theirs.as_slice()]),
            centre_velocity: self.theirs(Quantity::CentreVelocity).map(|compared| compared.theirs.as_slice()),
            momentum: (problem.rod.top == Top::Free).then(|| ours.momentum()),
        };
        let alone = |row: &&(Option<Touch>, Option<Touch>)| row.0.is_none() || row.1.is_none();
        let below =
            |row: &&(Option<Touch>, Option<Touch>)| [&row.0, &row.1].into_iter().flatten().all(|t| t.below_step);
        let told = || contacts.iter().filter(alone).filter(|row| !below(row));
        self.audit = Audit {
            missed: told().filter(|row| row.1.is_none()).count(),
            invented: told().filter(|row| row.0.is_none()).count(),
            below_step: contacts.iter().filter(alone).filter(below).count(),
            not_covered: books.not_covered(until.unwrap_or(last)),
            ..books.audit()
        };
        self.contacts = contacts;
    }
}
