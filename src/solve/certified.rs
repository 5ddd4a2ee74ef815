//! Answers whose digits are proved: enclosures with as many bits as it takes to settle every comparison and every digit.

use rug::Float;
use rug::float::Round;

use super::undamped_within;
use crate::certified::ProvedContact;
use crate::error::Error;
use crate::history::{Ending, History};
use crate::lattice::Limits;
use crate::number::{Interval, IntervalPrecision, Scalar, bits_for_digits, decided, undecided};
use crate::rod::Problem;

/// Guard bits of the first try.
const GUARD_BITS: u32 = 64;
/// Bits beyond which a comparison is called undecided, where the digits asked for do not need more.
const MAX_BITS: u32 = 1 << 13;
/// As often a history may end at the same doubt, with more bits each time, before that is the answer.
const SAME_DOUBT: usize = 3;
/// Digits of a number beyond those asked for, so that it is rare that two of its decimals come into question.
const SPARE_DIGITS: u32 = 8;
/// A number that is this many digits below the greatest of the answer, beyond those asked for, may stay with fewer digits: where
/// it is zero in truth, no bits would ever give it any.
const FLOOR_DIGITS: u32 = 30;

/// The answer to `question`, asked of histories in enclosures with more and more bits, until no comparison on the way is open and
/// all `numbers` of the answer have `digits` digits that are proved.
///
/// **Accuracy**: *enclosure*; each number is known to `10^−digits` of itself, or to `10^−(digits + 30)` of the greatest.
///
/// **Errors**: [`Error::Undecided`] where too many bits do not settle it; [`Error::NotCertified`] where no engine works in
/// enclosures; those of the run and of `question`.
///
/// ```
/// use dalembert::{History, Number, Problem, solve::certify};
/// // Corollary 1 below the critical speed: t_b = 2t₁ − μ/g = 5/2 for μ = 3/2.
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), "3/2".parse()?);
/// let ends = |history: &dyn dalembert::History<_>| Ok::<_, dalembert::Error>(history.contacts()[0].to.clone());
/// let end = certify(&problem, 50, ends, |end| end.iter().collect(), |_, _| ())?.unwrap();
/// assert!(end.contains(&(5, 2).into()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify<T, E: From<Error>>(
    problem: &Problem,
    digits: u32,
    mut question: impl FnMut(&dyn History<Interval>) -> Result<T, E>,
    numbers: impl Fn(&T) -> Vec<&Interval>,
    mut observe: impl FnMut(usize, usize),
) -> Result<T, E> {
    let wanted = bits_for_digits(digits);
    let most = MAX_BITS.max(wanted.saturating_mul(4));
    let mut bits = wanted + GUARD_BITS;
    let mut ends: Vec<f64> = Vec::new();
    loop {
        let mut ask = |history: &dyn History<Interval>| {
            // A history that ends in doubt may not with more bits; if thrice in the same place, it is no matter of bits.
            if matches!(history.ending(), Ending::Undecided(_)) {
                let end = history.end().to_f64();
                ends.push(end);
                if ends.iter().filter(|other| (*other - end).abs() <= 1e-9 * end).count() < SAME_DOUBT {
                    return Ok(None);
                }
            }
            question(history).map(Some)
        };
        let answer = decided(|| {
            if problem.rod.damping.is_some() {
                return ask(&proved_contact(problem, bits)?);
            }
            let precision = IntervalPrecision::with_exact(bits);
            match undamped_within::<Interval>(problem, &precision, Limits::default(), &mut observe) {
                Ok(history) => {
                    let answer = ask(&history);
                    if history.met_open_comparison() { Ok(None) } else { answer }
                }
                Err(Error::Open(_)) => Ok(None),
                Err(error) => Err(error.into()),
            }
        });
        // Errors on the way to an open comparison mean nothing, except where no bits can help.
        let missing = match answer {
            Some(Ok(None)) => bits,
            Some(Ok(Some(answer))) => {
                let missing = missing_bits(&numbers(&answer), digits);
                if missing == 0 {
                    return Ok(answer);
                }
                missing
            }
            Some(Err(error)) => return Err(error),
            None => bits,
        };
        let next = bits.saturating_add(missing.clamp(32, bits));
        if next > most {
            return Err(Error::Undecided { digits, bits }.into());
        }
        bits = next;
    }
}

