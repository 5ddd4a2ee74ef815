//! The planned engine, run in fractions, and doubles that exact numbers confirm.

use std::sync::Arc;

use super::asked::{Longer, Open, Telling};
use super::converted::Converted;
use super::derivative::{Asked, Derivatives};
use super::exact;
use super::ladder::{Engined, Observer, Target};
use super::plan::{Plan, Rung};
use crate::error::Error;
use crate::lattice::Undamped;
use crate::motion::{Ending, Motion};
use crate::number::{Bounded, Estimate, Rational, Reads};
use crate::problem::Problem;

impl Target for Rational {
    fn run(problem: &Problem, plan: &Plan, _: Rung, observe: &Observer) -> Result<Engined<Rational>, Error> {
        Ok(Arc::new(fractions(problem, plan, observe)?))
    }

    fn derivatives(asked: &Asked<'_>, _: &Engined<Self>) -> Result<Derivatives<Rational>, Error> {
        exact::derivatives(asked)
    }
}

/// Doubles that fractions confirm; `longer` are the runs for times that these do not tell.
///
/// **Errors**: [`Error::NotDecided`] where fractions end before the run does.
pub(super) fn in_doubles(
    problem: &Problem,
    plan: &Plan,
    longer: Longer<f64>,
    observe: &Observer,
) -> Result<Engined<f64>, Error> {
    let exact = match fractions(problem, plan, observe) {
        Err(Error::Irrational { .. }) => None,
        exact => Some(exact?).filter(|exact| !matches!(exact.ending(), Ending::ExactnessEnds { .. })),
    };
    confirmed(problem, plan, exact.ok_or(Error::NotDecided { what: "by fractions", bits: 0 })?, longer, observe)
}

/// Doubles, which answer faster than exact numbers, and within their bounds where all that they took for equal is
/// equal; otherwise the exact ones.
pub(super) fn confirmed<N>(
    problem: &Problem,
    plan: &Plan,
    exact: Undamped<N>,
    longer: Longer<f64>,
    observe: &Observer,
) -> Result<Engined<f64>, Error>
where
    N: Bounded,
    Undamped<N>: Motion<N>,
    Estimate<f64>: Reads<N>,
{
    let reached = plan.reaching(problem);
    let mut doubles = Undamped::<Estimate<f64>>::solve_within(&reached, &(), plan.lattice_limits(problem), &**observe)?;
    Ok(if doubles.confirm(&exact) {
        Telling::of(Arc::new(doubles), problem, Open::Ask(longer))
    } else {
        Arc::new(Converted::new(Arc::new(exact)))
    })
}

/// The run in fractions, read in doubles.
pub(super) fn read(problem: &Problem, plan: &Plan, observe: &Observer) -> Result<Engined<f64>, Error> {
    Ok(Arc::new(Converted::new(Arc::new(fractions(problem, plan, observe)?))))
}

fn fractions(problem: &Problem, plan: &Plan, observe: &Observer) -> Result<Undamped<Rational>, Error> {
    let problem = &*plan.reaching(problem);
    Undamped::<Rational>::solve_within(problem, &(), plan.lattice_limits(problem), &**observe)
}
