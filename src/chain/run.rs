//! A finished run of a chain: events, contacts, forces and gaps.

use super::curve::Signal;
use super::definition::SOFT;
use super::interface::Soft;
use super::node::{Gap, Stage};
use super::peak::highest;
use super::start::Bar;
use super::sums::KeptSums;
use super::wave::{Limit, Wave, either, indices_at, left, may_jump, smooth_value};
use crate::error::Error;
use crate::motion::{Ending, EventKind, Side, maps};
use crate::number::{Bounded, Open, is_exact_zero};

/// An impact or a release at a node of a chain.
#[derive(Clone, Debug)]
pub struct ChainEvent<N> {
    /// Impact or release.
    pub kind: EventKind,
    /// The node: 0 at the bottom, `n` above the n-th body.
    pub node: usize,
    /// The time.
    pub t: N,
    /// Rate of the gap that free ends would have just before.
    pub before: N,
    /// The same rate just after.
    pub after: N,
}

/// A gap that reaches zero without a contact.
#[derive(Clone, Debug)]
pub struct Touch<N> {
    /// The node: 0 at the bottom, `n` above the n-th body.
    pub node: usize,
    /// The time.
    pub t: N,
    /// Rate of the gap that free ends would have just before.
    pub before: N,
    /// The same rate just after.
    pub after: N,
}

/// A period of contact at a node of a chain.
#[derive(Clone, Debug)]
pub struct ChainContact<N> {
    /// The node: 0 at the bottom, `n` above the n-th body.
    pub node: usize,
    /// Its beginning.
    pub impact: N,
    /// Its end; `None` if the run ends before.
    pub release: Option<N>,
    /// Integral of the force over the contact.
    pub impulse: N,
    /// Greatest force.
    pub peak: N,
    /// The first time of the greatest force. Where the force agrees with its greatest value over some time within its
    /// bound, as on a plateau, the bound of this time covers all of it.
    pub peak_time: N,
}

/// A stretch of time on which the force of a node is linear, or has one Chebyshev series.
#[derive(Clone, Debug)]
pub struct ForcePiece<N> {
    /// Its beginning.
    pub start: N,
    /// Its end.
    pub end: N,
    /// Compressive force just after the beginning.
    pub first: N,
    /// Compressive force just before the end.
    pub last: N,
    /// Chebyshev coefficients of the force from the start to the end, the first one whole and with the bound of the
    /// whole; empty where the force is linear.
    pub series: Vec<N>,
}

maps!(pub ChainEvent { t, before, after } keeps kind, node);
maps!(pub Touch { t, before, after } keeps node);
maps!(pub ChainContact { impact, impulse, peak, peak_time } maps release keeps node);

impl<N> ChainEvent<N> {
    /// Returns the time, and the rates of the gap before and after it.
    pub fn numbers(&self) -> [&N; 3] {
        [&self.t, &self.before, &self.after]
    }
}

impl<N> ChainContact<N> {
    /// Returns whether impulse and peak are known in a run that ends like this: the contact ends, or it lasts to the
    /// time asked for.
    pub fn is_settled(&self, ending: &Ending) -> bool {
        self.release.is_some() || *ending == Ending::Time
    }

    /// Returns impact, release, impulse and greatest force, as far as a run that ends like this knows them.
    pub fn numbers(&self, ending: &Ending) -> [Option<&N>; 4] {
        let is_settled = self.is_settled(ending);
        let settled = |number| Some(number).filter(|_| is_settled);
        [Some(&self.impact), self.release.as_ref(), settled(&self.impulse), settled(&self.peak)]
    }
}

impl<N> ForcePiece<N> {
    /// Converts the piece to other numbers.
    pub fn map<T>(self, f: impl Fn(N) -> T) -> ForcePiece<T> {
        let ForcePiece { start, end, first, last, series } = self;
        let series = series.into_iter().map(&f).collect();
        ForcePiece { start: f(start), end: f(end), first: f(first), last: f(last), series }
    }
}

