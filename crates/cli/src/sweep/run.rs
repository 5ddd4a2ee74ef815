//! What is asked of the points of a sweep, and their answers, on all threads.

use rayon::prelude::*;
use std::ops::{ControlFlow, Range};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::output::{bound_json, number_json};
use crate::sweep::Grid;
use dalembert::Error;
use dalembert::engine::Motion;
use dalembert::number::{Number, Scalar, bound_of_log2, shown_bound};
use dalembert::problem::{Problem, ProblemError, Run};
use dalembert::quantity::{Needs, One, Quantity, UnitSystem, Units};
use dalembert::solve::{ExactnessEnd, Numbers, Plan, Question, Solution, Target, TypedHistory, Visitor, unobserved};

#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) quantities: Vec<Quantity>,
    /// For quantities at a time; at the first bounce without it.
    pub(crate) time: Option<Number>,
    pub(crate) numbers: Numbers,
    pub(crate) units: UnitSystem,
}

/// A point and its numbers, in the order of the quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Point {
    pub(crate) index: usize,
    pub(crate) cells: Vec<Cell>,
}

/// One number of a point of a sweep, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// As JSON has it: a number for a double, otherwise a text, or an enclosure; null where there is none.
    pub(crate) value: Value,
    pub(crate) uncertainty: Value,
    /// Why there is no value, or what a user should know of it: where exactness ends, and warnings of the history.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) note: Option<String>,
}

impl Cell {
    /// The number; `None` where there is none.
    pub fn value(&self) -> Option<f64> {
        self.value.as_f64().or_else(|| self.value.as_str()?.parse().ok())
    }

    /// How far it may be off; infinite where that is not known.
    pub fn bound(&self) -> f64 {
        let text = || self.uncertainty.as_str().and_then(|text| text.parse().ok());
        self.uncertainty.as_f64().or_else(text).unwrap_or(f64::INFINITY)
    }

    /// Why there is no number, or what a user should know of it.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    fn none(why: impl std::fmt::Display) -> Self {
        Cell { note: Some(why.to_string()), ..Cell::default() }
    }

    fn noted(self, note: String) -> Self {
        Cell { note: Some(self.note.map_or_else(|| note.clone(), |before| format!("{before}; {note}"))), ..self }
    }
}

impl Asked {
    /// The numbers of a problem. What cannot be answered is an answer too; quantities that the same run answers share
    /// it.
    fn cells_of(&self, problem: Result<Problem, ProblemError>) -> Vec<Cell> {
        let problem = match &problem {
            Ok(problem) => problem,
            Err(error) => return vec![Cell::none(error); self.quantities.len()],
        };
        let units = Units::of(problem, self.units);
        let mut runs: Vec<(Question, Result<Solution, String>)> = Vec::new();
        let mut cells = Vec::with_capacity(self.quantities.len());
        for quantity in &self.quantities {
            let time = self.time.clone().filter(|_| quantity.needs() == Needs::Time);
            let run = Question::of(*quantity, time.as_ref(), self.numbers);
            let known = runs.iter().position(|(other, _)| *other == run);
            let known = known.unwrap_or_else(|| {
                let solution = Plan::of(problem, &run).and_then(|plan| plan.solve_typed(problem, unobserved()));
                runs.push((run, solution.map_err(|error| error.to_string())));
                runs.len() - 1
            });
            cells.push(match &runs[known].1 {
                Ok(solution) => solution.visit(Found {
                    one: &One::new(*quantity, time),
                    units: &units,
                    run: &problem.run,
                    digits: solution.digits(),
                    exactness_end: solution.exactness_end(),
                }),
                Err(why) => Cell::none(why),
            });
        }
        cells
    }
}

struct Found<'a> {
    one: &'a One,
    units: &'a Units,
    run: &'a Run,
    digits: u32,
    exactness_end: Option<&'a ExactnessEnd>,
}

impl Visitor for Found<'_> {
    type Output = Cell;

    fn visit<S: Target>(self, history: &TypedHistory<S>) -> Cell {
        let digits = self.digits;
        let query = |motion: &dyn Motion<S::Carried>| self.one.of(motion, self.units, self.run);
        let found = history.ask(query, |found| found.iter().map(|[_, plain]| plain).collect());
        let cell = match found {
            Ok(Ok([value, _])) if !value.is_finite() => Cell::none("no finite number"),
            Ok(Ok([value, _])) => Cell {
                value: number_json(&value, digits),
                uncertainty: match bound_json(&value, digits) {
                    Value::Null => bound_of_log2(shown_bound(&value, digits)).into(),
                    bound => bound,
                },
                note: None,
            },
            Ok(Err(missing)) => Cell::none(missing.why),
            Err(error) => Cell::none(error),
        };
        let ends = self.exactness_end.map(|end| format!("{end}; the number is in {digits} digits"));
        let warnings = history.warnings().into_iter().map(|warning| warning.to_string());
        ends.into_iter().chain(warnings).fold(cell, Cell::noted)
    }
}

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
/// # use dalembert::{Numbers, Problem, Quantity};
/// # use dalembert_cli::sweep::sweep;
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
    (0..count)
        .into_par_iter()
        .map(|k| match go_on() {
            ControlFlow::Continue(()) => Ok(asked.cells_of(problem(k))),
            ControlFlow::Break(()) => Err(Error::Interrupted),
        })
        .collect::<Result<Vec<_>, _>>()
}

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

    /// All `points`, in order: those that are `known`, and the others, which `done` receives as they are finished; it
    /// may refuse to go on.
    pub(crate) fn run<E: Send>(
        &self,
        points: Range<usize>,
        known: Vec<Point>,
        done: &(dyn Fn(&Point) -> Result<(), E> + Sync),
    ) -> Result<Vec<Point>, E> {
        let mut have = vec![None; points.len()];
        for point in known.into_iter().filter(|point| points.contains(&point.index)) {
            let place = point.index - points.start;
            have[place] = Some(point);
        }
        (0..points.len())
            .into_par_iter()
            .map(|place| match &have[place] {
                Some(point) => Ok(point.clone()),
                None => {
                    let index = points.start + place;
                    let point = Point { index, cells: self.asked.cells_of(self.grid.problem(index)) };
                    done(&point).map(|()| point)
                }
            })
            .collect::<Result<Vec<_>, _>>()
    }
}
