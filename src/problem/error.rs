//! What is wrong with a problem.

use thiserror::Error;

/// What is wrong with a problem: which value, what was found and what was expected.
///
/// ```
/// use dalembert::{Problem, problem::ProblemErrorKind};
/// let error = Problem::builder().length("1 m").wave_speed(1).impact_speed(3).build().unwrap_err();
/// assert_eq!((error.kind, error.path.as_str()), (ProblemErrorKind::NotANumber, "rod.length"));
/// let expected = "a number such as 3, 0.1, 1e-9 or \"1/3\", without a unit";
/// assert_eq!(error.to_string(), format!("found length = \"1 m\", expected {expected}"));
/// ```
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("found {found}, expected {expected}")]
#[non_exhaustive]
pub struct ProblemError {
    /// Which rule the problem breaks.
    pub kind: ProblemErrorKind,
    /// The value, or the table that lacks one, as a scene file has it: `impact.speed`, `start.velocity[3].x`, `rod`.
    /// It is empty where neither an impact nor a profile is given.
    pub path: String,
    /// What was found, the offending value included.
    pub found: String,
    /// What was expected in its place.
    pub expected: String,
}

/// Which rule a problem breaks.
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
}

impl ProblemError {
    pub(super) fn new(
        kind: ProblemErrorKind,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        ProblemError { kind, path: path.into(), found: found.into(), expected: expected.into() }
    }
}
