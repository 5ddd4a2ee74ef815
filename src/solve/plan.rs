//! All decisions before a run: engine, number system, bits, reach.

use std::borrow::Cow;

use serde::Serialize;

use super::question::{Numbers, Question, Want};
use super::{chain, foresee};
use crate::cells::{Effort, MOST_DIGITS};
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
    proof_bits: u32,
    /// Bits that the series of a damped march need in the first numbers after doubles, if the run in doubles determines
    /// them; otherwise series are as accurate as the numbers.
    #[serde(skip)]
    series_bits: Option<f64>,
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

/// The numbers of one attempt, in the order of their cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::Display)]
#[serde(rename_all = "snake_case")]
pub enum Rung {
    /// Doubles with their error bound.
    #[strum(to_string = "doubles")]
    Double,
    /// Numbers of this many bits with their error bound.
    #[strum(to_string = "numbers of {0} bits")]
    Bits(u32),
    /// Fractions.
    #[strum(to_string = "fractions")]
    Fractions,
    /// Doubles, confirmed by enclosures of this many bits with the same events.
    #[strum(to_string = "doubles that enclosures of {0} bits confirm")]
    Confirmed(u32),
    /// Enclosures of this many bits, with exact roots inside if the rod is undamped.
    #[strum(to_string = "enclosures of {0} bits")]
    Enclosures(u32),
}

/// Deficit of an attempt.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lacks {
    /// Approximate number of missing bits.
    Bits(f64),
    /// Numbers that are equal, not merely within their bounds.
    Exactness,
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
const PROOF_GUARD_BITS: u32 = 24;
/// Additional bits that distinguish events whose distance is a rounding of a double, or its square.
const NEAR_MISS: u32 = 256;
/// Maximum contacts for exact roots; beyond, these take minutes.
const MOST_EXACT: u32 = 1000;
/// Factor on the requested bits at which enclosures replace more bits: a root that is met exactly would take any number
/// of bits, and enclosures carry exact roots.
const EXACT_ROOT: u32 = 4;
/// Minimum bits of a number with an error bound that follows doubles.
const FEWEST_BITS: u32 = 128;
/// Bits of the numbers on the stack.
const SIZES: [u32; 3] = [128, 256, 384];
/// Bits by which such numbers may be shorter than planned; guard bits are several times as many.
const SHORTER: u32 = 8;
/// Bits of the series of a damped march beyond the estimated need of its answer.
const SERIES_GUARD_BITS: f64 = 6.0;
/// Bits that [`Effort::digits`] carries beyond those of its digits.
const EFFORT_BITS: f64 = 20.0;
/// Default limits of cells: thirteen digits in doubles; some ten seconds in doubles, and a few in numbers of 128 bits.
/// The cost of more digits grows with their cube.
const CELLS: CellLimits =
    CellLimits { double_digits: 13.0, double_cells: 20_000_000, long_cells: Some(30_000), most_digits: MOST_DIGITS };
/// Maximum bits of a number with an error bound.
const MOST_BITS: u32 = 1 << 22;
/// Bits of an enclosure beyond which a comparison is reported as undecided, unless the requested digits need more.
const MOST_ENCLOSED: u32 = 1 << 13;
/// Maximum bits of a damped march that is proved: its error account is kept in doubles, which end at 2⁻¹⁰²².
pub(super) const MOST_PROVED: u32 = 900;

/// Whether answers in doubles may take numbers of any length, and enclosures. The tests inside the library leave them
/// out, to shorten their build; `tests/suite` has them.
pub(crate) const LONG: bool = cfg!(feature = "long") && !cfg!(test);
/// Maximum bits of the numbers that may follow doubles; those of doubles if none may.
pub(super) const LONGEST: u32 = match (LONG, cfg!(feature = "wide") && !cfg!(test)) {
    (true, _) => MOST_BITS,
    (false, true) => FEWEST_BITS,
    (false, false) => f64::MANTISSA_DIGITS,
};

