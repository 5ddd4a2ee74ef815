//! The march: how far, with what limits, and what it leaves. The contact law itself is in `contact`.

use super::contact::March;
use super::scaled::Scaled;
use super::trace::{Occurrence, Trace};
use crate::error::Error;
use crate::number::Scalar;
use crate::rod::Top;

/// How much a march may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The greatest number of pieces that is stored.
    pub pieces: usize,
}

impl Default for Limits {
    /// Ten million pieces: under a gigabyte in double precision.
    fn default() -> Self {
        Limits { pieces: 10_000_000 }
    }
}

/// How far to march.
#[derive(Clone, Debug)]
pub enum Until<S> {
    /// Through this many contacts, each with the flight after it.
    Contacts(u32),
    /// To this age of this round trip, included.
    Age(usize, S),
}

/// Why a march ended.
#[derive(Clone, Debug)]
pub enum Halt<S> {
    /// The time asked for.
    Time,
    /// The impact after the contacts asked for, at this trip and age.
    NextImpact(usize, S),
    /// In flight, and two round trips have repeated without an event.
    NoFurtherImpact,
    /// In contact, and two round trips have repeated without an event.
    NoBounce,
    /// A comparison of enclosures is open at or after this trip and age: what is there before it holds.
    Open(usize, S),
    /// The next landing is at `trip + fraction + (−q − √disc)/slope`, which is no fraction.
    Irrational {
        /// The round trip.
        trip: usize,
        /// The beginning of the piece, as an age in it.
        fraction: S,
        /// `q` there.
        q: S,
        /// `dq/dt`.
        slope: S,
        /// `q² − 2 v dq/dt > 0`, no square.
        disc: S,
    },
}

/// What a march leaves.
#[derive(Clone, Debug)]
pub struct Marched<S> {
    /// The ground trace.
    pub trace: Trace<S>,
    /// Impacts and releases.
    pub occurrences: Vec<Occurrence<S>>,
    /// Touches in flight that start no contact: trip and age.
    pub grazes: Vec<(usize, S)>,
    /// Why it ended.
    pub halt: Halt<S>,
    /// The greatest error bound of any piece, in roundoffs. The time of a tangential landing is not among them: it loses
    /// half the digits, while the motion does not.
    pub greatest_error: f64,
    /// The same, relative to the greatest speed of the start, to the greatest height, and to time itself where it is greater than 1.
    pub relative_error: f64,
}

/// Marches `problem` over round trip after round trip. `observe` is told the trip and the number of pieces so far.
///
/// **Accuracy**: *exact* in fractions; otherwise within the bounds that pieces and occurrences carry.
///
/// **Errors**: [`Error::TooManyPieces`].
pub fn march<S: Scalar>(
    problem: &Scaled<S>,
    until: &Until<S>,
    limits: Limits,
    mut observe: impl FnMut(usize, usize),
) -> Result<Marched<S>, Error> {
    let mut state = March {
        trace: Trace::new(problem.before.clone(), problem.top, problem.gravity.clone()),
        unit: problem.gravity.roundoff(),
        occurrences: Vec::new(),
        grazes: Vec::new(),
        contact: false,
        contacts: 0,
        height: problem.ground_start.clone(),
        height_error: if S::RIGOROUS { 0.0 } else { 4.0 * problem.ground_start.to_f64().abs() },
        arriving: problem.ground_velocity.clone(),
        touch_error: 0.0,
        greatest_error: 0.0,
        relative_error: 0.0,
        half_digits: (f64::from(problem.gravity.bits().unwrap_or(0)) / 2.0).exp2(),
        greatest_speed: problem.greatest_speed(),
        greatest_height: problem.greatest_speed(),
    };
    let mut quiet_since = 0;
    let mut trip = 0;
    let halt = loop {
        let (events, height) = (state.occurrences.len(), state.height.clone());
        if let Some(halt) = state.trip(trip, until) {
            break halt;
        }
        trip += 1;
        if state.occurrences.len() != events {
            quiet_since = trip;
        }
        if state.trace.count() > limits.pieces {
            let time = problem.units.round_trip.to_f64() * trip as f64;
            return Err(Error::TooManyPieces { limit: limits.pieces, time });
        }
        observe(trip, state.trace.count());
        // A leap wants a rise of two units; the difference of heights tells well enough whether to look closer.
        let rises = state.height.clone() - &height >= height.int(2);
        if rises && state.occurrences.len() == events && !state.contact {
            trip += state.leap(trip, until);
        }
        // Two round trips without an event repeat for ever, up to the drift of a rod that flies freely without gravity.
        if matches!(until, Until::Contacts(_)) && trip >= quiet_since + 2 {
            let drift = state.height.clone() - height;
            let free_fall = problem.top == Top::Free && !problem.gravity.is_zero();
            if state.contact {
                break Halt::NoBounce;
            }
            if !free_fall && (problem.top == Top::Fixed || !state.negative(&drift, state.height_error)) {
                break Halt::NoFurtherImpact;
            }
        }
    };
    let March { trace, occurrences, grazes, greatest_error, relative_error, .. } = state;
    Ok(Marched { trace, occurrences, grazes, halt, greatest_error, relative_error })
}
