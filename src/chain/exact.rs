//! Exact forms of times, which tell times that are one from times that agree within their bounds.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::varied::Given;
use crate::number::{Rational, Scalar};

/// A sum of a fraction and of multiples of named times, of which nothing is known but that each equals itself: those of
/// events, and travel times that are no fractions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExactTime {
    /// The names in order, each with a factor that is not zero. The name of the fraction is 0.
    terms: Vec<(u64, Rational)>,
}

/// The exact form of a time, if it is known.
pub(super) type Exact = Option<Arc<ExactTime>>;

impl ExactTime {
    pub(super) fn rational(x: Rational) -> Self {
        ExactTime { terms: vec![(0, x)] }.without_zeros()
    }

    /// Returns a new named time.
    pub(super) fn named() -> Self {
        static NAMES: AtomicU64 = AtomicU64::new(1);
        ExactTime { terms: vec![(NAMES.fetch_add(1, Ordering::Relaxed), Rational::from(1))] }
    }

    fn without_zeros(mut self) -> Self {
        self.terms.retain(|(_, factor)| *factor != Rational::default());
        self
    }

    fn plus(&self, other: &Self) -> Self {
        let mut terms = self.terms.clone();
        for (name, factor) in &other.terms {
            match terms.binary_search_by_key(name, |(name, _)| *name) {
                Ok(at) => terms[at].1 += factor,
                Err(at) => terms.insert(at, (*name, factor.clone())),
            }
        }
        ExactTime { terms }.without_zeros()
    }

    /// Returns a multiple of the time.
    pub(super) fn scaled(&self, by: &Rational) -> Self {
        let terms = self.terms.iter().map(|(name, factor)| (*name, factor.clone() * by));
        ExactTime { terms: terms.collect() }.without_zeros()
    }
}

/// Returns the exact form of the sum of two times.
pub(super) fn exact_sum(a: &Exact, b: &Exact) -> Exact {
    Some(Arc::new(a.as_deref()?.plus(b.as_deref()?)))
}

/// Returns the fraction that a number is, unless it changes with a value of the chain.
pub(super) fn fixed(given: &Given) -> Option<Rational> {
    let is_fixed = given.rate().is_some_and(|rate| *rate == Rational::default());
    is_fixed.then(|| given.value().clone())
}

/// Returns the exact form of a time, unless it changes with a value of the chain.
pub(super) fn exact(given: &Given) -> Exact {
    Some(Arc::new(ExactTime::rational(fixed(given)?)))
}

/// The travel times that have names, with length and squared wave speed.
#[derive(Debug, Default)]
pub(super) struct Travels(Vec<(Rational, Rational, ExactTime)>);

impl Travels {
    /// Returns the exact form of the travel time through a length, from the square of the wave speed: a fraction, or a
    /// name, which equal bars share.
    pub(super) fn exact(&mut self, length: &Given, square: &Given) -> Exact {
        let (length, square) = (fixed(length)?, fixed(square)?);
        if let Some(speed) = square.try_sqrt() {
            return Some(Arc::new(ExactTime::rational(length / speed)));
        }
        let known = self.0.iter().find(|(a, b, _)| (a, b) == (&length, &square)).map(|(.., travel)| travel.clone());
        let travel = known.unwrap_or_else(ExactTime::named);
        self.0.push((length, square, travel.clone()));
        Some(Arc::new(travel))
    }
}
