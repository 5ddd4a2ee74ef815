//! Histories: their tables, columns and fields as arrays.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use dalembert::engine::Scales;
use dalembert::quantity::{Needs, SLICE, Slice};
use dalembert::solve::Derivatives;
use dalembert::{Derivative, Error, Numbers, Parameter, Quantity, Side, Value};
use dalembert_plot::Drawing;
use numpy::PyArray1;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

use super::argument::{Given, names, one_of, refuse, typed};
use super::run;

/// A number as Python receives it: a float, the text of a fraction or of a decimal, or both ends of an enclosure.
#[derive(IntoPyObject)]
pub(crate) enum Cell {
    Double(f64),
    Text(String),
    Ends([String; 2]),
}

impl From<&Value> for Cell {
    fn from(value: &Value) -> Self {
        match (value.is_double(), value.ends()) {
            (true, _) => Cell::Double(value.to_f64()),
            (false, Some(ends)) => Cell::Ends(ends),
            (false, None) => Cell::Text(value.to_string()),
        }
    }
}

/// Numbers of one quantity; an absent number is NaN among doubles.
pub(crate) enum Column {
    Doubles(Vec<f64>),
    Cells(Vec<Option<Cell>>),
}

impl Column {
    /// Collects values, which are doubles or not.
    pub(crate) fn new<'a>(values: impl Iterator<Item = Option<&'a Value>>, is_double: bool) -> Self {
        if is_double {
            Column::Doubles(values.map(|value| value.map_or(f64::NAN, Value::to_f64)).collect())
        } else {
            Column::Cells(values.map(|value| value.map(Cell::from)).collect())
        }
    }

    /// Collects the columns of an answer with their names. Sides are doubles in every number system.
    fn all<'a>(
        quantities: impl IntoIterator<Item = &'a Quantity>,
        columns: &[Vec<Value>],
        is_double: bool,
    ) -> Vec<(&'static str, Self)> {
        let column = |(quantity, values): (&Quantity, &Vec<Value>)| {
            let is_double = is_double || *quantity == Quantity::Side;
            (quantity.name(), Column::new(values.iter().map(Some), is_double))
        };
        quantities.into_iter().zip(columns).map(column).collect()
    }
}

impl<'py> IntoPyObject<'py> for Column {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        match self {
            Column::Doubles(column) => Ok(PyArray1::from_vec(py, column).into_any()),
            Column::Cells(column) => column.into_bound_py_any(py),
        }
    }
}

/// A column some of whose numbers may be absent.
#[derive(IntoPyObject)]
pub(crate) struct Listed {
    name: String,
    values: Column,
    /// Bound of the error of each number.
    bounds: Column,
    /// Rows without a number, and the reason.
    missing: Vec<(usize, String)>,
}

impl Listed {
    pub(crate) fn new(name: &str, values: &[Result<&Value, String>], is_double: bool) -> Self {
        let found = values.iter().map(|value| value.as_ref().ok().copied());
        let reason = |(row, value): (usize, &Result<_, String>)| Some((row, value.as_ref().err()?.clone()));
        Listed {
            name: name.into(),
            values: Column::new(found.clone(), is_double),
            bounds: Column::Doubles(
                found.map(|value| value.map_or(f64::NAN, |value| value.bound().to_f64())).collect(),
            ),
            missing: values.iter().enumerate().filter_map(reason).collect(),
        }
    }
}

/// Name, unit and meaning of a quantity.
#[derive(IntoPyObject)]
pub(crate) struct Described {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    pub(crate) meaning: String,
}

/// Attributes of a history.
#[derive(IntoPyObject)]
struct Facts {
    /// `double`, `exact`, `digits` or `certified`.
    numbers: &'static str,
    /// Numbers as they were asked for, in words.
    question: String,
    end: Cell,
    ending: String,
    engine: String,
    /// Natural scales: time, velocity, length, wave speed, gravity.
    scales: [f64; 5],
}

/// Tables of a history, by name: a row for each event, contact, flight, or piece of the stress at the ground.
const TABLES: [(&str, Needs); 4] = [
    ("events", Needs::Event),
    ("contacts", Needs::Contact),
    ("flights", Needs::Flight),
    ("stress_history", Needs::Piece),
];

/// A motion, and the means to interrupt its questions.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct History {
    history: Arc<dalembert::History>,
    stop: Arc<AtomicBool>,
}

impl History {
    pub(crate) fn new(history: dalembert::History, stop: Arc<AtomicBool>) -> Self {
        History { history: Arc::new(history), stop }
    }

