//! A cluster: neighbouring interfaces with the rigid masses between them, which act on each other without a delay.
//!
//! The states are the velocities of the masses and the gaps. While no contact changes, they solve a linear equation with
//! constant coefficients, `x′ = Mx + Bu`, for arriving signals `u` that are polynomials. The solution is a Taylor
//! polynomial on each step; in a single state that decays much faster than the signals change, it is the polynomial
//! solution and an exponential.
//!
//! **Errors**: the distance of the stored states from the true ones is bounded in the norm of the energy, `Σ mV² + Σ k gap²`
//! over masses and loaded springs. An error of the arriving signals does work of at most `Z e²/4` per unit of time, and
//! dashpots take up energy, so that the norm grows by this and by the defect of the polynomials alone. A single state is
//! bounded by the greater of its error before and that of its input.

use super::curve::{Curve, Fall, Signal, bound, derivative, first_fall, greater, upper, value};
use super::interface::{Interface, Mode, Moment, Row, Rows, Softness};
use super::law::Law;
use super::node::{Occurrence, Source, Stage, Stop};
use super::wave::{Wave, is_exact_zero};
use crate::motion::EventKind;
use crate::number::{Bounded, Open};

/// A rigid mass between two interfaces.
#[derive(Clone, Debug)]
pub(super) struct Mass<N> {
    /// Index of the body.
    pub(super) body: usize,
    /// The velocity at the time that is reached, an exact number.
    pub(super) velocity: N,
    /// Bound of the error of the velocity at the start.
    error: N,
    /// `1/m` and `√m`.
    pub(super) inverse: N,
    pub(super) root: N,
}

/// Neighbouring interfaces with the masses between them.
#[derive(Clone, Debug)]
pub(super) struct Cluster<N> {
    /// The node of the lowest interface.
    pub(super) first: usize,
    pub(super) interfaces: Vec<Interface<N>>,
    masses: Vec<Mass<N>>,
    pub(super) reached: Moment<N>,
    until: Moment<N>,
    /// Bound of the error of the states, in the norm of the energy.
    norm: N,
    /// The natural speed of the chain.
    speed: N,
    /// Degree of the polynomials.
    degree: usize,
    /// States of the step before, and its width.
    before: Option<(Vec<Vec<N>>, N)>,
    /// Latest events of the interfaces.
    latest: Vec<Option<Moment<N>>>,
    /// Number of significant jumps of each interface at the time that is reached, if their order is not known.
    jumps: Vec<usize>,
    /// Number of events without a step between them.
    repeated: usize,
    /// The first time of a decision that the bounds leave open.
    pub(super) doubt: Option<f64>,
}

/// The states over a step.
struct Step<N> {
    states: Vec<Vec<N>>,
    width: N,
    /// Integral of the defect of each state, or a bound of its effect.
    defects: Vec<N>,
}

/// Events of a contact that a step ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Change {
    Close,
    Release,
    Return,
}

/// Events at one time after which a cluster is given up.
const MOST_REPEATED: usize = 16;
/// Greatest product of rate and width for a Taylor step.
const WIDEST: f64 = 2.0;

/// Returns the degree at which `θᵏ/k!` falls below a rounding, for steps of [`WIDEST`].
fn degree(bits: u32) -> usize {
    let (mut log2, mut k) = (0.0, 0);
    while log2 > -f64::from(bits) {
        k += 1;
        log2 += (WIDEST / f64::from(k)).log2();
    }
    k as usize
}

/// Returns `x` to the power `n`.
fn power<N: Bounded>(x: &N, n: usize) -> N {
    let half = if n < 2 { x.one() } else { power(x, n / 2).square() };
    if n % 2 == 1 { half * x } else { half }
}

/// The signals at an interface in one order: from below, from above, and the gap.
type Values<N> = [N; 3];

fn refs<N>(values: &Values<N>) -> [&N; 3] {
    values.each_ref()
}

impl<N: Bounded> Mass<N> {
    pub(super) fn new(body: usize, velocity: N, inverse: N, root: N) -> Self {
        let (velocity, error) = velocity.centred();
        Mass { body, velocity, error, inverse, root }
    }
}

impl<N: Bounded> Cluster<N> {
    pub(super) fn new(first: usize, interfaces: Vec<Interface<N>>, masses: Vec<Mass<N>>, speed: f64, until: &N) -> Self {
        let zero = until.zero();
        let bits = until.bits().unwrap_or(64);
        let norm = masses.iter().fold(zero.clone(), |norm, mass| norm + mass.error.clone() * &mass.root);
        Cluster {
            first,
            latest: vec![None; interfaces.len()],
            jumps: vec![0; interfaces.len()],
            interfaces,
            masses,
            reached: Moment::new(zero.clone()),
            until: Moment::new(until.clone()),
            norm: upper(norm),
            speed: zero.double(speed),
            degree: degree(bits),
            before: None,
            repeated: 0,
            doubt: None,
        }
    }

