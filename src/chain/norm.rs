//! Bounds of the errors of the states of a cluster.

use super::cluster::Cluster;
use super::curve::{Curve, greater, rough_slope, rough_slope_at, smaller, upper};
use super::interface::{Mode, Rows};
use super::linear::{Dynamic, Linear};
use super::node::Source;
use super::response::Response;
use super::step::{Step, Values, refs};
use crate::number::{Bounded, is_exact_zero};

/// Share of a time that covers the roundings of a sum of times.
const LONGER: f64 = 1e-6;

/// All that the errors of the states that act back come from since a time, in the norm.
#[derive(Clone, Debug)]
pub(super) struct Since<N> {
    /// Errors at that time.
    begun: Vec<N>,
    /// Sums of those that steps have added since.
    added: Vec<N>,
    /// Bounds of the rates that errors of the signals cause.
    rates: Vec<N>,
    elapsed: N,
}

impl<N: Bounded> Since<N> {
    /// Returns `Σ aᵢⱼ begunⱼ + sup |e^{At}|ᵢⱼ addedⱼ + min(time, ∫|e^{At}|ᵢⱼ) ratesⱼ` for a bound `a` of what is left
    /// of the errors at the beginning.
    fn bounds(&self, a: &[Vec<f64>], response: &Response, time: &N) -> Vec<N> {
        let Response { peak, integral, .. } = response;
        let row = |i: usize| {
            let term = |j: usize| {
                let reach = smaller(time.double(integral[i][j]), time.clone());
                let left = time.double(a[i][j]) * &self.begun[j] + time.double(peak[i][j]) * &self.added[j];
                left + reach * &self.rates[j]
            };
            (0..a.len()).map(term).reduce(|sum, term| sum + term).map(upper)
        };
        (0..a.len()).filter_map(row).collect()
    }
}

impl<N: Bounded> Cluster<N> {
    /// Returns the bounds of the errors of the states over a step, and adds what uncertain breaks before it have
    /// caused.
    pub(super) fn step_errors(&mut self, inputs: &[[Curve<N>; 2]], step: &Step<N>) -> Vec<N> {
        self.add_slivers(step);
        let zero = self.norm.zero();
        let masses = self.masses.len();
        let count = masses + self.interfaces.len();
        let mut errors = vec![zero.clone(); count];
        let forced = self.rates_of_errors(inputs, &errors);
        let driven = self.driven_errors(&forced, step);
        let Linear { dynamic, .. } = &self.linear;
        let width = &step.width;
        let norm = if dynamic.len() > 1 { Some(upper(self.energy_bound(inputs, step))) } else { None };
        let mut fading = Vec::new();
        for (place, own) in dynamic.iter().enumerate() {
            // The others act on the state by their bounds in the norm.
            let mut rate = forced[own.state].clone();
            for (other, factor) in dynamic.iter().zip(&own.factors) {
                if let Some(norm) = norm.as_ref().filter(|_| !is_exact_zero(factor)) {
                    rate = rate + norm.clone() / &other.root * factor;
                }
            }
            let (before, defect) = (self.error(own.state), &step.defects[own.state]);
            let rate = upper(rate);
            let grown = rate.clone() * width;
            let (most, held) = match &own.decay {
                Some(decay) => {
                    let level = rate / decay;
                    let most = smaller(greater(before.clone(), level.clone()), before.clone() + &grown);
                    (most, smaller(level, grown))
                }
                None => (before.clone() + &grown, grown),
            };
            fading.push((before, upper(held + defect)));
            let most = upper(most + defect);
            let bounds =
                [norm.as_ref().map(|norm| norm.clone() / &own.root), driven.as_ref().map(|d| d[place].clone())];
            errors[own.state] = bounds.into_iter().flatten().fold(most, |least, bound| smaller(bound, least));
        }
        let rates = self.rates_of_errors(inputs, &errors);
        for (j, interface) in self.interfaces.iter().enumerate() {
            let state = masses + j;
            if self.linear.root(state).is_none() {
                errors[state] = interface.gap_error.clone() + rates[state].clone() * width + &step.defects[state];
            }
        }
        self.fading = fading;
        if let Some(norm) = norm {
            self.norm = norm;
        }
        errors
    }

    /// Returns bounds of the rates that the errors of the signals and these errors of the states cause.
    fn rates_of_errors(&self, inputs: &[[Curve<N>; 2]], errors: &[N]) -> Vec<N> {
        let value = |j: usize| {
            let side = |side: usize| match &self.interfaces[j].sides[side].source {
                Source::Mass(mass) => errors[*mass].clone(),
                _ => inputs[j][side].error.clone(),
            };
            [side(0), side(1), errors[self.masses.len() + j].clone()]
        };
        let values: Vec<Values<N>> = (0..self.interfaces.len()).map(value).collect();
        self.rates(&values, true)
    }

