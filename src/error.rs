//! Everything that can be refused, and how it is said.

use thiserror::Error;

use crate::problem::Parameter;

/// Error of the library: what was found, where, and what was expected.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A problem that cannot be built.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A time or a point that is no number.
    #[error("{quantity}: {error}")]
    Spelling {
        /// The time or the point.
        quantity: &'static str,
        /// The error of its text.
        error: crate::number::NumberError,
    },
    /// A fraction cannot hold a square root.
    #[error(
        "exact fractions cannot hold the {quantity} √({square}), expected a square, or digits in place of fractions"
    )]
    Irrational {
        /// The quantity that needs the root.
        quantity: &'static str,
        /// The number under the root.
        square: String,
    },
    /// A question about a time that the history does not reach.
    #[error("found time {found}, expected one between 0 and {end}, where this history ends")]
    TimeOutside {
        /// The time.
        found: String,
        /// The end of the history.
        end: String,
    },
    /// A question about a time after the end of a history that ends for a reason of its own.
    #[error("found time {found}, expected times up to t = {end}: {ending}")]
    BeyondEnd {
        /// The time.
        found: String,
        /// The end of the history.
        end: String,
        /// The reason why it is the end, as the history's ending prints it.
        ending: String,
    },
    /// A question about a time after the last one that fractions reach.
    #[error("found time {found}, expected an earlier one, or digits where fractions end: {ending}")]
    BeyondExactness {
        /// The time.
        found: String,
        /// The event before which exactness ends, as the history's ending prints it.
        ending: String,
    },
    /// A question about a time that the march has gone past and forgotten.
    #[error("found time {found}, expected one from {start} on: what was before is forgotten")]
    TimeForgotten {
        /// The time.
        found: String,
        /// The first time that is still known.
        start: String,
    },
    /// A question about a point outside of the rod.
    #[error("found point {found}, expected one between 0 and {length}, the rod's length")]
    PointOutside {
        /// The point.
        found: String,
        /// The length of the rod.
        length: String,
    },
    /// A quantity that has no value at a time.
    #[error("found {quantity} asked at times, expected a quantity over time, such as u_end")]
    NotOverTime {
        /// Its name.
        quantity: &'static str,
    },
    /// A quantity that has no value at a point.
    #[error("found {quantity} asked at points, expected a quantity along the rod, such as strain")]
    NotAlong {
        /// Its name.
        quantity: &'static str,
    },
    /// The history has more pieces than the limit allows.
    #[error(
        "the history passed {limit} pieces at t = {time:?}; expected fewer: ask for a shorter time, for fewer impacts \
         of a rod, or for a greater run.pieces of a chain"
    )]
    TooManyPieces {
        /// The limit.
        limit: usize,
        /// The time at which it was passed.
        time: f64,
    },
    /// Damping so strong that a first contact without a closed form takes too many cells.
    #[error(
        "found r t₁ = {found} with a start or a top that has no closed form, expected at most {most}: cells must not \
         be wider than the waves reach; a uniform start on the ground under a free top has no such limit"
    )]
    DampingTooStrong {
        /// `r t₁`.
        found: f64,
        /// The most that is marched.
        most: f64,
    },
    /// A damped scene has no exact fractions.
    #[error(
        "found damping = {damping} in fractions, expected an undamped rod: Bessel functions are no fractions; ask for \
        digits"
    )]
    DampedExact {
        /// The damping.
        damping: String,
    },
    /// An accuracy outside of its range.
    #[error("found accuracy {found:?}, expected one between 1e-15 and 0.1 for doubles; digits give more")]
    Accuracy {
        /// The number that was asked for.
        found: f64,
    },
    /// No digits, or absurdly many.
    #[error("found {found} digits asked for, expected 1 to {most}")]
    Digits {
        /// The number that was asked for.
        found: u32,
        /// The most that is given.
        most: u32,
    },
    /// Comparisons of enclosures stay open.
    #[error(
        "{digits} digits are not proved with {bits} bits: two events cannot be told apart, or a landing from a graze; \
         expected a run that ends before them"
    )]
    Undecided {
        /// The number that was asked for.
        digits: u32,
        /// The number of bits that was tried.
        bits: u32,
    },
    /// Digits that the greatest number of bits does not settle.
    #[error(
        "{digits} digits are not settled with {bits} bits; expected a shorter run, fewer digits, or certified ones, \
        which come with exact roots"
    )]
    Unsettled {
        /// The number that was asked for.
        digits: u32,
        /// The number of bits that was tried.
        bits: u32,
    },
    /// The rays of a damped rod.
    #[error("found the rays of a damped rod asked for, expected an undamped one: only there jumps travel unchanged")]
    NoRays,
    /// A grid for averages or projections.
    #[error("found {found}, expected a grid of two points or more that increase")]
    Grid {
        /// The points, in words.
        found: String,
    },
    /// A body of a chain, or a spring or a mass in one, in a build without the feature `chain`.
    #[error(
        "found a body of a chain, or a chain with springs or masses, expected a single rod or rigid joints: this build \
         solves no others"
    )]
    NoChains,
    /// The travelling waves of a damped rod, or of a body of a chain.
    #[error("found a damped rod or a body of a chain, expected an undamped rod by itself, which two waves describe")]
    NoWaves,
    /// Exact fractions of a chain with springs, dashpots or masses.
    #[error(
        "found a chain with springs, dashpots or masses in fractions, expected digits: \
         its signals are exponentials, which are no fractions"
    )]
    SoftExact,
    /// Lines of a chain with springs, dashpots or masses.
    #[error(
        "found a chain with springs, dashpots or masses, expected rigid joints and bars: \
         its velocity and stress are no lines between rays"
    )]
    Curved,
    /// A contact that the history does not have.
    #[error("found contact number {} asked for, expected one of the {found} contacts of the history", contact + 1)]
    NoContact {
        /// Its index, from 0.
        contact: usize,
        /// The number of contacts.
        found: usize,
    },
    /// A number of a contact that lasts to the end of the history.
    #[error("contact number {} lasts to the end of the history", contact + 1)]
    ContactLasts {
        /// Its index, from 0.
        contact: usize,
    },
    /// A start or a top for which the first contact has no closed form.
    #[error(
        "found a gap, a start that is not uniform, or a fixed top; expected a uniform start on the ground under a free \
         top, whose first contact has a closed form"
    )]
    NoClosedForm,
    /// A derivative that there is not, or not in these numbers.
    #[error("found the derivative by {parameter} asked for, expected {expected}")]
    Derivative {
        /// The value by which it was to be taken.
        parameter: Parameter,
        /// A problem or numbers that have it, in words.
        expected: &'static str,
    },
    /// The observer of a run ended it.
    #[error("interrupted")]
    Interrupted,
    /// A comparison of enclosures that their ends do not settle.
    #[error(transparent)]
    Open(#[from] crate::number::Open),
    /// A question that this many bits do not settle.
    #[error("with {bits} bits it is not decided {what}; expected more bits")]
    NotDecided {
        /// The question that is open.
        what: &'static str,
        /// The bits of the enclosures.
        bits: u32,
    },
}

