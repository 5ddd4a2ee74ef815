//! All decisions before a run: engine, number system, bits, reach.

use std::borrow::Cow;

use serde::Serialize;

use super::foresee;
use super::question::{Numbers, Question, Want};
use super::rung::{LONGEST, MOST_BITS, Rung, rungs, size};
use crate::cells::MOST_DIGITS;
use crate::error::Error;
use crate::lattice::Limits;
use crate::number::{Number, bits_for_digits};
use crate::problem::validate::check_time;
use crate::problem::{Parameters, Problem, Run};
use crate::reason::Warning;

/// The decisions about how to answer a question. No engine and no caller repeats any of them.
///
/// **Source**: the cheapest route to the answer: a first contact alone needs no flight, and values between two times
/// need nothing beyond the later one.
///
/// ```
/// use dalembert::{Engine, Numbers, Plan, Problem, Question};
/// let mut problem = Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
/// assert_eq!(Plan::of(&problem, &Question::run(Numbers::default()))?.engine, Engine::Lattice);
/// problem = problem.to_builder().damping("0.1").build()?;
/// assert_eq!(Plan::of(&problem, &Question::first_contact(Numbers::default()))?.engine, Engine::ClosedForm);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// The engine.
    pub engine: Engine,
    /// The number system of the answer.
    pub numbers: Numbers,
    /// End of the motion that is computed.
    pub reach: Reach,
    /// Time before which the run may drop its data.
    pub keep_from: Option<f64>,
    /// Whether all events and contacts are settled before any query; otherwise only queried numbers are computed.
    pub settles_events: bool,
    /// The rung of the first attempt; `explain` prints it. Longer numbers follow if it does not settle the answer.
    pub rung: Rung,
    /// Estimated decimal digits that rounding takes in a chaotic run; the first rung has as many more.
    pub foreseen_loss: f64,
    /// Required accuracy of an answer.
    pub goal: Goal,
    /// The rungs after the first attempt.
    pub climb: Climb,
    /// Limits of cells; `None` without cells.
    pub cells: Option<CellLimits>,
    /// Estimated cost in bits of the proof of a damped march.
    #[serde(skip)]
    pub(super) proof_bits: u32,
    /// Bits that the series of a damped march need in the first numbers after doubles, if the run in doubles determines
    /// them; otherwise series are as accurate as the numbers.
    #[serde(skip)]
    pub(super) series_bits: Option<f64>,
}

/// Required accuracy of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Goal {
    /// Decimal digits of each number.
    pub digits: f64,
    /// Digits below the greatest number of the answer to which smaller numbers keep all of their own. With `digits` 9
    /// and `spare` 6 beside a 1, `1e-6` needs an error of `1e-15`, and so does every smaller number.
    pub spare: f64,
    /// Digits, beyond `digits`, of a number that is not distinguished from zero. With `digits` 9 and `faint` 30 it is
    /// settled where its error is `1e-39` of its natural scale.
    pub faint: f64,
}

/// Number systems that follow if those of an attempt do not settle an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Climb {
    /// Bits of the first attempt after doubles or fractions.
    pub bits: u32,
    /// Maximum bits of numbers with an error bound.
    pub most_bits: u32,
    /// Maximum bits that are tried to distinguish two events that may coincide.
    pub near_miss: u32,
    /// Number of bits beyond which enclosures, which carry exact roots, replace numbers with a bound.
    pub exact_roots: Option<u32>,
    /// Bits of an enclosure beyond which a comparison is reported as undecided.
    pub most_enclosed: u32,
    /// Maximum number of contacts for which exact numbers decide events that coincide within their bounds.
    pub exact_contacts: Option<u32>,
}

/// Limits of cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CellLimits {
    /// Decimal digits in doubles.
    pub double_digits: f64,
    /// Maximum number of cells in doubles.
    pub double_cells: u64,
    /// Maximum number of cells in numbers of 128 bits, lower by the square of the bits in longer ones; `None`, no
    /// limit, if digits are requested.
    pub long_cells: Option<u64>,
    /// Decimal digits beyond which no march is made.
    pub most_digits: f64,
}

