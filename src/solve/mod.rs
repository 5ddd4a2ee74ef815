//! From a plan to a solution: the engine run in the planned numbers.

use crate::damped::{Damped, Joined};
use crate::error::Error;
use crate::first_contact::FirstContact;
#[cfg(feature = "mp")]
use crate::history::Ending;
use crate::history::History;
use crate::lattice::Limits;
use crate::rod::{Parameters, Problem};
use crate::scene::{Engine, Plan, System};

#[cfg(feature = "mp")]
mod certified;
#[cfg(feature = "mp")]
mod digits;
mod stripped;
mod twice;
mod undamped;
#[cfg(feature = "mp")]
pub use certified::{certify, proved_digits, proved_ends};
#[cfg(feature = "mp")]
pub use digits::{bits_lost, damped_to_digits, undamped_to_digits};
pub use stripped::Stripped;
pub use undamped::{StrippedUndamped, undamped, undamped_within};

/// A history in the numbers that its plan chose.
pub enum Solution {
    /// Double precision.
    Double(Box<dyn History<f64>>),
    /// Decimal digits: this many are to be printed.
    #[cfg(feature = "mp")]
    Digits(Box<dyn History<rug::Float>>, u32),
    /// Fractions; where they end before the run does and digits were asked for, the whole run again in digits.
    #[cfg(feature = "mp")]
    Exact(Box<dyn History<rug::Rational>>, Option<(Box<dyn History<rug::Float>>, u32)>),
}

/// Solves `problem` by `plan`. `observe` is told the round trip and the number of pieces from time to time.
///
/// **Accuracy**: by `plan.system`. In double precision the error bound that the history carries; where the plan has an
/// accuracy and the bound is above it, a damped run is held against a second one with other cells and other last digits,
/// and where that does not settle it either, the run is repeated with more bits and read in doubles. With
/// digits, eight digits more of each scale than are printed; *exact* in fractions.
///
/// **Errors**: [`Error::TooManyPieces`]; [`Error::Irrational`] where a parameter is no fraction and no digits are asked
/// for; [`Error::Unsettled`]; [`Error::AskCertify`] for a plan of enclosures, which [`certify`] solves.
///
/// ```
/// use dalembert::{Ask, Plan, Scene, Solution, scene::builtin, solve};
/// let scene = Scene::parse(builtin::get("doyen-ern-piperno").unwrap().source)?;
/// let plan = Plan::of(&scene, Ask::default())?;
/// let Solution::Double(history) = solve(&scene.problem, &plan, |_, _| ())? else { unreachable!() };
/// assert!((history.contacts()[1].from - 8.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve(problem: &Problem, plan: &Plan, mut observe: impl FnMut(usize, usize)) -> Result<Solution, Error> {
    let limits = plan.from.map_or_else(Limits::default, |time| Limits::keeping_from(problem, time));
    match plan.system {
        System::Double(accuracy) => {
            let history = match plan.engine {
                Engine::Lattice => undamped_in_doubles(problem, accuracy, limits, &mut observe)?,
                Engine::Cells => damped_in_doubles(problem, accuracy)?,
            };
            Ok(Solution::Double(history))
        }
        #[cfg(feature = "mp")]
        System::Digits(digits) => {
            let history = match plan.engine {
                Engine::Lattice => Box::new(undamped_to_digits(problem, digits, limits, &mut observe)?),
                Engine::Cells => damped_to_digits(problem, digits)?,
            };
            Ok(Solution::Digits(history, digits))
        }
        #[cfg(feature = "mp")]
        System::Exact(digits) => {
            let exact = match undamped_within::<rug::Rational>(problem, &(), limits, &mut observe) {
                // Not even the parameters are fractions: in digits from the beginning.
                Err(error @ Error::Irrational { .. }) => {
                    let digits = digits.ok_or(error)?;
                    return Ok(Solution::Digits(
                        Box::new(undamped_to_digits(problem, digits, limits, &mut observe)?),
                        digits,
                    ));
                }
                exact => exact?,
            };
            let rest = match digits {
                Some(digits) if matches!(exact.ending(), Ending::ExactnessEnds { .. }) => {
                    let rest: Box<dyn History<rug::Float>> =
                        Box::new(undamped_to_digits(problem, digits, limits, &mut observe)?);
                    Some((rest, digits))
                }
                _ => None,
            };
            Ok(Solution::Exact(Box::new(exact), rest))
        }
        // An enclosure answers a question, and how many bits it takes depends on the question.
        #[cfg(feature = "mp")]
        System::Certified(digits) => Err(Error::AskCertify { digits }),
        #[cfg(not(feature = "mp"))]
        System::Digits(_) | System::Exact(_) | System::Certified(_) => Err(Error::NoMultiprecision),
    }
}

