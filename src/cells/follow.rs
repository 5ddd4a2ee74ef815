//! The ground end, followed through contacts and flights.
//!
//! With `y = v_t + c v_x` at the ground: in contact `y = c v_x`, and the rod leaves when `y` turns positive; in flight
//! `y = v_t`, and the rod lands when `v(0,·) = ∫ y` returns to zero. A return at which `y` is positive, or zero and not
//! falling, is no landing: the flight goes on.

use std::ops::ControlFlow;

use super::account::Proof;
use super::budget::{Budget, CUT_CELLS, FIRST_CELLS, MOST_LATE};
use super::effort::{Effort, MOST_PIECES, MOST_SEGMENTS, Task};
use super::flight::Flight;
use super::march::{Medium, State};
use super::piece::{Checkpoint, Found, Mark, Piece};
use super::root::first_descent;
use super::series::{at_one, at_zero, bound, derivative, evaluate};
use super::start::{Data, on_grid};
use super::uncertainty::{Off, Uncertainty};
use crate::error::Error;
use crate::motion::{Ending, EventKind};
use crate::problem::Run;
use crate::reason::{Near, Reason, Warning};
use crate::special::RoundedSpecial;

/// Roundings of a round trip within which an event counts as at a ray.
const AT_RAY: f64 = 32.0;

/// Distance of an event from the end of a run, in round trips, below which its time error may reach the end: with a
/// greater error the order of events is lost.
const NEAR_END: f64 = MOST_LATE;

#[derive(Clone, Debug)]
pub(super) enum Goal<S> {
    /// A number of contacts, each with the flight after it.
    Impacts(u32),
    /// A time, dimensionless.
    Time(S),
}

impl<S: RoundedSpecial> Goal<S> {
    /// Reads the goal from the run of the problem.
    fn of(task: &Task<'_, S>, data: &Data<S>) -> Self {
        match task.problem.run() {
            Run::Impacts(count) => Goal::Impacts(*count),
            Run::Time(time) => Goal::Time(S::from_number(time, task.precision) / &data.units.time),
        }
    }
}

/// State of a run: the rod, its ground end, and the results so far.
#[derive(Debug)]
pub(super) struct Follower<'a, S> {
    pub(super) medium: &'a Medium<S>,
    pub(super) data: &'a Data<S>,
    /// `q` of the deviation from the static state, or of the vibration in a separated flight.
    pub(super) state: State<S>,
    pub(super) contact: bool,
    pub(super) landed: u32,
    /// Whether the order of events is in doubt.
    pub(super) lost: bool,
    /// Whether the present landing is at a ray.
    pub(super) at_ray: bool,
    /// Time error of the end of the run, if it is an event.
    pub(super) end_error: f64,
    /// Whether the end has only risen since the release and is not yet clear of the ground.
    pub(super) rising: bool,
    /// Warning about hops that the bound does not separate from contact.
    pub(super) unresolved: Option<Warning>,
    /// Start of the last contact: the number of whole round trips, and the fraction.
    pub(super) landing: Option<(i64, S)>,
    /// Index of the present flight, if it is separated.
    pub(super) flight: Option<usize>,
    pub(super) flights: Vec<Flight<S>>,
    /// `v(0,b)`.
    pub(super) height: S,
    /// `z(0,b)` of the vibration.
    pub(super) ground: S,
    pub(super) pieces: Vec<Piece<S>>,
    pub(super) marks: Vec<Mark<S>>,
    /// States at the beginning of each round trip and on both sides of a leap.
    pub(super) checkpoints: Vec<Checkpoint<S>>,
    pub(super) warnings: Vec<Warning>,
    crossed: u64,
    /// Error of `p`, `q` made in one cell.
    pub(super) cell_error: f64,
    pub(super) budget: Budget,
    /// Value of the trace at the end of the last piece.
    pub(super) last_trace: Option<S>,
    /// Error bounds of values before the first event.
    pub(super) before: Uncertainty,
    pub(super) proof: Option<Proof<S>>,
}

