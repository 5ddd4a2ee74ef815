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
//!   before it, or goes another way after it: so one of the parts before the flight has to count, unless the value
//!   leaves nothing that the data resolve.
//! - *Of the first sample*, which a scheme is given and does not compute, at most half of what the value changes is
//!   left. Where it is the energy that the value changes there and at most a quarter is left, the start itself says
//!   the value: then half of ‖e‖₂² may be left over all columns, and no column may get worse.
//! - The value is more than twice its standard error. That has three parts: the step; the scatter of the parts about
//!   the value; and what is off alike in all of them, as where a soft contact lasts longer, which no scatter shows. It
//!   is taken to be as great as what is left beside it, ‖e‖₂/‖s‖₂ where the value changes the signals by s; where the
//!   start says the value it is what the two differ by.
//!
//! Of those that pass, the one with the least left over all columns is said.

use super::agree::Agreement;
use super::model::Model;
use super::ours::Ours;
use super::unfitted::{
    FEWEST, Judgement, LEFT, ToldFrom, Verdict, empty, gained, half_step, is_empty, lighter, lost_start, spread,
};
use dalembert::Error;
use dalembert::problem::Parameter;
use dalembert::quantity::{Measure, Quantity};

/// A hypothesis, with one number `p` that is 0 where nothing is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hypothesis {
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

impl Hypothesis {
    /// The column that it is about, where it is one.
    fn place(self) -> Option<usize> {
        match self {
            Hypothesis::Factor(place) | Hypothesis::Origin(place) => Some(place),
            _ => None,
        }
    }
}

/// The hypotheses about all columns, with their kind.
const ALL: [(&str, Hypothesis); 8] = [
    ("wave_speed", Hypothesis::Value(Parameter::WaveSpeed)),
    ("mass", Hypothesis::Value(Parameter::Density)),
    ("length", Hypothesis::Value(Parameter::Length)),
    ("start_velocity", Hypothesis::Value(Parameter::ImpactSpeed)),
    ("gravity", Hypothesis::Value(Parameter::Gravity)),
    ("end_mass", Hypothesis::EndMass),
    ("clock", Hypothesis::Clock),
    ("time_shift", Hypothesis::Late),
];

/// Up to so much of a value what it changes is taken for linear.
const LINEAR: f64 = 0.2;
/// What difference quotients are taken over.
const WIDTH: f64 = 1e-4;
/// A change of less than this share of a round trip is rounding.
const NONE: f64 = 1e-9;
/// A fit that leaves more of ‖e‖₂² after three steps is given up.
const HOPELESS: f64 = 0.8;
const STEPS: usize = 12;
/// Where a fit of what may have been left out, a speed or the weight, starts besides at 0: nearly nothing of it.
const NOTHING: f64 = -0.999;
/// A gravity that is known no better than this, in standard errors, may be none.
pub(super) const NO_GRAVITY: f64 = 0.009;

#[derive(Debug)]
pub(super) struct Fitted {
    pub(super) value: f64,
    pub(super) error: f64,
    /// ‖e‖₂² that is left over all signals.
    left: f64,
}

/// The signals, the misfit as it is, and where their parts begin.
pub(super) struct Judge<'a> {
    pub(super) model: Model<'a>,
    base: Vec<Vec<f64>>,
    exact: Vec<Vec<f64>>,
    ends: Vec<f64>,
    pub(super) trip: f64,
}

