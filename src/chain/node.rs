//! A node: the signals that arrive at it, its state, and its next event.

use std::cmp::Ordering;
use std::sync::Arc;

use super::curve::Signal;
use super::exact::{Exact, exact_sum};
use super::interface::Softness;
use super::law::{Law, Leaving, Mix};
use super::onset::Taylor;
use super::wave::Wave;
use crate::lattice::Line;
use crate::motion::EventKind;
use crate::number::{Bounded, Open, is_exact_zero};

/// Origin of a signal that arrives at a node.
#[derive(Clone, Debug)]
pub(super) enum Source<N> {
    /// Zero for ever.
    Nothing,
    /// The wave through the body with this index.
    Wave(usize),
    /// Given lines.
    Data(Vec<DataLine<N>>),
    /// The velocity of the mass with this index in its cluster.
    Mass(usize),
}

/// A line that is given from a time on.
#[derive(Clone, Debug)]
pub(super) struct DataLine<N> {
    pub(super) from: N,
    pub(super) line: Line<N>,
    /// Exact form of the beginning.
    pub(super) exact: Exact,
    /// The value at the beginning, which the line has within a rounding.
    pub(super) first: N,
}

impl<N: Bounded> Source<N> {
    /// Returns the time at which a piece of the signal arrives after `delay`, if it has left its origin.
    pub(super) fn beginning(&self, delay: Option<&N>, piece: usize, waves: &[[Wave<N>; 2]], side: usize) -> Option<N> {
        match (self, delay) {
            (Source::Wave(body), Some(delay)) => {
                waves[*body][side].pieces.get(piece).map(|piece| piece.from.clone() + delay)
            }
            (Source::Data(lines), _) => lines.get(piece).map(|line| line.from.clone()),
            _ => None,
        }
    }

    /// Returns the exact form of [`Source::beginning`].
    pub(super) fn exact_beginning(&self, delay: &Exact, piece: usize, waves: &[[Wave<N>; 2]], side: usize) -> Exact {
        match self {
            Source::Wave(body) => exact_sum(&waves[*body][side].pieces.get(piece)?.exact, delay),
            Source::Data(lines) => lines.get(piece)?.exact.clone(),
            _ => None,
        }
    }

    /// Returns the Taylor series of a piece at its beginning, if it begins at exactly zero.
    pub(super) fn taylor(&self, piece: usize, waves: &[[Wave<N>; 2]], side: usize) -> Option<Arc<Taylor<N>>> {
        match self {
            Source::Wave(body) => waves[*body][side].pieces.get(piece)?.taylor.clone(),
            Source::Data(lines) => {
                let DataLine { line, first, .. } = lines.get(piece)?;
                Taylor::new(first.one(), vec![first.clone(), line.slope.clone()])
            }
            _ => None,
        }
    }

    /// Returns a piece of the signal after `delay`.
    pub(super) fn piece(
        &self,
        delay: Option<&N>,
        piece: usize,
        waves: &[[Wave<N>; 2]],
        side: usize,
    ) -> Option<Signal<N>> {
        match (self, delay) {
            (Source::Wave(body), Some(delay)) => {
                waves[*body][side].pieces.get(piece).map(|piece| piece.signal.delayed(delay))
            }
            (Source::Data(lines), _) => lines.get(piece).map(|data| Signal::Line(data.line.clone())),
            _ => None,
        }
    }
}

/// The signal that arrives from one side.
#[derive(Clone, Debug)]
pub(super) struct Arrival<N> {
    pub(super) source: Source<N>,
    /// Travel time through the body of a wave.
    delay: Option<N>,
    /// Index of the piece that arrives.
    cursor: usize,
    line: Line<N>,
    /// Arrival of the next break, as far as it is known.
    next: Option<N>,
}

/// The next event that a contact has by itself, if no signal changes before it.
#[derive(Clone, Debug)]
enum Root<N> {
    None,
    At(N),
    /// An irrational time: its surd, and the nearest double.
    Irrational {
        surd: String,
        near: f64,
    },
}

