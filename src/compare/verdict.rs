//! Which one number is wrong: hypotheses, each fitted to the data.
//!
//! A hypothesis has one number. It is fitted to the first contact and the flight after it: a scheme starts from the
//! same data as ours, and its errors grow from impact to impact. It is said where it removes most of the misfit in all
//! that it concerns.
//!
//! - *Of all columns that it changes* it leaves at most half of ‖e‖₂, three quarters of ‖e‖₂² being removed; of each
//!   of them it removes more than half of ‖e‖₂². Of a clock or a shift in time at most a quarter is left: contacts
//!   that are soft look like one.
//! - *Of each part of a column*, which are the first wave up the rod, the rest of the contact, and the flight, the
//!   number that fits it best is within half of the value. A part counts where the value changes it by more than the
//!   resolution of the data, which is an error of one step in time. What a scheme does wrong at an impact is not there
//!   before it, or goes another way after it.
//! - *Of the first sample*, which a scheme is given and does not compute, at most half of what the value changes is
//!   left. Where it is the energy that the value changes there and at most a quarter is left, the start itself says
//!   the value: then half of ‖e‖₂² may be left over all columns, and no column may get worse.
//! - The value is more than twice its standard error. That has two parts: the scatter of the parts about the value,
//!   and the step.
//!
//! Of those that pass, the one with the least left over all columns is said.

use serde::Serialize;

use super::model::{Model, Signal};
use super::norms::{Compared, Grid};
use crate::error::Error;
use crate::motion::Side;
use crate::number::Scalar;
use crate::problem::{Parameter, Problem};
use crate::quantity::{Measure, Quantity, Rays};
use crate::solve::History;

/// One number that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Verdict {
    /// Which: `wave_speed`.
    pub(crate) kind: &'static str,
    /// The column that it is about; `all` where it is all of them.
    pub(crate) quantity: String,
    /// By how much.
    pub(crate) value: f64,
    /// Its standard error; zero where it is counted.
    pub(crate) error: f64,
    /// In words.
    pub(crate) text: String,
}

/// A hypothesis, with one number `p` that is 0 where nothing is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hypothesis {
    /// A value of the scene is `1 + p` times what is given.
    Value(Parameter),
    /// The ends of the rod carry `p` times its mass.
    EndMass,
    /// All times are `1 + p` times what they should be.
    Clock,
    /// All is late by `p` round trips.
    Late,
    /// A column is `1 + p` times what it should be.
    Factor(usize),
    /// A column is off by `p` times what its rate makes in a round trip.
    Origin(usize),
}

/// The hypotheses about all columns, with their kind.
const ALL: [(&str, Hypothesis); 8] = [
    ("wave_speed", Hypothesis::Value(Parameter::WaveSpeed)),
    ("mass", Hypothesis::Value(Parameter::Density)),
    ("length", Hypothesis::Value(Parameter::Length)),
    ("start_velocity", Hypothesis::Value(Parameter::Speed)),
    ("gravity", Hypothesis::Value(Parameter::Gravity)),
    ("end_mass", Hypothesis::EndMass),
    ("clock", Hypothesis::Clock),
    ("time_shift", Hypothesis::Late),
];

/// At most so much of ‖e‖₂ is left by an explanation.
const LEFT: f64 = 0.5;
/// A change of less than this share of a round trip is rounding.
const NONE: f64 = 1e-9;
/// A fit that leaves more of ‖e‖₂² after three steps is given up.
const HOPELESS: f64 = 0.8;
/// Steps of a fit.
const STEPS: usize = 12;
/// Where a fit starts besides at 0: nearly nothing of a value.
const NOTHING: f64 = -0.999;
/// A gravity that is known no better than this, in standard errors, may be none.
const NO_GRAVITY: f64 = 0.009;

/// A hypothesis that was fitted.
#[derive(Debug)]
struct Fitted {
    value: f64,
    error: f64,
    /// ‖e‖₂² that is left over all signals.
    left: f64,
}

