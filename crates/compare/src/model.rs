//! What other values of the scene would have given at the times of the data, and the columns that are held against it.

use super::agree::Agreement;
use super::norms::{Compared, Grid};
use super::ours::Ours;
use dalembert::Error;
use dalembert::Side;
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::{Measure, Quantity};
use dalembert::solve::TypedHistory;

/// A column as it is held against a run: itself where it has no jumps, its integral over time where it has them. An
/// integral does not see how far a front is spread about its time, and changes steadily with the values of the scene.
#[derive(Debug)]
pub(super) struct Signal {
    pub(super) what: Quantity,
    /// The quantity that the values below are of.
    pub(super) model: Quantity,
    /// Theirs, at the times of the [`Model`].
    pub(super) theirs: Vec<f64>,
    pub(super) is_empty: bool,
    /// What makes it a time: an error of so much is one of a unit of time.
    pub(super) rate: f64,
}

/// Times and columns of data, with the problem that they are of.
#[derive(Debug)]
pub(super) struct Model<'a> {
    pub(super) problem: &'a Problem,
    /// `ρS L`, or `L` where forces are per `ρS`.
    mass: f64,
    pub(super) times: Vec<f64>,
    pub(super) signals: Vec<Signal>,
    pub(super) weights: Vec<f64>,
    /// The median step of the data.
    pub(super) step: f64,
}

pub(super) fn solved(problem: &Problem, until: f64) -> Result<TypedHistory<f64>, Error> {
    // A rounding further, for times that are as many.
    problem.to_builder().time(until * (1.0 + 4.0 * f64::EPSILON)).build()?.doubles()
}

/// `start + ∫ values dt` by the trapezoidal rule.
fn integral(times: &[f64], values: &[f64], start: f64) -> Vec<f64> {
    let mut sum = start;
    let step = |k: usize| (times[k] - times[k - 1]) * f64::midpoint(values[k - 1], values[k]);
    let sums = (0..times.len()).map(|k| {
        sum += if k > 0 { step(k) } else { 0.0 };
        sum
    });
    sums.collect()
}

impl<'a> Model<'a> {
    /// The columns at the samples up to `until`, at most about `most` of them.
    pub(super) fn of(ours: &Ours<'a>, agreement: &Agreement, until: f64, most: usize) -> Result<Self, Error> {
        let problem = ours.history.problem();
        let (history, times, step) = (ours.history, &agreement.grid.times, agreement.step);
        let (speed, trip) = (history.scales().velocity, history.scales().time);
        let wave_speed = Parameter::WaveSpeed.value(problem).unwrap_or(1.0);
        let [mass, ..] = ours.momentum();
        let count = times.partition_point(|time| *time <= until);
        let kept: Vec<usize> = (0..count).step_by(count.div_ceil(most).max(1)).collect();
        let mut signals = Vec::new();
        for Compared { what, ours: own, theirs, .. } in &agreement.quantities {
            let rate = match what.measure() {
                _ if *what == Quantity::CentreVelocity => speed / trip,
                Some(Measure::Energy) => mass * speed * speed / trip,
                Some(Measure::Force | Measure::Stress | Measure::Strain | Measure::Impulse) => {
                    ours.line() * wave_speed * speed
                }
                Some(_) => speed,
                None => continue,
            };
            let model = match what {
                Quantity::EndVelocity => Quantity::EndDisplacement,
                Quantity::TopVelocity => Quantity::TopDisplacement,
                Quantity::Force | Quantity::Stress | Quantity::Strain => Quantity::Impulse,
                _ => *what,
            };
            let mut values: Vec<f64> = theirs.iter().map(|value| value * ours.force_per(*what)).collect();
            if what.jumps() {
                let start = history.columns(&[model, *what], &times[..1], Some(Side::Right))?;
                // A row with the stress that is there before the start, on which nothing has acted yet.
                let before = own[0] != start[1][0] && own[0] != 0.0;
                if let (true, Some(next)) = (before, values.get(1).copied()) {
                    values[0] = next;
                }
                values = integral(times, &values, start[0][0]);
            }
            let is_empty = theirs.iter().all(|value| *value == 0.0);
            let theirs = kept.iter().map(|k| values[*k]).collect();
            signals.push(Signal { what: *what, model, theirs, is_empty, rate });
        }
        let times: Vec<f64> = kept.iter().map(|k| times[*k]).collect();
        let weights = Grid::new(times.clone(), None).weights;
        Ok(Model { problem, mass, times, signals, weights, step })
    }

