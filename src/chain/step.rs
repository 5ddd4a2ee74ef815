//! The linear equation of a cluster over a step, and its solution by polynomials.

use super::cluster::{Cluster, Solved};
use super::curve::{Curve, bound, unit_of};
use super::interface::{Interface, Row};
use super::node::{Source, Stop};
use crate::number::{Bounded, is_exact_zero};

/// The states over a step.
pub(super) struct Step<N> {
    /// Coefficients of each state, for times in the unit.
    pub(super) states: Vec<Vec<N>>,
    pub(super) unit: N,
    pub(super) width: N,
    /// Integral of the defect of each state, or a bound of its effect.
    pub(super) defects: Vec<N>,
}

/// The states that act back on the motion while no contact changes.
#[derive(Clone, Debug)]
pub(super) struct Linear<N> {
    /// Each state, with the root of its weight in the norm.
    pub(super) dynamic: Vec<(usize, N)>,
    /// The rate at which a single state decays.
    pub(super) decay: Option<N>,
    /// A bound of the rates.
    rate: f64,
}

impl<N> Default for Linear<N> {
    fn default() -> Self {
        Linear { dynamic: Vec::new(), decay: None, rate: 0.0 }
    }
}

impl<N> Linear<N> {
    /// Returns the root of the weight of a state, if it acts back.
    pub(super) fn root(&self, state: usize) -> Option<&N> {
        self.dynamic.iter().find(|(of, _)| *of == state).map(|(_, root)| root)
    }
}

/// Greatest product of rate and width for a Taylor step.
const WIDEST: f64 = 2.0;

/// Share of the greatest width that a step takes.
const UNEVEN: f64 = 0.971_828_182_845;

/// Roundings of a state that do not count as a decaying part.
const NOISE: f64 = 64.0;

/// Returns the degree at which `θᵏ/k!` falls below a rounding, for steps of [`WIDEST`].
pub(super) fn degree(bits: u32) -> usize {
    let (mut log2, mut k) = (0.0, 0);
    while log2 > -f64::from(bits) {
        k += 1;
        log2 += (WIDEST / f64::from(k)).log2();
    }
    k as usize
}

/// Returns `x` to the power `n`.
pub(super) fn power<N: Bounded>(x: &N, n: usize) -> N {
    let half = if n < 2 { x.one() } else { power(x, n / 2).square() };
    if n % 2 == 1 { half * x } else { half }
}

/// The signals at an interface in one order: from below, from above, and the gap.
pub(super) type Values<N> = [N; 3];

pub(super) fn refs<N>(values: &Values<N>) -> [&N; 3] {
    values.each_ref()
}

impl<N: Bounded> Cluster<N> {
    /// Returns the arriving signals as polynomials from `origin` on. Those of masses stay empty.
    pub(super) fn inputs(&self, origin: &N, width: &N) -> Vec<[Curve<N>; 2]> {
        let curve = |interface: &Interface<N>, side: usize| interface.sides[side].signal.about(origin, width);
        self.interfaces.iter().map(|interface| [0, 1].map(|side| curve(interface, side))).collect()
    }

