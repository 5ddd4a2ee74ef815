//! One number of a problem, asked of any account of its motion.

use super::account::{Account, At, Found, find};
use super::value::{NoAnswer, System, Value};
use dalembert::Error;
use dalembert::Scene;
use dalembert::Side;
use dalembert::engine::{Motion, Scales};
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{Missing, Needs, One, Quantity, Units};
use dalembert::solve::{Plan, Solution, Target, TypedHistory};

/// What is made of an answer: claims of the paper that are no quantities of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claimed {
    Itself,
    /// The jump of it, the later limit minus the earlier.
    Jump,
    /// `e^{2r t_b}` times it.
    TimesGrowth,
    /// What its root exceeds `e^{−r t_b}` by.
    RootBeyondDecay,
}

/// One number of a problem that is followed as far as the answer needs.
#[derive(Clone, Debug)]
pub struct Question {
    pub problem: Problem,
    pub one: One,
    pub units: Units,
    pub claimed: Claimed,
}

impl Question {
    /// `quantity` of `scene` at `time`; without one at three quarters of a round trip. Without a quantity it is the
    /// bounce time, or, where the scene calls for more than one contact, the time of the last event. A time below zero
    /// is refused, and one for a quantity that is not asked at a time.
    pub fn of_scene(scene: &Scene, quantity: Option<Quantity>, time: Option<Number>) -> Result<Self, NoAnswer> {
        let mut problem = scene.problem.clone();
        let quantity = quantity.unwrap_or(match problem.run {
            Run::Impacts(1) => Quantity::BounceTime,
            _ => Quantity::LastEvent,
        });
        let over_time = quantity.needs() == Needs::Time;
        let expected = match &time {
            Some(time) if !over_time => Some((time, format!("none: {} is not asked at a time", quantity.name()))),
            Some(time) if time.to_f64() < 0.0 => Some((time, "one from 0 on".into())),
            _ => None,
        };
        if let Some((time, expected)) = expected {
            return Err(NoAnswer::gave_up(format!("found time {time}, expected {expected}")));
        }
        let time = if time.is_none() && over_time { Some(default_time(&problem)?) } else { time };
        match (&time, quantity.needs()) {
            (Some(time), _) => problem.run = Run::Time(time.clone()),
            (None, Needs::FirstContact | Needs::Contact) => problem.run = Run::Impacts(1),
            (None, _) => (),
        }
        let (one, units) = (One::new(quantity, time), Units::of(&problem, scene.units));
        Ok(Question { problem, one, units, claimed: Claimed::Itself })
    }

    /// The answer of one account of the motion of `rod`.
    pub fn ask<S: System>(&self, rod: &Parameters<S>, motion: &dyn Account<S>) -> Result<Value, NoAnswer> {
        let quantity = self.one.quantity;
        let lift = |number: &Number| S::from_number(number, &rod.length.precision());
        let (zero, point) = (rod.length.zero(), self.one.point.as_ref().map(lift));
        let at = |side: Side| At { rod, point: point.clone().unwrap_or(zero.clone()), time: zero.clone(), side };
        let bounce = || find(motion, Quantity::BounceTime, &at(Side::Right));
        let find = |side: Side| {
            let time = match &self.one.time {
                Some(time) => lift(time),
                None if matches!(quantity.needs(), Needs::Time | Needs::PointAndTime) => bounce()?,
                None => zero.clone(),
            };
            Ok(quantity.in_unit(find(motion, quantity, &At { time, ..at(side) })?, &Scales::of(rod), &self.units))
        };
        // A release that is found without a bound counts as exact, as it does where values are asked at it.
        let unbounded = |time: &S| time.log2_error() == f64::INFINITY;
        let bounce = || bounce().map(|time| if unbounded(&time) { time.nominal() } else { time });
        self.claim(rod, find, bounce).map(Into::into)
    }

    pub fn ask_engine<S: System>(&self, motion: &dyn Motion<S>) -> Result<Value, NoAnswer> {
        self.find_in(motion)?.map(Into::into)
    }

    /// The answer in doubles by a plan, which works out nothing else.
    pub fn ask_plan(&self, plan: &Plan) -> Result<Value, NoAnswer> {
        let query = |motion: &dyn Motion<_>| self.find_in(motion);
        plan.ask::<f64, _>(&self.problem, query, |found| found.iter().collect())?.map(Into::into)
    }

    pub fn ask_solution(&self, solution: &Solution) -> Result<Value, NoAnswer> {
        match solution {
            Solution::Double(history) => self.ask_history(history),
            Solution::Digits(history, _) | Solution::DigitsAfter(history, ..) => self.ask_history(history),
            Solution::Exact(history) => self.ask_history(history),
            Solution::Certified(history, _) => self.ask_history(history),
        }
    }

    fn ask_history<S: Target<Carried: System>>(&self, history: &TypedHistory<S>) -> Result<Value, NoAnswer> {
        history.ask(|motion| self.find_in(motion), |found| found.iter().collect())?.map(Into::into)
    }

    /// The answer of a motion. **Errors**: those that more bits may settle.
    fn find_in<S: System>(&self, motion: &dyn Motion<S>) -> Result<Found<S>, Error> {
        let run = &self.problem.run;
        let find = |one: &One| match one.of(motion, &self.units, run)? {
            Ok([value, _]) => Ok(value),
            Err(Missing { open: true, why }) => Err(NoAnswer::gave_up(why)),
            Err(Missing { why, .. }) => Err(NoAnswer::none(why)),
        };
        let found = Parameters::of(&self.problem, &motion.end().precision()).map_err(NoAnswer::from).and_then(|rod| {
            let bounce = || find(&One::new(Quantity::BounceTime, None));
            self.claim(&rod, |side| find(&One { side, ..self.one.clone() }), bounce)
        });
        match found {
            Err(NoAnswer::Solve(error @ (Error::NotDecided { .. } | Error::Open(_)))) => Err(error),
            found => Ok(found),
        }
    }

    /// What is made of what `find` gives for a side.
    fn claim<S: System>(
        &self,
        rod: &Parameters<S>,
        find: impl Fn(Side) -> Found<S>,
        bounce: impl Fn() -> Found<S>,
    ) -> Found<S> {
        let exponential = |exponent: S| exponent.exponential().ok_or_else(|| NoAnswer::none("no fraction"));
        let claimed = || {
            let found = find(self.one.side)?;
            Ok(match self.claimed {
                Claimed::Itself => found,
                Claimed::Jump => find(Side::Right)? - find(Side::Left)?,
                Claimed::TimesGrowth => found * exponential(bounce()? * &rod.damping * rod.damping.int(2))?,
                Claimed::RootBeyondDecay => {
                    let root = found.try_sqrt().ok_or_else(|| NoAnswer::none("no fraction"))?;
                    root - exponential(-(bounce()? * &rod.damping))?
                }
            })
        };
        claimed().map_err(|error| match error {
            NoAnswer::NoSuchQuantity { why, .. } => {
                NoAnswer::NoSuchQuantity { quantity: self.one.quantity.name(), why }
            }
            other => other,
        })
    }
}

/// Three quarters of a round trip, to three digits: an ordinary time within the first contact.
fn default_time(problem: &Problem) -> Result<Number, NoAnswer> {
    let time = 0.75 * Parameters::<f64>::of(problem, &())?.round_trip();
    let text = format!("{time:.2e}");
    let expected = "a round trip between 1e-300 and 1e300";
    text.parse().map_err(|_| NoAnswer::gave_up(format!("found time {text}, expected {expected}")))
}