    /// Lets the signals of the start arrive, and closes contacts that begin closed.
    pub(super) fn begin(&mut self, waves: &[[Wave<N>; 2]]) -> Result<Vec<(usize, Occurrence<N>)>, Stop> {
        let zero = self.norm.zero();
        let mut impacts = Vec::new();
        for interface in &mut self.interfaces {
            for (side, input) in interface.sides.iter_mut().enumerate() {
                input.begin(waves, side);
            }
        }
        for j in 0..self.interfaces.len() {
            let lines = [0, 1].map(|side| self.first_line(j, side));
            let [y, slope] = [0, 1].map(|k| lines[1][k].clone() - &lines[0][k]);
            let interface = &mut self.interfaces[j];
            interface.drive = y.clone();
            if interface.law != Law::Contact || interface.soft.is_none() && interface.mode == Mode::Closed {
                continue;
            }
            if is_exact_zero(&interface.gap) && is_exact_zero(&interface.gap_error) {
                let closes = y.negative()? || y.vanishes()? && slope.negative()?;
                if closes {
                    interface.mode = Mode::Closed;
                    impacts.push((j, y));
                }
            }
        }
        let occurrence = |(j, y): (usize, N)| {
            let kind = Some(EventKind::Impact);
            (self.first + j, Occurrence { kind, t: zero.clone(), drive: [y.clone(), y] })
        };
        Ok(impacts.into_iter().map(occurrence).collect())
    }

    /// Returns value and slope of the signal that arrives at a side at the start.
    fn first_line(&self, j: usize, side: usize) -> [N; 2] {
        let zero = self.norm.zero();
        let input = &self.interfaces[j].sides[side];
        match (&input.source, &input.signal) {
            (Source::Mass(mass), _) => [self.masses[*mass].velocity.clone(), zero],
            (_, Signal::Line(line)) => [line.intercept.clone(), line.slope.clone()],
            (_, Signal::Curve(_)) => [zero.clone(), zero],
        }
    }

    /// Looks up the breaks that have left the neighbours since.
    fn look_up(&mut self, waves: &[[Wave<N>; 2]]) {
        for interface in &mut self.interfaces {
            for (side, input) in interface.sides.iter_mut().enumerate() {
                input.look_up(waves, side);
            }
        }
    }

    /// Goes on to the next break, event, or end of a step. Signals are known up to `horizon`.
    pub(super) fn advance(
        &mut self,
        horizon: Option<N>,
        waves: &mut [[Wave<N>; 2]],
    ) -> Result<Vec<(usize, Occurrence<N>)>, Stop> {
        self.look_up(waves);
        self.pass_breaks(waves);
        let mut end = self.end(horizon);
        let (width, late) = (end.at.clone() - &self.reached.at).centred();
        if width.positive() != Ok(true) {
            return Err(Stop::Open);
        }
        let origin = self.reached.at.clone();
        let inputs: Vec<[Curve<N>; 2]> = self.inputs(&origin, &width);
        let step = self.solve(&inputs, &width)?;
        let is_short = step.width.below(&width) == Ok(true);
        let norm = self.norm.clone();
        let errors = self.step_errors(&inputs, &step);
        let found = self.events(&inputs, &step, &errors)?;
        let earlier = |a: Moment<N>, b: Moment<N>| if b.at.below(&a.at) == Ok(true) { b } else { a };
        let first = found.iter().map(|(_, _, at)| at.clone()).reduce(earlier);
        let (width, next) = match &first {
            Some(at) => {
                let (stored, rounding) = (origin.clone() + &at.at).centred();
                (at.at.clone(), Moment::beside(stored, at.late.clone() + rounding))
            }
            None if is_short => {
                let stored = (origin.clone() + &step.width).centred().0;
                (step.width.clone(), Moment::new(stored))
            }
            None => {
                end.late = end.late.clone() + &late;
                (width, end)
            }
        };
        let is_at_once = next.at.alike(&origin);
        if is_at_once {
            self.repeated += 1;
            if self.repeated > MOST_REPEATED {
                return Err(Stop::Open);
            }
            self.norm = norm;
        } else {
            self.emit(&inputs, &step, &errors, &width, waves);
            self.take(&step, &errors, &width);
            self.before = Some((step.states, width.clone()));
            self.repeated = 0;
        }
        let drives_before: Vec<N> = self.interfaces.iter().map(|interface| interface.drive.clone()).collect();
        let drives_after: Vec<N> = (0..self.interfaces.len()).map(|j| self.drive(&inputs, j, &width)).collect();
        if !is_at_once {
            self.reached = next;
        } else if self.reached.late.below(&next.late) != Ok(false) {
            self.reached = Moment::beside(self.reached.at.clone(), greater(next.late, self.reached.late.clone()));
        }
        let mut occurrences = Vec::new();
        for (j, change, at) in found {
            if !first.as_ref().is_some_and(|first| at.meets(first)) {
                continue;
            }
            let kind = self.change(j, change, is_at_once);
            if let Some(kind) = kind {
                let before = if is_at_once { drives_before[j].clone() } else { drives_after[j].clone() };
                let drive = [before, drives_after[j].clone()];
                let t = self.reached.time.clone();
                occurrences.push((self.first + j, Occurrence { kind: Some(kind), t, drive }));
            }
        }
        for (interface, drive) in self.interfaces.iter_mut().zip(drives_after) {
            interface.drive = drive;
        }
        Ok(occurrences)
    }

