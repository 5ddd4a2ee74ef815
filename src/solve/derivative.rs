//! Derivatives of what a history lists by a value of the problem, from both sides.

use std::fmt;

use super::history::History;
use super::ladder::{Observer, Target};
use super::plan::Plan;
use super::question::{Question, Want};
use crate::error::Error;
use crate::mapped::{MapEach, mapped, try_mapped};
use crate::motion::{Motion, Side};
use crate::number::{Number, Scalar};
use crate::problem::{Parameter, Problem};
use crate::quantity::{self, Measure, Quantity, UnitSystem, Units};

/// The derivative of a number of a history by a value of the problem.
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
    /// The same from both sides, or from the only one: a damping that is zero can only grow.
    One(S),
    /// Not the same from both sides: an event meets a ray, and comes before it on one side and after it on the other.
    Sides {
        /// As the value grows towards that of the problem.
        left: Result<S, NoDerivative>,
        /// As it grows beyond.
        right: Result<S, NoDerivative>,
    },
}

/// Why there is no derivative from a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDerivative {
    /// Difference quotients grow without bound as steps get smaller, slower than their inverse: as next to a touch.
    Infinite,
    /// The number jumps, or is one of another event.
    Jumps,
    /// The numbers that were tried do not settle it; in fractions, first order does not.
    Unsettled,
}

/// Derivatives by row and column; `None` where there is no number.
pub type Derivatives<S> = Vec<Vec<Option<Derivative<S>>>>;

/// What there is by row and column.
pub(super) type Rows<S> = Vec<Vec<Option<S>>>;

/// `f` of each number that there is, with its row and column.
pub(super) fn of_each<S, T>(rows: &Rows<S>, mut f: impl FnMut((usize, usize), &S) -> T) -> Rows<T> {
    mapped(rows.iter().enumerate(), |(i, row)| {
        mapped(row.iter().enumerate(), |(j, number)| number.as_ref().map(|number| f((i, j), number)))
    })
}

/// What there is in that row and column.
pub(super) fn at<S>(rows: &Rows<S>, (row, column): (usize, usize)) -> Option<&S> {
    rows.get(row)?.get(column)?.as_ref()
}

/// What derivatives are asked for.
pub struct Asked<'a> {
    pub(super) problem: &'a Problem,
    pub(super) plan: &'a Plan,
    /// What a run with another value is to answer.
    pub(super) want: Want,
    pub(super) observe: &'a Observer,
    pub(super) by: Parameter,
    pub(super) quantities: &'a [Quantity],
    /// Where they are values at times, and not those of a list.
    pub(super) at: Option<At<'a>>,
}

/// Times, points of the rod for quantities that have one, and which limit.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) times: &'a [Number],
    pub(super) points: &'a [Number],
    pub(super) side: Side,
}

impl Asked<'_> {
    /// The numbers that derivatives are taken of, in units of `problem`: a row for each of the list, or for each time
    /// and there for each point.
    pub(super) fn values<S: Scalar>(&self, problem: &Problem, motion: &dyn Motion<S>) -> Result<Rows<S>, Error> {
        let units = Units::of(problem, UnitSystem::default());
        let Some(At { times, points, side }) = self.at else {
            return quantity::values(motion, self.quantities, &units);
        };
        let precision = motion.end().precision();
        let lift = |list: &[Number]| -> Vec<S> { mapped(list, |number| S::spelling(number, &precision)) };
        let times = lift(times);
        if !points.is_empty() {
            return quantity::along(motion, &units, self.quantities, (&lift(points), &times), side);
        }
        let rows = |times: &[S]| {
            let table = quantity::columns(motion, &units, self.quantities, times, Some(side))?;
            Ok(mapped(0..times.len(), |row| mapped(&table, |column| Some(column[row].clone()))))
        };
        match rows(&times) {
            // With another value it may end before.
            Err(Error::TimeOutside { .. }) => {
                let none = || vec![mapped(self.quantities, |_| None)];
                let row = |time: &S| match rows(std::slice::from_ref(time)) {
                    Err(Error::TimeOutside { .. }) => Ok(none()),
                    found => found,
                };
                Ok(try_mapped(&times, row)?.concat())
            }
            found => found,
        }
    }

    /// The natural scale of each column, in units of `problem`; ratios are about 1.
    pub(super) fn scales<S: Scalar>(&self, problem: &Problem, motion: &dyn Motion<S>) -> Vec<f64> {
        let units = Units::of(problem, UnitSystem::default());
        let time = motion.scales().time.to_f64();
        mapped(self.quantities, |quantity| match quantity.measure() {
            Some(Measure::Time) => time,
            _ => quantity.natural_scale(motion, &units).unwrap_or(1.0),
        })
    }

    /// Whether a number is absent where the rod is too short for it: then there is but one side.
    pub(super) fn is_stretched(&self) -> bool {
        self.by == Parameter::Length && self.at.is_some_and(|at| !at.points.is_empty())
    }
}

impl<S> Derivative<S> {
    /// The derivative, where it is the same from both sides.
    pub fn value(&self) -> Option<&S> {
        match self {
            Derivative::One(value) => Some(value),
            Derivative::Sides { .. } => None,
        }
    }

    /// From the left and from the right.
    pub fn sides(&self) -> [Result<&S, NoDerivative>; 2] {
        match self {
            Derivative::One(value) => [Ok(value), Ok(value)],
            Derivative::Sides { left, right } => [left, right].map_each(|side| side.as_ref().map_err(|why| *why)),
        }
    }

