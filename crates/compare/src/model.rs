//! Predictions for other values of the scene at the times of the data, and the columns they are compared with.

use std::cell::OnceCell;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::agreement::Agreement;
use super::norms::{ComparedColumn, Grid};
use super::reference::Reference;
use super::spring::SpringContact;
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::{Measure, Quantity};
use dalembert::solve::{Numbers, Observer, Plan, Question, TypedHistory, unobserved};
use dalembert::{Error, Number, Side};

/// A column of data as it is compared with a run: the column itself where it has no jumps, otherwise its integral over
/// time. An integral does not depend on how far a front is spread about its time, and it changes continuously with the
/// values of the scene.
#[derive(Debug)]
pub(super) struct Signal {
    /// The quantity of the column.
    pub(super) column: Quantity,
    /// The quantity that the signal is compared with: the column or its integral.
    pub(super) model: Quantity,
    /// The data at the times of the [`Model`].
    pub(super) data: Vec<f64>,
    /// Whether the column is zero throughout.
    pub(super) is_zero: bool,
    /// The change of the signal that counts as one unit of time.
    pub(super) rate: f64,
}

/// The signals of a data set, with the problem that they belong to.
#[derive(Debug)]
pub(super) struct Model<'a> {
    pub(super) problem: &'a Problem,
    /// The mass of the rod `ρS L`, or `L` where forces are per `ρS`.
    mass: f64,
    pub(super) times: Vec<f64>,
    pub(super) signals: Vec<Signal>,
    /// The weight of each time in an integral.
    pub(super) weights: Vec<f64>,
    /// The median step of the data.
    pub(super) step: f64,
    /// The march on a rigid ground.
    rigid: OnceCell<Option<SpringContact>>,
    /// The number of wave pieces or cells of the scene as it is.
    pieces: OnceCell<usize>,
}

/// Number of wave pieces or cells of another scene, in those of the scene as it is, beyond which it is given up: values
/// far from those of the scene may take as many times as long.
const MOST_PIECES: usize = 16;
/// Number of wave pieces or cells that every run may have.
const FREE_PIECES: usize = 2000;

/// Solves `problem` to a little beyond `until`, so that times next to the end have both sides.
pub(super) fn solve_beyond(problem: &Problem, until: f64) -> Result<TypedHistory<f64>, Error> {
    solve_observed_beyond(problem, until, unobserved())
}

fn solve_observed_beyond(problem: &Problem, until: f64, observer: Observer) -> Result<TypedHistory<f64>, Error> {
    let problem = problem.to_builder().time(until.max(f64::MIN_POSITIVE) * (1.0 + 1e-8)).build()?;
    let plan = Plan::of(&problem, &Question::run(Numbers::Double(None)))?;
    TypedHistory::solve(&problem, &plan, observer)
}

/// The distance from a ray, in round trips, at which derivatives are taken, of undamped and of damped rods. On a ray
/// they are one-sided, and those of damped rods come from runs whose rays are a little apart.
const RAY_DISTANCE: [f64; 2] = [1e-9, 1e-3];

/// The distance from the times of the data, in steps of them, at which signals of chains are taken. Signals are
/// continuous, and at the very time of an event a chain takes enclosures to tell its sides apart.
const ASIDE: f64 = 1e-7;

