//! The errors of the crate.

use crate::regimes::GridError;
use dalembert::number::{Number, NumberError};
use dalembert::problem::ProblemError;
use dalembert::{Error, SceneError};

/// A reason for which a question, a route or a figure has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// An error of the library.
    #[error(transparent)]
    Library(#[from] Error),
    /// A text that spells no number.
    #[error(transparent)]
    Number(#[from] NumberError),
    /// A scene that cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A grid that cannot be built.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The numbers of a figure without the map that it shows.
    #[error("no map")]
    NoMap,
    /// A quantity that the motion does not have.
    #[error("found {quantity} asked of a scene that has none: {why}; expected another quantity")]
    NoSuchQuantity {
        /// The name of the quantity.
        quantity: &'static str,
        /// The reason, in words.
        why: String,
    },
    /// A question that the motion leaves undecided, for this reason.
    #[error("{0}")]
    Undecided(String),
    /// A quantity for which the route has no formula, in such numbers or for such a rod.
    #[error("this route does not give that")]
    NotGiven,
    /// A search without a release.
    #[error("no tensile stress in 64 round trips")]
    NoTensileStress,
    /// A march without a release.
    #[error("no release found")]
    NoRelease,
    /// A march without an event.
    #[error("no event found")]
    NoEvent,
    /// A time at which a march has kept no state.
    #[error("nothing is kept of that time")]
    TimeNotKept,
    /// Integrals that pass their deadline.
    #[error("the nested integrals take too long")]
    TooSlow,
    /// A time that does not suit the quantity.
    #[error("found time {found}, expected {expected}")]
    Time {
        /// The time.
        found: Number,
        /// The times that suit, in words.
        expected: String,
    },
    /// A rod whose round trip has no usual magnitude.
    #[error("found time {0:.2e}, expected a round trip between 1e-300 and 1e300")]
    RoundTrip(f64),
    /// A budget that is no time.
    #[error("found {0} seconds, expected more than 0 and at most 86400")]
    Budget(f64),
}

impl VerifyError {
    /// Builds the error for a quantity that the motion does not have; the question adds the name of the quantity.
    pub(crate) fn none(why: impl Into<String>) -> Self {
        VerifyError::NoSuchQuantity { quantity: "", why: why.into() }
    }
}

impl From<ProblemError> for VerifyError {
    fn from(error: ProblemError) -> Self {
        VerifyError::Library(error.into())
    }
}