/// A finished run of a [`Chain`](super::Chain) in one number system.
///
/// **Accuracy**: *exact* in fractions, *enclosure* in intervals; otherwise *within the bound* that each number carries.
#[derive(Clone, Debug)]
pub struct ChainRun<N> {
    pub(super) bars: Vec<Bar<N>>,
    pub(super) nodes: Vec<Vec<Stage<N>>>,
    /// The springs of the nodes.
    pub(super) springs: Vec<Option<Soft<N>>>,
    pub(super) waves: Vec<[Wave<N>; 2]>,
    pub(super) gravity: N,
    /// The velocity at the start of the frame that falls with `g`, in which the waves are.
    pub(super) frame: N,
    pub(super) end: N,
    pub(super) ending: Ending,
    pub(super) events: Vec<ChainEvent<N>>,
    pub(super) touches: Vec<Touch<N>>,
    pub(super) doubt: Option<f64>,
    pub(super) kept: KeptSums<N>,
}

impl<N: Bounded> ChainRun<N> {
    /// Returns the impacts and releases, in the order of time.
    pub fn events(&self) -> &[ChainEvent<N>] {
        &self.events
    }

    /// Returns the gaps that reach zero without a contact, in the order of time.
    pub fn touches(&self) -> &[Touch<N>] {
        &self.touches
    }

    /// Returns the last time.
    pub fn end(&self) -> &N {
        &self.end
    }

    /// Returns the reason of the end.
    pub fn ending(&self) -> &Ending {
        &self.ending
    }

    /// Returns the first time at which events that agree within their bounds count as one; `None` if there is none.
    pub fn undetermined_from(&self) -> Option<f64> {
        self.doubt
    }

    /// Returns the velocity of the frame of the waves, downward, and twice the distance that it has gone.
    pub(super) fn fallen(&self, time: &N) -> [N; 2] {
        let fall = self.gravity.clone() * time;
        let twice = fall.clone() * time;
        if is_exact_zero(&self.frame) {
            return [fall, twice];
        }
        [fall - &self.frame, twice - self.frame.clone().doubled() * time]
    }

    /// Returns the number of wave pieces that left the nodes after the start.
    pub fn pieces(&self) -> usize {
        left(&self.waves)
    }

