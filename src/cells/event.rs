//! What an event does to the state, and to the bound of its error.

use super::budget::{Landing, Off};
use super::follow::Follower;
use super::piece::{Mark, Unresolved};
use super::series::at_zero;
use crate::motion::EventKind;
use crate::reason::Warning;
use crate::special::RoundedSpecial;

/// Where times are in doubt by more than this part of a round trip, so are the events.
const MOST_LATE: f64 = 0.01;

impl<S: RoundedSpecial> Follower<'_, S> {
    /// Turns contact into flight or back, now. A release at a root of the trace has velocity zero. Where the end
    /// only touches the ground and a ray arrives at that very time, the velocity is the one that the ray brings.
    pub(super) fn event(&mut self, off: Off, at_root: bool) {
        let zero = self.height.zero();
        let kind = if self.contact { EventKind::Release } else { EventKind::Impact };
        let velocity = match (&self.last_trace, kind) {
            (Some(last), EventKind::Impact) if last.to_f64() < -self.noise() => last.clone(),
            (_, EventKind::Release) if at_root => zero.clone(),
            _ => at_zero(&self.held_trace(), &zero),
        };
        let time = self.state.time();
        let apart = self.medium.splits();
        if self.budget.lost(off, apart, MOST_LATE) && !self.lost {
            self.lost = true;
            let from = (time.clone() * &self.data.units.time).to_f64();
            self.warnings.push(Warning::EventsOverlap { from });
        }
        self.height = zero;
        // A ray of the start is off by no more than the roundings of t₁ and of its own time.
        let rounding = 4.0 * time.log2_roundoff().exp2() * (1.0 + time.to_f64());
        let time_error = self.budget.time(off, apart).max(rounding);
        let time_error = if self.lost { f64::INFINITY } else { time_error };
        self.marks.push(Mark { kind, time, velocity: velocity.clone(), time_error });
        if self.contact {
            self.contact = false;
            self.let_go(&velocity, off);
        } else {
            self.touch_down(&velocity, off);
            self.contact = true;
            self.weigh();
        }
    }

    /// The ground lets go, with this velocity: p goes over from −q to q, too early or too late by what the time is off.
    pub(super) fn let_go(&mut self, velocity: &S, off: Off) {
        self.budget.let_go(velocity.to_f64().abs(), off, self.cell_error);
        self.take_off();
    }

    /// The ground is hit. What is off in time is the ray that starts; or, in a flight that is taken apart, where the
    /// motion is compared with the true one at equal times since the impact, all the rest of the motion.
    fn touch_down(&mut self, velocity: &S, off: Off) {
        let speed = velocity.to_f64().abs();
        self.landing = Some((self.state.round, self.state.segments[0].at.clone()));
        self.compare_rays(speed, off);
        let (Some(flight), Some((_, rate))) = (self.flying().cloned(), self.centre()) else {
            self.budget.hit(self.damping(), speed, off);
            return;
        };
        self.budget.hit(self.damping(), speed, off);
        let (slope, range) = self.medium.variation(&self.state);
        let damping = self.damping();
        let age = flight.age((self.state.round, &self.state.segments[0].at)).to_f64();
        let (kept, slowed) = slowed(damping, age);
        let fall = -self.medium.gravity.to_f64() - 2.0 * damping * rate.to_f64();
        self.budget.land(&Landing { speed, off, kept, slowed, fall, range, slope });
        for segment in &mut self.state.segments {
            segment.off.moving += off.moving;
        }
        self.state.segments[0].off.moving = 0.0;
        self.medium.touch_down(&mut self.state, &flight);
        self.flight = None;
    }

    /// Counts a landing that the bound does not tell apart from a ray that passes: between the two the end may rise for
    /// as long, now or whenever both return. A landing without speed starts no ray.
    fn compare_rays(&mut self, speed: f64, off: Off) {
        let off = self.budget.better(off, self.medium.splits());
        let segments = &self.state.segments;
        let last = &segments[segments.len() - 1];
        // The ray of the release itself does not count.
        let own = self.flying().is_some_and(|flight| segments[segments.len() - 1].at == flight.from.1);
        let near = segments[0].len.to_f64() < off || (last.len.to_f64() < off && !own);
        let speeds = (self.medium.gravity.to_f64() + self.noise()) * off;
        if speed > speeds && (near || self.at_ray) {
            let from = self.unresolved.as_ref().map_or_else(|| self.state.time(), |unresolved| unresolved.from.clone());
            let (count, longest) = self.unresolved.as_ref().map_or((0, 0.0), |old| (old.count, old.longest));
            self.unresolved = Some(Unresolved { from, count: count + 1, longest: longest.max(off) });
        }
    }
}

/// `e^{−2Rτ}` and `(1 − e^{−2Rτ})/2R`.
pub(super) fn slowed(damping: f64, age: f64) -> (f64, f64) {
    let fall = -2.0 * damping * age;
    (fall.exp(), crate::special::phi1(&fall) * age)
}