/// The engine that a plan chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::Display, strum::IntoStaticStr)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// The undamped rod, event by event on the characteristic lattice.
    #[strum(serialize = "characteristic lattice, event by event, without a time step")]
    Lattice,
    /// The damped first contact in closed form, and nothing after it.
    #[strum(serialize = "closed form of the first contact")]
    ClosedForm,
    /// Strips of characteristic cells: a damped rod through any number of impacts. A first contact that has a closed
    /// form and never ends is taken from there.
    #[strum(serialize = "strips of characteristic cells")]
    Cells,
    /// An undamped chain of bodies, from node to node.
    #[strum(serialize = "a chain of bodies, from node to node")]
    Chain,
}

impl Engine {
    /// Returns the name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// End of the motion that is computed.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reach {
    /// This many contacts, each with the flight after it.
    Contacts(u32),
    /// The end of the first contact.
    FirstContact,
    /// This time, included.
    Time(Number),
}

/// Number of proved digits if none is requested.
pub const CERTIFIED_DIGITS: u32 = 15;
/// Default accuracy of doubles, relative to the greatest number of an answer; digits beyond the bound are not printed.
pub const DEFAULT_ACCURACY: f64 = 1e-9;
/// Digits below the requested ones, and below its natural scale, at which a number that is indistinguishable from zero
/// is settled.
const FAINT_DIGITS: f64 = 30.0;
/// Bits beyond those of the requested digits, on the first attempt with error bounds.
const GUARD_BITS: u32 = 64;
/// Bits beyond those of the requested digits and the estimated cost of the proof, for a damped march that is proved.
pub(super) const PROOF_GUARD_BITS: u32 = 24;
/// Additional bits that distinguish events whose distance is a rounding of a double, or its square.
pub(super) const NEAR_MISS: u32 = 256;
/// Maximum contacts for exact roots; beyond, these take minutes.
const MOST_EXACT: u32 = 1000;
/// Factor on the requested bits at which enclosures replace more bits: a root that is met exactly would take any number
/// of bits, and enclosures carry exact roots.
const EXACT_ROOT: u32 = 4;
/// Default limits of cells: thirteen digits in doubles; some ten seconds in doubles, and a few in numbers of 128 bits.
/// The cost of more digits grows with their cube.
pub(super) const CELLS: CellLimits =
    CellLimits { double_digits: 13.0, double_cells: 20_000_000, long_cells: Some(30_000), most_digits: MOST_DIGITS };
/// Bits of an enclosure beyond which a comparison is reported as undecided, unless the requested digits need more.
const MOST_ENCLOSED: u32 = 1 << 13;
/// Maximum bits of a damped march that is proved: its error account is kept in doubles, which end at 2⁻¹⁰²².
pub(super) const MOST_PROVED: u32 = 900;

impl Plan {
    /// Chooses the plan for `question` of `problem`.
    ///
    /// **Errors**: [`Error::DampedExact`]; [`Error::Accuracy`]; [`Error::Digits`] for no digits or absurdly many.
    pub fn of(problem: &Problem, question: &Question) -> Result<Self, Error> {
        let numbers = question.numbers;
        if let (Some(damping), Numbers::Exact | Numbers::ExactThenDigits(_)) = (problem.damping(), numbers) {
            return Err(Error::DampedExact { damping: damping.to_string() });
        }
        numbers.check()?;
        let reach = match &question.want {
            Want::FirstContact | Want::Bounce if problem.in_chain.is_some() => Reach::run(problem),
            Want::Run => Reach::run(problem),
            Want::FirstContact | Want::Bounce => Reach::FirstContact,
            Want::Between(_, to) => {
                check_time(to, &to.to_string(), Parameters::<f64>::of(problem, &())?.round_trip())?;
                Reach::Time(if problem.damping().is_some() { beyond(problem, to) } else { to.clone() })
            }
        };
        let keep_from = match &question.want {
            Want::Between(from, _) => Some(from.to_f64()),
            _ => None,
        };
        let single = question.want == Want::Bounce;
        let engine = match (problem.damping(), problem.has_closed_form()) {
            _ if problem.in_chain.is_some() => Engine::Chain,
            // Corollary 1 needs no exact numbers, and its terms need no events.
            (None, true) if single && matches!(numbers, Numbers::Double(_)) => Engine::ClosedForm,
            (None, _) => Engine::Lattice,
            (Some(_), true) if reach == Reach::FirstContact => Engine::ClosedForm,
            (Some(_), _) => Engine::Cells,
        };
        let settles_events = keep_from.is_none() && !single;
        Ok(Self::with(problem, numbers, engine, reach, (keep_from, settles_events)))
    }