impl Error {
    /// [`Error::NotDecided`], which counts as an open comparison.
    pub(crate) fn not_decided(what: &'static str, bits: Option<u32>) -> Self {
        Error::NotDecided { what, bits: bits.unwrap_or(0) }
    }
}

/// Error of a problem: the value, what was found and what was expected.
///
/// ```
/// use dalembert::Problem;
/// use dalembert::problem::ProblemErrorKind;
/// let error = Problem::builder().length("1 m").wave_speed(1).impact_speed(3).build().unwrap_err();
/// assert_eq!((error.kind, error.path.as_str()), (ProblemErrorKind::NotANumber, "rod.length"));
/// let expected = "a number such as 3, 0.1, 1e-9 or \"1/3\", without a unit";
/// assert_eq!(error.to_string(), format!("found length = \"1 m\", expected {expected}"));
/// ```
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("found {found}, expected {expected}")]
#[non_exhaustive]
pub struct ProblemError {
    /// The rule that the problem breaks.
    pub kind: ProblemErrorKind,
    /// The value, or the table that lacks one, as a scene file has it: `impact.speed`, `start.velocity[3].x`, `rod`.
    /// It is empty where neither an impact nor a profile is given.
    pub path: String,
    /// Description of the value that was found.
    pub found: String,
    /// Description of a value that is accepted.
    pub expected: String,
}

/// A rule that a problem, or the scene that it is read from, breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemErrorKind {
    /// A value that this problem needs and does not have.
    Missing,
    /// A text or a double that is no usable number.
    NotANumber,
    /// A value outside of its range.
    OutOfRange,
    /// Two values that exclude each other.
    Contradiction,
    /// A start whose points do not run along the rod.
    Profile,
    /// Values that are each possible, in a combination that double precision cannot hold.
    Combination,
    /// A scene that is longer than the limit.
    TooLong,
    /// A scene that is not TOML.
    Syntax,
    /// A key that no scene has.
    UnknownKey,
    /// A value of a scene of the wrong type.
    WrongType,
}

impl ProblemError {
    pub(crate) fn new(
        kind: ProblemErrorKind,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        ProblemError { kind, path: path.into(), found: found.into(), expected: expected.into() }
    }

    /// Builds the error of a start that has a strain at `path` and a displacement too.
    pub(crate) fn strain_and_displacement(path: &str) -> Self {
        let expected = "one of them: the strain is the displacement's slope";
        ProblemError::new(ProblemErrorKind::Contradiction, path, "strain as well as displacement", expected)
    }
}
