//! Derivatives of the numbers of a history with respect to a value of the problem, from both sides.

use super::plan::Plan;
use super::question::{Observer, Want};
use super::rung::Rung;
use crate::error::Error;
use crate::motion::{Motion, Side};
use crate::number::{Dual, Estimate, Float, Number, Rational, Scalar};
use crate::problem::{Parameter, Problem};
use crate::quantity::{self, Measure, Quantity, UnitSystem, Units};

/// The derivative of a number of a history with respect to a value of the problem.
///
/// ```
/// use dalembert::{Parameter, Problem, Quantity};
/// let rod = Problem::builder().length(2).wave_speed(1).gravity(1).impact_speed(5).build()?;
/// // Corollary 1: t_b = 2L/c.
/// let times = rod.exact()?.derivatives(Parameter::Length, &[Quantity::EventTime])?;
/// assert_eq!(times[1][0].as_ref().and_then(|by| by.value()), Some(&2.into()));
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Derivative<S> {
    /// Equal derivatives from both sides, or the only one: a damping of zero can only grow.
    One(S),
    /// Different derivatives: an event meets a ray, and precedes it on one side and follows it on the other.
    Sides {
        /// Derivative as the value grows towards that of the problem.
        left: Result<S, NoDerivative>,
        /// Derivative as the value grows beyond that of the problem.
        right: Result<S, NoDerivative>,
    },
}

/// Reason for the absence of a derivative on a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum NoDerivative {
    /// Difference quotients grow without bound as steps shrink, but slower than the inverse step: next to a touch.
    Infinite,
    /// The number jumps, or belongs to another event.
    Jumps,
    /// The tried numbers do not determine the derivative; in fractions, first order does not.
    #[strum(serialize = "not settled")]
    Unsettled,
}

