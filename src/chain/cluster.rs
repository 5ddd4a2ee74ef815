//! A cluster: neighbouring interfaces with the rigid masses between them, which act on each other without a delay.
//!
//! The states are the velocities of the masses and the gaps. While no contact changes, they solve a linear equation
//! with constant coefficients, `x′ = Mx + Bu`, for arriving signals `u` that are polynomials. The solution is a Taylor
//! polynomial on each step; the gap of a stiff spring, once it has decayed, follows the others at once.
//!
//! **Errors**: the distance of the stored states from the true ones is bounded in the norm of the energy, `Σ mV² + Σ k
//! gap²` over masses and loaded springs. An error of the arriving signals does work of at most `Z e²/4` per unit of
//! time, and dashpots take up energy, so that the norm grows by this and by the defect of the polynomials alone. A
//! state that decays is also bounded by the greater of its error before and that of all that acts on it.

use std::sync::Arc;

use super::curve::{Curve, Fall, Signal, first_fall, greater, upper, value};
use super::exact::ExactTime;
use super::interface::{Interface, Mode, Moment, Softness};
use super::law::Law;
use super::linear::Linear;
use super::node::{Gap, Occurrence, Source, Stage, Stop};
use super::norm::Since;
use super::onset::{Onset, Series};
use super::step::{Step, degree, in_unit, power};
use super::wave::{Wave, either};
use crate::motion::EventKind;
use crate::number::{Bounded, Open, Rational, is_exact_zero};

/// A rigid mass between two interfaces.
#[derive(Clone, Debug)]
pub(super) struct Mass<N> {
    /// Index of the body.
    pub(super) body: usize,
    /// The velocity at the time that is reached, an exact number.
    pub(super) velocity: N,
    /// Bound of the error of the velocity at the time that is reached.
    pub(super) error: N,
    /// Whether the velocity is exactly that of the start.
    pub(super) is_still: bool,
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
    pub(super) masses: Vec<Mass<N>>,
    pub(super) linear: Linear<N>,
    pub(super) reached: Moment<N>,
    pub(super) until: Moment<N>,
    /// Bound of the error of the states, in the norm of the energy.
    pub(super) norm: N,
    /// The bounds of the states that act back before a step, and those that they decay to or grow by.
    pub(super) fading: Vec<(N, N)>,
    /// All that the errors come from since the last change of a contact or decay, if the response of the states bounds
    /// them.
    pub(super) since: Option<Since<N>>,
    /// The natural speed of the chain.
    pub(super) speed: N,
    /// One rounding, relative to the number.
    pub(super) rounding: N,
    /// Degree of the polynomials.
    pub(super) degree: usize,
    /// The step before, as far as it was taken.
    pub(super) before: Option<Taken<N>>,
    /// Latest events of the interfaces.
    pub(super) latest: Vec<Option<Moment<N>>>,
    /// Number of significant jumps of each interface at the time that is reached, if their order is not known.
    pub(super) jumps: Vec<usize>,
    /// Bounds of the rates of the states between breaks at that time whose order is not known; empty if it is.
    pub(super) jolts: Vec<N>,
    /// Number of events without a step between them.
    repeated: usize,
    /// The first time of a decision that the bounds leave open.
    pub(super) doubt: Option<f64>,
}

/// Arriving signals, states and their errors over a step.
pub(super) type Solved<'a, N> = (&'a [[Curve<N>; 2]], &'a Step<N>, &'a [N]);

/// A step that was taken over a width.
#[derive(Clone, Debug)]
pub(super) struct Taken<N> {
    inputs: Vec<[Curve<N>; 2]>,
    pub(super) step: Step<N>,
    errors: Vec<N>,
    pub(super) width: N,
}

/// All that leaves an interface over a step, and its state.
struct Output<N> {
    force: Curve<N>,
    leaving: [Curve<N>; 2],
    softness: Option<Softness<N>>,
}

/// Changes of a contact that a step ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    Close,
    Release,
    Return,
}

/// Events at one time, beside two of each interface, after which a cluster is given up.
const MOST_REPEATED: usize = 16;

impl<N: Bounded> Mass<N> {
    pub(super) fn new(body: usize, velocity: N, inverse: N, root: N) -> Self {
        let (velocity, error) = velocity.centred();
        let is_still = is_exact_zero(&error);
        Mass { body, velocity, error, is_still, inverse, root }
    }
}

