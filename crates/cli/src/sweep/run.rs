//! The numbers of the points of a sweep, computed on all threads.

use rayon::prelude::*;
use std::ops::{ControlFlow, Range};

use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

use crate::sweep::Grid;
use dalembert::chain::{Chain, ChainHistory, ChainQuery};
use dalembert::number::Number;
use dalembert::problem::{Problem, ProblemError};
use dalembert::quantity::{Missing, Needs, Quantity, UnitSystem, Units, ValueQuery};
use dalembert::solve::{History, Numbers, Question, unobserved};
use dalembert::{ChainScene, Error, Side, Value};

/// The numbers and the time that every point is asked for.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// Time of the quantities over time; `None` for the first bounce of a rod, and the end of the run of a chain.
    pub(crate) time: Option<Number>,
    pub(crate) numbers: Numbers,
}

/// A point with its numbers, in the order of the quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Point {
    pub(crate) index: usize,
    pub(crate) numbers: Vec<PointNumber>,
}

/// One number of a point of a sweep, or the reason why it does not exist.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointNumber {
    /// The number as JSON has it; null without one.
    pub(crate) value: Json,
    /// Bound of the error.
    pub(crate) uncertainty: Json,
    /// The reason why there is no number, or the end of exactness and the warnings of the history.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) note: Option<String>,
}

impl PointNumber {
    /// Returns the number, if there is one.
    pub fn value(&self) -> Option<f64> {
        self.value.as_f64().or_else(|| self.value.as_str()?.parse().ok())
    }

    /// Returns the bound of the error; infinity if it is not known.
    pub fn bound(&self) -> f64 {
        let text = || self.uncertainty.as_str().and_then(|text| text.parse().ok());
        self.uncertainty.as_f64().or_else(text).unwrap_or(f64::INFINITY)
    }

    /// Returns the reason why there is no number, or notes on it.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    fn missing(why: impl std::fmt::Display) -> Self {
        PointNumber { note: Some(why.to_string()), ..PointNumber::default() }
    }

    /// Returns the number of a history.
    fn new(history: &History, query: &ValueQuery) -> Self {
        let digits = history.digits();
        let end = history.exactness_end().map(|end| format!("{end}; the number is in {digits} digits"));
        let notes = end.into_iter().chain(history.warnings().into_iter().map(|warning| warning.to_string()));
        PointNumber::noted(history.query(query), notes)
    }

    /// Returns the number of the history of a chain, at a time where the query is for a quantity over time.
    fn of_chain(history: &ChainHistory, query: ChainQuery, time: Option<&Number>) -> Self {
        let value = match query {
            ChainQuery::Column(column) => {
                let last = history.chain().until();
                history.value(column, time.unwrap_or(last), Side::Right)
            }
            ChainQuery::Contact(node, quantity) => match history.contact_value(node, quantity, 0) {
                Err(Error::NoContact { .. }) => return PointNumber::missing("no contact up to the end of the run"),
                value => value,
            },
        };
        PointNumber::noted(value.map(Ok), history.warnings().iter().map(ToString::to_string))
    }

    /// Returns a number with notes on it.
    fn noted(found: Result<Result<Value, Missing>, Error>, notes: impl Iterator<Item = String>) -> Self {
        let number = match found {
            Ok(Ok(value)) if !value.is_finite() => PointNumber::missing("no finite number"),
            Ok(Ok(value)) => {
                // An enclosure has its bound in itself, and here as a text too.
                let uncertainty =
                    if value.ends().is_some() { value.bound().to_string().into() } else { json!(value.bound()) };
                PointNumber { value: json!(value), uncertainty, note: None }
            }
            Ok(Err(missing)) => PointNumber::missing(missing.why),
            Err(error) => PointNumber::missing(error),
        };
        let notes: Vec<String> = number.note.iter().cloned().chain(notes).collect();
        PointNumber { note: (!notes.is_empty()).then(|| notes.join("; ")), ..number }
    }
}

impl Request {
    /// Returns the numbers of a problem, or the reasons why they do not exist. Quantities that the same run answers
    /// share it.
    fn of_rod(
        &self,
        problem: Result<Problem, ProblemError>,
        quantities: &[Quantity],
        units: UnitSystem,
    ) -> Vec<PointNumber> {
        let problem = match &problem {
            Ok(problem) => problem,
            Err(error) => return vec![PointNumber::missing(error); quantities.len()],
        };
        let mut runs: Vec<(Question, Result<History, Error>)> = Vec::new();
        let mut numbers = Vec::with_capacity(quantities.len());
        for quantity in quantities {
            let time = self.time.clone().filter(|_| quantity.needs() == Needs::Time);
            let question = Question::of(*quantity, time.as_ref(), self.numbers);
            let known = runs.iter().position(|(other, _)| *other == question);
            let known = known.unwrap_or_else(|| {
                let history = problem.ask(&question, unobserved()).map(|history| history.in_units(units));
                runs.push((question, history));
                runs.len() - 1
            });
            numbers.push(match &runs[known].1 {
                Ok(history) => PointNumber::new(history, &ValueQuery::new(*quantity, time)),
                Err(error) => PointNumber::missing(error),
            });
        }
        numbers
    }

