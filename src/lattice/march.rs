//! The march over round trips: its limits, its state and its ending. `ground` holds the contact law.

use std::ops::ControlFlow;

use super::start::{Scaled, Units};
use super::trace::{GroundEvent, Place, Trace};
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Bounded, Open};
use crate::problem::{Parameters, Problem, Top};
use crate::reason::Reason;

/// Maximum number of round trips skipped at once; the arithmetic of trip numbers stays in range.
const MOST_LEAPT: usize = if usize::BITS < 64 { usize::MAX >> 2 } else { usize::MAX >> 12 };

/// Limits of a march.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Maximum number of stored pieces.
    pub pieces: usize,
    /// The first round trip that will be queried; until then the march keeps only the last two stored trips.
    pub keep_from: usize,
}

impl Limits {
    /// Returns limits that drop all that queries about `time` or later do not need.
    pub fn keeping_from(problem: &Problem, time: f64) -> Self {
        let trips = Parameters::<f64>::of(problem, &()).map_or(0.0, |rod| time / rod.round_trip());
        // One trip is subtracted, in case rounding moves the time into the next trip.
        Limits { keep_from: (trips.clamp(1.0, 1e15) - 1.0) as usize, ..Limits::default() }
    }
}

impl Default for Limits {
    /// Returns a limit of ten million pieces: under a gigabyte in double precision.
    fn default() -> Self {
        Limits { pieces: 10_000_000, keep_from: 0 }
    }
}

/// End condition of a march.
#[derive(Clone, Debug)]
pub enum Until<N> {
    /// This many contacts, each with the flight after it.
    Contacts(u32),
    /// This age of this round trip, included.
    Time {
        /// The round trip, from 0.
        trip: usize,
        /// The age in it.
        age: N,
    },
}

/// Position and reason of the end of a march.
#[derive(Clone, Debug)]
pub struct Halt<N> {
    /// The round trip, from 0.
    pub trip: usize,
    /// The age in it.
    pub age: N,
    /// The reason. Everything before an undecided comparison or an irrational landing is valid.
    pub ending: Ending,
}

/// Reason to end the march inside a stretch.
pub(super) enum Stop<N> {
    /// An undecided comparison.
    Open,
    /// Any other ending.
    Halt(Halt<N>),
}

impl<N> From<Open> for Stop<N> {
    fn from(_: Open) -> Self {
        Stop::Open
    }
}

/// The motion of the ground end: the result of a march.
#[derive(Clone, Debug)]
pub struct GroundMotion<N> {
    /// The ground trace.
    pub trace: Trace<N>,
    /// Impacts and releases.
    pub events: Vec<GroundEvent<N>>,
    /// Position and reason of the end.
    pub halt: Halt<N>,
    /// Number of contacts, dropped ones included.
    pub contacts: u32,
    /// The greatest error bound in roundoffs: of any line, relative to the greatest speed of the start, or of any
    /// height, relative to the greatest height.
    pub relative_error: f64,
    /// The first round trip with a decision whose bound exceeds half of the digits: later events are undetermined.
    pub undetermined: Option<usize>,
    /// The first round trip in which two events, or an event and a break, are one only within their bounds.
    pub coincidence: Option<usize>,
}

pub(super) struct March<'a, N> {
    pub(super) problem: &'a Scaled<N>,
    pub(super) trace: Trace<N>,
    pub(super) events: Vec<GroundEvent<N>>,
    pub(super) until: &'a Until<N>,
    pub(super) contact: bool,
    pub(super) contacts: u32,
    /// `v(0,·)`.
    pub(super) height: N,
    /// Whether `v(0,·)` is zero, in contact or not.
    pub(super) touches: bool,
    /// `q` and its slope just before the break.
    pub(super) arriving_q: N,
    pub(super) arriving_slope: N,
    /// Deviation in time of a touch at the break.
    pub(super) early: Option<N>,
    pub(super) relative_error: f64,
    pub(super) undetermined: Option<usize>,
    pub(super) coincidence: Option<usize>,
    /// `u^{−1/2}`: half of the digits, in roundoffs.
    pub(super) half_digits: f64,
    pub(super) greatest_speed: f64,
    /// The greatest height, but at least `greatest_speed`: the height gained at that speed in one round trip.
    pub(super) greatest_height: f64,
    pub(super) zero: N,
}

