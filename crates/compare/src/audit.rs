//! What the laws say of other people's data alone: contact conditions, energy, momentum.

use serde::Serialize;

/// A greatest value, and when it is reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Extreme {
    pub value: f64,
    pub time: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct EnergyChange {
    /// `theirs − ours` at the end, less what it is at the start.
    pub change: f64,
    /// The most that it is above that at the start.
    pub gain: Extreme,
    pub loss: Extreme,
    /// `change` divided by our energy at the start, `None` where that is zero.
    pub relative: Option<f64>,
    #[serde(skip)]
    pub start: f64,
}

/// What the laws say of samples; `None` where the columns for it are not given.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Audit {
    /// The deepest `−v(0,t)`.
    pub penetration: Option<Extreme>,
    /// The greatest pull of the ground, `−F`.
    pub tension: Option<Extreme>,
    /// `∫ |v F| dt`, zero where contact and gap exclude each other.
    pub complementarity: Option<f64>,
    pub energy_change: Option<EnergyChange>,
    /// `[P] + 2r [∫ P dt] + ρS L g [t] − ∫ F dt` over all samples, with `P = ρS L h′`.
    pub momentum: Option<f64>,
    /// How many of our contacts have none in the samples.
    pub missed: usize,
    /// How many contacts of the samples are none of ours.
    pub invented: usize,
    /// How many more, of either, are shorter than two steps of the samples.
    pub below_step: usize,
    /// Times of the run that the samples leave out: before, after, and in holes ten times as long as the median step.
    pub not_covered: Vec<[f64; 2]>,
}

/// What an audit needs of samples: columns in our conventions and units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Books<'a> {
    pub times: &'a [f64],
    /// How many of them are the start, where the ground does not act yet.
    pub start: usize,
    pub displacement: Option<&'a [f64]>,
    /// `F`: the force of the ground, or what is proportional to it.
    pub force: Option<&'a [f64]>,
    pub energy: Option<[&'a [f64]; 2]>,
    pub centre_velocity: Option<&'a [f64]>,
    /// `ρS L` (or `L`, where forces are per `ρS`), `g` and `r`; `None` where the top is fixed and the ground not alone.
    pub momentum: Option<[f64; 3]>,
}

impl Books<'_> {
    /// The first sample with the greatest `value` above zero.
    fn most(&self, value: impl Fn(usize) -> f64) -> Extreme {
        let none = Extreme { value: 0.0, time: self.times.first().copied().unwrap_or(0.0) };
        let all = (self.start..self.times.len()).map(|k| Extreme { value: value(k), time: self.times[k] });
        all.fold(none, |most, found| if found.value > most.value { found } else { most })
    }

    /// `∫ value dt` by the trapezoidal rule.
    fn integral(&self, value: impl Fn(usize) -> f64) -> f64 {
        (1..self.times.len()).map(|k| (self.times[k] - self.times[k - 1]) * f64::midpoint(value(k - 1), value(k))).sum()
    }

    /// The audit, but for contacts and coverage.
    ///
    /// **Source**: (1.5), (1.6) for the contact conditions; `P′ + 2rP = F − ρS L g`; the energy of ours is (3.54).
    ///
    /// **Accuracy**: integrals by the trapezoidal rule over the samples.
    pub(super) fn audit(&self) -> Audit {
        let energy_change = self.energy.filter(|[ours, _]| !ours.is_empty()).map(|[ours, theirs]| {
            let change = |k: usize| (theirs[k] - ours[k]) - (theirs[0] - ours[0]);
            let last = change(ours.len() - 1);
            EnergyChange {
                change: last,
                gain: self.most(change),
                loss: self.most(|k| -change(k)),
                relative: (ours[0] != 0.0).then(|| last / ours[0].abs()),
                start: ours[0].abs(),
            }
        });
        let momentum = self.momentum.zip(self.force).zip(self.centre_velocity).and_then(|((rod, force), rate)| {
            let [mass, gravity, damping] = rod;
            let change = rate.last()? - rate.first()?;
            let passed = self.times.last()? - self.times.first()?;
            let path = self.integral(|k| rate[k]);
            Some(mass * (change + 2.0 * damping * path + gravity * passed) - self.integral(|k| force[k]))
        });
        Audit {
            penetration: self.displacement.map(|v| self.most(|k| -v[k])),
            tension: self.force.map(|force| self.most(|k| -force[k])),
            complementarity: self.displacement.zip(self.force).map(|(v, f)| self.integral(|k| (v[k] * f[k]).abs())),
            energy_change,
            momentum,
            ..Audit::default()
        }
    }

    /// Times between 0 and `end` that the samples leave out, whose `median` step is known.
    pub(super) fn not_covered(&self, median: f64, end: f64) -> Vec<[f64; 2]> {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return vec![[0.0, end]] };
        let long = |from: &f64, to: &f64| to - from > HOLE * median;
        let holes = self.times.windows(2).filter(|pair| long(&pair[0], &pair[1])).map(|pair| [pair[0], pair[1]]);
        let before = (*first > median).then_some([0.0, *first]);
        let after = (end - last > median).then_some([*last, end]);
        before.into_iter().chain(holes).chain(after).collect()
    }
}

/// So many median steps without a sample are a hole.
const HOLE: f64 = 10.0;

#[cfg(test)]
#[path = "tests/audit.rs"]
mod tests;
