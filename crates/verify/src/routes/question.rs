//! A question about one number of a problem, and the ways in which it is answered.

use super::method::{Method, Query, evaluate};
use super::value::RouteNumber;
use crate::error::VerifyError;
use dalembert::engine::{Motion, Scales};
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{Missing, Needs, Quantity, Units, ValueQuery};
use dalembert::solve::{self, Numbers, Plan, Target, TypedHistory};
use dalembert::{Error, Scene, Side, Value};

/// A function of an answer, for claims of the paper that are no quantities of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Transform {
    /// The answer itself.
    Identity,
    /// Its jump: the limit from later times minus that from earlier times.
    Jump,
    /// `e^{2r t_b}` times the answer.
    TimesGrowth,
    /// Its root minus `e^{−r t_b}`.
    RootMinusDecay,
}

/// A question about one number of a problem, which is followed as far as the answer needs.
#[derive(Clone, Debug)]
pub struct RouteQuestion {
    pub(crate) problem: Problem,
    pub(crate) query: ValueQuery,
    pub(crate) units: Units,
    pub(crate) transform: Transform,
}

impl RouteQuestion {
    /// Builds the question for `quantity` of `scene` at `time`.
    ///
    /// The default quantity is the bounce time or, for a scene of more than one contact, the time of the last event.
    /// The default time is three quarters of a round trip; where the quantity is zero then, it is the middle of the
    /// first contact or flight of the scene in which it is not.
    ///
    /// **Errors**: [`VerifyError::Time`] for a time below zero, or one for a quantity that has no time.
    ///
    /// ```
    /// use dalembert::{Quantity, Scene};
    /// use dalembert_verify::RouteQuestion;
    /// let scene = "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = 1 }";
    /// // The rod falls up to t = 1 and is in contact up to t = 1 + t₁ = 3, where v(0,·) = 0; 3t₁/4 = 1.5.
    /// let question = RouteQuestion::from_scene(&Scene::parse(scene)?, Some(Quantity::EndDisplacement), None)?;
    /// assert_eq!(question.time().map(|time| time.to_f64()), Some(0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_scene(scene: &Scene, quantity: Option<Quantity>, time: Option<Number>) -> Result<Self, VerifyError> {
        let quantity = quantity.unwrap_or(match scene.problem.run() {
            Run::Impacts(1) => Quantity::BounceTime,
            _ => Quantity::LastEvent,
        });
        let has_time = quantity.needs() == Needs::Time;
        if let Some(found) = time.clone() {
            if !has_time {
                let expected = format!("none: {} is not asked at a time", quantity.name());
                return Err(VerifyError::Time { found, expected });
            }
            if found.to_f64() < 0.0 {
                return Err(VerifyError::Time { found, expected: "one from 0 on".into() });
            }
        }
        if time.is_none() && has_time {
            return Self::at_default_time(scene, quantity);
        }
        Self::new(scene, quantity, time)
    }

    fn new(scene: &Scene, quantity: Quantity, time: Option<Number>) -> Result<Self, VerifyError> {
        let problem = match (&time, quantity.needs()) {
            (Some(time), _) if !time.is_zero() => scene.problem.with_run(Run::Time(time.clone()))?,
            _ if scene.problem.chain().is_some() => scene.problem.clone(),
            (None, Needs::FirstContact | Needs::Contact) => scene.problem.with_run(Run::Impacts(1))?,
            _ => scene.problem.clone(),
        };
        let (query, units) = (ValueQuery::new(quantity, time), Units::new(&problem, scene.units));
        Ok(RouteQuestion { problem, query, units, transform: Transform::Identity })
    }

    /// Builds the question at the first default time at which the answer in doubles is not zero.
    fn at_default_time(scene: &Scene, quantity: Quantity) -> Result<Self, VerifyError> {
        let is_zero = |question: &Self| {
            let answer = question.plan(Numbers::default()).and_then(|plan| question.ask_plan(&plan));
            answer.is_ok_and(|value| value.to_f64().abs() <= value.log2_error().exp2())
        };
        let time = 0.75 * Parameters::<f64>::of(&scene.problem, &())?.round_trip();
        let first = rounded(time).ok_or(VerifyError::RoundTrip(time))?;
        let first = Self::new(scene, quantity, Some(first))?;
        if !is_zero(&first) {
            return Ok(first);
        }
        let Ok(history) = scene.problem.doubles() else { return Ok(first) };
        let events = history.events().iter().map(|event| event.t);
        let mut times: Vec<f64> = [0.0].into_iter().chain(events).chain([*history.end()]).collect();
        times.dedup();
        let middles = times.windows(2).filter_map(|pair| rounded(0.5 * (pair[0] + pair[1])));
        let mut questions = middles.filter_map(|time| Self::new(scene, quantity, Some(time)).ok());
        Ok(questions.find(|question| !is_zero(question)).unwrap_or(first))
    }

    /// Returns the time of the question; `None` for a quantity without a time.
    pub fn time(&self) -> Option<&Number> {
        self.query.time.as_ref()
    }

    /// Plans the answer in `numbers`, and nothing more.
    pub fn plan(&self, numbers: Numbers) -> Result<Plan, VerifyError> {
        let ValueQuery { quantity, time, .. } = &self.query;
        Ok(Plan::of(&self.problem, &solve::Question::of(*quantity, time.as_ref(), numbers))?)
    }

    /// Answers by a method of the first contact of `rod`.
    pub(super) fn ask<S: RouteNumber>(
        &self,
        rod: &Parameters<S>,
        method: &dyn Method<S>,
    ) -> Result<Value, VerifyError> {
        let quantity = self.query.quantity;
        let convert = |number: &Number| S::from_number(number, &rod.length.precision());
        let (zero, point) = (rod.length.zero(), self.query.point.as_ref().map(convert));
        let query = |side: Side| Query { rod, point: point.clone().unwrap_or(zero.clone()), time: zero.clone(), side };
        let bounce = || evaluate(method, Quantity::BounceTime, &query(Side::Right));
        let find = |side: Side| {
            let time = match &self.query.time {
                Some(time) => convert(time),
                None if matches!(quantity.needs(), Needs::Time | Needs::PointAndTime) => bounce()?,
                None => zero.clone(),
            };
            let value = evaluate(method, quantity, &Query { time, ..query(side) })?;
            Ok(quantity.in_unit(value, &Scales::of(rod), &self.units))
        };
        // A release without a bound counts as exact, as it does where values are asked at it.
        let unbounded = |time: &S| time.log2_error() == f64::INFINITY;
        let bounce = || bounce().map(|time| if unbounded(&time) { time.nominal() } else { time });
        self.transformed(rod, find, bounce).map(Into::into)
    }

    /// Answers by an engine of the library.
    pub(super) fn ask_engine<S: RouteNumber>(&self, motion: &dyn Motion<S>) -> Result<Value, VerifyError> {
        self.find_in(motion)?.map(Into::into)
    }

    /// Answers in doubles by a plan, which computes nothing else.
    pub(super) fn ask_plan(&self, plan: &Plan) -> Result<Value, VerifyError> {
        let query = |motion: &dyn Motion<_>| self.find_in(motion);
        plan.ask::<f64, _>(&self.problem, query, |found| found.iter().collect())?.map(Into::into)
    }

    /// Answers by a history in numbers `S`, with all its events.
    pub(super) fn ask_history<S: Target<Carried: RouteNumber>>(&self, plan: &Plan) -> Result<Value, VerifyError> {
        let history = TypedHistory::<S>::solve(&self.problem, plan, solve::unobserved())?;
        history.ask(|motion| self.find_in(motion), |found| found.iter().collect())?.map(Into::into)
    }

    /// Answers by the library, for a question without a transform.
    pub(super) fn ask_library(&self, plan: &Plan) -> Result<Value, VerifyError> {
        plan.solve(&self.problem, solve::unobserved())?.query(&self.query)?.map_err(missing)
    }

    /// Answers by a motion. **Errors**: the outer ones may be settled by more bits.
    fn find_in<S: RouteNumber>(&self, motion: &dyn Motion<S>) -> Result<Result<S, VerifyError>, Error> {
        let find = |query: &ValueQuery| match query.evaluate(motion, &self.units, self.problem.run())? {
            Ok([value, _]) => Ok(value),
            Err(why) => Err(missing(why)),
        };
        let rod = Parameters::of(&self.problem, &motion.end().precision()).map_err(VerifyError::from);
        let found = rod.and_then(|rod| {
            let bounce = || find(&ValueQuery::new(Quantity::BounceTime, None));
            self.transformed(&rod, |side| find(&ValueQuery { side, ..self.query.clone() }), bounce)
        });
        match found {
            Err(VerifyError::Library(error @ (Error::NotDecided { .. } | Error::Open(_)))) => Err(error),
            found => Ok(found),
        }
    }

    /// Applies the transform to the value that `find` returns for a side.
    fn transformed<S: RouteNumber>(
        &self,
        rod: &Parameters<S>,
        find: impl Fn(Side) -> Result<S, VerifyError>,
        bounce: impl Fn() -> Result<S, VerifyError>,
    ) -> Result<S, VerifyError> {
        let no_fraction = || VerifyError::none("no fraction");
        let exponential = |exponent: S| exponent.try_exp().ok_or_else(no_fraction);
        let transformed = || {
            let value = find(self.query.side)?;
            Ok(match self.transform {
                Transform::Identity => value,
                Transform::Jump => find(Side::Right)? - find(Side::Left)?,
                Transform::TimesGrowth => value * exponential(bounce()? * &rod.damping * rod.damping.int(2))?,
                Transform::RootMinusDecay => {
                    let root = value.try_sqrt().ok_or_else(no_fraction)?;
                    root - exponential(-(bounce()? * &rod.damping))?
                }
            })
        };
        transformed().map_err(|error| match error {
            VerifyError::NoSuchQuantity { why, .. } => {
                VerifyError::NoSuchQuantity { quantity: self.query.quantity.name(), why }
            }
            other => other,
        })
    }
}

/// Converts the reason why there is no number to an error.
fn missing(Missing { open, why }: Missing) -> VerifyError {
    if open { VerifyError::Undecided(why) } else { VerifyError::none(why) }
}

/// Rounds a time to three digits; `None` beyond the range of numbers.
fn rounded(time: f64) -> Option<Number> {
    format!("{time:.2e}").parse().ok()
}

#[cfg(test)]
#[path = "tests/question.rs"]
mod tests;