/// The state of a node between two breaks.
#[derive(Clone, Debug)]
pub(super) struct Stage<N> {
    /// Its beginning.
    pub(super) from: N,
    /// The compressive force.
    pub(super) force: Signal<N>,
    /// The gap.
    pub(super) gap: Gap<N>,
    /// Whether a contact is closed.
    pub(super) closed: bool,
}

/// The gap of a node over time.
#[derive(Clone, Debug)]
pub(super) enum Gap<N> {
    /// Zero: no contact, a closed one, or one at rest.
    Zero,
    /// A gap `at` the stored beginning, and `drive`, its rate `y` between free ends.
    Open { at: N, drive: Line<N> },
    /// The gap of a contact, or of a spring, in a chain with springs, dashpots or masses.
    Soft(Box<Softness<N>>),
}

/// An occurrence at a contact.
#[derive(Clone, Debug)]
pub(super) struct Occurrence<N> {
    /// Impact or release; `None` for a touch: the gap reaches zero without a contact.
    pub(super) kind: Option<EventKind>,
    pub(super) t: N,
    /// `y` before and after.
    pub(super) drive: [N; 2],
}

/// Time that a node has reached, and the occurrence at it.
pub(super) type Processed<N> = (N, Option<Occurrence<N>>);

/// Reason that a node cannot continue.
pub(super) enum Stop {
    /// An undecided comparison.
    Open,
    /// An event at an irrational time.
    Irrational { kind: EventKind, surd: String, near: f64 },
}

impl From<Open> for Stop {
    fn from(_: Open) -> Self {
        Stop::Open
    }
}

/// A node of the chain.
#[derive(Clone, Debug)]
pub(super) struct Node<N> {
    pub(super) sides: [Arrival<N>; 2],
    pub(super) law: Law,
    mix: Mix<N>,
    leaving: Leaving<N>,
    /// The states of the node, in order; empty before the start.
    pub(super) stages: Vec<Stage<N>>,
    /// The end of the run.
    until: N,
    gap: N,
    closed: bool,
    /// Whether the gap of an open contact is zero.
    resting: bool,
    root: Root<N>,
    /// The next time at which the node changes, as a double.
    pub(super) key: f64,
    /// The first time of a decision that the bounds leave open.
    pub(super) doubt: Option<f64>,
}

impl<N: Bounded> Arrival<N> {
    fn new(source: Source<N>, delay: Option<N>, zero: &N) -> Self {
        let line = Line { intercept: zero.clone(), slope: zero.clone() };
        Arrival { source, delay, cursor: 0, line, next: None }
    }

    /// Returns the line that arrives at the start.
    fn first(&self, waves: &[[Wave<N>; 2]], side: usize) -> Line<N> {
        let first = self.source.piece(self.delay.as_ref(), 0, waves, side);
        first.map_or_else(|| self.line.clone(), Signal::into_line)
    }

    /// Looks up the next break, if it has left its origin.
    fn look_up(&mut self, waves: &[[Wave<N>; 2]], side: usize) {
        if self.next.is_none() {
            self.next = self.source.beginning(self.delay.as_ref(), self.cursor + 1, waves, side);
        }
    }

    /// Passes on to the next piece.
    fn advance(&mut self, waves: &[[Wave<N>; 2]], side: usize) {
        self.cursor += 1;
        let Some(piece) = self.source.piece(self.delay.as_ref(), self.cursor, waves, side) else { return };
        self.line = piece.into_line();
        self.next = None;
        self.look_up(waves, side);
    }
}

impl<N: Bounded> Node<N> {
    pub(super) fn new(sources: [Source<N>; 2], delays: [Option<N>; 2], law: Law, mix: Mix<N>, gap: N) -> Self {
        let [below, above] = sources;
        let [first, second] = delays;
        let sides = [Arrival::new(below, first, &gap), Arrival::new(above, second, &gap)];
        let (stages, root) = (Vec::new(), Root::None);
        let leaving = mix.leaving(law, false, sides.each_ref().map(|side| &side.line));
        let until = gap.zero();
        Node {
            sides,
            law,
            mix,
            leaving,
            stages,
            until,
            gap,
            closed: false,
            resting: false,
            root,
            key: 0.0,
            doubt: None,
        }
    }