impl NoDerivative {
    /// Returns the name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Derivatives by row and column; `None` for a missing number.
pub type Derivatives<S> = Vec<Vec<Option<Derivative<S>>>>;

/// Derivatives as a number system computes them.
#[derive(Debug)]
pub struct Computed<S> {
    pub(super) rows: Derivatives<S>,
    /// Whether the errors are estimates: the derivatives come from runs with other values.
    pub(super) is_estimated: bool,
}

/// Numbers by row and column; `None` for a missing number.
pub(super) type Rows<S> = Vec<Vec<Option<S>>>;

/// Applies `f` to each existing number with its row and column.
pub(super) fn of_each<S, T>(rows: &Rows<S>, mut f: impl FnMut((usize, usize), &S) -> T) -> Rows<T> {
    rows.iter()
        .enumerate()
        .map(|(i, row)| {
            row.iter().enumerate().map(|(j, number)| number.as_ref().map(|number| f((i, j), number))).collect()
        })
        .collect()
}

/// Removes the derivatives of rows of events or contacts on sides where the time, which comes first, has none: another
/// event is in that place there.
pub(super) fn of_same_events<S>(rows: Derivatives<S>) -> Derivatives<S> {
    let row = |row: Vec<Option<Derivative<S>>>| {
        let time = row.first().and_then(Option::as_ref);
        let other: [Option<NoDerivative>; 2] = time
            .map_or([None; 2], |time| time.sides().map(|side| side.err().filter(|why| *why != NoDerivative::Infinite)));
        let limited = |derivative: Derivative<S>| match (other, derivative) {
            ([None, None], derivative) => derivative,
            ([left, right], Derivative::Sides { left: own_left, right: own_right }) => {
                Derivative::Sides { left: left.map_or(own_left, Err), right: right.map_or(own_right, Err) }
            }
            ([Some(left), Some(right)], Derivative::One(_)) => Derivative::Sides { left: Err(left), right: Err(right) },
            ([None, Some(right)], Derivative::One(own)) => Derivative::Sides { left: Ok(own), right: Err(right) },
            ([Some(left), None], Derivative::One(own)) => Derivative::Sides { left: Err(left), right: Ok(own) },
        };
        row.into_iter().map(|cell| cell.map(limited)).collect()
    };
    rows.into_iter().map(row).collect()
}

pub(super) fn at<S>(rows: &Rows<S>, (row, column): (usize, usize)) -> Option<&S> {
    rows.get(row)?.get(column)?.as_ref()
}

/// Maximum error of a derivative in doubles, relative to its size plus its natural size.
const WANTED: f64 = 1e-5;

/// Returns whether the bound of a derivative in doubles is small enough, given its `natural` size.
pub(super) fn is_settled(found: &Estimate<f64>, natural: f64) -> bool {
    found.bound() <= WANTED * (found.value().abs() + natural)
}

/// A problem or a chain, with the values that derivatives are taken by.
pub(super) trait Varying: Sized + Sync {
    /// Returns a value.
    ///
    /// **Errors**: it has no such value.
    fn value_in<S: Scalar>(&self, by: Parameter, precision: &S::Precision) -> Result<S, Error>;
    /// Returns it with a value greater by the part `step` of its size, or by `step` times [`Varying::scale_of_zero`]
    /// where the value is zero; `None` if there is none.
    fn moved(&self, by: Parameter, step: &Rational) -> Option<Self>;
    /// Returns whether a value is zero and has no smaller values.
    fn only_grows(&self, by: Parameter) -> bool;
    /// Returns the scale of a step from zero.
    fn scale_of_zero(&self, by: Parameter) -> Number;
    /// Returns the power of the value that [`Varying::moved`] moves.
    fn power(&self, by: Parameter) -> i64;
    /// Returns the decimal exponent of the first step of a value of zero, if it must not be that of the digits.
    fn first_exponent(&self, _: Parameter) -> Option<u32> {
        None
    }
}

/// Decimal exponent of the first step of a gravity of zero: a gravity this weak, squared, still brings a rod down.
const WEAKEST: u32 = 6;

impl Varying for Problem {
    fn value_in<S: Scalar>(&self, by: Parameter, precision: &S::Precision) -> Result<S, Error> {
        by.value_in(self, precision)
    }
    fn moved(&self, by: Parameter, step: &Rational) -> Option<Self> {
        by.moved(self, step)
    }
    fn only_grows(&self, by: Parameter) -> bool {
        by.only_grows(self)
    }
    fn scale_of_zero(&self, by: Parameter) -> Number {
        by.scale_of_zero(self)
    }
    fn power(&self, by: Parameter) -> i64 {
        by.power(self)
    }
    fn first_exponent(&self, by: Parameter) -> Option<u32> {
        Some(WEAKEST).filter(|_| by == Parameter::Gravity)
    }
}

/// A request for derivatives of numbers of a problem or a chain.
pub(super) trait Request: Sync {
    /// A problem or a chain.
    type Of: Varying;

    fn of(&self) -> &Self::Of;
    fn by(&self) -> Parameter;
    /// Returns whether a number is missing if the rod is too short for its point: then only one side exists.
    fn is_stretched(&self) -> bool;
    /// Returns the numbers of another problem or chain to twice as many digits as `exponent`, and the natural scale of
    /// each column.
    fn long_rows(&self, of: &Self::Of, exponent: u32) -> Result<(Rows<Estimate<Float>>, Vec<f64>), Error>;
    /// Returns the numbers in fractions.
    fn exact_rows(&self) -> Result<Rows<Rational>, Error>;
    /// Returns the numbers in fractions with their rates, for a growing value or, with the sign −1, a shrinking one;
    /// and whether first order settles them.
    fn rated_rows(&self, value: &Rational, sign: i64) -> Result<(Rows<Dual<Rational>>, bool), Error>;
}

/// A request for derivatives of numbers of a rod.
pub struct Asked<'a> {
    pub(super) problem: &'a Problem,
    pub(super) plan: &'a Plan,
    /// The rung that settled the run of these numbers.
    pub(super) rung: Rung,
    /// The question for a run with another value.
    pub(super) want: Want,
    pub(super) observe: &'a Observer,
    pub(super) by: Parameter,
    pub(super) quantities: &'a [Quantity],
    /// Times and points of the values; `None` for values of a list.
    pub(super) at: Option<At<'a>>,
}