    /// Returns the bounds of the errors that the response of the states gives over a step, `forced` being the rates
    /// that errors of the signals cause.
    fn driven_errors(&mut self, forced: &[N], step: &Step<N>) -> Option<Vec<N>> {
        let Linear { dynamic, response, .. } = &self.linear;
        let response = response.as_ref()?;
        let begun = |own: &Dynamic<N>| self.error(own.state) * &own.root;
        let mut since = self.since.clone().unwrap_or_else(|| Since {
            begun: dynamic.iter().map(begun).collect(),
            added: vec![self.norm.zero(); dynamic.len()],
            rates: vec![self.norm.zero(); dynamic.len()],
            elapsed: self.norm.zero(),
        });
        for (place, own) in dynamic.iter().enumerate() {
            let mut rate = forced[own.state].clone();
            if !step.fast.contains(&place) {
                let acts = |fast: &usize| own.factors[*fast].clone() * &step.defects[dynamic[*fast].state];
                rate = step.fast.iter().map(acts).fold(rate, |sum, rate| sum + rate);
                since.added[place] = upper(step.defects[own.state].clone() * &own.root + &since.added[place]);
            }
            since.rates[place] = upper(greater(since.rates[place].clone(), rate * &own.root));
        }
        let bounds = since.bounds(&response.peak, response, &(since.elapsed.clone() + &step.width));
        self.since = Some(since);
        let error = |(place, (own, bound)): (usize, (&Dynamic<N>, N))| {
            let bound = bound / &own.root;
            upper(if step.fast.contains(&place) { bound + &step.defects[own.state] } else { bound })
        };
        Some(dynamic.iter().zip(bounds).enumerate().map(error).collect())
    }

    /// Adds to the bound of the error of a state.
    pub(super) fn add_error(&mut self, state: usize, added: N) {
        if let Some(place) = self.linear.dynamic.iter().position(|own| own.state == state) {
            let weighted = added.clone() * &self.linear.dynamic[place].root;
            if let Some(since) = &mut self.since {
                since.added[place] = upper(since.added[place].clone() + &weighted);
            }
            self.norm = self.norm.clone() + weighted;
        }
        let error = self.error_mut(state);
        *error = upper(error.clone() + added);
    }

    /// Returns the bound of the error of a state at the time that is reached.
    pub(super) fn error(&self, state: usize) -> N {
        match self.masses.get(state) {
            Some(mass) => mass.error.clone(),
            None => self.interfaces[state - self.masses.len()].gap_error.clone(),
        }
    }

    /// Returns the bound of the error of a state, for change.
    pub(super) fn error_mut(&mut self, state: usize) -> &mut N {
        match state.checked_sub(self.masses.len()) {
            None => &mut self.masses[state].error,
            Some(j) => &mut self.interfaces[j].gap_error,
        }
    }

    /// Carries the bounds of the states that act back over a step of which the first part, `width`, is taken: an error
    /// of a state before the step fades as `e⁻ᵏʷ`, which is below `1/(1 + x + x²/2 + x³/6)` for `x = κw`.
    ///
    /// Once all has decayed, the response bounds the errors from then on by those that are left.
    pub(super) fn fade(&mut self, width: &N, (errors, step): (&[N], &Step<N>)) {
        let mut sum = self.norm.zero();
        let left = self.left(width, step);
        for (place, (own, (before, held))) in
            self.linear.dynamic.clone().iter().zip(std::mem::take(&mut self.fading)).enumerate()
        {
            let faded = match &own.decay {
                Some(decay) => {
                    let x = decay.clone() * width;
                    let sixth = (x.clone() / x.int(3) + x.one()) * &x / x.int(2) + x.one();
                    before / (sixth * &x + x.one())
                }
                None => before,
            };
            let mut error = smaller(faded + held, errors[own.state].clone());
            if let Some(left) = &left {
                error = smaller(left[place].clone() / &own.root, error);
            }
            let error = upper(error);
            sum = sum + error.clone() * &own.root;
            *self.error_mut(own.state) = error;
        }
        let sum = upper(sum);
        self.norm = if self.linear.dynamic.len() > 1 { smaller(self.norm.clone(), sum) } else { sum };
    }

