//! All points of a sweep, on all threads.

use std::ops::{ControlFlow, Range};

use super::grid::Grid;
use super::point::{Asked, Cell, Point};
use crate::error::Error;
use crate::number::Number;
use crate::problem::{Problem, ProblemError};
use crate::quantity::{Quantity, UnitSystem, Units};
use crate::solve::Numbers;
use crate::threads::Threads;

/// The same numbers of many problems, on all cores: for each of `count` problems a cell for each quantity. Those that
/// need a time are taken at `time`, or at the end of the first contact; impulses and energies are per `ρS` where a
/// problem has no material. `go_on` is asked before each problem.
///
/// **Accuracy**: that of the numbers asked for, with the bound in each cell; the same for any number of cores.
///
/// **Errors**: [`Error::Interrupted`] where `go_on` breaks. A problem that is none, and a number that there is not,
/// has the reason in its cells.
///
/// ```
/// # use dalembert::{Numbers, Problem, Quantity, sweep};
/// # use std::ops::ControlFlow;
/// let rod = |k| Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(k as i64 + 2).build();
/// let asked = [Quantity::BounceTime, Quantity::EnergyRestitution];
/// let cells = sweep(3, &rod, &asked, None, Numbers::Double(None), &|| ControlFlow::Continue(()))?;
/// assert_eq!(cells[1][0].value(), Some(2.0));
/// # Ok::<(), dalembert::Error>(())
/// ```
pub fn sweep(
    count: usize,
    problem: &(dyn Fn(usize) -> Result<Problem, ProblemError> + Sync),
    quantities: &[Quantity],
    time: Option<&Number>,
    numbers: Numbers,
    go_on: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<Vec<Vec<Cell>>, Error> {
    let (quantities, units) = (quantities.to_vec(), UnitSystem::default());
    let asked = Asked { quantities, time: time.cloned(), numbers, units };
    Threads::default().all(count, |k| match go_on() {
        ControlFlow::Continue(()) => Ok(asked.cells_of(problem(k))),
        ControlFlow::Break(()) => Err(Error::Interrupted),
    })
}

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
