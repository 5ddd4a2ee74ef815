//! Derivatives of the numbers of a history with respect to a value of its problem.

use super::derivative::{Asked, At, Computed, Derivatives, of_same_events};
use super::ladder::Target;
use super::plan::Plan;
use super::question::Question;
use super::typed::TypedHistory;
use crate::error::Error;
use crate::motion::Side;
use crate::number::Number;
use crate::problem::Parameter;
use crate::quantity::{Measure, Quantity};
use crate::threads::locked;

impl<S: Target> TypedHistory<S> {
    /// Computes the derivatives of `quantities` of one kind with respect to a value of the problem, for each event,
    /// contact or flight; with a material in its units. All other values stay fixed: a derivative by the wave speed is
    /// at the same density, one by gravity at the same impact speed. A missing value, such as the end of a contact that
    /// lasts, is `None`.
    ///
    /// **Accuracy**: *exact* in fractions; where first order does not decide the order of two events, difference
    /// quotients have confirmed the derivatives. In doubles with the default accuracy, the derivative for an undamped
    /// rod is carried through the run beside each number, *within a bound* of its own, in fractions if these decide an
    /// order of events; so it is for a body of a chain whose run fractions hold. The error of any other derivative is
    /// an *estimate*, as [`TypedHistory::warnings`] then says. The derivative for a damped rod takes three more runs
    /// and is that of a cubic through all four; the difference from a quadratic serves as its error, within 1e-5 of its
    /// natural size, mostly 1e-8. If these do not settle it, if more accuracy is requested, and in digits, it is a
    /// difference quotient of runs in long numbers, with a step as small as the last of the digits, and the error
    /// contains the difference of the quotients on both sides, or of two steps. A threshold that is nearer than the
    /// step counts as met.
    ///
    /// **Errors**: [`Error::Derivative`] if the problem has no such value, in fractions for damping, and for
    /// enclosures; [`Error::Digits`] for more than 60; the errors of the runs.
    ///
    /// ```
    /// use dalembert::{Derivative, Parameter, Problem, Quantity};
    /// // Doyen, Ern and Piperno's rod lands for the second time as a wave arrives: a faster one lands after it, and
    /// // g ∂t₂/∂μ is 6 for slower rods and 6/5 for faster ones.
    /// let rod = Problem::builder().length(10).wave_speed(30).gravity(10).impact_speed(10).impacts(2).build()?;
    /// let times = rod.exact()?.derivatives(Parameter::ImpactSpeed, &[Quantity::EventTime])?;
    /// let Some(Derivative::Sides { left: Ok(slower), right: Ok(faster) }) = &times[2][0] else { unreachable!() };
    /// assert_eq!((slower.to_string(), faster.to_string()), ("3/5".into(), "3/25".into()));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn derivatives(&self, by: Parameter, quantities: &[Quantity]) -> Result<Derivatives<S::Carried>, Error> {
        self.computed(&self.asked(by, quantities))
    }

    /// Computes the derivatives of `quantities` at `times` with respect to a value of the problem, a row for each time;
    /// with `points`, the derivatives of quantities along the rod, a row for each time and, within it, each point. Time
    /// and point stay fixed: a value that jumps on a ray there has a derivative only on the side to which the ray moves
    /// away, and a derivative by the length at the upper end exists only on the side of longer rods.
    ///
    /// **Accuracy**, **Errors**: those of [`TypedHistory::derivatives`] and [`TypedHistory::columns`].
    ///
    /// ```
    /// use dalembert::{Parameter, Problem, Quantity, Side};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(1).build()?;
    /// // Behind the first front v_x(0,t) = −(μ + g t)/c, so that ∂/∂g is −t/c.
    /// let history = rod.exact()?;
    /// let (of, at) = ([Quantity::Strain], ["1/3".parse()?]);
    /// let found = history.derivatives_at(Parameter::Gravity, &of, &at, &[], Side::Right)?;
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
        let length = &self.problem().length();
        if let Some(point) = points.iter().find(|point| point.to_f64() < 0.0 || point.compare(length).is_gt()) {
            return Err(Error::PointOutside { found: point.to_string(), length: length.to_string() });
        }
        // A run to a given event would end earlier or later with other values.
        let from = if quantities.iter().any(|quantity| quantity.is_of_past()) { 0.into() } else { first.clone() };
        let Question { want, numbers } = Question::between(from, last.clone(), self.plan().numbers);
        let plan = Plan::of(self.problem(), &Question { want: want.clone(), numbers })?;
        let at = Some(At { times, points, side });
        self.computed(&Asked { plan: &plan, want, at, ..self.asked(by, quantities) })
    }

    /// Computes derivatives, and keeps for [`TypedHistory::warnings`] whether their errors are estimates.
    fn computed(&self, asked: &Asked<'_>) -> Result<Derivatives<S::Carried>, Error> {
        let Computed { rows, is_estimated } = S::derivatives(asked, &self.first.engine)?;
        let mut estimated = locked(&self.estimated);
        if is_estimated && !estimated.contains(&asked.by) {
            estimated.push(asked.by);
        }
        // A list of events, contacts or flights begins with a time.
        let is_list =
            asked.at.is_none() && asked.quantities.first().and_then(|first| first.measure()) == Some(Measure::Time);
        Ok(if is_list { of_same_events(rows) } else { rows })
    }

    fn asked<'a>(&'a self, by: Parameter, quantities: &'a [Quantity]) -> Asked<'a> {
        let (problem, plan, observe) = (self.problem(), self.plan(), &self.observe);
        Asked { problem, plan, rung: self.first.rung, want: plan.want(), observe, by, quantities, at: None }
    }
}