    /// Returns the numbers of a chain, or the reasons why they do not exist.
    fn of_chain(&self, chain: Result<Chain, ProblemError>, quantities: &[(String, ChainQuery)]) -> Vec<PointNumber> {
        // The run goes to the time, or to its own end if that is later and a contact is asked about.
        let is_over_time = |(_, query): &(_, ChainQuery)| matches!(query, ChainQuery::Column(_));
        let are_over_time = quantities.iter().all(is_over_time);
        let run_to = |chain: Chain| match &self.time {
            Some(time) if are_over_time || time.compare(chain.until()).is_gt() => chain.reaching(time),
            _ => Ok(chain),
        };
        match chain.and_then(run_to).map_err(Error::from).and_then(|chain| chain.solve(self.numbers)) {
            Ok(history) => {
                let number = |(_, query): &(_, ChainQuery)| PointNumber::of_chain(&history, *query, self.time.as_ref());
                quantities.iter().map(number).collect()
            }
            Err(error) => vec![PointNumber::missing(error); quantities.len()],
        }
    }
}

/// Returns the numbers of many problems, computed on all cores: for each of `count` problems one for each quantity.
/// Quantities over time are taken at `time`, or at the end of the first contact; impulses and energies are per `ρS`
/// where a problem has no material. `go_on` is asked before each problem.
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
) -> Result<Vec<Vec<PointNumber>>, Error> {
    let request = Request { time: time.cloned(), numbers };
    (0..count)
        .into_par_iter()
        .map(|k| match go_on() {
            ControlFlow::Continue(()) => Ok(request.of_rod(problem(k), quantities, UnitSystem::default())),
            ControlFlow::Break(()) => Err(Error::Interrupted),
        })
        .collect::<Result<Vec<_>, _>>()
}

/// A time that a sweep does not take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TimeRefused {
    /// A time before the start.
    #[error("found time {0}, expected one from 0 on")]
    Negative(Number),
    /// A time beside a quantity that is not asked at a time.
    #[error("found time {time}, expected none: {quantity} is not asked at a time")]
    NotAsked {
        /// The time.
        time: Number,
        /// The first such quantity.
        quantity: Quantity,
    },
}

/// Checks the time of quantities.
///
/// **Errors**: [`TimeRefused`].
///
/// ```
/// use dalembert::Quantity;
/// use dalembert_cli::sweep::{TimeRefused, check_time};
/// assert_eq!(check_time(&[Quantity::Centre], Some(&1.into())), Ok(()));
/// assert_eq!(check_time(&[Quantity::Centre], Some(&(-1).into())), Err(TimeRefused::Negative((-1).into())));
/// assert!(check_time(&[Quantity::BounceTime], Some(&1.into())).is_err());
/// ```
pub fn check_time(quantities: &[Quantity], time: Option<&Number>) -> Result<(), TimeRefused> {
    let Some(time) = time.cloned() else { return Ok(()) };
    if time.to_f64() < 0.0 {
        return Err(TimeRefused::Negative(time));
    }
    match quantities.iter().copied().find(|quantity| quantity.needs() != Needs::Time) {
        Some(quantity) => Err(TimeRefused::NotAsked { time, quantity }),
        None => Ok(()),
    }
}

/// The subject of a sweep, with the quantities that each point is asked for.
#[derive(Debug)]
pub(crate) enum Subject {
    /// A rod by itself, or a body of a chain.
    Rod { start: Box<Problem>, units: UnitSystem, quantities: Vec<Quantity> },
    /// A whole chain, with the names of its quantities.
    Chain { scene: Box<ChainScene>, quantities: Vec<(String, ChainQuery)> },
}

/// A grid of values, and the numbers that are asked for at each of its points.
#[derive(Debug)]
pub(crate) struct Sweep {
    pub(crate) grid: Grid,
    pub(crate) subject: Subject,
    pub(crate) request: Request,
}

impl Sweep {
    /// Returns the names of the quantities with their units, which are the same at every point.
    pub(crate) fn units(&self) -> Vec<(String, &'static str)> {
        match &self.subject {
            Subject::Rod { start, units, quantities } => {
                let problem = (0..self.grid.len()).find_map(|index| self.grid.problem(start, index).ok());
                let units = problem.map_or_else(Units::default, |problem| Units::new(&problem, *units));
                let unit = |quantity: &Quantity| (quantity.name().to_string(), quantity.unit(&units));
                quantities.iter().map(unit).collect()
            }
            Subject::Chain { scene, quantities } => {
                let unit = |(name, query): &(String, ChainQuery)| (name.clone(), scene.unit(query.measure()));
                quantities.iter().map(unit).collect()
            }
        }
    }

    fn numbers_of(&self, index: usize) -> Vec<PointNumber> {
        match &self.subject {
            Subject::Rod { start, units, quantities } => {
                self.request.of_rod(self.grid.problem(start, index), quantities, *units)
            }
            Subject::Chain { scene, quantities } => {
                let values = self.grid.values(index).into_iter().map(|(parameter, value)| (parameter, value.clone()));
                self.request.of_chain(scene.chain.with_values(values), quantities)
            }
        }
    }

    /// Solves `points` and returns all of them in order. Points that are `known` are not solved again; `done` receives
    /// every other point as it is finished, and may refuse to go on.
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
                    let point = Point { index, numbers: self.numbers_of(index) };
                    done(&point).map(|()| point)
                }
            })
            .collect::<Result<Vec<_>, _>>()
    }
}
