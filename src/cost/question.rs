//! The quantity that is asked for, and how a history and the closed forms answer it.

use super::CostError;
use super::value::{Answer, Value};
use crate::error::Error;
use crate::first_contact::{Bounce, FirstContact};
use crate::history::{Ending, EventKind, History, Side};
use crate::number::{Estimate, Number, Scalar};
use crate::rod::{Parameters, Problem, Run};
use crate::scene::Scene;
use crate::solve::bounce_within;
use crate::special::RoundedSpecial;

/// What is asked of every route: one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(feature = "cli", value(rename_all = "snake_case"))]
pub enum Quantity {
    /// `t_b`: the first release.
    BounceTime,
    /// `v_x(0,t)`: the stress at the ground.
    Stress,
    /// `h(t)`: the centre of mass.
    Centre,
    /// `E(t)`.
    Energy,
    /// `E_z(t)`: the vibrational part of the energy.
    Vibrational,
    /// `e_E²` of the first contact.
    Restitution,
    /// The time of the last impact or release of the run.
    LastEvent,
}

impl Quantity {
    /// The name in output: `bounce_time`.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::BounceTime => "bounce_time",
            Quantity::Stress => "stress",
            Quantity::Centre => "centre",
            Quantity::Energy => "energy",
            Quantity::Vibrational => "vibrational",
            Quantity::Restitution => "restitution",
            Quantity::LastEvent => "last_event",
        }
    }

    /// The symbol: `t_b`.
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::BounceTime => "t_b",
            Quantity::Stress => "v_x(0,t)",
            Quantity::Centre => "h(t)",
            Quantity::Energy => "E(t)",
            Quantity::Vibrational => "E_z(t)",
            Quantity::Restitution => "e_E²",
            Quantity::LastEvent => "time of the last event",
        }
    }

    /// Whether it is asked at a time.
    pub fn at_a_time(self) -> bool {
        matches!(self, Quantity::Stress | Quantity::Centre | Quantity::Energy | Quantity::Vibrational)
    }
}

/// A quantity of a problem: the run is cut to what the answer needs.
#[derive(Clone, Debug)]
pub struct Question {
    /// The problem, followed as far as the quantity asks.
    pub problem: Problem,
    /// What is asked.
    pub quantity: Quantity,
    /// When, for a quantity at a time.
    pub time: Option<Number>,
}