/// State of a run between its strips.
struct Pace<S> {
    /// Last round trip that has begun.
    round: i64,
    /// Time since which the rod has been calm, as [`Follower::settle`] notes it.
    calm: Option<S>,
    /// Whether an event has already occurred at this time.
    fresh: bool,
    /// Time by which an event at the end of the strip before was moved onto its ray.
    moved: f64,
}

/// The strip that begins now, with `v_t + c v_x` at the ground and, in flight, `v(0,·)` over it.
struct Strip<S> {
    len: S,
    trace: Vec<S>,
    height: Vec<S>,
}

/// The next event in a strip.
struct Next<S> {
    /// Time from the beginning of the strip, between its ends.
    inside: Option<S>,
    at_start: bool,
    at_end: bool,
    /// Error of the function and of its bound where noise hides its root.
    vague: f64,
}

impl<'a, S: RoundedSpecial> Follower<'a, S> {
    /// Builds the state of a run at `t = 0`.
    pub(super) fn new(medium: &'a Medium<S>, data: &'a Data<S>, mut proof: Option<Proof<S>>) -> Self {
        let state = data.march(medium, &mut |cell| {
            if let Some(proof) = &mut proof {
                proof.cell(medium, cell);
            }
        });
        let mut follower = Follower { proof, ..Self::with(medium, data, state) };
        follower.prove(Proof::start);
        follower.budget.add(FIRST_CELLS * follower.cell_error);
        follower.height = data.ground.clone();
        follower.rising = !data.ground.is_positive();
        if !data.ground.is_positive() && !follower.rises(follower.held_trace()) {
            follower.contact = true;
            follower.landed = 1;
            follower.landing = Some((0, data.slope.zero()));
            follower.prove(|proof, _| proof.contact());
            let impact = Mark::new(EventKind::Impact, data.slope.zero(), data.end_velocity());
            follower.marks.push(Mark { time_error: 0.0, ..impact });
        } else {
            follower.take_off(&data.end_velocity(), Off::default(), None);
        }
        follower.note_slope();
        follower
    }

    /// Builds the state of a run in flight at height zero, without errors.
    fn with(medium: &'a Medium<S>, data: &'a Data<S>, state: State<S>) -> Self {
        let mut follower = Follower {
            medium,
            data,
            state,
            contact: false,
            landed: 0,
            lost: false,
            at_ray: false,
            end_error: 0.0,
            rising: true,
            unresolved: None,
            landing: None,
            flight: None,
            flights: Vec::new(),
            height: data.slope.zero(),
            ground: data.slope.zero(),
            pieces: Vec::new(),
            marks: Vec::new(),
            checkpoints: Vec::new(),
            warnings: Vec::new(),
            crossed: 0,
            cell_error: 0.0,
            budget: Budget::new(2.0 * medium.kappa.to_f64(), medium.splits()),
            last_trace: None,
            before: Uncertainty::default(),
            proof: None,
        };
        follower.weigh();
        follower.add_chain();
        follower
    }

    pub(super) fn weigh(&mut self) {
        self.cell_error = self.medium.cell_error(&self.state);
    }

    /// Adds the error of the cells along the present characteristic: each strip adds two cells to the longest path to
    /// the next characteristic, and the first strips of a chain add all cells of this one.
    pub(super) fn add_chain(&mut self) {
        self.budget.add(self.state.segments.len() as f64 * self.cell_error);
    }

    /// Returns the error of `p` and `q` from roundings and truncations; smaller values decide nothing.
    pub(super) fn noise(&self) -> f64 {
        self.budget.noise()
    }

    /// Returns the corresponding error of `v(0,·)` up to `len` from now. Where the bound leaves an event `open`, this
    /// noise alone decides, so that one hop results and not a row of ever smaller ones.
    fn height_noise(&self, len: f64, open: bool) -> f64 {
        let noise = if self.flight.is_some() {
            2.0 * self.damping().exp() * self.noise()
        } else {
            self.height_error(len).fixed
        };
        if open { noise } else { noise.min(self.height_most(len, 0.0)) }
    }