    /// The values of each signal in `problem`, at `at` of the times. Before `t = 0` the rod has fallen as a whole.
    pub(super) fn values(&self, problem: &Problem, at: impl Fn(f64) -> f64) -> Result<Vec<Vec<f64>>, Error> {
        let times: Vec<f64> = self.times.iter().map(|time| at(*time)).collect();
        let last = times.iter().copied().fold(0.0, f64::max);
        let history = solved(problem, last.max(f64::MIN_POSITIVE))?;
        let whats: Vec<Quantity> = self.signals.iter().map(|signal| signal.model).collect();
        let asked: Vec<f64> = times.iter().map(|time| time.clamp(0.0, *history.end())).collect();
        let mut all = history.columns(&whats, &asked, Some(Side::Right))?;
        let value = |parameter: Parameter| parameter.value(problem).unwrap_or_default();
        let (gravity, speed) = (value(Parameter::Gravity), value(Parameter::ImpactSpeed));
        for (values, what) in all.iter_mut().zip(&whats) {
            for (value, time) in values.iter_mut().zip(&times).filter(|(_, time)| **time < 0.0) {
                match what.measure() {
                    Some(Measure::Length) => *value -= (speed + gravity * time / 2.0) * time,
                    Some(Measure::Velocity) => *value = -speed - gravity * time,
                    _ => {}
                }
            }
        }
        Ok(all)
    }

    /// How far theirs are from these `values`, as times.
    pub(super) fn errors(&self, values: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let of = |(signal, values): (&Signal, &Vec<f64>)| {
            signal.theirs.iter().zip(values).map(|(theirs, ours)| (theirs - ours) / signal.rate).collect()
        };
        self.signals.iter().zip(values).map(of).collect()
    }

    /// What a rod gives whose ends carry `share` of its mass more in all.
    ///
    /// **Source**: to first order in the share. The mass at the top moves with it as a piece of the rod would that is
    /// as heavy; that at the ground is stopped at an impact and set off at a release, at once.
    pub(super) fn with_end_mass(&self, share: f64) -> Result<Vec<Vec<f64>>, Error> {
        let (length, own) = (Parameter::Length.value(self.problem).unwrap_or_default(), self.mass);
        let problem = Parameter::Length.set(self.problem, length * (1.0 + share / 2.0))?;
        let mut all = self.values(&problem, |time| time)?;
        let (extra, rod) = (own * share / 2.0, own * (1.0 + share / 2.0));
        let history = solved(&problem, self.times.last().copied().unwrap_or_default())?;
        let value = |parameter: Parameter| parameter.value(&problem).unwrap_or_default();
        let (gravity, speed) = (value(Parameter::Gravity), value(Parameter::ImpactSpeed));
        // The mass at the ground by itself: where it is stopped, and what of the time it lies there.
        let mut contacts = Vec::new();
        for contact in history.contacts() {
            let before = history.columns(&[Quantity::EndVelocity], &[contact.impact], Some(Side::Left))?;
            contacts.push((contact.impact, contact.release.unwrap_or(f64::INFINITY), before[0][0].abs()));
        }
        let given = |time: f64| -> f64 {
            let of = |(from, to, speed): &(f64, f64, f64)| speed + gravity * (time.min(*to) - from);
            contacts.iter().filter(|contact| contact.0 < time).map(of).sum()
        };
        let rates: Vec<f64> = self.times.iter().map(|time| given(*time) - speed - gravity * time).collect();
        let start = Parameter::Gap.value(&problem).unwrap_or_default();
        let places = integral(&self.times, &rates, start);
        for (values, signal) in all.iter_mut().zip(&self.signals) {
            for (k, value) in values.iter_mut().enumerate() {
                let (u, v) = (places[k], rates[k]);
                *value = match signal.model {
                    Quantity::Impulse => *value + extra * given(self.times[k]),
                    Quantity::Centre => (*value * rod + extra * u) / (rod + extra),
                    Quantity::CentreVelocity => (*value * rod + extra * v) / (rod + extra),
                    Quantity::Energy => *value + extra * (v * v / 2.0 + gravity * u),
                    _ => *value,
                };
            }
        }
        Ok(all)
    }
}
