//! Longer runs for times and points with more digits than the numbers of a history hold.
//!
//! A number of 40 digits may lie 1e-30 from an event. Doubles round it to the event; enclosures, or a run in as many
//! digits as are written, do not. Such runs are made at the first question that needs one, and kept.

use std::sync::{Arc, Mutex};

use super::ladder::{Ladder, Target};
use super::places::Places;
use super::plan::{Engine, Plan};
use super::question::Numbers;
use super::typed::TypedHistory;
use crate::error::Error;
use crate::number::{Estimate, Float, Interval, Number, Scalar, Spelling};
use crate::threads::locked;

/// Maximum number of digits of a longer run, in which a number of more digits is rounded.
const MAX_RUN_DIGITS: u32 = 240;
/// Digits of a longer run beyond those of the number.
const MORE_DIGITS: u32 = 17;

/// Digits of a proved run for answers in doubles.
const PROVED_DIGITS: u32 = 17;
/// Digits of numbers that the shortest enclosures hold: a time within some of their roundings of a ray counts as that
/// of the ray.
const ENCLOSED_DIGITS: u32 = 28;

/// A run that is kept with its digits; `None` if it failed.
type Kept<S> = Mutex<Option<(u32, Option<Arc<TypedHistory<S>>>)>>;

/// The run that is found, if there is one.
type Found<S> = Result<Option<Arc<TypedHistory<S>>>, Error>;

/// The longest runs of a history so far.
#[derive(Debug, Default)]
pub(super) struct Finer {
    proved: Kept<Interval>,
    digits: Kept<Float>,
}

/// Returns the greatest number of digits in `places` that the numbers of `plan` do not hold; `None` if they hold all.
pub(super) fn digits_beyond(plan: &Plan, places: &[&Places<'_>]) -> Option<u32> {
    let longer = places.iter().flat_map(|places| places.spelled()).filter(|number| !is_held(plan, number));
    longer.map(Number::written_digits).max().filter(|_| plan.may_climb())
}

/// Returns whether the numbers of `plan` hold a number.
pub(super) fn is_held(plan: &Plan, number: &Number) -> bool {
    match plan.numbers {
        Numbers::Double(_) => Estimate::<f64>::spelling(number, &()).spelled_as() != Some(Spelling::Near),
        Numbers::Digits(digits) => number.written_digits() <= digits,
        Numbers::Certified(digits) => plan.engine != Engine::Cells || is_enclosed(number.written_digits(), digits),
        // Fractions hold every number.
        Numbers::Exact | Numbers::ExactThenDigits(_) => true,
    }
}

/// Returns whether enclosures to `digits` digits hold a number of `written` digits.
fn is_enclosed(written: u32, digits: u32) -> bool {
    written <= digits.max(ENCLOSED_DIGITS)
}

/// Returns the digits of a run for numbers of this many digits: few lengths, so that few runs are made.
fn rounded_up(written: u32) -> u32 {
    (written + MORE_DIGITS).next_multiple_of(40).min(MAX_RUN_DIGITS)
}

/// Returns the kept run if it has enough digits, or makes one.
///
/// **Errors**: [`Error::Interrupted`] by `observe`.
fn run<S: Target>(
    kept: &Kept<S>,
    Ladder { problem, plan, observe }: Ladder<'_>,
    (digits, numbers): (u32, fn(u32) -> Numbers),
) -> Found<S> {
    let mut kept = locked(kept);
    match &*kept {
        Some((known, run)) if *known >= digits => Ok(run.clone()),
        _ => {
            let plan = plan.in_numbers(problem, numbers(digits));
            let run = match TypedHistory::solve(problem, &plan, observe.clone()) {
                Err(Error::Interrupted) => return Err(Error::Interrupted),
                run => run.ok().map(Arc::new),
            };
            Ok(kept.insert((digits, run)).1.clone())
        }
    }
}

impl Finer {
    /// Returns a proved run of a damped rod that holds numbers of this many digits. It takes more bits only where those
    /// that it has do not tell a time from an event, and is many times as fast as a run in as many digits.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`.
    pub(super) fn proved(&self, ladder: Ladder<'_>, written: u32) -> Found<Interval> {
        let plan = ladder.plan;
        if plan.engine != Engine::Cells {
            return Ok(None);
        }
        let asked = match plan.numbers {
            Numbers::Digits(digits) | Numbers::Certified(digits) => digits,
            _ => PROVED_DIGITS,
        };
        let digits = if is_enclosed(written, asked) { asked } else { rounded_up(written).max(asked) };
        run(&self.proved, ladder, (digits, Numbers::Certified))
    }

    /// Returns a run that holds numbers of this many digits.
    ///
    /// **Errors**: [`Error::Interrupted`] by `observe`.
    pub(super) fn in_digits(&self, ladder: Ladder<'_>, written: u32) -> Found<Float> {
        if matches!(ladder.plan.numbers, Numbers::Certified(_)) {
            return Ok(None);
        }
        run(&self.digits, ladder, (rounded_up(written), Numbers::Digits))
    }
}
