//! A history in numbers that carry their bound, read in numbers without it.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Field, Motion, Scales, Side, StressPiece};
use crate::number::{Answer, Scalar};
use crate::ray::Ray;

/// A history whose numbers carry their bounds, read without them.
#[derive(Debug)]
pub struct Stripped<S: Answer, H> {
    history: H,
    events: Vec<Event<S>>,
    contacts: Vec<Contact<S>>,
    open: AtomicBool,
}

impl<S: Answer, H: Motion<S::Carried>> Stripped<S, H> {
    /// `history`, read without bounds; those of event times stay in [`Event::time_error`].
    pub fn new(history: H) -> Self {
        let events = history.events().iter().map(event).collect();
        let contacts = history.contacts().iter().map(|contact| Contact {
            from: strip(&contact.from),
            to: contact.to.as_ref().map(strip),
            impulse: strip(&contact.impulse),
            peak_stress: strip(&contact.peak_stress),
        });
        let contacts = contacts.collect();
        Stripped { events, contacts, history, open: AtomicBool::new(false) }
    }

    /// The history that carries the bounds.
    pub fn carried(&self) -> &H {
        &self.history
    }

    /// Whether a question has met a comparison that enclosures leave open.
    pub fn met_open_comparison(&self) -> bool {
        self.open.load(Ordering::Relaxed)
    }

    fn noted<T>(&self, answer: Result<T, Error>) -> Result<T, Error> {
        if matches!(answer, Err(Error::Open(_))) {
            self.open.store(true, Ordering::Relaxed);
        }
        answer
    }
}

fn strip<S: Answer>(x: &S::Carried) -> S {
    S::strip(x.clone())
}

fn pair<S: Answer>((a, b): (S::Carried, S::Carried)) -> (S, S) {
    (S::strip(a), S::strip(b))
}

fn event<S: Answer>(event: &Event<S::Carried>) -> Event<S> {
    Event {
        kind: event.kind,
        time_error: event.time.log2_error().exp2(),
        time: strip(&event.time),
        end_velocity: strip(&event.end_velocity),
        centre: strip(&event.centre),
        centre_velocity: strip(&event.centre_velocity),
    }
}

impl<S: Answer, H: Motion<S::Carried>> Motion<S> for Stripped<S, H> {
    fn end(&self) -> S {
        S::strip(self.history.end())
    }

    fn ending(&self) -> &Ending {
        self.history.ending()
    }

    fn events(&self) -> &[Event<S>] {
        &self.events
    }

    fn contacts(&self) -> &[Contact<S>] {
        &self.contacts
    }

    fn stress_pieces(&self) -> Vec<StressPiece<S>> {
        let piece = |piece: StressPiece<S::Carried>| StressPiece {
            from: S::strip(piece.from),
            to: S::strip(piece.to),
            left: S::strip(piece.left),
            right: S::strip(piece.right),
            chebyshev: piece.chebyshev.into_iter().map(S::strip).collect(),
        };
        self.history.stress_pieces().into_iter().map(piece).collect()
    }

    fn stress(&self, time: &S, side: Side) -> Result<S, Error> {
        self.noted(self.history.stress(&time.carry(), side)).map(S::strip)
    }

    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        self.noted(self.history.ground_end(&time.carry(), side)).map(pair)
    }

    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        self.noted(self.history.top_end(&time.carry(), side)).map(pair)
    }

    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        self.noted(self.history.centre(&time.carry())).map(pair)
    }

    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        let energy = self.noted(self.history.energy(&time.carry()))?;
        Ok(Energy {
            total: S::strip(energy.total),
            translational: S::strip(energy.translational),
            vibrational: S::strip(energy.vibrational),
        })
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        let field = self.noted(self.history.field(&point.carry(), &time.carry(), side))?;
        Ok(Field {
            displacement: S::strip(field.displacement),
            velocity: S::strip(field.velocity),
            strain: S::strip(field.strain),
        })
    }

    fn highest(&self, release: &Event<S>) -> Option<(S, S)> {
        let known = self
            .events
            .iter()
            .position(|event| event.kind == release.kind && event.time.text() == release.time.text())?;
        self.history.highest(self.history.events().get(known)?).map(pair)
    }

    fn rays(&self, trip: usize) -> Result<Vec<Ray<S>>, Error> {
        Ok(self.noted(self.history.rays(trip))?.into_iter().map(|ray| ray.map(S::strip)).collect())
    }

    fn scales(&self) -> Scales<S> {
        self.history.scales().map(S::strip)
    }

    fn error_estimate(&self) -> S {
        S::strip(self.history.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.history.digits_lost()
    }

    fn warnings(&self) -> &[String] {
        self.history.warnings()
    }
}
