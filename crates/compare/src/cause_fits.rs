//! Fits of single causes to data, each with one number.
//!
//! A cause is fitted to the first contact and the flight after it: a scheme starts from the same data as the exact
//! history, and its errors grow from impact to impact. A cause passes where it removes most of the misfit in all that
//! it changes:
//!
//! - *All columns that it changes*: it leaves at most half of ‖e‖₂, so that three quarters of ‖e‖₂² are removed; it
//!   removes more than half of ‖e‖₂² of each column. A clock, a shift in time or a damping leaves at most a quarter of
//!   ‖e‖₂: soft contacts look like the first two, and the dissipation of a scheme like the last.
//! - *Each part of a column*, which are the first wave up the rod, the rest of the contact, and the flight: the number
//!   that fits the part best differs by at most half of the value. A part counts where the value changes it by more
//!   than the resolution of the data, which is an error of one step in time. An error that a scheme makes at an impact
//!   is not there before it, or has another sign after it, so that one of the parts before the flight has to count,
//!   unless the value leaves nothing that the data resolve.
//! - *The first sample*, which a scheme is given and does not compute: at most half of the change by the value is left.
//!   Where the value changes the energy there and at most a quarter is left, the start itself determines the value:
//!   then half of ‖e‖₂² may be left over all columns, and no column may get worse.
//! - The value exceeds twice its standard error, and a factor four times its own. The error has three parts: the step;
//!   the scatter of the parts about the value; and an error that all parts share, as where a soft contact lasts longer,
//!   which no scatter shows. The last is estimated by ‖e‖₂/‖s‖₂ from the misfit that is left, where the value changes
//!   the signals by s; where the start determines the value, it is the difference between both values.
//!
//! A value of the scene that leaves at most a fiftieth of ‖e‖₂ passes without these conditions.
//!
//! The cause that leaves the least over all columns is asserted, unless another one leaves about as little: then all of
//! these are listed, and none is asserted.
//!
//! A contact that may be as soft as a mesh makes it is named only where it is clear: it leaves at most a quarter of
//! ‖e‖₂, so that it and not the mesh dominates, and `EA/kc` exceeds two steps by twice its standard error, so that the
//! samples show its front.

use super::cause::Cause;
use super::hint::Detectable;
use super::model::Model;
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::{Measure, Quantity};

/// A cause with its name, and the derivatives of the signals by its number at 0.
pub(super) struct Candidate {
    pub(super) kind: &'static str,
    pub(super) cause: Cause,
    pub(super) slope: Vec<Vec<f64>>,
}

/// Largest share of ‖e‖₂ that an explanation may leave.
pub(super) const LEFT: f64 = 0.5;
/// Largest share of ‖e‖₂² that an explanation may leave that looks like another one: a quarter of ‖e‖₂.
pub(super) const CLEAR: f64 = LEFT * LEFT * LEFT * LEFT;
/// Number of standard errors that a value exceeds.
const EVIDENT: f64 = 2.0;
/// Number of standard errors that a factor of a column is known to.
const KNOWN: f64 = 4.0;
/// Largest share of a value up to which its effect is taken for linear.
const LINEAR: f64 = 0.2;
/// Width of a difference quotient.
const WIDTH: f64 = 1e-4;
/// Smallest change that counts, in round trips.
const LEAST_CHANGE: f64 = 1e-9;
/// Share of ‖e‖₂² that a fit may leave after three steps before it is given up.
const HOPELESS: f64 = 0.8;
/// Share of ‖e‖₂² that a damping removes to first order, below which it is not fitted.
const LEAST_REMOVED: f64 = 0.2;
/// Largest number of steps of a fit.
const STEPS: usize = 12;
/// Start of the fit of a speed or a gravity that may be missing altogether.
const NEARLY_MISSING: f64 = -0.999;
/// Starts of the fit of a damping in an undamped scene, per round trip: the landing after the first contact gets
/// earlier.
const DAMPED: [f64; 2] = [0.05, 0.2];
/// Greatest additional damping that is tried, per round trip.
const MOST_DAMPED: f64 = 1.0;
/// Start of the fit of a soft contact, whose effect is not linear.
const SOFT: f64 = 0.1;
/// Change of a number up to which the derivatives of the signals are taken for the same.
const SAME_SLOPE: f64 = 0.01;
/// Limit of the ratio of a fitted value to that of the scene.
const MAX_RATIO: f64 = 1000.0;
/// Limit of the ratio of the round trip of a fitted rod to that of the scene, in either direction: that of a modulus in
/// another unit, and no more. A fit to other data runs away, and a rod of a much faster wave takes as much longer to
/// solve.
const MAX_TRIP_RATIO: f64 = 32.0;
/// Standard error below which a gravity of nearly zero is none.
pub(super) const NO_GRAVITY: f64 = 0.009;
/// Factor of the ‖e‖₂² that the best cause leaves, up to which another cause explains the data about as well.
const ABOUT_EQUAL: f64 = 2.0;
/// Largest share of ‖e‖₂² that damping leaves where it is not the dissipation of a scheme. Most exact data of another
/// damping leave less, upwind differences some hundredths.
pub(super) const LEFT_BY_DAMPING: f64 = 4e-3;
/// `EA/kL` of the softest contact that a mesh may make: a penalty of the stiffness of an element is softer than this on
/// fewer than 20 elements.
const SOFT_MESH: f64 = 0.05;
/// Number of steps in time within which samples show no front: schemes spread a jump over as many.
const BLURRED: f64 = 2.0;
/// Largest share of ‖e‖₂² that a value of the scene leaves where it explains the data by itself. The trapezoidal rule,
/// by which columns are integrated, leaves about as much; the errors of a scheme leave more.
const EXPLAINED: f64 = 4e-4;
/// Share of a value below which the text of a hint shows none.
const LEAST_VALUE: f64 = 5e-5;
/// Share of ‖e‖₂² that such a cause removes to first order.
const NEARLY_EXPLAINED: f64 = 0.8;
/// Share of the whole ‖e‖₂² below which a difference between two causes does not count.
const NO_DIFFERENCE: f64 = 1e-6;