impl<N: Bounded> Cluster<N> {
    pub(super) fn new(
        first: usize,
        interfaces: Vec<Interface<N>>,
        masses: Vec<Mass<N>>,
        speed: f64,
        until: &N,
    ) -> Self {
        let zero = until.zero();
        let bits = until.bits().unwrap_or(64);
        let norm = masses.iter().fold(zero.clone(), |norm, mass| norm + mass.error.clone() * &mass.root);
        Cluster {
            first,
            latest: vec![None; interfaces.len()],
            jumps: vec![0; interfaces.len()],
            jolts: Vec::new(),
            interfaces,
            masses,
            linear: Linear::default(),
            reached: Moment {
                exact: Some(Arc::new(ExactTime::rational(Rational::default()))),
                ..Moment::new(zero.clone())
            },
            until: Moment::new(until.clone()),
            norm: upper(norm),
            fading: Vec::new(),
            since: None,
            speed: zero.double(speed),
            rounding: power(&zero.one().halved(), bits as usize),
            degree: degree(bits),
            before: None,
            repeated: 0,
            doubt: None,
        }
    }

    /// Lets the signals of the start arrive, and closes contacts that begin closed.
    pub(super) fn begin(&mut self, waves: &[[Wave<N>; 2]]) -> Result<Vec<(usize, Occurrence<N>)>, Stop> {
        let zero = self.norm.zero();
        for interface in &mut self.interfaces {
            for (side, input) in interface.sides.iter_mut().enumerate() {
                input.begin(waves, side);
            }
        }
        for j in 0..self.interfaces.len() {
            self.interfaces[j].drive = self.arriving(j, 1) - self.arriving(j, 0);
        }
        self.relate();
        for interface in self.interfaces.iter().filter(|interface| interface.is_sprung()) {
            if let Some(soft) = &interface.soft {
                self.norm = self.norm.clone() + interface.gap_error.clone() * &soft.root;
            }
        }
        let impacts = self.close_at_start()?;
        let occurrence = |(j, y): (usize, N)| {
            let kind = Some(EventKind::Impact);
            (self.first + j, Occurrence { kind, t: zero.clone(), drive: [y.clone(), y] })
        };
        Ok(impacts.into_iter().map(occurrence).collect())
    }

    /// Returns whether the cluster has gone on to its last time.
    pub(super) fn is_finished(&self) -> bool {
        self.reached.at.below(&self.until.at) != Ok(true)
    }