/// The signals, the misfit as it is, and where their parts begin.
struct Judge<'a> {
    model: Model<'a>,
    base: Vec<Vec<f64>>,
    exact: Vec<Vec<f64>>,
    /// Ends of the parts.
    ends: Vec<f64>,
    trip: f64,
}

impl Judge<'_> {
    fn errors(&self, values: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let of = |(signal, values): (&Signal, &Vec<f64>)| {
            signal.theirs.iter().zip(values).map(|(theirs, ours)| (theirs - ours) / signal.rate).collect()
        };
        self.model.signals.iter().zip(values).map(of).collect()
    }

    /// What the hypothesis makes of our signals.
    fn predict(&self, hypothesis: Hypothesis, p: f64) -> Option<Vec<Vec<f64>>> {
        let (model, trip) = (&self.model, self.trip);
        let one = |place: usize, change: &dyn Fn(usize) -> f64| {
            let mut all = self.exact.clone();
            all[place].iter_mut().enumerate().for_each(|(k, value)| *value += change(k));
            Some(all)
        };
        match hypothesis {
            Hypothesis::Value(parameter) => {
                let value = parameter.value(model.problem)? * (1.0 + p);
                model.values(&parameter.set(model.problem, value).ok()?, |time| time).ok()
            }
            Hypothesis::EndMass => model.with_end_mass(p).ok(),
            Hypothesis::Clock => self.integrated(model.values(model.problem, |time| time / (1.0 + p)).ok()?, 1.0 + p),
            Hypothesis::Late => self.integrated(model.values(model.problem, |time| time - p * trip).ok()?, 1.0),
            Hypothesis::Factor(place) => one(place, &|k| p * self.exact[place][k]),
            Hypothesis::Origin(place) => one(place, &|_| p * trip * model.signals[place].rate),
        }
    }

    /// Values on another clock: what is integrated begins where the samples do, and grows with their steps.
    fn integrated(&self, mut values: Vec<Vec<f64>>, steps: f64) -> Option<Vec<Vec<f64>>> {
        let signals = self.model.signals.iter().zip(&self.exact);
        for (values, (_, exact)) in values.iter_mut().zip(signals).filter(|(_, (signal, _))| signal.is_integral()) {
            let first = *values.first()?;
            values.iter_mut().for_each(|value| *value = exact[0] + steps * (*value - first));
        }
        Some(values)
    }

    /// `Σ w a b` over the samples of a part.
    fn product(&self, a: &[f64], b: &[f64], part: Option<usize>) -> f64 {
        let of = |time: f64| self.ends.partition_point(|end| *end <= time);
        let counts = |k: &usize| part.is_none_or(|part| of(self.model.times[*k]) == part);
        (0..a.len()).filter(counts).map(|k| self.model.weights[k] * a[k] * b[k]).sum()
    }

    /// `∫ dt` over a part.
    fn span(&self, part: usize) -> f64 {
        let ones = vec![1.0; self.model.times.len()];
        self.product(&ones, &ones, Some(part))
    }

    /// Whether anything is off by more than half of what the step resolves.
    fn tells(&self) -> bool {
        let half = self.model.step / 2.0;
        let told = |errors: &Vec<f64>| {
            (0..=self.ends.len()).any(|part| self.product(errors, errors, Some(part)) > half * half * self.span(part))
        };
        self.base.iter().any(told)
    }

    fn squares(&self, errors: &[Vec<f64>]) -> f64 {
        errors.iter().map(|errors| self.product(errors, errors, None)).sum()
    }

    /// The value that leaves the least, where the conditions at the head of this module hold.
    fn fit(&self, hypothesis: Hypothesis) -> Option<Fitted> {
        let errors = |p: f64| self.predict(hypothesis, p).map(|values| self.errors(&values));
        let width = 1e-4;
        let slopes = |p: f64, now: &[Vec<f64>]| -> Option<Vec<Vec<f64>>> {
            let next = errors(p + width)?;
            let slope = |(now, next): (&Vec<f64>, &Vec<f64>)| {
                now.iter().zip(next).map(|(now, next)| (now - next) / width).collect()
            };
            Some(now.iter().zip(&next).map(slope).collect())
        };
        let (mut p, mut found) = (0.0, self.base.clone());
        let slope = slopes(p, &found)?;
        // What the number does not change does not count. Nor does the energy after the start: a scheme loses as much
        // of it at an impact as one number would.
        let tells = |k: usize| {
            let by_itself = matches!(hypothesis, Hypothesis::Factor(_));
            (by_itself || self.model.signals[k].what.measure() != Some(Measure::Energy))
                && slope[k].iter().any(|d| d.abs() > NONE * self.trip)
        };
        let concerned: Vec<bool> = (0..slope.len()).map(tells).collect();
        let squares = |errors: &[Vec<f64>]| -> f64 {
            let told = errors.iter().zip(&concerned).filter(|(_, concerned)| **concerned);
            told.map(|(errors, _)| self.product(errors, errors, None)).sum()
        };
        let base = squares(&found);
        let mut left = base;
        if let (true, Some(other)) = (matches!(hypothesis, Hypothesis::Value(_)), errors(NOTHING)) {
            let square = squares(&other);
            if square < left {
                (p, found, left) = (NOTHING, other, square);
            }
        }
        let mut slope = if p == 0.0 { slope } else { slopes(p, &found)? };
        for turn in 0..STEPS {
            let sum = |f: &dyn Fn(usize) -> f64| (0..slope.len()).filter(|j| concerned[*j]).map(f).sum::<f64>();
            let gain = sum(&|j| self.product(&slope[j], &found[j], None));
            let mut step = gain / sum(&|j| self.product(&slope[j], &slope[j], None));
            let mut tries = 0;
            let better = loop {
                let tried = errors(p + step).map(|errors| (squares(&errors), errors));
                match tried {
                    Some((square, errors)) if square < left => break Some((square, errors)),
                    _ if tries == 2 => break None,
                    _ => (step, tries) = (step / 4.0, tries + 1),
                }
            };
            let Some((square, errors)) = better else { break };
            (p, found, left) = (p + step, errors, square);
            slope = slopes(p, &found)?;
            // Well known enough, or without a chance.
            if step.abs() < 1e-3 * p.abs() || (turn > 1 && left > HOPELESS * base) {
                break;
            }
        }
        self.judged(hypothesis, p, &concerned, &slope, &found)
    }

    /// Whether the value removes most of the misfit everywhere, and how well it is known.
    fn judged(
        &self,
        hypothesis: Hypothesis,
        p: f64,
        concerned: &[bool],
        slope: &[Vec<f64>],
        found: &[Vec<f64>],
    ) -> Option<Fitted> {
        let square = |errors: &[f64], part| self.product(errors, errors, part);
        let of = |errors: &[Vec<f64>]| -> f64 {
            (0..errors.len()).filter(|j| concerned[*j]).map(|j| square(&errors[j], None)).sum()
        };
        let by_itself = matches!(hypothesis, Hypothesis::Factor(_) | Hypothesis::Origin(_));
        let total = |errors: &[Vec<f64>]| match by_itself {
            true => self.squares(errors),
            false => of(errors),
        };
        let mut holds = true;
        let mut start_tells = false;
        for j in 0..found.len() {
            // The start is given to a scheme and not computed by it.
            let by = (p * slope[j][0]).abs();
            holds &= by <= NONE * self.trip || found[j][0].abs() <= by / 2.0;
            let energy = self.model.signals[j].what == Quantity::Energy;
            start_tells |= energy && by > NONE * self.trip && found[j][0].abs() <= by / 4.0;
        }
        let (mut scatter, mut weight, mut count, mut early) = (0.0, 0.0, 0.0, false);
        for j in (0..found.len()).filter(|j| concerned[*j]) {
            let mut told = false;
            for part in 0..=self.ends.len() {
                let own = square(&slope[j], Some(part));
                let span = self.span(part);
                if p * p * own <= self.model.step * self.model.step * span {
                    continue;
                }
                (told, early) = (true, early || part < self.ends.len());
                let apart = self.product(&slope[j], &found[j], Some(part)) / own;
                let resolution = self.model.step * (span / own).sqrt();
                holds &= apart.abs() <= p.abs() / 2.0 + resolution;
                (scatter, weight, count) = (scatter + own * apart * apart, weight + own, count + 1.0);
            }
            let share = if start_tells { 1.0 } else { 0.5 };
            holds &= !told || square(&found[j], None) <= square(&self.base[j], None) * share;
        }
        // A contact that is soft, or late, is much like a clock.
        let clock = matches!(hypothesis, Hypothesis::Clock | Hypothesis::Late);
        let most = if start_tells { LEFT } else { LEFT * LEFT } * if clock { LEFT * LEFT } else { 1.0 };
        holds &= total(found) <= most * total(&self.base);
        let span: f64 = self.model.weights.iter().sum::<f64>() * count / (self.ends.len() + 1) as f64;
        let resolution = self.model.step * (span / weight).sqrt() / f64::max(count, 1.0).sqrt();
        let error = (scatter / weight / f64::max(count - 1.0, 1.0) + resolution * resolution).sqrt();
        // What is off by a factor has its errors off by it as well.
        let error = if matches!(hypothesis, Hypothesis::Factor(_)) { error * (1.0 + p).abs() } else { error };
        let holds = holds && (early || by_itself) && count > 0.0 && p.abs() > 2.0 * error;
        holds.then(|| Fitted { value: p, error, left: self.squares(found) })
    }
}