    /// Passes on to the pieces of all signals that begin at the time that is reached.
    fn pass_breaks(&mut self, waves: &[[Wave<N>; 2]]) {
        let mut spread = self.reached.late.clone();
        for j in 0..self.interfaces.len() {
            let mut passed: Vec<(Moment<N>, N)> = Vec::new();
            for side in 0..2 {
                loop {
                    let input = &mut self.interfaces[j].sides[side];
                    let Some(next) = input.next.clone() else { break };
                    if self.reached.at.below(&next.at) == Ok(true) && !next.meets(&self.reached) {
                        break;
                    }
                    let old = input.signal.value_at(&self.reached.at);
                    input.advance(waves, side);
                    let new = input.signal.value_at(&self.reached.at);
                    let apart = (next.at.clone() - &self.reached.at).magnitude() + &next.late;
                    spread = greater(spread, apart);
                    let jump = if side == 0 { old - new } else { new - old };
                    let is_real = jump.positive() == Ok(true) || jump.negative() == Ok(true);
                    if is_real {
                        passed.push((next, jump));
                    }
                }
            }
            self.jumps[j] = 0;
            let told = passed.iter().all(|(moment, _)| moment.is(&passed[0].0));
            if !told {
                self.jumps[j] = passed.len();
                self.check_sliver(j, &passed);
            }
            if !passed.is_empty()
                && let Some(event) = &self.latest[j]
                && event.meets(&self.reached)
                && !passed.iter().all(|(moment, _)| moment.is(event))
            {
                self.doubts();
            }
        }
        self.reached.late = upper(spread);
    }

    /// Notes a doubt if the force of a closed contact may be greater between two breaks that coincide within their bounds
    /// than before and after them.
    fn check_sliver(&mut self, j: usize, passed: &[(Moment<N>, N)]) {
        let interface = &self.interfaces[j];
        let closed = interface.law == Law::Contact && interface.mode == Mode::Closed;
        let [rises, falls] = [1, -1].map(|sign| passed.iter().any(|(_, jump)| (jump.clone() * jump.int(sign)).positive() == Ok(true)));
        if closed && rises && falls {
            self.doubts();
        }
    }

    fn doubts(&mut self) {
        let at = self.reached.at.to_f64();
        self.doubt = Some(self.doubt.map_or(at, |earlier| earlier.min(at)));
    }

    /// Returns the next time at which a signal changes, or up to which signals are known.
    fn end(&self, horizon: Option<N>) -> Moment<N> {
        let horizon = horizon.map(|time| Moment { late: time.zero(), ..Moment::new(time) });
        let fronts = self.interfaces.iter().flat_map(|interface| &interface.sides).filter_map(|side| side.next.clone());
        let first = |a: Moment<N>, b: Moment<N>| if b.at.below(&a.at) == Ok(true) { b } else { a };
        fronts.chain(horizon).fold(self.until.clone(), first)
    }

    /// Returns the arriving signals as polynomials from `origin` on. Those of masses stay empty.
    fn inputs(&self, origin: &N, width: &N) -> Vec<[Curve<N>; 2]> {
        let curve = |interface: &Interface<N>, side: usize| interface.sides[side].signal.about(origin, width);
        self.interfaces.iter().map(|interface| [0, 1].map(|side| curve(interface, side))).collect()
    }

