//! Chains and their histories.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use dalembert::chain::{ChainColumn, ChainContact, ChainEvent, ChainNumbers, ChainTime};
use dalembert::quantity::{Measure, SLICE};
use dalembert::{ChainScene, Error, Number, Numbers, Parameter, Side, UnknownName, Value};
use pyo3::prelude::*;

use super::argument::{Given, names, number, one_of, refuse, typed};
use super::history::{Cell, Column, Described, Listed, parameter, side_of, sides, system};
use super::problem::numbers;
use super::{observer, run};

/// A body of a chain.
#[derive(IntoPyObject)]
struct BodyFacts {
    name: Option<String>,
    length: String,
    /// Mass of a rigid body.
    mass: Option<String>,
}

/// Bodies, values and quantities of a chain.
#[derive(IntoPyObject)]
struct ChainFacts {
    title: Option<String>,
    bodies: Vec<BodyFacts>,
    values: Vec<(String, String)>,
    quantities: Vec<Described>,
}

/// A chain, with the accuracy, the title and the units of its scene.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Chain {
    scene: Arc<ChainScene>,
}

/// Times and points are in the units of the scene.
fn described(scene: &ChainScene) -> Vec<Described> {
    let chain = &scene.chain;
    let time = Described { name: "t".into(), unit: scene.unit(Measure::Time), meaning: "time".into() };
    let columns = ChainColumn::all(chain).into_iter().map(|column| Described {
        name: column.name(chain),
        unit: scene.unit(column.quantity.measure()),
        meaning: column.meaning(chain),
    });
    [time].into_iter().chain(columns).collect()
}

#[pymethods]
impl Chain {
    /// Reads a chain from its text, and replaces values by name.
    #[new]
    fn new(text: &str, replaced: Vec<(String, Bound<'_, PyAny>)>) -> PyResult<Self> {
        let mut scene = match ChainScene::parse(text) {
            // The error of a text that is no scene of a rod either is that of the text.
            Err(_) if !ChainScene::is_chain(text) && dalembert::Scene::parse(text).is_ok() => {
                return Err(refuse("found a rod on rigid ground, expected a chain: dalembert.Problem takes rods"));
            }
            scene => scene.map_err(refuse)?,
        };
        let value = |(name, value): &(String, Bound<'_, PyAny>)| -> PyResult<(Parameter, Number)> {
            let parameter = name.parse().map_err(|error: UnknownName| refuse(error))?;
            Ok((parameter, number(name, value)?))
        };
        let values = replaced.iter().map(value).collect::<PyResult<Vec<_>>>()?;
        scene.chain = scene.chain.with_values(values).map_err(refuse)?;
        Ok(Chain { scene: Arc::new(scene) })
    }

    fn facts(&self) -> PyResult<ChainFacts> {
        let (scene, chain) = (&self.scene, &self.scene.chain);
        let body = |body: &dalembert::chain::Body| BodyFacts {
            name: body.name().map(Into::into),
            length: body.length().to_string(),
            mass: body.rigid_mass().map(ToString::to_string),
        };
        let parameters = chain.parameters().map(Parameter::OfChain).chain([Parameter::Gravity, Parameter::Time]);
        let value = |parameter: Parameter| Ok((parameter.to_string(), chain.number(parameter)?.to_string()));
        let values = parameters.map(value).collect::<Result<_, dalembert::problem::ProblemError>>().map_err(refuse)?;
        Ok(ChainFacts {
            title: scene.title.clone(),
            bodies: chain.bodies().iter().map(body).collect(),
            values,
            quantities: described(scene),
        })
    }

    /// Solves the chain in the numbers that are asked for.
    fn solve(
        &self,
        py: Python<'_>,
        digits: &Bound<'_, PyAny>,
        exact: &Bound<'_, PyAny>,
        certified: &Bound<'_, PyAny>,
        accuracy: &Bound<'_, PyAny>,
    ) -> PyResult<ChainHistory> {
        let numbers = numbers([digits, exact, certified, accuracy], self.scene.accuracy)?;
        let (scene, stop) = (self.scene.clone(), Arc::default());
        let observe = observer(&stop);
        let history = run(py, &stop, move || scene.chain.solve_observed(numbers, observe))?;
        Ok(ChainHistory { history: Arc::new(history), numbers, stop })
    }
}

/// Attributes of a history.
#[derive(IntoPyObject)]
struct HistoryFacts {
    /// `double`, `exact`, `digits` or `certified`.
    numbers: &'static str,
    /// Numbers as they were asked for, in words.
    question: String,
    end: Cell,
    ending: String,
}

/// A table of a history: words and numbers by column.
#[derive(IntoPyObject)]
struct ListedRows {
    words: Vec<(&'static str, Vec<String>)>,
    numbers: Vec<Listed>,
}

/// The force of a node in pieces.
#[derive(IntoPyObject)]
struct Pieces {
    numbers: Vec<Listed>,
    /// Chebyshev coefficients of each piece; none of a line.
    series: Vec<Column>,
}

/// A motion of a chain, and the means to interrupt its questions.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct ChainHistory {
    history: Arc<dalembert::chain::ChainHistory>,
    numbers: Numbers,
    stop: Arc<AtomicBool>,
}

impl ChainHistory {
    /// Returns the answer to `query`, without the interpreter's lock.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        query: impl FnOnce(&dalembert::chain::ChainHistory) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let history = self.history.clone();
        run(py, &self.stop, move || query(&history))
    }

