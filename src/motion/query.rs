//! What can be asked of a motion, whatever engine answers.

use std::ops::ControlFlow;

use super::moments::{self, Moments};
use super::{Contact, Course, Ending, Energy, Event, EventKind, Field, Ray, Side, StressPiece, Stretch, Waves};
use crate::error::Error;
use crate::motion::partition;
use crate::number::Scalar;
use crate::problem::Parameters;
use crate::reason::Warning;

/// The scales of a motion: what its quantities are to be compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales<S> {
    /// `t₁`, of times; later times scale with themselves.
    pub time: S,
    /// About the greatest speed: `μ`, or `g t₁` where that is greater. Displacements scale with `time · velocity`, or
    /// with the greatest of them.
    pub velocity: S,
    /// `L`.
    pub length: S,
    /// `c`.
    pub wave_speed: S,
    /// `g`.
    pub gravity: S,
}

impl<S: Scalar> Scales<S> {
    /// Those of a rod that lands with its impact speed.
    pub fn of(rod: &Parameters<S>) -> Self {
        let Parameters { length, wave_speed, gravity, speed, .. } = rod.clone();
        Scales { time: rod.round_trip(), velocity: speed, length, wave_speed, gravity }
    }
}

impl<S> Scales<S> {
    /// The same scales in other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Scales<T> {
        Scales {
            time: f(self.time),
            velocity: f(self.velocity),
            length: f(self.length),
            wave_speed: f(self.wave_speed),
            gravity: f(self.gravity),
        }
    }
}

/// Two numbers at a time that an engine finds together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pair {
    /// `v(0,t)` and `v_t(0,t)`.
    GroundEnd,
    /// `h(t)` and `h′(t)`.
    Centre,
    /// `E_h(t)` and `E_z(t)`.
    Energy,
    /// `½ ∫ v_t² dx` and `½ c² ∫ v_x² dx`.
    EnergyParts,
}

/// What can be asked of a solution. All times are absolute, in the units of the scene; a time outside of
/// `0 … end()` is [`Error::TimeOutside`], a point outside of the rod is [`Error::PointOutside`].
///
/// An engine answers the first six; the rest follows from them, where it has no better answer of its own.
pub trait Motion<S: Scalar>: Send + Sync {
    /// What has happened, up to the end.
    fn course(&self) -> &Course<S>;

    /// The natural scales of the motion.
    fn scales(&self) -> Scales<S>;

    /// `v_x(0,·)` from 0 to the end, pieces in order, canonical: neighbours that continue each other are one.
    fn stress_pieces(&self) -> Vec<StressPiece<S>>;

    /// `v_x(0,t)`: the stress at the ground divided by the modulus; zero in flight.
    fn strain(&self, time: &S, side: Side) -> Result<S, Error>;

    /// Two numbers at a time. Only [`Pair::GroundEnd`] has two limits.
    fn pair(&self, pair: Pair, time: &S, side: Side) -> Result<[S; 2], Error>;

    /// `v`, `v_t`, `v_x` at `(x,t)`.
    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error>;

    /// The last time that is known.
    fn end(&self) -> S {
        self.course().end.clone()
    }

    /// Why it is the last.
    fn ending(&self) -> &Ending {
        &self.course().ending
    }

    /// All impacts and releases, in order. The start at `t = 0` is the first impact where the rod stands on the ground.
    fn events(&self) -> &[Event<S>] {
        &self.course().events
    }

    /// All contacts, in order.
    fn contacts(&self) -> &[Contact<S>] {
        &self.course().contacts
    }

    /// When a contact, counted from 0, begins and ends.
    fn contact_times(&self, contact: usize) -> Option<(S, Option<S>)> {
        self.contacts().get(contact).map(|contact| (contact.impact.clone(), contact.release.clone()))
    }

    /// The impulse of a contact, counted from 0.
    fn impulse(&self, contact: usize) -> Option<S> {
        self.contacts().get(contact).map(|contact| contact.impulse.clone())
    }

    /// What a user should know beside the numbers.
    fn warnings(&self) -> &[Warning] {
        &self.course().warnings
    }