/// Returns the derivative of each quantity at `times` by a value of the problem, `None` where the library settles none,
/// and for a body of a chain, of which the library takes difference quotients in long numbers.
///
/// **Accuracy**: that of [`TypedHistory::derivatives_at`], at times [`RAY_DISTANCE`] off the rays.
pub(super) fn derivatives(
    history: &TypedHistory<f64>,
    by: Parameter,
    quantities: &[Quantity],
    times: &[f64],
) -> Option<Vec<Vec<f64>>> {
    if history.problem().chain().is_some() {
        return None;
    }
    let trip = history.scales().time;
    let is_damped = by == Parameter::Damping || Parameter::Damping.value(history.problem()).is_some_and(|r| r > 0.0);
    let distance = trip * RAY_DISTANCE[usize::from(is_damped)];
    let reference = if is_damped { Some(Reference::new(history).ok()?) } else { None };
    let number = |time: &f64| -> Option<Number> {
        let before = if *time > distance { time - distance } else { time + distance };
        let moved = reference.as_ref().map_or(before, |it| it.away_from_rays(*time, distance));
        format!("{:e}", moved.clamp(0.0, *history.end())).parse().ok()
    };
    let times: Vec<Number> = times.iter().map(number).collect::<Option<_>>()?;
    let rows = history.derivatives_at(by, quantities, &times, &[], Side::Right).ok()?;
    let column = |place: usize| {
        let cell = |row: &Vec<Option<dalembert::Derivative<_>>>| {
            let [left, right] = row.get(place)?.as_ref()?.sides();
            right.or(left).ok().map(|derivative: &dalembert::Estimate<f64>| *derivative.value())
        };
        rows.iter().map(cell).collect()
    };
    (0..quantities.len()).map(column).collect()
}

/// Returns `start + ∫ values dt` at each time by the trapezoidal rule.
fn integral(times: &[f64], values: &[f64], start: f64) -> Vec<f64> {
    let step = |k: usize| (times[k] - times[k - 1]) * f64::midpoint(values[k - 1], values[k]);
    let sums = (0..times.len()).scan(start, |sum, k| {
        *sum += if k > 0 { step(k) } else { 0.0 };
        Some(*sum)
    });
    sums.collect()
}

