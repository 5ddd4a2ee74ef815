//! A proved damped run, read in enclosures.

use std::sync::Arc;

use super::converted::Converted;
use crate::cells::Damped;
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Course, EventKind, Field, Motion, Pair, Scales, Side, StressPiece};
use crate::number::{Ball, Estimate, Interval, Reads, Scalar};

/// A proved run. A time within what an event, or a ray that it has sent out, may be off is told from it by more bits.
#[derive(Debug)]
pub(super) struct Proved {
    read: Converted<Estimate<Ball>, Interval>,
    /// When rays leave the ground.
    rays: Vec<Interval>,
    scales: Scales<Interval>,
}

impl Proved {
    pub(super) fn new(run: Damped<Ball>) -> Self {
        let scales = Motion::scales(&run).map(Interval::read);
        let corners = Motion::corners(&run).into_iter().map(Interval::read);
        let mut rays = Vec::new();
        for corner in corners {
            let travel = corner / &scales.wave_speed;
            rays.extend([travel.clone(), -travel]);
        }
        let read = Converted::new(Arc::new(run) as Arc<dyn Motion<Estimate<Ball>>>);
        let course: &Course<Interval> = read.course();
        rays.extend(course.events.iter().map(|event| event.time.clone()));
        Proved { rays, scales, read }
    }

    /// Whether a time is that of an event, as it is stored.
    fn is_event(&self, time: &Interval) -> bool {
        let same = |event: &Interval| event.lo() == time.lo() && event.hi() == time.hi();
        self.read.course().events.iter().any(|event| same(&event.time)) || same(&self.read.course().end)
    }

    /// **Errors**: [`Error::NotDecided`] where it is open on which side of an event the time lies.
    fn told(&self, time: &Interval) -> Result<(), Error> {
        let open = |event: &Interval| event.lo() <= time.hi() && event.hi() >= time.lo();
        let events = self
            .read
            .course()
            .events
            .iter()
            .filter(|event| event.kind == EventKind::Release || event.time.lo() != event.time.hi());
        if !self.is_event(time) && events.map(|event| &event.time).any(open) {
            return Err(Error::not_decided("on which side of an event the time lies", time.bits()));
        }
        Ok(())
    }

    /// **Errors**: [`Error::NotDecided`] where it is open on which side of a ray the point lies.
    fn told_at(&self, point: &Interval, time: &Interval) -> Result<(), Error> {
        self.told(time)?;
        let travel = point.clone() / &self.scales.wave_speed;
        let trip = &self.scales.time;
        let at_ground = point.vanishes() == Ok(true) && self.is_event(time);
        for ray in self.rays.iter().filter(|_| !at_ground) {
            for arrives in [time.clone() + &travel, time.clone() - &travel] {
                let since = (arrives - ray) / trip;
                let nearest = (since.clone() + since.ratio(1, 2)).floor_int();
                // The engine takes what is within some roundings of a ray for the ray.
                let off = nearest.map(|k| since.clone() - since.int(k));
                let slack = (since.magnitude() + since.one()) * since.roundoff() * since.int(64);
                let near =
                    off.is_none_or(|off| off.vanishes() != Ok(true) && slack.below(&off.magnitude()) != Ok(true));
                if near && since.negative() != Ok(true) {
                    return Err(Error::not_decided("on which side of a ray the point lies", time.bits()));
                }
            }
        }
        Ok(())
    }
}

impl Motion<Interval> for Proved {
    fn course(&self) -> &Course<Interval> {
        self.read.course()
    }

    fn scales(&self) -> Scales<Interval> {
        self.scales.clone()
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Interval>> {
        self.read.stress_pieces()
    }

    fn strain(&self, time: &Interval, side: Side) -> Result<Interval, Error> {
        self.told_at(&time.zero(), time)?;
        self.read.strain(time, side)
    }

    fn pair(&self, pair: Pair, time: &Interval, side: Side) -> Result<[Interval; 2], Error> {
        match pair {
            Pair::GroundEnd => self.told_at(&time.zero(), time)?,
            _ => self.told(time)?,
        }
        self.read.pair(pair, time, side)
    }

    fn field(&self, point: &Interval, time: &Interval, side: Side) -> Result<Field<Interval>, Error> {
        self.told_at(point, time)?;
        self.read.field(point, time, side)
    }

    /// **Errors**: [`Error::NotCertified`]: what the rule leaves of a mean is not enclosed.
    fn moments(&self, _: &Interval, _: &[Interval]) -> Result<Vec<Moments<Interval>>, Error> {
        Err(Error::NotCertified)
    }

    fn corners(&self) -> Vec<Interval> {
        self.read.corners()
    }

    fn highest(&self, release: usize) -> Option<(Interval, Interval)> {
        self.read.highest(release)
    }

    fn error_estimate(&self) -> Interval {
        self.read.error_estimate()
    }
}