/// What is known of the data besides their columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<'a> {
    pub(super) problem: &'a Problem,
    pub(super) history: &'a History<f64>,
    pub(super) grid: &'a Grid,
    pub(super) columns: &'a [Compared],
    /// The median step.
    pub(super) step: f64,
    /// Contacts of ours that are missing, and contacts that ours does not have.
    pub(super) contacts: [usize; 2],
}

/// What is wrong, as far as one number says it; `force_per` makes a stress or a strain the force of the ground, and
/// `factors` names those that are often forgotten.
///
/// **Errors**: what the history cannot answer.
pub(super) fn verdicts(
    known: &Known<'_>,
    force_per: impl Fn(Quantity) -> f64,
    factors: impl Fn(Quantity) -> Vec<(f64, &'static str)>,
) -> Result<Vec<Verdict>, Error> {
    let Known { problem, history, grid, columns, step, contacts } = *known;
    let mut said: Vec<Verdict> = columns.iter().filter(|column| is_empty(column)).map(empty).collect();
    if let Some(lost) = lost_start(columns) {
        return Ok(vec![lost]);
    }
    if grid.times.len() < FEWEST {
        return Ok(said);
    }
    // The first contact and the flight after it.
    let release = history.contacts().iter().find_map(|contact| contact.to).unwrap_or(f64::INFINITY);
    let until = history.events().iter().map(|event| event.time).find(|time| *time > release);
    let until = until.unwrap_or(f64::INFINITY);
    let model = Model::of(problem, history, (&grid.times, step), columns, force_per, (until, SAMPLES))?;
    let trip = history.scales().time;
    let first = history.contacts().first().map_or(0.0, |contact| contact.from);
    let exact = model.values(problem, |time| time)?;
    let ends = [first, first + trip / 2.0, release].into_iter().filter(|end| *end > 0.0).collect();
    let mut judge = Judge { model, base: Vec::new(), exact, ends, trip };
    judge.base = judge.errors(&judge.exact);
    if judge.model.times.len() < FEWEST || !judge.tells() {
        return Ok(said);
    }
    let filled = (0..judge.model.signals.len()).filter(|k| !judge.model.signals[*k].is_empty);
    let of_columns = filled.flat_map(|k| {
        let what = judge.model.signals[k].what;
        let origin = matches!(what.measure(), Some(Measure::Length)).then_some(("origin", Hypothesis::Origin(k)));
        let kind = match what.measure() {
            Some(Measure::Energy) => "energy_factor",
            Some(Measure::Force | Measure::Stress | Measure::Strain | Measure::Impulse) => "force_factor",
            _ => "factor",
        };
        std::iter::once((kind, Hypothesis::Factor(k))).chain(origin)
    });
    let unstable = gained(columns);
    let of_columns: Vec<_> = of_columns.filter(|_| unstable.is_none()).collect();
    // A column that is wrong by itself is put right before the others are looked at.
    loop {
        let mut best: Option<(&'static str, Hypothesis, Fitted)> = None;
        for (kind, hypothesis) in ALL.into_iter().chain(of_columns.iter().copied()) {
            let Some(fitted) = judge.fit(hypothesis) else { continue };
            if best.as_ref().is_none_or(|(.., best)| fitted.left < best.left) {
                best = Some((kind, hypothesis, fitted));
            }
        }
        let Some((kind, hypothesis, fitted)) = best else { break };
        said.push(judge.verdict(kind, hypothesis, &fitted, &factors));
        let again = said.len() <= columns.len() && judge.put_right(hypothesis, fitted.value);
        if !again {
            break;
        }
    }
    if said.is_empty() {
        said.extend(unstable.or_else(|| half_step(known, trip)));
    }
    for (count, kind, whose) in [
        (contacts[0], "missed", "of ours that are not in theirs"),
        (contacts[1], "invented", "of theirs that are not in ours"),
    ] {
        if count > 0 {
            let text = format!("contacts {whose}: {count}; see the table of contacts");
            said.push(Verdict { kind, quantity: "contact".into(), value: count as f64, error: 0.0, text });
        }
    }
    Ok(said)
}

/// Fewer samples say nothing.
const FEWEST: usize = 8;
/// So many samples are looked at.
const SAMPLES: usize = 150;

fn is_empty(column: &Compared) -> bool {
    column.theirs.iter().all(|value| *value == 0.0) && column.norms.l2.relative.is_some_and(|share| share > LEFT)
}

fn empty(column: &Compared) -> Verdict {
    let name = column.what.name();
    let text = format!("{name} is zero throughout: an empty column?");
    Verdict { kind: "empty", quantity: name.into(), value: 0.0, error: 0.0, text }
}

fn energy(columns: &[Compared]) -> Option<&Compared> {
    columns.iter().find(|column| column.what == Quantity::Energy && !is_empty(column))
}

/// A start that is not that of the scene: the greater part of the energy is gone at the second sample.
fn lost_start(columns: &[Compared]) -> Option<Verdict> {
    let energy = energy(columns)?;
    let [first, second] = energy.theirs.get(..2)?.try_into().ok()?;
    let lost: f64 = first - second;
    (lost > first / 2.0 && energy.ours[1] > energy.ours[0] / 2.0).then(|| {
        let text = format!(
            "{} of {} of the energy are lost in the first step: is the initial velocity ignored?",
            lost.decimal(4),
            first.decimal(4)
        );
        Verdict { kind: "start_velocity", quantity: "all".into(), value: -1.0, error: 0.0, text }
    })
}

/// Energy from nowhere, as much as there was.
fn gained(columns: &[Compared]) -> Option<Verdict> {
    let energy = energy(columns)?;
    let first = *energy.theirs.first()?;
    let most = energy.theirs.iter().copied().fold(first, f64::max);
    let share = most / first - 1.0;
    (first > 0.0 && share > 1.0).then(|| {
        let text = format!("energy up by {} %, from nowhere: the scheme is unstable", (100.0 * share).decimal(4));
        Verdict { kind: "energy_gain", quantity: energy.what.name().into(), value: share, error: 0.0, text }
    })
}

/// Over how long a time the fronts of the data are spread: the width of a ramp that is as far from a jump.
///
/// **Source**: `∫ e² dt = J² W/12` for a ramp of the width `W` about a jump `J`; the median over the jumps at both
/// ends of the first contact, and at the top when the first wave is there. The start is left out: before it there are
/// no data.
pub(super) fn spread(history: &History<f64>, grid: &Grid, columns: &[Compared]) -> Result<Option<f64>, Error> {
    let trip = history.scales().time;
    let released = history.contacts().iter().find_map(|contact| contact.to).unwrap_or(f64::INFINITY);
    let events = history.events().iter().map(|event| event.time);
    let events: Vec<f64> = events.filter(|time| *time > 0.0 && *time <= released).collect();
    let first = history.contacts().first().map_or(0.0, |contact| contact.from);
    let mut widths = Vec::new();
    for column in columns.iter().filter(|column| column.what.rays() == Rays::Jump && column.what.measure().is_some()) {
        let times = if column.what == Quantity::TopVelocity { vec![first + trip / 2.0] } else { events.clone() };
        for time in times.into_iter().filter(|time| *time < *history.end()) {
            let limit = |side| Ok::<_, Error>(history.columns(&[column.what], &[time], Some(side))?[0][0]);
            let jump = limit(Side::Right)? - limit(Side::Left)?;
            let near = |k: &usize| (grid.times[*k] - time).abs() < trip / 8.0;
            let square = |k: usize| grid.weights[k] * (column.theirs[k] - column.ours[k]).powi(2);
            let sum: f64 = (0..grid.times.len()).filter(near).map(square).sum();
            let most = column.ours.iter().fold(0.0f64, |most, value| most.max(value.abs()));
            widths.extend((jump.abs() > LEFT * most).then(|| 12.0 * sum / (jump * jump)));
        }
    }
    widths.sort_by(f64::total_cmp);
    Ok(widths.get(widths.len() / 2).copied())
}

/// Velocities that are half a step from their times: of a top, or an end, that nothing has reached yet but gravity.
///
/// **Source**: there every scheme has the velocity to a rounding, and `v − ours = ∓(Δt/2) v_tt`.
fn half_step(known: &Known<'_>, trip: f64) -> Option<Verdict> {
    let Known { history, grid, columns, step, .. } = *known;
    let first = history.contacts().first().map_or(f64::INFINITY, |contact| contact.from);
    let of = |column: &Compared| {
        let until = match column.what {
            Quantity::EndVelocity => first,
            // Well before the first wave, of which schemes send some ahead.
            Quantity::TopVelocity => first + trip / 4.0,
            _ => return None,
        };
        let count = grid.times.partition_point(|time| *time < until - step);
        let rate = |k: usize| (column.ours[k] - column.ours[k - 1]) / (grid.times[k] - grid.times[k - 1]);
        let sum = |f: &dyn Fn(usize) -> f64| (1..count).filter(|k| rate(*k).is_finite()).map(f).sum::<f64>();
        let error = |k: usize| column.theirs[k] - column.ours[k];
        let (square, cross) = (sum(&|k| rate(k) * rate(k)), sum(&|k| error(k) * rate(k)));
        let late = -cross / square;
        let left = sum(&|k| (error(k) + late * rate(k)).powi(2));
        let is_half = (late.abs() / step - 0.5).abs() < LEFT * 0.5;
        let error = (left / square / (count as f64 - 2.0)).sqrt();
        (count > 3 && is_half && error < late.abs() / 2.0).then(|| {
            let side = if late > 0.0 { "late" } else { "early" };
            let name = column.what.name();
            let text =
                format!("{name} is {:.2} steps {side}: is it the velocity between two steps?", late.abs() / step);
            Verdict { kind: "half_step", quantity: name.into(), value: late, error, text }
        })
    };
    columns.iter().find_map(of)
}

impl Judge<'_> {
    /// Takes what is wrong with a column out of it; `false` where it is not one column that is wrong.
    fn put_right(&mut self, hypothesis: Hypothesis, p: f64) -> bool {
        let (place, factor, offset) = match hypothesis {
            Hypothesis::Factor(place) => (place, 1.0 + p, 0.0),
            Hypothesis::Origin(place) => (place, 1.0, p * self.trip * self.model.signals[place].rate),
            _ => return false,
        };
        self.model.signals[place].theirs.iter_mut().for_each(|value| *value = (*value - offset) / factor);
        self.base = self.errors(&self.exact);
        true
    }

    fn verdict(
        &self,
        kind: &'static str,
        hypothesis: Hypothesis,
        fitted: &Fitted,
        factors: &impl Fn(Quantity) -> Vec<(f64, &'static str)>,
    ) -> Verdict {
        let Fitted { value: p, error, .. } = *fitted;
        let percent = |p: f64, error: f64| format!("{:+.2} ± {:.2} %", 100.0 * p, 100.0 * error).replace('-', "−");
        let column = |place: usize| self.model.signals[place].what;
        let name = |place: usize| column(place).name().to_string();
        let of_all =
            |value: f64, error: f64, text: String| Verdict { kind, quantity: "all".into(), value, error, text };
        match hypothesis {
            Hypothesis::Value(Parameter::WaveSpeed) => {
                let modulus = percent((1.0 + p) * (1.0 + p) - 1.0, 2.0 * error);
                of_all(p, error, format!("wave speed off by {}, as by a modulus off by {modulus}", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Density) => {
                of_all(p, error, format!("mass off by {}: check density and mass matrix", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Speed) => {
                of_all(p, error, format!("velocity at the start off by {}", percent(p, error)))
            }
            Hypothesis::Value(Parameter::Gravity) if p < -1.0 + 3.0 * error.max(NO_GRAVITY) => {
                of_all(-1.0, error, "no gravity: is the weight missing?".into())
            }
            Hypothesis::Value(parameter) => {
                of_all(p, error, format!("{} off by {}", parameter.name(), percent(p, error)))
            }
            Hypothesis::EndMass => {
                let text =
                    format!("the ends carry {} of the mass of the rod besides: check end masses", percent(p, error));
                of_all(p, error, text)
            }
            Hypothesis::Clock => {
                of_all(p, error, format!("clock off by {}: check the step of time", percent(p, error)))
            }
            Hypothesis::Late => {
                let (late, error) = (p * self.trip, error * self.trip);
                let side = if late > 0.0 { "late" } else { "early" };
                let steps = late.abs() / self.model.step;
                let (by, shift) = (late.abs().decimal(4), (-late).decimal(4));
                let text = format!(
                    "{by} ± {} {side}, {steps:.2} steps: is it on the same clock? A shift of {shift} undoes it",
                    error.decimal(2)
                );
                of_all(late, error, text)
            }
            Hypothesis::Factor(place) => {
                let (quantity, factor) = (name(place), 1.0 + p);
                if (factor + 1.0).abs() < (2.0 * error).max(LEFT * LEFT) {
                    let text = format!("{quantity} has the other sign");
                    return Verdict { kind: "sign", quantity, value: -1.0, error, text };
                }
                let near = |known: f64| (factor / known - 1.0).abs() < (2.0 * error / factor.abs()).max(0.02);
                let known: Vec<&str> = factors(column(place))
                    .into_iter()
                    .filter(|(value, _)| near(*value))
                    .map(|(_, name)| name)
                    .collect();
                let ask = if known.is_empty() { "which unit?".to_string() } else { known.join(" ") };
                let text = format!("{quantity} × {} ± {}: {ask}", factor.decimal(4), error.decimal(2));
                Verdict { kind, quantity, value: factor, error, text }
            }
            Hypothesis::Origin(place) => {
                let unit = self.trip * self.model.signals[place].rate;
                let (offset, error) = (p * unit, error * unit);
                let quantity = name(place);
                let text = format!(
                    "{quantity} off by {} ± {} everywhere: is it measured from elsewhere?",
                    offset.decimal(4),
                    error.decimal(2)
                );
                Verdict { kind, quantity, value: offset, error, text }
            }
        }
    }
}