/// The number of a cause as it was fitted.
#[derive(Debug)]
pub(super) struct Fitted {
    pub(super) kind: &'static str,
    pub(super) cause: Cause,
    pub(super) value: f64,
    pub(super) error: f64,
    /// ‖e‖₂² that is left over all signals.
    left: f64,
    /// The share of ‖e‖₂² that is left over the columns that count.
    pub(super) share_left: f64,
}

/// The fits of causes to the signals of a data set.
pub(super) struct CauseFits<'a> {
    pub(super) model: Model<'a>,
    /// The misfit of the scene as it is.
    pub(super) base: Vec<Vec<f64>>,
    /// The signals of the scene as it is.
    pub(super) exact: Vec<Vec<f64>>,
    pub(super) candidates: Vec<Candidate>,
    /// The times at which the parts of the data end, but for the last one.
    pub(super) part_ends: Vec<f64>,
    pub(super) trip: f64,
}

impl CauseFits<'_> {
    /// Returns the problem with the number `p` of a cause that is a value of the scene.
    fn problem_with(&self, cause: Cause, p: f64) -> Option<Problem> {
        let problem = self.model.problem;
        let (parameter, value) = match cause {
            Cause::Value(Parameter::Length | Parameter::WaveSpeed)
                if !(1.0 / MAX_TRIP_RATIO..=MAX_TRIP_RATIO).contains(&(1.0 + p)) =>
            {
                return None;
            }
            Cause::Value(parameter) if (1.0 + p).abs() <= MAX_RATIO => {
                (parameter, parameter.value(problem)? * (1.0 + p))
            }
            Cause::Damping if p <= MOST_DAMPED => (Parameter::Damping, self.damping() + p / self.trip),
            _ => return None,
        };
        parameter.set(problem, value).ok()
    }

    /// Returns the damping of the scene.
    pub(super) fn damping(&self) -> f64 {
        Parameter::Damping.value(self.model.problem).unwrap_or_default()
    }

    /// Returns the signals with the number `p` of a cause.
    fn predict(&self, cause: Cause, p: f64) -> Option<Vec<Vec<f64>>> {
        let (model, trip) = (&self.model, self.trip);
        let one = |place: usize, change: &dyn Fn(usize) -> f64| {
            let mut all = self.exact.clone();
            all[place].iter_mut().enumerate().for_each(|(k, value)| *value += change(k));
            Some(all)
        };
        match cause {
            Cause::Value(_) | Cause::Damping => model.values(&self.problem_with(cause, p)?, |time| time).ok(),
            Cause::SoftContact(node) => {
                model.with_spring(node, p * Parameter::Length.value(model.problem)?, &self.exact)
            }
            Cause::EndMass => model.with_end_mass(p).ok(),
            Cause::Clock => self.reintegrated(model.values(model.problem, |time| time / (1.0 + p)).ok()?, 1.0 + p),
            Cause::TimeShift => self.reintegrated(model.values(model.problem, |time| time - p * trip).ok()?, 1.0),
            Cause::Factor(place) => one(place, &|k| p * self.exact[place][k]),
            Cause::Offset(place) => one(place, &|_| p * trip * model.signals[place].rate),
        }
    }

    /// Returns values on another clock: integrals begin at the first sample, and grow with its steps.
    fn reintegrated(&self, mut values: Vec<Vec<f64>>, steps: f64) -> Option<Vec<Vec<f64>>> {
        let signals = self.model.signals.iter().zip(&self.exact);
        let integrals = values.iter_mut().zip(signals).filter(|(_, (signal, _))| signal.column != signal.model);
        for (values, (_, exact)) in integrals {
            let first = *values.first()?;
            values.iter_mut().for_each(|value| *value = exact[0] + steps * (*value - first));
        }
        Some(values)
    }

    /// Returns `Σ w a b` over the samples of a part, or over all of them.
    fn product(&self, a: &[f64], b: &[f64], part: Option<usize>) -> f64 {
        let of = |time: f64| self.part_ends.partition_point(|end| *end <= time);
        let counts = |k: &usize| part.is_none_or(|part| of(self.model.times[*k]) == part);
        (0..a.len()).filter(counts).map(|k| self.model.weights[k] * a[k] * b[k]).sum()
    }

    /// Returns `∫ dt` over a part.
    fn span(&self, part: usize) -> f64 {
        let ones = vec![1.0; self.model.times.len()];
        self.product(&ones, &ones, Some(part))
    }

    /// Returns `Σ w a b` over all samples of the `concerned` columns.
    fn product_over(&self, concerned: &[bool], a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
        (0..a.len()).filter(|j| concerned[*j]).map(|j| self.product(&a[j], &b[j], None)).sum()
    }

    /// Returns whether any of `errors` exceeds half of the resolution of the step.
    pub(super) fn is_resolved(&self, errors: &[Vec<f64>]) -> bool {
        let half = self.model.step / 2.0;
        let resolved = |errors: &Vec<f64>| {
            let square = |part| self.product(errors, errors, Some(part));
            (0..=self.part_ends.len()).any(|part| square(part) > half * half * self.span(part))
        };
        errors.iter().any(resolved)
    }

    fn squares(&self, errors: &[Vec<f64>]) -> f64 {
        errors.iter().map(|errors| self.product(errors, errors, None)).sum()
    }

    /// Returns the derivatives of the signals by the number of a cause at `p`, where the errors are `now`: those of the
    /// library for values of the scene, otherwise difference quotients.
    pub(super) fn slopes(&self, cause: Cause, p: f64, now: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        self.exact_slopes(cause, p).or_else(|| {
            let next = self.model.errors(&self.predict(cause, p + WIDTH)?);
            let slope = |(now, next): (&Vec<f64>, &Vec<f64>)| {
                now.iter().zip(next).map(|(now, next)| (now - next) / WIDTH).collect()
            };
            Some(now.iter().zip(&next).map(slope).collect())
        })
    }

    fn exact_slopes(&self, cause: Cause, p: f64) -> Option<Vec<Vec<f64>>> {
        let (parameter, unit) = match cause {
            Cause::Value(parameter) => (parameter, parameter.value(self.model.problem).filter(|value| *value != 0.0)?),
            Cause::Damping => (Parameter::Damping, 1.0 / self.trip),
            _ => return None,
        };
        let history = self.model.solve(&self.problem_with(cause, p)?).ok()?;
        let mut slopes = self.model.derivatives(&history, parameter)?;
        slopes.iter_mut().flatten().for_each(|slope| *slope *= unit);
        Some(slopes)
    }

    /// Returns which columns count: those that the cause changes, but for energies after the start. A scheme loses as
    /// much of them at an impact as one wrong number would.
    fn concerned(&self, cause: Cause, slope: &[Vec<f64>]) -> Vec<bool> {
        let is_factor = matches!(cause, Cause::Factor(_));
        let counts = |k: usize| {
            (is_factor || self.model.signals[k].column.measure() != Some(Measure::Energy))
                && slope[k].iter().any(|d| d.abs() > LEAST_CHANGE * self.trip)
        };
        (0..slope.len()).map(counts).collect()
    }

    /// Returns the least value of each of `causes` that would be named in a run with the errors of the data, the value
    /// within a fifth.
    ///
    /// **Source**: a number p changes the signals by p s beside the errors e. A fit finds p within ‖e‖/‖s‖ and leaves
    /// at most ‖e‖: a fifth of p where p‖s‖ ≥ 5‖e‖, and at most a quarter of ‖e + p s‖ ≥ 4‖e‖. In a column or a part of
    /// one it is off by e/s there besides, at most p/4 + p/5 < p/2 where p‖s‖ ≥ 4‖e‖; then at most (1 + 4/5)² of the
    /// (4 − 1)² are left, less than half. Another number, whose s has the angle θ to that, leaves at least
    /// p‖s‖ sin θ − ‖e‖, which exceeds ‖e‖ where p‖s‖ sin θ ≥ 2‖e‖. Some part up to the release must be changed by a
    /// step, and a value is twice the resolution of a step. Signals are linear in p up to about [`LINEAR`]; greater
    /// values are left out.
    pub(super) fn detectable(&self) -> Vec<Detectable> {
        let least_named = |Candidate { kind, cause, slope }: &Candidate| {
            let concerned = self.concerned(*cause, slope);
            let over = |a: &[Vec<f64>], b: &[Vec<f64>]| self.product_over(&concerned, a, b);
            let (own, errors) = (over(slope, slope), over(&self.base, &self.base));
            let ratio = |factor: f64, own: f64, errors: f64| factor * (errors / own).sqrt();
            let mut least = ratio(5.0, own, errors);
            // A factor of a column competes in that column alone.
            let is_rival = |other: &&Candidate| other.cause != *cause && other.cause.column().is_none();
            for Candidate { slope: rival, .. } in self.candidates.iter().filter(is_rival) {
                let theirs = over(rival, rival);
                let cosine = if theirs > 0.0 { over(slope, rival).powi(2) / (own * theirs) } else { 0.0 };
                least = least.max(ratio(2.0, own * (1.0 - cosine), errors));
            }
            let column = cause.column();
            let mut by_step = f64::INFINITY;
            for j in (0..slope.len()).filter(|j| concerned[*j]) {
                let square = |values: &[f64], part| self.product(values, values, part);
                least = least.max(ratio(4.0, square(&slope[j], None), square(&self.base[j], None)));
                for part in 0..=self.part_ends.len() {
                    let own = square(&slope[j], Some(part));
                    // A part that the cause does not change is no evidence.
                    if own <= LEAST_CHANGE * LEAST_CHANGE * self.trip * self.trip * self.span(part) {
                        continue;
                    }
                    least = least.max(ratio(4.0, own, square(&self.base[j], Some(part))));
                    if column.is_some() || part < self.part_ends.len() {
                        by_step = by_step.min(self.model.step * (self.span(part) / own).sqrt());
                    }
                }
            }
            let unit = match cause {
                Cause::TimeShift => self.trip,
                Cause::Damping => 1.0 / self.trip,
                Cause::Offset(place) => self.trip * self.model.signals[*place].rate,
                _ => 1.0,
            };
            let share = least.max(EVIDENT * by_step);
            let most = if column.is_some() { 1.0 } else { LINEAR };
            let quantity = column.map_or("all", |place| self.model.signals[place].column.name());
            // The models of the first two are of first order; the last would fill a page.
            let is_known = share <= most
                && !matches!(cause, Cause::EndMass | Cause::SoftContact(_) | Cause::Value(Parameter::OfChain(_)));
            is_known.then_some(Detectable { kind, quantity, value: share * unit })
        };
        self.candidates.iter().filter_map(least_named).collect()
    }

    /// Returns starts of the fit besides 0, for numbers that may be far from it.
    fn starts(&self, cause: Cause) -> Vec<f64> {
        match cause {
            Cause::Value(Parameter::ImpactSpeed | Parameter::Gravity) => vec![NEARLY_MISSING],
            Cause::Damping if self.damping() > 0.0 => vec![-self.damping() * self.trip],
            Cause::Damping => DAMPED.to_vec(),
            Cause::SoftContact(_) => vec![SOFT],
            _ => Vec::new(),
        }
    }

    /// Fits a cause by the method of Gauss and Newton; `None` where it does not pass. The slope is computed again where
    /// the number has changed by more than [`SAME_SLOPE`], and at the end.
    fn fit(&self, candidate: &Candidate) -> Option<Fitted> {
        let Candidate { kind, cause, ref slope } = *candidate;
        let errors = |p: f64| self.predict(cause, p).map(|values| self.model.errors(&values));
        let concerned = self.concerned(cause, slope);
        let product = |a: &[Vec<f64>], b: &[Vec<f64>]| self.product_over(&concerned, a, b);
        let base = product(&self.base, &self.base);
        let (mut p, mut found, mut left) = (0.0, self.base.clone(), base);
        let (mut slope, mut slope_at) = (slope.clone(), 0.0);
        let step = product(&slope, &found) / product(&slope, &slope);
        let removed = step * product(&slope, &found);
        let is_near_linear = cause == Cause::Damping && self.damping() == 0.0 && removed > LEAST_REMOVED * base;
        let starts = if is_near_linear { Vec::new() } else { self.starts(cause) };
        for start in starts {
            if let Some(other) = errors(start)
                && product(&other, &other) < left
            {
                (p, left, found) = (start, product(&other, &other), other);
            }
        }
        if p != 0.0 {
            (slope, slope_at) = (self.slopes(cause, p, &found)?, p);
        } else if cause == Cause::Damping && removed < LEAST_REMOVED * base {
            // Damped runs take long, and most data are far from them.
            return None;
        }
        for turn in 0..STEPS {
            let step = product(&slope, &found) / product(&slope, &slope);
            let better = [step, step / 4.0, step / 16.0].into_iter().find_map(|step| {
                let tried = errors(p + step)?;
                let square = product(&tried, &tried);
                (square < left).then_some((step, square, tried))
            });
            let Some((step, square, errors)) = better else { break };
            (p, found, left) = (p + step, errors, square);
            if step.abs() < 1e-3 * p.abs() {
                break;
            }
            if turn > 1 && left > HOPELESS * base {
                return None;
            }
            if (p - slope_at).abs() > SAME_SLOPE || matches!(cause, Cause::SoftContact(_)) {
                (slope, slope_at) = (self.slopes(cause, p, &found)?, p);
            }
        }
        if left > LEFT * base && cause.column().is_none() {
            return None;
        }
        let slope = self.slopes(cause, p, &found)?;
        let (before, after) = (self.squares(&self.base), self.squares(&found));
        let error = match matches!(cause, Cause::Value(_)) && after <= EXPLAINED * before {
            true => Some((after / product(&slope, &slope)).sqrt()).filter(|error| p.abs() > EVIDENT * error)?,
            false => self.accepted(cause, p, &concerned, &slope, &found)?,
        };
        Some(Fitted { kind, cause, value: p, error, left: self.squares(&found), share_left: left / base })
    }

    /// Returns the standard error of the number `p` of a cause, `None` where a condition at the head of this module
    /// does not hold.
    fn accepted(
        &self,
        cause: Cause,
        p: f64,
        concerned: &[bool],
        slope: &[Vec<f64>],
        found: &[Vec<f64>],
    ) -> Option<f64> {
        let square = |errors: &[f64], part| self.product(errors, errors, part);
        let is_column = cause.column().is_some();
        // An offset is evident from the start; a factor has to explain what is left of all columns.
        let total = |errors: &[Vec<f64>]| match cause {
            Cause::Factor(_) => self.squares(errors),
            _ => self.product_over(concerned, errors, errors),
        };
        // The model of a mass at the ends is of first order.
        let mut holds = cause != Cause::EndMass || p.abs() <= LINEAR;
        // The error of the value where the energy at the start determines it.
        let mut by_start = None;
        for j in 0..found.len() {
            let change = (p * slope[j][0]).abs();
            let is_changed = change > LEAST_CHANGE * self.trip;
            holds &= !is_changed || found[j][0].abs() <= change / 2.0;
            let is_energy = self.model.signals[j].column == Quantity::Energy;
            if is_energy && is_changed && found[j][0].abs() <= change / 4.0 {
                by_start = Some(found[j][0] / slope[j][0]);
            }
        }
        let (mut scatter, mut weight, mut count, mut early) = (0.0, 0.0, 0.0, false);
        for j in (0..found.len()).filter(|j| concerned[*j]) {
            let mut is_evident = false;
            for part in 0..=self.part_ends.len() {
                let own = square(&slope[j], Some(part));
                let span = self.span(part);
                if p * p * own <= self.model.step * self.model.step * span {
                    continue;
                }
                (is_evident, early) = (true, early || part < self.part_ends.len());
                let apart = self.product(&slope[j], &found[j], Some(part)) / own;
                let resolution = self.model.step * (span / own).sqrt();
                holds &= apart.abs() <= p.abs() / 2.0 + resolution;
                (scatter, weight, count) = (scatter + own * apart * apart, weight + own, count + 1.0);
            }
            let share = if by_start.is_some() { 1.0 } else { 0.5 };
            holds &= !is_evident || square(&found[j], None) <= square(&self.base[j], None) * share;
        }
        let is_confusable = matches!(cause, Cause::Clock | Cause::TimeShift | Cause::Damping);
        let most = if by_start.is_some() { LEFT } else { LEFT * LEFT } * if is_confusable { LEFT * LEFT } else { 1.0 };
        holds &= total(found) <= most * total(&self.base);
        let span: f64 = self.model.weights.iter().sum::<f64>() * count / (self.part_ends.len() + 1) as f64;
        let resolution = self.model.step * (span / weight).sqrt() / f64::max(count, 1.0).sqrt();
        // A factor multiplies what the step does not resolve, as it has multiplied the errors of its column.
        let resolution = if matches!(cause, Cause::Factor(_)) { resolution * (1.0 + p).abs() } else { resolution };
        let scatter = scatter / weight / f64::max(count - 1.0, 1.0);
        let shared =
            by_start.map_or_else(|| self.product_over(concerned, found, found) / weight, |apart| apart * apart);
        let error = (scatter + shared + resolution * resolution).sqrt();
        let early = early || is_column || !self.is_resolved(found);
        let is_known = !matches!(cause, Cause::Factor(_)) || (1.0 + p).abs() > KNOWN * error;
        (holds && early && count > 0.0 && p.abs() > EVIDENT * error && is_known).then_some(error)
    }

    /// Returns the fits of causes that explain by themselves what the step in time does not resolve. They are fitted
    /// where they do so to first order.
    pub(super) fn best_unresolved(&self) -> Vec<Fitted> {
        let base = self.squares(&self.base);
        let least = LEAST_CHANGE * self.trip;
        if base <= least * least * self.model.weights.iter().sum::<f64>() {
            return Vec::new();
        }
        let all = vec![true; self.base.len()];
        let is_near = |Candidate { slope, cause, .. }: &&Candidate| {
            let own = self.product_over(&all, slope, slope);
            matches!(cause, Cause::Value(_))
                && self.product_over(&all, slope, &self.base).powi(2) >= NEARLY_EXPLAINED * own * base
        };
        let mut fits = self.best_of(self.candidates.iter().filter(is_near));
        fits.retain(|fit| fit.left <= EXPLAINED * base && fit.value.abs() > LEAST_VALUE);
        fits
    }

    /// Returns the fits that explain the data about as well as the best one, which is the first.
    pub(super) fn best(&self) -> Vec<Fitted> {
        self.best_of(self.candidates.iter())
    }

    fn best_of<'c>(&self, candidates: impl Iterator<Item = &'c Candidate>) -> Vec<Fitted> {
        let mut fits: Vec<Fitted> = candidates.filter_map(|candidate| self.fit(candidate)).collect();
        fits.sort_by(|a, b| a.left.total_cmp(&b.left));
        let Some(best) = fits.first() else { return fits };
        let most = ABOUT_EQUAL * best.left + NO_DIFFERENCE * self.squares(&self.base);
        let column = best.cause.column();
        // Two columns may both be wrong.
        let competes = |fit: &Fitted| match (column, fit.cause.column()) {
            (Some(column), Some(other)) => column == other,
            _ => true,
        };
        fits.retain(|fit| fit.left <= most && competes(fit));
        fits
    }

    /// Returns whether the only explanation is a contact that may be as soft as a mesh makes it, and that is not clear.
    pub(super) fn is_soft_mesh(&self, best: &[Fitted]) -> bool {
        let [Fitted { cause: Cause::SoftContact(_), value, error, share_left, .. }] = best else { return false };
        // `EA/kc` of a share of the length is that share of half a round trip.
        let (least, blurred) = (value - 2.0 * error, BLURRED * self.model.step / (self.trip / 2.0));
        least < SOFT_MESH && (*share_left > CLEAR || least <= blurred)
    }

    /// Corrects the column that a cause concerns; returns `false` for a cause that concerns all columns.
    pub(super) fn correct(&mut self, Fitted { cause, value: p, .. }: &Fitted) -> bool {
        let (place, factor, offset) = match *cause {
            Cause::Factor(place) => (place, 1.0 + p, 0.0),
            Cause::Offset(place) => (place, 1.0, p * self.trip * self.model.signals[place].rate),
            _ => return false,
        };
        self.model.signals[place].data.iter_mut().for_each(|value| *value = (*value - offset) / factor);
        self.base = self.model.errors(&self.exact);
        true
    }
}