    /// Returns the error of `p` and `q` at the ground, by the better account.
    pub(super) fn trace_error(&self) -> f64 {
        self.budget.trace()
    }

    /// Bounds the error of `v(0,·)` from now until `len` later, by the better account; `passing` is `Σ |jump| · time
    /// error` of the rays that pass in each round trip.
    pub(super) fn height_most(&self, len: f64, passing: f64) -> f64 {
        let flown = self.flying().map(|flight| {
            let age = flight.age(&self.state).to_f64();
            [age, age + len].map(|age| (age, flight.rate_at(&self.height.double(age)).to_f64()))
        });
        self.budget.end_most(flown, len, passing)
    }

    pub(super) fn damping(&self) -> f64 {
        2.0 * self.medium.kappa.to_f64()
    }

    /// Returns the place on the circle of a round trip where this characteristic leaves the ground.
    pub(super) fn place(&self) -> f64 {
        self.state.segments[0].at.to_f64()
    }

    /// Returns the present flight, if it is separated.
    pub(super) fn flying(&self) -> Option<&Flight<S>> {
        self.flight.and_then(|k| self.flights.get(k))
    }

    /// Returns `h` and `h′` now in a separated flight.
    pub(super) fn centre(&self) -> Option<(S, S)> {
        self.flying().map(|flight| flight.at(&flight.age(&self.state)))
    }

    /// Computes the error of `v(0,·)` up to `len` from now, in both accounts.
    pub(super) fn height_error(&self, len: f64) -> Off {
        let then = self.flying().map(|flight| {
            let age = flight.age(&self.state).to_f64() + len;
            let rate = flight.rate_at(&self.height.double(age)).to_f64();
            (age, rate, (self.place() + len).fract())
        });
        self.budget.end(then, len)
    }

    /// Returns whether the ground end, at height zero, leaves at once: `y > 0`, or `y = 0` and rising.
    ///
    /// A value below the error counts as zero; Markov's inequality, `‖f′‖ ≤ 2n²‖f‖` on the unit interval, gives the
    /// error of a derivative.
    fn rises(&self, mut c: Vec<S>) -> bool {
        let zero = self.height.zero();
        let mut noise = self.noise();
        for _ in 0..3 {
            let value = at_zero(&c, &zero).to_f64();
            if value.abs() > noise {
                return value > 0.0;
            }
            noise *= 2.0 * (c.len() as f64).powi(2);
            c = derivative(&c);
        }
        false
    }

    /// Computes the trace as if the end were now in contact.
    pub(super) fn held_trace(&self) -> Vec<S> {
        match self.flying() {
            Some(flight) => {
                let segments = self.state.segments.iter().take(1).cloned().collect();
                let mut first = State { round: self.state.round, segments };
                self.medium.touch_down(&mut first, flight);
                self.medium.trace(&first, true)
            }
            None => self.medium.trace(&self.state, true),
        }
    }

    pub(super) fn run(mut self, task: &Task<'_, S>) -> Result<Found<S>, Error> {
        let ending = self.follow(&Goal::of(task, self.data), task)?;
        let last = self.budget.since();
        match self.marks.last_mut() {
            Some(mark) => mark.after = last,
            None => self.before = last,
        }
        let Follower { pieces, checkpoints, flights, marks, warnings, unresolved, before, end_error, proof, .. } = self;
        Ok(Found { pieces, checkpoints, flights, marks, warnings, unresolved, before, ending, end_error, proof })
    }

