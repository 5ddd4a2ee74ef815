//! How far a march goes, what it may take, and why it ends.

use crate::motion::Ending;
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

/// Where a march ended, and why.
#[derive(Clone, Debug)]
pub struct Halt<N> {
    /// The round trip, from 0.
    pub trip: usize,
    /// The age in it.
    pub age: N,
    /// Why. What is there before an open comparison or an irrational landing holds.
    pub ending: Ending,
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
