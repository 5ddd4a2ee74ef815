//! The planned engine, run in doubles and in fractions.

use std::sync::Arc;

use super::asked::{Longer, Open, Telling};
use super::converted::{Converted, confirmed};
use super::derivative::{Asked, Derivatives};
use super::ladder::{Engined, Target};
use super::plan::{DEFAULT_ACCURACY, Engine, Plan, Rung};
use super::question::Observer;
use super::{differences, interpolated, long, rates};
use crate::cells::{ContactThenCells, Damped, Task};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::lattice::Undamped;
use crate::mapped::mapped;
use crate::modal::Modal;
use crate::motion::{Ending, Motion, Side};
use crate::number::{Estimate, Rational, Reads};
use crate::problem::{Parameters, Problem};
use crate::special::RoundedSpecial;

impl Target for f64 {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<f64>, Error> {
        // What exact numbers confirm is in doubles.
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
            rung => return long::in_doubles(problem, plan, (rung, longer), observe),
        }
        let problem = &*plan.reaching(problem);
        let task = plan.task::<f64>(problem, &(), rung, observe);
        let rate = |bounce: &Bounce<_>| plan.rate_bits.and_then(|bits| long::rate_after(problem, bounce, bits));
        let engine = estimates(plan, &task, rung.bits(), rate, |march| march())?;
        Ok(Telling::of(engine, problem, Open::Ask(longer)))
    }

    /// From doubles, where no more is asked for than they have and nothing jumps or bends; where they do not settle it,
    /// one digit more than the run is asked for.
    fn derivatives(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Derivatives<Estimate<f64>>, Error> {
        if asked.plan.goal.digits <= -DEFAULT_ACCURACY.log10() {
            for way in [rates::in_doubles, rates::by_fractions, interpolated::of] {
                if let Ok(Some(found)) = way(asked, run) {
                    return Ok(found);
                }
            }
        }
        let digits = asked.plan.goal.digits.ceil() as u32;
        let found = differences::of(asked, digits)?;
        Ok(mapped(found, |row| mapped(row, |cell| cell.map(|it| it.map(Reads::read)))))
    }
}

/// A damped run.
pub(super) type March<'a, S> = &'a dyn Fn() -> Result<Engined<S>, Error>;

/// The planned engine, in numbers with their error bound; `rate` is `h′` at the bounce, where it is known better than a
/// march has it, and `marched` what is made of a march.
pub(super) fn estimates<S: RoundedSpecial>(
    plan: &Plan,
    task: &Task<'_, S>,
    bits: u32,
    rate: impl Fn(&Bounce<Estimate<S>>) -> Option<Estimate<S>>,
    marched: impl Fn(March<'_, S>) -> Result<Engined<S>, Error>,
) -> Result<Engined<S>, Error> {
    let Task { problem, precision, .. } = *task;
    let undecided = |what| Error::NotDecided { what, bits };
    Ok(match plan.engine {
        Engine::Lattice => {
            let limits = plan.lattice_limits(problem);
            let history = Undamped::<Estimate<S>>::solve_within(problem, precision, limits, task.observe)?;
            if plan.climb.bits.is_some() && history.undetermined_from().is_some() {
                return Err(undecided("in which order the events come"));
            }
            Arc::new(history)
        }
        Engine::Cells => marched(&|| Ok(Arc::new(Damped::march(task, 1, false)?)))?,
        Engine::ClosedForm | Engine::ClosedFormThenCells => {
            let contact = FirstContact::new(&Parameters::<Estimate<S>>::of(problem, precision)?);
            let mut bounce = contact.bounce();
            if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
                let modes = plan.modes.ok_or_else(|| undecided("how the first contact ends"))?;
                bounce = by_modes(&contact, &Modal::new(&Parameters::<S>::of(problem, precision)?, modes));
            }
            if plan.engine == Engine::ClosedFormThenCells {
                let (rate, bounces) = (rate(&bounce), matches!(bounce, Bounce::At { .. }));
                let march = || Ok(Arc::new(ContactThenCells::march(task, bounce.clone(), rate.clone())?) as Engined<S>);
                if bounces { marched(&march)? } else { march()? }
            } else if plan.settles_events {
                Arc::new(ContactThenCells::<S>::first_contact(problem, precision, bounce)?)
            } else {
                Arc::new(ContactHistory::new(contact, bounce, None)?)
            }
        }
    })
}

impl Target for Rational {
    fn run(problem: &Problem, plan: &Plan, _: Rung, observe: &Observer) -> Result<Engined<Rational>, Error> {
        Ok(Arc::new(plan.lattice::<Rational>(problem, &(), observe)?))
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Derivatives<Rational>, Error> {
        rates::in_fractions(asked)
    }
}

/// The runs that tell a time from an event or a ray where one in `rung` does not: fractions for a rod without damping
/// that has not bounced too often for them, and more and more bits.
fn longer(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Longer<f64> {
    let (rungs, exact_contacts) = (plan.telling(rung), plan.climb.exact_contacts.unwrap_or(0));
    let (problem, plan, observe) = (problem.clone(), plan.clone(), observe.clone());
    let run = move |rung: Rung| match rung {
        Rung::Fractions => {
            let exact: Engined<Rational> = Arc::new(plan.lattice(&problem, &(), &observe)?);
            Ok(Arc::new(Converted::new(exact)) as Engined<f64>)
        }
        rung => long::read(&problem, &plan, rung, &observe),
    };
    Longer { rungs, exact_contacts, run: Box::new(run) }
}

/// How the first contact ends by the sum over modes, which does not cancel late in the contact as that over
/// rays does.
fn by_modes<S: RoundedSpecial>(contact: &FirstContact<Estimate<S>>, modal: &Modal<S>) -> Bounce<Estimate<S>> {
    // The last moment of a cell belongs to it.
    let side = |trips: &S, k: i64| if *trips == trips.int(k + 1) { Side::Left } else { Side::Right };
    contact.bounce_by(&|trips, k| modal.ground(trips, side(trips.value(), k)))
}
