//! A history whose answers carry their bounds.

use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Field, Motion, Scales, Side, StressPiece};
use crate::number::{Estimate, Rounded, Scalar};
use crate::reason::Warning;

/// A history, each of whose numbers has the bound that follows from [`Motion::error_estimate`] and its natural scale;
/// times of events have their own.
///
/// **Accuracy**: *within its own bound*, away from rays that are themselves off in time. A time that is asked about is
/// taken as it is stored, or as that of an event beside it.
#[derive(Debug)]
pub struct WithBounds<S, H> {
    history: H,
    /// Bounds of displacements, velocities, strains, and energies for each unit of speed.
    rise: f64,
    speed: f64,
    strain: f64,
    length: f64,
    gravity: f64,
    events: Vec<Event<Estimate<S>>>,
    contacts: Vec<Contact<Estimate<S>>>,
}

/// `value` within `bound`.
fn within<S: Rounded>(value: &S, bound: f64) -> Estimate<S> {
    Estimate::new(value.clone(), bound / value.unit() + value.to_f64().abs())
}

impl<S: Rounded, H: Motion<S>> WithBounds<S, H> {
    /// `history` with its bounds.
    pub fn new(history: H) -> Self {
        let Scales { time, velocity, length, wave_speed, gravity } = history.scales();
        let error = history.error_estimate().to_f64();
        let speed = error * velocity.to_f64();
        let (rise, strain) = (speed * time.to_f64(), speed / wave_speed.to_f64());
        let event = |event: &Event<S>| Event {
            kind: event.kind,
            time: within(&event.time, event.time_error),
            end_velocity: within(&event.end_velocity, speed),
            centre: within(&event.centre, rise),
            centre_velocity: within(&event.centre_velocity, speed),
            time_error: event.time_error,
        };
        let events: Vec<_> = history.events().iter().map(event).collect();
        let time_of = |time: &S| {
            let known = events.iter().find(|event| event.time.value() == time);
            known.map_or_else(|| within(time, 0.0), |event| event.time.clone())
        };
        let contact = |contact: &Contact<S>| {
            let (from, to) = (time_of(&contact.from), contact.to.as_ref().map(&time_of));
            let last = to.as_ref().map_or_else(|| history.end().to_f64(), Estimate::to_f64);
            // −c² ∫ v_x dt.
            let push = (last - from.to_f64()) * strain * wave_speed.to_f64().powi(2);
            Contact {
                impulse: within(&contact.impulse, push + 2.0 * rise * wave_speed.to_f64()),
                peak_stress: within(&contact.peak_stress, strain),
                from,
                to,
            }
        };
        let contacts = history.contacts().iter().map(contact).collect();
        let (length, gravity) = (length.to_f64(), gravity.to_f64());
        WithBounds { rise, speed, strain, length, gravity, events, contacts, history }
    }

    /// The time that is asked about: that of an event from which roundings alone set it apart.
    fn meant(&self, time: &Estimate<S>) -> S {
        let next = self.events.partition_point(|event| event.time.value() < time.value());
        let near = self.events[next.saturating_sub(1)..].iter().take(2);
        let roundings = 4.0 * time.value().unit() * time.value().to_f64().abs();
        let same = |event: &&Event<Estimate<S>>| {
            let apart = (event.time.value().clone() - time.value()).to_f64().abs();
            apart <= time.bound() + event.time.bound().min(roundings)
        };
        near.filter(same).map(|event| &event.time).next().unwrap_or(time).value().clone()
    }

    /// The history without its bounds.
    pub fn plain(&self) -> &H {
        &self.history
    }
}

impl<S: Rounded, H: Motion<S>> Motion<Estimate<S>> for WithBounds<S, H> {
    fn end(&self) -> Estimate<S> {
        within(&self.history.end(), 0.0)
    }

    fn ending(&self) -> &Ending {
        self.history.ending()
    }

    fn events(&self) -> &[Event<Estimate<S>>] {
        &self.events
    }

    fn contacts(&self) -> &[Contact<Estimate<S>>] {
        &self.contacts
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        let piece = |piece: StressPiece<S>| StressPiece {
            from: within(&piece.from, 0.0),
            to: within(&piece.to, 0.0),
            left: within(&piece.left, self.strain),
            right: within(&piece.right, self.strain),
            // The bound is that of the whole; the first coefficient carries it.
            chebyshev: piece
                .chebyshev
                .iter()
                .enumerate()
                .map(|(k, c)| within(c, if k == 0 { self.strain } else { 0.0 }))
                .collect(),
        };
        self.history.stress_pieces().into_iter().map(piece).collect()
    }

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        Ok(within(&self.history.strain(&self.meant(time), side)?, self.strain))
    }

    fn ground_end(&self, time: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let (height, rate) = self.history.ground_end(&self.meant(time), side)?;
        Ok((within(&height, self.rise), within(&rate, self.speed)))
    }

    fn top_end(&self, time: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let (height, rate) = self.history.top_end(&self.meant(time), side)?;
        Ok((within(&height, self.rise), within(&rate, self.speed)))
    }

    fn centre(&self, time: &Estimate<S>) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let (height, rate) = self.history.centre(&self.meant(time))?;
        Ok((within(&height, self.rise), within(&rate, self.speed)))
    }

    /// Of a mean square `s²`, off by δ in the root, `L s²/2` is off by at most `L (2s + δ) δ`; and `L g h` by that of
    /// h.
    fn energy(&self, time: &Estimate<S>) -> Result<Energy<Estimate<S>>, Error> {
        let energy = self.history.energy(&self.meant(time))?;
        let (_, rate) = self.history.centre(&self.meant(time))?;
        let vibration = (2.0 * energy.vibrational.to_f64().max(0.0) / self.length).sqrt();
        let of = |speed: f64| self.length * (2.0 * speed + self.speed) * self.speed;
        let weight = self.length * self.gravity * self.rise;
        let translational = of(rate.to_f64().abs()) + weight;
        Ok(Energy {
            total: within(&energy.total, translational + of(vibration)),
            translational: within(&energy.translational, translational),
            vibrational: within(&energy.vibrational, of(vibration)),
        })
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let field = self.history.field(point.value(), &self.meant(time), side)?;
        Ok(Field {
            displacement: within(&field.displacement, self.rise),
            velocity: within(&field.velocity, self.speed),
            strain: within(&field.strain, self.strain),
        })
    }

    fn highest(&self, release: &Event<Estimate<S>>) -> Option<(Estimate<S>, Estimate<S>)> {
        let known = self.events.iter().position(|event| event.time.value() == release.time.value())?;
        let (time, height) = self.history.highest(self.history.events().get(known)?)?;
        // dt*/dh′ = 1/(g + 2rh′); and what the height loses there is of second order.
        let late = release.time_error + self.speed / self.gravity;
        Some((within(&time, late), within(&height, self.rise + self.gravity * late * late)))
    }

    fn scales(&self) -> Scales<Estimate<S>> {
        self.history.scales().map(|scale| within(&scale, 0.0))
    }

    fn error_estimate(&self) -> Estimate<S> {
        Estimate::exact(self.history.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.history.digits_lost()
    }

    fn warnings(&self) -> &[Warning] {
        self.history.warnings()
    }
}
