//! Runs of the planned engine in doubles and in fractions.

use std::sync::Arc;

use super::asked::{Longer, Open, TimeResolver};
use super::converted::{Converted, confirmed};
use super::derivative::{Asked, Computed, Derivative};
use super::ladder::{Engined, Ladder, Target};
use super::plan::{DEFAULT_ACCURACY, Engine, Plan};
use super::planned::estimates;
use super::question::Observer;
use super::rung::{LONG, LONGEST, Rung};
use super::{chain, interpolated, long, rates};
use crate::error::Error;
use crate::motion::{Ending, Motion};
use crate::number::{Estimate, Rational, Reads};
use crate::problem::Problem;

impl Target for f64 {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<f64>, Error> {
        let ladder = Ladder { problem, plan, observe };
        if plan.engine == Engine::Chain {
            let engine = if rung == Rung::Double {
                chain::motion::<Estimate<f64>>(ladder, (rung, &()))?
            } else {
                let run = long_chain(ladder, rung)?;
                // Without longer numbers the first attempt answers.
                match LONG.then(|| chain::sketch(ladder, &*run)).flatten() {
                    Some(sketch) => sketch,
                    None => return Ok(run),
                }
            };
            let rungs = plan.chain_rungs().into_iter().skip(1).collect();
            let longer = longer(ladder, rungs, u32::MAX, long_chain);
            return Ok(TimeResolver::of(Arc::new(engine), problem, Open::Says(longer)));
        }
        // A run that exact numbers confirm is in doubles.
        let exact = matches!(rung, Rung::Fractions | Rung::Confirmed(_));
        let rungs = plan.telling(if exact { Rung::Double } else { rung });
        let longer = longer(ladder, rungs, plan.climb.exact_contacts.unwrap_or(0), long_rod);
        match rung {
            Rung::Double => {}
            Rung::Fractions => {
                let exact = match ladder.lattice::<Rational>(&()) {
                    Err(Error::Irrational { .. }) => None,
                    exact => Some(exact?).filter(|exact| !matches!(exact.ending(), Ending::ExactnessEnds { .. })),
                };
                let exact = exact.ok_or(Error::NotDecided { what: "by fractions", bits: 0 })?;
                return confirmed(ladder, exact, longer);
            }
            rung if rung.bits() <= LONGEST => return long::in_doubles(ladder, rung, longer),
            _ => return Err(not_in_doubles()),
        }
        let problem = &*plan.reaching(problem);
        let task = Ladder { problem, ..ladder }.task::<f64>(&(), rung);
        let engine = estimates(plan, &task, rung.bits(), |march| march())?;
        Ok(TimeResolver::of(engine, problem, Open::Ask(longer)))
    }

    /// Computes derivatives from doubles if the request does not exceed their accuracy and nothing jumps or bends;
    /// otherwise from difference quotients to the digits of the run, rounded up.
    fn derivatives(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Computed<Estimate<f64>>, Error> {
        if asked.plan.goal.digits <= -DEFAULT_ACCURACY.log10() {
            for way in [rates::in_doubles, rates::by_fractions] {
                if let Ok(Some(rows)) = way(asked, run) {
                    return Ok(Computed { rows, is_estimated: false });
                }
            }
            if let Ok(Some(rows)) = interpolated::of(asked, run) {
                return Ok(Computed { rows, is_estimated: true });
            }
        }
        let digits = asked.plan.goal.digits.ceil() as u32;
        let read = |row: Vec<Option<Derivative<_>>>| row.into_iter().map(|cell| cell.map(|it| it.map(Reads::read)));
        let rows = long::quotients(asked, digits)?.into_iter().map(|row| read(row).collect()).collect();
        Ok(Computed { rows, is_estimated: true })
    }
}

/// Makes an attempt at a chain in fractions or in more bits than doubles have, converted to doubles.
fn long_chain(ladder: Ladder<'_>, rung: Rung) -> Result<Engined<f64>, Error> {
    match rung {
        Rung::Fractions => Ok(Arc::new(Converted::new(chain::engine::<Rational>(ladder, (rung, &()))?))),
        rung if LONG => long::chain_in_doubles(ladder, rung),
        _ => Err(not_in_doubles()),
    }
}

/// Returns the error of a build without longer numbers.
fn not_in_doubles() -> Error {
    Error::NotDecided { what: "what the answer is", bits: f64::MANTISSA_DIGITS }
}

impl Target for Rational {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Rational>, Error> {
        let ladder = Ladder { problem, plan, observe };
        if plan.engine == Engine::Chain {
            return chain::engine::<Rational>(ladder, (rung, &()));
        }
        Ok(Arc::new(ladder.lattice::<Rational>(&())?))
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Computed<Rational>, Error> {
        rates::in_fractions(asked).map(|rows| Computed { rows, is_estimated: false })
    }
}

/// Makes an attempt at a rod in fractions or in more bits than doubles have, converted to doubles.
fn long_rod(ladder: Ladder<'_>, rung: Rung) -> Result<Engined<f64>, Error> {
    match rung {
        Rung::Fractions => Ok(Arc::new(Converted::new(Arc::new(ladder.lattice::<Rational>(&())?)))),
        rung if rung.bits() <= LONGEST => long::read(ladder, rung),
        _ => Err(not_in_doubles()),
    }
}

/// Returns the runs that distinguish a time from an event or a ray if an attempt does not: `run` makes them.
fn longer(
    Ladder { problem, plan, observe }: Ladder<'_>,
    rungs: Vec<Rung>,
    exact_contacts: u32,
    run: fn(Ladder<'_>, Rung) -> Result<Engined<f64>, Error>,
) -> Longer<f64> {
    let (problem, plan, observe) = (problem.clone(), plan.clone(), observe.clone());
    let run = move |rung| run(Ladder { problem: &problem, plan: &plan, observe: &observe }, rung);
    Longer { rungs, exact_contacts, run: Box::new(run) }
}
