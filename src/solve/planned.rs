//! The planned engine in rounded numbers with their error bound.

use std::sync::Arc;

use super::ladder::Engined;
use super::plan::{Engine, Plan};
use crate::cells::{ContactThenCells, Damped, Task};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::lattice::Undamped;
use crate::number::Estimate;
use crate::problem::Parameters;
use crate::special::RoundedSpecial;

/// A function that makes a damped run.
pub(super) type March<'a, S> = &'a dyn Fn() -> Result<Engined<S>, Error>;

/// Runs the planned engine in numbers with their error bound. `rate` returns `h′` at the bounce if it is known better
/// than from the march, and `marched` turns a march into the run.
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
            if history.undetermined_from().is_some() {
                return Err(undecided("in which order the events come"));
            }
            Arc::new(history)
        }
        Engine::Cells => marched(&|| Ok(Arc::new(Damped::march(task, 1, false)?)))?,
        Engine::ClosedForm | Engine::ClosedFormThenCells => {
            let contact = FirstContact::new(&Parameters::<Estimate<S>>::of(problem, precision)?);
            let bounce = contact.bounce();
            if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
                return Err(undecided("how the first contact ends"));
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
