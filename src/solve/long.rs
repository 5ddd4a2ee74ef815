//! The planned engine, run in long numbers and enclosures.

use std::sync::Arc;

use super::asked::Asked;
use super::converted::Converted;
use super::fractions::confirmed;
use super::ladder::{Engined, Observer, Target};
use super::plan::{Engine, Lacks, Plan, Rung};
use super::proved::Proved;
use crate::cells::{ContactThenCells, Damped, Effort, FirstRelease};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::lattice::Undamped;
use crate::motion::Motion;
use crate::number::{Ball, Estimate, Float, Interval, IntervalPrecision, Reads, Scalar};
use crate::problem::{Parameters, Problem};

impl Target for Float {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Float>, Error> {
        match rung {
            Rung::Enclosures(bits) => Ok(Arc::new(Converted::new(enclosures(problem, plan, bits, observe)?))),
            rung => estimates(problem, plan, bits_of(rung), observe),
        }
    }
}

impl Target for Interval {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Interval>, Error> {
        enclosures(problem, plan, bits_of(rung), observe)
    }
}

/// An attempt in more bits than doubles have, read in doubles.
pub(super) fn in_doubles(
    problem: &Problem,
    plan: &Plan,
    rung: Rung,
    observe: &Observer,
) -> Result<Engined<f64>, Error> {
    fn read<N: Scalar>(engine: Arc<dyn Motion<N>>, problem: &Problem) -> Engined<f64>
    where
        Estimate<f64>: Reads<N>,
    {
        Arc::new(Asked::longer(Converted::new(engine), problem))
    }
    Ok(match rung {
        Rung::Enclosures(bits) => read(enclosures(problem, plan, bits, observe)?, problem),
        Rung::Confirmed(bits) => confirmed(problem, plan, roots(problem, plan, bits, observe)?, observe)?,
        rung => read(estimates(problem, plan, bits_of(rung), observe)?, problem),
    })
}

fn bits_of(rung: Rung) -> u32 {
    match rung {
        Rung::Bits(bits) | Rung::Confirmed(bits) | Rung::Enclosures(bits) => bits,
        Rung::Double | Rung::Fractions => f64::MANTISSA_DIGITS,
    }
}

fn estimates(problem: &Problem, plan: &Plan, bits: u32, observe: &Observer) -> Result<Engined<Float>, Error> {
    let problem = &*plan.reaching(problem);
    let effort = plan.effort(Rung::Bits(bits));
    Ok(match plan.engine {
        Engine::Lattice => {
            let limits = plan.lattice_limits(problem);
            let history = Undamped::<Estimate<Float>>::solve_within(problem, &bits, limits, &**observe)?;
            if history.undetermined_from().is_some() {
                return Err(Error::NotDecided { what: "in which order the events come", bits });
            }
            Arc::new(Asked::new(history, problem))
        }
        Engine::Cells => {
            let history = Damped::<Float>::solve_observed(problem, &bits, effort, 1, &**observe)?;
            Arc::new(Asked::new(history, problem))
        }
        Engine::ClosedForm if !plan.settles_events => {
            Arc::new(Asked::new(ContactHistory::<Estimate<Float>>::solve(problem, &bits)?, problem))
        }
        Engine::ClosedForm | Engine::ClosedFormThenCells => {
            let rod = Parameters::<Estimate<Float>>::of(problem, &bits)?;
            let bounce = FirstContact::new(&rod).bounce();
            if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
                return Err(Error::NotDecided { what: "how the first contact ends", bits });
            }
            if plan.engine == Engine::ClosedForm {
                let history = ContactThenCells::<Float>::first_contact(problem, &bits, bounce)?;
                return Ok(Arc::new(Asked::new(history, problem)));
            }
            let history = ContactThenCells::<Float>::solve_observed(problem, &bits, effort, bounce, None, &**observe)?;
            Arc::new(Asked::new(history, problem))
        }
    })
}

