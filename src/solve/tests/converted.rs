use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::motion::Ending;
use crate::number::{Estimate, Float};

type Long = Estimate<Float>;

/// An engine that counts its grids, and answers nothing else.
#[derive(Debug)]
struct Grids(Course<Long>, AtomicUsize);

impl Motion<Long> for Grids {
    fn course(&self) -> &Course<Long> {
        &self.0
    }
    fn scales(&self) -> Scales<Long> {
        let one = || self.0.end.one();
        Scales { time: one(), velocity: one(), length: one(), wave_speed: one(), gravity: one() }
    }
    fn stress_pieces(&self) -> Vec<StressPiece<Long>> {
        Vec::new()
    }
    fn strain(&self, _: &Long, _: Side) -> Result<Long, Error> {
        Err(Error::NoWaves)
    }
    fn pair(&self, _: Pair, _: &Long, _: Side) -> Result<[Long; 2], Error> {
        Err(Error::NoWaves)
    }
    fn field(&self, _: &Long, _: &Long, _: Side) -> Result<Field<Long>, Error> {
        Err(Error::NoWaves)
    }
    fn rates(&self, points: &[Long], times: &[Long]) -> Result<Vec<[Long; 2]>, Error> {
        self.1.fetch_add(1, Ordering::Relaxed);
        Ok(times.iter().flat_map(|t| points.iter().map(|x| [x.clone(), t.clone()])).collect())
    }
    fn highest(&self, _: usize) -> Option<(Long, Long)> {
        None
    }
    fn error_estimate(&self) -> Long {
        self.0.end.zero()
    }
}

/// A grid in longer numbers is marched once.
#[test]
fn a_grid_is_asked_of_the_engine_as_a_whole() {
    let end = Estimate::exact(Float::with_val(128, 2));
    let engine = Arc::new(Grids(Course::new(end, Ending::Time), AtomicUsize::new(0)));
    let read = Converted::<_, Estimate<f64>>::new(engine.clone());
    let grid = [0.0, 0.25, 0.5].map(Estimate::exact);
    assert_eq!(read.rates(&grid, &grid).unwrap().len(), 9);
    assert_eq!(engine.1.load(Ordering::Relaxed), 1);
}
