//! Runs of the planned engine in doubles and in fractions.

use std::sync::Arc;

use super::asked::{Longer, Open, Telling};
use super::converted::{Converted, confirmed};
use super::derivative::{Asked, Computed};
use super::ladder::{Engined, Target};
use super::plan::{DEFAULT_ACCURACY, Engine, LONG, LONGEST, Plan, Rung};
use super::planned::estimates;
use super::question::Observer;
use super::{chain, interpolated, long, rates};
use crate::error::Error;
use crate::motion::{Ending, Motion};
use crate::number::{Estimate, Rational, Reads};
use crate::problem::Problem;

impl Target for f64 {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<f64>, Error> {
        if plan.engine == Engine::Chain {
            let engine = if rung == Rung::Double {
                chain::motion::<Estimate<f64>>(problem, plan, (rung, &()), observe)?
            } else {
                let run = long_chain(problem, plan, rung, observe)?;
                // Without longer numbers the first attempt answers.
                match LONG.then(|| chain::sketch(problem, plan, &*run, observe)).flatten() {
                    Some(sketch) => sketch,
                    None => return Ok(run),
                }
            };
            let rungs = plan.chain_rungs().into_iter().skip(1).collect();
            let owned = (problem.clone(), plan.clone(), observe.clone());
            let run = move |rung| long_chain(&owned.0, &owned.1, rung, &owned.2);
            let longer = Longer::<f64> { rungs, exact_contacts: u32::MAX, run: Box::new(run) };
            return Ok(Telling::of(Arc::new(engine), problem, Open::Says(longer)));
        }
        // A run that exact numbers confirm is in doubles.
        let exact = matches!(rung, Rung::Fractions | Rung::Confirmed(_));
        let longer = longer(problem, plan, if exact { Rung::Double } else { rung }, observe);
        match rung {
            Rung::Double => {}
            Rung::Fractions => {
                let exact = match plan.lattice::<Rational>(problem, &(), observe) {
                    Err(Error::Irrational { .. }) => None,
                    exact => Some(exact?).filter(|exact| !matches!(exact.ending(), Ending::ExactnessEnds { .. })),
                };
                let exact = exact.ok_or(Error::NotDecided { what: "by fractions", bits: 0 })?;
                return confirmed(problem, plan, exact, longer, observe);
            }
            rung if rung.bits() <= LONGEST => return long::in_doubles(problem, plan, (rung, longer), observe),
            _ => return Err(not_in_doubles()),
        }
        let problem = &*plan.reaching(problem);
        let task = plan.task::<f64>(problem, &(), rung, observe);
        let engine = estimates(plan, &task, rung.bits(), |march| march())?;
        Ok(Telling::of(engine, problem, Open::Ask(longer)))
    }

    /// Computes derivatives from doubles if the request does not exceed their accuracy and nothing jumps or bends;
    /// otherwise from difference quotients to the digits of the run, rounded up.
    fn derivatives(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Computed<Estimate<f64>>, Error> {
        if asked.plan.goal.digits <= -DEFAULT_ACCURACY.log10() {
            for way in [rates::in_doubles, rates::by_fractions] {
                if let Ok(Some(found)) = way(asked, run) {
                    return Ok(Computed::bounded(found));
                }
            }
            if let Ok(Some(found)) = interpolated::of(asked, run) {
                return Ok(Computed::estimated(found));
            }
        }
        let digits = asked.plan.goal.digits.ceil() as u32;
        let found = long::quotients(asked, digits)?;
        let rows =
            found.into_iter().map(|row| row.into_iter().map(|cell| cell.map(|it| it.map(Reads::read))).collect());
        Ok(Computed::estimated(rows.collect()))
    }
}

/// Makes an attempt at a chain in fractions or in more bits than doubles have, converted to doubles.
fn long_chain(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<f64>, Error> {
    match rung {
        Rung::Fractions => {
            Ok(Arc::new(Converted::new(chain::engine::<Rational>(problem, plan, (rung, &()), observe)?)))
        }
        rung if LONG => long::chain_in_doubles(problem, plan, rung, observe),
        _ => Err(not_in_doubles()),
    }
}

/// Returns the error of a build without longer numbers.
fn not_in_doubles() -> Error {
    Error::NotDecided { what: "what the answer is", bits: f64::MANTISSA_DIGITS }
}

impl Target for Rational {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Rational>, Error> {
        if plan.engine == Engine::Chain {
            return chain::engine::<Rational>(problem, plan, (rung, &()), observe);
        }
        Ok(Arc::new(plan.lattice::<Rational>(problem, &(), observe)?))
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Computed<Rational>, Error> {
        rates::in_fractions(asked).map(Computed::bounded)
    }
}

/// Returns the runs that distinguish a time from an event or a ray if a run in `rung` does not: fractions for an
/// undamped rod with few enough bounces, and runs with more and more bits.
fn longer(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Longer<f64> {
    let (rungs, exact_contacts) = (plan.telling(rung), plan.climb.exact_contacts.unwrap_or(0));
    let (problem, plan, observe) = (problem.clone(), plan.clone(), observe.clone());
    let run = move |rung: Rung| match rung {
        Rung::Fractions => {
            let exact: Engined<Rational> = Arc::new(plan.lattice(&problem, &(), &observe)?);
            Ok(Arc::new(Converted::new(exact)) as Engined<f64>)
        }
        rung if rung.bits() <= LONGEST => long::read(&problem, &plan, rung, &observe),
        _ => Err(not_in_doubles()),
    };
    Longer { rungs, exact_contacts, run: Box::new(run) }
}
