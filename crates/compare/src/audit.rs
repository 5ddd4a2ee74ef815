//! The audit of data by the laws of motion: contact conditions, energy, momentum.

use schemars::JsonSchema;
use serde::Serialize;

/// A greatest value with its time.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Extreme {
    pub value: f64,
    pub time: f64,
}

/// The change of the energy of the data against that of the exact history, `theirs − ours` less its value at the start.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct EnergyChange {
    /// The change at the end.
    pub change: f64,
    /// The greatest change upwards.
    pub gain: Extreme,
    /// The greatest change downwards.
    pub loss: Extreme,
    /// `change` divided by the exact energy at the start; `None` where that is zero.
    pub relative: Option<f64>,
    /// The exact energy at the start.
    #[serde(skip)]
    pub start: f64,
}

/// The result of the audit; `None` where the columns for it are not given.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Audit {
    /// The greatest `−v(0,t)`.
    pub penetration: Option<Extreme>,
    /// The greatest `−v(0,t)` of the exact history at these times, on a ground that yields.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indentation: Option<Extreme>,
    /// The greatest pull of the ground, `−F`.
    pub tension: Option<Extreme>,
    /// `∫ |v F| dt`, zero where contact and gap exclude each other; `None` on a ground that yields.
    pub complementarity: Option<f64>,
    pub energy_change: Option<EnergyChange>,
    /// `[P] + 2r [∫ P dt] + ρS L g [t] − ∫ F dt` over all samples, with `P = ρS L h′`.
    pub momentum: Option<f64>,
    /// The number of exact contacts without one in the data.
    pub missed: usize,
    /// The number of contacts in the data without an exact one.
    pub invented: usize,
    /// The number of further contacts of either kind that are shorter than two steps of the samples.
    pub below_step: usize,
    /// Times of the run without samples: before the first, after the last, and holes of ten median steps.
    pub not_covered: Vec<[f64; 2]>,
    /// Whether other bodies or ends act on the rod, which then has no balances.
    #[serde(skip)]
    pub of_body: bool,
}

/// The values of the rod that enter the balance of momentum.
#[derive(Clone, Copy, Debug)]
pub(super) struct MomentumTerms {
    /// `ρS L`, or `L` where forces are per `ρS`.
    pub mass: f64,
    pub gravity: f64,
    pub damping: f64,
}

/// The columns that an audit needs, in the conventions and units of the library.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AuditInput<'a> {
    pub times: &'a [f64],
    /// The number of samples at the start, where the ground does not act yet.
    pub start: usize,
    pub displacement: Option<&'a [f64]>,
    /// The force of the ground `F`.
    pub force: Option<&'a [f64]>,
    /// The exact energy and that of the data.
    pub energy: Option<[&'a [f64]; 2]>,
    pub centre_velocity: Option<&'a [f64]>,
    /// The terms of the momentum; `None` where the top is fixed, as then the ground does not act alone.
    pub momentum: Option<MomentumTerms>,
}

/// Number of median steps without a sample that make a hole.
const HOLE: f64 = 10.0;

impl AuditInput<'_> {
    /// Returns the first sample with the greatest `value` above zero.
    pub(super) fn greatest(&self, value: impl Fn(usize) -> f64) -> Extreme {
        let none = Extreme { value: 0.0, time: self.times.first().copied().unwrap_or(0.0) };
        let all = (self.start..self.times.len()).map(|k| Extreme { value: value(k), time: self.times[k] });
        all.fold(none, |most, found| if found.value > most.value { found } else { most })
    }

    /// Returns `∫ value dt` by the trapezoidal rule.
    fn integral(&self, value: impl Fn(usize) -> f64) -> f64 {
        (1..self.times.len()).map(|k| (self.times[k] - self.times[k - 1]) * f64::midpoint(value(k - 1), value(k))).sum()
    }

    /// Computes the audit, but for contacts and coverage.
    ///
    /// **Source**: (1.5), (1.6) for the contact conditions; `P′ + 2rP = F − ρS L g`; (3.54) for the exact energy.
    ///
    /// **Accuracy**: integrals by the trapezoidal rule over the samples.
    pub(super) fn audit(&self) -> Audit {
        let energy_change = self.energy.filter(|[ours, _]| !ours.is_empty()).map(|[ours, theirs]| {
            let change = |k: usize| (theirs[k] - ours[k]) - (theirs[0] - ours[0]);
            let last = change(ours.len() - 1);
            EnergyChange {
                change: last,
                gain: self.greatest(change),
                loss: self.greatest(|k| -change(k)),
                relative: (ours[0] != 0.0).then(|| last / ours[0].abs()),
                start: ours[0].abs(),
            }
        });
        let momentum = self.momentum.zip(self.force).zip(self.centre_velocity).and_then(|((rod, force), rate)| {
            let change = rate.last()? - rate.first()?;
            let duration = self.times.last()? - self.times.first()?;
            let path = self.integral(|k| rate[k]);
            let drawn = change + 2.0 * rod.damping * path + rod.gravity * duration;
            Some(rod.mass * drawn - self.integral(|k| force[k]))
        });
        Audit {
            penetration: self.displacement.map(|v| self.greatest(|k| -v[k])),
            tension: self.force.map(|force| self.greatest(|k| -force[k])),
            complementarity: self.displacement.zip(self.force).map(|(v, f)| self.integral(|k| (v[k] * f[k]).abs())),
            energy_change,
            momentum,
            ..Audit::default()
        }
    }

    /// Returns the times between 0 and `end` without samples, whose `median` step is known.
    pub(super) fn not_covered(&self, median: f64, end: f64) -> Vec<[f64; 2]> {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return vec![[0.0, end]] };
        let is_hole = |from: &f64, to: &f64| to - from > HOLE * median;
        let holes = self.times.windows(2).filter(|pair| is_hole(&pair[0], &pair[1])).map(|pair| [pair[0], pair[1]]);
        let before = (*first > median).then_some([0.0, *first]);
        let after = (end - last > median).then_some([*last, end]);
        before.into_iter().chain(holes).chain(after).collect()
    }
}

#[cfg(test)]
#[path = "tests/audit.rs"]
mod tests;