/// Returns the bits of the shortest numbers on the stack with at least `bits − SHORTER`, or `bits` if there are none.
fn size(bits: u32) -> u32 {
    SIZES.into_iter().find(|size| bits <= size + SHORTER).unwrap_or(bits)
}

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
            Engine::Chain => chain::rungs(numbers)[0],
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

    /// Returns the rung after `rung`, by the deficit of the answer; `None` if no other numbers are worth trying.
    pub(crate) fn next(&self, rung: Rung, lacks: Lacks) -> Option<Rung> {
        if self.engine == Engine::Chain {
            return self.chain_rungs().into_iter().skip_while(|known| *known != rung).nth(1);
        }
        let Climb { bits: after, most_bits, near_miss, exact_roots, most_enclosed, .. } = self.climb;
        if most_bits <= FEWEST_BITS {
            return match (rung, lacks) {
                (Rung::Double, Lacks::Exactness) => Some(Rung::Fractions),
                (Rung::Double | Rung::Fractions, Lacks::Bits(_)) if after <= most_bits => Some(Rung::Bits(after)),
                _ => None,
            };
        }
        let Lacks::Bits(missing) = lacks else {
            // Fractions are fast, and end early if they do not apply; more bits distinguish a near miss from a meeting.
            return match rung {
                Rung::Double => Some(Rung::Fractions),
                Rung::Bits(bits) if bits < near_miss => Some(Rung::Bits(bits + NEAR_MISS)),
                Rung::Bits(bits) if matches!(self.numbers, Numbers::Double(_)) => Some(Rung::Confirmed(bits)),
                Rung::Bits(bits) => Some(Rung::Enclosures(bits)),
                Rung::Fractions | Rung::Confirmed(_) | Rung::Enclosures(_) => None,
            };
        };
        match rung {
            Rung::Fractions if matches!(self.numbers, Numbers::Exact | Numbers::ExactThenDigits(_)) => None,
            Rung::Fractions | Rung::Double => Some(Rung::Bits(after)),
            Rung::Bits(bits) => {
                // A double root needs two bits for each missing one.
                let more = if missing.is_finite() { (2.0 * missing).ceil() + 8.0 } else { f64::from(bits) };
                let next = f64::from(bits) + more.max(f64::from(bits / 4));
                if exact_roots.is_some_and(|most| next > f64::from(most)) {
                    Some(Rung::Enclosures(after))
                } else {
                    (next <= f64::from(most_bits)).then_some(Rung::Bits(size(next as u32)))
                }
            }
            Rung::Confirmed(bits) => Some(Rung::Enclosures(bits)),
            Rung::Enclosures(bits) => {
                let next = f64::from(bits) + missing.clamp(32.0, f64::from(bits));
                let fits = if self.cells.is_some() { size } else { |bits| bits };
                (next <= f64::from(most_enclosed)).then_some(Rung::Enclosures(fits(next as u32)))
            }
        }
    }

    /// Returns the numbers of the attempts at a body of a chain, in order.
    pub(super) fn chain_rungs(&self) -> Vec<Rung> {
        let rungs = chain::rungs(self.numbers).into_iter();
        rungs.filter(|rung| rung.bits() <= self.climb.most_bits).collect()
    }

    /// Returns whether longer numbers may follow the first ones.
    pub(super) fn may_climb(&self) -> bool {
        self.climb.bits <= self.climb.most_bits
    }

    /// Returns the rungs to query, in order, if those of `rung` cannot distinguish a time from an event or a ray.
    pub(super) fn telling(&self, rung: Rung) -> Vec<Rung> {
        let exact = self.engine == Engine::Lattice && !matches!(rung, Rung::Bits(_));
        let longer = [1, 2, 4].map(|times| times * self.climb.bits).into_iter();
        let longer = longer.filter(|bits| *bits > rung.bits() && *bits <= self.climb.most_bits).map(Rung::Bits);
        exact.then_some(Rung::Fractions).into_iter().chain(longer).collect()
    }

    /// Returns the reasons for this engine and these numbers, one sentence each.
    pub fn reasons(&self) -> Vec<String> {
        let engine = match self.engine {
            Engine::Lattice => "without damping the solution travels unchanged along its characteristics",
            Engine::ClosedForm => {
                "damping couples the characteristics; the first contact has a closed form, and no more is asked for"
            }
            Engine::Chain => "without damping waves travel unchanged through each body, and all happens at its ends",
            Engine::Cells => {
                "damping couples the characteristics: inside a cell between rays Riemann's formula converges \
                 geometrically"
            }
        };
        let numbers = match self.numbers {
            Numbers::Double(accuracy) => {
                let exactly = match self.engine {
                    Engine::Lattice | Engine::Chain => {
                        "; exact ones where an event and a ray coincide within their bounds"
                    }
                    _ if self.cells.is_some() => {
                        "; those and a proof where bounds leave open what happens at the ground"
                    }
                    _ => "",
                };
                format!(
                    "doubles with an error bound; longer numbers where the bound is above {:e} of the greatest number \
                     of an answer{exactly}",
                    accuracy.unwrap_or(DEFAULT_ACCURACY)
                )
            }
            Numbers::Digits(digits) => {
                let proved = match self.cells {
                    Some(_) => format!("; the run is proved, up to {MOST_PROVED} bits and where nothing stays open"),
                    None => String::new(),
                };
                format!("{digits} digits are asked for: bits are added until the error bound leaves that many{proved}")
            }
            Numbers::Certified(digits) => format!(
                "{digits} proved digits are asked for: enclosures, with bits added until every comparison is settled \
                 and every digit known"
            ),
            Numbers::Exact => "fractions are asked for: the run stops where a root is irrational".into(),
            Numbers::ExactThenDigits(digits) => {
                format!("fractions are asked for, and {digits} digits of the whole run where they end")
            }
        };
        let mut reasons = vec![engine.to_string(), numbers];
        if self.foreseen_loss >= 1.0 {
            reasons.push(format!(
                "rounding at the impacts is foreseen to take {:.0} digits, and as many more are carried",
                self.foreseen_loss
            ));
        }
        reasons
    }

    /// Returns the limits of the plan, one sentence each.
    pub fn limits(&self) -> Vec<String> {
        let mut limits = Vec::new();
        let Goal { digits, spare, .. } = self.goal;
        if digits > 0.0 {
            limits.push(format!(
                "a number is settled at {digits:.0} digits, or at {:.0} below the greatest of its answer",
                digits + spare
            ));
        }
        let Climb { bits, most_bits, most_enclosed, exact_contacts, .. } = self.climb;
        if let Some(contacts) = exact_contacts.filter(|_| matches!(self.numbers, Numbers::Double(_))) {
            limits.push(format!("exact numbers decide meetings of events through {contacts} contacts"));
        }
        limits.push(match bits <= most_bits {
            true => format!("longer numbers have {bits} to {most_bits} bits, enclosures up to {most_enclosed}"),
            false => "no longer numbers than doubles".into(),
        });
        if let Some(CellLimits { double_digits, double_cells, long_cells, most_digits }) = self.cells {
            let long = long_cells.map_or(String::new(), |cells| format!(", {cells} in {FEWEST_BITS} bits"));
            limits.push(format!(
                "cells: {double_digits} digits and {double_cells} cells in doubles{long}; none beyond {most_digits} \
                 digits"
            ));
        }
        limits
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

    /// Returns the limits of a damped march in the numbers of `rung`. A run that has lost its events is useless if
    /// longer numbers follow.
    pub(super) fn effort(&self, rung: Rung) -> Effort {
        let CellLimits { double_digits, double_cells, long_cells, .. } = self.cells.unwrap_or(CELLS);
        let (digits, cells) = match rung {
            Rung::Bits(bits) | Rung::Enclosures(bits) => {
                let fewer = |cells: u64| (cells as f64 * (f64::from(FEWEST_BITS) / f64::from(bits)).powi(2)) as u64;
                let all = f64::from(bits) * std::f64::consts::LOG10_2 - 19.0;
                let needed = self.series_bits.filter(|_| bits == self.climb.bits);
                let digits = needed.map_or(all, |needed| all.min(series_digits(needed)));
                (digits, long_cells.map_or(u64::MAX, fewer))
            }
            _ => (double_digits, double_cells),
        };
        Effort { digits, cells, until_lost: self.may_climb() }
    }

    /// Returns the plan after a run in doubles that lacks this many bits.
    ///
    /// The bound of a march is roughly proportional to the truncation of its series and the roundings of its numbers;
    /// in doubles the roundings dominate. If this proportion fails, the rung after the next uses all terms.
    pub(crate) fn lacking(&self, missing: f64) -> Self {
        let bits = f64::from(f64::MANTISSA_DIGITS) + missing.max(0.0);
        Plan { series_bits: Some(bits), ..self.clone() }
    }

    /// Returns the digits of the series of a proof in this many bits. The first longer numbers use the digits that the
    /// answer needs plus the estimated cost of the proof; later ones use all.
    pub(super) fn proved_digits(&self, bits: u32) -> f64 {
        let all = f64::from(bits) * std::f64::consts::LOG10_2;
        let first = if self.rung == Rung::Double { self.climb.bits } else { self.rung.bits() };
        let wanted = self.goal.digits * std::f64::consts::LOG2_10;
        let spare = if matches!(self.numbers, Numbers::Digits(_)) { self.goal.spare } else { 0.0 };
        let needed = wanted + spare * std::f64::consts::LOG2_10 + f64::from(self.proof_bits + PROOF_GUARD_BITS);
        if bits == first { all.min(series_digits(needed)) } else { all }
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

/// Returns the digits for series with a truncation below `2^−bits`.
fn series_digits(bits: f64) -> f64 {
    (bits + SERIES_GUARD_BITS - EFFORT_BITS) * std::f64::consts::LOG10_2
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

impl Rung {
    /// Returns the bits of the significand; those of a double for fractions.
    pub(super) fn bits(self) -> u32 {
        match self {
            Rung::Bits(bits) | Rung::Confirmed(bits) | Rung::Enclosures(bits) => bits,
            Rung::Double | Rung::Fractions => f64::MANTISSA_DIGITS,
        }
    }
}

impl Reach {
    fn run(problem: &Problem) -> Self {
        match problem.run() {
            Run::Impacts(contacts) => Reach::Contacts(*contacts),
            Run::Time(time) => Reach::Time(time.clone()),
        }
    }
}

impl std::fmt::Display for Reach {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Reach::Contacts(1) => f.write_str("through the first contact and the flight after it"),
            Reach::Contacts(contacts) => write!(f, "through {contacts} contacts and the flight after the last"),
            Reach::FirstContact => f.write_str("to the end of the first contact"),
            Reach::Time(time) => write!(f, "to t = {time}"),
        }
    }
}
