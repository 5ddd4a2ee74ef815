//! Answers in long numbers from a motion in numbers of fixed limbs.

use std::sync::OnceLock;

use super::forwarded::forwarded;
use super::ladder::Engined;
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Course, Field, Motion, Pair, Scales, Side, Stretch};
use crate::number::{Estimate, Float, Reads, Wide};

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

impl<const N: usize> Motion<Long> for InFloats<N> {
    forwarded!(Long, read);

    fn course(&self) -> &Course<Long> {
        self.course.get_or_init(|| self.engine.course().clone().map(read))
    }

    fn scales(&self) -> Scales<Long> {
        self.engine.scales().map(read)
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

    fn stretches(&self, time: &Long) -> Result<Vec<Stretch<Long>>, Error> {
        Ok(self.engine.stretches(&give(time))?.into_iter().map(|stretch| stretch.map(read)).collect())
    }

    fn moments(&self, time: &Long, points: &[Long]) -> Result<Vec<Moments<Long>>, Error> {
        let cells = self.engine.moments(&give(time), &points.iter().map(give).collect::<Vec<_>>())?;
        Ok(cells.into_iter().map(|cell| cell.map(|both| both.map(read))).collect())
    }

    fn may_jump(&self, time: &Long) -> Result<bool, Error> {
        self.engine.may_jump(&give(time))
    }
}
