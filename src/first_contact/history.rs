//! The first contact as a history, from the impact to the bounce.

use std::sync::OnceLock;

use super::field::{FirstContact, Trips};
use super::outcome::{Bounce, BounceKind};
use super::rebound::Rebound;
use super::static_state::{StaticState, faded_after};
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{
    Contact, Course, Ending, Energy, Event, EventKind, Field, Motion, Pair, Scales, Side, StressPiece,
};
use crate::number::{Open, Scalar};
use crate::problem::{Parameters, Problem, Run};
use crate::reason::{Reason, Warning};
use crate::special::BoundedSpecial;

/// The first contact of a uniform start under a free top, damped or not, from the impact to the bounce, or to the end
/// of the closed forms used.
///
/// **Source**: [`FirstContact`]; Theorem 1 for its end. The bounce is the first sign change of the stress, with a proof
/// that none comes before it: a jump at `k t₁`, whose number k is exact, or a root between signs beyond their bounds.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *within its own bound*: estimates in [`Estimate`](crate::number::Estimate), enclosures in intervals.
/// The history ends with the contact, because the flight that follows is only valid until an impact ends it: see
/// [`Rebound::flight`].
///
/// ```
/// use dalembert::{Estimate, Number, Problem};
/// use dalembert::engine::{ContactHistory, Motion};
/// // (1.10): g = 0, R = 3: the bounce is a root in the fourth round trip.
/// let mut problem = Problem::uniform("1/2".parse()?, Number::from(1), Number::from(0), Number::from(1));
/// problem = problem.to_builder().damping(3).build()?;
/// let contact = ContactHistory::<Estimate<f64>>::solve(&problem, &())?;
/// let bounce = &contact.events()[1].t;
/// assert!((bounce.value() - 3.299026051445773).abs() < bounce.bound() && bounce.bound() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// All values except the end are computed on demand.
#[derive(Clone, Debug)]
pub struct ContactHistory<N> {
    contact: FirstContact<N>,
    end: N,
    ending: Ending,
    /// Time up to which the closed forms are used: the end, or rest.
    followed: Trips<N>,
    /// Behaviour of the stress at the end, if that is the bounce.
    release: Option<BounceKind>,
    /// Number of round trips after which a contact without end is at rest.
    rest: Option<i64>,
    rebound: OnceLock<Box<Rebound<N>>>,
    course: OnceLock<Box<Course<N>>>,
}

/// A time of the history.
enum Moment<'a, N> {
    Bounce(BounceKind),
    Contact(Trips<N>),
    /// A time at which a contact without end is at rest.
    Rest(StaticState<'a, N>),
}

/// Round trips for which a contact without end is followed: the number if no time is requested, and the maximum, which
/// does not apply if the rod is at rest by then.
const SHOWN_TRIPS: i64 = 8;
const MOST_TRIPS: i64 = 256;

/// Converts an undecided comparison of enclosures into an error.
fn open<T>(what: &'static str, like: &impl Scalar, found: Result<T, Open>) -> Result<T, Error> {
    found.map_err(|_| Error::not_decided(what, like.bits()))
}

fn trips_at<N: BoundedSpecial>(contact: &FirstContact<N>, time: &N) -> Result<Trips<N>, Error> {
    open("how many rays have returned by that time", time, contact.trips(time).ok_or(Open))
}

impl<N: BoundedSpecial> ContactHistory<N> {
    /// Solves the first contact of `problem`, up to the requested time.
    ///
    /// **Errors**: [`Error::NoClosedForm`]; [`Error::NotDecided`] if more bits may decide how the contact ends.
    pub fn solve(problem: &Problem, precision: &N::Precision) -> Result<Self, Error> {
        if !problem.has_closed_form() {
            return Err(Error::NoClosedForm);
        }
        let contact = FirstContact::new(&Parameters::<N>::of(problem, precision)?);
        let bounce = contact.bounce();
        if matches!(&bounce, Bounce::Undecided { why, .. } if why.needs_bits()) {
            return Err(Error::not_decided("how the contact ends", contact.round_trip().bits()));
        }
        let asked = match problem.run() {
            Run::Time(asked) => Some(N::from_number(asked, precision)),
            Run::Impacts(_) => None,
        };
        Self::new(contact, bounce, asked)
    }

