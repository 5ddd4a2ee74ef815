//! Times and points of the queries to a history.

use std::ops::Range;

use crate::error::Error;
use crate::motion::Motion;
use crate::number::{List, Number, Scalar};

/// Times or points of a question, in the units of the problem.
#[derive(Clone, Debug)]
pub enum Places<'a> {
    /// A range of a list of numbers as a person writes them; each represents exactly the number that it spells.
    Part(&'a List, Range<usize>),
    /// Doubles as a program computes them; one within some roundings of an event or a ray represents that event or ray.
    Doubles(&'a [f64]),
    /// Numbers as a history prints them; the digits of an event represent that event.
    Printed(&'a [Number]),
    /// The start, the events and the end, each once; for times.
    Events,
}

impl<'a> From<&'a List> for Places<'a> {
    fn from(list: &'a List) -> Self {
        Places::Part(list, 0..list.len())
    }
}

impl<'a> From<&'a [f64]> for Places<'a> {
    fn from(list: &'a [f64]) -> Self {
        Places::Doubles(list)
    }
}

impl Places<'_> {
    /// Returns the numbers that a person wrote one by one, each of which represents exactly itself.
    pub(super) fn spelled(&self) -> &[Number] {
        match self {
            Places::Part(List::Numbers(numbers), part) => numbers.get(part.clone()).unwrap_or_default(),
            Places::Part(..) | Places::Doubles(_) | Places::Printed(_) | Places::Events => &[],
        }
    }

    /// Returns the places in parts, in order: numbers that a person wrote and that `is_held` accepts, and others.
    pub(super) fn parted(&self, is_held: impl Fn(&Number) -> bool) -> Vec<Places<'_>> {
        let (spelled, Places::Part(list, part)) = (self.spelled(), self) else { return vec![self.clone()] };
        if spelled.is_empty() {
            return vec![self.clone()];
        }
        let held: Vec<bool> = spelled.iter().map(is_held).collect();
        let mut begin = part.start;
        let parts = held.chunk_by(|a, b| a == b).map(|chunk| {
            let range = begin..begin + chunk.len();
            begin = range.end;
            Places::Part(list, range)
        });
        parts.collect()
    }

    pub(super) fn lift<S: Scalar>(&self, motion: &dyn Motion<S>) -> Result<Vec<S>, Error> {
        let end = motion.end();
        let precision = end.precision();
        Ok(match self {
            Places::Part(list, part) => list.lift_part(part.clone(), &precision),
            Places::Doubles(list) => {
                // Fractions and enclosures hold no other doubles.
                if let Some(x) = list.iter().find(|x| !x.is_finite()) {
                    return Err(Error::TimeOutside { found: x.to_string(), end: end.text() });
                }
                list.iter().map(|x| end.double(*x)).collect()
            }
            Places::Printed(list) if end.as_double().is_none() => {
                list.iter().map(|x| S::from_number(x, &precision)).collect()
            }
            Places::Printed(list) => list.iter().map(|x| S::spelling(x, &precision)).collect(),
            Places::Events => {
                let mut times = vec![end.zero()];
                for time in motion.events().iter().map(|event| &event.t).chain([&end]) {
                    if times.last().map_or(Ok(true), |last| last.below(time))? {
                        times.push(time.clone());
                    }
                }
                times
            }
        })
    }
}