    /// Notes a doubt if a slope that may be other than zero can bring an event before the end of the run.
    fn check_drift(&mut self, drive: &Line<N>, from: &N) -> Result<(), Open> {
        let flat = Line { intercept: drive.intercept.clone(), slope: drive.slope.taken_for_zero() };
        let stays = match self.closed {
            true => flat.value_at(&self.until).negative()?,
            false if drive.value_at(from).negative()? => true,
            false => self.resting || (flat.integral(from, &self.until) + &self.gap).positive()?,
        };
        if !stays {
            self.doubts(&flat.slope, from);
        }
        Ok(())
    }

    /// Returns the states of the node.
    pub(super) fn into_stages(self) -> Vec<Stage<N>> {
        self.stages
    }

    /// Looks up the breaks that have left the neighbours since.
    pub(super) fn look_up(&mut self, waves: &[[Wave<N>; 2]]) {
        for (side, arrival) in self.sides.iter_mut().enumerate() {
            arrival.look_up(waves, side);
        }
        let fronts = self.sides.iter().filter_map(|side| side.next.as_ref()).map(N::to_f64);
        let root = match &self.root {
            Root::None => f64::INFINITY,
            Root::At(t) => t.to_f64(),
            Root::Irrational { near, .. } => *near,
        };
        self.key = fronts.fold(root, f64::min);
    }

    /// Lets the signals of the start arrive.
    pub(super) fn begin(&mut self, until: &N, waves: &mut [[Wave<N>; 2]]) -> Result<Option<Occurrence<N>>, Stop> {
        self.until = until.clone();
        for side in 0..2 {
            self.sides[side].line = self.sides[side].first(waves, side);
        }
        let zero = self.gap.zero();
        let drive = self.drive();
        let mut impact = None;
        if self.law == Law::Contact && self.gap.vanishes()? {
            self.closed = self.closes(&drive, &zero)?;
            self.resting = !self.closed && drive.value_at(&zero).vanishes()? && drive.slope.vanishes()?;
            self.gap = zero.clone();
            let (kind, y) = (Some(EventKind::Impact), drive.value_at(&zero));
            impact = self.closed.then(|| Occurrence { kind, t: zero.clone(), drive: [y.clone(), y] });
        }
        self.cross(&zero, &mut [zero.clone(), zero.clone()]);
        self.settle(zero.clone(), drive, [zero.clone(), zero], waves)?;
        Ok(impact)
    }

    /// Returns `y`.
    fn drive(&self) -> Line<N> {
        let [below, above] = &self.sides;
        above.line.clone().minus(&below.line)
    }

