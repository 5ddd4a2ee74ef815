//! Comparisons of other data with the exact history.

use std::path::Path;
use std::sync::Arc;

use dalembert::{Parameter, Units};
use dalembert_compare::data::{DataErrorKind, Source};
use dalembert_compare::{Axis, Comparison as Compared, Compression, Limit, Options, Origin, Prepared};
use numpy::{PyArray1, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::argument::{names, number, one_of, refuse, typed, wrong_type};
use super::problem::Problem;
use super::{observer, run};

/// Data: a path, or arrays under a name.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Data<'py> {
    name: String,
    columns: Vec<String>,
    arrays: Option<Vec<Bound<'py, PyUntypedArray>>>,
}

type Samples<'py> = Vec<(String, Bound<'py, PyArray1<f64>>)>;

/// The results of a comparison.
#[derive(IntoPyObject)]
struct Report<'py> {
    json: String,
    table: String,
    warnings: Vec<String>,
    /// The samples of each source by name: times, points, and for each quantity ours and theirs.
    samples: Vec<Samples<'py>>,
}

/// Returns the column as doubles, or the reason why it has none.
fn column(array: Bound<'_, PyUntypedArray>) -> Result<Vec<f64>, DataErrorKind> {
    match array.cast::<PyArray1<f64>>() {
        Ok(values) => Ok(values.readonly().as_array().to_vec()),
        Err(_) if array.ndim() != 1 => Err(DataErrorKind::Shape(array.shape().to_vec())),
        Err(_) => Err(DataErrorKind::ElementType { found: array.dtype().to_string() }),
    }
}

/// A comparison, as `dalembert compare` reports it.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Comparison {
    compared: Compared,
    title: Option<String>,
}

fn options(given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let mut options = Options::default();
    for (key, value) in given {
        let name: String = key.extract()?;
        let number = |value: &Bound<'_, PyAny>| number(&name, value);
        match name.as_str() {
            "map" => options.map = Some(typed(&name, &value, "a text such as \"t=0,u=1\"")?),
            "to" => options.to = Some(number(&value)?),
            "fit" => {
                let names = names(&name, &value)?;
                options.fit = names
                    .iter()
                    .map(|name| Parameter::differentiable(name))
                    .collect::<Result<_, _>>()
                    .map_err(refuse)?;
            }
            "dt" => options.dt = Some(number(&value)?),
            "t0" => options.t0 = Some(number(&value)?),
            "shift" => options.shift = Some(number(&value)?),
            "energy_scale" => options.energy_scale = Some(number(&value)?),
            "window" => options.window = Some(number(&value)?),
            "widths" => {
                let widths = value.try_iter().map_err(|_| wrong_type(&name, &value, "a sequence of numbers"))?;
                options.widths = widths.map(|width| number(&width?)).collect::<PyResult<_>>()?;
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
    #[new]
    fn new(py: Python<'_>, problem: &Problem, data: Vec<Data<'_>>, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let options = options(given)?;
        let source = |data: Data<'_>| match data.arrays {
            Some(arrays) => {
                Ok(Source::from_columns(&data.name, data.columns, arrays.into_iter().map(column).collect()))
            }
            None => Source::open(Path::new(&data.name)).map_err(refuse),
        };
        let sources = data.into_iter().map(source).collect::<PyResult<Vec<_>>>()?;
        let (rod, accuracy) = (problem.problem.clone(), problem.accuracy);
        let units = Units::new(&rod, problem.units);
        let stop = Arc::default();
        let observe = observer(&stop);
        let compared =
            run(py, &stop, move || Prepared::new(&rod, &units, accuracy, sources, &options)?.compare(observe))?;
        Ok(Comparison { compared, title: problem.title.clone() })
    }

    fn report<'py>(&self, py: Python<'py>) -> Report<'py> {
        let (compared, title) = (&self.compared, self.title.as_deref());
        let array = |(name, values)| (name, PyArray1::from_slice(py, values));
        Report {
            json: compared.json(title).to_string(),
            table: compared.table(title),
            warnings: compared.warnings.iter().map(ToString::to_string).collect(),
            samples: compared.files.iter().map(|file| file.columns().map(array).collect()).collect(),
        }
    }

    /// Returns a line for each number above or below its limit; limits are texts such as `u.l2=0.1`.
    fn failures(&self, above: Vec<String>, below: Vec<String>) -> PyResult<Vec<String>> {
        let parsed = |limits: &[String]| limits.iter().map(|limit| limit.parse()).collect::<Result<Vec<Limit>, _>>();
        let mut limits = parsed(&above).map_err(refuse)?;
        limits.extend(parsed(&below).map_err(refuse)?.into_iter().map(Limit::into_minimum));
        let outcomes = self.compared.outcomes(&limits).map_err(refuse)?;
        Ok(outcomes.iter().filter(|outcome| outcome.failure.is_some()).map(ToString::to_string).collect())
    }
}
