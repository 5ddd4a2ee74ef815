//! An interface of a chain with springs, dashpots or masses: the signals that arrive at it, and its linear law.

use std::sync::Arc;

use super::cluster::Change;
use super::curve::{Curve, Signal, upper};
use super::exact::{Exact, exact_sum};
use super::law::{Law, Mix};
use super::node::{Gap, Source, Stage};
use super::onset::Taylor;
use super::wave::Wave;
use crate::lattice::Line;
use crate::number::{Bounded, is_exact_zero};

/// A spring with a dashpot beside it, in the numbers of a run.
#[derive(Clone, Debug)]
pub(super) struct Soft<N> {
    pub(super) stiffness: N,
    /// The root of the stiffness.
    pub(super) root: N,
    pub(super) damping: N,
}

/// A time, and a stored value with a bound of its distance from the true time.
#[derive(Clone, Debug)]
pub(super) struct Moment<N> {
    pub(super) time: N,
    pub(super) at: N,
    pub(super) late: N,
    pub(super) exact: Exact,
}

impl<N: Bounded> Moment<N> {
    pub(super) fn new(time: N) -> Self {
        let (at, late) = time.centred();
        Moment { time, at, late, exact: None }
    }

    /// Returns the time within `late` of a stored one.
    pub(super) fn beside(at: N, late: N, exact: Exact) -> Self {
        let late = upper(late);
        let time = if is_exact_zero(&late) { at.clone() } else { at.clone().widened(&late) };
        Moment { time, at, late, exact }
    }

    /// Returns the moment with the earlier stored value; of equal ones, this one.
    pub(super) fn earlier(self, other: Self) -> Self {
        if other.at.below(&self.at) == Ok(true) { other } else { self }
    }

    /// Returns whether both times agree within their bounds.
    pub(super) fn meets(&self, other: &Self) -> bool {
        let apart = (self.at.clone() - &other.at).magnitude();
        (apart - &self.late - &other.late).positive() != Ok(true)
    }

    /// Returns whether both times are known to be one.
    pub(super) fn is(&self, other: &Self) -> bool {
        self.exact.is_some() && self.exact == other.exact
    }
}

/// A factor of a linear law. Factors of zero and one cost no rounding.
#[derive(Clone, Debug)]
enum Factor<N> {
    Zero,
    Plus,
    Minus,
    Times(N),
}

impl<N: Bounded> Factor<N> {
    fn new(x: N) -> Self {
        let one = x.one();
        match () {
            () if is_exact_zero(&x) => Factor::Zero,
            () if is_exact_zero(&(x.clone() - &one)) => Factor::Plus,
            () if is_exact_zero(&(x.clone() + &one)) => Factor::Minus,
            () => Factor::Times(x),
        }
    }

    fn of(&self, x: &N) -> Option<N> {
        match self {
            Factor::Zero => None,
            Factor::Plus => Some(x.clone()),
            Factor::Minus => Some(-x.clone()),
            Factor::Times(by) => Some(x.clone() * by),
        }
        .filter(|product| !is_exact_zero(product))
    }

    fn magnitude(&self) -> Self {
        match self {
            Factor::Times(by) => Factor::Times(by.magnitude()),
            Factor::Minus => Factor::Plus,
            other => other.clone(),
        }
    }
}

/// A linear form in the signal from below, that from above, and the gap.
#[derive(Clone, Debug)]
pub(super) struct Row<N> {
    factors: [Factor<N>; 3],
    /// Magnitudes of the factors.
    sizes: [Factor<N>; 3],
    /// Whether the first two factors are opposite, so that equal signals from both sides count for nothing.
    is_difference: bool,
}

impl<N: Bounded> Row<N> {
    fn new(factors: [N; 3]) -> Self {
        let factors = factors.map(Factor::new);
        Row { sizes: factors.each_ref().map(Factor::magnitude), factors, is_difference: false }
    }