    /// Returns the contacts, in the order of their impacts.
    pub fn contacts(&self) -> Vec<ChainContact<N>> {
        let impacts = self.events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Impact);
        impacts.map(|(k, impact)| self.contact(k, impact)).collect()
    }

    fn contact(&self, k: usize, impact: &ChainEvent<N>) -> ChainContact<N> {
        let node = impact.node;
        let release = self.events[k + 1..].iter().find(|event| event.node == node).map(|event| event.t.clone());
        let stages = &self.nodes[node];
        let first = stages.partition_point(|stage| stage.from.to_f64() < impact.t.to_f64());
        let first =
            (first.saturating_sub(2)..stages.len()).find(|k| stages[*k].closed && stages[*k].from.alike(&impact.t));
        let later = first.map_or(&[][..], |first| &stages[first..]);
        let ends = later.iter().skip(1).map(|next| &next.from).chain([&self.end]);
        let closed = later.iter().zip(ends).take_while(|(stage, _)| stage.closed);
        // A break at the end of the run does not count.
        let is_counted =
            |(k, (stage, to)): &(usize, (&Stage<N>, &N))| *k == 0 || *k + 1 < later.len() || !stage.from.same(to);
        let closed: Vec<(&Stage<N>, &N)> = closed.enumerate().filter(is_counted).map(|(_, stage)| stage).collect();
        let least = self.least_peak(&closed);
        let (mut impulse, mut peak, mut peak_time) = (self.end.zero(), None::<N>, impact.t.clone());
        for (stage, to) in closed {
            let force = &stage.force;
            impulse = impulse + force.integral(&stage.from, to);
            // An uncertain end of the stage moves the area of the force that ends there.
            for at in [&stage.from, to] {
                impulse = match (force, at.deviation()) {
                    (Signal::Line(line), Some(late)) => impulse + late * line.value_at_stored(at),
                    (Signal::Line(_), None) => impulse,
                    (Signal::Curve(curve), _) => {
                        let (stored, late) = at.centred();
                        impulse.widened(&(curve.value_at(&stored).magnitude() * late))
                    }
                };
            }
            // The force of a spring alone has the slope −k gap′.
            let spring = self.springs[node].as_ref().filter(|soft| is_exact_zero(&soft.damping));
            let slope = spring.and_then(|soft| Some((stage.softness()?.rate.negated(), &soft.stiffness)));
            if least.as_ref().is_some_and(|least| force.stays_below(least, &stage.from, to)) {
                continue;
            }
            let found = force.greatest(&stage.from, to, slope.as_ref().map(|(curve, factor)| (curve, *factor)));
            let (value, at) = match peak {
                Some(peak) if stage.softness().is_some() => highest((peak, peak_time), found),
                Some(peak) if peak.below(&found.0) != Ok(true) => (peak, peak_time),
                _ => found,
            };
            (peak, peak_time) = (Some(value), at);
        }
        let peak = peak.unwrap_or_else(|| self.end.zero());
        ChainContact { node, impact: impact.t.clone(), release, impulse, peak, peak_time }
    }

    /// Returns a number that the greatest force over stages, each with its end, exceeds or equals; `None` for a single
    /// stage.
    fn least_peak(&self, stages: &[(&Stage<N>, &N)]) -> Option<N> {
        let least = |force: N| {
            let (stored, error) = force.centred();
            (stored - error.doubled()).centred().0
        };
        let last = stages.iter().map(|(stage, to)| least(stage.force.value_at(to)));
        let greatest = last.reduce(|a, b| if a.below(&b) == Ok(true) { b } else { a });
        greatest.filter(|_| SOFT && stages.len() > 1)
    }

    /// Returns the stages of a node, each with its end.
    fn ended_stages(&self, node: usize) -> impl Iterator<Item = (&Stage<N>, &N)> {
        let stages = &self.nodes[node];
        let ends = stages.iter().skip(1).map(|next| &next.from).chain([&self.end]);
        stages.iter().zip(ends)
    }

    /// Returns whether the force of a node is zero from one time to another.
    pub(super) fn is_unloaded(&self, node: usize, from: &N, to: &N) -> bool {
        let is_within =
            |(stage, end): &(&Stage<N>, &N)| stage.from.below(to) != Ok(false) && from.below(end) != Ok(false);
        self.ended_stages(node).filter(is_within).all(|(stage, _)| match &stage.force {
            Signal::Line(line) => is_exact_zero(&line.intercept) && is_exact_zero(&line.slope),
            Signal::Curve(curve) => curve.terms.iter().chain([&curve.error]).all(is_exact_zero),
        })
    }

    /// Returns whether the force of a node has pieces that are no lines.
    pub(super) fn is_curved(&self, node: usize) -> bool {
        self.nodes[node].iter().any(|stage| matches!(stage.force, Signal::Curve(_)))
    }

    /// Returns the pieces of the compressive force of a node, in order and without a gap.
    pub fn force_pieces(&self, node: usize) -> Vec<ForcePiece<N>> {
        let mut pieces: Vec<(&Signal<N>, ForcePiece<N>)> = Vec::new();
        for (stage, end) in self.ended_stages(node) {
            let [first, last] = [&stage.from, end].map(|t| stage.force.value_at(t));
            let series = match &stage.force {
                Signal::Curve(curve) if SOFT => curve.chebyshev(&stage.from, end),
                _ => Vec::new(),
            };
            let is_flight =
                |first: &N, last: &N, series: &[N]| series.is_empty() && is_exact_zero(first) && is_exact_zero(last);
            if let Some((before, piece)) = pieces.last_mut() {
                let continues = match (before, &stage.force) {
                    (Signal::Line(before), Signal::Line(line)) => before.same(line),
                    _ => is_flight(&first, &last, &series) && is_flight(&piece.first, &piece.last, &piece.series),
                };
                if continues {
                    (piece.end, piece.last) = (end.clone(), last);
                    continue;
                }
            }
            pieces
                .push((&stage.force, ForcePiece { start: stage.from.clone(), end: end.clone(), first, last, series }));
        }
        // A break at the end of the run begins no piece.
        if pieces.len() > 1 {
            pieces.pop_if(|(_, piece)| piece.start.same(&piece.end));
        }
        pieces.into_iter().map(|(_, piece)| piece).collect()
    }

    /// Returns a bound of the magnitude of the force of a node.
    pub(super) fn greatest_force(&self, node: usize) -> N {
        self.ended_stages(node).fold(self.end.zero(), |most, (stage, end)| match &stage.force {
            Signal::Curve(curve) => most.larger(curve.most()),
            Signal::Line(line) => {
                [&stage.from, end].into_iter().fold(most, |most, t| most.larger(line.value_at(t).magnitude()))
            }
        })
    }

    /// Returns the compressive force of a node.
    ///
    /// **Errors**: [`Error::TimeOutside`]; [`Error::Open`] if the time is not told from that of a break.
    pub fn force(&self, node: usize, time: &N, side: Side) -> Result<N, Error> {
        let stages = self.stages(node, time, Limit::at(side))?;
        Ok(smooth_value(stages.iter().map(|stage| (&stage.from, &stage.force)), time)?)
    }

    /// Returns [`ChainRun::force`], with a bound that covers both limits where the time is not told from a jump.
    pub(super) fn force_within(&self, node: usize, time: &N, limit: Limit) -> Result<N, Error> {
        either(self.stages(node, time, limit)?.iter().map(|stage| stage.force.value_at(time))).ok_or(Error::Open(Open))
    }

    /// Returns the gap of a contact; zero where the node is none.
    ///
    /// **Errors**: [`Error::TimeOutside`].
    pub fn gap(&self, node: usize, time: &N) -> Result<N, Error> {
        let gap = |stage: &Stage<N>| match &stage.gap {
            Gap::Zero => time.zero(),
            Gap::Open { at, drive } => {
                let from = stage.from.clone().nominal();
                let middle = (from.clone() + time).halved();
                drive.value_at(&middle) * (time.clone() - from) + at
            }
            Gap::Soft(softness) => softness.gap.value_at(time),
        };
        either(self.stages(node, time, Limit::at(Side::Right))?.iter().map(gap)).ok_or(Error::Open(Open))
    }

    /// Returns the energy that the spring of a node holds, and the energy that its dashpot has taken up: where a spring
    /// is let go at a depth, or closes again at one, the limit from `side`.
    ///
    /// **Errors**: [`Error::TimeOutside`].
    pub fn spring_energies(&self, node: usize, time: &N, side: Side) -> Result<[N; 2], Error> {
        self.spring_energies_within(node, time, Limit::at(side))
    }

    pub(super) fn spring_energies_within(&self, node: usize, time: &N, limit: Limit) -> Result<[N; 2], Error> {
        let energies = |stage: &Stage<N>| {
            let (Some(softness), Some(soft)) = (stage.softness(), &self.springs[node]) else {
                return [time.zero(), time.zero()];
            };
            if !softness.loaded {
                return [time.zero(), softness.dissipated.clone()];
            }
            let stored = softness.gap.value_at(time).square() * &soft.stiffness;
            let since = time.clone() - &softness.rate.origin;
            let lost = softness.rate.square_integral(&since) * &soft.damping;
            [stored.halved(), lost + &softness.dissipated]
        };
        let stages = self.stages(node, time, limit)?;
        let one = |k: usize| either(stages.iter().map(|stage| energies(stage)[k].clone())).ok_or(Error::Open(Open));
        Ok([one(0)?, one(1)?])
    }

    /// Returns whether a contact is closed.
    ///
    /// **Errors**: [`Error::TimeOutside`]; [`Error::Open`] if the time is not told from that of a break.
    pub fn is_closed(&self, node: usize, time: &N, side: Side) -> Result<bool, Error> {
        Ok(self.stage(node, time, side)?.closed)
    }

    /// Returns whether the force of a node, or its slope, may have two limits at a time.
    pub(super) fn may_jump(&self, node: usize, time: &N) -> Result<bool, Open> {
        may_jump(&self.nodes[node], |stage| (&stage.from, &stage.force), time)
    }

    fn stage(&self, node: usize, time: &N, side: Side) -> Result<&Stage<N>, Error> {
        match self.stages(node, time, Limit::at(side))? {
            [stage] => Ok(stage),
            _ => Err(Error::Open(Open)),
        }
    }

    /// Returns the stages of a node that a time may lie in.
    fn stages(&self, node: usize, time: &N, limit: Limit) -> Result<&[Stage<N>], Error> {
        self.check_time(time)?;
        let stages = &self.nodes[node];
        stages.get(indices_at(stages, |stage| &stage.from, time, limit)).ok_or(Error::Open(Open))
    }

    /// Refuses times outside of the run.
    pub(super) fn check_time(&self, time: &N) -> Result<(), Error> {
        if time.negative()? || self.end.below(time)? {
            return Err(Error::TimeOutside { found: time.text(), end: self.end.text() });
        }
        Ok(())
    }
}