    /// Returns the plan without attempts in numbers longer than doubles; without damping fractions remain, for events
    /// that coincide. Its answers come at once, with whatever bounds they have.
    ///
    /// ```
    /// use dalembert::{Numbers, Plan, Problem, Question, TypedHistory};
    /// // Fifteen damped impacts lose too many digits for doubles.
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).damping("0.1").impact_speed(20).impacts(15);
    /// let rod = rod.build()?;
    /// let plan = Plan::of(&rod, &Question::run(Numbers::default()))?.in_doubles();
    /// let history = TypedHistory::<f64>::solve(&rod, &plan, dalembert::solve::unobserved())?;
    /// assert!(history.error_estimate() > 1e-9);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn in_doubles(mut self) -> Self {
        self.climb.most_bits = f64::MANTISSA_DIGITS;
        self
    }

    /// Completes the plan with the fields that follow from engine, numbers and reach.
    fn with(
        problem: &Problem,
        numbers: Numbers,
        engine: Engine,
        reach: Reach,
        (keep_from, settles_events): (Option<f64>, bool),
    ) -> Self {
        let doubles = matches!(numbers, Numbers::Double(_));
        let marched = engine == Engine::Cells;
        let cells = CellLimits { long_cells: CELLS.long_cells.filter(|_| doubles), ..CELLS };
        let proof_bits = if marched {
            foresee::proof_bits(problem, |trip| match &reach {
                Reach::Contacts(contacts) => f64::from(*contacts),
                Reach::FirstContact => 1.0,
                Reach::Time(time) => (time.to_f64() / (2.0 * trip)).ceil(),
            })
        } else {
            0
        };
        let (rung, foreseen_loss) = match numbers {
            Numbers::Double(_) => (Rung::Double, 0.0),
            Numbers::Exact | Numbers::ExactThenDigits(_) => (Rung::Fractions, 0.0),
            Numbers::Certified(digits) => {
                let wanted = bits_for_digits(digits);
                let bits = if marched && wanted < MOST_PROVED {
                    size(wanted + PROOF_GUARD_BITS + proof_bits).min(MOST_PROVED)
                } else {
                    wanted + GUARD_BITS
                };
                (Rung::Enclosures(bits), 0.0)
            }
            Numbers::Digits(digits) => {
                let lost = match (engine, &reach) {
                    (Engine::Lattice, Reach::Time(end)) => foresee::bits_lost(problem, end.to_f64()),
                    _ => 0.0,
                };
                let lost = lost.min(f64::from(MOST_BITS));
                // A tenth more than estimated is cheaper than a second run.
                let bits = bits_for_digits(digits + SPARE_DIGITS) + GUARD_BITS.max((1.1 * lost) as u32 + 8);
                (Rung::Bits(size(bits)), lost * std::f64::consts::LOG10_2)
            }
        };
        let rung = match engine {
            Engine::Chain => rungs(numbers)[0],
            _ => rung,
        };
        let goal = Goal::of(numbers);
        let (wanted, lattice) = (bits_for_digits(goal.digits.ceil() as u32), engine == Engine::Lattice);
        let climb = Climb {
            bits: size(wanted + GUARD_BITS),
            most_bits: if doubles { LONGEST } else { MOST_BITS },
            near_miss: wanted + NEAR_MISS,
            exact_roots: lattice.then_some(wanted * EXACT_ROOT + 1024),
            most_enclosed: match marched && wanted + GUARD_BITS < MOST_PROVED {
                true => MOST_PROVED,
                false => MOST_ENCLOSED.max(4 * wanted),
            },
            exact_contacts: lattice.then_some(MOST_EXACT),
        };
        Plan {
            climb,
            goal,
            cells: marched.then_some(cells),
            engine,
            numbers,
            reach,
            keep_from,
            settles_events,
            rung,
            foreseen_loss,
            proof_bits,
            series_bits: None,
        }
    }

    /// Returns the plan of the same run in other `numbers`.
    pub(super) fn in_numbers(&self, problem: &Problem, numbers: Numbers) -> Self {
        let keeps = (self.keep_from, self.settles_events);
        Self::with(problem, numbers, self.engine, self.reach.clone(), keeps)
    }

    /// Returns the question that the plan answers: events and contacts.
    pub(super) fn want(&self) -> Want {
        if self.reach == Reach::FirstContact { Want::FirstContact } else { Want::Run }
    }

    /// Returns the problem with the run that is computed.
    pub(super) fn reaching<'a>(&self, problem: &'a Problem) -> Cow<'a, Problem> {
        let run = match &self.reach {
            Reach::Contacts(contacts) => Run::Impacts(*contacts),
            Reach::FirstContact => Run::Impacts(1),
            Reach::Time(time) => Run::Time(time.clone()),
        };
        if *problem.run() == run { Cow::Borrowed(problem) } else { Cow::Owned(problem.shortened(run)) }
    }

    /// Returns the warning that digits of a damped march in this many bits are not proved.
    pub(super) fn not_proved(&self, rung: Rung) -> Option<Warning> {
        let digits = self.cells.is_some() && matches!(self.numbers, Numbers::Digits(_));
        (digits && rung.bits() > MOST_PROVED).then_some(Warning::NotProved { most: MOST_PROVED })
    }

    /// Returns the limits of an undamped march.
    pub(super) fn lattice_limits(&self, problem: &Problem) -> Limits {
        self.keep_from.map_or_else(Limits::default, |time| Limits::keeping_from(problem, time))
    }
}

