//! The planned engine in rounded numbers with their error bound.

use std::sync::Arc;

use super::ladder::Engined;
use super::plan::{Engine, Plan};
use super::rung::LONG;
use crate::cells::{Damped, EstimatedContact, MOST_DIGITS, Task};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::lattice::Undamped;
use crate::number::Estimate;
use crate::problem::Parameters;
use crate::special::RoundedSpecial;

/// A function that makes a damped run.
pub(super) type March<'a, S> = &'a dyn Fn() -> Result<Engined<S>, Error>;

/// Runs the planned engine in numbers with their error bound; `marched` turns a march into the run.
pub(super) fn estimates<S: RoundedSpecial>(
    plan: &Plan,
    task: &Task<'_, S>,
    bits: u32,
    marched: impl Fn(March<'_, S>) -> Result<Engined<S>, Error>,
) -> Result<Engined<S>, Error> {
    let Task { problem, precision, .. } = *task;
    let march = || Ok(Arc::new(Damped::march(task, false)?) as Engined<S>);
    let undecided = |what| Error::NotDecided { what, bits };
    Ok(match plan.engine {
        Engine::Chain => return Err(undecided("a chain by an engine of a single rod")),
        Engine::Lattice => {
            let limits = plan.lattice_limits(problem);
            let history = Undamped::<Estimate<S>>::solve_within(problem, precision, limits, task.observe)?;
            if LONG && history.undetermined_from().is_some() {
                return Err(undecided("in which order the events come"));
            }
            Arc::new(history)
        }
        Engine::Cells if !problem.has_closed_form() => marched(&march)?,
        Engine::Cells | Engine::ClosedForm => {
            let contact = FirstContact::new(&Parameters::<Estimate<S>>::of(problem, precision)?);
            let bounce = contact.bounce();
            if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
                return Err(undecided("how the first contact ends"));
            }
            match plan.engine {
                // A contact that never ends is known at all times.
                Engine::Cells if matches!(bounce, Bounce::At { .. }) => {
                    if task.effort.digits > MOST_DIGITS {
                        let contact = EstimatedContact::<S>::new(problem, precision, bounce)?;
                        return Ok(Arc::new(contact.without_flight()));
                    }
                    marched(&march)?
                }
                Engine::ClosedForm if !plan.settles_events => Arc::new(ContactHistory::new(contact, bounce, None)?),
                _ => Arc::new(EstimatedContact::<S>::new(problem, precision, bounce)?),
            }
        }
    })
}