    /// Returns the form `a (below − above) + b gap`.
    fn of_difference(a: N, b: N) -> Self {
        Row { is_difference: true, ..Row::new([a.clone(), -a, b]) }
    }

    /// Returns whether the form is zero for all values that count.
    pub(super) fn is_zero(&self, counts: [bool; 3]) -> bool {
        self.factors.iter().zip(counts).all(|(factor, counts)| !counts || matches!(factor, Factor::Zero))
    }

    /// Returns the only value that counts, by its index, and whether it counts as its negative; `None` where several
    /// count, or a factor changes their size.
    pub(super) fn only(&self, counts: [bool; 3]) -> Option<(usize, bool)> {
        let is_left = |(k, factor): &(usize, &Factor<N>)| counts[*k] && !matches!(factor, Factor::Zero);
        let mut left = self.factors.iter().enumerate().filter(is_left);
        match (left.next()?, left.next()) {
            ((k, Factor::Plus), None) => Some((k, false)),
            ((k, Factor::Minus), None) => Some((k, true)),
            _ => None,
        }
    }

    /// Returns the value of the form.
    pub(super) fn of(&self, values: [&N; 3]) -> N {
        let [below, above, gap] = values;
        if !self.is_difference || is_exact_zero(below) || is_exact_zero(above) {
            return weighted(&self.factors, values);
        }
        let (apart, none) = (below.clone() - above, gap.zero());
        weighted(&self.factors, [&apart, &none, gap])
    }

    /// Returns a bound of the form for bounds of its values.
    pub(super) fn bound_of(&self, values: [&N; 3]) -> N {
        weighted(&self.sizes, values)
    }
}

fn weighted<N: Bounded>(factors: &[Factor<N>; 3], values: [&N; 3]) -> N {
    let mut sum: Option<N> = None;
    for (factor, value) in factors.iter().zip(values) {
        if let Some(product) = factor.of(value) {
            sum = Some(match sum {
                Some(sum) => sum + product,
                None => product,
            });
        }
    }
    sum.unwrap_or_else(|| values[0].zero())
}

/// The linear laws of an interface that is open, or closed.
#[derive(Clone, Debug)]
pub(super) struct Rows<N> {
    /// The compressive force.
    pub(super) force: Row<N>,
    /// The rate of the gap.
    pub(super) rate: Row<N>,
    /// The signals that leave downward and upward.
    pub(super) leaving: [Row<N>; 2],
}

impl<N: Bounded> Rows<N> {
    /// Returns the laws without a force.
    pub(super) fn open(zero: &N) -> Self {
        let (z, one) = (|| zero.zero(), || zero.one());
        Rows {
            force: Row::new([z(), z(), z()]),
            rate: Row::of_difference(-one(), z()),
            leaving: [Row::new([one(), z(), z()]), Row::new([z(), one(), z()])],
        }
    }

    /// Returns the laws of a closed or bonded interface.
    ///
    /// **Source**: with a spring, `f = −(k gap + d gap′)` and `gap′ = A₊ − A₋ + Yf`.
    pub(super) fn closed((law, outer): (Law, usize), mix: &Mix<N>, soft: Option<&Soft<N>>) -> Self {
        let zero = mix.conductance.zero();
        let (z, one) = (|| zero.zero(), || zero.one());
        let [twice_below, twice_above] = &mix.twice;
        if let Some(Soft { stiffness, damping, .. }) = soft {
            let compliance = (twice_below.clone() + twice_above).halved();
            let denominator = damping.clone() * &compliance + one();
            let [d, k, share] = [damping.clone(), stiffness.clone(), one()].map(|x| x / &denominator);
            return Rows {
                force: Row::of_difference(d.clone(), -k.clone()),
                rate: Row::of_difference(-share, -(k.clone() * &compliance)),
                leaving: [
                    Row::new([one() - d.clone() * twice_below, d.clone() * twice_below, k.clone() * twice_below]),
                    Row::new([d.clone() * twice_above, one() - d * twice_above, -(k * twice_above)]),
                ],
            };
        }
        if law == Law::Force {
            // The force arrives from the outer side.
            let force = if outer == 0 { [-one(), z(), z()] } else { [z(), -one(), z()] };
            let below = [one(), twice_below.clone(), z()];
            let above = [-twice_above.clone(), one(), z()];
            let rate = Row::new([z(), z(), z()]);
            return Rows { force: Row::new(force), rate, leaving: [Row::new(below), Row::new(above)] };
        }
        let [past_below, past_above] = &mix.passed;
        let reflection = &mix.reflection;
        Rows {
            force: Row::of_difference(mix.conductance.clone(), z()),
            rate: Row::new([z(), z(), z()]),
            leaving: [
                Row::new([reflection.clone(), past_below.clone(), z()]),
                Row::new([past_above.clone(), -reflection.clone(), z()]),
            ],
        }
    }
}

