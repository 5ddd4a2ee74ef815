//! Runs of the planned engine in long numbers and enclosures.

use std::sync::Arc;

use super::asked::{Longer, Open, TimeResolver, not_told};
use super::chain;
use super::converted::{Converted, confirmed};
use super::derivative::{Asked, Computed};
pub(super) use super::differences::of as quotients;
use super::in_floats::in_floats;
use super::ladder::{Engined, Ladder, Target, needs_bits};
use super::plan::{Engine, MOST_PROVED, Plan};
use super::planned::{self, March};
use super::question::{Numbers, Observer};
use super::rung::{LONG, Lacks, Rung};
use crate::cells::{Damped, Effort, Task};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::lattice::Undamped;
use crate::motion::{Ending, Motion};
use crate::number::{Estimate, Float, Interval, IntervalPrecision, Wide};
use crate::problem::{Parameters, Problem};
use crate::special::RoundedSpecial;

/// Evaluates an expression in the numbers for this many bits: up to 384 bits in numbers on the stack, which are several
/// times as fast, beyond in MPFR's. A build without numbers of any length has those of 128 bits. In the expression the
/// first name is their type, the second their precision.
macro_rules! in_numbers {
    ($bits:expr, |$s:ident, $precision:ident| $body:expr) => {
        in_numbers!($bits, |$s, $precision| $body, $body)
    };
    ($bits:expr, |$s:ident, $precision:ident| $stack:expr, $any:expr) => {
        match $bits {
            bits if !LONG || bits <= 128 => in_numbers!(@ Wide<2>, &(), $s, $precision, $stack),
            ..=256 => in_numbers!(@ Wide<4>, &(), $s, $precision, $stack),
            ..=384 => in_numbers!(@ Wide<6>, &(), $s, $precision, $stack),
            _ => in_numbers!(@ Float, &$bits, $s, $precision, $any),
        }
    };
    (@ $type:ty, $with:expr, $s:ident, $precision:ident, $body:expr) => {{
        type $s = $type;
        let $precision = $with;
        $body
    }};
}