    /// Returns the answer to `query`, without the interpreter's lock.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        query: impl FnOnce(&dalembert::History) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let history = self.history.clone();
        run(py, &self.stop, move || query(&history))
    }

    /// Returns the columns of a table; stresses and forces with a material only.
    fn listed(&self, table: &Bound<'_, PyAny>) -> PyResult<Vec<Quantity>> {
        let has_material = self.history.units().has_material();
        let columns = one_of("table", table, &TABLES)?.quantities();
        Ok(columns.filter(|quantity| quantity.is_listed(has_material)).collect())
    }
}

#[pymethods]
impl History {
    fn facts(&self) -> Facts {
        let history = &*self.history;
        let numbers = system(history.plan().numbers);
        let Scales { time, velocity, length, wave_speed, gravity } = history.scales();
        Facts {
            numbers,
            question: history.plan().numbers.to_string(),
            end: Cell::from(&history.end()),
            ending: history.ending().to_string(),
            engine: history.plan().engine.to_string(),
            scales: [time, velocity, length, wave_speed, gravity],
        }
    }

    fn warnings(&self) -> Vec<String> {
        let in_digits = |end| format!("{end}; what follows is in {} digits", self.history.digits());
        let first = self.history.exactness_end().map(in_digits);
        first.into_iter().chain(self.history.warnings().iter().map(ToString::to_string)).collect()
    }

    fn error_estimate(&self) -> f64 {
        self.history.error_estimate()
    }

    /// Returns the sheet of pictures of the scene, as SVG.
    fn sheet(&self, py: Python<'_>) -> PyResult<String> {
        self.ask(py, |history| {
            history.in_doubles(|doubles| Ok(Drawing::default().draw(doubles, history.units().clone())?.svg))?
        })
    }

    /// Returns the first and the last time of that sheet.
    fn span(&self, py: Python<'_>) -> PyResult<[f64; 2]> {
        self.ask(py, |history| history.in_doubles(|doubles| Drawing::default().drawn_span(doubles))?)
    }

    /// Returns the kind of each event, and the bound of the error of its time.
    fn kinds(&self, py: Python<'_>) -> PyResult<(Vec<String>, Vec<f64>)> {
        self.ask(py, |history| {
            Ok(history.events()?.iter().map(|event| (event.kind.to_string(), event.t_error)).unzip())
        })
    }

