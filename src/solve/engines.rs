//! The planned engine, run in doubles.

use std::sync::Arc;

use super::ladder::{Engined, Observer, Target};
use super::plan::{Engine, Plan, Rung};
use super::{fractions, long};
use crate::cells::{self, ContactThenCells, Damped, WithBounds};
use crate::error::Error;
use crate::first_contact::{Bounce, FirstContact};
use crate::lattice::Undamped;
use crate::modal::Modal;
use crate::motion::Side;
use crate::number::Estimate;
use crate::problem::{Parameters, Problem};

impl Target for f64 {
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<f64>, Error> {
        match rung {
            Rung::Double => {}
            Rung::Fractions => return fractions::in_doubles(problem, plan, observe),
            rung => return long::in_doubles(problem, plan, rung, observe),
        }
        let problem = &*plan.reaching(problem);
        Ok(match plan.engine {
            Engine::Lattice => {
                let history =
                    Undamped::<Estimate<f64>>::solve_within(problem, &(), plan.limits(problem), |a, b| observe(a, b))?;
                if cfg!(feature = "mp") && history.undetermined_from().is_some() {
                    return Err(Error::NotDecided { what: "in which order the events come", bits: 53 });
                }
                Arc::new(history)
            }
            Engine::Cells => Arc::new(WithBounds::new(Damped::<f64>::solve_observed(
                problem,
                &(),
                plan.effort(rung),
                1,
                &**observe,
            )?)?),
            Engine::ClosedForm | Engine::ClosedFormThenCells => {
                let rod = Parameters::<Estimate<f64>>::of(problem, &())?;
                let contact = FirstContact::new(&rod);
                let mut bounce = contact.bounce();
                if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
                    if cfg!(feature = "mp") {
                        return Err(Error::NotDecided { what: "how the first contact ends", bits: 53 });
                    }
                    bounce = by_modes(&contact, problem)?;
                }
                let (reach, rate) = match plan.engine {
                    Engine::ClosedForm => (cells::Reach::Bounce, None),
                    _ => (cells::Reach::Run, long::rate_after(problem, &bounce)),
                };
                Arc::new(WithBounds::new(ContactThenCells::<f64>::solve_observed(
                    problem,
                    &(),
                    plan.effort(rung),
                    (bounce, reach),
                    rate,
                    &**observe,
                )?)?)
            }
        })
    }
}

/// Modes that are summed where the rays cancel and there are no longer numbers: with them the stress is known to some
/// 10⁻¹¹ of the lowest mode at `τR² ≈ 300`, which is `R → π` and 30 round trips.
const MODES: u32 = 4096;

/// How the first contact ends by the sum over its modes, which does not cancel late in the contact as that over rays
/// does.
fn by_modes(contact: &FirstContact<Estimate<f64>>, problem: &Problem) -> Result<Bounce<Estimate<f64>>, Error> {
    let modal = Modal::new(&Parameters::<f64>::of(problem, &())?, MODES);
    // The last moment of a cell belongs to it.
    let side = |trips: &f64, k: i64| if *trips == (k + 1) as f64 { Side::Left } else { Side::Right };
    Ok(contact.bounce_by(&|trips, k| modal.ground(trips.value(), side(trips.value(), k))))
}
