//! How far a march goes, what it may take, and why it ends.

use crate::problem::{Parameters, Problem};

/// How much a march may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The greatest number of pieces that is stored.
    pub pieces: usize,
    /// The first round trip that will be asked about: what is two trips older is forgotten on the way.
    pub keep_from: usize,
}

impl Limits {
    /// Forgets what no question about `time` or later needs.
    pub fn keeping_from(problem: &Problem, time: f64) -> Self {
        let trips = Parameters::<f64>::of(problem, &()).map_or(0.0, |rod| time / rod.round_trip());
        // One trip more, in case a rounding puts the time into it.
        Limits { keep_from: (trips.clamp(1.0, 1e15) - 1.0) as usize, ..Limits::default() }
    }
}

impl Default for Limits {
    /// Ten million pieces: under a gigabyte in double precision.
    fn default() -> Self {
        Limits { pieces: 10_000_000, keep_from: 0 }
    }
}

/// How far to march.
#[derive(Clone, Debug)]
pub enum Until<N> {
    /// Through this many contacts, each with the flight after it.
    Contacts(u32),
    /// To this age of this round trip, included.
    Time {
        /// The round trip, from 0.
        trip: usize,
        /// The age in it.
        age: N,
    },
}

/// Why a march ended.
#[derive(Clone, Debug)]
pub enum Halt<N> {
    /// The time asked for.
    Time,
    /// The impact after the contacts asked for.
    NextImpact {
        /// The round trip.
        trip: usize,
        /// The age in it.
        age: N,
    },
    /// In flight, and two round trips have repeated without an event.
    NoFurtherImpact,
    /// In contact, and two round trips have repeated without an event.
    NoBounce,
    /// A comparison of enclosures is open at or after this trip and age: what is there before it holds.
    Open {
        /// The round trip.
        trip: usize,
        /// The age in it.
        age: N,
        /// How far apart two solutions may be that go on from here, see [`super::Trace`], in lattice units.
        spread: f64,
    },
    /// The next landing is at `trip + from + (−q − √disc)/slope`, which is no fraction.
    Irrational {
        /// The round trip.
        trip: usize,
        /// The beginning of the piece, as an age in it.
        from: N,
        /// `q` there.
        q: N,
        /// `dq/dt`.
        slope: N,
        /// `q² − 2 v dq/dt > 0`, no square.
        disc: N,
    },
}

/// What ends the march inside of a stretch.
pub(super) enum Stop<N> {
    /// An open comparison.
    Open,
    /// Anything else.
    Halt(Halt<N>),
}

impl<N> From<crate::number::Open> for Stop<N> {
    fn from(_: crate::number::Open) -> Self {
        Stop::Open
    }
}