impl Question {
    /// `quantity` of `scene` at `time`; without one at three quarters of a round trip. Without a quantity it is the bounce time, or,
    /// where the scene calls for more than one contact, the time of the last event.
    ///
    /// **Errors**: [`CostError::Time`] for a time below zero, or for a quantity that is not asked at a time.
    ///
    /// ```
    /// use dalembert::{Scene, cost::{Quantity, Question}};
    /// let scene = Scene::parse("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 3 }")?;
    /// let question = Question::of(&scene, Some(Quantity::Stress), None)?;
    /// assert_eq!(question.time.unwrap().to_f64(), 1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(scene: &Scene, quantity: Option<Quantity>, time: Option<Number>) -> Result<Self, CostError> {
        let mut problem = scene.problem.clone();
        let quantity = quantity.unwrap_or(match problem.run {
            Run::Impacts(1) => Quantity::BounceTime,
            _ => Quantity::LastEvent,
        });
        if let Some(time) = time.as_ref().filter(|time| !quantity.at_a_time() || time.to_f64() < 0.0) {
            let expected = if quantity.at_a_time() {
                "one from 0 on".into()
            } else {
                format!("none: {} is not asked at a time", quantity.name())
            };
            return Err(CostError::Time { found: time.to_string(), expected });
        }
        let time = match time {
            None if quantity.at_a_time() => Some(default_time(&problem)?),
            other => other,
        };
        match (&time, quantity) {
            (Some(time), _) => problem.run = Run::Time(time.clone()),
            (None, Quantity::BounceTime | Quantity::Restitution) => problem.run = Run::Impacts(1),
            (None, _) => (),
        }
        Ok(Question { problem, quantity, time })
    }

    fn none(&self, why: impl Into<String>) -> CostError {
        CostError::NoSuchQuantity { quantity: self.quantity.name(), why: why.into() }
    }

    fn time_in<S: Scalar>(&self, precision: &S::Precision) -> Result<S, CostError> {
        let time = self.time.as_ref().ok_or_else(|| self.none("no time was given"))?;
        Ok(S::from_number(time, precision))
    }

    /// The answer of a history.
    pub(super) fn ask<S: Scalar + Answer>(&self, history: &dyn History<S>) -> Result<Value, CostError> {
        let why_not = |error: Error| match error {
            // A history that ends early says why.
            Error::TimeOutside { .. } => self.none(history.ending().to_string()),
            other => other.into(),
        };
        let precision = history.end().precision();
        let value = match self.quantity {
            Quantity::BounceTime => {
                let release = history.events().iter().find(|event| event.kind == EventKind::Release);
                release.map(|event| event.time.clone()).ok_or_else(|| self.none(history.ending().to_string()))?
            }
            // The last event before a doubt is not the last of the run.
            Quantity::LastEvent if matches!(history.ending(), Ending::Undecided(_) | Ending::ExactnessEnds { .. }) => {
                return Err(CostError::GaveUp(history.ending().to_string()));
            }
            Quantity::LastEvent => {
                let last = history.events().last();
                last.map(|event| event.time.clone()).ok_or_else(|| self.none("nothing happens in it"))?
            }
            Quantity::Restitution => {
                let contact = history.contacts().first().ok_or_else(|| self.none("no contact in it"))?;
                let to = contact.to.as_ref().ok_or_else(|| self.none(history.ending().to_string()))?;
                // h and h′ are all that (4.71) needs: no vibrational energy is integrated.
                let ((h0, p0), (h, p)) =
                    (history.centre(&contact.from).map_err(why_not)?, history.centre(to).map_err(why_not)?);
                let gravity = self.gravity(&precision);
                let kinetic = |h: S, p: S| p.square() / p.int(2) + h * &gravity;
                let before = kinetic(h0, p0);
                if !before.is_positive() {
                    return Err(self.none("E_h ≤ 0 where the contact begins: nothing to compare with"));
                }
                kinetic(h, p) / before
            }
            Quantity::Stress => history.stress(&self.time_in(&precision)?, Side::Right).map_err(why_not)?,
            Quantity::Centre => history.centre(&self.time_in(&precision)?).map_err(why_not)?.0,
            Quantity::Energy => history.energy(&self.time_in(&precision)?).map_err(why_not)?.total,
            Quantity::Vibrational => history.energy(&self.time_in(&precision)?).map_err(why_not)?.vibrational,
        };
        Ok(value.answer())
    }

    fn gravity<S: Scalar>(&self, precision: &S::Precision) -> S {
        S::from_number(self.problem.gravity.as_ref().unwrap_or(&Number::from(0)), precision)
    }

    /// Whether the first contact alone answers, and if so as long as it lasts.
    ///
    /// **Errors**: why not.
    pub(super) fn of_first_contact(&self) -> Result<(), String> {
        if !self.problem.has_closed_form() {
            return Err("the start or the top is not the paper's, so the first contact has no closed form".into());
        }
        if self.quantity == Quantity::LastEvent {
            return match self.problem.run {
                Run::Impacts(1) => Ok(()),
                _ => Err("it knows the first contact only".into()),
            };
        }
        let Some(time) = &self.time else { return Ok(()) };
        let rod = Parameters::<f64>::of(&self.problem, &()).map_err(|error| error.to_string())?;
        match bounce_within(&FirstContact::new(&rod.carry()), 1e-10) {
            Bounce::At { time: end, .. } if time.to_f64() > end.value() * (1.0 + 1e-12) => {
                Err(format!("it knows the first contact only, which ends at t = {:.6}", end.value()))
            }
            Bounce::Undecided { until, .. } if time.to_f64() > *until.value() => {
                Err(format!("it is undecided whether the first contact lasts beyond t = {:.6}", until.value()))
            }
            _ => Ok(()),
        }
    }

    /// The answer of the closed forms, with the bounce time that is given.
    pub(super) fn closed<S: RoundedSpecial + Answer>(
        &self,
        precision: &S::Precision,
        bounce: impl FnOnce(&FirstContact<Estimate<S>>) -> Bounce<Estimate<S>>,
    ) -> Result<Value, CostError> {
        let contact = FirstContact::new(&Parameters::<S>::of(&self.problem, precision)?.carry());
        let released = |contact: &FirstContact<Estimate<S>>| match bounce(contact) {
            Bounce::At { time, .. } => Ok(time),
            Bounce::Never(reason) => Err(self.none(reason.to_string())),
            Bounce::Undecided { why, .. } => Err(CostError::GaveUp(why.to_string())),
        };
        let time = || Ok::<_, CostError>(self.time_in::<S>(precision)?.carry());
        let value = match self.quantity {
            Quantity::BounceTime | Quantity::LastEvent => released(&contact)?,
            Quantity::Restitution => {
                let time = released(&contact)?;
                let squared = contact.rebound(&time).energy_restitution_squared();
                squared.ok_or_else(|| self.none("E_h < 0 where the contact ends"))?
            }
            Quantity::Stress => contact.stress(&time()?, Side::Right),
            Quantity::Centre => contact.centre(&time()?).0,
            Quantity::Energy => contact.energy(&time()?).total,
            Quantity::Vibrational => contact.energy(&time()?).vibrational,
        };
        Ok(value.into_value().answer())
    }
}

/// Three quarters of a round trip, to three digits: an ordinary time within the first contact.
fn default_time(problem: &Problem) -> Result<Number, CostError> {
    let time = 0.75 * Parameters::<f64>::of(problem, &())?.round_trip();
    let text = format!("{time:.2e}");
    text.parse().map_err(|_| CostError::Time { found: text, expected: "a round trip between 1e-300 and 1e300".into() })
}