    /// Builds the first contact that ends with `bounce`, up to the requested time `asked`.
    ///
    /// **Errors**: [`Error::NotDecided`] if an enclosure leaves open which of the two comes first.
    pub fn new(contact: FirstContact<N>, bounce: Bounce<N>, asked: Option<N>) -> Result<Self, Error> {
        let (rebound, course) = (OnceLock::new(), OnceLock::new());
        let (until, ending) = match bounce {
            Bounce::At { time, trips, kind } => match &asked {
                Some(asked) if open("whether the contact lasts so long", asked, asked.below(&time))? => {
                    (None, Ending::Time)
                }
                _ => {
                    let (end, ending, followed, release, rest) = (time, Ending::Bounce, trips, Some(kind), None);
                    return Ok(ContactHistory { contact, end, ending, followed, release, rest, rebound, course });
                }
            },
            Bounce::Undecided { until, why } => (Some(until), Ending::Undecided(Reason::Doubt(why))),
            Bounce::Never(reason) => (None, Ending::NoBounce(Reason::NoBounce(reason))),
        };
        let trips = |k: i64| contact.round_trip.int(k) * &contact.round_trip;
        let most = trips(if asked.is_some() { MOST_TRIPS } else { SHOWN_TRIPS });
        let last = until.clone().unwrap_or(most);
        let (mut end, mut ending, mut rest) = (last.clone(), ending, None);
        if let Some(asked) = asked {
            if !open("whether the contact is followed so long", &asked, last.below(&asked))? {
                (end, ending) = (asked, Ending::Time);
            } else if until.is_none()
                && let Some(faded) = faded_after(&contact.rod, MOST_TRIPS)
            {
                (end, rest) = (asked, Some(faded));
            }
        }
        let followed = match rest {
            Some(rest) => contact.lattice(rest),
            None => trips_at(&contact, &end)?,
        };
        Ok(ContactHistory { contact, end, ending, followed, release: None, rest, rebound, course })
    }

    fn measured(&self) -> Course<N> {
        let (zero, rod) = (self.end.zero(), &self.contact.rod);
        let mut events = vec![Event {
            kind: EventKind::Impact,
            v_end: -rod.speed.clone(),
            h: zero.clone(),
            h_rate: -rod.speed.clone(),
            t: zero.clone(),
            t_error: 0.0,
        }];
        if let (Some(kind), Some(rebound)) = (self.release, self.rebound()) {
            let end_velocity = match kind {
                // The stress of a rod still held to the ground would be tensile: it gives the velocity of the end.
                BounceKind::Jump => {
                    match (self.contact.stress_at(&self.followed, Side::Right) * &rod.wave_speed).without_exact() {
                        none if none.vanishes() == Ok(true) => zero.clone().widened(&none),
                        pull => pull,
                    }
                }
                BounceKind::Root => zero.clone(),
            };
            events.push(Event {
                kind: EventKind::Release,
                t: self.end.clone(),
                v_end: end_velocity,
                h: rebound.centre.clone(),
                h_rate: rebound.velocity.clone(),
                t_error: self.end.log2_error().exp2(),
            });
        }
        let contacts = vec![Contact {
            release: self.release.map(|_| self.end.clone()),
            impulse: self.whole_impulse(),
            peak_strain: self.contact.peak(&self.followed),
            impact: zero,
        }];
        Course { events, contacts, ..Course::new(self.end.clone(), self.ending.clone()) }
    }

