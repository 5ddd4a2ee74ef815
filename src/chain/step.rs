//! The linear equation of a cluster over a step, and its solution by polynomials.

use super::cluster::{Cluster, Solved};
use super::curve::{Curve, bound, unit_of};
use super::interface::{Input, Interface, Row};
use super::linear::{Linear, WIDEST, even};
use super::node::{Source, Stop};
use crate::number::Bounded;

/// The states over a step.
#[derive(Clone, Debug)]
pub(super) struct Step<N> {
    /// Coefficients of each state, for times in the unit.
    pub(super) states: Vec<Vec<N>>,
    pub(super) unit: N,
    pub(super) width: N,
    /// Integral of the defect of each state; of a fast one, a bound of its distance from the polynomial.
    pub(super) defects: Vec<N>,
    /// Fast states, by their places among the dynamic ones.
    pub(super) fast: Vec<usize>,
}

/// Polynomials that solve the equation of the states.
struct Polynomials<N> {
    /// Coefficients of each state.
    states: Vec<Vec<N>>,
    unit: N,
    /// Bounds of the coefficients of the integral of the defect of each state; of the defect, for a fast one.
    radii: Vec<Vec<N>>,
    /// Bounds of the rates in the order that is left out; zero for a fast state.
    rates: Vec<N>,
    /// Number of fast states.
    fast: usize,
    /// Distances of the polynomials of the fast states from the states at the beginning.
    off: Vec<N>,
}

