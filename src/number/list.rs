//! Lists of numbers in the grammar of the command line: times, points and the values of a sweep.

use std::borrow::Cow;
use std::ops::Range;

use thiserror::Error;

use super::{Number, NumberError, Scalar, rational, short};

/// Largest number of values of one range.
const MOST: u32 = 10_000_000;

/// Reason to reject a list of numbers.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ListError {
    /// One of the numbers is none.
    #[error(transparent)]
    Number(#[from] NumberError),
    /// The text has another form, or an impossible count or end.
    #[error("found `{found}`, expected {expected}")]
    Grammar {
        /// The text, shortened.
        found: String,
        /// Description of a list that is accepted.
        expected: Cow<'static, str>,
    },
    /// The step is not above 0, or the end is below 0.
    #[error("found steps of {step} up to {to}, expected a step above 0 and an end from 0 on")]
    Step {
        /// The step.
        step: Number,
        /// The end.
        to: Number,
    },
    /// The steps are too many.
    #[error("found {count:.0} steps of {step} up to {to}, expected fewer than {MOST}")]
    TooManySteps {
        /// The number of steps.
        count: f64,
        /// The step.
        step: Number,
        /// The end.
        to: Number,
    },
}

/// Numbers as they are written, or equally spaced ones that are computed when they are needed.
#[derive(Clone, Debug)]
pub enum List {
    /// Single numbers.
    Numbers(Vec<Number>),
    /// The given count of equally spaced numbers from one to another, both included.
    Range(Number, Number, u32),
    /// The given count of multiples of a step, from 0 on.
    Steps(Number, u32),
}

impl List {
    /// Reads `0.1,1/3` or `0..2:5`.
    ///
    /// **Errors**: [`ListError`], with the grammar.
    pub fn equally_spaced(text: &str) -> Result<List, ListError> {
        Ok(List::read(text, false)?.0)
    }

    /// Reads `V1,V2,…`, `A..B:N` or, if `geometric`, `A..B:N:log`. Returns the list, and whether it is a geometric
    /// progression.
    ///
    /// **Errors**: [`ListError`], with the grammar.
    pub fn read(text: &str, geometric: bool) -> Result<(List, bool), ListError> {
        let number = |text: &str| text.parse::<Number>();
        let refused = |expected| ListError::Grammar { found: short(text), expected };
        let Some((from, rest)) = text.split_once("..") else {
            return Ok((List::Numbers(text.split(',').map(number).collect::<Result<_, _>>()?), false));
        };
        let (to, count, log) = match *rest.split(':').collect::<Vec<_>>() {
            [to, count] => (to, count, false),
            [to, count, "log"] if geometric => (to, count, true),
            _ if geometric => return Err(refused("V1,V2,…, A..B:N or A..B:N:log".into())),
            _ => return Err(refused("A..B:N".into())),
        };
        let count = count.trim().parse().ok().filter(|count| (2..=MOST).contains(count));
        let count = count.ok_or_else(|| refused(format!("a count of 2 to {MOST} in A..B:N").into()))?;
        let (from, to) = (number(from)?, number(to)?);
        if log && !(from.to_f64() > 0.0 && to.to_f64() > 0.0) {
            return Err(refused("two ends above zero for :log".into()));
        }
        Ok((List::Range(from, to, count), log))
    }

    /// Returns the multiples of `step` from 0 to `to`.
    ///
    /// **Errors**: [`ListError::Step`], [`ListError::TooManySteps`].
    pub fn steps(step: &Number, to: &Number) -> Result<List, ListError> {
        if step.to_f64() <= 0.0 || to.to_f64() < 0.0 {
            return Err(ListError::Step { step: step.clone(), to: to.clone() });
        }
        let count = to.to_f64() / step.to_f64();
        if count >= f64::from(MOST) {
            return Err(ListError::TooManySteps { count, step: step.clone(), to: to.clone() });
        }
        // Two roundings below the number of steps is that number.
        let count = (count * (1.0 + 2.0 * f64::EPSILON)) as u32;
        match count as f64 * step.to_f64() >= to.to_f64() * (1.0 - 4.0 * f64::EPSILON) {
            // The last one is met exactly: it is where the history ends.
            true if count > 0 => Ok(List::Range(0.into(), to.clone(), count + 1)),
            _ => Ok(List::Steps(step.clone(), count + 1)),
        }
    }

