//! Longer runs for times and points with more digits than the numbers of a history hold.
//!
//! A number of 40 digits may lie 1e-30 from an event. Doubles round it to the event; enclosures, or a run in as many
//! digits as are written, do not. Such runs are made at the first question that needs one, and kept.

use std::sync::{Arc, Mutex};

use super::ladder::Target;
use super::plan::{Engine, LONG, Plan};
use super::question::{Numbers, Observer};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::number::{Estimate, Float, Interval, Number, Scalar, Spelling};
use crate::problem::Problem;
use crate::threads::locked;

/// Maximum number of digits of a longer run, in which a number of more digits is rounded.
const MAX_RUN_DIGITS: u32 = 240;
/// Digits of a longer run beyond those of the number.
const MORE_DIGITS: u32 = 17;

/// Digits of a proved run for answers in doubles.
const PROVED_DIGITS: u32 = 17;

/// A run that is kept; `None` if it failed.
type Kept<S> = Option<Arc<TypedHistory<S>>>;

/// The longer runs of a history.
#[derive(Debug, Default)]
pub(super) struct Finer {
    proved: Mutex<Option<Kept<Interval>>>,
    /// The longest run in digits so far, and its digits.
    digits: Mutex<Option<(u32, Kept<Float>)>>,
}

/// Returns the greatest number of digits of `numbers` that those of `plan` do not hold; `None` if they hold all.
pub(super) fn digits_beyond<'a>(plan: &Plan, numbers: impl Iterator<Item = &'a Number>) -> Option<u32> {
    let longer = numbers.filter(|number| !holds(plan, number));
    longer.map(Number::written_digits).max().filter(|_| LONG && plan.may_climb())
}

/// Returns whether the numbers of `plan` hold a number.
pub(super) fn holds(plan: &Plan, number: &Number) -> bool {
    match plan.numbers {
        Numbers::Double(_) => Estimate::<f64>::spelling(number, &()).spelled_as() != Some(Spelling::Near),
        Numbers::Digits(digits) => number.written_digits() <= digits,
        // Fractions hold every number, and enclosures decide or are made longer.
        Numbers::Exact | Numbers::ExactThenDigits(_) | Numbers::Certified(_) => true,
    }
}

/// Makes a run; `None` if it fails.
///
/// **Errors**: [`Error::Interrupted`] by `observe`.
fn run<S: Target>(problem: &Problem, plan: &Plan, numbers: Numbers, observe: &Observer) -> Result<Kept<S>, Error> {
    match TypedHistory::solve(problem, &plan.in_numbers(problem, numbers), observe.clone()) {
        Err(Error::Interrupted) => Err(Error::Interrupted),
        run => Ok(run.ok().map(Arc::new)),
    }
}

impl Finer {
    /// Returns the proved run of a damped rod, which takes more bits only where those that it has do not tell a time
    /// from an event: most times of many digits are told by few.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`.
    pub(super) fn proved(&self, problem: &Problem, plan: &Plan, observe: &Observer) -> Result<Kept<Interval>, Error> {
        if plan.engine != Engine::Cells {
            return Ok(None);
        }
        let mut kept = locked(&self.proved);
        if kept.is_none() {
            let digits = if let Numbers::Digits(digits) = plan.numbers { digits } else { PROVED_DIGITS };
            *kept = Some(run(problem, plan, Numbers::Certified(digits), observe)?);
        }
        Ok(kept.clone().flatten())
    }

    /// Returns a run that holds numbers of this many digits.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`.
    pub(super) fn in_digits(
        &self,
        problem: &Problem,
        plan: &Plan,
        observe: &Observer,
        digits: u32,
    ) -> Result<Kept<Float>, Error> {
        // Few lengths, so that few runs are made.
        let digits = (digits + MORE_DIGITS).next_multiple_of(40).min(MAX_RUN_DIGITS);
        let mut kept = locked(&self.digits);
        match &*kept {
            Some((known, run)) if *known >= digits => Ok(run.clone()),
            _ => {
                let run = run(problem, plan, Numbers::Digits(digits), observe)?;
                Ok(kept.insert((digits, run)).1.clone())
            }
        }
    }
}