impl<'a> Model<'a> {
    /// Builds the signals of the samples up to `until`, at about `most` times at most.
    pub(super) fn new(
        reference: &Reference<'a>,
        agreement: &Agreement,
        until: f64,
        most: usize,
    ) -> Result<Self, Error> {
        let history = reference.history;
        let problem = history.problem();
        let (times, step) = (&agreement.grid.times, agreement.step);
        let (speed, trip) = (history.scales().velocity, history.scales().time);
        let wave_speed = Parameter::WaveSpeed.value(problem).unwrap_or(1.0);
        let mass = reference.mass();
        let count = times.partition_point(|time| *time <= until);
        let kept: Vec<usize> = (0..count).step_by(count.div_ceil(most).max(1)).collect();
        let mut signals = Vec::new();
        for ComparedColumn { what, ours, theirs, norms, .. } in &agreement.quantities {
            let rate = match what.measure() {
                _ if *what == Quantity::CentreVelocity => speed / trip,
                // The model fits integrals of forces, and no quantity is that of the force at the top.
                _ if *what == Quantity::TopForce => continue,
                Some(Measure::Energy) => mass * speed * speed / trip,
                Some(Measure::Force | Measure::Stress | Measure::Strain | Measure::Impulse) => {
                    reference.line_density() * wave_speed * speed
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
            let factor = reference.force_factor(*what);
            let mut values: Vec<f64> = theirs.iter().map(|value| value * factor).collect();
            if what.jumps() && norms.l1.absolute * factor <= step * rate {
                // The data are off by less than one step in time: jumps that both have cancel in the difference.
                let differences: Vec<f64> =
                    values.iter().zip(ours).map(|(theirs, ours)| theirs - ours * factor).collect();
                let exact = history.columns(&[model], times, Some(Side::Right))?.remove(0);
                values = integral(times, &differences, 0.0).iter().zip(exact).map(|(off, exact)| off + exact).collect();
            } else if what.jumps() {
                let start = history.columns(&[model, *what], &times[..1], Some(Side::Right))?;
                // A first row that holds the stress before the start is replaced by the next one.
                let is_before_start = ours[0] != start[1][0] && ours[0] != 0.0;
                if let (true, Some(next)) = (is_before_start, values.get(1).copied()) {
                    values[0] = next;
                }
                values = integral(times, &values, start[0][0]);
            }
            let is_zero = theirs.iter().all(|value| *value == 0.0);
            let data = kept.iter().map(|k| values[*k]).collect();
            signals.push(Signal { column: *what, model, data, is_zero, rate });
        }
        let times: Vec<f64> = kept.iter().map(|k| times[*k]).collect();
        let weights = Grid::new(times.clone(), None).weights;
        Ok(Model { problem, mass, times, signals, weights, step, rigid: OnceCell::new(), pieces: OnceCell::new() })
    }

    fn quantities(&self) -> Vec<Quantity> {
        self.signals.iter().map(|signal| signal.model).collect()
    }

    /// Solves `problem` as far as the times go.
    pub(super) fn solve(&self, problem: &Problem) -> Result<TypedHistory<f64>, Error> {
        self.solve_to(problem, self.times.last().copied().unwrap_or_default())
    }

    /// Solves `problem` as [`solve_beyond`] does, with a limited number of pieces.
    ///
    /// **Errors**: those of the run; [`Error::Interrupted`] for too many pieces.
    fn solve_to(&self, problem: &Problem, until: f64) -> Result<TypedHistory<f64>, Error> {
        let counted = Arc::new(AtomicUsize::new(0));
        let limit = self.pieces.get().map_or(usize::MAX, |pieces| MOST_PIECES * pieces + FREE_PIECES);
        let count = counted.clone();
        let observer: Observer = Arc::new(move |_, pieces| {
            count.fetch_max(pieces, Ordering::Relaxed);
            if pieces > limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let history = solve_observed_beyond(problem, until, observer)?;
        self.pieces.get_or_init(|| counted.load(Ordering::Relaxed));
        Ok(history)
    }

    /// Returns the values of each signal in `problem` at the times mapped by `at`, of a chain [`ASIDE`] of a step
    /// later. Before `t = 0` the rod falls as a whole.
    pub(super) fn values(&self, problem: &Problem, at: impl Fn(f64) -> f64) -> Result<Vec<Vec<f64>>, Error> {
        let aside = if problem.chain().is_some() { ASIDE * self.step } else { 0.0 };
        let times: Vec<f64> = self.times.iter().map(|time| at(*time) + aside).collect();
        let history = self.solve_to(problem, times.iter().copied().fold(0.0, f64::max))?;
        let quantities = self.quantities();
        let from_start: Vec<f64> = times.iter().map(|time| time.max(0.0)).collect();
        let mut all = history.columns(&quantities, &from_start, Some(Side::Right))?;
        let value = |parameter: Parameter| parameter.value(problem).unwrap_or_default();
        let (gravity, speed) = (value(Parameter::Gravity), value(Parameter::ImpactSpeed));
        for (values, quantity) in all.iter_mut().zip(&quantities) {
            for (value, time) in values.iter_mut().zip(&times).filter(|(_, time)| **time < 0.0) {
                match quantity.measure() {
                    Some(Measure::Length) => *value -= (speed + gravity * time / 2.0) * time,
                    Some(Measure::Velocity) => *value = -speed - gravity * time,
                    _ => {}
                }
            }
        }
        Ok(all)
    }

    /// Returns the derivatives of each signal by a value of the problem of `history`, in units of time per unit of the
    /// value; `None` where the library settles none.
    pub(super) fn derivatives(&self, history: &TypedHistory<f64>, by: Parameter) -> Option<Vec<Vec<f64>>> {
        let mut all = derivatives(history, by, &self.quantities(), &self.times)?;
        for (values, signal) in all.iter_mut().zip(&self.signals) {
            values.iter_mut().for_each(|value| *value /= signal.rate);
        }
        Some(all)
    }

    /// Returns `data − values` of each signal, in units of time.
    pub(super) fn errors(&self, values: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let errors = |(signal, values): (&Signal, &Vec<f64>)| {
            signal.data.iter().zip(values).map(|(data, value)| (data - value) / signal.rate).collect()
        };
        self.signals.iter().zip(values).map(errors).collect()
    }

    /// Returns the signals of a rod whose ends carry `share` of its mass in addition, half at each end.
    ///
    /// **Accuracy**: first order in the share. The mass at the top moves as a piece of rod of the same mass would. The
    /// mass at the ground is stopped by an impact and set off by a release, both at once.
    pub(super) fn with_end_mass(&self, share: f64) -> Result<Vec<Vec<f64>>, Error> {
        let length = Parameter::Length.value(self.problem).unwrap_or_default();
        let problem = Parameter::Length.set(self.problem, length * (1.0 + share / 2.0))?;
        let mut all = self.values(&problem, |time| time)?;
        let (extra, rod) = (self.mass * share / 2.0, self.mass * (1.0 + share / 2.0));
        let history = self.solve(&problem)?;
        let value = |parameter: Parameter| parameter.value(&problem).unwrap_or_default();
        let (gravity, speed) = (value(Parameter::Gravity), value(Parameter::ImpactSpeed));
        let mut stops = Vec::new();
        for contact in history.contacts() {
            let before = history.columns(&[Quantity::EndVelocity], &[contact.impact], Some(Side::Left))?;
            stops.push(Stop {
                from: contact.impact,
                to: contact.release.unwrap_or(f64::INFINITY),
                speed: before[0][0].abs(),
            });
        }
        // The velocity that the ground has given to the mass until then.
        let given = |time: f64| -> f64 {
            let gain = |stop: &Stop| stop.speed + gravity * (time.min(stop.to) - stop.from);
            stops.iter().filter(|stop| stop.from < time).map(gain).sum()
        };
        let velocities: Vec<f64> = self.times.iter().map(|time| given(*time) - speed - gravity * time).collect();
        let places = integral(&self.times, &velocities, value(Parameter::Gap));
        for (values, signal) in all.iter_mut().zip(&self.signals) {
            for (k, value) in values.iter_mut().enumerate() {
                let (u, v) = (places[k], velocities[k]);
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

    /// Returns each signal where the ground is a spring of stiffness `EA/softness`, or in a chain the contact at
    /// `node`, or all rigid ones. Energies, which do not count after the start, are those of `exact`, the signals of
    /// the scene as it is. `None` for a chain without rigid contacts, and where a rod by itself does not start with a
    /// uniform velocity, bounces too long, or has a signal that the march does not record.
    pub(super) fn with_spring(&self, node: Option<usize>, softness: f64, exact: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let Some((chain, _)) = self.problem.chain() else { return self.marched(softness, exact) };
        let nodes: Vec<usize> = node.map_or_else(|| chain.rigid_contacts().collect(), |node| vec![node]);
        let value = |parameter: Parameter| parameter.value(self.problem);
        let modulus = self.mass * value(Parameter::WaveSpeed)?.powi(2) / value(Parameter::Length)?;
        let stiffness = format!("{:e}", modulus / softness).parse().ok()?;
        let soft = self.problem.with_springs(&nodes, &stiffness).ok()?.filter(|_| !nodes.is_empty())?;
        let mut all = self.values(&soft, |time| time).ok()?;
        for (k, signal) in self.signals.iter().enumerate() {
            if signal.model.measure() == Some(Measure::Energy) {
                all[k].clone_from(&exact[k]);
            }
        }
        Some(all)
    }

    /// Returns each signal of a rod by itself on a spring ground: those of `exact`, changed as the march changes.
    fn marched(&self, softness: f64, exact: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let march = |softness: f64| SpringContact::solve(self.problem, softness, self.times.last().copied()?);
        let rigid = self.rigid.get_or_init(|| march(0.0)).as_ref()?;
        let soft = march(softness)?;
        let marched = |(signal, exact): (&Signal, &Vec<f64>)| {
            if signal.model.measure() == Some(Measure::Energy) {
                return Some(exact.clone());
            }
            let factor = if signal.model == Quantity::Impulse { self.mass } else { 1.0 };
            let value = |(time, exact): (&f64, &f64)| {
                Some(factor * (soft.at(signal.model, *time)? - rigid.at(signal.model, *time)?) + exact)
            };
            self.times.iter().zip(exact).map(value).collect()
        };
        self.signals.iter().zip(exact).map(marched).collect()
    }
}

/// The time that a mass lies on the ground, and the speed at which it arrives.
struct Stop {
    from: f64,
    to: f64,
    speed: f64,
}
