//! Queries that a motion answers, for every engine.

use std::ops::ControlFlow;

use super::maps::maps;
use super::moments::{self, Moments};
use super::{Contact, Course, Ending, Energy, Event, EventKind, Field, Ray, Side, StressPiece, Stretch, Waves};
use crate::error::Error;
use crate::number::Scalar;
use crate::problem::Parameters;
use crate::reason::Warning;

/// Converts the time of each place, once for all places of one time in a row.
pub(crate) fn by_time<S: Scalar, T: Clone>(
    places: &[(S, S)],
    convert: impl Fn(&S) -> Result<T, Error>,
) -> Result<Vec<T>, Error> {
    let known = |time: &S| (time.spelled_as(), time.log2_error());
    let is_same = |(_, a): &(S, S), (_, b): &(S, S)| a.alike(b) && known(a) == known(b);
    let mut times = Vec::with_capacity(places.len());
    for places in places.chunk_by(is_same) {
        let time = convert(&places[0].1)?;
        times.extend(places.iter().map(|_| time.clone()));
    }
    Ok(times)
}

/// Returns the number of leading items of `list` that have `passed`, by bisection.
///
/// **Errors**: the first one of `passed`.
pub(crate) fn partition<T, E>(list: &[T], passed: impl Fn(&T) -> Result<bool, E>) -> Result<usize, E> {
    let (mut from, mut to) = (0, list.len());
    while from < to {
        let middle = (from + to) / 2;
        if passed(&list[middle])? { from = middle + 1 } else { to = middle }
    }
    Ok(from)
}

/// Natural scales of a motion, with which its quantities are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales<S> {
    /// `t₁`, the scale of times below `t₁`; a later time is its own scale.
    pub time: S,
    /// Approximately the greatest speed: `μ`, or `g t₁` if that is greater. The scale of displacements is
    /// `time · velocity`, or the greatest displacement.
    pub velocity: S,
    /// `L`.
    pub length: S,
    /// `c`.
    pub wave_speed: S,
    /// `g`.
    pub gravity: S,
}

impl<S: Scalar> Scales<S> {
    /// Returns the scales of a rod that lands with its impact speed.
    pub fn of(rod: &Parameters<S>) -> Self {
        let Parameters { length, wave_speed, gravity, speed, .. } = rod.clone();
        Scales { time: rod.round_trip(), velocity: speed, length, wave_speed, gravity }
    }
}

maps!(pub Scales { time, velocity, length, wave_speed, gravity });

/// Two quantities at a time that an engine computes together.
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

/// Queries that every solution answers. All times are absolute, in the units of the scene. A time outside
/// `0 … end()` is [`Error::TimeOutside`], a point outside the rod is [`Error::PointOutside`].
///
/// An engine implements the methods without a default; the others follow from them unless an engine overrides them.
pub trait Motion<S: Scalar>: Send + Sync {
    /// Returns events and contacts up to the end, with the reason of the end.
    fn course(&self) -> &Course<S>;

    /// Returns the natural scales of the motion.
    fn scales(&self) -> Scales<S>;

    /// Returns `v_x(0,·)` from 0 to the end, pieces in order, with neighbours that continue each other merged.
    fn stress_pieces(&self) -> Vec<StressPiece<S>>;

    /// Returns `v_x(0,t)`: the stress at the ground divided by the modulus; zero in flight.
    fn strain(&self, time: &S, side: Side) -> Result<S, Error>;

    /// Returns two quantities at a time. Only [`Pair::GroundEnd`] has two limits.
    fn pair(&self, pair: Pair, time: &S, side: Side) -> Result<[S; 2], Error>;

    /// Returns `v`, `v_t`, `v_x` at `(x,t)`.
    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error>;

    /// Returns the last known time.
    fn end(&self) -> S {
        self.course().end.clone()
    }

    /// Returns the reason of the end.
    fn ending(&self) -> &Ending {
        &self.course().ending
    }

    /// Returns all impacts and releases, in order. A rod that stands on the ground has its first impact at `t = 0`.
    fn events(&self) -> &[Event<S>] {
        &self.course().events
    }

    /// Returns all contacts, in order.
    fn contacts(&self) -> &[Contact<S>] {
        &self.course().contacts
    }

    /// Returns the times of impact and release of a contact, counted from 0.
    fn contact_times(&self, contact: usize) -> Option<(S, Option<S>)> {
        self.contacts().get(contact).map(|contact| (contact.impact.clone(), contact.release.clone()))
    }

    /// Returns the impulse of a contact, counted from 0.
    fn impulse(&self, contact: usize) -> Option<S> {
        self.contacts().get(contact).map(|contact| contact.impulse.clone())
    }

    /// Returns warnings about the numbers.
    fn warnings(&self) -> &[Warning] {
        &self.course().warnings
    }

