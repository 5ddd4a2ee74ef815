//! Problems, and numbers as Python has them.

use std::sync::Arc;

use dalembert::problem::{Builder, Parameters, Top, Written};
use dalembert::solve::MAX_DIGITS;
use dalembert::{Number, Numbers, Plan, Question, Scene, UnitSystem};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};

use super::history::History;
use super::{observer, one_of, refuse, run};

/// A number: exactly what an int, a `Fraction`, a `Decimal` or a text spells; a float is the shortest decimal that
/// spells it.
pub(crate) fn written(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Written> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Written::from(text.to_str()?));
    }
    let spelt = value.is_instance_of::<PyInt>() || value.hasattr("as_integer_ratio")? || value.hasattr("__index__")?;
    if !spelt || value.is_instance_of::<PyBool>() {
        let (shown, kind) = (value.repr()?, value.get_type().name()?);
        let shown: String = shown.to_str()?.chars().take(40).collect();
        return Err(PyTypeError::new_err(format!(
            "found {name} = {shown}, of type {kind}, expected a number: int, float, Fraction, Decimal or str"
        )));
    }
    let single = || value.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.eq("f"));
    if value.is_instance_of::<PyFloat>() || single().unwrap_or(false) {
        return Ok(Written::from(value.extract::<f64>()?));
    }
    let text = value.str()?;
    let text = text.to_str()?;
    Ok(text.parse::<Number>().map_or_else(|_| Written::from(text), Written::from))
}

/// The same, of a time or a point.
pub(crate) fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Number> {
    written(name, value)?.number().cloned().map_err(refuse)
}

type Points<'py> = Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)>;

fn points(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<(Written, Written)>> {
    let pairs: Points<'_> = value.extract().map_err(|_| {
        PyTypeError::new_err(format!(
            "found {name} of another shape, expected points (x, value), an array of shape (n, 2)"
        ))
    })?;
    pairs.iter().map(|(x, v)| Ok((written("x", x)?, written(name, v)?))).collect()
}

/// The physics in exact numbers, checked.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Problem {
    pub(crate) problem: dalembert::Problem,
    pub(crate) accuracy: Option<f64>,
    pub(crate) title: Option<String>,
    pub(crate) units: UnitSystem,
}

#[pymethods]
impl Problem {
    /// A problem from its values by name.
    #[new]
    fn new(values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let problem = set(dalembert::Problem::builder(), values)?.build().map_err(refuse)?;
        Ok(Problem { problem, accuracy: None, title: None, units: UnitSystem::default() })
    }

    /// The problem of a scene in TOML.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let scene = Scene::parse(text).map_err(refuse)?;
        let Scene { problem, accuracy, title, units, .. } = scene;
        Ok(Problem { problem, accuracy: accuracy.as_ref().map(Number::to_f64), title, units })
    }

    /// The same problem with other values in place of some.
    fn replace(&self, values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let problem = set(self.problem.to_builder(), values)?.build().map_err(refuse)?;
        Ok(Problem { problem, accuracy: self.accuracy, title: self.title.clone(), units: self.units })
    }

    /// `c`, `t₁`, `R`, `M`, in doubles; `M` is infinite without gravity and `None` where the start is not uniform.
    fn parameters(&self) -> PyResult<(f64, f64, f64, Option<f64>)> {
        let rod = Parameters::<f64>::of(&self.problem, &()).map_err(refuse)?;
        let groups = self.problem.dimensionless();
        Ok((rod.wave_speed, rod.round_trip(), groups.damping_ratio, groups.speed_ratio))
    }

    /// Solves it, in the numbers that are asked for, through the first contact alone or the whole run.
    fn solve(
        &self,
        py: Python<'_>,
        digits: Option<i64>,
        exact: bool,
        certified: bool,
        accuracy: Option<f64>,
        first_contact: bool,
    ) -> PyResult<History> {
        let digits = digits.map(|digits| {
            u32::try_from(digits)
                .map_err(|_| refuse(format!("found {digits} digits asked for, expected 1 to {MAX_DIGITS}")))
        });
        let digits = digits.transpose()?;
        let numbers = match (certified, exact, digits, accuracy) {
            (true, true, ..) => return Err(PyValueError::new_err("found certified and exact, expected one of them")),
            (true, _, _, Some(_)) | (_, true, _, Some(_)) | (_, _, Some(_), Some(_)) => {
                return Err(PyValueError::new_err("found accuracy with other numbers, expected it with doubles only"));
            }
            (true, _, digits, _) => Numbers::Certified(digits.unwrap_or(dalembert::CERTIFIED_DIGITS)),
            (_, true, None, _) => Numbers::Exact,
            (_, true, Some(digits), _) => Numbers::ExactThenDigits(digits),
            (_, _, Some(digits), _) => Numbers::Digits(digits),
            (.., accuracy) => Numbers::Double(accuracy.or(self.accuracy)),
        };
        let question = if first_contact { Question::first_contact(numbers) } else { Question::run(numbers) };
        let (problem, stop) = (self.problem.clone(), Arc::default());
        let observe = observer(&stop);
        // The plan may already take long: it foresees the digits that a chaotic run loses.
        let solution = run(py, &stop, move || Plan::of(&problem, &question)?.solve(&problem, observe))?;
        Ok(History::new(solution, stop))
    }
}

/// A whole number, whose range the builder checks.
fn whole(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u32> {
    let message = || format!("found {name} = {value}, expected a whole number from 1 to 10000000");
    let whole: i64 = value.extract().map_err(|_| PyTypeError::new_err(message()))?;
    u32::try_from(whole).map_err(|_| refuse(message()))
}

/// The builder with all of `values` set.
fn set(mut builder: Builder, values: &Bound<'_, PyDict>) -> PyResult<Builder> {
    for (key, value) in values {
        let key: String = key.extract()?;
        let name = key.as_str();
        builder = match name {
            "impacts" => builder.impacts(whole(name, &value)?),
            "displacement" => builder.displacement(points(name, &value)?),
            "velocity" => builder.velocity(points(name, &value)?),
            "top" => builder.top(one_of(name, &value, &[("free", Top::Free), ("fixed", Top::Fixed)])?),
            _ => match Builder::numbers().any(|known| known == name) {
                true => builder.named(name, written(name, &value)?),
                false => {
                    let known = Builder::numbers().collect::<Vec<_>>().join(", ");
                    let expected = format!("one of {known}, impacts, displacement, velocity, top");
                    return Err(PyTypeError::new_err(format!("found the unknown value `{name}`, expected {expected}")));
                }
            },
        };
    }
    Ok(builder)
}