/// Marches `problem` over round trip after round trip. `observe` receives the number of trips, or of contacts if
/// [`Until::Contacts`] is given, and the number of pieces. It may end the march.
///
/// **Accuracy**: *exact* in fractions, *enclosure* in intervals; otherwise *within the bounds* that the numbers carry.
///
/// **Errors**: [`Error::TooManyPieces`]; [`Error::Interrupted`] by `observe`; [`Error::Open`] if an enclosure leaves
/// open whether the rod touches the ground at the start.
pub fn march<N: Bounded>(
    problem: &Scaled<N>,
    until: &Until<N>,
    limits: Limits,
    observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
) -> Result<GroundMotion<N>, Error> {
    let zero = problem.gravity.zero();
    let mut state = March {
        problem,
        trace: Trace::new(&problem.before, problem.top, problem.gravity.clone()),
        events: Vec::new(),
        until,
        contact: false,
        contacts: 0,
        height: problem.ground_start.clone(),
        touches: problem.ground_start.vanishes()?,
        arriving_q: problem.ground_velocity.clone(),
        arriving_slope: zero.clone(),
        early: None,
        relative_error: 0.0,
        undetermined: None,
        coincidence: None,
        half_digits: (-zero.log2_roundoff() / 2.0).exp2(),
        greatest_speed: problem.greatest_speed(),
        greatest_height: problem.greatest_speed(),
        zero,
    };
    let mut quiet_since = 0;
    let mut forgotten = 0;
    let mut trip = 0;
    let halt = loop {
        let (events, height) = (forgotten + state.events.len(), state.height.clone());
        if let Err(halt) = state.trip() {
            break halt;
        }
        trip += 1;
        let quiet = forgotten + state.events.len() == events;
        if !quiet {
            quiet_since = trip;
        }
        if state.trace.count() > limits.pieces {
            let time = problem.units.round_trip.to_f64() * trip as f64;
            return Err(Error::TooManyPieces { limit: limits.pieces, time });
        }
        let done = if matches!(until, Until::Contacts(_)) { state.contacts as usize } else { trip };
        if observe(done, state.trace.count()).is_break() {
            return Err(Error::Interrupted);
        }
        if trip + 1 < limits.keep_from {
            state.trace.forget();
            let old = state.events.partition_point(|event| event.trip + 1 < trip);
            forgotten += old;
            state.events.drain(..old);
        }
        // A leap requires a rise of at least two units.
        if quiet && !state.contact && state.height.to_f64() - height.to_f64() >= 2.0 {
            trip += state.leap(trip);
        }
        match until {
            Until::Time { trip: last, age } if *last < trip => {
                break Halt { trip: *last, age: age.clone(), ending: Ending::Time };
            }
            Until::Contacts(_) if trip >= quiet_since + 2 => match state.repeats(&height) {
                Ok(None) => (),
                Ok(Some(halt)) => break halt,
                Err(Open) => break state.open(trip, &height.zero(), state.trace.spread(&state.height)),
            },
            _ => (),
        }
    };
    let March { trace, events, contacts, relative_error, undetermined, coincidence, .. } = state;
    Ok(GroundMotion { trace, events, halt, contacts, relative_error, undetermined, coincidence })
}

impl<N: Bounded> March<'_, N> {
    /// Builds the halt before an undecided comparison at or after this age. Solutions that continue from there may
    /// differ by `spread`, in lattice units.
    pub(super) fn open(&self, trip: usize, age: &N, spread: f64) -> Halt<N> {
        let Units { velocity, round_trip, .. } = &self.problem.units;
        let spread = spread * (velocity.clone() * round_trip).to_f64();
        let ending = Ending::Undecided(Reason::Touch { bits: age.bits().unwrap_or(0), spread });
        // Everything before the beginning of the trip is known even if the age is not.
        Halt { trip, age: if age.is_finite() { age.clone() } else { age.zero() }, ending }
    }

    /// Returns the final halt if the motion repeats for ever: after two round trips without an event it does, up to the
    /// drift of a rod that flies freely without gravity. `height` is the height one trip before.
    fn repeats(&self, height: &N) -> Result<Option<Halt<N>>, Open> {
        let why = Reason::Repeats { contact: self.contact };
        let ending = if self.contact {
            Ending::NoBounce(why)
        } else if self.trace.falls_freely() || (self.problem.top == Top::Free && self.height.below(height)?) {
            return Ok(None);
        } else {
            Ending::NoFurtherImpact(why)
        };
        Ok(Some(Halt { trip: self.trace.trips(), age: self.zero.clone(), ending }))
    }

    /// Skips round trips of a long flight under gravity that repeat trip `trip` up to the fall: as many as surely end
    /// in flight. Returns the number of skipped trips.
    ///
    /// With `D = ∫ q dt` over that trip, `v(0,·)` at age `f` is `v + j (D − f − (j − 1)/2)` after `j` more trips, with
    /// `v ≥ 0`. This is a concave function of `j`, positive up to `k` for every `f ≤ 1` if `D − 1 − (k − 1)/2 > 0`. One
    /// trip is kept in reserve, which also covers the rounding of `D` to a double.
    fn leap(&mut self, trip: usize) -> usize {
        if !self.trace.falls_freely() {
            return 0;
        }
        let one = self.zero.one();
        let mut rise = self.zero.clone();
        let from = Place { index: trip, piece: 0, age: self.zero.clone() };
        let to = Place { index: trip, piece: self.trace.slice(trip).len() - 1, age: one.clone() };
        self.trace.window(&from, &to, &mut |part| rise = rise.clone() + part.integral());
        let safe = (2.0 * rise.to_f64() * (1.0 - 1e-15) - 2.0).max(0.0) as usize;
        let trips = safe.min(MOST_LEAPT);
        if trips < 2 {
            return 0;
        }
        // The beginning of the next trip is j trips after that of this one: v + j (D − 1 − (j − 1)/2).
        let j = rise.int(trips as i64);
        let lift = (rise.clone() - &one - (j.clone() - &one).halved()) * &j;
        // The skipped part includes the highest point of the flight: D²/2.
        self.greatest_height = self.greatest_height.max(rise.to_f64() * rise.to_f64() / 2.0);
        self.height = self.height.clone() + lift;
        self.arriving_q = self.arriving_q.clone() - &j;
        self.trace.repeat(rise, trips);
        trips
    }
}