    /// Returns the signals at an interface in the order `k`.
    pub(super) fn values(&self, inputs: &[[Curve<N>; 2]], j: usize, k: usize, state: &dyn Fn(usize) -> N) -> Values<N> {
        let side = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => state(*mass),
            _ => inputs[j][side].terms.get(k).cloned().unwrap_or_else(|| self.norm.zero()),
        };
        [side(0), side(1), state(self.masses.len() + j)]
    }

    /// Returns the rates of the states for these signals at each interface, or their bounds for bounds of the signals.
    pub(super) fn rates(&self, values: &[Values<N>], are_bounds: bool) -> Vec<N> {
        let row = |row: &Row<N>, j: usize| match are_bounds {
            true => row.bound_of(refs(&values[j])),
            false => row.of(refs(&values[j])),
        };
        let mut rates = Vec::with_capacity(self.masses.len() + self.interfaces.len());
        if !self.masses.is_empty() {
            let forces: Vec<N> =
                self.interfaces.iter().enumerate().map(|(j, interface)| row(&interface.rows().force, j)).collect();
            let sum = |i: usize| match are_bounds {
                true => forces[i].clone() + &forces[i + 1],
                false => forces[i].clone() - &forces[i + 1],
            };
            rates.extend(self.masses.iter().enumerate().map(|(i, mass)| sum(i) * &mass.inverse));
        }
        rates.extend(self.interfaces.iter().enumerate().map(|(j, interface)| row(&interface.rows().rate, j)));
        rates
    }

    fn rates_in_order(&self, inputs: &[[Curve<N>; 2]], k: usize, state: &dyn Fn(usize) -> N) -> Vec<N> {
        let values: Vec<Values<N>> = (0..self.interfaces.len()).map(|j| self.values(inputs, j, k, state)).collect();
        self.rates(&values, false)
    }

    /// Returns the polynomials of rows of the law of an interface over a step.
    pub(super) fn curves<const R: usize>(&self, rows: [&Row<N>; R], j: usize, solved: Solved<'_, N>) -> [Curve<N>; R] {
        let mut values = Vec::new();
        rows.map(|row| self.row_curve(row, j, solved, &mut values))
    }

    /// Returns the polynomial of a row; `values` are the signals in all orders, which the first row that needs them
    /// finds.
    fn row_curve(
        &self,
        row: &Row<N>,
        j: usize,
        (inputs, step, errors): Solved<'_, N>,
        values: &mut Vec<Values<N>>,
    ) -> Curve<N> {
        let zero = self.norm.zero();
        let is_mass = |side: usize| matches!(self.interfaces[j].sides[side].source, Source::Mass(_));
        let [below, above] = [0, 1].map(|side| is_mass(side) || !inputs[j][side].is_zero());
        let counts = [below, above, true];
        let origin = (&self.reached.at, &step.unit);
        if row.is_zero(counts) {
            return Curve::new(origin, vec![zero.clone()], zero, &step.width);
        }
        let signal = |k: usize| inputs[j].get(k).filter(|_| !is_mass(k));
        if let Some((curve, negative)) = row.only(counts).and_then(|(k, negative)| Some((signal(k)?, negative))) {
            // A signal that passes as it is.
            let curve = Curve { width: step.width.clone(), ..curve.clone() }.trimmed();
            return if negative { curve.negated() } else { curve };
        }
        if values.is_empty() {
            let states = step.states.iter().map(Vec::len).max().unwrap_or(1);
            let count = inputs[j].iter().map(|curve| curve.terms.len()).max().unwrap_or(1).max(states);
            *values = (0..count)
                .map(|k| {
                    let state = |state: usize| step.states[state].get(k).cloned().unwrap_or_else(|| zero.clone());
                    self.values(inputs, j, k, &state)
                })
                .collect();
        }
        let error = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => errors[*mass].clone(),
            _ => inputs[j][side].error.clone(),
        };
        let bounds = [error(0), error(1), errors[self.masses.len() + j].clone()];
        let terms = values.iter().map(|values| row.of(refs(values))).collect();
        Curve::new(origin, terms, row.bound_of(refs(&bounds)), &step.width)
    }

    /// Returns the polynomial of a state over a step.
    pub(super) fn state_curve(&self, state: usize, (_, step, errors): Solved<'_, N>) -> Curve<N> {
        let origin = (&self.reached.at, &step.unit);
        Curve::new(origin, step.states[state].clone(), errors[state].clone(), &step.width)
    }

    /// Returns the values of the states at the time that is reached.
    fn states(&self) -> Vec<N> {
        let gaps = self.interfaces.iter().map(|interface| interface.gap.clone());
        self.masses.iter().map(|mass| mass.velocity.clone()).chain(gaps).collect()
    }

    /// Returns the states that act back on the motion in the present state of the contacts.
    pub(super) fn linear(&self) -> Linear<N> {
        let zero = self.norm.zero();
        let masses = self.masses.iter().map(|mass| mass.root.clone()).enumerate();
        let sprung = self.interfaces.iter().enumerate().filter(|(_, interface)| interface.is_sprung());
        let root = |(j, interface): (usize, &Interface<N>)| {
            Some((self.masses.len() + j, interface.soft.as_ref()?.root.clone()))
        };
        let dynamic: Vec<(usize, N)> = masses.chain(sprung.filter_map(root)).collect();
        let none = self.inputs_of_zero();
        let column = |of: usize| {
            let state = |k: usize| if k == of { zero.one() } else { zero.zero() };
            self.rates_in_order(&none, 0, &state)
        };
        let columns: Vec<Vec<N>> = dynamic.iter().map(|(of, _)| column(*of)).collect();
        let scaled = |(i, own): &(usize, N), (j, other): (usize, &N)| {
            (columns[j][*i].clone() * own / other).magnitude().to_f64()
        };
        let others = || dynamic.iter().map(|(_, root)| root).enumerate();
        let sum = |row: &(usize, N)| others().map(|other| scaled(row, other)).sum::<f64>();
        let rate = dynamic.iter().map(sum).fold(0.0, f64::max);
        let decay = match &dynamic[..] {
            [(state, _)] => Some(-columns[0][*state].clone()),
            _ => None,
        };
        Linear { dynamic, decay, rate }
    }

    fn inputs_of_zero(&self) -> Vec<[Curve<N>; 2]> {
        let zero = self.norm.zero();
        let none = Curve {
            origin: zero.clone(),
            unit: zero.one(),
            terms: vec![zero.clone()].into(),
            error: zero.clone(),
            width: zero,
        };
        self.interfaces.iter().map(|_| [none.clone(), none.clone()]).collect()
    }

    /// Solves the equation of the states from the time that is reached on, over `width` or less.
    pub(super) fn solve(&self, inputs: &[[Curve<N>; 2]], width: &N) -> Result<Step<N>, Stop> {
        let zero = self.norm.zero();
        if self.masses.is_empty() && self.interfaces.iter().all(|interface| interface.rows().rate.is_zero([true; 3])) {
            let states: Vec<Vec<N>> = self.states().into_iter().map(|state| vec![state]).collect();
            let defects = vec![zero; states.len()];
            return Ok(Step { states, unit: unit_of(width), width: width.clone(), defects });
        }
        let Linear { dynamic, decay, rate } = &self.linear;
        let rate = *rate;
        let tolerance = self.speed.clone() * &self.rounding;
        let product = rate * width.to_f64();
        if !product.is_finite() || !rate.is_finite() {
            return Err(Stop::Open);
        }
        if let ([(state, _)], Some(decay), true) = (&dynamic[..], decay, product > self.degree as f64) {
            return Ok(self.solve_stiff(inputs, (*state, decay), width, &tolerance));
        }
        let mut width = width.clone();
        if product > WIDEST {
            // A width that is no simple fraction keeps the ends of steps away from times that are asked for.
            width = (width * zero.double(UNEVEN / (product / WIDEST).ceil())).centred().0;
        }
        let unit = unit_of(&width);
        let inputs = in_unit(inputs, &unit);
        let count = self.masses.len() + self.interfaces.len();
        let mut states: Vec<Vec<N>> = self.states().into_iter().map(|state| vec![state]).collect();
        let mut radii: Vec<Vec<N>> = vec![vec![zero.clone()]; count];
        // Without a state that acts back, the states are integrals of the signals.
        let least = if dynamic.is_empty() { 1 } else { self.degree };
        let last = inputs.iter().flatten().map(|curve| curve.terms.len()).max().unwrap_or(1).max(least);
        let mut rates = Vec::new();
        for k in 0..=last {
            rates = self.rates_in_order(&inputs, k, &|state| states[state][k].clone());
            if k < last {
                for (state, rate) in rates.iter().enumerate() {
                    let (term, radius) = (rate.clone() * &unit / rate.int(k as i64 + 1)).centred();
                    states[state].push(term);
                    radii[state].push(radius);
                }
            }
        }
        // The order that is left out.
        let rest = |state: usize, width: &N| {
            let share = power(&(width.clone() / &unit), last + 1);
            rates[state].magnitude() * &unit * share / width.int(last as i64 + 1)
        };
        for _ in 0..8 {
            let allowed = |state: usize| {
                let time = if rate > 0.0 { width.to_f64().min(1.0 / rate) } else { width.to_f64() };
                if state < self.masses.len() { 1.0 } else { time }
            };
            let excess = |state: usize| (rest(state, &width) / &tolerance).to_f64() / allowed(state);
            let worst = (0..count).map(excess).fold(0.0, f64::max);
            if worst <= 1.0 || !worst.is_finite() {
                break;
            }
            let factor = 0.9 * worst.powf(-1.0 / (last as f64 + 1.0));
            width = (width * zero.double(factor)).centred().0;
        }
        let reach = width.clone() / &unit;
        let defect = |state: usize| bound(&radii[state], &reach) + rest(state, &width);
        let defects = (0..count).map(defect).collect();
        Ok(Step { states, unit, width, defects })
    }

    /// Solves `x′ = −κx + u` for one state that decays fast: `Σ (−1)ᵏ u⁽ᵏ⁾/κᵏ⁺¹` and a decaying exponential, which is a
    /// polynomial over the width of the step. The other states are integrals.
    fn solve_stiff(&self, inputs: &[[Curve<N>; 2]], (fast, decay): (usize, &N), width: &N, tolerance: &N) -> Step<N> {
        let zero = self.norm.zero();
        let last = inputs.iter().flatten().map(|curve| curve.terms.len()).max().unwrap_or(1).max(self.degree);
        let none = |_: usize| zero.clone();
        let wide = unit_of(width);
        let inputs = in_unit(inputs, &wide);
        let mut slow = vec![zero.clone(); last + 2];
        for k in (0..=last).rev() {
            let forced = self.rates_in_order(&inputs, k, &none)[fast].clone();
            let next = slow[k + 1].clone() * zero.int(k as i64 + 1) / &wide;
            slow[k] = ((forced - next) / decay).centred().0;
        }
        slow.truncate(last + 1);
        let begun = self.states();
        let amplitude = (begun[fast].clone() - &slow[0]).centred().0;
        let allowed = if fast < self.masses.len() { tolerance.clone() } else { tolerance.clone() / decay };
        // An amplitude within some roundings of the state is dropped; it would not decay.
        let noise = slow[0].magnitude() * &self.rounding;
        let excess = (amplitude.magnitude() / (allowed + noise)).to_f64();
        let (mut width, mut unit, mut terms, mut inputs) = (width.clone(), wide.clone(), slow, inputs);
        let mut dropped = amplitude.magnitude();
        if excess > NOISE {
            // The order that is left out, |C| (κw)ⁿ/n!, is at most the tolerance.
            let log2: f64 = (1..=last).map(|k| (k as f64).log2()).sum();
            let reach = ((log2 - excess.min(1e300).log2()) / last as f64).exp2() / decay.to_f64();
            if reach < width.to_f64() {
                width = zero.double(reach * 0.99);
                unit = unit_of(&width);
                inputs = in_unit(&inputs, &unit);
            }
            let (mut share, ratio) = (zero.one(), unit.clone() / wide);
            let (mut decaying, per_unit) = (amplitude, decay.clone() * &unit);
            for (k, term) in terms.iter_mut().enumerate() {
                if k > 0 {
                    decaying = (-(decaying * &per_unit) / zero.int(k as i64)).centred().0;
                    share = share * &ratio;
                }
                *term = (term.clone() * &share + &decaying).centred().0;
            }
            dropped = zero.clone();
        }
        let mut states: Vec<Vec<N>> = begun.iter().map(|state| vec![state.clone()]).collect();
        let first = (terms[0].clone() - &begun[fast]).magnitude();
        let first = if is_exact_zero(&dropped) { first } else { zero.clone() };
        states[fast] = terms;
        let mut defects: Vec<Vec<N>> = vec![Vec::new(); states.len()];
        for k in 0..=last {
            let state = |state: usize| states[state].get(k).cloned().unwrap_or_else(|| zero.clone());
            let rates = self.rates_in_order(&inputs, k, &state);
            for (state, rate) in rates.iter().enumerate() {
                let factor = zero.int(k as i64 + 1) / &unit;
                if state == fast {
                    let own = states[fast].get(k + 1).map_or_else(|| zero.clone(), |term| term.clone() * &factor);
                    defects[state].push((own - rate).magnitude());
                } else if k < last {
                    let (term, radius) = (rate.clone() / &factor).centred();
                    states[state].push(term);
                    defects[state].push(radius * &factor);
                } else {
                    defects[state].push(rate.magnitude());
                }
            }
        }
        let reach = width.clone() / &unit;
        let effect = |state: usize| {
            if state == fast {
                // A defect acts for no longer than 1/κ.
                return bound(&defects[state], &reach) / decay + &dropped + &first;
            }
            let integrals = defects[state].iter().enumerate().map(|(k, term)| term.clone() / zero.int(k as i64 + 1));
            bound(&integrals.collect::<Vec<_>>(), &reach) * &width
        };
        let defects = (0..states.len()).map(effect).collect();
        Step { states, unit, width, defects }
    }
}

/// Returns arriving signals in another unit of time.
pub(super) fn in_unit<N: Bounded>(inputs: &[[Curve<N>; 2]], unit: &N) -> Vec<[Curve<N>; 2]> {
    inputs.iter().map(|sides| sides.each_ref().map(|curve| curve.in_unit(unit))).collect()
}