    /// Returns the columns of a table.
    fn table(&self, py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<Vec<Listed>> {
        let quantities = self.listed(table)?;
        self.ask(py, move |history| {
            let (rows, is_double) = (history.list(&quantities)?, history.end().is_double());
            let column = |(k, quantity): (usize, &Quantity)| {
                let values = rows.iter().filter_map(|row| row.get(k));
                let values: Vec<_> = values.map(|value| value.as_ref().map_err(ToString::to_string)).collect();
                Listed::new(quantity.name(), &values, is_double)
            };
            Ok(quantities.iter().enumerate().map(column).collect())
        })
    }

    /// Describes the columns of a table, or the quantities over `time` or along the `rod`.
    fn describe(&self, table: &Bound<'_, PyAny>) -> PyResult<Vec<Described>> {
        let quantities = match table.extract()? {
            "time" => Needs::Time.quantities().collect(),
            "rod" => Needs::PointAndTime.quantities().collect(),
            _ => self.listed(table)?,
        };
        let units = self.history.units();
        let described =
            |q: Quantity| Described { name: q.name().into(), unit: q.unit(units), meaning: q.meaning().into() };
        Ok(quantities.into_iter().map(described).collect())
    }

    /// Returns the derivatives of a table from the left and from the right.
    fn derivatives(
        &self,
        py: Python<'_>,
        by: &Bound<'_, PyAny>,
        table: &Bound<'_, PyAny>,
    ) -> PyResult<[Vec<Listed>; 2]> {
        let by = parameter(by)?;
        let quantities = self.listed(table)?;
        self.ask(py, move |history| {
            let rows = history.derivatives(by, &quantities)?;
            Ok(sides(&rows, &quantity_names(&quantities), history.end().is_double()))
        })
    }

    /// Returns the derivatives of quantities at times, or of the field at points at times.
    fn derivatives_at(
        &self,
        py: Python<'_>,
        by: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        quantities: &Bound<'_, PyAny>,
        points: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
    ) -> PyResult<[Vec<Listed>; 2]> {
        let (by, side) = (parameter(by)?, side_of(side)?);
        let (times, points) =
            (Given::new("time", times)?.into_numbers("time")?, Given::new("point", points)?.into_numbers("point")?);
        let quantities = named(quantities, if points.is_empty() { Needs::Time } else { Needs::PointAndTime })?;
        self.ask(py, move |history| {
            let rows = history.derivatives_at(by, &quantities, &times, &points, side)?;
            Ok(sides(&rows, &quantity_names(&quantities), history.end().is_double()))
        })
    }

    /// Returns the values of quantities at times. Without a side a time has two rows where two limits differ.
    fn columns(
        &self,
        py: Python<'_>,
        times: &Bound<'_, PyAny>,
        quantities: &Bound<'_, PyAny>,
        side: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<(&'static str, Column)>> {
        let quantities = named(quantities, Needs::Time)?;
        let (times, side) = (Given::new("time", times)?, side.map(side_of).transpose()?);
        self.ask(py, move |history| {
            if let (true, Given::Doubles(times)) = (history.end().is_double(), &times) {
                // A million doubles take a quarter less time than a million values.
                let columns = history.in_doubles(|doubles| doubles.columns(&quantities, times, side))??;
                return Ok(quantities
                    .iter()
                    .map(|it| it.name())
                    .zip(columns.into_iter().map(Column::Doubles))
                    .collect());
            }
            let columns = history.sample(&quantities, &times.places(), side)?;
            Ok(Column::all(&quantities, &columns, history.end().is_double()))
        })
    }

    /// Returns `u`, `v`, `strain` at each point at the time beside it.
    fn field(
        &self,
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<(&'static str, Column)>> {
        let (points, times) = (Given::new("point", points)?, Given::new("time", times)?);
        let side = side_of(side)?;
        self.ask(py, move |history| {
            let columns = history.sample_pairs(&points.places(), &times.places(), side)?;
            Ok(Column::all(&SLICE[3..], &columns, history.end().is_double()))
        })
    }

    /// Returns `u`, `v`, `strain` time by time, and there point by point or cell by cell.
    fn grid(
        &self,
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
        kind: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<(&'static str, Column)>> {
        let (points, times) = (Given::new("point", points)?, Given::new("time", times)?);
        let side = side_of(side)?;
        let kinds = [("points", Slice::Points), ("averages", Slice::Averages), ("p1", Slice::P1)];
        let kind = one_of("kind", kind, &kinds)?;
        self.ask(py, move |history| {
            let columns = history.sample_field(kind, &points.places(), &times.places(), Some(side))?;
            Ok(Column::all(&SLICE[3..], &columns[3..], history.end().is_double()))
        })
    }
}

fn quantity_names(quantities: &[Quantity]) -> Vec<&'static str> {
    quantities.iter().map(|quantity| quantity.name()).collect()
}

/// Returns the name of a number system.
pub(crate) fn system(numbers: Numbers) -> &'static str {
    match numbers {
        Numbers::Double(_) => "double",
        Numbers::Exact | Numbers::ExactThenDigits(_) => "exact",
        Numbers::Digits(_) => "digits",
        Numbers::Certified(_) => "certified",
    }
}

/// Returns the quantities of these names and groups.
fn named(quantities: &Bound<'_, PyAny>, needs: Needs) -> PyResult<Vec<Quantity>> {
    needs.list(&names("names", quantities)?.join(",")).map_err(refuse)
}

pub(crate) fn parameter(by: &Bound<'_, PyAny>) -> PyResult<Parameter> {
    Parameter::differentiable(&typed::<String>("by", by, "the name of a value of the problem")?).map_err(refuse)
}

pub(crate) fn side_of(side: &Bound<'_, PyAny>) -> PyResult<Side> {
    one_of("side", side, &[("left", Side::Left), ("right", Side::Right)])
}

/// Returns the columns of derivatives of the numbers of these names from the left and from the right.
pub(crate) fn sides(rows: &Derivatives<Value>, names: &[impl AsRef<str>], is_double: bool) -> [Vec<Listed>; 2] {
    [0, 1].map(|side| {
        let column = |(k, name): (usize, &_)| {
            let found = rows.iter().map(|row| row.get(k).and_then(Option::as_ref).map(Derivative::sides));
            let none = || Err("there is no number".to_string());
            let values = found.map(|sides| sides.map_or_else(none, |sides| sides[side].map_err(|why| why.to_string())));
            let values: Vec<_> = values.collect();
            Listed::new(AsRef::as_ref(name), &values, is_double)
        };
        names.iter().enumerate().map(column).collect()
    })
}