    /// Goes on to the next break, event, or end of a step. Signals are known up to `horizon`.
    pub(super) fn advance(
        &mut self,
        horizon: Option<Moment<N>>,
        waves: &mut [[Wave<N>; 2]],
    ) -> Result<Vec<(usize, Occurrence<N>)>, Stop> {
        self.look_up(waves);
        let mut occurrences = self.pass_breaks(waves);
        let mut end = self.end(horizon);
        let (width, late) = (end.at.clone() - &self.reached.at).centred();
        if width.positive() != Ok(true) {
            return Err(Stop::Open);
        }
        let origin = self.reached.at.clone();
        let inputs: Vec<[Curve<N>; 2]> = self.inputs(&origin, &width);
        let step = self.solve(&inputs, &width)?;
        let inputs = in_unit(&inputs, &step.unit);
        let is_short = step.width.below(&width) == Ok(true);
        let norm = self.norm.clone();
        let series = self.series(&inputs);
        let errors = self.step_errors(&inputs, &step);
        let solved = (&inputs[..], &step, &errors[..]);
        let outputs: Vec<Output<N>> = (0..self.interfaces.len()).map(|j| self.output(j, solved)).collect();
        let found = self.events(&outputs, solved, series.as_ref())?;
        let first = found.iter().map(|(_, _, at)| at.clone()).reduce(Moment::earlier);
        let (width, next) = match &first {
            Some(at) => {
                let (stored, rounding) = (origin.clone() + &at.at).centred();
                let exact = Some(Arc::new(ExactTime::named()));
                (at.at.clone(), Moment::beside(stored, at.late.clone() + rounding, exact))
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
        // An event at once is as late as the breaks that it follows.
        let late = if is_at_once { greater(next.late.clone(), self.reached.late.clone()) } else { next.late.clone() };
        let at = if is_exact_zero(&late) { width.clone() } else { width.clone().widened(&late) };
        let drives =
            |at: &N, solved| -> Vec<N> { (0..self.interfaces.len()).map(|j| self.drive(j, at, solved)).collect() };
        let drives_after = drives(&at, solved);
        let drives_before = match &self.before {
            Some(Taken { inputs, step, errors, width }) if is_at_once => {
                drives(&width.clone().widened(&late), (inputs, step, errors))
            }
            _ => self.interfaces.iter().map(|interface| interface.drive.clone()).collect(),
        };
        if is_at_once {
            self.repeated += 1;
            if self.repeated > MOST_REPEATED + 2 * self.interfaces.len() {
                return Err(Stop::Open);
            }
            self.norm = norm;
        } else {
            self.emit(outputs, solved, (&width, series.as_ref()), waves);
            self.take(&step, &errors, &width, series.as_ref());
            self.before = Some(Taken { inputs, step, errors, width });
            self.repeated = 0;
        }
        // An event that a break causes is at the time of the break; another is within the bounds of it only.
        let is_told = first.as_ref().is_some_and(|at| is_exact_zero(&at.at) && is_exact_zero(&at.late));
        if !is_at_once {
            self.reached = next;
        } else {
            if !is_told {
                self.reached.exact = next.exact;
            }
            if self.reached.late.below(&next.late) != Ok(false) {
                self.reached = Moment::beside(self.reached.at.clone(), late, self.reached.exact.clone());
            }
        }
        for (j, change, at) in found {
            if !first.as_ref().is_some_and(|first| at.meets(first)) {
                continue;
            }
            // A gap of zero within its error may close at a break, or just after it.
            let jump = drives_after[j].clone() - &drives_before[j];
            let jumps = jump.positive() == Ok(true) || jump.negative() == Ok(true);
            let interface = &self.interfaces[j];
            let lands = change == Change::Close && interface.mode == Mode::Open && !interface.touches;
            if is_at_once && jumps && lands && !is_exact_zero(&interface.gap_error) {
                self.doubts();
            }
            let kind = self.change(j, change, is_at_once);
            if let Some(kind) = kind {
                let [old, new] = [&drives_before, &drives_after].map(|drives| drives[j].clone());
                let before = match is_at_once {
                    true if is_told => old,
                    true => either([old, new].into_iter()).unwrap_or_else(|| self.norm.zero()),
                    false => new,
                };
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

    /// Notes that the bounds leave a decision open.
    pub(super) fn doubts(&mut self) {
        let at = self.reached.at.to_f64();
        self.doubt = Some(self.doubt.map_or(at, |earlier| earlier.min(at)));
    }

    /// Returns `y` of an interface after the time `at` in a step, which is known within its bound.
    fn drive(&self, j: usize, at: &N, (inputs, step, errors): Solved<'_, N>) -> N {
        let side = |side: usize| match &self.interfaces[j].sides[side].source {
            Source::Mass(mass) => value(&step.states[*mass], &(at.clone() / &step.unit)).widened(&errors[*mass]),
            _ => {
                let curve = &inputs[j][side];
                value(&curve.terms, &(at.clone() / &curve.unit)).widened(&curve.error)
            }
        };
        side(1) - side(0)
    }

    /// Returns all that leaves an interface over a step, and its state.
    fn output(&self, j: usize, solved: Solved<'_, N>) -> Output<N> {
        let interface = &self.interfaces[j];
        let rows = interface.rows();
        let is_wave = |side: usize| matches!(interface.sides[side].source, Source::Wave(_));
        let [below, above] = [0, 1].map(|side| if is_wave(side) { &rows.leaving[side] } else { interface.nothing() });
        let rate = if interface.has_gap() { &rows.rate } else { interface.nothing() };
        let [force, rate, below, above] = self.curves([&rows.force, rate, below, above], j, solved);
        let softness = interface.has_gap().then(|| Softness {
            gap: self.state_curve(self.masses.len() + j, solved),
            rate,
            loaded: interface.mode == Mode::Closed,
            dissipated: interface.dissipated.clone(),
        });
        Output { force, leaving: [below, above], softness }
    }

    /// Returns whether a single state acts back, and no signal arrives: it decays as `e⁻ᵏᵗ`, without a change of sign,
    /// and with it the force of a contact that is closed.
    fn is_free(&self, inputs: &[[Curve<N>; 2]]) -> bool {
        let is_mass = |j: usize, side: usize| matches!(self.interfaces[j].sides[side].source, Source::Mass(_));
        let is_silent = |j: usize| [0, 1].iter().all(|side| is_mass(j, *side) || inputs[j][*side].is_zero());
        self.linear.dynamic.len() == 1 && (0..self.interfaces.len()).all(is_silent)
    }

    /// Returns the changes of contacts within a step, each with its time since the beginning.
    fn events(
        &mut self,
        outputs: &[Output<N>],
        solved: Solved<'_, N>,
        series: Option<&Series<N>>,
    ) -> Result<Vec<(usize, Change, Moment<N>)>, Stop> {
        let (mut found, mut falls, step) = (Vec::new(), Vec::new(), solved.1);
        let is_free = self.is_free(solved.0);
        for (j, output) in outputs.iter().enumerate() {
            if self.interfaces[j].law != Law::Contact {
                continue;
            }
            let is_positive = (output.force.terms[0].clone() - &output.force.error).positive() == Ok(true);
            let interface = &mut self.interfaces[j];
            interface.holds = is_free && interface.mode == Mode::Closed && (interface.holds || is_positive);
            let interface = &self.interfaces[j];
            let Output { force, softness: Some(Softness { gap, .. }), .. } = output else { continue };
            let onset = series.filter(|_| interface.touches).map(|series| match interface.mode {
                Mode::Closed => series.onset(interface.closed_force(), j),
                _ => self.onset_of_gap(series, j),
            });
            let onset = onset.and_then(|onset| onset.ok().filter(|(_, doubt)| !doubt)).map(|(onset, _)| onset);
            // A function that is exactly zero and rises is watched once it has risen.
            let risen = |curve: &Curve<N>, rise: Option<N>| {
                let Some(width) = rise else { return Some((curve.clone(), self.norm.zero())) };
                let left = (step.width.clone() - &width).centred().0;
                let origin = (curve.origin.clone() + &width).centred().0;
                (left.positive() == Ok(true)).then(|| (curve.about(&origin, &left), width))
            };
            let rising = |curve: &Curve<N>| if onset == Some(Onset::Rise) { curve.rising_width() } else { None };
            let watched = match interface.mode {
                _ if onset == Some(Onset::Zero) || interface.holds => Vec::new(),
                Mode::Open if interface.is_fresh => {
                    // The force fell to zero, so that y rises from zero, and the gap with it.
                    let [drive] = self.curves([interface.drive_row()], j, solved);
                    risen(gap, drive.rising_width()).map(|rest| (Change::Close, rest)).into_iter().collect()
                }
                Mode::Open => match onset {
                    Some(Onset::Fall(order)) => {
                        falls.push((order, j));
                        Vec::new()
                    }
                    _ => risen(gap, rising(gap)).map(|rest| (Change::Close, rest)).into_iter().collect(),
                },
                Mode::Closed => risen(force, rising(force)).map(|rest| (Change::Release, rest)).into_iter().collect(),
                Mode::Released => {
                    let [pull] = self.curves([interface.closed_force()], j, solved);
                    let whole = |curve: Curve<N>| (curve.negated(), self.norm.zero());
                    vec![(Change::Return, whole(gap.clone())), (Change::Close, whole(pull))]
                }
            };
            let (mut ends_at_zero, before) = (None, found.len());
            for (change, (curve, skipped)) in watched {
                let (fall, doubt) = first_fall(&curve).map_err(|Open| Stop::Open)?;
                if doubt {
                    self.doubts();
                }
                match fall {
                    Fall::After(at) => found.push((j, change, Moment::new(at + &skipped))),
                    Fall::AtEnd => ends_at_zero = Some(change),
                    Fall::None => {}
                }
            }
            // Only the change whose function was zero within its bound at the end of the last step settles that zero.
            let graze = std::mem::replace(&mut self.interfaces[j].grazes, ends_at_zero);
            let settles = |found: &(usize, Change, Moment<N>)| Some(found.1) == graze && is_exact_zero(&found.2.at);
            if graze.is_some() && !found[before..].iter().any(settles) {
                self.doubts();
            }
        }
        // Of contacts that close at once, the first pushes the others.
        let least = falls.iter().map(|(order, _)| *order).min();
        let first = falls.into_iter().filter(|(order, _)| Some(*order) == least);
        found.extend(first.map(|(_, j)| (j, Change::Close, Moment::new(self.norm.zero()))));
        Ok(found)
    }

    /// Changes the state of a contact; returns the event.
    fn change(&mut self, j: usize, change: Change, at_once: bool) -> Option<EventKind> {
        let zero = self.norm.zero();
        if at_once && self.jumps[j] > 1 {
            self.doubts();
        }
        self.latest[j] = Some(self.reached.clone());
        let was_sprung = self.interfaces[j].is_sprung();
        let interface = &mut self.interfaces[j];
        let rest = interface.gap.magnitude();
        interface.touches = change == Change::Close && interface.mode == Mode::Open;
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
        }
        self.relate();
        kind
    }

    /// Sends out the signals of a step, and records its states.
    fn emit(
        &mut self,
        outputs: Vec<Output<N>>,
        solved: Solved<'_, N>,
        (width, series): (&N, Option<&Series<N>>),
        waves: &mut [[Wave<N>; 2]],
    ) {
        let Moment { time: from, late, .. } = self.reached.clone();
        let cut = |curve: Curve<N>| Curve { width: width.clone(), ..curve };
        for (i, mass) in self.masses.iter().enumerate() {
            let curve = cut(self.state_curve(i, solved));
            for wave in &mut waves[mass.body] {
                wave.push_curve(&self.reached, curve.clone(), None);
            }
        }
        for (j, (interface, output)) in self.interfaces.iter_mut().zip(outputs).enumerate() {
            let Output { force, leaving, mut softness } = output;
            for (side, curve) in leaving.into_iter().enumerate() {
                if let Source::Wave(body) = &interface.sides[side].source {
                    let taylor = series.and_then(|series| series.taylor(&interface.rows().leaving[side], j));
                    waves[*body][1 - side].push_curve(&self.reached, cut(curve), taylor);
                }
            }
            if let (Some(soft), Some(softness)) = (&interface.soft, &mut softness)
                && interface.mode == Mode::Closed
                && !is_exact_zero(&soft.damping)
            {
                // Where the power jumps, it does so within `late` of the stored time.
                if !is_exact_zero(&late) {
                    let within = from.clone().widened(&late);
                    let power = |rate: &Curve<N>| rate.value_at(&within).square() * &soft.damping;
                    let before = interface.stages.last().and_then(Stage::softness).filter(|before| before.loaded);
                    let jump = power(&softness.rate) - before.map_or(late.zero(), |before| power(&before.rate));
                    softness.dissipated = softness.dissipated.clone().widened(&(jump.magnitude() * &late));
                }
                interface.dissipated = softness.rate.square_integral(width) * &soft.damping + &softness.dissipated;
            }
            let closed = interface.mode == Mode::Closed && interface.law == Law::Contact;
            let gap = softness.map_or(Gap::Zero, |softness| Gap::Soft(Box::new(softness)));
            interface.is_fresh = false;
            interface.sides.iter_mut().for_each(|side| side.taylor = None);
            let force = Signal::Curve(Box::new(cut(force)));
            interface.stages.push(Stage { from: from.clone(), force, gap, closed });
        }
    }

    /// Takes over the states at the end of a step.
    fn take(&mut self, step: &Step<N>, errors: &[N], width: &N, series: Option<&Series<N>>) {
        self.fade(width, (errors, step));
        let masses = self.masses.len();
        let is_constant = |state: usize| series.is_some_and(|series| series.is_constant(state));
        for (state, terms) in step.states.iter().enumerate() {
            let (found, radius) = value(terms, &(width.clone() / &step.unit)).centred();
            if self.linear.root(state).is_none() {
                *self.error_mut(state) = errors[state].clone();
            }
            self.add_error(state, radius);
            if let Some(interface) = state.checked_sub(masses).map(|j| &mut self.interfaces[j]) {
                let has_closed = interface.law == Law::Contact && interface.mode == Mode::Closed;
                interface.touches = interface.touches && !has_closed && is_constant(state);
            }
            match self.masses.get_mut(state) {
                Some(mass) => (mass.velocity, mass.is_still) = (found, mass.is_still && is_constant(state)),
                None => self.interfaces[state - masses].gap = found,
            }
        }
        if self.linear.dynamic.is_empty() {
            self.norm = self.norm.zero();
        }
    }
}