    /// Processes all that happens at the next time of the node; returns `None` if that is after the end of the
    /// run.
    pub(super) fn process(&mut self, waves: &mut [[Wave<N>; 2]]) -> Result<Option<Processed<N>>, Stop> {
        let (stored, hits) = self.next_time()?;
        if self.until.below(&stored)? {
            return Ok(None);
        }
        let [below, above, root] = hits;
        let (before, was_closed, was_resting) = (self.drive(), self.closed, self.resting);
        let is_open_contact = self.law == Law::Contact && !self.closed;
        if let Some(stage) = self.stages.last().filter(|_| is_open_contact) {
            self.gap = before.integral(&stage.from, &stored) + &self.gap;
        }
        // The drive after the break from above alone, if two coincide.
        let other = (below.is_some() && above.is_some()).then(|| self.sides[0].line.clone());
        let (mut t, mut drive, mut alone) = (stored.clone(), before.clone(), None);
        let crossed = below.is_some() || above.is_some();
        let mut off = [t.zero(), t.zero()];
        // Each signal is passed on by itself, so that bounds count the slivers between coincident breaks.
        for (side, place) in [below, above].into_iter().enumerate() {
            let Some(place) = place else { continue };
            let place = stored.clone().nominal().joined(&place);
            self.sides[side].advance(waves, side);
            let new = self.drive();
            if is_open_contact {
                let [a, b] = [&drive, &new].map(|line| line.value_at_stored(&stored));
                self.gap.cross_break(&place, [&a, &drive.slope], [&b, &new.slope]);
            }
            self.cross(&place, &mut off);
            t = t.joined(&place);
            alone = Some(std::mem::replace(&mut drive, new)).filter(|_| side == 1);
        }
        let alone = other.zip(alone).map(|(below, alone)| [alone, self.sides[1].line.clone().minus(&below)]);
        let mut touched = false;
        if self.law == Law::Contact && self.closed {
            self.check_sliver([&before, &drive], alone.as_ref(), &t);
            self.closed = !self.opens(&drive, alone.as_ref(), root.is_some() && !crossed, &t)?;
            if !self.closed {
                (self.gap, self.resting) = (t.zero(), false);
                let y = drive.value_at_stored(&t);
                self.gap.cross_break(&t, [&t.zero(), &t.zero()], [&y, &drive.slope]);
            }
        } else if is_open_contact {
            let near = if root.is_some() { Some(None) } else { self.touch([&before, &drive], &stored)? };
            if let Some(deviation) = near {
                t = deviation.map_or(t.clone(), |by| t.widened(&by));
                self.closed = self.closes(&drive, &t)?;
                touched = !self.closed && !was_resting;
                if touched && root.is_none() {
                    let gap = self.gap.clone();
                    self.doubts(&gap, &t);
                }
                self.resting = !self.closed && drive.value_at(&t).vanishes()? && drive.slope.vanishes()?;
                self.gap = if self.closed { t.zero() } else { self.gap.taken_for_zero() };
            } else {
                self.resting = false;
            }
        }
        // Where two breaks, or a break and a root, coincide within their bounds, their order sets the rates at the
        // event, the peak, and whether there is another event.
        let is_event = was_closed != self.closed;
        if (is_event && alone.is_some()) || (root.is_some() && crossed) {
            self.doubts(&t, &t);
        }
        if is_event {
            let place = stored.nominal().joined(root.as_ref().unwrap_or(&t)).joined(&t);
            self.cross(&place, &mut off);
        }
        let kind = match (was_closed, self.closed) {
            (false, true) => Some(EventKind::Impact),
            (true, false) => Some(EventKind::Release),
            _ => None,
        };
        let occurrence = (kind.is_some() || touched).then(|| {
            let drive = [&before, &drive].map(|line| line.value_at(&t));
            Occurrence { kind, t: t.clone(), drive }
        });
        self.settle(t.clone(), drive, off, waves)?;
        Ok(Some((t, occurrence)))
    }

    /// Returns the time that comes next, and which of the two breaks and the root of a contact are there.
    fn next_time(&self) -> Result<(N, [Option<N>; 3]), Stop> {
        let [below, above] = self.sides.each_ref().map(|side| side.next.clone());
        let root = match &self.root {
            Root::At(t) => Some(t.clone()),
            Root::None => None,
            Root::Irrational { surd, near } => {
                let mut lands = true;
                for front in [&below, &above].into_iter().flatten() {
                    lands = lands && self.lands_before(front)?;
                }
                if lands {
                    let kind = if self.closed { EventKind::Release } else { EventKind::Impact };
                    return Err(Stop::Irrational { kind, surd: surd.clone(), near: *near });
                }
                None
            }
        };
        let mut candidates = [below, above, root];
        let mut first: Option<N> = None;
        for candidate in candidates.iter().flatten() {
            let earlier = first.as_ref().map(|first| candidate.below(first)).transpose()?;
            if earlier != Some(false) {
                first = Some(candidate.clone());
            }
        }
        let first = first.ok_or(Stop::Open)?;
        for candidate in &mut candidates {
            let order = candidate.as_ref().map(|t| t.compare(&first)).transpose()?;
            if order.is_some_and(Ordering::is_ne) {
                *candidate = None;
            }
        }
        Ok((first, candidates))
    }

