//! Bounds of the errors of the states of a cluster.

use super::cluster::Cluster;
use super::curve::{Curve, greater, rough_slope, rough_slope_at, upper};
use super::interface::{Mode, Rows};
use super::node::Source;
use super::step::{Linear, Step, Values, refs};
use crate::number::{Bounded, is_exact_zero};

impl<N: Bounded> Cluster<N> {
    /// Returns the bounds of the errors of the states over a step, and adds what uncertain breaks before it have
    /// caused.
    pub(super) fn step_errors(&mut self, inputs: &[[Curve<N>; 2]], step: &Step<N>) -> Vec<N> {
        self.add_slivers(step);
        let zero = self.norm.zero();
        let Linear { dynamic, decay, .. } = self.linear.clone();
        let masses = self.masses.len();
        let given = |states: &dyn Fn(usize) -> N| {
            let value = |j: usize| {
                let side = |side: usize| match &self.interfaces[j].sides[side].source {
                    Source::Mass(mass) => states(*mass),
                    _ => inputs[j][side].error.clone(),
                };
                [side(0), side(1), states(masses + j)]
            };
            let values: Vec<Values<N>> = (0..self.interfaces.len()).map(value).collect();
            self.rates(&values, true)
        };
        let width = &step.width;
        let mut fading = None;
        let norm = match &dynamic[..] {
            [] => zero.clone(),
            [(state, root)] => {
                let decay = decay.unwrap_or_else(|| zero.clone());
                let input = given(&|_| zero.clone())[*state].clone();
                let before = self.norm.clone();
                let defect = step.defects[*state].clone() * root;
                let decays = decay.positive() == Ok(true);
                let held = match decays {
                    true if is_exact_zero(&input) => zero.clone(),
                    true => input / &decay * root,
                    false => before.clone() + input * width * root,
                };
                fading = decays.then(|| (before.clone(), upper(held.clone() + &defect)));
                if decays { greater(before, held) + defect } else { held + defect }
            }
            _ => self.energy_bound(&dynamic, inputs, step),
        };
        let mut errors: Vec<N> = self.masses.iter().map(|mass| norm.clone() / &mass.root).collect();
        let of = |state: usize| self.linear.root(state).map(|root| norm.clone() / root);
        let known: Vec<N> =
            (0..masses + self.interfaces.len()).map(|state| of(state).unwrap_or_else(|| zero.clone())).collect();
        let rates = given(&|state| known[state].clone());
        for (j, interface) in self.interfaces.iter().enumerate() {
            let state = masses + j;
            errors.push(
                of(state).unwrap_or_else(|| {
                    interface.gap_error.clone() + rates[state].clone() * width + &step.defects[state]
                }),
            );
        }
        self.fading = fading;
        self.norm = upper(norm);
        errors
    }

    /// Lets the norm of a single state decay over a step: an error of the state before the step fades as `e⁻ᵏʷ`, which
    /// is below `1/(1 + x + x²/2 + x³/6)` for `x = κw`.
    pub(super) fn fade(&mut self, width: &N) {
        let (Some((before, held)), Some(decay)) = (self.fading.take(), &self.linear.decay) else { return };
        let x = decay.clone() * width;
        let sixth = (x.clone() / x.int(3) + x.one()) * &x / x.int(2) + x.one();
        let norm = upper(before / (sixth * &x + x.one()) + held);
        if norm.below(&self.norm) == Ok(true) {
            self.norm = norm;
        }
    }

    /// Returns `√(n² + ½ Σ Z e² w) + Σ √weight · defect`.
    fn energy_bound(&self, dynamic: &[(usize, N)], inputs: &[[Curve<N>; 2]], step: &Step<N>) -> N {
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
        dynamic.iter().fold(norm, |norm, (state, root)| norm + step.defects[*state].clone() * root)
    }

    /// Adds the error that the uncertain time of a break or an event causes: the jumps of the rates over that time.
    fn add_slivers(&mut self, step: &Step<N>) {
        let late = self.reached.late.clone();
        let Some((before, unit, reach)) = self.before.clone().filter(|_| !is_exact_zero(&late)) else { return };
        for (state, terms) in step.states.iter().enumerate() {
            // Rates and their slopes per time, at the end of the step before and at the beginning of this one. Doubles
            // suffice: what they lose is a rounding of the rates.
            let [old, new] = [rough_slope_at(&before[state], &reach), rough_slope_at(terms, &late.zero())];
            let [old, new] = [(old, &unit), (new, &step.unit)].map(|(slope, unit)| slope.map(|x| x / unit.to_f64()));
            let jump = (new[0] - old[0]).abs() * (1.0 + 2.0 * f64::EPSILON) + old[1] + new[1];
            let old_bend = rough_slope(&before[state], &(late.clone() / &unit + &reach), 2) / unit.square();
            let bend = rough_slope(terms, &(late.clone() / &step.unit), 2) / step.unit.square() + old_bend;
            let added = upper((late.double(jump) + bend * &late) * &late);
            match self.linear.root(state) {
                Some(root) => self.norm = self.norm.clone() + added * root,
                None => {
                    let interface = &mut self.interfaces[state - self.masses.len()];
                    interface.gap_error = interface.gap_error.clone() + added;
                }
            }
        }
    }
}
