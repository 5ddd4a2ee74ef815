//! A history of many bits, read in doubles.

use rug::Float;

use crate::error::Error;
use crate::history::{Contact, Ending, Energy, Event, Field, History, Scales, Side, StressPiece};
use crate::number::{Number, Scalar};

/// A history that was computed in more bits than doubles have, each answer rounded once at the end.
pub struct Rounded {
    history: Box<dyn History<Float>>,
    bits: u32,
    ending: Ending,
    events: Vec<Event<f64>>,
    contacts: Vec<Contact<f64>>,
    warnings: Vec<String>,
}

impl Rounded {
    /// `history`, rounded.
    pub fn new(history: Box<dyn History<Float>>) -> Self {
        let bits = history.end().prec();
        let events = history.events().iter().map(event).collect();
        let contacts = history.contacts().iter().map(|contact| Contact {
            from: contact.from.to_f64(),
            to: contact.to.as_ref().map(Float::to_f64),
            impulse: contact.impulse.to_f64(),
            peak_stress: contact.peak_stress.to_f64(),
        });
        Rounded {
            ending: history.ending().clone(),
            contacts: contacts.collect(),
            warnings: history.warnings().to_vec(),
            events,
            bits,
            history,
        }
    }

    /// How many bits stand behind the doubles.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// A time that was rounded down to a double just beyond the end, or an event's own, is meant as that.
    fn time(&self, time: f64) -> Float {
        let exact = self
            .history
            .events()
            .iter()
            .map(|event| &event.time)
            .chain([&self.history.end()])
            .find_map(|known| (known.to_f64() == time).then(|| known.clone()));
        exact.unwrap_or_else(|| self.lift(time))
    }

    /// A double stands for the shortest decimal that it is the nearest to: `0.6` is 6/10, and meets a ray that comes then.
    fn lift(&self, x: f64) -> Float {
        match x.to_string().parse::<Number>() {
            Ok(number) => Float::from_number(&number, &self.bits),
            Err(_) => Float::with_val(self.bits, x),
        }
    }
}

fn event(event: &Event<Float>) -> Event<f64> {
    let time = event.time.to_f64();
    Event {
        kind: event.kind,
        time,
        end_velocity: event.end_velocity.to_f64(),
        centre: event.centre.to_f64(),
        centre_velocity: event.centre_velocity.to_f64(),
        time_error: event.time_error + time * f64::EPSILON / 2.0,
    }
}

fn pair(pair: (Float, Float)) -> (f64, f64) {
    (pair.0.to_f64(), pair.1.to_f64())
}

impl History<f64> for Rounded {
    fn end(&self) -> f64 {
        self.history.end().to_f64()
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn events(&self) -> &[Event<f64>] {
        &self.events
    }

    fn contacts(&self) -> &[Contact<f64>] {
        &self.contacts
    }

    fn stress_pieces(&self) -> Vec<StressPiece<f64>> {
        let round = |piece: StressPiece<Float>| StressPiece {
            from: piece.from.to_f64(),
            to: piece.to.to_f64(),
            left: piece.left.to_f64(),
            right: piece.right.to_f64(),
            chebyshev: piece.chebyshev.iter().map(Float::to_f64).collect(),
        };
        self.history.stress_pieces().into_iter().map(round).collect()
    }

    fn stress(&self, time: &f64, side: Side) -> Result<f64, Error> {
        Ok(self.history.stress(&self.time(*time), side)?.to_f64())
    }

    fn ground_end(&self, time: &f64, side: Side) -> Result<(f64, f64), Error> {
        self.history.ground_end(&self.time(*time), side).map(pair)
    }

    fn top_end(&self, time: &f64, side: Side) -> Result<(f64, f64), Error> {
        self.history.top_end(&self.time(*time), side).map(pair)
    }

    fn centre(&self, time: &f64) -> Result<(f64, f64), Error> {
        self.history.centre(&self.time(*time)).map(pair)
    }

    fn energy(&self, time: &f64) -> Result<Energy<f64>, Error> {
        let energy = self.history.energy(&self.time(*time))?;
        Ok(Energy {
            total: energy.total.to_f64(),
            translational: energy.translational.to_f64(),
            vibrational: energy.vibrational.to_f64(),
        })
    }

    fn field(&self, point: &f64, time: &f64, side: Side) -> Result<Field<f64>, Error> {
        let field = self.history.field(&self.lift(*point), &self.time(*time), side)?;
        Ok(Field {
            displacement: field.displacement.to_f64(),
            velocity: field.velocity.to_f64(),
            strain: field.strain.to_f64(),
        })
    }

    fn highest(&self, release: &Event<f64>) -> Option<(f64, f64)> {
        let known = self.events.iter().position(|event| event.time == release.time)?;
        self.history.highest(self.history.events().get(known)?).map(pair)
    }

    fn scales(&self) -> Scales<f64> {
        let Scales { time, velocity, length, wave_speed } = self.history.scales();
        Scales {
            time: time.to_f64(),
            velocity: velocity.to_f64(),
            length: length.to_f64(),
            wave_speed: wave_speed.to_f64(),
        }
    }

    fn error_estimate(&self) -> f64 {
        self.history.error_estimate().to_f64() + f64::EPSILON
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.history.digits_lost()
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}