    fn is_double(&self) -> bool {
        matches!(self.numbers, Numbers::Double(_))
    }

    /// Returns the columns of these names and groups.
    fn columns_of(&self, quantities: &Bound<'_, PyAny>) -> PyResult<Vec<ChainColumn>> {
        let chain = self.history.chain();
        let list = |name: String| match ChainColumn::list(&name, chain) {
            found if found.is_empty() => {
                let known = ChainColumn::names(chain).join(", ");
                Err(refuse(format!("found the quantity {name} of a chain, expected one of {known}")))
            }
            found => Ok(found),
        };
        Ok(names("names", quantities)?.into_iter().map(list).collect::<PyResult<Vec<_>>>()?.concat())
    }

    fn body(&self, body: &Bound<'_, PyAny>) -> PyResult<usize> {
        let body: i64 = typed("body", body, "the number of a body, from 1")?;
        let bodies = self.history.chain().bodies().len();
        let found = usize::try_from(body).ok().filter(|body| (1..=bodies).contains(body));
        let refused = || refuse(format!("found body = {body}, expected a body from 1, the lowest, to {bodies}"));
        Ok(found.ok_or_else(refused)? - 1)
    }
}

/// Returns the columns of rows of numbers, some of which may be absent.
fn listed(names: &[&str], rows: &[Vec<Option<Value>>], why: &str, is_double: bool) -> Vec<Listed> {
    let column = |(k, name): (usize, &&str)| {
        let values: Vec<_> = rows.iter().map(|row| row[k].as_ref().ok_or_else(|| why.to_string())).collect();
        Listed::new(name, &values, is_double)
    };
    names.iter().enumerate().map(column).collect()
}

#[pymethods]
impl ChainHistory {
    fn facts(&self, py: Python<'_>) -> PyResult<HistoryFacts> {
        let numbers = self.numbers;
        self.ask(py, move |history| {
            let listing = history.listing()?;
            let (numbers, question) = (system(numbers), numbers.to_string());
            Ok(HistoryFacts { numbers, question, end: Cell::from(&listing.end), ending: listing.ending.to_string() })
        })
    }

    fn warnings(&self) -> Vec<String> {
        self.history.warnings().iter().map(ToString::to_string).collect()
    }