    /// Follows the end to the goal; `observe` receives the number of round trips, or of contacts if the goal is a
    /// number of impacts, and the number of pieces.
    fn follow(&mut self, goal: &Goal<S>, Task { effort, observe, .. }: &Task<'_, S>) -> Result<Ending, Error> {
        let mut pace = Pace { round: i64::MIN, calm: None, fresh: true, moved: 0.0 };
        loop {
            if let Some(ending) = self.limits(effort)? {
                return Ok(ending);
            }
            if self.state.round > pace.round {
                if let Some(ending) = self.begin_round(goal, *observe, &mut pace)? {
                    return Ok(ending);
                }
                if let Some(trips) = self.leap_length(goal) {
                    self.leap(trips);
                    pace.fresh = false;
                    continue;
                }
            }
            if let Goal::Impacts(_) = goal
                && let Some(ending) = self.stays()
            {
                return Ok(ending);
            }
            if let Some(ending) = self.follow_strip(goal, &mut pace) {
                return Ok(ending);
            }
            let once = self.state.round > pace.round && !self.contact && matches!(goal, Goal::Impacts(_));
            if once && let Some(ending) = self.escapes() {
                return Ok(ending);
            }
        }
    }

    /// Returns the ending of a run that has reached a limit of its effort or of its proof.
    ///
    /// **Errors**: [`Error::NotDecided`] where the order of events is lost, and longer numbers follow.
    fn limits(&self, effort: &Effort) -> Result<Option<Ending>, Error> {
        if self.open() {
            return Ok(Some(Ending::Time));
        }
        let (pieces, rays) = (self.pieces.len(), self.state.segments.len());
        if pieces >= MOST_PIECES || rays > MOST_SEGMENTS || self.crossed > effort.cells {
            return Ok(Some(Ending::Undecided(Reason::Effort { cells: self.crossed, rays })));
        }
        if self.lost && effort.until_lost {
            return Err(Error::not_decided("in which order the events come", self.height.bits()));
        }
        Ok(None)
    }

    /// Begins a round trip, and returns the ending of a run that needs no further one.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`; [`Error::NotDecided`] beyond the range of the numbers.
    fn begin_round(
        &mut self,
        goal: &Goal<S>,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
        pace: &mut Pace<S>,
    ) -> Result<Option<Ending>, Error> {
        pace.round = self.state.round;
        let done = if matches!(goal, Goal::Impacts(_)) { self.landed as usize } else { pace.round.max(0) as usize };
        if observe(done, self.pieces.len()).is_break() {
            return Err(Error::Interrupted);
        }
        self.new_round();
        if !(self.height.is_finite() && self.cell_error.is_finite()) {
            return Err(Error::not_decided("how the rod moves beyond the range of these numbers", self.height.bits()));
        }
        Ok(self.settle(goal, &mut pace.calm))
    }

    /// Follows the end to the next event, at most over the strip that begins now; returns the ending if the run ends
    /// there.
    fn follow_strip(&mut self, goal: &Goal<S>, pace: &mut Pace<S>) -> Option<Ending> {
        let first = &self.state.segments[0];
        let (len, ray) = (first.len.clone(), first.off.plus(std::mem::take(&mut pace.moved)));
        let fresh = std::mem::replace(&mut pace.fresh, true);
        if !fresh && self.contact {
            let trace = self.held_trace();
            self.note_open_ray(&trace);
            if self.rises(trace) {
                self.event(ray, None);
                return None;
            }
        }
        let (trace, height) = self.over(&len);
        // The height after a release already includes the ray that releases the end.
        if !fresh {
            self.pass_ray(&trace, ray);
        }
        let left = match goal {
            Goal::Time(end) => (end.clone() - self.state.time()).to_f64(),
            Goal::Impacts(_) => f64::INFINITY,
        };
        let open = self.note_open(&trace, &height, fresh, left);
        let grounded = !self.contact && self.height.to_f64() <= self.height_noise(0.0, open);
        if !fresh && grounded && !self.rises(self.held_trace()) {
            return self.land_at_ray(goal, ray, &trace, &height, &len).then_some(Ending::NextImpact);
        }
        let strip = Strip { len, trace, height };
        let Next { inside, at_start, at_end, vague } = self.next_event(&strip, open);
        let Strip { len, trace, height } = &strip;
        let close = AT_RAY * self.unit();
        if at_start && !fresh {
            let ray = ray.plus(close);
            if !self.contact {
                return self.land_at_ray(goal, ray, trace, height, len).then_some(Ending::NextImpact);
            }
            self.event(ray, None);
            return None;
        }
        if let Goal::Time(end) = goal
            && self.ends(end, inside.as_ref(), vague, &strip)
        {
            return Some(Ending::Time);
        }
        let Some(x) = inside else {
            self.advance(None, Off::default(), trace, height);
            if at_end {
                pace.moved = close;
            }
            if at_end && !self.contact {
                self.height = self.height.zero();
            }
            pace.fresh = false;
            return None;
        };
        let off = self.event_error(trace, height, &(x.clone() / len), len, vague);
        let slope = evaluate(&derivative(trace), &(x.clone() / len)).to_f64() / len.to_f64();
        self.advance(Some((&x, true)), off, trace, height);
        if self.contact {
            self.event(off, Some(slope));
            return None;
        }
        self.at_ray = false;
        self.land(goal, off).then_some(Ending::NextImpact)
    }

