//! The answer in the requested numbers.

use super::plan::Plan;
use super::question::{Numbers, Observer};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Float, Interval, Rational};
use crate::problem::Problem;

/// A history in the numbers of its plan.
#[derive(Debug)]
pub(super) enum Solution {
    Double(TypedHistory<f64>),
    Digits(TypedHistory<Float>),
    Exact(TypedHistory<Rational>),
    Certified(TypedHistory<Interval>),
}

/// An event, a parameter or a signal that fractions cannot hold.
#[derive(Clone, Debug, thiserror::Error, PartialEq)]
pub enum ExactnessEnd {
    /// A parameter of the problem.
    #[error("the {quantity} √({square}) is no fraction")]
    Parameter {
        /// Its name.
        quantity: &'static str,
        /// The radicand of its root.
        square: String,
    },
    /// The signals of springs, dashpots and masses, which are exponentials.
    #[error("the signals of springs, dashpots and masses are no fractions")]
    Curves,
    /// An event, as [`Ending::ExactnessEnds`].
    #[error("{0}")]
    Event(Ending),
}

impl Plan {
    /// Solves `problem` in the planned numbers, or in digits after the returned event or parameter ends exactness.
    pub(super) fn solution(
        &self,
        problem: &Problem,
        observe: Observer,
    ) -> Result<(Solution, Option<ExactnessEnd>), Error> {
        let solution = match self.numbers {
            Numbers::Double(_) => Solution::Double(TypedHistory::solve(problem, self, observe)?),
            Numbers::Digits(_) => Solution::Digits(TypedHistory::solve(problem, self, observe)?),
            Numbers::Certified(_) => Solution::Certified(TypedHistory::solve(problem, self, observe)?),
            Numbers::Exact => Solution::Exact(TypedHistory::solve(problem, self, observe)?),
            Numbers::ExactThenDigits(digits) => {
                let end = match TypedHistory::<Rational>::solve(problem, self, observe.clone()) {
                    Err(Error::Irrational { quantity, square }) => ExactnessEnd::Parameter { quantity, square },
                    Err(Error::SoftExact) => ExactnessEnd::Curves,
                    Ok(exact) => match exact.ending() {
                        ending @ Ending::ExactnessEnds { .. } => ExactnessEnd::Event(ending.clone()),
                        _ => return Ok((Solution::Exact(exact), None)),
                    },
                    Err(error) => return Err(error),
                };
                let plan = self.in_numbers(problem, Numbers::Digits(digits));
                return Ok((Solution::Digits(TypedHistory::solve(problem, &plan, observe)?), Some(end)));
            }
        };
        Ok((solution, None))
    }
}
