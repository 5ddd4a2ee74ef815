//! Lists of numbers on the command line.

use std::ops::Range;

use crate::number::{Number, Scalar};

/// The most values that one range may hold.
const MAX_VALUES: u32 = 10_000_000;

/// Numbers, or equally spaced ones.
#[derive(Clone, Debug)]
pub(super) enum List {
    Numbers(Vec<Number>),
    /// So many numbers from one to another, both included.
    Range(Number, Number, u32),
    /// So many multiples of a step, from 0 on.
    Steps(Number, u32),
}

/// The numbers that `0.1,1/3` or `0..2:5` spells.
pub(super) fn list(text: &str) -> Result<List, String> {
    let number = |text: &str| text.parse::<Number>().map_err(|error| error.to_string());
    let Some((from, rest)) = text.split_once("..") else {
        return Ok(List::Numbers(text.split(',').map(number).collect::<Result<_, _>>()?));
    };
    let (to, count) = rest.split_once(':').ok_or_else(|| format!("found `{text}`, expected A..B:N"))?;
    let count: u32 = count.trim().parse().map_err(|_| format!("found a count `{count}`, expected a whole number"))?;
    if !(2..=MAX_VALUES).contains(&count) {
        return Err(format!("found a count of {count}, expected 2 to {MAX_VALUES}"));
    }
    Ok(List::Range(number(from)?, number(to)?, count))
}

impl List {
    /// The multiples of `step` from 0 to `to`.
    pub(super) fn steps(step: &Number, to: &Number) -> Result<List, String> {
        if step.to_f64() <= 0.0 || to.to_f64() < 0.0 {
            return Err(format!("found steps of {step} up to {to}, expected a step above 0 and an end from 0 on"));
        }
        let count = to.to_f64() / step.to_f64();
        if count >= f64::from(MAX_VALUES) {
            return Err(format!("found {count:.0} steps of {step} up to {to}, expected fewer than {MAX_VALUES}"));
        }
        // Two roundings below the number of steps is that number.
        let count = (count * (1.0 + 2.0 * f64::EPSILON)) as u32;
        match count as f64 * step.to_f64() >= to.to_f64() * (1.0 - 4.0 * f64::EPSILON) {
            // The last one is met exactly: it is where the history ends.
            true if count > 0 => Ok(List::Range(0.into(), to.clone(), count + 1)),
            _ => Ok(List::Steps(step.clone(), count + 1)),
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            List::Numbers(numbers) => numbers.len(),
            List::Range(_, _, count) | List::Steps(_, count) => *count as usize,
        }
    }

    pub(super) fn greatest(&self) -> Option<Number> {
        let greater = |a: Number, b: &Number| if b.compare(&a).is_gt() { b.clone() } else { a };
        match self {
            List::Numbers(numbers) => numbers.iter().cloned().reduce(|a, b| greater(a, &b)),
            List::Range(from, to, _) => Some(greater(from.clone(), to)),
            List::Steps(step, count) => {
                (f64::from(count - 1) * step.to_f64() * (1.0 + f64::EPSILON)).to_string().parse().ok()
            }
        }
    }

    pub(super) fn least(&self) -> Option<Number> {
        let less = |a: Number, b: &Number| if b.compare(&a).is_lt() { b.clone() } else { a };
        match self {
            List::Numbers(numbers) => numbers.iter().cloned().reduce(|a, b| less(a, &b)),
            List::Range(from, to, _) => Some(less(from.clone(), to)),
            List::Steps(..) => Some(0.into()),
        }
    }

    /// All numbers, in some number system.
    pub(super) fn lift<S: Scalar>(&self, precision: &S::Precision) -> Vec<S> {
        self.lift_part(0..self.len(), precision)
    }

    /// The numbers of a part of the list.
    pub(super) fn lift_part<S: Scalar>(&self, part: Range<usize>, precision: &S::Precision) -> Vec<S> {
        match self {
            List::Numbers(numbers) => numbers[part].iter().map(|number| S::from_number(number, precision)).collect(),
            List::Range(from, to, count) => {
                let (from, to) = (S::from_number(from, precision), S::from_number(to, precision));
                let last = i64::from(*count) - 1;
                // Both ends are met exactly: the last is where the history ends.
                let at = |k: i64| match k {
                    0 => from.clone(),
                    k if k == last => to.clone(),
                    k => (from.clone() * from.int(last - k) + to.clone() * to.int(k)) / from.int(last),
                };
                part.map(|k| at(k as i64)).collect()
            }
            List::Steps(step, _) => {
                let step = S::from_number(step, precision);
                part.map(|k| step.int(k as i64) * &step).collect()
            }
        }
    }
}
