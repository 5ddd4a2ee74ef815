//! Which engine and which numbers a scene needs: the cheapest that give what is asked.

use serde::Serialize;

use super::{Effect, EffectUse, Scene};
use crate::error::Error;
use crate::number::Number;
use crate::problem::Run;

/// What a user asks of a solution, beyond the scene itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ask {
    /// Exact fractions, as far as they reach.
    pub exact: bool,
    /// This many decimal digits, rounded once from values known to eight more of their scale. With `exact`: from where exactness ends.
    pub digits: Option<u32>,
    /// Enclosures: every digit printed is proved. With `digits`, or else 15 of them.
    pub certified: bool,
    /// Nothing before this time will be asked for, so an undamped march may forget it.
    pub from: Option<f64>,
    /// The accuracy relative to the natural scales, before that of the scene.
    pub accuracy: Option<f64>,
}

/// The engine that a plan chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// [`crate::lattice`]: the undamped rod, event by event on the characteristic lattice.
    Lattice,
    /// [`crate::damped`]: the first contact in closed form, then strips of characteristic cells.
    Cells,
}

impl std::fmt::Display for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Engine::Lattice => "characteristic lattice, event by event, without a time step",
            Engine::Cells => "closed form of the first contact, then strips of characteristic cells",
        })
    }
}

/// The number system that a plan chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// `f64`, to this accuracy if one is asked for: with more bits behind the doubles where they alone do not reach it.
    Double(Option<f64>),
    /// Decimal digits; how many bits they take is found from the error bound of the run.
    Digits(u32),
    /// Fractions, and decimal digits from where they end if that is asked for.
    Exact(Option<u32>),
    /// Decimal digits that are proved, by enclosures.
    Certified(u32),
}

/// Digits that are proved where none are asked for.
const CERTIFIED_DIGITS: u32 = 15;

impl std::fmt::Display for System {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            System::Double(None) => f.write_str("double"),
            System::Double(Some(accuracy)) => write!(f, "double, accuracy {accuracy:e}"),
            System::Digits(digits) => write!(f, "{digits} digits"),
            System::Certified(digits) => write!(f, "{digits} digits, proved"),
            System::Exact(None) => f.write_str("exact"),
            System::Exact(Some(digits)) => write!(f, "exact, then {digits} digits"),
        }
    }
}

/// How a scene is going to be solved. What the plan leaves out is neither run nor allocated.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Every effect, called for or not.
    pub effects: Vec<EffectUse>,
    /// The engine.
    pub engine: Engine,
    /// The numbers.
    pub system: System,
    /// The first time that will be asked for.
    pub from: Option<f64>,
    /// Why this engine and these numbers.
    pub reasons: Vec<String>,
    /// What it will take, in words.
    pub cost: String,
}

/// More digits than this are refused: a slip of the hand, not a question.
pub const MAX_DIGITS: u32 = 100_000;

impl Plan {
    /// The plan for `scene`.
    ///
    /// **Errors**: [`Error::DampedExact`]; [`Error::Accuracy`]; [`Error::Digits`] for none or absurdly many; [`Error::NoMultiprecision`] where the
    /// crate was built without it.
    ///
    /// ```
    /// use dalembert::{Scene, scene::{Ask, Plan, System}};
    /// let scene = Scene::parse("[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 3\n")?;
    /// assert_eq!(Plan::of(&scene, Ask::default())?.system, System::Double(None));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(scene: &Scene, ask: Ask) -> Result<Self, Error> {
        let damping = scene.problem.rod.damping.as_ref();
        if let (Some(damping), true) = (damping, ask.exact) {
            return Err(Error::DampedExact { damping: damping.to_string() });
        }
        let accuracy = ask.accuracy.or(scene.accuracy.as_ref().map(Number::to_f64));
        if let Some(accuracy) = accuracy.filter(|accuracy| !(1e-300..=0.1).contains(accuracy)) {
            return Err(Error::Accuracy { found: accuracy });
        }
        if let Some(digits) = ask.digits.filter(|digits| !(1..=MAX_DIGITS).contains(digits)) {
            return Err(Error::Digits { found: digits, most: MAX_DIGITS });
        }
        if cfg!(not(feature = "mp")) && (ask.exact || ask.certified || ask.digits.is_some()) {
            return Err(Error::NoMultiprecision);
        }
        let system = match (ask.exact, ask.digits) {
            _ if ask.certified => System::Certified(ask.digits.unwrap_or(CERTIFIED_DIGITS)),
            (true, digits) => System::Exact(digits),
            (false, Some(digits)) => System::Digits(digits),
            (false, None) => System::Double(accuracy),
        };
        let engine = if damping.is_some() { Engine::Cells } else { Engine::Lattice };
        let mut reasons = vec![match engine {
            Engine::Lattice => "without damping the solution travels unchanged along its characteristics".to_string(),
            Engine::Cells if scene.problem.has_closed_form() => {
                "damping couples the characteristics: the first contact has a closed form, and inside a cell between \
                 rays Riemann's formula converges geometrically"
                    .into()
            }
            Engine::Cells => {
                "damping couples the characteristics, and this start has no closed form: cells from the beginning"
                    .into()
            }
        }];
        reasons.push(match system {
            System::Double(None) if engine == Engine::Lattice => {
                "neither --digits, --exact nor --accuracy is asked for: double precision, with a running error bound".into()
            }
            System::Double(None) => {
                "neither --digits nor --accuracy is asked for: double precision with an error bound, and more bits only \
                 where the rays of a long first contact cancel"
                    .into()
            }
            System::Double(Some(accuracy)) => {
                format!("accuracy {accuracy:e} is asked for: double precision if its error estimate allows, more bits if not")
            }
            System::Digits(digits) => {
                format!("{digits} digits are asked for: bits are added until the error bound leaves that many")
            }
            System::Certified(digits) => {
                format!(
                    "{digits} proved digits are asked for: enclosures, with bits added until every comparison is settled and \
                     every digit known"
                )
            }
            System::Exact(None) => "exact fractions are asked for: the run stops where a root is irrational".into(),
            System::Exact(Some(digits)) => {
                format!("exact fractions are asked for, and {digits} digits from the first irrational root on")
            }
        });
        let cost = match &scene.problem.run {
            Run::Impacts(impacts) => format!("{impacts} contact(s): time and memory linear in the number of pieces"),
            Run::Time(time) => format!("to t = {time}: time and memory linear in the number of pieces"),
        };
        let mut effects = scene.effects();
        effects.push(scene.effect(Effect::FieldEnergies));
        effects.push(match system {
            System::Double(_) => scene.effect(Effect::ArbitraryPrecision),
            _ => EffectUse {
                effect: Effect::ArbitraryPrecision,
                called: true,
                line: None,
                because: format!("{system} asked for"),
            },
        });
        Ok(Plan { effects, engine, system, from: ask.from, reasons, cost })
    }

    /// The names of the effects that the scene itself calls for.
    pub fn called(&self) -> Vec<&'static str> {
        let called = self.effects.iter().filter(|used| used.called && Effect::ALL.contains(&used.effect));
        called.map(|used| used.effect.name()).collect()
    }
}