/// Times, points of the rod for quantities that have one, and the side of the limit.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) times: &'a [Number],
    pub(super) points: &'a [Number],
    pub(super) side: Side,
}

impl Asked<'_> {
    /// Returns the numbers to be differentiated, in units of `problem`: a row for each entry of the list, or for each
    /// time and, within it, each point.
    pub(super) fn values<S: Scalar>(&self, problem: &Problem, motion: &dyn Motion<S>) -> Result<Rows<S>, Error> {
        let units = Units::new(problem, UnitSystem::default());
        let Some(At { times, points, side }) = self.at else {
            return quantity::values(motion, self.quantities, &units);
        };
        let precision = motion.end().precision();
        let lift = |list: &[Number]| -> Vec<S> { list.iter().map(|number| S::spelling(number, &precision)).collect() };
        let times = lift(times);
        if !points.is_empty() {
            return quantity::columns_along(motion, &units, self.quantities, (&lift(points), &times), side);
        }
        let rows = |times: &[S]| {
            let table = quantity::columns(motion, &units, self.quantities, times, Some(side))?;
            Ok((0..times.len()).map(|row| table.iter().map(|column| Some(column[row].clone())).collect()).collect())
        };
        match rows(&times) {
            // The run may end earlier with another value.
            Err(Error::TimeOutside { .. }) => {
                let none = || vec![self.quantities.iter().map(|_| None).collect()];
                let row = |time: &S| match rows(std::slice::from_ref(time)) {
                    Err(Error::TimeOutside { .. }) => Ok(none()),
                    found => found,
                };
                Ok(times.iter().map(row).collect::<Result<Vec<_>, _>>()?.concat())
            }
            found => found,
        }
    }

    /// Returns the numbers with the natural scale of each column.
    pub(super) fn scaled<S: Scalar>(
        &self,
        problem: &Problem,
        motion: &dyn Motion<S>,
    ) -> Result<(Rows<S>, Vec<f64>), Error> {
        Ok((self.values(problem, motion)?, self.scales(problem, motion)))
    }

    /// Returns the natural scale of each column, in units of `problem`; ratios have a scale of about 1.
    fn scales<S: Scalar>(&self, problem: &Problem, motion: &dyn Motion<S>) -> Vec<f64> {
        let units = Units::new(problem, UnitSystem::default());
        let time = motion.scales().time.to_f64();
        self.quantities
            .iter()
            .map(|quantity| match quantity.measure() {
                Some(Measure::Time) => time,
                _ => quantity.natural_scale(motion, &units).unwrap_or(1.0),
            })
            .collect()
    }
}

impl<S> Derivative<S> {
    /// Returns the derivative if it is the same from both sides.
    pub fn value(&self) -> Option<&S> {
        match self {
            Derivative::One(value) => Some(value),
            Derivative::Sides { .. } => None,
        }
    }

    /// Returns the derivatives from the left and from the right.
    pub fn sides(&self) -> [Result<&S, NoDerivative>; 2] {
        match self {
            Derivative::One(value) => [Ok(value), Ok(value)],
            Derivative::Sides { left, right } => [left, right].map(|side| side.as_ref().map_err(|why| *why)),
        }
    }

    /// Converts the derivative to other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Derivative<T> {
        match self {
            Derivative::One(value) => Derivative::One(f(value)),
            Derivative::Sides { left, right } => Derivative::Sides { left: left.map(&f), right: right.map(&f) },
        }
    }
}

#[cfg(test)]
#[path = "tests/derivative.rs"]
mod tests;
