//! Events, contacts and forces of a chain in one list.

use super::run::{ChainContact, ChainEvent, ForcePiece, Touch};
use crate::motion::Ending;
use crate::number::Value;
use crate::quantity::Measure;

/// Relative bound of the time of a peak from which on the peak counts as a plateau.
const PLATEAU: f64 = 0.01;

/// A number of an answer with the scale that its bound is held against.
pub(super) type Judged<'a> = (&'a Value, Measure);

/// Events, contacts and forces of a chain.
#[derive(Clone, Debug)]
pub struct ChainListing {
    /// Impacts and releases, in the order of time.
    pub events: Vec<ChainEvent<Value>>,
    /// Gaps that reach zero without a contact, in the order of time.
    pub touches: Vec<Touch<Value>>,
    /// Contacts, in the order of their impacts.
    pub contacts: Vec<ChainContact<Value>>,
    /// Pieces of the compressive force of each node; none where the force is a curve, whose pieces are those of
    /// [`ChainHistory::force_pieces`](super::ChainHistory::force_pieces).
    pub forces: Vec<Vec<ForcePiece<Value>>>,
    /// The last time.
    pub end: Value,
    /// The reason of the end.
    pub ending: Ending,
}

impl ChainListing {
    /// Converts the numbers.
    pub(super) fn map(self, f: impl Fn(Value) -> Value) -> Self {
        let pieces = |pieces: Vec<ForcePiece<Value>>| pieces.into_iter().map(|piece| piece.map(&f)).collect();
        ChainListing {
            events: self.events.into_iter().map(|event| event.map(&f)).collect(),
            touches: self.touches.into_iter().map(|touch| touch.map(&f)).collect(),
            contacts: self.contacts.into_iter().map(|contact| contact.map(&f)).collect(),
            forces: self.forces.into_iter().map(pieces).collect(),
            end: f(self.end),
            ending: self.ending,
        }
    }

    /// Returns whether impulse and peak of a contact are known: it ends, or it lasts to the time asked for.
    pub fn is_settled(&self, contact: &ChainContact<Value>) -> bool {
        contact.is_settled(&self.ending)
    }

    /// Returns the first time of the greatest force of a contact; `None` where its peak is not known, and where the
    /// force is the same over a plateau, which has no time of its own.
    pub fn peak_time<'a>(&self, contact: &'a ChainContact<Value>) -> Option<&'a Value> {
        let time = &contact.peak_time;
        let is_told = time.bound().to_f64() <= PLATEAU * time.to_f64().abs();
        Some(time).filter(|_| is_told && self.is_settled(contact))
    }

    /// Returns the numbers whose bounds decide whether longer numbers are taken. The time of a flat peak is known to
    /// half as many digits as the force, and that of a plateau not at all: it says so by its bound.
    pub(super) fn numbers(&self, peaks: bool) -> Vec<Judged<'_>> {
        let mut all = Vec::new();
        for event in &self.events {
            all.extend([
                (&event.t, Measure::Time),
                (&event.before, Measure::Velocity),
                (&event.after, Measure::Velocity),
            ]);
        }
        for contact in &self.contacts {
            all.push((&contact.impact, Measure::Time));
            all.extend(Some(&contact.peak_time).filter(|_| peaks).map(|t| (t, Measure::Time)));
            all.extend(contact.release.iter().map(|t| (t, Measure::Time)));
            all.extend([(&contact.impulse, Measure::Impulse), (&contact.peak, Measure::Force)]);
        }
        all.extend(self.forces.iter().flat_map(|pieces| piece_numbers(pieces)));
        all
    }
}

/// Returns the times and forces at the ends of pieces.
pub(super) fn piece_numbers(pieces: &[ForcePiece<Value>]) -> impl Iterator<Item = Judged<'_>> {
    pieces.iter().flat_map(|piece| {
        let ForcePiece { start, end, first, last, .. } = piece;
        [(start, Measure::Time), (end, Measure::Time), (first, Measure::Force), (last, Measure::Force)]
    })
}