/// The first contact of a damped `problem` in enclosures of `bits` bits. It holds if no comparison was left open, see [`decided`].
///
/// **Errors**: [`Error::NotCertified`], and those of the run.
fn proved_contact(problem: &Problem, bits: u32) -> Result<ProvedContact, Error> {
    if !problem.has_closed_form() {
        return Err(Error::NotCertified);
    }
    ProvedContact::solve(problem, bits)?.ok_or_else(|| {
        undecided();
        Error::NotDecided { what: "how the contact ends", bits }
    })
}

/// About how many bits more would give each number its digits; zero if all have them.
fn missing_bits(numbers: &[&Interval], digits: u32) -> u32 {
    let greatest = numbers.iter().map(|x| exponent(x.lo()).max(exponent(x.hi()))).max().unwrap_or(0);
    let kept = i64::from(bits_for_digits(digits + SPARE_DIGITS));
    let floor = greatest - i64::from(bits_for_digits(digits + FLOOR_DIGITS));
    // A number that is a point has all its digits, zero too.
    let missing = numbers.iter().filter(|x| !x.radius().is_zero()).map(|x| {
        let radius = exponent(&x.radius());
        let least = match x.sign() {
            Some(_) => exponent(x.lo()).min(exponent(x.hi())) - kept,
            None => i64::MIN / 2,
        };
        radius - least.max(floor)
    });
    u32::try_from(missing.max().unwrap_or(0).max(0)).unwrap_or(u32::MAX)
}

/// The binary exponent, far down for zero and far up for what is not finite.
fn exponent(x: &Float) -> i64 {
    match x.get_exp() {
        Some(exponent) => i64::from(exponent),
        None if x.is_zero() => i64::MIN / 4,
        None => i64::MAX / 4,
    }
}

/// `x` to `digits` significant digits, or as many as are proved: correctly rounded unless the enclosure is astride a rounding
/// boundary, and then within one unit of the last digit. `0` where no digit is known.
///
/// **Accuracy**: n digits have a last unit of at least `10⁻ⁿ|x|`; half of it goes to rounding, and the radius is at most the other half.
///
/// ```
/// use dalembert::{number::Interval, solve::proved_digits};
/// use rug::Float;
/// let around = |x: f64, by: f64| Interval::between(Float::with_val(99, x - by), Float::with_val(99, x + by));
/// assert_eq!(proved_digits(&around(2.0, 9e-6), 20), "2.0000");
/// assert_eq!(proved_digits(&around(2.0, 3.0), 20), "0");
/// ```
pub fn proved_digits(x: &Interval, digits: u32) -> String {
    if x.sign().is_none_or(std::cmp::Ordering::is_eq) {
        return "0".into();
    }
    let radius = x.radius();
    let known = if radius.is_zero() {
        f64::from(digits)
    } else {
        let least = if x.lo().cmp_abs(x.hi()) == Some(std::cmp::Ordering::Less) { x.lo() } else { x.hi() };
        Float::with_val(64, least / radius).abs().log10().to_f64() - std::f64::consts::LOG10_2
    };
    if known < 1.0 {
        return "0".into();
    }
    crate::number::decimal(&x.mid().to_rational().unwrap_or_default(), digits.min(known as u32))
}

/// Both ends to ten digits more, rounded outwards.
pub fn proved_ends(x: &Interval, digits: u32) -> [String; 2] {
    let text = |end: &Float, round| end.to_string_radix_round(10, Some(digits as usize + 10), round);
    [text(x.lo(), Round::Down), text(x.hi(), Round::Up)]
}