impl Judge<'_> {
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
        for (values, (_, exact)) in
            values.iter_mut().zip(signals).filter(|(_, (signal, _))| signal.what != signal.model)
        {
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

    /// `Σ w a b` over all samples of the columns that are `concerned`.
    fn over(&self, concerned: &[bool], a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
        (0..a.len()).filter(|j| concerned[*j]).map(|j| self.product(&a[j], &b[j], None)).sum()
    }

    /// Whether any of `errors` is more than half of what the step resolves.
    fn tells(&self, errors: &[Vec<f64>]) -> bool {
        let half = self.model.step / 2.0;
        let told = |errors: &Vec<f64>| {
            (0..=self.ends.len()).any(|part| self.product(errors, errors, Some(part)) > half * half * self.span(part))
        };
        errors.iter().any(told)
    }

    fn squares(&self, errors: &[Vec<f64>]) -> f64 {
        errors.iter().map(|errors| self.product(errors, errors, None)).sum()
    }

    /// The derivatives of the errors by the number at `p`, where they are `now`.
    fn slopes(&self, hypothesis: Hypothesis, p: f64, now: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let next = self.model.errors(&self.predict(hypothesis, p + WIDTH)?);
        let slope = |(now, next): (&Vec<f64>, &Vec<f64>)| {
            now.iter().zip(next).map(|(now, next)| (now - next) / WIDTH).collect()
        };
        Some(now.iter().zip(&next).map(slope).collect())
    }

    /// What the number does not change does not count. Nor does the energy after the start: a scheme loses as much of
    /// it at an impact as one number would.
    fn concerned(&self, hypothesis: Hypothesis, slope: &[Vec<f64>]) -> Vec<bool> {
        let by_itself = matches!(hypothesis, Hypothesis::Factor(_));
        let tells = |k: usize| {
            (by_itself || self.model.signals[k].what.measure() != Some(Measure::Energy))
                && slope[k].iter().any(|d| d.abs() > NONE * self.trip)
        };
        (0..slope.len()).map(tells).collect()
    }

    /// From what value on each of `hypotheses` would be said of a run whose own errors are those of the data, its value
    /// within a fifth.
    ///
    /// **Source**: a number p changes the signals by p s, the errors e being there besides. A fit finds p within
    /// ‖e‖/‖s‖ and leaves at most ‖e‖: a fifth of p where p‖s‖ ≥ 5‖e‖, and of ‖e + p s‖ ≥ 4‖e‖ at most a quarter. In a
    /// column or a part of one it is off by e/s there besides, at most p/4 + p/5 < p/2 where p‖s‖ ≥ 4‖e‖; then at most
    /// (1 + 4/5)² of the (4 − 1)² are left, less than half. Another number, whose s has the angle θ to that, leaves at
    /// least p‖s‖ sin θ − ‖e‖, which is more than ‖e‖ where p‖s‖ sin θ ≥ 2‖e‖. Some part up to the release must be
    /// changed by a step, and a value is twice what a step resolves. Signals are linear in p up to about [`LINEAR`];
    /// what is told from more is left out.
    fn told_from(&self, hypotheses: &[(&'static str, Hypothesis)]) -> Vec<ToldFrom> {
        let slopes = |(kind, hypothesis): &(&'static str, Hypothesis)| {
            Some((*kind, *hypothesis, self.slopes(*hypothesis, 0.0, &self.base)?))
        };
        let known: Vec<_> = hypotheses.iter().filter_map(slopes).collect();
        let told = |(kind, hypothesis, slope): &(&'static str, Hypothesis, Vec<Vec<f64>>)| {
            let concerned = self.concerned(*hypothesis, slope);
            let over = |a: &[Vec<f64>], b: &[Vec<f64>]| self.over(&concerned, a, b);
            let (own, errors) = (over(slope, slope), over(&self.base, &self.base));
            let ratio = |factor: f64, own: f64, errors: f64| factor * (errors / own).sqrt();
            let mut least = ratio(5.0, own, errors);
            // A factor of a column is asked of that column alone.
            for (.., rival) in known.iter().filter(|(_, other, _)| other != hypothesis && other.place().is_none()) {
                let theirs = over(rival, rival);
                let cosine = if theirs > 0.0 { over(slope, rival).powi(2) / (own * theirs) } else { 0.0 };
                least = least.max(ratio(2.0, own * (1.0 - cosine), errors));
            }
            let by_itself = hypothesis.place();
            let mut by_step = f64::INFINITY;
            for j in (0..slope.len()).filter(|j| concerned[*j]) {
                let square = |values: &[f64], part| self.product(values, values, part);
                least = least.max(ratio(4.0, square(&slope[j], None), square(&self.base[j], None)));
                for part in 0..=self.ends.len() {
                    let own = square(&slope[j], Some(part));
                    // What a part is not changed by says nothing.
                    if own <= NONE * NONE * self.trip * self.trip * self.span(part) {
                        continue;
                    }
                    least = least.max(ratio(4.0, own, square(&self.base[j], Some(part))));
                    if by_itself.is_some() || part < self.ends.len() {
                        by_step = by_step.min(self.model.step * (self.span(part) / own).sqrt());
                    }
                }
            }
            let unit = match hypothesis {
                Hypothesis::Late => self.trip,
                Hypothesis::Origin(place) => self.trip * self.model.signals[*place].rate,
                _ => 1.0,
            };
            let share = least.max(2.0 * by_step);
            let most = if by_itself.is_some() { 1.0 } else { LINEAR };
            let quantity = by_itself.map_or("all", |place| self.model.signals[place].what.name());
            // The mass of the ends is known to first order only.
            let known = share <= most && *hypothesis != Hypothesis::EndMass;
            known.then_some(ToldFrom { kind, quantity, value: share * unit })
        };
        known.iter().filter_map(told).collect()
    }

    /// The value that leaves the least, where the conditions at the head of this module hold.
    fn fit(&self, hypothesis: Hypothesis) -> Option<Fitted> {
        let errors = |p: f64| self.predict(hypothesis, p).map(|values| self.model.errors(&values));
        let mut slope = self.slopes(hypothesis, 0.0, &self.base)?;
        let concerned = self.concerned(hypothesis, &slope);
        let square = |errors: &[Vec<f64>]| self.over(&concerned, errors, errors);
        let base = square(&self.base);
        let (mut p, mut found, mut left) = (0.0, self.base.clone(), base);
        if matches!(hypothesis, Hypothesis::Value(Parameter::ImpactSpeed | Parameter::Gravity))
            && let Some(other) = errors(NOTHING)
            && square(&other) < left
        {
            slope = self.slopes(hypothesis, NOTHING, &other)?;
            (p, left, found) = (NOTHING, square(&other), other);
        }
        for turn in 0..STEPS {
            let step = self.over(&concerned, &slope, &found) / self.over(&concerned, &slope, &slope);
            let better = [step, step / 4.0, step / 16.0].into_iter().find_map(|step| {
                let tried = errors(p + step)?;
                let square = square(&tried);
                (square < left).then_some((step, square, tried))
            });
            let Some((step, square, errors)) = better else { break };
            (p, found, left) = (p + step, errors, square);
            slope = self.slopes(hypothesis, p, &found)?;
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
        let by_itself = hypothesis.place().is_some();
        // A start that is given says an origin of its own; all else is about what is left of all.
        let total = |errors: &[Vec<f64>]| match hypothesis {
            Hypothesis::Factor(_) => self.squares(errors),
            _ => self.over(concerned, errors, errors),
        };
        let mut holds = true;
        let mut start_tells = None;
        for j in 0..found.len() {
            // The start is given to a scheme and not computed by it.
            let by = (p * slope[j][0]).abs();
            holds &= by <= NONE * self.trip || found[j][0].abs() <= by / 2.0;
            let energy = self.model.signals[j].what == Quantity::Energy;
            if energy && by > NONE * self.trip && found[j][0].abs() <= by / 4.0 {
                start_tells = Some(found[j][0] / slope[j][0]);
            }
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
            let share = if start_tells.is_some() { 1.0 } else { 0.5 };
            holds &= !told || square(&found[j], None) <= square(&self.base[j], None) * share;
        }
        // A contact that is soft, or late, is much like a clock.
        let clock = matches!(hypothesis, Hypothesis::Clock | Hypothesis::Late);
        let most = if start_tells.is_some() { LEFT } else { LEFT * LEFT } * if clock { LEFT * LEFT } else { 1.0 };
        holds &= total(found) <= most * total(&self.base);
        let span: f64 = self.model.weights.iter().sum::<f64>() * count / (self.ends.len() + 1) as f64;
        let resolution = self.model.step * (span / weight).sqrt() / f64::max(count, 1.0).sqrt();
        let scatter = scatter / weight / f64::max(count - 1.0, 1.0);
        let alike = start_tells.map_or_else(|| self.over(concerned, found, found) / weight, |apart| apart * apart);
        let error = (scatter + alike + resolution * resolution).sqrt();
        // What is off by a factor has its errors off by it as well.
        let error = if matches!(hypothesis, Hypothesis::Factor(_)) { error * (1.0 + p).abs() } else { error };
        // Where nothing is left that the step resolves, the flight alone may tell.
        let early = early || by_itself || !self.tells(found);
        let holds = holds && early && count > 0.0 && p.abs() > 2.0 * error;
        holds.then(|| Fitted { value: p, error, left: self.squares(found) })
    }

    /// Takes what is wrong with a column out of it; `false` where it is not one column that is wrong.
    fn put_right(&mut self, hypothesis: Hypothesis, p: f64) -> bool {
        let (place, factor, offset) = match hypothesis {
            Hypothesis::Factor(place) => (place, 1.0 + p, 0.0),
            Hypothesis::Origin(place) => (place, 1.0, p * self.trip * self.model.signals[place].rate),
            _ => return false,
        };
        self.model.signals[place].theirs.iter_mut().for_each(|value| *value = (*value - offset) / factor);
        self.base = self.model.errors(&self.exact);
        true
    }
}

/// What is wrong, as far as one number says it.
pub(super) fn judged(ours: &Ours<'_>, agreement: &Agreement) -> Result<Judgement, Error> {
    if agreement.grid.points.is_some() {
        return Ok(Judgement::default());
    }
    let (hints, told_from) = hints(ours, agreement)?;
    Ok(Judgement { hints, told_from, spread: spread(ours, agreement)? })
}

fn hints(ours: &Ours<'_>, agreement: &Agreement) -> Result<(Vec<Verdict>, Vec<ToldFrom>), Error> {
    let (history, columns) = (ours.history, agreement.quantities.as_slice());
    let mut said: Vec<Verdict> = columns.iter().filter(|column| is_empty(column)).map(empty).collect();
    if let Some(lost) = lost_start(columns) {
        return Ok((vec![lost], Vec::new()));
    }
    if agreement.grid.times.len() < FEWEST {
        return Ok((said, Vec::new()));
    }
    // The first contact and the flight after it.
    let release = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
    let until = history.events().iter().map(|event| event.t).find(|time| *time > release);
    let model = Model::of(ours, agreement, until.unwrap_or(f64::INFINITY), SAMPLES)?;
    if model.times.len() < FEWEST {
        return Ok((said, Vec::new()));
    }
    let trip = history.scales().time;
    let first = history.contacts().first().map_or(0.0, |contact| contact.impact);
    let exact = model.values(model.problem, |time| time)?;
    let ends = [first, first + trip / 2.0, release].into_iter().filter(|end| *end > 0.0).collect();
    let mut judge = Judge { model, base: Vec::new(), exact, ends, trip };
    judge.base = judge.model.errors(&judge.exact);
    let unstable = gained(columns);
    let mut hypotheses = ALL.to_vec();
    for (k, signal) in judge.model.signals.iter().enumerate().filter(|(_, s)| unstable.is_none() && !s.is_empty) {
        let kind = match signal.what.measure() {
            Some(Measure::Energy) => "energy_factor",
            Some(Measure::Force | Measure::Stress | Measure::Strain | Measure::Impulse) => "force_factor",
            _ => "factor",
        };
        hypotheses.push((kind, Hypothesis::Factor(k)));
        if signal.what.measure() == Some(Measure::Length) {
            hypotheses.push(("origin", Hypothesis::Origin(k)));
        }
    }
    if !judge.tells(&judge.base) {
        let told_from = if said.is_empty() { judge.told_from(&hypotheses) } else { Vec::new() };
        return Ok((said, told_from));
    }
    // A column that is wrong by itself is put right before the others are looked at.
    loop {
        let fits =
            hypotheses.iter().filter_map(|(kind, hypothesis)| Some((*kind, *hypothesis, judge.fit(*hypothesis)?)));
        let best = fits.min_by(|(.., a), (.., b)| a.left.total_cmp(&b.left));
        let Some((kind, hypothesis, fitted)) = best else { break };
        said.push(judge.verdict(kind, hypothesis, &fitted, ours));
        if said.len() > columns.len() || !judge.put_right(hypothesis, fitted.value) {
            break;
        }
    }
    let mut told_from = Vec::new();
    if said.is_empty() {
        told_from = if unstable.is_none() { judge.told_from(&hypotheses) } else { Vec::new() };
        said.extend(unstable.or_else(|| half_step(ours, agreement)).or_else(|| lighter(ours, agreement)));
    }
    for (count, kind, whose) in [
        (agreement.audit.missed, "missed", "of ours that are not in theirs"),
        (agreement.audit.invented, "invented", "of theirs that are not in ours"),
    ] {
        if count > 0 {
            let text = format!("contacts {whose}: {count}; see the table of contacts");
            said.push(Verdict { kind, quantity: "contact", value: count as f64, error: 0.0, text });
        }
    }
    Ok((said, told_from))
}

const SAMPLES: usize = 150;
