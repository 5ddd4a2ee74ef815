//! Numbers as Python has them.

use dalembert::Number;
use dalembert::problem::Written;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyString};

use super::refuse;

/// A number: exactly what an int, a `Fraction`, a `Decimal` or a text spells; a float is the shortest decimal that
/// spells it.
pub(crate) fn written(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Written> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Written::from(text.to_str()?));
    }
    let spelt = value.hasattr("as_integer_ratio")? || value.hasattr("__index__")?;
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