    /// Returns `v(0,t)` and `v_t(0,t)`.
    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        self.pair(Pair::GroundEnd, time, side).map(Into::into)
    }

    /// Returns `v(L,t)` and `v_t(L,t)`.
    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let Field { displacement, velocity, .. } = self.field(&self.scales().length, time, side)?;
        Ok((displacement, velocity))
    }

    /// Returns `h(t)` and `h′(t)`.
    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        self.pair(Pair::Centre, time, Side::Left).map(Into::into)
    }

    /// Returns `E(t)`, `E_h(t)`, `E_z(t)`.
    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        let [translational, vibrational] = self.pair(Pair::Energy, time, Side::Left)?;
        Ok(Energy { total: translational.clone() + &vibrational, translational, vibrational })
    }

    /// Returns `½ ∫ v_t² dx` and `½ c² ∫ v_x² dx`, each a sum of squares, per linear density: the kinetic energy of the
    /// whole motion, and the strain energy.
    fn energy_parts(&self, time: &S) -> Result<[S; 2], Error> {
        self.pair(Pair::EnergyParts, time, Side::Left)
    }

    /// Returns `v_t` and `v_x` at every place, a point and a time, in increasing order of times. On a ray, the values
    /// are the limit from one side.
    fn rates(&self, places: &[(S, S)]) -> Result<Vec<[S; 2]>, Error> {
        let rates = |(point, time): &(S, S)| {
            let Field { velocity, strain, .. } = self.field(point, time, Side::Right)?;
            Ok([velocity, strain])
        };
        places.iter().map(rates).collect()
    }

    /// Returns `t*` and `h(t*)`, at which the centre of mass is highest in the flight after the release with this event
    /// index, if nothing ends the flight before. `None` without such a point: without gravity, under a fixed top, or if
    /// the centre falls at the release already.
    fn highest(&self, release: usize) -> Option<(S, S)>;

    /// Returns the rays that leave the ground in round trip `trip`, counted from 0, in order: jumps and mere kinks.
    ///
    /// **Errors**: [`Error::NoRays`] if the engine does not follow rays: under damping.
    fn rays(&self, trip: usize) -> Result<Vec<Ray<S>>, Error> {
        let _ = trip;
        Err(Error::NoRays)
    }

    /// Returns the rays that leave the lower end, and those that leave the upper end, by their times of departure and
    /// the jumps of `v_t`; a ray that enters the rod elsewhere by the time at which it would have left the end.
    ///
    /// **Errors**: [`Error::NoWaves`] for a rod by itself, whose rays [`Motion::waves`] and [`Motion::rays`] return.
    fn departures(&self) -> Result<[Vec<(S, S)>; 2], Error> {
        Err(Error::NoWaves)
    }

    /// Returns the stretches of the rod between the rays at a time.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping.
    fn stretches(&self, time: &S) -> Result<Vec<Stretch<S>>, Error> {
        let _ = time;
        Err(Error::NoWaves)
    }

    /// Returns the points from which the start sends rays: kinks and jumps of its data, and a fixed top.
    fn corners(&self) -> Vec<S> {
        Vec::new()
    }

    /// Returns `∫ f dx` and `∫ f (x − a) dx` over each cell `a … b` between neighbours of the increasing `points`, for
    /// `f` = `v`, `v_t`, `v_x`.
    fn moments(&self, time: &S, points: &[S]) -> Result<Vec<Moments<S>>, Error> {
        moments::of_stretches(&self.stretches(time)?, points)
    }

    /// Returns 1 if the end is in contact just before or just after a time, and 0 otherwise.
    fn in_contact(&self, time: &S, side: Side) -> Result<S, Error> {
        let like = self.end();
        if like.below(time) == Ok(true) || time.negative() == Ok(true) {
            return Err(Error::TimeOutside { found: time.text(), end: like.text() });
        }
        // The impact that ends a history is not one of its events.
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

    /// Returns the queried times that are indistinguishable from an event or a ray, with the motion that answers for
    /// these events and rays; `None` if there are none. Other answers at such times cover both sides.
    fn covered(&self) -> Option<(Vec<f64>, &dyn Motion<S>)> {
        None
    }

    /// Returns whether the two limits in time of any quantity at the ends may differ: `false` if no ray is there.
    fn may_jump(&self, time: &S) -> Result<bool, Error> {
        let _ = time;
        Ok(true)
    }

    /// Returns the whole solution as two travelling waves.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping.
    fn waves(&self) -> Result<Waves<S>, Error> {
        Err(Error::NoWaves)
    }

    /// Returns the error bound that the run carries for all quantities, relative to their natural scales; 0 if exact.
    fn error_estimate(&self) -> S;

    /// Returns the number of impacts and `log₁₀` of the factor by which rounding errors may have grown over them;
    /// `None` if the engine does not track this.
    fn digits_lost(&self) -> Option<(u32, f64)> {
        None
    }
}

/// Ignores the progress and continues.
pub fn unobserved(_: usize, _: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