    /// Returns bounds of the errors of the states after a step of which the first part, `width`, is taken, in the norm,
    /// if all that was before has decayed.
    fn left(&mut self, width: &N, step: &Step<N>) -> Option<Vec<N>> {
        let Linear { dynamic, response, .. } = &self.linear;
        let (response, since) = (response.as_ref()?, self.since.as_mut()?);
        for place in &step.fast {
            let own = &dynamic[*place];
            since.added[*place] = upper(step.defects[own.state].clone() * &own.root + &since.added[*place]);
        }
        since.elapsed = (since.elapsed.clone() + width).centred().0;
        if since.elapsed.to_f64() <= response.time * (1.0 + LONGER) {
            return None;
        }
        let left = since.bounds(&response.left, response, &since.elapsed);
        let zeros = vec![width.zero(); left.len()];
        *since = Since { begun: left.clone(), added: zeros.clone(), rates: zeros, elapsed: width.zero() };
        Some(left)
    }

    /// Returns `√(n² + ½ Σ Z e² w) + Σ √weight · defect`.
    fn energy_bound(&self, inputs: &[[Curve<N>; 2]], step: &Step<N>) -> N {
        let zero = self.norm.zero();
        let mut work = zero.clone();
        let mut shoved = zero.clone();
        for (j, interface) in self.interfaces.iter().enumerate() {
            if interface.mode != Mode::Closed {
                continue;
            }
            for (side, input) in interface.sides.iter().enumerate() {
                let error = &inputs[j][side].error;
                match &input.source {
                    Source::Wave(_) => work = work + error.square() * &interface.impedances[side],
                    Source::Data(_) if !is_exact_zero(error) => {
                        // Through the law, a given signal acts on both neighbours and on the gap.
                        let mut values = [zero.clone(), zero.clone(), zero.clone()];
                        values[side] = error.clone();
                        let rows: &Rows<N> = interface.rows();
                        let force = rows.force.bound_of(refs(&values));
                        for mass in [j.checked_sub(1), Some(j)].into_iter().flatten().filter_map(|i| self.masses.get(i))
                        {
                            shoved = shoved + force.clone() * &mass.inverse * &mass.root;
                        }
                        if let Some(soft) = &interface.soft {
                            shoved = shoved + rows.rate.bound_of(refs(&values)) * &soft.root;
                        }
                    }
                    _ => {}
                }
            }
        }
        let mut norm = self.norm.clone();
        if !is_exact_zero(&work) {
            let square = norm.square() + (work * &step.width).halved();
            norm = square.try_sqrt().unwrap_or(square);
        }
        norm = norm + shoved * &step.width;
        for (place, own) in self.linear.dynamic.iter().enumerate() {
            let defect = &step.defects[own.state];
            norm = norm + defect.clone() * &own.root;
            // The effect of the defect on a fast state acts on the others over the step.
            if step.fast.contains(&place) {
                let slow = self.linear.dynamic.iter().enumerate().filter(|(other, _)| !step.fast.contains(other));
                let acts = |(_, other): (usize, &Dynamic<N>)| {
                    other.factors[place].clone() * defect * &step.width * &other.root
                };
                norm = slow.map(acts).fold(norm, |norm, more| norm + more);
            }
        }
        norm
    }

    /// Adds the error that the uncertain time of a break or an event causes: the jumps of the rates over that time.
    fn add_slivers(&mut self, step: &Step<N>) {
        let late = self.reached.late.clone();
        if is_exact_zero(&late) {
            return;
        }
        let Some(taken) = self.before.take() else { return };
        let (before, unit) = (&taken.step.states, &taken.step.unit);
        let reach = taken.width.clone() / unit;
        for (state, terms) in step.states.iter().enumerate() {
            // Rates and their slopes per time, at the end of the step before and at the beginning of this one. Doubles
            // suffice: what they lose is a rounding of the rates.
            let [old, new] = [rough_slope_at(&before[state], &reach), rough_slope_at(terms, &late.zero())];
            let [old, new] = [(old, unit), (new, &step.unit)].map(|(slope, unit)| slope.map(|x| x / unit.to_f64()));
            let jump = (new[0] - old[0]).abs() * (1.0 + 2.0 * f64::EPSILON) + old[1] + new[1];
            let old_bend = rough_slope(&before[state], &(late.clone() / unit + &reach), 2) / unit.square();
            let bend = rough_slope(terms, &(late.clone() / &step.unit), 2) / step.unit.square() + old_bend;
            let jump = self.jolts.get(state).map_or(late.double(jump), |jolt| jolt.clone() + late.double(jump));
            let added = upper((jump + bend * &late) * &late);
            self.add_error(state, added);
        }
        self.before = Some(taken);
    }
}
