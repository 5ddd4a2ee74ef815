//! The answer in the requested numbers.

use super::ladder::Target;
use super::plan::Plan;
use super::question::{Numbers, Observer};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Float, Interval, Rational};
use crate::problem::Problem;

/// A history in the numbers of its plan. All variants exist in every build; a build without the feature `mp` yields
/// only doubles and fractions.
#[derive(Debug)]
pub enum Solution {
    /// Doubles.
    Double(TypedHistory<f64>),
    /// Decimal digits, this many of which are printed.
    Digits(TypedHistory<Float>, u32),
    /// Fractions.
    Exact(TypedHistory<Rational>),
    /// Digits of the whole run, this many of which are printed, and the event or parameter that is irrational.
    DigitsAfter(TypedHistory<Float>, u32, ExactnessEnd),
    /// Enclosures, with this many proved digits.
    Certified(TypedHistory<Interval>, u32),
}

/// An operation on a history in any number system.
pub trait Visitor {
    /// Result of the operation.
    type Output;

    /// Performs the operation on `history`.
    fn visit<S: Target>(self, history: &TypedHistory<S>) -> Self::Output;
}

impl Solution {
    /// Returns the result of `visitor` for the history.
    pub fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        match self {
            Solution::Double(history) => visitor.visit(history),
            Solution::Exact(history) => visitor.visit(history),
            Solution::Digits(history, _) | Solution::DigitsAfter(history, ..) => visitor.visit(history),
            Solution::Certified(history, _) => visitor.visit(history),
        }
    }

    /// Returns the number of printed digits; 0 for doubles and fractions.
    pub fn digits(&self) -> u32 {
        match self {
            Solution::Double(_) | Solution::Exact(_) => 0,
            Solution::Digits(_, digits) | Solution::DigitsAfter(_, digits, _) | Solution::Certified(_, digits) => {
                *digits
            }
        }
    }

    /// Returns the event or parameter that fractions cannot hold, if digits of the whole run replace the fractions.
    pub fn exactness_end(&self) -> Option<&ExactnessEnd> {
        match self {
            Solution::DigitsAfter(_, _, end) => Some(end),
            _ => None,
        }
    }
}

/// An event or a parameter that fractions cannot hold.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactnessEnd {
    /// A parameter of the problem.
    Parameter {
        /// Its name.
        quantity: &'static str,
        /// The radicand of its root.
        square: String,
    },
    /// An event, as [`Ending::ExactnessEnds`].
    Event(Ending),
}

impl std::fmt::Display for ExactnessEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ExactnessEnd::Parameter { quantity, square } => write!(f, "the {quantity} √({square}) is no fraction"),
            ExactnessEnd::Event(ending) => ending.fmt(f),
        }
    }
}

impl Plan {
    /// Solves `problem`; see [`Observer`] for what `observe` receives.
    ///
    /// **Accuracy**: that of [`Plan::numbers`].
    ///
    /// **Errors**: [`Error::TooManyPieces`]; [`Error::Irrational`] if a parameter is irrational and no digits are
    /// requested; [`Error::Unsettled`], [`Error::Undecided`] if no affordable number of bits settles the answer;
    /// [`Error::Interrupted`] by `observe`.
    ///
    /// ```
    /// use dalembert::{Numbers, Plan, Problem, Question, Solution};
    /// use std::{ops::ControlFlow, sync::Arc};
    /// let problem = Problem::uniform(10.into(), 30.into(), 10.into(), 10.into());
    /// let plan = Plan::of(&problem, &Question::run(Numbers::default()))?;
    /// let observe = Arc::new(|_, _| ControlFlow::Continue(()));
    /// let Solution::Double(motion) = plan.solve_typed(&problem, observe)? else { unreachable!() };
    /// assert!((motion.contacts()[0].release.unwrap() - 2.0 / 3.0).abs() < 1e-15);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn solve_typed(&self, problem: &Problem, observe: Observer) -> Result<Solution, Error> {
        Ok(match self.numbers {
            Numbers::Double(_) => Solution::Double(TypedHistory::solve(problem, self, observe)?),
            Numbers::Digits(digits) => Solution::Digits(TypedHistory::solve(problem, self, observe)?, digits),
            Numbers::Certified(digits) => Solution::Certified(TypedHistory::solve(problem, self, observe)?, digits),
            Numbers::Exact => Solution::Exact(TypedHistory::solve(problem, self, observe)?),
            Numbers::ExactThenDigits(digits) => {
                let in_digits = |end: ExactnessEnd| {
                    let motion = TypedHistory::solve(problem, &self.in_digits(problem, digits), observe.clone())?;
                    Ok(Solution::DigitsAfter(motion, digits, end))
                };
                match TypedHistory::<Rational>::solve(problem, self, observe.clone()) {
                    Err(Error::Irrational { quantity, square }) => {
                        return in_digits(ExactnessEnd::Parameter { quantity, square });
                    }
                    Err(error) => return Err(error),
                    Ok(exact) => match exact.ending() {
                        Ending::ExactnessEnds { .. } => return in_digits(ExactnessEnd::Event(exact.ending().clone())),
                        _ => Solution::Exact(exact),
                    },
                }
            }
        })
    }
}
