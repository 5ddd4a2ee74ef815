//! Events and contacts of an undamped history, in the units of the scene.

use super::history::{Centre, Moment, Undamped};
use super::start::Units;
use super::trace::{GroundEvent, Place};
use crate::error::Error;
use crate::motion::{Contact, Event, EventKind};
use crate::number::{Bounded, Open};
use crate::problem::Top;

impl<N: Bounded> Undamped<N> {
    pub(super) fn in_scene_units(&self) -> Result<Vec<Event<N>>, Error> {
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let rise = velocity.clone() * round_trip;
        let mut events: Vec<Event<N>> = Vec::with_capacity(self.ground.events.len());
        let mut last: Option<(&GroundEvent<N>, Centre<N>)> = None;
        for event in &self.ground.events {
            let centre = match last {
                Some((before, centre)) if before.trip == event.trip && self.problem.top == Top::Free => {
                    self.centre_later(before, centre, event)
                }
                _ => self.centre_at_event(event)?,
            };
            let time = self.time_of(&Moment { index: event.trip + 1, age: event.age.clone() });
            events.push(Event {
                kind: event.kind,
                time_error: time.log2_error().exp2(),
                time,
                end_velocity: event.end_velocity.clone() * velocity,
                centre: centre.height.clone() * &rise,
                centre_velocity: centre.rate.clone() * velocity,
            });
            last = Some((event, centre));
        }
        Ok(events)
    }

    /// The place of an event, and from the left.
    fn places(&self, event: &GroundEvent<N>) -> [Place<N>; 2] {
        let (index, piece, age) = (event.trip + 1, event.piece, event.age.clone());
        let before = self.ground.trace.place_before(index, piece, &age);
        [Place { index, piece, age }, before]
    }

    fn centre_at_event(&self, event: &GroundEvent<N>) -> Result<Centre<N>, Open> {
        let a_trip_before = Place { index: event.trip, piece: event.incoming, age: event.age.clone() };
        let [_, until] = self.places(event);
        self.centre_at(&[a_trip_before, until])
    }

    /// The centre at the next event of the same round trip: under a free top `h″ = −(c²/L) v_x(0,t) − g`. Started
    /// afresh in every round trip, this costs a piece once and adds no more than one trip's roundings.
    fn centre_later(&self, before: &GroundEvent<N>, centre: Centre<N>, event: &GroundEvent<N>) -> Centre<N> {
        let width = event.age.clone() - &before.age;
        let fall = self.problem.gravity.clone() * &width;
        let (mut push, mut lift) = (width.zero(), width.zero());
        if before.kind == EventKind::Impact {
            let ([from, _], [_, until]) = (self.places(before), self.places(event));
            self.ground.trace.window(&from, &until, &mut |part| {
                let first = part.integral();
                lift = lift.clone() + (width.clone() - &part.offset) * &first - part.moment();
                push = push.clone() + first;
            });
        }
        let height = centre.height + (centre.rate.clone() - fall.clone().halved()) * &width + lift.doubled();
        Centre { height, rate: centre.rate + push.doubled() - fall }
    }

    pub(super) fn summed_contacts(&self) -> Vec<Contact<N>> {
        let Units { length, velocity, wave_speed, .. } = &self.problem.units;
        Contact::between(&self.course.events, |k| {
            let [from, _] = self.places(&self.ground.events[k]);
            let until = match self.ground.events.get(k + 1) {
                Some(release) => self.places(release)[1].clone(),
                None => {
                    let Moment { index, age } = self.end.clone();
                    Place { index, piece: self.ground.trace.slice(index).len() - 1, age }
                }
            };
            let (mut sum, mut peak) = (from.age.zero(), from.age.zero());
            self.ground.trace.window(&from, &until, &mut |part| {
                sum = sum.clone() + part.integral();
                peak = part.ends().into_iter().fold(peak.clone(), N::larger);
            });
            (sum.doubled() * length * velocity, -(peak * velocity / wave_speed))
        })
    }
}
