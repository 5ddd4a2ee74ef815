//! Longer runs for times and points with more digits than the numbers of a history hold.
//!
//! A number of 40 digits may lie 1e-30 from an event. Doubles round it to the event; a run in as many digits as are
//! written does not. Such runs are made at the first question that needs one, and kept.

use std::sync::{Arc, Mutex};

use super::places::Places;
use super::plan::{LONG, Plan};
use super::question::{Numbers, Observer};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::number::{Estimate, Float, Number, Scalar, Spelling};
use crate::problem::Problem;
use crate::threads::locked;

/// Maximum number of digits of a longer run, in which a number of more digits is rounded.
const MAX_RUN_DIGITS: u32 = 240;
/// Digits of a longer run beyond those of the number.
const MORE_DIGITS: u32 = 17;

/// A run in long numbers; `None` if it failed.
type LongRun = Option<Arc<TypedHistory<Float>>>;

/// The longest run so far, and its digits.
#[derive(Debug, Default)]
pub(super) struct Finer(Mutex<Option<(u32, LongRun)>>);

impl Finer {
    /// Returns a run of `plan` in the digits that `places` need; `None` if the numbers of the plan hold them, or if
    /// such a run fails.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`.
    pub(super) fn run(
        &self,
        problem: &Problem,
        plan: &Plan,
        observe: &Observer,
        places: &[&Places<'_>],
    ) -> Result<LongRun, Error> {
        let held = |number: &Number| match plan.numbers {
            Numbers::Double(_) => Estimate::<f64>::spelling(number, &()).spelled_as() != Some(Spelling::Near),
            Numbers::Digits(digits) => number.written_digits() <= digits,
            // Fractions hold every number, and enclosures decide or are made longer.
            Numbers::Exact | Numbers::ExactThenDigits(_) | Numbers::Certified(_) => true,
        };
        let longer = places.iter().flat_map(|places| places.spelled()).filter(|number| !held(number));
        let Some(digits) = longer.map(Number::written_digits).max().filter(|_| LONG && plan.may_climb()) else {
            return Ok(None);
        };
        // Few lengths, so that few runs are made.
        let digits = (digits + MORE_DIGITS).next_multiple_of(40).min(MAX_RUN_DIGITS);
        let mut kept = locked(&self.0);
        match &*kept {
            Some((known, run)) if *known >= digits => Ok(run.clone()),
            _ => {
                let plan = plan.in_numbers(problem, Numbers::Digits(digits));
                let run = match TypedHistory::solve(problem, &plan, observe.clone()) {
                    Err(Error::Interrupted) => return Err(Error::Interrupted),
                    run => run.ok().map(Arc::new),
                };
                Ok(kept.insert((digits, run)).1.clone())
            }
        }
    }
}