    /// Computes `−c² ∫ v_x dt = P(t) − P(0) + 2rL h(t) + gLt`, (3.36) integrated, over the contact.
    fn whole_impulse(&self) -> N {
        let rod = &self.contact.rod;
        let (centre, velocity) = match (self.rebound(), self.rest) {
            (Some(rebound), _) => (rebound.centre.clone(), rebound.velocity.clone()),
            (None, Some(_)) => StaticState::of(rod).centre(),
            (None, None) => self.contact.centre_at(&self.followed),
        };
        let gained = velocity + &rod.speed + centre * &rod.damping * &self.end.int(2) + rod.gravity.clone() * &self.end;
        (gained * &rod.length).without_exact()
    }

    /// Returns the closed forms behind the history, which hold during the contact.
    pub fn form(&self) -> &FirstContact<N> {
        &self.contact
    }

    /// Returns the behaviour of the stress at the bounce, and k if that is at `k t₁`; `None` if there is no bounce.
    pub fn bounce(&self) -> Option<(BounceKind, Option<i64>)> {
        self.release.map(|kind| (kind, self.followed.lattice()))
    }

    /// Returns the motion of the centre of mass after the bounce; `None` if there is no bounce.
    pub fn rebound(&self) -> Option<&Rebound<N>> {
        self.release?;
        Some(self.rebound.get_or_init(|| {
            let (centre, velocity) = self.contact.centre_at(&self.followed);
            Box::new(Rebound { time: self.end.clone(), centre, velocity, rod: self.contact.rod.clone() })
        }))
    }

    fn moment(&self, time: &N) -> Result<Moment<'_, N>, Error> {
        let at_end = time.coincides(&self.end);
        if at_end && let Some(kind) = self.release {
            return Ok(Moment::Bounce(kind));
        }
        let outside = || Ok(time.negative()? || !at_end && self.end.below(time)?);
        if !time.is_finite() || open("whether that time is before the end", time, outside())? {
            return Err(Error::TimeOutside { found: time.text(), end: self.end.text() });
        }
        if let Some(rest) = self.rest {
            let rest = self.end.int(rest) * &self.contact.round_trip;
            if open("whether the rod is at rest", time, rest.below(time))? {
                return Ok(Moment::Rest(StaticState::of(&self.contact.rod)));
            }
        }
        Ok(Moment::Contact(trips_at(&self.contact, time)?))
    }

    /// Returns whether the state is the one just before the impact.
    fn before_impact(time: &N, side: Side) -> bool {
        side == Side::Left && time.vanishes() == Ok(true)
    }
}

impl<N: BoundedSpecial> Motion<N> for ContactHistory<N> {
    fn course(&self) -> &Course<N> {
        self.course.get_or_init(|| Box::new(self.measured()))
    }