impl Target for Float {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Float>, Error> {
        let ladder = Ladder { problem, plan, observe };
        match rung {
            Rung::Bits(bits) if plan.engine == Engine::Chain => Ok(in_numbers!(
                bits,
                |S, precision| in_floats(chain::engine::<Estimate<S>>(ladder, (rung, precision))?),
                chain::engine::<Estimate<S>>(ladder, (rung, precision))?
            )),
            Rung::Enclosures(bits) => Ok(Arc::new(Converted::new(enclosures(ladder, bits)?))),
            rung => {
                let bits = rung.bits();
                let run: Engined<Float> = in_numbers!(
                    bits,
                    |S, precision| in_floats(estimates::<S>(ladder, bits, precision)?),
                    estimates::<S>(ladder, bits, precision)?
                );
                // An event of an undamped rod may be exactly at the queried time.
                if plan.engine == Engine::Lattice {
                    return Ok(run);
                }
                let digits = plan.goal.digits as u32;
                let last = bits >= MOST_TIMES * plan.rung.bits();
                let error = if last { Error::Unsettled { digits, bits } } else { not_told(Some(bits)) };
                Ok(TimeResolver::<Float>::of(run, problem, Open::Refuse(error)))
            }
        }
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Computed<Estimate<Float>>, Error> {
        let rows = quotients(asked, asked.plan.goal.digits.ceil() as u32)?;
        Ok(Computed { rows, is_estimated: true })
    }
}

/// Maximum factor on the first number of bits, for runs that distinguish a time from that of an event or a ray.
const MOST_TIMES: u32 = 4;

impl Target for Interval {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Interval>, Error> {
        enclosures(Ladder { problem, plan, observe }, rung.bits())
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Computed<Interval>, Error> {
        Err(Error::Derivative { parameter: asked.by, expected: "digits that need not be proved" })
    }
}

/// Makes an attempt in more bits than doubles have, converted to doubles; `longer` answers undecided times.
pub(super) fn in_doubles(ladder: Ladder<'_>, rung: Rung, longer: Longer<f64>) -> Result<Engined<f64>, Error> {
    Ok(match rung {
        Rung::Enclosures(bits) if LONG => Arc::new(Converted::new(enclosures(ladder, bits)?)),
        Rung::Confirmed(bits) if LONG => confirmed(ladder, roots(ladder, bits)?, longer)?,
        rung => TimeResolver::of(read(ladder, rung)?, ladder.problem, Open::Says(longer)),
    })
}

/// Makes an attempt at a chain in more bits than doubles have, converted to doubles.
pub(super) fn chain_in_doubles(ladder: Ladder<'_>, rung: Rung) -> Result<Engined<f64>, Error> {
    if let Rung::Enclosures(bits) = rung {
        return Ok(Arc::new(Converted::new(enclosures(ladder, bits)?)));
    }
    Ok(in_numbers!(rung.bits(), |S, precision| {
        Arc::new(Converted::new(chain::engine::<Estimate<S>>(ladder, (rung, precision))?))
    }))
}

/// Makes an attempt in this many bits, converted to doubles; it reports times that it does not decide.
pub(super) fn read(ladder: Ladder<'_>, rung: Rung) -> Result<Engined<f64>, Error> {
    let bits = rung.bits();
    Ok(in_numbers!(bits, |S, precision| Arc::new(Converted::new(estimates::<S>(ladder, bits, precision)?))))
}

fn estimates<S: RoundedSpecial>(ladder: Ladder<'_>, bits: u32, precision: &S::Precision) -> Result<Engined<S>, Error> {
    let (plan, problem) = (ladder.plan, &*ladder.plan.reaching(ladder.problem));
    let task = Ladder { problem, ..ladder }.task::<S>(precision, Rung::Bits(bits));
    planned::estimates(plan, &task, bits, |march| marched(plan, &task, bits, march))
}

/// Makes a damped run: the proved one if the proof reaches its end, otherwise the run of `march`. For digits the proof
/// comes first; for an answer in doubles it is tried only if the bounds of `march` leave events open.
fn marched<S: RoundedSpecial>(
    plan: &Plan,
    task: &Task<'_, S>,
    bits: u32,
    march: March<'_, S>,
) -> Result<Engined<S>, Error> {
    let run = if matches!(plan.numbers, Numbers::Digits(_)) { None } else { Some(march()?) };
    if bits <= MOST_PROVED && run.as_ref().is_none_or(|run| needs_bits(&**run)) {
        match prove(plan, task, bits) {
            Ok(run) if !matches!(run.ending(), Ending::Unproved { .. }) => return Ok(Arc::new(run)),
            Ok(_) | Err(Error::NotDecided { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    run.map_or_else(march, Ok)
}

fn prove<S: RoundedSpecial>(plan: &Plan, task: &Task<'_, S>, bits: u32) -> Result<Damped<S>, Error> {
    let effort = Effort { digits: plan.proved_digits(bits), until_lost: false, ..task.effort };
    Damped::march(&Task { effort, ..*task }, true)
}

/// Computes enclosures with exact roots inside, for an undamped rod.
fn roots(ladder: Ladder<'_>, bits: u32) -> Result<Undamped<Interval>, Error> {
    ladder.lattice(&IntervalPrecision::with_exact(bits))
}

fn enclosures(ladder: Ladder<'_>, bits: u32) -> Result<Engined<Interval>, Error> {
    let (plan, problem) = (ladder.plan, &*ladder.plan.reaching(ladder.problem));
    let ladder = Ladder { problem, ..ladder };
    match plan.engine {
        Engine::Chain => {
            let precision = IntervalPrecision::with_exact(bits);
            chain::engine::<Interval>(ladder, (Rung::Enclosures(bits), &precision))
        }
        Engine::Lattice => Ok(Arc::new(roots(ladder, bits)?)),
        Engine::Cells if !problem.has_closed_form() => proved(ladder, bits),
        // For more digits than a march can prove, the first contact provides all of them.
        Engine::Cells if bits <= MOST_PROVED && bounces(problem, bits)? => match proved(ladder, bits) {
            Err(Error::NotDecided { .. }) if last_proof(plan, bits) => contact(problem, bits),
            run => run,
        },
        Engine::Cells | Engine::ClosedForm => contact(problem, bits),
    }
}

fn contact(problem: &Problem, bits: u32) -> Result<Engined<Interval>, Error> {
    Ok(Arc::new(ContactHistory::<Interval>::solve(problem, &IntervalPrecision::with_exact(bits))?))
}

fn bounces(problem: &Problem, bits: u32) -> Result<bool, Error> {
    let rod = Parameters::<Interval>::of(problem, &IntervalPrecision::bits(bits))?;
    match FirstContact::new(&rod).bounce() {
        Bounce::At { .. } => Ok(true),
        Bounce::Undecided { why, .. } if why.needs_bits() => {
            Err(Error::NotDecided { what: "how the first contact ends", bits })
        }
        Bounce::Never(_) | Bounce::Undecided { .. } => Ok(false),
    }
}

fn last_proof(plan: &Plan, bits: u32) -> bool {
    plan.next(Rung::Enclosures(bits), Lacks::Bits(f64::INFINITY)).is_none()
}

/// Makes a proved damped run; returns an error first if more bits may prove more.
fn proved(ladder: Ladder<'_>, bits: u32) -> Result<Engined<Interval>, Error> {
    let Ladder { problem, plan, .. } = ladder;
    if bits > MOST_PROVED {
        return Err(Error::Undecided { digits: plan.goal.digits as u32, bits: MOST_PROVED });
    }
    in_numbers!(bits, |S, precision| {
        let run = prove::<S>(plan, &ladder.task(precision, Rung::Bits(bits)), bits)?;
        if matches!(run.ending(), Ending::Unproved { .. }) && !last_proof(plan, bits) {
            return Err(Error::NotDecided { what: "what happens at the ground", bits });
        }
        let rod = Parameters::of(problem, &IntervalPrecision::bits(bits))?;
        Ok(Arc::new(Converted::new(Arc::new(run) as Engined<S>).of_rod(&rod)))
    })
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/long.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