/// The state of an interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// A contact without a force, at a gap.
    Open,
    /// A closed contact, or an interface that is never open.
    Closed,
    /// A contact whose dashpot no longer pushes, at a depth.
    Released,
}

/// The signal that arrives at one side of an interface.
#[derive(Clone, Debug)]
pub(super) struct Input<N> {
    pub(super) source: Source<N>,
    pub(super) delay: Option<N>,
    /// Exact form of the delay.
    exact_delay: Exact,
    cursor: usize,
    pub(super) signal: Signal<N>,
    /// The Taylor series at the time that is reached, if the signal has just left zero.
    pub(super) taylor: Option<Arc<Taylor<N>>>,
    /// Arrival of the next piece, as far as it is known.
    pub(super) next: Option<Moment<N>>,
}

impl<N: Bounded> Input<N> {
    pub(super) fn new(source: Source<N>, (delay, exact_delay): (Option<N>, Exact), zero: &N) -> Self {
        let signal = Signal::Line(Line { intercept: zero.zero(), slope: zero.zero() });
        Input { source, delay, exact_delay, cursor: 0, signal, taylor: None, next: None }
    }

    /// Receives the first piece.
    pub(super) fn begin(&mut self, waves: &[[Wave<N>; 2]], side: usize) {
        if let Some(signal) = self.source.piece(self.delay.as_ref(), 0, waves, side) {
            self.signal = signal;
        }
    }

    /// Looks up the arrival of the next piece, if it has left its origin.
    pub(super) fn look_up(&mut self, waves: &[[Wave<N>; 2]], side: usize) {
        if self.next.is_none() {
            let piece = self.cursor + 1;
            let next = self.source.beginning(self.delay.as_ref(), piece, waves, side);
            let exact = || self.source.exact_beginning(&self.exact_delay, piece, waves, side);
            self.next = next.map(|time| Moment { exact: exact(), ..Moment::new(time) });
        }
    }

    /// Returns the arrival of what leaves the origin of the signal at a time; its bound is left to the break there.
    pub(super) fn after(&self, Moment { time, exact, .. }: &Moment<N>) -> Option<Moment<N>> {
        let time = time.clone() + self.delay.as_ref()?;
        Some(Moment { late: time.zero(), exact: exact_sum(exact, &self.exact_delay), ..Moment::new(time) })
    }

    /// Passes on to the next piece.
    pub(super) fn advance(&mut self, waves: &[[Wave<N>; 2]], side: usize) {
        self.cursor += 1;
        if let Some(signal) = self.source.piece(self.delay.as_ref(), self.cursor, waves, side) {
            self.signal = signal;
            self.taylor = self.source.taylor(self.cursor, waves, side);
        }
        self.next = None;
        self.look_up(waves, side);
    }
}