    fn end(&self) -> N {
        self.end.clone()
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn warnings(&self) -> &[Warning] {
        &[]
    }

    fn contact_times(&self, contact: usize) -> Option<(N, Option<N>)> {
        (contact == 0).then(|| (self.end.zero(), self.release.map(|_| self.end.clone())))
    }

    fn impulse(&self, contact: usize) -> Option<N> {
        (contact == 0).then(|| self.whole_impulse())
    }

    fn stress_pieces(&self) -> Vec<StressPiece<N>> {
        let mut pieces = self.contact.pieces(&self.followed);
        if let Some(last) = pieces.last_mut().filter(|_| self.rest.is_none()) {
            last.end = self.end.clone();
            if self.release == Some(BounceKind::Root) {
                last.strain_end = self.end.zero();
            }
        }
        if let Some(rest) = self.rest {
            let still = StaticState::of(&self.contact.rod).field(&self.end.zero()).strain;
            let (start, end) = (self.end.int(rest) * &self.contact.round_trip, self.end.clone());
            let (strain_start, chebyshev) = (still.clone(), vec![still.clone()]);
            pieces.push(StressPiece { start, end, strain_start, strain_end: still, chebyshev });
        }
        pieces
    }

    fn strain(&self, time: &N, side: Side) -> Result<N, Error> {
        if Self::before_impact(time, side) {
            return Ok(time.zero());
        }
        Ok(match self.moment(time)? {
            // The stress at a root, or its limit before the jump.
            Moment::Bounce(BounceKind::Jump) if side == Side::Left => {
                self.contact.stress_at(&self.followed, Side::Left)
            }
            Moment::Bounce(_) => time.zero(),
            Moment::Contact(trips) => self.contact.stress_at(&trips, side),
            Moment::Rest(state) => state.field(&time.zero()).strain,
        })
    }

    fn pair(&self, pair: Pair, time: &N, side: Side) -> Result<[N; 2], Error> {
        if pair == Pair::GroundEnd {
            if Self::before_impact(time, side) {
                return Ok([time.zero(), -self.contact.rod.speed.clone()]);
            }
            return Ok(match (self.moment(time)?, self.events().last()) {
                (Moment::Bounce(_), Some(event)) if side == Side::Right => [time.zero(), event.v_end.clone()],
                _ => [time.zero(), time.zero()],
            });
        }
        // The rod is undeformed and has its given velocity: no ray is in it yet.
        if pair == Pair::Centre && time.vanishes() == Ok(true) {
            return Ok([time.zero(), -self.contact.rod.speed.clone()]);
        }
        let apart = |Energy { translational, vibrational, .. }| [translational, vibrational];
        let moment = self.moment(time)?;
        let trips = match &moment {
            Moment::Bounce(_) => &self.followed,
            Moment::Contact(trips) => trips,
            Moment::Rest(state) => {
                return Ok(match pair {
                    Pair::Centre | Pair::GroundEnd => state.centre().into(),
                    Pair::Energy => apart(state.energy()),
                    Pair::EnergyParts => state.energy_parts(),
                });
            }
        };
        Ok(match pair {
            Pair::Centre | Pair::GroundEnd => self.contact.centre_at(trips).into(),
            Pair::Energy => apart(self.contact.energy_at(trips)),
            Pair::EnergyParts => self.contact.energy_parts_at(trips),
        })
    }

    fn field(&self, point: &N, time: &N, side: Side) -> Result<Field<N>, Error> {
        let length = &self.contact.rod.length;
        let outside = || Ok(point.negative()? || !point.coincides(length) && length.below(point)?);
        if !point.is_finite() || open("whether the point is in the rod", point, outside())? {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        match self.moment(time)? {
            Moment::Bounce(_) => {
                let ground =
                    side == Side::Right && open("whether the point is at the ground", point, point.vanishes())?;
                if ground {
                    let (displacement, velocity) = self.ground_end(time, side)?;
                    return Ok(Field { displacement, velocity, strain: time.zero() });
                }
                Ok(self.contact.field_at(point, &self.followed, side))
            }
            Moment::Contact(trips) => Ok(self.contact.field_at(point, &trips, side)),
            Moment::Rest(state) => Ok(state.field(point)),
        }
    }

    fn moments(&self, time: &N, points: &[N]) -> Result<Vec<Moments<N>>, Error> {
        match self.moment(time)? {
            Moment::Bounce(_) => Ok(self.contact.moments_at(points, &self.followed)),
            Moment::Contact(trips) => Ok(self.contact.moments_at(points, &trips)),
            Moment::Rest(state) => state.moments(points),
        }
    }

    /// **Errors**: `None` also if these bits leave open whether the centre of mass rises.
    fn highest(&self, release: usize) -> Option<(N, N)> {
        self.rebound().filter(|_| release == 1)?.highest()
    }

    fn scales(&self) -> Scales<N> {
        let rod = &self.contact.rod;
        let critical = rod.gravity.clone() * &self.contact.round_trip;
        // Either is a scale if it is undecided which is greater.
        let velocity = if rod.speed.near().0 >= critical.near().0 { rod.speed.clone() } else { critical };
        Scales { time: self.contact.round_trip(), velocity, ..Scales::of(rod) }
    }

    /// Returns zero: every number carries its own bound.
    fn error_estimate(&self) -> N {
        self.end.zero()
    }
}