    /// `v(0,t)` and `v_t(0,t)`.
    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        self.pair(Pair::GroundEnd, time, side).map(Into::into)
    }

    /// `v(L,t)` and `v_t(L,t)`.
    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let Field { displacement, velocity, .. } = self.field(&self.scales().length, time, side)?;
        Ok((displacement, velocity))
    }

    /// `h(t)` and `h′(t)`.
    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        self.pair(Pair::Centre, time, Side::Left).map(Into::into)
    }

    /// `E(t)`, `E_h(t)`, `E_z(t)`.
    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        let [translational, vibrational] = self.pair(Pair::Energy, time, Side::Left)?;
        Ok(Energy { total: translational.clone() + &vibrational, translational, vibrational })
    }

    /// `½ ∫ v_t² dx` and `½ c² ∫ v_x² dx`, each a sum of squares, per linear density: the kinetic energy of the whole
    /// motion, and the strain energy.
    fn energy_parts(&self, time: &S) -> Result<[S; 2], Error> {
        self.pair(Pair::EnergyParts, time, Side::Left)
    }

    /// `v_t` and `v_x` at every point of `points` for every time of `times`, both in increasing order: time by time,
    /// all points of one time together. Where a ray passes, the value on one of its sides.
    fn rates(&self, points: &[S], times: &[S]) -> Result<Vec<[S; 2]>, Error> {
        let places = times.iter().flat_map(|time| points.iter().map(move |point| (point, time)));
        places
            .into_iter()
            .map(|(point, time)| {
                let Field { velocity, strain, .. } = self.field(point, time, Side::Right)?;
                Ok([velocity, strain])
            })
            .collect()
    }

    /// `t*` and `h(t*)`: where the centre of mass turns in the flight after the release that is this event, if nothing
    /// ends the flight before. `None` where it does not turn: without gravity, under a fixed top, or already falling at
    /// the release.
    fn highest(&self, release: usize) -> Option<(S, S)>;

    /// The rays that leave the ground in round trip `trip`, counted from 0, in order: jumps, and mere kinks.
    ///
    /// **Errors**: [`Error::NoRays`] where they are not followed: under damping.
    fn rays(&self, trip: usize) -> Result<Vec<Ray<S>>, Error> {
        let _ = trip;
        Err(Error::NoRays)
    }

    /// The rod at a time, in stretches between the rays.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping.
    fn stretches(&self, time: &S) -> Result<Vec<Stretch<S>>, Error> {
        let _ = time;
        Err(Error::NoWaves)
    }

    /// The points from which the start sends rays: where its data bend or jump, and a top that is held.
    fn corners(&self) -> Vec<S> {
        Vec::new()
    }

    /// `∫ f dx` and `∫ f (x − a) dx` over each cell `a … b` between neighbours of `points`, which increase, for `f` =
    /// `v`, `v_t`, `v_x`.
    fn moments(&self, time: &S, points: &[S]) -> Result<Vec<Moments<S>>, Error> {
        moments::of_stretches(&self.stretches(time)?, points)
    }

    /// Whether the end is on the ground just before or just after a time: 1 or 0.
    fn in_contact(&self, time: &S, side: Side) -> Result<S, Error> {
        let like = self.end();
        if like.below(time) == Ok(true) || time.negative() == Ok(true) {
            return Err(Error::TimeOutside { found: time.text(), end: like.text() });
        }
        // The impact that ends a history is no event of it.
        if side == Side::Right && *self.ending() == Ending::NextImpact && !time.below(&like)? {
            return Ok(like.one());
        }
        let events = self.events();
        let passed = partition(events, |event| match side {
            Side::Left => event.t.below(time),
            Side::Right => Ok(!time.below(&event.t)?),
        })?;
        let contact = passed.checked_sub(1).is_some_and(|last| events[last].kind == EventKind::Impact);
        Ok(like.int(contact.into()))
    }

    /// The times that were asked for and are not told from that of an event or a ray, with the motion as it answers
    /// where they stand for these; `None` where there are none. Other answers at such times cover both sides.
    fn covered(&self) -> Option<(Vec<f64>, &dyn Motion<S>)> {
        None
    }

    /// Whether the two limits in time of anything at the ends may differ: `false` where no ray is there.
    fn may_jump(&self, time: &S) -> Result<bool, Error> {
        let _ = time;
        Ok(true)
    }

    /// The whole solution as two travelling waves.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping.
    fn waves(&self) -> Result<Waves<S>, Error> {
        Err(Error::NoWaves)
    }

    /// How far any quantity may be off, relative to its natural scale; zero where all is exact. The bound that the run
    /// carries.
    fn error_estimate(&self) -> S;

    /// How many impacts there were and `log₁₀` of the factor by which rounding may have grown over them; `None` where
    /// that is not followed.
    fn digits_lost(&self) -> Option<(u32, f64)> {
        None
    }
}

/// An observer that does nothing.
pub fn unobserved(_: usize, _: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
