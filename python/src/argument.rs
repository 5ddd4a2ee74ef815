//! Arguments as Python has them. Each error says what was found and what is expected.

use dalembert::Number;
use dalembert::problem::Written;
use dalembert::solve::Places;
use numpy::PyReadonlyArray1;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyString};

/// Builds a `ValueError` with the text of the command.
pub(crate) fn refuse(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Builds the `TypeError` for an argument of another type.
pub(crate) fn wrong_type(name: &str, found: &Bound<'_, PyAny>, expected: &str) -> PyErr {
    let shown = found.repr().map_or_else(|_| "…".into(), |text| text.to_string());
    let shown: String = shown.chars().take(40).collect();
    let kind = found.get_type().name().map_or_else(|_| "…".into(), |name| name.to_string());
    PyTypeError::new_err(format!("found {name} = {shown}, of type {kind}, expected {expected}"))
}

/// Returns the argument as a `T`, which `expected` describes.
pub(crate) fn typed<'py, T: FromPyObjectOwned<'py>>(
    name: &str,
    value: &Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<T> {
    value.extract().map_err(|_| wrong_type(name, value, expected))
}

/// Returns the names in a sequence of texts, or in a single one.
pub(crate) fn names(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    if let Ok(one) = value.extract::<String>() {
        return Ok(vec![one]);
    }
    let refused = || wrong_type(name, value, "a name or a sequence of names");
    let items = value.try_iter().map_err(|_| refused())?;
    items.map(|item| item?.extract().map_err(|_| refused())).collect()
}

/// Returns the member of `known` that is called `found`.
pub(crate) fn one_of<T: Copy>(name: &str, found: &Bound<'_, PyAny>, known: &[(&str, T)]) -> PyResult<T> {
    let text: Option<String> = found.extract().ok();
    known.iter().find(|(word, _)| text.as_deref() == Some(word)).map(|(_, value)| *value).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        refuse(format!("found {name} = {found}, expected {}", words.join(" or ")))
    })
}

/// Returns a number: exactly the one that an int, a `Fraction`, a `Decimal` or a text spells. A float of Python or
/// NumPy, whatever its size, is the shortest decimal that spells it.
pub(crate) fn written(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Written> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Written::from(text.to_str()?));
    }
    if let Ok(double) = value.cast::<PyFloat>() {
        return Ok(Written::from(double.extract::<f64>()?));
    }
    let is_number = value.hasattr("as_integer_ratio")? || value.hasattr("__index__")?;
    if !is_number || value.is_instance_of::<PyBool>() {
        return Err(wrong_type(name, value, "a number: int, float, Fraction, Decimal or str"));
    }
    // NumPy's own text of a float32 is its shortest decimal.
    let text = value.str()?;
    let text = text.to_str()?;
    Ok(text.parse::<Number>().map_or_else(|_| Written::from(text), Written::from))
}

/// Returns a number, such as a time.
pub(crate) fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Number> {
    written(name, value)?.number().cloned().map_err(refuse)
}

/// Times or points.
pub(crate) enum Given {
    /// An array of doubles, for histories in doubles.
    Doubles(Vec<f64>),
    Numbers(Vec<Number>),
}

impl Given {
    /// Reads an array of doubles, or numbers of any type.
    pub(crate) fn new(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(list) = given.extract::<PyReadonlyArray1<'_, f64>>() {
            return Ok(Given::Doubles(list.as_slice()?.to_vec()));
        }
        Ok(Given::Numbers(given.try_iter()?.map(|x| number(name, &x?)).collect::<PyResult<_>>()?))
    }

    pub(crate) fn places(&self) -> Places<'_> {
        match self {
            Given::Doubles(list) => Places::Doubles(list),
            Given::Numbers(list) => Places::Printed(list),
        }
    }

    /// Returns the numbers as they are written; `name` is that of one.
    pub(crate) fn into_numbers(self, name: &str) -> PyResult<Vec<Number>> {
        let spelled = |x: f64| {
            let finite = || refuse(format!("found {name} {x}, expected a finite number"));
            format!("{x:e}").parse().map_err(|_| finite())
        };
        match self {
            Given::Doubles(list) => list.into_iter().map(spelled).collect(),
            Given::Numbers(list) => Ok(list),
        }
    }
}
