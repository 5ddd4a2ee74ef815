//! Data of a user's against the exact history.

use std::path::Path;
use std::sync::Arc;

use dalembert::Units;
use dalembert::agreement::{Axis, CompareError, Comparison as Compared, Compression, Limit, Options, Origin, Prepared};
use dalembert::data::{DataErrorKind, Source};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::problem::{Problem, number as read_number};
use super::{observer, one_of, refuse, run};

/// A column: doubles, or the type or the shape that makes it none.
#[derive(FromPyObject)]
pub(crate) enum Column<'py> {
    Doubles(PyReadonlyArray1<'py, f64>),
    Type(String),
    Shape(Vec<usize>),
}

impl Column<'_> {
    fn read(self) -> Result<Vec<f64>, DataErrorKind> {
        match self {
            Column::Doubles(values) => Ok(values.as_array().to_vec()),
            Column::Type(found) => Err(DataErrorKind::ElementType { found }),
            Column::Shape(shape) => Err(DataErrorKind::Shape(shape)),
        }
    }
}

/// What `dalembert compare` reports.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Comparison {
    compared: Compared,
    title: Option<String>,
    units: Units,
}

fn options(given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let mut options = Options::default();
    for (key, value) in given {
        let name: String = key.extract()?;
        let number = || read_number(&name, &value).map(Some);
        match name.as_str() {
            "map" => options.map = Some(value.extract()?),
            "dt" => options.dt = number()?,
            "t0" => options.t0 = number()?,
            "shift" => options.shift = number()?,
            "energy_scale" => options.energy_scale = number()?,
            "window" => options.window = number()?,
            "widths" => {
                let widths = value.try_iter()?.map(|width| read_number("widths", &width?));
                options.widths = widths.collect::<PyResult<_>>()?;
            }
            "compression" => {
                let known = [("+", Compression::Positive), ("-", Compression::Negative)];
                options.compression = Some(one_of(&name, &value, &known)?);
            }
            "u_origin" => {
                options.origin = one_of(&name, &value, &[("ground", Origin::Ground), ("start", Origin::Start)])?;
            }
            _ => options.axis = one_of(&name, &value, &[("up", Axis::Up), ("down", Axis::Down)])?,
        }
    }
    Ok(options)
}

#[pymethods]
impl Comparison {
    /// Compares sources: a name with the names of columns and these, or a path alone.
    #[new]
    fn new(
        py: Python<'_>,
        problem: &Problem,
        data: Vec<(String, Vec<String>, Option<Vec<Column<'_>>>)>,
        given: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let options = options(given)?;
        let source = |(name, names, columns): (String, Vec<String>, Option<Vec<Column<'_>>>)| match columns {
            Some(columns) => Ok(Source::arrays(&name, names, columns.into_iter().map(Column::read).collect())),
            None => Source::open(Path::new(&name)).map_err(refuse),
        };
        let sources = data.into_iter().map(source).collect::<PyResult<Vec<_>>>()?;
        let (rod, accuracy) = (problem.problem.clone(), problem.accuracy);
        let units = Units::of(&rod, problem.units);
        let (stop, in_run) = (Arc::default(), units.clone());
        let observe = observer(&stop);
        let compared = run(py, &stop, move || {
            Prepared::new(&rod, &in_run, accuracy, sources, &options)?.compare(observe).map_err(CompareError::from)
        })?;
        Ok(Comparison { compared, title: problem.title.clone(), units })
    }

    fn table(&self) -> String {
        self.compared.table(self.title.as_deref(), &self.units)
    }

    fn json(&self) -> String {
        self.compared.json(self.title.as_deref(), &self.units).to_string()
    }

    /// The norms that are above limits such as `u.l2=0.1`, a line each.
    fn above(&self, limits: Vec<String>) -> PyResult<Vec<String>> {
        let limits = limits.iter().map(|limit| limit.parse()).collect::<Result<Vec<Limit>, _>>().map_err(refuse)?;
        self.compared.above(&limits).map_err(refuse)
    }

    fn warnings(&self) -> Vec<String> {
        self.compared.warnings.iter().map(ToString::to_string).collect()
    }

    /// Every sample of a source, by name: times, points, and for each quantity ours and theirs.
    fn columns<'py>(&self, py: Python<'py>, source: usize) -> Vec<(String, Bound<'py, PyArray1<f64>>)> {
        let files = self.compared.files.get(source).into_iter();
        files.flat_map(|file| file.columns()).map(|(name, values)| (name, PyArray1::from_slice(py, values))).collect()
    }
}