/// An interface between two bodies, or at an end of the chain.
#[derive(Clone, Debug)]
pub(super) struct Interface<N> {
    pub(super) law: Law,
    pub(super) soft: Option<Soft<N>>,
    pub(super) sides: [Input<N>; 2],
    /// Impedances of the sides; zero for a ground or a mass.
    pub(super) impedances: [N; 2],
    open: Rows<N>,
    closed: Rows<N>,
    pub(super) mode: Mode,
    /// The gap at the time that is reached, an exact number, and the bound of its error where it is no part of the
    /// norm.
    pub(super) gap: N,
    /// Whether the force of the closed contact is positive, and goes on to decay without a sign of its own: no signal
    /// arrives.
    pub(super) holds: bool,
    pub(super) gap_error: N,
    /// Whether the contact has just opened at a gap of zero, from a force that fell to zero.
    pub(super) is_fresh: bool,
    /// Whether the gap is exactly zero: it has been since the start, or the contact has just closed.
    pub(super) touches: bool,
    /// The change whose function was zero within its bound at the end of the step before.
    pub(super) grazes: Option<Change>,
    /// Energy that the dashpot has taken up.
    pub(super) dissipated: N,
    /// `y` just before the time that is reached.
    pub(super) drive: N,
    pub(super) stages: Vec<Stage<N>>,
}

impl<N: Bounded> Interface<N> {
    pub(super) fn new(
        (law, soft): (Law, Option<Soft<N>>),
        (sides, impedances): ([Input<N>; 2], [Option<N>; 2]),
        (mix, outer): (&Mix<N>, usize),
        gap: &N,
    ) -> Self {
        let zero = gap.zero();
        let mode = if law == Law::Contact { Mode::Open } else { Mode::Closed };
        let (gap, gap_error) = gap.centred();
        let has_gap = law == Law::Contact || soft.is_some();
        let touches = has_gap && is_exact_zero(&gap) && is_exact_zero(&gap_error);
        Interface {
            open: Rows::open(&zero),
            closed: Rows::closed((law, outer), mix, soft.as_ref()),
            impedances: impedances.map(|z| z.unwrap_or_else(|| zero.zero())),
            law,
            soft,
            sides,
            mode,
            gap,
            holds: false,
            gap_error,
            is_fresh: false,
            touches,
            grazes: None,
            dissipated: zero.zero(),
            drive: zero,
            stages: Vec::new(),
        }
    }

    /// Returns the laws in the present state.
    pub(super) fn rows(&self) -> &Rows<N> {
        if self.mode == Mode::Closed { &self.closed } else { &self.open }
    }

    /// Returns a form that is zero.
    pub(super) fn nothing(&self) -> &Row<N> {
        &self.open.force
    }

    /// Returns whether the gap is a number of the answers: that of a contact or a spring.
    pub(super) fn has_gap(&self) -> bool {
        self.law == Law::Contact || self.soft.is_some()
    }

    /// Returns the rate of the gap between free ends.
    pub(super) fn drive_row(&self) -> &Row<N> {
        &self.open.rate
    }

    /// Returns the force of the closed interface.
    pub(super) fn closed_force(&self) -> &Row<N> {
        &self.closed.force
    }

    /// Returns whether the gap acts back on the motion: a spring is under load.
    pub(super) fn is_sprung(&self) -> bool {
        self.mode == Mode::Closed && self.soft.as_ref().is_some_and(|soft| !is_exact_zero(&soft.stiffness))
    }
}

impl<N> Stage<N> {
    /// Returns the gap of a chain with springs, dashpots or masses.
    pub(super) fn softness(&self) -> Option<&Softness<N>> {
        match &self.gap {
            Gap::Soft(softness) => Some(softness),
            _ => None,
        }
    }
}

/// The gap of an interface over a stretch of time.
#[derive(Clone, Debug)]
pub(super) struct Softness<N> {
    /// The gap.
    pub(super) gap: Curve<N>,
    /// The rate of the gap.
    pub(super) rate: Curve<N>,
    /// Whether the spring is loaded, or the contact closed.
    pub(super) loaded: bool,
    /// Energy that the dashpot has taken up before.
    pub(super) dissipated: N,
}