    /// Returns the signals at an interface in the order `k`.
    fn values(&self, inputs: &[[Curve<N>; 2]], j: usize, k: usize, state: &dyn Fn(usize) -> N) -> Values<N> {
        let side = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => state(*mass),
            _ => inputs[j][side].terms.get(k).cloned().unwrap_or_else(|| self.norm.zero()),
        };
        [side(0), side(1), state(self.masses.len() + j)]
    }

    /// Returns the rates of the states for these signals at each interface.
    fn rates(&self, values: &[Values<N>], row: impl Fn(&Row<N>) -> Row<N>, is_bound: bool) -> Vec<N> {
        let forces = |j: usize| row(&self.interfaces[j].rows().force).of(refs(&values[j]));
        let mass = |(i, mass): (usize, &Mass<N>)| {
            let [below, above] = [forces(i), forces(i + 1)];
            (if is_bound { below + above } else { below - above }) * &mass.inverse
        };
        let gap = |(j, interface): (usize, &Interface<N>)| row(&interface.rows().rate).of(refs(&values[j]));
        let masses = self.masses.iter().enumerate().map(mass);
        masses.chain(self.interfaces.iter().enumerate().map(gap)).collect()
    }

    fn rates_in_order(&self, inputs: &[[Curve<N>; 2]], k: usize, state: &dyn Fn(usize) -> N) -> Vec<N> {
        let values: Vec<Values<N>> = (0..self.interfaces.len()).map(|j| self.values(inputs, j, k, state)).collect();
        self.rates(&values, Row::clone, false)
    }

    /// Returns the states that act back on the motion, each with the root of its weight in the norm.
    fn dynamic(&self) -> Vec<(usize, N)> {
        let masses = self.masses.iter().map(|mass| mass.root.clone()).enumerate();
        let sprung = self.interfaces.iter().enumerate().filter(|(_, interface)| interface.is_sprung());
        let springs = sprung.filter_map(|(j, interface)| Some((self.masses.len() + j, interface.soft.as_ref()?.root.clone())));
        masses.chain(springs).collect()
    }

    /// Returns the values of the states at the time that is reached.
    fn states(&self) -> Vec<N> {
        let gaps = self.interfaces.iter().map(|interface| interface.gap.clone());
        self.masses.iter().map(|mass| mass.velocity.clone()).chain(gaps).collect()
    }

    /// Returns the matrix `M` of the dynamic states, and the greatest rate that it has.
    fn matrix(&self, dynamic: &[(usize, N)]) -> (Vec<Vec<N>>, f64) {
        let zero = self.norm.zero();
        let none: Vec<[Curve<N>; 2]> = self.inputs_of_zero();
        let column = |of: usize| {
            let state = |k: usize| if k == of { zero.one() } else { zero.zero() };
            self.rates_in_order(&none, 0, &state)
        };
        let columns: Vec<Vec<N>> = dynamic.iter().map(|(of, _)| column(*of)).collect();
        let entry = |i: usize, j: usize| columns[j][dynamic[i].0].clone();
        let matrix: Vec<Vec<N>> =
            (0..dynamic.len()).map(|i| (0..dynamic.len()).map(|j| entry(i, j)).collect()).collect();
        let scaled = |i: usize, j: usize| {
            (matrix[i][j].clone() * &dynamic[i].1 / &dynamic[j].1).magnitude().to_f64()
        };
        let sum = |i: usize| (0..dynamic.len()).map(|j| scaled(i, j)).sum::<f64>();
        let greatest = (0..dynamic.len()).map(sum).fold(0.0, f64::max);
        (matrix, greatest)
    }

    fn inputs_of_zero(&self) -> Vec<[Curve<N>; 2]> {
        let zero = self.norm.zero();
        let none = Curve { origin: zero.clone(), terms: vec![zero.clone()].into(), error: zero.clone(), width: zero };
        self.interfaces.iter().map(|_| [none.clone(), none.clone()]).collect()
    }

    /// Solves the equation of the states from the time that is reached on, over `width` or less.
    fn solve(&self, inputs: &[[Curve<N>; 2]], width: &N) -> Result<Step<N>, Stop> {
        let zero = self.norm.zero();
        let dynamic = self.dynamic();
        let (matrix, rate) = self.matrix(&dynamic);
        let tolerance = self.speed.clone() * zero.roundoff();
        let product = rate * width.to_f64();
        if !product.is_finite() || !rate.is_finite() {
            return Err(Stop::Open);
        }
        if let ([(state, _)], true) = (&dynamic[..], product > self.degree as f64) {
            let decay = -matrix[0][0].clone();
            return Ok(self.solve_stiff(inputs, (*state, &decay), width, &tolerance));
        }
        let mut width = width.clone();
        if product > WIDEST {
            width = (width / zero.double((product / WIDEST).ceil())).centred().0;
        }
        let count = self.masses.len() + self.interfaces.len();
        let mut states: Vec<Vec<N>> = self.states().into_iter().map(|state| vec![state]).collect();
        let mut radii: Vec<Vec<N>> = vec![vec![zero.clone()]; count];
        let last = inputs.iter().flatten().map(|curve| curve.terms.len()).max().unwrap_or(1).max(self.degree);
        let mut rates = Vec::new();
        for k in 0..=last {
            rates = self.rates_in_order(inputs, k, &|state| states[state][k].clone());
            if k < last {
                for (state, rate) in rates.iter().enumerate() {
                    let (term, radius) = (rate.clone() / rate.int(k as i64 + 1)).centred();
                    states[state].push(term);
                    radii[state].push(radius);
                }
            }
        }
        // The order that is left out.
        let rest = |state: usize, width: &N| rates[state].magnitude() * power(width, last + 1) / width.int(last as i64 + 1);
        for _ in 0..8 {
            let allowed = |state: usize| {
                let time = if rate > 0.0 { width.to_f64().min(1.0 / rate) } else { width.to_f64() };
                if state < self.masses.len() { 1.0 } else { time }
            };
            let excess = |state: usize| (rest(state, &width) / &tolerance).to_f64() / allowed(state);
            let worst = (0..count).map(excess).fold(0.0, f64::max);
            if worst <= 1.0 || !worst.is_finite() && is_exact_zero(&tolerance) {
                break;
            }
            let factor = 0.9 * worst.min(1e300).powf(-1.0 / (last as f64 + 1.0));
            width = (width * zero.double(factor)).centred().0;
        }
        let defect = |state: usize| bound(&radii[state], &width) + rest(state, &width);
        let defects = (0..count).map(defect).collect();
        Ok(Step { states, width, defects })
    }

    /// Solves `x′ = −κx + u` for one state that decays fast: `Σ (−1)ᵏ u⁽ᵏ⁾/κᵏ⁺¹` and a decaying exponential, which is a
    /// polynomial over the width of the step. The other states are integrals.
    fn solve_stiff(&self, inputs: &[[Curve<N>; 2]], (fast, decay): (usize, &N), width: &N, tolerance: &N) -> Step<N> {
        let zero = self.norm.zero();
        let last = inputs.iter().flatten().map(|curve| curve.terms.len()).max().unwrap_or(1).max(self.degree);
        let none = |_: usize| zero.clone();
        let forced: Vec<N> = (0..=last).map(|k| self.rates_in_order(inputs, k, &none)[fast].clone()).collect();
        let mut slow = vec![zero.clone(); last + 2];
        for k in (0..=last).rev() {
            let next = slow[k + 1].clone() * zero.int(k as i64 + 1);
            slow[k] = ((forced[k].clone() - next) / decay).centred().0;
        }
        slow.truncate(last + 1);
        let begun = self.states();
        let amplitude = (begun[fast].clone() - &slow[0]).centred().0;
        let allowed = if fast < self.masses.len() { tolerance.clone() } else { tolerance.clone() / decay };
        let mut width = width.clone();
        let excess = (amplitude.magnitude() / &allowed).to_f64();
        let mut terms = slow;
        let mut dropped = amplitude.magnitude();
        if !(excess <= 1.0) {
            // |C| (κw)ⁿ/n! is at most the tolerance.
            let n = last + 1;
            let log2: f64 = (1..=n).map(|k| (k as f64).log2()).sum();
            let reach = ((log2 - excess.min(1e300).log2()) / n as f64).exp2() / decay.to_f64();
            if reach < width.to_f64() {
                width = zero.double(reach * 0.99);
            }
            let mut decaying = amplitude.clone();
            for (k, term) in terms.iter_mut().enumerate() {
                if k > 0 {
                    decaying = (-(decaying * decay) / zero.int(k as i64)).centred().0;
                }
                *term = (term.clone() + &decaying).centred().0;
            }
            dropped = zero.clone();
        }
        let mut states: Vec<Vec<N>> = begun.iter().map(|state| vec![state.clone()]).collect();
        let first = (terms[0].clone() - &begun[fast]).magnitude();
        states[fast] = terms;
        let mut defects: Vec<Vec<N>> = vec![Vec::new(); states.len()];
        for k in 0..=last {
            let rates = self.rates_in_order(inputs, k, &|state| states[state].get(k).cloned().unwrap_or_else(|| zero.clone()));
            for (state, rate) in rates.iter().enumerate() {
                let factor = zero.int(k as i64 + 1);
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
        let effect = |state: usize| {
            if state == fast {
                // A defect acts for no longer than 1/κ.
                return bound(&defects[state], &width) / decay + &dropped + &first;
            }
            let integrals = defects[state].iter().enumerate().map(|(k, term)| term.clone() / zero.int(k as i64 + 1));
            bound(&integrals.collect::<Vec<_>>(), &width) * &width
        };
        let defects = (0..states.len()).map(effect).collect();
        Step { states, width, defects }
    }

    /// Returns the bounds of the errors of the states over a step, and adds what uncertain breaks before it have caused.
    fn step_errors(&mut self, inputs: &[[Curve<N>; 2]], step: &Step<N>) -> Vec<N> {
        self.add_slivers(step);
        let zero = self.norm.zero();
        let dynamic = self.dynamic();
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
            self.rates(&values, Row::magnitude, true)
        };
        let width = &step.width;
        let norm = match &dynamic[..] {
            [] => zero.clone(),
            [(state, root)] => {
                let (matrix, _) = self.matrix(&dynamic);
                let decay = -matrix[0][0].clone();
                let input = given(&|_| zero.clone())[*state].clone();
                let before = self.norm.clone();
                let held = match decay.positive() {
                    Ok(true) if !is_exact_zero(&input) => greater(before, input / decay * root),
                    Ok(true) => before,
                    _ => before + input * width * root,
                };
                held + step.defects[*state].clone() * root
            }
            _ => self.energy_bound(&dynamic, inputs, step),
        };
        let mut errors: Vec<N> = self.masses.iter().map(|mass| norm.clone() / &mass.root).collect();
        let of = |state: usize| dynamic.iter().find(|(of, _)| *of == state).map(|(_, root)| norm.clone() / root);
        let known: Vec<N> = (0..masses + self.interfaces.len()).map(|state| of(state).unwrap_or_else(|| zero.clone())).collect();
        let rates = given(&|state| known[state].clone());
        for (j, interface) in self.interfaces.iter().enumerate() {
            let state = masses + j;
            errors.push(of(state).unwrap_or_else(|| {
                interface.gap_error.clone() + rates[state].clone() * width + &step.defects[state]
            }));
        }
        self.norm = upper(norm);
        errors
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
                        let force = rows.force.magnitude().of(refs(&values));
                        for mass in [j.checked_sub(1), Some(j)].into_iter().flatten().filter_map(|i| self.masses.get(i)) {
                            shoved = shoved + force.clone() * &mass.inverse * &mass.root;
                        }
                        if let Some(soft) = &interface.soft {
                            shoved = shoved + rows.rate.magnitude().of(refs(&values)) * &soft.root;
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
        let Some((before, width)) = self.before.clone().filter(|_| !is_exact_zero(&late)) else { return };
        let dynamic = self.dynamic();
        for (state, terms) in step.states.iter().enumerate() {
            let (old, new) = (derivative(&before[state]), derivative(terms));
            let jump = (value(&new, &late.zero()) - value(&old, &width)).magnitude();
            let bend = bound(&derivative(&old), &(width.clone() + &late)) + bound(&derivative(&new), &late);
            let added = upper((jump + bend * &late) * &late);
            match dynamic.iter().find(|(of, _)| *of == state) {
                Some((_, root)) => self.norm = self.norm.clone() + added * root,
                None => {
                    let interface = &mut self.interfaces[state - self.masses.len()];
                    interface.gap_error = interface.gap_error.clone() + added;
                }
            }
        }
    }

    /// Returns `y` of an interface after the time `at` in a step.
    fn drive(&self, inputs: &[[Curve<N>; 2]], j: usize, at: &N) -> N {
        let side = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => self.masses[*mass].velocity.clone().widened(&(self.norm.clone() / &self.masses[*mass].root)),
            _ => {
                let curve = &inputs[j][side];
                value(&curve.terms, at).widened(&curve.error)
            }
        };
        side(1) - side(0)
    }

    /// Returns the polynomial of a row of the law of an interface over a step.
    fn curve(
        &self,
        row: &Row<N>,
        j: usize,
        (inputs, step, errors): (&[[Curve<N>; 2]], &Step<N>, &[N]),
        width: &N,
    ) -> Curve<N> {
        let count = step.states.iter().map(Vec::len).max().unwrap_or(1);
        let last = inputs[j].iter().map(|curve| curve.terms.len()).max().unwrap_or(1).max(count);
        let zero = self.norm.zero();
        let state = |k: usize| {
            move |state: usize| step.states[state].get(k).cloned().unwrap_or_else(|| zero.clone())
        };
        let terms = (0..last).map(|k| row.of(refs(&self.values(inputs, j, k, &state.clone()(k))))).collect();
        let masses = self.masses.len();
        let side = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => errors[*mass].clone(),
            _ => inputs[j][side].error.clone(),
        };
        let error = row.magnitude().of(refs(&[side(0), side(1), errors[masses + j].clone()]));
        Curve::new(&self.reached.at, terms, error, width)
    }

    /// Returns the changes of contacts within a step, each with its time since the beginning.
    fn events(
        &mut self,
        inputs: &[[Curve<N>; 2]],
        step: &Step<N>,
        errors: &[N],
    ) -> Result<Vec<(usize, Change, Moment<N>)>, Stop> {
        let mut found = Vec::new();
        let all = (inputs, step, errors);
        let masses = self.masses.len();
        for j in 0..self.interfaces.len() {
            if self.interfaces[j].law != Law::Contact {
                continue;
            }
            let gap = |sign: i64| {
                let terms = step.states[masses + j].iter().map(|term| term.clone() * term.int(sign)).collect();
                Curve::new(&self.reached.at, terms, errors[masses + j].clone(), &step.width)
            };
            let force = |row: &Row<N>| self.curve(row, j, all, &step.width);
            let interface = &self.interfaces[j];
            let mut skipped = self.norm.zero();
            let watched = match interface.mode {
                Mode::Open if interface.is_fresh => {
                    // The force fell to zero, so that y rises from zero, and the gap with it.
                    let drive = self.curve(interface.drive_row(), j, all, &step.width);
                    match drive.rising_width() {
                        Some(width) if width.below(&step.width) == Ok(true) => {
                            let rest = gap(1);
                            let origin = (rest.origin.clone() + &width).centred().0;
                            let left = (step.width.clone() - &width).centred().0;
                            skipped = width;
                            vec![(Change::Close, rest.about(&origin, &left))]
                        }
                        Some(_) => Vec::new(),
                        None => vec![(Change::Close, gap(1))],
                    }
                }
                Mode::Open => vec![(Change::Close, gap(1))],
                Mode::Closed => vec![(Change::Release, force(&interface.rows().force))],
                Mode::Released => {
                    let pull = force(interface.closed_force());
                    let terms = pull.terms.iter().map(|term| -term.clone()).collect::<Vec<_>>().into();
                    vec![(Change::Return, gap(-1)), (Change::Close, Curve { terms, ..pull })]
                }
            };
            let (mut ends_at_zero, before) = (false, found.len());
            for (change, curve) in watched {
                let (fall, doubt) = first_fall(&curve).map_err(|Open| Stop::Open)?;
                if doubt {
                    self.doubts();
                }
                match fall {
                    Fall::After(at) => found.push((j, change, Moment::new(at + &skipped))),
                    Fall::AtEnd => ends_at_zero = true,
                    Fall::None => {}
                }
            }
            let is_at_once = found[before..].iter().any(|(_, _, at)| is_exact_zero(&at.at));
            if std::mem::replace(&mut self.interfaces[j].grazes, ends_at_zero) && !is_at_once {
                self.doubts();
            }
        }
        Ok(found)
    }

    /// Changes the state of a contact; returns the event.
    fn change(&mut self, j: usize, change: Change, at_once: bool) -> Option<EventKind> {
        let masses = self.masses.len();
        let zero = self.norm.zero();
        if at_once && self.jumps[j] > 1 {
            self.doubts();
        }
        self.latest[j] = Some(self.reached.clone());
        let was_sprung = self.interfaces[j].is_sprung();
        let dynamic = self.dynamic();
        let root = dynamic.iter().find(|(state, _)| *state == masses + j).map(|(_, root)| root.clone());
        let interface = &mut self.interfaces[j];
        let rest = interface.gap.magnitude();
        let kind = match change {
            Change::Close => {
                match &interface.soft {
                    Some(soft) if interface.mode == Mode::Released => {
                        let depth = interface.gap.clone().widened(&interface.gap_error);
                        interface.dissipated =
                            interface.dissipated.clone() - (depth.square() * &soft.stiffness).halved();
                    }
                    _ => {
                        interface.gap_error = interface.gap_error.clone() + rest;
                        interface.gap = zero.clone();
                    }
                }
                interface.mode = Mode::Closed;
                Some(EventKind::Impact)
            }
            Change::Release => {
                if was_sprung && let Some(root) = &root {
                    interface.gap_error = self.norm.clone() / root;
                }
                let damped = interface.soft.as_ref().filter(|soft| !is_exact_zero(&soft.damping));
                interface.mode = match damped {
                    Some(soft) => {
                        let depth = interface.gap.clone().widened(&interface.gap_error);
                        interface.dissipated =
                            interface.dissipated.clone() + (depth.square() * &soft.stiffness).halved();
                        Mode::Released
                    }
                    None => {
                        match interface.soft {
                            Some(_) => interface.gap_error = interface.gap_error.clone() + rest,
                            None => interface.is_fresh = true,
                        }
                        interface.gap = zero.clone();
                        Mode::Open
                    }
                };
                Some(EventKind::Release)
            }
            Change::Return => {
                interface.gap_error = interface.gap_error.clone() + rest;
                interface.gap = zero.clone();
                interface.mode = Mode::Open;
                None
            }
        };
        if self.interfaces[j].is_sprung()
            && !was_sprung
            && let Some(soft) = &self.interfaces[j].soft
        {
            self.norm = self.norm.clone() + self.interfaces[j].gap_error.clone() * &soft.root;
            self.interfaces[j].gap_error = zero;
        }
        kind
    }

    /// Sends out the signals of a step, and records its states.
    fn emit(
        &mut self,
        inputs: &[[Curve<N>; 2]],
        step: &Step<N>,
        errors: &[N],
        width: &N,
        waves: &mut [[Wave<N>; 2]],
    ) {
        let all = (inputs, step, errors);
        let from = self.reached.time.clone();
        let masses = self.masses.len();
        let mut stages = Vec::new();
        for (j, interface) in self.interfaces.iter().enumerate() {
            let rows = interface.rows();
            for side in 0..2 {
                if let Source::Wave(body) = &interface.sides[side].source {
                    let curve = self.curve(&rows.leaving[side], j, all, width);
                    waves[*body][1 - side].push_curve(&from, &self.reached.late, curve);
                }
            }
            let force = self.curve(&rows.force, j, all, width);
            let drive = self.curve(interface.drive_row(), j, all, width);
            let softness = (interface.law == Law::Contact || interface.soft.is_some()).then(|| {
                let gap = Curve::new(&self.reached.at, step.states[masses + j].clone(), errors[masses + j].clone(), width);
                let rate = self.curve(&rows.rate, j, all, width);
                let loaded = interface.mode == Mode::Closed;
                Softness { gap, rate, loaded, dissipated: interface.dissipated.clone() }
            });
            let closed = interface.mode == Mode::Closed && interface.law == Law::Contact;
            let [force, drive] = [force, drive].map(Signal::Curve);
            stages.push(Stage { from: from.clone(), force, drive, gap: None, closed, softness });
        }
        for (i, mass) in self.masses.iter().enumerate() {
            let curve = Curve::new(&self.reached.at, step.states[i].clone(), errors[i].clone(), width);
            for side in 0..2 {
                waves[mass.body][side].push_curve(&from, &self.reached.late, curve.clone());
            }
        }
        for (interface, stage) in self.interfaces.iter_mut().zip(stages) {
            let damping = interface.soft.as_ref().map(|soft| &soft.damping).filter(|damping| !is_exact_zero(*damping));
            if interface.mode == Mode::Closed
                && let (Some(damping), Some(softness)) = (damping, &stage.softness)
            {
                interface.dissipated = interface.dissipated.clone() + softness.rate.square_integral(width) * damping;
            }
            interface.is_fresh = false;
            interface.stages.push(stage);
        }
    }

    /// Takes over the states at the end of a step.
    fn take(&mut self, step: &Step<N>, errors: &[N], width: &N) {
        let dynamic = self.dynamic();
        let masses = self.masses.len();
        for (state, terms) in step.states.iter().enumerate() {
            let (found, radius) = value(terms, width).centred();
            match dynamic.iter().find(|(of, _)| *of == state) {
                Some((_, root)) => self.norm = self.norm.clone() + radius * root,
                None => self.interfaces[state - masses].gap_error = upper(errors[state].clone() + radius),
            }
            match self.masses.get_mut(state) {
                Some(mass) => mass.velocity = found,
                None => self.interfaces[state - masses].gap = found,
            }
        }
        if dynamic.is_empty() {
            self.norm = self.norm.zero();
        }
    }
}
