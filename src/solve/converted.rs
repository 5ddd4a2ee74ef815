//! A history in one number system, read in another.

use std::sync::Arc;

use super::rays::Rays;
use crate::error::Error;
use crate::motion::moments::{self, Moments};
use crate::motion::{Course, Energy, Event, Field, Motion, Ray, Scales, Side, StressPiece, Stretch, Waves};
use crate::number::{Reads, Scalar};
use crate::problem::Problem;

/// The history of an engine in numbers `N`, read in numbers `M`.
#[derive(Debug)]
pub(super) struct Converted<N: Scalar, M> {
    engine: Arc<dyn Motion<N>>,
    precision: N::Precision,
    rays: Rays<N>,
    course: Course<M>,
}

impl<N: Scalar, M: Reads<N>> Converted<N, M> {
    pub(super) fn new(engine: Arc<dyn Motion<N>>, problem: &Problem) -> Self {
        Converted {
            precision: engine.end().precision(),
            rays: Rays::of(&*engine, problem),
            course: engine.course().clone().map(M::read),
            engine,
        }
    }

    /// A time of this history. One that an event, or the end, was rounded to is that event's own.
    fn time(&self, time: &M) -> Result<N, Error> {
        self.finite(time)?;
        Ok(self.known(time).unwrap_or_else(|| time.give(&self.precision)))
    }

    /// What is no number has none in another system that stands for it.
    fn finite(&self, time: &M) -> Result<(), Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.engine.end().text() };
        if time.is_finite() { Ok(()) } else { Err(outside()) }
    }

    fn known(&self, time: &M) -> Option<N> {
        let end = self.engine.end();
        let mut known = self.engine.events().iter().map(|event| &event.time).chain([&end]);
        // Both are rounded, each to its own bits.
        let same = |known: &&N| {
            let known = M::read((*known).clone());
            let rounding = time.magnitude() * (known.roundoff() + time.roundoff());
            rounding.below(&(known - time).magnitude()) == Ok(false)
        };
        let exactly = |known: &&N| M::read((*known).clone()).text() == time.text();
        known.clone().find(exactly).or_else(|| known.find(same)).cloned()
    }

    /// A point of this rod. The one that its length was rounded to is its top.
    fn point(&self, point: &M) -> Result<N, Error> {
        let length = self.engine.scales().length;
        if !point.is_finite() {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        Ok(if M::read(length.clone()).text() == point.text() { length } else { point.give(&self.precision) })
    }

    /// A time at which `point` is asked about: that of a ray there, where the roundings of `M` alone set it apart.
    fn time_at(&self, point: &N, time: &M) -> Result<N, Error> {
        self.finite(time)?;
        let roundings = 8.0 * time.log2_roundoff().exp2() * time.to_f64();
        Ok(self.known(time).unwrap_or_else(|| self.rays.meant(point, time.give(&self.precision), roundings)))
    }

    fn time_at_ground(&self, time: &M) -> Result<N, Error> {
        self.time_at(&self.engine.end().zero(), time)
    }

    fn pair(pair: (N, N)) -> (M, M) {
        (M::read(pair.0), M::read(pair.1))
    }
}

impl<N: Scalar, M: Reads<N>> Motion<M> for Converted<N, M> {
    fn course(&self) -> &Course<M> {
        &self.course
    }

    fn stress_pieces(&self) -> Vec<StressPiece<M>> {
        self.engine.stress_pieces().into_iter().map(|piece| piece.map(M::read)).collect()
    }

    fn strain(&self, time: &M, side: Side) -> Result<M, Error> {
        self.engine.strain(&self.time_at_ground(time)?, side).map(M::read)
    }

    fn ground_end(&self, time: &M, side: Side) -> Result<(M, M), Error> {
        self.engine.ground_end(&self.time_at_ground(time)?, side).map(Self::pair)
    }

    fn top_end(&self, time: &M, side: Side) -> Result<(M, M), Error> {
        self.engine.top_end(&self.time_at(&self.engine.scales().length, time)?, side).map(Self::pair)
    }

    fn centre(&self, time: &M) -> Result<(M, M), Error> {
        self.engine.centre(&self.time(time)?).map(Self::pair)
    }

    fn energy(&self, time: &M) -> Result<Energy<M>, Error> {
        self.engine.energy(&self.time(time)?).map(|energy| energy.map(M::read))
    }

    fn energy_parts(&self, time: &M) -> Result<[M; 2], Error> {
        self.engine.energy_parts(&self.time(time)?).map(|parts| parts.map(M::read))
    }

    fn field(&self, point: &M, time: &M, side: Side) -> Result<Field<M>, Error> {
        let point = self.point(point)?;
        let field = self.engine.field(&point, &self.time_at(&point, time)?, side)?;
        Ok(field.map(M::read))
    }

    fn highest(&self, release: &Event<M>) -> Option<(M, M)> {
        let time = release.time.text();
        let known =
            self.course.events.iter().position(|event| event.kind == release.kind && event.time.text() == time)?;
        self.engine.highest(self.engine.events().get(known)?).map(Self::pair)
    }

    fn rays(&self, trip: usize) -> Result<Vec<Ray<M>>, Error> {
        Ok(self.engine.rays(trip)?.into_iter().map(|ray| ray.map(M::read)).collect())
    }

    fn stretches(&self, time: &M) -> Result<Vec<Stretch<M>>, Error> {
        Ok(self.engine.stretches(&self.time(time)?)?.into_iter().map(|stretch| stretch.map(M::read)).collect())
    }

    fn moments(&self, time: &M, points: &[M]) -> Result<Vec<Moments<M>>, Error> {
        match self.stretches(time) {
            Err(Error::NoWaves) => {}
            stretches => return moments::of_stretches(&stretches?, points),
        }
        let points = points.iter().map(|point| self.point(point)).collect::<Result<Vec<N>, Error>>()?;
        let moments = self.engine.moments(&self.time(time)?, &points)?;
        Ok(moments.into_iter().map(|cell| cell.map(|pair| pair.map(M::read))).collect())
    }

    fn waves(&self) -> Result<Waves<M>, Error> {
        Ok(self.engine.waves()?.map(M::read))
    }

    fn scales(&self) -> Scales<M> {
        self.engine.scales().map(M::read)
    }

    fn error_estimate(&self) -> M {
        M::read(self.engine.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.engine.digits_lost()
    }
}