/// Roundings of a state that do not count as a decaying part.
const NOISE: i64 = 64;

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

    pub(super) fn rates_in_order(&self, inputs: &[[Curve<N>; 2]], k: usize, state: &dyn Fn(usize) -> N) -> Vec<N> {
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

    pub(super) fn inputs_of_zero(&self) -> Vec<[Curve<N>; 2]> {
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
            return Ok(Step { states, unit: unit_of(width), width: width.clone(), defects, fast: Vec::new() });
        }
        let Linear { dynamic, rate, .. } = &self.linear;
        let product = rate * width.to_f64();
        if !product.is_finite() || !rate.is_finite() {
            return Err(Stop::Open);
        }
        let tolerance = self.speed.clone() * &self.rounding;
        // Number of the first states in the order of their decay that have decayed.
        let mut settled = dynamic.len();
        while let Some((fast, slow)) = self.linear.fast(self.degree, width.to_f64(), settled) {
            let slow = if slow < width.to_f64() { width.double(slow) } else { width.clone() };
            match self.solve_stiff(inputs, fast, &slow, &tolerance) {
                Ok(solved) => return Ok(self.shortened(solved, (slow, *rate), &tolerance)),
                Err(moving) => settled = moving,
            }
        }
        let shorter = even(*rate, width.to_f64());
        let width = if shorter < width.to_f64() { width.double(shorter) } else { width.clone() };
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
        let rates = rates.iter().map(N::magnitude).collect();
        let solved = Polynomials { states, unit, radii, rates, fast: 0, off: Vec::new() };
        Ok(self.shortened(solved, (width, *rate), &tolerance))
    }

    /// Returns the step with the polynomials, over a width on which the order that they leave out is within the
    /// tolerance.
    fn shortened(&self, solved: Polynomials<N>, (mut width, rate): (N, f64), tolerance: &N) -> Step<N> {
        let Polynomials { states, unit, radii, rates, fast, off } = solved;
        let last = radii.iter().map(Vec::len).max().unwrap_or(1) - 1;
        // The order that is left out.
        let rest = |state: usize, width: &N| {
            let share = power(&(width.clone() / &unit), last + 1);
            rates[state].clone() * &unit * share / width.int(last as i64 + 1)
        };
        for _ in 0..8 {
            let allowed = |state: usize| {
                let time = if rate > 0.0 { width.to_f64().min(1.0 / rate) } else { width.to_f64() };
                if state < self.masses.len() { 1.0 } else { time }
            };
            let excess = |state: usize| (rest(state, &width) / tolerance).to_f64() / allowed(state);
            let worst = (0..states.len()).map(excess).fold(0.0, f64::max);
            if worst <= 1.0 || !worst.is_finite() {
                break;
            }
            let factor = 0.9 * worst.powf(-1.0 / (last as f64 + 1.0));
            width = (width * tolerance.double(factor)).centred().0;
        }
        let reach = width.clone() / &unit;
        let defect = |state: usize| bound(&radii[state], &reach) + rest(state, &width);
        let mut defects: Vec<N> = (0..states.len()).map(defect).collect();
        if let Some(block) = self.linear.block(fast) {
            let own: Vec<N> = block.states.iter().map(|state| defects[*state].clone()).collect();
            for ((state, driven), left) in block.states.iter().zip(block.driven(&own)).zip(block.left(&off)) {
                defects[*state] = driven + left;
            }
        }
        Step { states, unit, width, defects, fast: self.linear.order[..fast].to_vec() }
    }

    /// Solves the equation over a width in which the first `count` states in the order of their decay follow the others
    /// at once: `x⁽ᵏ⁾ = M⁻¹ (x⁽ᵏ⁺¹⁾ − u⁽ᵏ⁾)` for their matrix `M` and the sum `u` of all that acts on them.
    ///
    /// **Errors**: the place in that order of the slowest state of which a part that decays is more than some
    /// roundings.
    fn solve_stiff(
        &self,
        inputs: &[[Curve<N>; 2]],
        count: usize,
        width: &N,
        tolerance: &N,
    ) -> Result<Polynomials<N>, usize> {
        let zero = self.norm.zero();
        let Some(block) = self.linear.block(count) else { return Err(0) };
        let has_slow = count < self.linear.dynamic.len();
        let last = inputs.iter().flatten().map(|curve| curve.terms.len()).max().unwrap_or(1).max(self.degree);
        let unit = unit_of(width);
        let inputs = in_unit(inputs, &unit);
        let begun = self.states();
        let is_fast = |state: usize| block.states.contains(&state);
        let mut states: Vec<Vec<N>> = vec![vec![zero.clone(); last + 1]; begun.len()];
        for (state, begun) in begun.iter().enumerate().filter(|(state, _)| !is_fast(*state)) {
            states[state][0] = begun.clone();
        }
        let slope = |terms: &[N], k: usize| match terms.get(k + 1) {
            Some(next) => next.clone() * zero.int(k as i64 + 1) / &unit,
            None => zero.clone(),
        };
        // Returns what the fast states have to make up for in this order.
        let missing = |states: &[Vec<N>], k: usize| -> Vec<N> {
            let slow = |state: usize| if is_fast(state) { zero.clone() } else { states[state][k].clone() };
            let forced = self.rates_in_order(&inputs, k, &slow);
            block.states.iter().map(|state| slope(&states[*state], k) - &forced[*state]).collect()
        };
        // Returns the sizes of roundings of the fast states.
        let noise = |states: &[Vec<N>], missing: &[N]| -> Vec<N> {
            let sizes = block.inverse_size(missing).into_iter();
            let noise = |((state, size), time): ((&usize, N), &N)| {
                let is_mass = *state < self.masses.len();
                let allowed = if is_mass { tolerance.clone() } else { tolerance.clone() * time };
                allowed + (size + states[*state][0].magnitude()) * &self.rounding
            };
            block.states.iter().zip(sizes).zip(&block.times).map(noise).collect()
        };
        // Returns the greatest change of a fast state in this order, in units of its roundings.
        let follow = |states: &mut [Vec<N>], k: usize| {
            let missing = missing(states, k);
            let noise = noise(states, &missing);
            let mut changed = 0.0_f64;
            for ((state, found), noise) in block.states.iter().zip(block.inverse(&missing)).zip(noise) {
                let found = found.centred().0;
                let change = (found.clone() - &states[*state][k]).magnitude();
                states[*state][k] = found;
                changed = changed.max((change / noise).to_f64());
            }
            changed
        };
        let advance = |states: &mut [Vec<N>], k: usize| {
            let rates = self.rates_in_order(&inputs, k, &|state| states[state][k].clone());
            for (state, rate) in rates.into_iter().enumerate().filter(|(state, _)| !is_fast(*state)) {
                if k < last {
                    states[state][k + 1] = (rate * &unit / zero.int(k as i64 + 1)).centred().0;
                }
            }
        };
        // The fast states follow from their higher orders, and the others from their lower ones.
        for _ in 0..=last {
            let mut changed = (0..=last).rev().map(|k| follow(&mut states, k)).fold(0.0, f64::max);
            for k in 0..=last {
                if has_slow {
                    changed = changed.max(follow(&mut states, k));
                }
                advance(&mut states, k);
            }
            if changed < 1.0 || !has_slow {
                break;
            }
        }
        // A part within the errors of the signals does not count: it may be none of the motion.
        let known = |side: &Input<N>, curve: &Curve<N>| match side.source {
            Source::Mass(mass) if is_fast(mass) => zero.clone(),
            Source::Mass(mass) => self.masses[mass].error.clone(),
            _ => curve.error.clone(),
        };
        let errors = self.interfaces.iter().zip(&inputs).map(|(interface, curves)| {
            let [below, above] = [0, 1].map(|side| known(&interface.sides[side], &curves[side]));
            [below, above, zero.clone()]
        });
        let errors = self.rates(&errors.collect::<Vec<_>>(), true);
        let blurs = block.driven(&block.states.iter().map(|state| errors[*state].clone()).collect::<Vec<_>>());
        let noise = block.left(&noise(&states, &missing(&states, 0)));
        let off: Vec<N> =
            block.states.iter().map(|state| (begun[*state].clone() - &states[*state][0]).magnitude()).collect();
        let moves = |i: &usize| off[*i].below(&(noise[*i].clone() * zero.int(NOISE) + &blurs[*i])) != Ok(true);
        if let Some(slowest) = (0..count).rev().find(moves) {
            return Err(slowest);
        }
        let mut radii: Vec<Vec<N>> = vec![vec![zero.clone()]; states.len()];
        let mut rates = vec![zero.clone(); states.len()];
        for k in 0..=last {
            for (state, rate) in self.rates_in_order(&inputs, k, &|state| states[state][k].clone()).iter().enumerate() {
                let defect = (slope(&states[state], k) - rate).magnitude();
                match is_fast(state) {
                    true if k == 0 => radii[state][0] = defect,
                    true => radii[state].push(defect),
                    false if k < last => radii[state].push(defect * &unit / zero.int(k as i64 + 1)),
                    false => rates[state] = defect,
                }
            }
        }
        Ok(Polynomials { states, unit, radii, rates, fast: count, off })
    }
}

/// Returns arriving signals in another unit of time.
pub(super) fn in_unit<N: Bounded>(inputs: &[[Curve<N>; 2]], unit: &N) -> Vec<[Curve<N>; 2]> {
    inputs.iter().map(|sides| sides.each_ref().map(|curve| curve.in_unit(unit))).collect()
}
