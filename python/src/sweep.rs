//! The same numbers of many problems.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use dalembert::{Numbers, Quantity};
use numpy::PyArray1;
use pyo3::prelude::*;

use super::number::written;
use super::problem::{Given, Problem};
use super::{refuse, run};

/// Values and bounds of one quantity, point by point.
type Column = (Py<PyArray1<f64>>, Py<PyArray1<f64>>);
/// What is said of points, by their index.
type Notes = Vec<(usize, String)>;

/// Values and bounds of each quantity, and a note for each point that has one.
#[pyfunction]
pub(crate) fn sweep(
    py: Python<'_>,
    base: &Bound<'_, PyAny>,
    quantities: Vec<String>,
    time: Option<&Bound<'_, PyAny>>,
    accuracy: Option<f64>,
    varied: Vec<(String, Vec<Bound<'_, PyAny>>)>,
) -> PyResult<(Vec<Column>, Notes)> {
    let base = base.cast::<Problem>()?.get();
    let single = |name: &String| {
        let known = || Quantity::singles().map(|quantity| quantity.name()).collect::<Vec<_>>().join(", ");
        Quantity::single(name).ok_or_else(|| refuse(format!("found quantity `{name}`, expected one of {}", known())))
    };
    let quantities = quantities.iter().map(single).collect::<PyResult<Vec<_>>>()?;
    let time = time.map(|time| written("time", time)?.number().cloned().map_err(refuse)).transpose()?;
    let mut columns: Vec<Vec<Given>> = Vec::new();
    for (name, values) in varied {
        let values = values.iter().map(|value| Given::of(&name, value)).collect::<PyResult<_>>()?;
        columns.push(values);
    }
    let count = columns.first().map_or(1, Vec::len);
    let numbers = Numbers::Double(accuracy.or(base.accuracy));
    let (start, stop) = (base.problem.clone(), Arc::new(AtomicBool::new(false)));
    let (asked, seen) = (quantities.len(), stop.clone());
    let cells = run(py, &stop, move || {
        let problem = |k: usize| {
            let set = |builder, values: &Vec<Given>| values[k].clone().set(builder);
            columns.iter().fold(start.to_builder(), set).build()
        };
        let go_on = || if seen.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        dalembert_cli::sweep::sweep(count, &problem, &quantities, time.as_ref(), numbers, &go_on)
    })?;
    let column = |j: usize| {
        let value = cells.iter().map(|cells| cells[j].value().unwrap_or(f64::NAN));
        let bound = cells.iter().map(|cells| if cells[j].value().is_some() { cells[j].bound() } else { f64::NAN });
        (PyArray1::from_iter(py, value).unbind(), PyArray1::from_iter(py, bound).unbind())
    };
    let mut notes = Vec::new();
    for (k, cells) in cells.iter().enumerate() {
        let mut said: Vec<&str> = cells.iter().filter_map(|cell| cell.note()).collect();
        said.dedup();
        if !said.is_empty() {
            notes.push((k, said.join("; ")));
        }
    }
    Ok(((0..asked).map(column).collect(), notes))
}