impl Goal {
    fn of(numbers: Numbers) -> Self {
        let (digits, spare, faint) = match numbers {
            Numbers::Double(accuracy) => (-accuracy.unwrap_or(DEFAULT_ACCURACY).log10(), 0.0, 0.0),
            Numbers::Exact => (0.0, 0.0, FAINT_DIGITS),
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => {
                (f64::from(digits), f64::from(SPARE_DIGITS), FAINT_DIGITS)
            }
            Numbers::Certified(digits) => (f64::from(digits), f64::from(FLOOR_DIGITS), FAINT_DIGITS),
        };
        Goal { digits, spare, faint }
    }
}

/// Returns a time a quarter of a round trip after `to`: if a ray arrives at the end of a damped march, the limit from
/// later times needs the strip after it.
fn beyond(problem: &Problem, to: &Number) -> Number {
    let quarter = Parameters::<f64>::of(problem, &()).map_or(0.0, |rod| rod.round_trip() / 4.0);
    format!("{:e}", to.to_f64() + quarter).parse().unwrap_or_else(|_| to.clone())
}

/// Digits that must remain beyond the printed ones, so that a quantity small against its scale still has all of them.
const SPARE_DIGITS: u32 = 8;
/// Digits below the greatest number of the answer, beyond the requested ones, at which a proved number may keep fewer
/// digits: if it is truly zero, no number of bits would give it any.
const FLOOR_DIGITS: u32 = 30;

impl Reach {
    fn run(problem: &Problem) -> Self {
        match problem.run() {
            Run::Impacts(contacts) => Reach::Contacts(*contacts),
            Run::Time(time) => Reach::Time(time.clone()),
        }
    }
}
