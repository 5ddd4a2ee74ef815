//! From a plan to a solution: the engine run in the planned numbers.

use crate::error::Error;
#[cfg(feature = "mp")]
use crate::history::Ending;
use crate::history::History;
use crate::lattice::{Limits, Undamped};
use crate::rod::Problem;
use crate::scene::{Plan, System};

/// A history in the numbers that its plan chose.
pub enum Solution {
    /// Double precision.
    Double(Box<dyn History<f64>>),
    /// Decimal digits, this many of them right.
    #[cfg(feature = "mp")]
    Digits(Box<dyn History<rug::Float>>, u32),
    /// Fractions; where they end before the run does and digits were asked for, the whole run again in digits.
    #[cfg(feature = "mp")]
    Exact(Box<dyn History<rug::Rational>>, Option<(Box<dyn History<rug::Float>>, u32)>),
}

/// Solves `problem` by `plan`. `observe` is told the round trip and the number of pieces from time to time.
///
/// **Accuracy**: by `plan.system`: a running error bound in double precision; every printed digit with digits; *exact* in
/// fractions.
///
/// **Errors**: [`Error::TooManyPieces`]; [`Error::Irrational`] where a parameter is no fraction and no digits are asked
/// for; [`Error::Unsettled`].
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
    match plan.system {
        System::Double => {
            let history = Undamped::<f64>::solve_within(problem, &(), Limits::default(), &mut observe)?;
            Ok(Solution::Double(Box::new(history)))
        }
        #[cfg(feature = "mp")]
        System::Digits(digits) => {
            Ok(Solution::Digits(Box::new(undamped_to_digits(problem, digits, &mut observe)?), digits))
        }
        #[cfg(feature = "mp")]
        System::Exact(digits) => {
            let exact = match Undamped::<rug::Rational>::solve_within(problem, &(), Limits::default(), &mut observe) {
                // Not even the parameters are fractions: in digits from the beginning.
                Err(error @ Error::Irrational { .. }) => {
                    let digits = digits.ok_or(error)?;
                    return Ok(Solution::Digits(Box::new(undamped_to_digits(problem, digits, &mut observe)?), digits));
                }
                exact => exact?,
            };
            let rest = match digits {
                Some(digits) if matches!(exact.ending(), Ending::ExactnessEnds { .. }) => {
                    let rest: Box<dyn History<rug::Float>> =
                        Box::new(undamped_to_digits(problem, digits, &mut observe)?);
                    Some((rest, digits))
                }
                _ => None,
            };
            Ok(Solution::Exact(Box::new(exact), rest))
        }
        #[cfg(not(feature = "mp"))]
        System::Digits(_) | System::Exact(_) => Err(Error::NoMultiprecision),
    }
}

/// Guard bits of the first try. Few runs need more; the bound of each run tells.
#[cfg(feature = "mp")]
const GUARD_BITS: u32 = 64;
/// Digits that must be left beyond those printed, so that a quantity small against its scale still has all of them.
#[cfg(feature = "mp")]
const SPARE_DIGITS: u32 = 8;
#[cfg(feature = "mp")]
const MAX_BITS: u32 = 1 << 22;

/// The history of an undamped rod with `digits` right digits in every event: precision is added until the error bound that
/// the run itself carries is below `10^−(digits + 8)` of the scale of each quantity, and that of the time of each event,
/// tangential landings included, below `10^−digits` of it.
///
/// **Errors**: [`Error::Unsettled`], and those of the run.
#[cfg(feature = "mp")]
pub fn undamped_to_digits(
    problem: &Problem,
    digits: u32,
    mut observe: impl FnMut(usize, usize),
) -> Result<Undamped<rug::Float>, Error> {
    use crate::number::bits_for_digits;
    let (wanted, spare) = (bits_for_digits(digits), bits_for_digits(SPARE_DIGITS));
    let mut bits = wanted + GUARD_BITS;
    loop {
        let history = Undamped::<rug::Float>::solve_within(problem, &bits, Limits::default(), &mut observe)?;
        let marched = history.marched();
        let of_values = marched.greatest_error.log2() + f64::from(spare);
        // One bit more for half a unit of the last digit.
        let of_times = marched.occurrences.iter().map(|event| event.error.log2() + 1.0);
        let lost = of_times.fold(of_values, f64::max);
        let missing = lost + f64::from(wanted) - f64::from(bits);
        if missing <= 0.0 {
            return Ok(history);
        }
        // A double root needs two bits for each that is missing.
        let more = if missing.is_finite() { 2.0 * missing.ceil() + 8.0 } else { f64::from(bits) };
        if f64::from(bits) + more > f64::from(MAX_BITS) {
            return Err(Error::Unsettled { digits, bits });
        }
        bits += more as u32;
    }
}
