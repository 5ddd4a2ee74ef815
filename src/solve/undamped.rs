//! The undamped rod in numbers of an answer.

use super::Stripped;
use crate::error::Error;
use crate::lattice::{Limits, Undamped};
use crate::number::Answer;
use crate::problem::Problem;

/// An undamped history, computed in numbers that carry their bounds and read without them.
pub type StrippedUndamped<S> = Stripped<S, Undamped<<S as Answer>::Carried>>;

/// The history of `problem`, whose damping is ignored, in doubles, long numbers, fractions or enclosures.
///
/// **Errors**: those of [`Undamped::solve`].
///
/// ```
/// use dalembert::{Motion, Number, Problem, solve::undamped};
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
/// // Corollary 1: at μ = 3 ≥ g t₁ = 2 the contact lasts exactly t₁ = 2.
/// assert_eq!(undamped::<f64>(&problem, &())?.contacts()[0].to, Some(2.0));
/// # Ok::<(), dalembert::Error>(())
/// ```
pub fn undamped<S: Answer>(problem: &Problem, precision: &S::Precision) -> Result<StrippedUndamped<S>, Error> {
    undamped_within(problem, precision, Limits::default(), |_, _| ())
}

/// [`undamped`] with a limit of one's own; `observe` is told the round trip and the pieces so far.
pub fn undamped_within<S: Answer>(
    problem: &Problem,
    precision: &S::Precision,
    limits: Limits,
    observe: impl FnMut(usize, usize),
) -> Result<StrippedUndamped<S>, Error> {
    Undamped::solve_within(problem, precision, limits, observe).map(Stripped::new)
}
