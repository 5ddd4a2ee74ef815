//! The flights between the contacts, and how high they go.

use std::iter::once;

use crate::error::Error;
use crate::mapped::CollectVec;
use crate::motion::{EventKind, Motion};
use crate::number::Scalar;

/// A flight of the rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight<S> {
    /// Its beginning.
    pub from: S,
    /// Its end; `None` where the history ends before.
    pub to: Option<S>,
    /// `t*` and `h_max = h(t*)`, where the centre of mass turns within the flight.
    pub highest: Option<(S, S)>,
}

impl<S> Flight<S> {
    pub(crate) fn map<T>(self, f: impl Fn(S) -> T) -> Flight<T> {
        Flight {
            from: f(self.from),
            to: self.to.map(&f),
            highest: self.highest.map(|(time, centre)| (f(time), f(centre))),
        }
    }

    /// Every number in them.
    pub(crate) fn numbers(flights: &[Self]) -> Vec<&S> {
        let numbers = flights.iter().flat_map(|Flight { from, to, highest }| {
            once(from).chain(to).chain(highest.iter().flat_map(|(time, height)| [time, height]))
        });
        numbers.collect_vec()
    }
}

/// The flights of a history, in order.
///
/// **Source**: Remark 2, for every flight and not just the first.
///
/// **Accuracy**: *exact* for exact histories, otherwise that of `h` and `h′` at the release.
///
/// **Errors**: [`Error::NotDecided`] where it is not settled whether the centre of mass turns before the flight ends.
pub fn flights<S: Scalar>(history: &dyn Motion<S>) -> Result<Vec<Flight<S>>, Error> {
    let events = history.events();
    let end = history.end();
    let mut flights = Vec::new();
    for (k, release) in events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Release) {
        let to = events.get(k + 1).map(|impact| impact.time.clone());
        let highest = match history.highest(k) {
            Some((time, _)) if to.as_ref().unwrap_or(&end).below(&time)? => None,
            highest => highest,
        };
        flights.push(Flight { from: release.time.clone(), to, highest });
    }
    Ok(flights)
}