    /// Returns the number of numbers.
    #[allow(clippy::len_without_is_empty, reason = "no list that was read is empty")]
    pub fn len(&self) -> usize {
        match self {
            List::Numbers(numbers) => numbers.len(),
            List::Range(_, _, count) | List::Steps(_, count) => *count as usize,
        }
    }

    /// Returns the greatest number; `None` for an empty list.
    pub fn greatest(&self) -> Option<Number> {
        match self {
            List::Numbers(numbers) => numbers.iter().rev().max_by(|a, b| a.compare(b)).cloned(),
            List::Range(from, to, _) => [to, from].into_iter().max_by(|a, b| a.compare(b)).cloned(),
            List::Steps(step, count) => {
                (f64::from(count - 1) * step.to_f64() * (1.0 + f64::EPSILON)).to_string().parse().ok()
            }
        }
    }

    /// Returns the least number; `None` for an empty list.
    pub fn least(&self) -> Option<Number> {
        match self {
            List::Numbers(numbers) => numbers.iter().min_by(|a, b| a.compare(b)).cloned(),
            List::Range(from, to, _) => [from, to].into_iter().min_by(|a, b| a.compare(b)).cloned(),
            List::Steps(..) => Some(0.into()),
        }
    }

    /// Returns all numbers in the number system `S`: see [`List::lift_part`].
    pub fn lift<S: Scalar>(&self, precision: &S::Precision) -> Vec<S> {
        self.lift_part(0..self.len(), precision)
    }

    /// Returns the numbers of a part of the list in the number system `S`.
    ///
    /// **Accuracy**: *correctly rounded* where the fraction of integers that each is has both below 2⁵³; otherwise
    /// within three roundings. The ends of a range are met exactly: the last is where the history ends.
    pub fn lift_part<S: Scalar>(&self, part: Range<usize>, precision: &S::Precision) -> Vec<S> {
        let lift = |number: &Number| S::spelling(number, precision);
        if let List::Numbers(numbers) = self {
            return numbers[part].iter().map(lift).collect();
        }
        let number = |number: &Number| S::from_number(number, precision);
        let (one, last) = (S::from_number(&1.into(), precision), self.len() as i64 - 1);
        let integers = self.integers();
        let at = |k: i64| match (self, integers) {
            (List::Range(from, ..), _) if k == 0 => lift(from),
            (List::Range(_, to, _), _) if k == last => lift(to),
            (_, Some([a, b, divisor])) => one.int(a * (last - k) + b * k) / one.int(divisor),
            (List::Range(from, to, _), None) => {
                (number(from) * one.int(last - k) + number(to) * one.int(k)) / one.int(last)
            }
            (List::Steps(step, _), None) => one.int(k) * number(step),
            (List::Numbers(_), _) => one.zero(),
        };
        part.map(|k| at(k as i64)).collect()
    }

    /// Returns all numbers as they are written; `None` where one is too long to be read again.
    pub fn numbers(&self) -> Option<Vec<Number>> {
        match self {
            List::Numbers(numbers) => Some(numbers.clone()),
            _ => self.lift(&()).iter().map(Number::of_rational).collect(),
        }
    }

    /// Returns `a`, `b`, `q` for which the k-th of `last + 1` numbers is `(a (last − k) + b k)/q`, where all are below
    /// 2⁵³.
    fn integers(&self) -> Option<[i64; 3]> {
        let last = self.len() as i128 - 1;
        let (from, to, divisor) = match self {
            List::Numbers(_) => return None,
            List::Range(from, to, _) => {
                let ([a, b], [c, d]) = (small(from)?, small(to)?);
                (a * d, c * b, b.checked_mul(d)?.checked_mul(last)?)
            }
            List::Steps(step, _) => {
                let [a, b] = small(step)?;
                (0, a, b)
            }
        };
        let most = from.abs().max(to.abs()).checked_mul(last)?.max(divisor);
        (most < 1 << 53).then_some([from as i64, to as i64, divisor as i64])
    }
}

/// Returns numerator and denominator; `None` where they are 2⁵³ or more.
fn small(number: &Number) -> Option<[i128; 2]> {
    let (p, q) = rational::parts(&number.to_rational());
    let parts = [i128::try_from(&p).ok()?, i128::try_from(&q).ok()?];
    parts.iter().all(|part| part.abs() < 1 << 53).then_some(parts)
}

#[cfg(test)]
#[path = "tests/list.rs"]
mod tests;