    /// Returns whether the gap closes before or at `t`, given that it does so at all while no signal changes.
    fn lands_before(&self, t: &N) -> Result<bool, Open> {
        let Some(stage) = self.stages.last() else { return Ok(false) };
        let Gap::Open { at, drive } = &stage.gap else { return Ok(false) };
        let gap = drive.integral(&stage.from, t) + at;
        Ok(!gap.positive()? || (drive.slope.positive()? && !drive.value_at(t).negative()?))
    }

    /// Returns whether a closed contact opens. `alone` has the drives after one of two coincident breaks each, and
    /// `rooted` says that nothing but a root of the drive is there.
    fn opens(&mut self, drive: &Line<N>, alone: Option<&[Line<N>; 2]>, rooted: bool, t: &N) -> Result<bool, Open> {
        let y = drive.value_at(t);
        if rooted || y.positive()? {
            return Ok(true);
        }
        if !y.negative()? {
            self.doubts(&y, t);
            return drive.slope.positive();
        }
        // One of two coincident breaks alone may open the contact for a moment.
        for line in alone.into_iter().flatten() {
            if !line.value_at(t).negative()? {
                self.doubts(t, t);
            }
        }
        Ok(false)
    }

    /// Notes a doubt if the force of a closed contact is greater between two breaks than before and after them. The
    /// breaks coincide within their bounds; if they do not coincide, that force is the peak. `alone` has the drives
    /// after one of them each.
    fn check_sliver(&mut self, drives: [&Line<N>; 2], alone: Option<&[Line<N>; 2]>, t: &N) {
        let drives = drives.map(|line| line.value_at(t));
        // The force rises as the drive falls.
        let exceeds = |y: &N| drives.iter().all(|other| (y.clone() - other).negative() == Ok(true));
        if alone.into_iter().flatten().any(|line| exceeds(&line.value_at(t))) {
            self.doubts(t, t);
        }
    }

    /// Returns whether a contact whose gap is zero closes.
    fn closes(&mut self, drive: &Line<N>, t: &N) -> Result<bool, Open> {
        let y = drive.value_at(t);
        if y.negative()? {
            return Ok(true);
        }
        if y.positive()? {
            return Ok(false);
        }
        self.doubts(&y, t);
        drive.slope.negative()
    }

    /// Notes a decision by a number that is known within a bound only.
    fn doubts(&mut self, number: &N, t: &N) {
        if number.roundoffs() > 0.0 && self.doubt.is_none() {
            self.doubt = Some(t.to_f64());
        }
    }

    /// Returns whether the gap is zero at a break within its bound, and if so its deviation in time.
    fn touch(&self, drives: [&Line<N>; 2], t: &N) -> Result<Option<Option<N>>, Open> {
        if self.resting || is_exact_zero(&self.gap) {
            return Ok(Some(None));
        }
        if self.gap.positive()? {
            return Ok(None);
        }
        let mut found: Option<N> = None;
        for line in drives {
            let speed = line.value_at_stored(t);
            if speed.negative()?
                && let Some(by) = self.gap.root_deviation(&speed, &line.slope)
            {
                found = Some(found.map_or(by.clone(), |sum| sum.widened(&by)));
            }
        }
        Ok(Some(found))
    }

    /// Lets the waves that leave follow the state, and widens `off` for the step, which is at `place`.
    fn cross(&mut self, place: &N, off: &mut [N; 2]) {
        let new = self.mix.leaving(self.law, self.closed, self.sides.each_ref().map(|side| &side.line));
        if place.roundoffs() > 0.0 {
            for ((off, old), new) in off.iter_mut().zip(&self.leaving.waves).zip(&new.waves) {
                let [a, b] = [old, new].map(|line| line.value_at_stored(place));
                off.cross_break(place, [&a, &old.slope], [&b, &new.slope]);
            }
        }
        self.leaving = new;
    }