    /// The same derivative in other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Derivative<T> {
        match self {
            Derivative::One(value) => Derivative::One(f(value)),
            Derivative::Sides { left, right } => Derivative::Sides { left: left.map(&f), right: right.map(&f) },
        }
    }
}

impl<S: Target> History<S> {
    /// The derivatives of `quantities` of one kind by a value of the problem, for each event, contact or flight; with a
    /// material in its units. All other values stay as they are: a derivative by the wave speed is one at the same
    /// density, one by gravity at the same impact speed. What there is not, such as the end of a contact that lasts, is
    /// `None`.
    ///
    /// **Accuracy**: *exact* in fractions; where the two sides differ, difference quotients have confirmed them.
    /// Otherwise each derivative is *within its own bound*. In doubles, as accurate as they are by default, that of a
    /// damped rod is within 1e-5 of its natural size, mostly 1e-8, and takes three runs: it is that of a cubic through
    /// four, and the bound what a quadratic differs by. Where these do not settle it, where more is asked for and in
    /// digits it is a difference quotient of runs in long numbers, with a step as small as the last of the digits, and
    /// the bound has what the quotients of both sides, or of two steps, differ by. A threshold that is nearer than the
    /// step counts as met.
    ///
    /// **Errors**: [`Error::Derivative`] where the problem has no such value, in fractions for damping, and for
    /// enclosures; [`Error::Digits`] for more than 60; [`Error::NoMultiprecision`] without the feature `mp`, but for
    /// fractions; those of the runs.
    ///
    /// ```
    /// # #[cfg(feature = "mp")] {
    /// use dalembert::{Derivative, Parameter, Problem, Quantity};
    /// // Doyen, Ern and Piperno's rod lands for the second time as a wave arrives: a faster one lands after it, and
    /// // g ∂t₂/∂μ is 6 for slower rods and 6/5 for faster ones.
    /// let rod = Problem::builder().length(10).wave_speed(30).gravity(10).impact_speed(10).impacts(2).build()?;
    /// let times = rod.exact()?.derivatives(Parameter::Speed, &[Quantity::EventTime])?;
    /// let Some(Derivative::Sides { left: Ok(slower), right: Ok(faster) }) = &times[2][0] else { unreachable!() };
    /// assert_eq!((slower.to_string(), faster.to_string()), ("3/5".into(), "3/25".into()));
    /// # }
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn derivatives(&self, by: Parameter, quantities: &[Quantity]) -> Result<Derivatives<S::Carried>, Error> {
        S::derivatives(&self.asked(by, quantities), self.run())
    }

    /// The derivatives of `quantities` at `times` by a value of the problem, a row for each time; with `points`, those
    /// of quantities along the rod, a row for each time and there for each point. Time and point stay where they are: a
    /// value that jumps where a ray passes has a derivative on that side of the ray only on which the ray leaves it,
    /// and one at the upper end by the length on the side of longer rods.
    ///
    /// **Accuracy**, **Errors**: those of [`History::derivatives`] and [`History::columns`].
    ///
    /// ```
    /// use dalembert::{Parameter, Problem, Quantity, Side};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(1).build()?;
    /// // Behind the first front v_x(0,t) = −(μ + g t)/c, so that ∂/∂g is −t/c.
    /// let history = rod.exact()?;
    /// let found = history.derivatives_at(Parameter::Gravity, &[Quantity::Strain], &["1/3".parse()?], &[], Side::Right)?;
    /// assert_eq!(found[0][0].as_ref().and_then(|by| by.value()).map(ToString::to_string), Some("-1/3".into()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn derivatives_at(
        &self,
        by: Parameter,
        quantities: &[Quantity],
        times: &[Number],
        points: &[Number],
        side: Side,
    ) -> Result<Derivatives<S::Carried>, Error> {
        let ordered = |a: &&Number, b: &&Number| a.compare(b);
        let (Some(first), Some(last)) = (times.iter().min_by(ordered), times.iter().max_by(ordered)) else {
            return Ok(Vec::new());
        };
        if let Some(time) = [first, last].into_iter().find(|time| !(0.0..=self.end().to_f64()).contains(&time.to_f64()))
        {
            return Err(self.explained(Error::TimeOutside { found: time.to_string(), end: self.end().text() }));
        }
        let length = &self.problem().rod.length;
        if let Some(point) = points.iter().find(|point| point.to_f64() < 0.0 || point.compare(length).is_gt()) {
            return Err(Error::PointOutside { found: point.to_string(), length: length.to_string() });
        }
        // A run that is followed to an event ends sooner or later with other values.
        let from = if quantities.iter().any(|quantity| quantity.is_of_past()) { 0.into() } else { first.clone() };
        let Question { want, numbers } = Question::between(from, last.clone(), self.plan().numbers);
        let plan = Plan::of(self.problem(), &Question { want: want.clone(), numbers })?;
        let at = Some(At { times, points, side });
        S::derivatives(&Asked { plan: &plan, want, at, ..self.asked(by, quantities) }, self.run())
    }

    fn asked<'a>(&'a self, by: Parameter, quantities: &'a [Quantity]) -> Asked<'a> {
        let (problem, plan, observe) = (self.problem(), self.plan(), self.observer());
        Asked { problem, plan, want: plan.want(), observe, by, quantities, at: None }
    }
}

impl fmt::Display for NoDerivative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoDerivative::Infinite => "infinite",
            NoDerivative::Jumps => "jumps",
            NoDerivative::Unsettled => "not settled",
        })
    }
}