    /// Returns the events, contacts or touches.
    fn table(&self, py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<ListedRows> {
        let table = one_of("table", table, &[("events", 0), ("contacts", 1), ("touches", 2)])?;
        let is_double = self.is_double();
        self.ask(py, move |history| {
            let (listing, chain) = (history.listing()?, history.chain());
            let node = |node: usize| chain.node_name(node);
            Ok(match table {
                0 => {
                    let row = |event: &ChainEvent<Value>| event.numbers().map(|value| Some(value.clone())).into();
                    let rows: Vec<Vec<_>> = listing.events.iter().map(row).collect();
                    let kinds = listing.events.iter().map(|event| event.kind.to_string()).collect();
                    let nodes = listing.events.iter().map(|event| node(event.node)).collect();
                    let words = vec![("node", nodes), ("kind", kinds)];
                    ListedRows { words, numbers: listed(ChainNumbers::Events.names(), &rows, "", is_double) }
                }
                1 => {
                    let row = |contact: &ChainContact<Value>| {
                        let numbers = contact.numbers(&listing.ending).into_iter();
                        numbers.chain([listing.peak_time(contact)]).map(Option::<&Value>::cloned).collect()
                    };
                    let rows: Vec<Vec<_>> = listing.contacts.iter().map(row).collect();
                    let nodes = listing.contacts.iter().map(|contact| node(contact.node)).collect();
                    let names = [ChainNumbers::Contacts.names(), &["peak_time"]].concat();
                    let why = "the contact does not end within this history, or its peak is a plateau";
                    ListedRows { words: vec![("node", nodes)], numbers: listed(&names, &rows, why, is_double) }
                }
                _ => {
                    let rows: Vec<Vec<_>> = listing.touches.iter().map(|touch| vec![Some(touch.t.clone())]).collect();
                    let nodes = listing.touches.iter().map(|touch| node(touch.node)).collect();
                    ListedRows { words: vec![("node", nodes)], numbers: listed(&["t"], &rows, "", is_double) }
                }
            })
        })
    }

    /// Returns the pieces of the force of a node: `bottom`, the number of a joint, or `top`.
    fn force_pieces(&self, py: Python<'_>, node: &Bound<'_, PyAny>) -> PyResult<Pieces> {
        let name = format!("force.{}", node.str()?);
        let found = ChainColumn::read(&name, self.history.chain());
        let joints = self.history.chain().bodies().len() - 1;
        let refused = || refuse(format!("found node {node}, expected bottom, top, or a joint from 1 to {joints}"));
        let (node, is_double) = (found.ok_or_else(refused)?.place, self.is_double());
        self.ask(py, move |history| {
            let pieces = history.force_pieces(node)?;
            let row = |piece: &dalembert::chain::ForcePiece<Value>| {
                [&piece.start, &piece.end, &piece.first, &piece.last].map(|value| Some(value.clone())).into()
            };
            let rows: Vec<Vec<_>> = pieces.iter().map(row).collect();
            let numbers = listed(&["start", "end", "force_start", "force_end"], &rows, "", is_double);
            let series = pieces.iter().map(|piece| Column::new(piece.series.iter().map(Some), is_double));
            Ok(Pieces { numbers, series: series.collect() })
        })
    }

    /// Returns the values of quantities at times. Without a side a time has two rows where two limits differ.
    fn columns(
        &self,
        py: Python<'_>,
        times: &Bound<'_, PyAny>,
        quantities: &Bound<'_, PyAny>,
        side: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<(String, Column)>> {
        let (columns, side) = (self.columns_of(quantities)?, side.map(side_of).transpose()?);
        let (given, is_double) = (Given::new("time", times)?, self.is_double());
        let doubles = if let Given::Doubles(list) = &given { list.clone() } else { Vec::new() };
        let times = given.into_numbers("time")?;
        self.ask(py, move |history| {
            let (mut spelled, mut sides, mut rows) = (Vec::new(), Vec::new(), Vec::new());
            for (k, time) in times.iter().enumerate() {
                let asked = doubles.get(k).map_or(ChainTime::Spelled(time), |time| ChainTime::Computed(*time));
                for row in history.rows_at(&columns, asked, side)? {
                    spelled.push(history.time(time)?);
                    sides.push(row.side.map_or(0.0, |side| if side == Side::Left { -1.0 } else { 1.0 }));
                    rows.push(row.values);
                }
            }
            let keys = [
                ("t".to_string(), Column::new(spelled.iter().map(Some), is_double)),
                ("side".to_string(), Column::Doubles(sides)),
            ];
            let column = |(k, column): (usize, &ChainColumn)| {
                let values = rows.iter().map(|row| Some(&row[k]));
                (column.name(history.chain()), Column::new(values, is_double))
            };
            Ok(keys.into_iter().chain(columns.iter().enumerate().map(column)).collect())
        })
    }

    /// Returns `u`, `v`, `strain` of a body at each point at the time beside it.
    fn field(
        &self,
        py: Python<'_>,
        body: &Bound<'_, PyAny>,
        points: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<(&'static str, Column)>> {
        let (body, side, is_double) = (self.body(body)?, side_of(side)?, self.is_double());
        let (points, times) =
            (Given::new("point", points)?.into_numbers("point")?, Given::new("time", times)?.into_numbers("time")?);
        self.ask(py, move |history| {
            let field = |(point, time): (&Number, &Number)| history.field(body, point, time, side);
            let fields = points.iter().zip(&times).map(field).collect::<Result<Vec<_>, _>>()?;
            let column = |k: usize| Column::new(fields.iter().map(|field| Some(field.numbers()[k])), is_double);
            Ok((0..3).map(|k| (SLICE[3 + k].name(), column(k))).collect())
        })
    }

    /// Returns the derivatives of events or contacts from the left and from the right.
    fn derivatives(
        &self,
        py: Python<'_>,
        by: &Bound<'_, PyAny>,
        table: &Bound<'_, PyAny>,
    ) -> PyResult<[Vec<Listed>; 2]> {
        let (by, is_double) = (parameter(by)?, self.is_double());
        let lists = [("events", ChainNumbers::Events), ("contacts", ChainNumbers::Contacts)];
        let numbers: ChainNumbers<'static> = one_of("table", table, &lists)?;
        self.ask(py, move |history| Ok(sides(&history.derivatives(by, numbers)?, numbers.names(), is_double)))
    }

    /// Returns the derivatives of quantities at times.
    fn derivatives_at(
        &self,
        py: Python<'_>,
        by: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        quantities: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
    ) -> PyResult<[Vec<Listed>; 2]> {
        let (by, side, is_double) = (parameter(by)?, side_of(side)?, self.is_double());
        let (columns, times) = (self.columns_of(quantities)?, Given::new("time", times)?.into_numbers("time")?);
        self.ask(py, move |history| {
            let names: Vec<String> = columns.iter().map(|column| column.name(history.chain())).collect();
            let numbers = ChainNumbers::Columns { columns: &columns, times: &times, side };
            Ok(sides(&history.derivatives(by, numbers)?, &names, is_double))
        })
    }
}