fn undamped_in_doubles(
    problem: &Problem,
    accuracy: Option<f64>,
    limits: Limits,
    mut observe: impl FnMut(usize, usize),
) -> Result<Box<dyn History<f64>>, Error> {
    let history = undamped_within::<f64>(problem, &(), limits, &mut observe)?;
    #[cfg(feature = "mp")]
    if accuracy.is_some_and(|accuracy| history.error_estimate() > accuracy) {
        let history = undamped_to_digits(problem, digits::of_accuracy(accuracy), limits, observe)?;
        return Ok(Box::new(crate::rounded::Rounded::new(Box::new(history))));
    }
    let _ = accuracy;
    Ok(Box::new(history))
}

/// The decimal digits that cells are marched to in doubles where no accuracy is asked for.
const CELL_DIGITS: f64 = 13.0;

/// Where the motion has decayed by more than this power of e when the first contact ends, sums over rays keep too few
/// digits of a double, and so would everything after.
#[cfg(feature = "mp")]
const MOST_FADED: f64 = 5.0;
/// In doubles nobody follows a motion below e⁻³⁰ ≈ 1e-13 of what it was.
#[cfg(feature = "mp")]
const FAINTEST: f64 = 30.0;

fn damped_in_doubles(problem: &Problem, accuracy: Option<f64>) -> Result<Box<dyn History<f64>>, Error> {
    let digits = accuracy.map_or(CELL_DIGITS, |accuracy| -accuracy.log10() + 1.0);
    let uncertain = |history: &dyn History<f64>| accuracy.is_some_and(|accuracy| history.error_estimate() > accuracy);
    // The bound of a march adds up every event's error without its sign; two marches side by side know better.
    let better = |history: &dyn History<f64>| {
        uncertain(history).then(|| twice::estimate(problem, digits, history)).flatten().unwrap_or(f64::INFINITY)
    };
    let history: Box<dyn History<f64>> = if problem.has_closed_form() {
        let rod = Parameters::<f64>::of(problem, &())?;
        let bounce = FirstContact::new(&rod).bounce_within(1e-13);
        #[cfg(feature = "mp")]
        if digits::faded(&rod, &bounce, problem) > MOST_FADED {
            let history = digits::damped_unless_faint(problem, digits::of_accuracy(accuracy), FAINTEST)?;
            return Ok(Box::new(crate::rounded::Rounded::new(history)));
        }
        let history = Joined::<f64>::solve(problem, &(), digits, bounce, true)?;
        let estimate = better(&history);
        Box::new(history.estimated(estimate))
    } else {
        let history = Damped::<f64>::solve(problem, &(), digits)?;
        let estimate = better(&history);
        Box::new(history.estimated(estimate))
    };
    #[cfg(feature = "mp")]
    if uncertain(history.as_ref()) {
        let history = damped_to_digits(problem, digits::of_accuracy(accuracy))?;
        return Ok(Box::new(crate::rounded::Rounded::new(history)));
    }
    Ok(history)
}