/// `h′` at the bounce that doubles have found, in numbers of so many bits: the first flight, and all that follows, hangs on it.
pub(super) fn rate_after(problem: &Problem, bounce: &Bounce<Estimate<f64>>, bits: u32) -> Option<Estimate<f64>> {
    let Bounce::At { time, trips, .. } = bounce else { return None };
    let contact = FirstContact::new(&Parameters::<Estimate<Float>>::of(problem, &bits).ok()?);
    let time = match trips.lattice() {
        Some(k) => contact.round_trip() * &contact.round_trip().int(k),
        None => Estimate::exact(Float::with_val(bits, time.value())),
    };
    let (_, rate) = contact.centre(&time);
    Some(Reads::read(rate))
}

/// Enclosures with exact roots inside, of an undamped rod.
fn roots(problem: &Problem, plan: &Plan, bits: u32, observe: &Observer) -> Result<Undamped<Interval>, Error> {
    let (problem, precision) = (&*plan.reaching(problem), IntervalPrecision::with_exact(bits));
    Undamped::<Interval>::solve_within(problem, &precision, plan.lattice_limits(problem), &**observe)
}

fn enclosures(problem: &Problem, plan: &Plan, bits: u32, observe: &Observer) -> Result<Engined<Interval>, Error> {
    let problem = &*plan.reaching(problem);
    let contact = || ContactHistory::<Interval>::solve(problem, &IntervalPrecision::with_exact(bits));
    Ok(match plan.engine {
        Engine::Lattice => Arc::new(roots(problem, plan, bits, observe)?),
        Engine::Cells => return Err(Error::NotCertified),
        Engine::ClosedForm => Arc::new(contact()?),
        Engine::ClosedFormThenCells => match first_release(problem, bits)? {
            Some(first) => match proved(problem, plan, bits, &first, observe)? {
                Some(run) => run,
                None => Arc::new(contact()?),
            },
            None => Arc::new(contact()?),
        },
    })
}

/// The first release by its closed form, if there is one.
fn first_release(problem: &Problem, bits: u32) -> Result<Option<FirstRelease<Ball>>, Error> {
    let rod = Parameters::<Interval>::of(problem, &IntervalPrecision::bits(bits))?;
    let contact = FirstContact::new(&rod);
    match contact.bounce() {
        Bounce::At { time, trips, .. } => Ok(Some(match trips.lattice() {
            Some(k) => FirstRelease::Ray(k),
            None => FirstRelease::Root((time / contact.round_trip()).give(&bits).into_value()),
        })),
        Bounce::Undecided { why, .. } if why.needs_bits() => {
            Err(Error::NotDecided { what: "how the first contact ends", bits })
        }
        _ => Ok(None),
    }
}

/// A damped run in numbers that enclose each of its steps, and what that proves. Where more bits may prove more, they
/// are asked for first; `None` where nothing is proved beyond the first contact.
fn proved(
    problem: &Problem,
    plan: &Plan,
    bits: u32,
    first: &FirstRelease<Ball>,
    observe: &Observer,
) -> Result<Option<Engined<Interval>>, Error> {
    let rung = Rung::Enclosures(bits);
    let effort = Effort { digits: f64::from(bits) * std::f64::consts::LOG10_2, until_lost: false, ..plan.effort(rung) };
    let run = Damped::<Ball>::solve_observed(problem, &bits, effort, 1, &**observe)?;
    let last = plan.next(rung, Lacks::Bits(f64::INFINITY)).is_none();
    let open = Err(Error::NotDecided { what: "what happens at the ground", bits });
    Ok(match run.proved(first) {
        // The closed form knows as much.
        Ok((run, false)) if run.events().len() <= 2 => None,
        Err(Error::NotDecided { .. }) => None,
        Ok((_, false)) if !last => return open,
        found => Some(Arc::new(Proved::new(found?.0))),
    })
}