    /// Finds the next event in a strip; where the bound leaves one `open`, the roundings alone decide.
    fn next_event(&self, Strip { len, trace, height }: &Strip<S>, open: bool) -> Next<S> {
        let unit = self.unit();
        let (noise, found) = if self.contact {
            let fall: Vec<S> = trace.iter().map(|term| -term.clone()).collect();
            let most = if open { f64::INFINITY } else { self.trace_error() };
            let noise = self.noise().min(most).max(unit * 16.0 * bound(trace, 0));
            (noise, first_descent(&self.medium.basis, &fall, noise))
        } else {
            let noise = self.height_noise(len.to_f64(), open).max(unit * 16.0 * bound(height, 0));
            (noise, first_descent(&self.medium.basis, height, noise))
        };
        // If the noise hides the root, both the function and its error bound are off by the noise.
        let vague = if found.as_ref().is_some_and(|(_, vague)| *vague) { 2.0 * noise } else { 0.0 };
        let found = found.map(|(x, _)| if self.proof.is_some() { on_grid(x * len) } else { x * len });
        let nearby = |x: &S| x.to_f64() <= AT_RAY * unit;
        let at_start = found.as_ref().is_some_and(&nearby);
        let at_end = found.as_ref().is_some_and(|x| nearby(&(len.clone() - x)));
        Next { inside: found.filter(|_| !at_start && !at_end), at_start, at_end, vague }
    }

    /// Returns whether the run ends at the time `end` in this strip, before the event at `found`; marches up to it.
    fn ends(&mut self, end: &S, found: Option<&S>, vague: f64, Strip { len, trace, height }: &Strip<S>) -> bool {
        let left = end.clone() - self.state.time();
        if let Some(x) = found.filter(|x| ((*x).clone() - &left).to_f64().abs() < NEAR_END) {
            let off = self.event_error(trace, height, &(x.clone() / len), len, vague);
            if (x.clone() - &left).to_f64().abs() <= self.budget.better(off) {
                self.not_told(left.to_f64(), Near::End, 0.0);
            }
        }
        let rounding = 8.0 * self.unit() * end.to_f64().max(1.0);
        if left.to_f64() <= rounding {
            // The strip after a release proves it: a run that ends with a release looks that far ahead.
            let cut = found.map(|x| x.clone() / x.double(2.0));
            let cut = cut.as_ref().map(|cut| (cut, false));
            self.prove(|proof, run| proof.last_release(run, cut, trace, height));
            return true;
        }
        // Where only roundings separate the next ray from the end of the run, that ray may bring a release.
        let ends = (len.clone() - &left).to_f64() > rounding && found.is_none_or(|x| *x > left);
        if ends {
            self.advance(Some((&left, false)), Off::default(), trace, height);
        }
        ends
    }

    /// Returns the unit roundoff.
    fn unit(&self) -> f64 {
        self.height.log2_roundoff().exp2()
    }

