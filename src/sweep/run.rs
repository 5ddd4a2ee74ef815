//! All points of a sweep, on all threads.

use std::ops::Range;

use super::grid::Grid;
use super::point::{Asked, Point};
use crate::quantity::{Quantity, Units};
use crate::threads::Threads;

/// A sweep: what is varied, and what is asked.
#[derive(Debug)]
pub(crate) struct Sweep {
    pub(crate) grid: Grid,
    pub(crate) asked: Asked,
}

impl Sweep {
    /// The quantities with their units, which are the same at every point.
    pub(crate) fn units(&self) -> impl Iterator<Item = (Quantity, &'static str)> {
        let problem = (0..self.grid.len()).find_map(|index| self.grid.problem(index).ok());
        let units = problem.map_or_else(Units::default, |problem| Units::of(&problem, self.asked.units));
        self.asked.quantities.iter().map(move |quantity| (*quantity, quantity.unit(&units)))
    }

    /// All `points` that are not `known`, and those that are, in order. `done` receives each as it is
    /// finished and may refuse to go on.
    ///
    /// **Accuracy**: that of the numbers asked for. The same for any number of threads.
    pub(crate) fn run<E: Send>(
        &self,
        points: Range<usize>,
        known: Vec<Point>,
        threads: Threads,
        done: &(dyn Fn(&Point) -> Result<(), E> + Sync),
    ) -> Result<Vec<Point>, E> {
        let mut have = vec![None; points.len()];
        for point in known.into_iter().filter(|point| points.contains(&point.index)) {
            let place = point.index - points.start;
            have[place] = Some(point);
        }
        threads.all(points.len(), |place| match &have[place] {
            Some(point) => Ok(point.clone()),
            None => {
                let point = self.asked.answer(&self.grid, points.start + place);
                done(&point).map(|()| point)
            }
        })
    }
}