    /// Sends out the waves from `t` on, records the state, and looks for the next event.
    fn settle(&mut self, t: N, drive: Line<N>, off: [N; 2], waves: &mut [[Wave<N>; 2]]) -> Result<(), Stop> {
        // The downward wave of a body has the index 1 there, and leaves to the side below.
        for (side, off) in off.into_iter().enumerate() {
            if let Source::Wave(body) = &self.sides[side].source {
                waves[*body][1 - side].push(&t, self.leaving.waves[side].clone(), off);
            }
        }
        self.root = if self.law == Law::Contact { self.find_root(&drive, &t)? } else { Root::None };
        let (closed, force) = (self.closed, self.leaving.force.clone());
        let is_open = self.law == Law::Contact && !closed && !self.resting;
        let gap = if is_open { Gap::Open { at: self.gap.clone(), drive } } else { Gap::Zero };
        self.stages.push(Stage { from: t, force: Signal::Line(force), gap, closed });
        Ok(())
    }

    /// Finds the next event of a contact from `from` on under a constant drive.
    ///
    /// **Source**: closed, the root of `y`. Open, the first root of `G + y s + a s²/2` that the gap crosses downward or
    /// touches; the form of the root avoids cancellation.
    fn find_root(&mut self, drive: &Line<N>, from: &N) -> Result<Root<N>, Stop> {
        let slope = &drive.slope;
        if slope.deviation().is_some() && slope.vanishes()? {
            self.check_drift(drive, from)?;
        }
        if self.closed {
            return Ok(if slope.positive()? { Root::At(-(drive.intercept.clone() / slope)) } else { Root::None });
        }
        if self.resting {
            return Ok(Root::None);
        }
        let from = from.clone().nominal();
        let (gap, y) = (&self.gap, drive.value_at(&from));
        let (speed, bend) = (y.sign()?, slope.sign()?);
        if bend.is_ge() && speed.is_ge() {
            return Ok(Root::None);
        }
        if bend.is_eq() {
            let wait = gap.clone() / &(-y.clone());
            if slope.deviation().is_none() {
                return Ok(Root::At(wait + &from));
            }
            // With `y² ≥ 2|a|G` the root of `G + y s + a s²/2` is at most twice as late as that of `G + y s`.
            let drift = slope.taken_for_zero();
            let square = y.square() - (drift.clone() * gap).doubled();
            let at = gap.clone() / &(-(drift * &wait + &y)) + &from;
            if !square.positive()? {
                self.doubts(&square, &from);
            }
            return Ok(Root::At(at));
        }
        let square = y.square() - (slope.clone() * gap).doubled();
        match square.sign()? {
            Ordering::Less => return Ok(Root::None),
            Ordering::Equal => {
                self.doubts(&square, &from);
                let at = -(y / slope) + &from;
                // The values of the parabola at its lowest point are within this of zero.
                let depth = square / &slope.clone().doubled();
                let deviation = depth.root_deviation(&depth.zero(), slope);
                return Ok(Root::At(deviation.map_or(at.clone(), |by| at.widened(&by))));
            }
            Ordering::Greater => (),
        }
        let exact = square.try_sqrt();
        let is_known = exact.is_some();
        let root = exact.unwrap_or_else(|| square.near_sqrt());
        // Each form adds terms of one sign.
        let wait = match speed.is_ge() {
            true => (y.clone() + root) / &(-slope.clone()),
            false => gap.clone().doubled() / (root - &y),
        };
        let at = wait + &from;
        if is_known {
            return Ok(Root::At(at));
        }
        let radicand = square / &slope.square();
        // An opening parabola has landed at its earlier root, a falling one at its later root.
        let surd = (from - &(y / slope)).surd(bend.is_lt(), &radicand);
        Ok(Root::Irrational { surd, near: at.to_f64() })
    }
}