    /// Begins a round trip: stores a checkpoint, and computes anew the values that are summed up during a round trip.
    fn new_round(&mut self) {
        self.weigh();
        if self.flight.is_some() {
            self.ground = self.medium.ground_of(&self.state);
            self.prove(|proof, run| proof.round(&run.state));
        }
        let (index, flight) = (self.pieces.len(), self.flight);
        self.checkpoints.push(Checkpoint { index, flight, state: self.state.clone(), ground: self.ground.clone() });
    }

    /// Records that a displaced ray passes the ground: in flight the velocity jumps at the wrong time.
    fn pass_ray(&mut self, trace: &[S], off: Off) {
        let now = at_zero(trace, &self.height.zero());
        let jump = self.last_trace.as_ref().map_or(2.0 * self.state.bound(), |last| (now - last).to_f64().abs());
        self.budget.pass(jump, off);
    }

    /// Computes `v_t + c v_x` at the ground and, in flight, `v(0,·)` over the strip.
    fn over(&self, len: &S) -> (Vec<S>, Vec<S>) {
        let mut trace = self.medium.trace(&self.state, self.contact);
        if self.contact {
            return (trace, Vec::new());
        }
        let centre = self.centre();
        let longer: Vec<S> = trace.iter().cloned().chain([len.zero()]).collect();
        let start = if centre.is_some() { &self.ground } else { &self.height };
        let mut height = self.medium.basis.primitive(&longer, len, start);
        if let Some(centre) = centre {
            let (rise, rate) = self.medium.rigid(&centre, len);
            add(&mut height, rise);
            add(&mut trace, rate);
        }
        (trace, height)
    }

    /// Marches over the first segment, or its part before `cut`; the flag beside `cut` says whether an event ends it.
    fn advance(&mut self, cut: Option<(&S, bool)>, off: Off, trace: &[S], height: &[S]) {
        self.prove(|proof, run| proof.strip(run, cut, trace, height));
        let cut = cut.map(|(cut, _)| cut);
        let from = self.state.time();
        let whole = self.state.segments[0].len.clone();
        let (mut trace, mut height) = (trace.to_vec(), height.to_vec());
        if let Some(cut) = cut {
            let fraction = cut.clone() / &whole;
            let part = |c: &[S]| self.medium.basis.restrict(c, &fraction.zero(), &fraction, c.len());
            trace = part(&trace);
            height = if height.is_empty() { height } else { part(&height) };
            self.medium.cut_first(&mut self.state, cut, off);
        }
        let len = cut.cloned().unwrap_or(whole);
        let zero = len.zero();
        if !self.contact {
            self.height = at_one(&height, &zero);
        }
        self.last_trace = Some(at_one(&trace, &zero));
        let segments = self.state.segments.len();
        self.crossed += segments as u64 + 2;
        let (mut proof, medium) = (self.proof.take(), self.medium);
        medium.strip(&mut self.state, self.contact, &mut |cell| {
            if let Some(proof) = &mut proof {
                proof.cell(medium, cell);
            }
        });
        self.proof = proof;
        let joined = segments - self.state.segments.len();
        self.prove(|proof, run| proof.joins(run.medium, joined));
        self.budget.add((joined as f64 + if cut.is_some() { CUT_CELLS } else { 0.0 }) * self.cell_error);
        if let Some((centre, _)) = self.centre() {
            self.ground = self.height.clone() - centre;
            self.budget.note_end(self.height_error(0.0));
        }
        self.budget.strip(len.to_f64(), self.cell_error, self.contact);
        let cut = cut.is_some();
        self.pieces.push(Piece { cut, trace, height, ..Piece::new(from, len, self.contact, self.flight) });
    }
}

fn add<S: RoundedSpecial>(target: &mut Vec<S>, series: Vec<S>) {
    if target.len() < series.len() {
        target.resize(series.len(), series[0].zero());
    }
    for (t, s) in target.iter_mut().zip(series) {
        *t = t.clone() + s;
    }
}
