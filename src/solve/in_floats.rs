//! Answers in long numbers from a motion in numbers of fixed limbs.

use std::sync::OnceLock;

use super::ladder::Engined;
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Course, Ending, Field, Motion, Pair, Ray, Scales, Side, StressPiece, Stretch, Waves};
use crate::number::{Estimate, Float, Reads, Wide};
use crate::reason::Warning;

type Long = Estimate<Float>;

/// A motion in numbers of `N` limbs, converted to [`Float`]s of as many bits.
///
/// **Accuracy**: *exact* in both directions for times and points of as many bits, bounds included. Each answer is
/// therefore that of the motion itself.
struct InFloats<const N: usize> {
    engine: Engined<Wide<N>>,
    course: OnceLock<Course<Long>>,
}

/// Wraps the motion with times, points and answers as [`Float`]s.
pub(super) fn in_floats<const N: usize>(engine: Engined<Wide<N>>) -> Engined<Float> {
    std::sync::Arc::new(InFloats { engine, course: OnceLock::new() })
}

fn read<const N: usize>(number: Estimate<Wide<N>>) -> Long {
    Reads::read(number)
}

fn give<const N: usize>(number: &Long) -> Estimate<Wide<N>> {
    Reads::give(number, &())
}

fn give_all<const N: usize>(numbers: &[Long]) -> Vec<Estimate<Wide<N>>> {
    numbers.iter().map(give).collect()
}

impl<const N: usize> Motion<Long> for InFloats<N> {
    fn course(&self) -> &Course<Long> {
        self.course.get_or_init(|| self.engine.course().clone().map(read))
    }

    fn end(&self) -> Long {
        read(self.engine.end())
    }

    fn ending(&self) -> &Ending {
        self.engine.ending()
    }

    fn warnings(&self) -> &[Warning] {
        self.engine.warnings()
    }

    fn contact_times(&self, contact: usize) -> Option<(Long, Option<Long>)> {
        self.engine.contact_times(contact).map(|(impact, release)| (read(impact), release.map(read)))
    }

    fn impulse(&self, contact: usize) -> Option<Long> {
        self.engine.impulse(contact).map(read)
    }

    fn scales(&self) -> Scales<Long> {
        self.engine.scales().map(read)
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Long>> {
        self.engine.stress_pieces().into_iter().map(|piece| piece.map(read)).collect()
    }

    fn strain(&self, time: &Long, side: Side) -> Result<Long, Error> {
        self.engine.strain(&give(time), side).map(read)
    }

    fn pair(&self, pair: Pair, time: &Long, side: Side) -> Result<[Long; 2], Error> {
        self.engine.pair(pair, &give(time), side).map(|pair| pair.map(read))
    }

    fn field(&self, point: &Long, time: &Long, side: Side) -> Result<Field<Long>, Error> {
        self.engine.field(&give(point), &give(time), side).map(|field| field.map(read))
    }

    fn in_contact(&self, time: &Long, side: Side) -> Result<Long, Error> {
        self.engine.in_contact(&give(time), side).map(read)
    }

    fn rates(&self, places: &[(Long, Long)]) -> Result<Vec<[Long; 2]>, Error> {
        let places: Vec<_> = places.iter().map(|(point, time)| (give(point), give(time))).collect();
        let rates = self.engine.rates(&places)?;
        Ok(rates.into_iter().map(|pair| pair.map(read)).collect())
    }

    fn highest(&self, release: usize) -> Option<(Long, Long)> {
        self.engine.highest(release).map(|(time, height)| (read(time), read(height)))
    }

    fn rays(&self, trip: usize) -> Result<Vec<Ray<Long>>, Error> {
        Ok(self.engine.rays(trip)?.into_iter().map(|ray| ray.map(read)).collect())
    }

    fn stretches(&self, time: &Long) -> Result<Vec<Stretch<Long>>, Error> {
        Ok(self.engine.stretches(&give(time))?.into_iter().map(|stretch| stretch.map(read)).collect())
    }

    fn departures(&self) -> Result<[Vec<(Long, Long)>; 2], Error> {
        let read = |(time, jump): (Estimate<Wide<N>>, Estimate<Wide<N>>)| (read(time), read(jump));
        Ok(self.engine.departures()?.map(|rays| rays.into_iter().map(read).collect()))
    }

    fn corners(&self) -> Vec<Long> {
        self.engine.corners().into_iter().map(read).collect()
    }

    fn moments(&self, time: &Long, points: &[Long]) -> Result<Vec<Moments<Long>>, Error> {
        let cells = self.engine.moments(&give(time), &give_all(points))?;
        Ok(cells.into_iter().map(|cell| cell.map(|both| both.map(read))).collect())
    }

    fn may_jump(&self, time: &Long) -> Result<bool, Error> {
        self.engine.may_jump(&give(time))
    }

    fn waves(&self) -> Result<Waves<Long>, Error> {
        Ok(self.engine.waves()?.map(read))
    }

    fn error_estimate(&self) -> Long {
        read(self.engine.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.engine.digits_lost()
    }
}
