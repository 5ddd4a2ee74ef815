//! Sweeps: the same numbers of many problems.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use dalembert::{Numbers, Quantity};
use numpy::PyArray1;
use pyo3::prelude::*;

use super::argument::{names, number, refuse, typed};
use super::problem::{Problem, Setting};
use super::run;

/// Values and bounds of one quantity, point by point.
type Column = (Py<PyArray1<f64>>, Py<PyArray1<f64>>);
/// Notes on points, by their index.
type Notes = Vec<(usize, String)>;

/// The answers of a sweep.
#[derive(IntoPyObject)]
pub(crate) struct Swept(Vec<&'static str>, Vec<Column>, Notes);

/// Returns the names of the quantities, values and bounds of each, and a note for each point that has one.
#[pyfunction]
pub(crate) fn sweep(
    py: Python<'_>,
    base: &Bound<'_, PyAny>,
    quantities: &Bound<'_, PyAny>,
    time: Option<&Bound<'_, PyAny>>,
    accuracy: &Bound<'_, PyAny>,
    varied: Vec<(String, Vec<Bound<'_, PyAny>>)>,
) -> PyResult<Swept> {
    let base = base.cast::<Problem>()?.get();
    let single = |name: &String| {
        Quantity::single(name).ok_or_else(|| {
            let known: Vec<&str> = Quantity::singles().map(Quantity::name).collect();
            let meant = dalembert::nearest(name, known.iter().copied());
            let meant = meant.map_or_else(String::new, |meant| format!(" (did you mean {meant}?)"));
            refuse(format!("found the quantity `{name}`, expected one of {}{meant}", known.join(", ")))
        })
    };
    let quantities = names("quantities", quantities)?.iter().map(single).collect::<PyResult<Vec<_>>>()?;
    let time = time.map(|time| number("time", time)).transpose()?;
    dalembert_cli::sweep::check_time(&quantities, time.as_ref()).map_err(refuse)?;
    let accuracy: Option<f64> = typed("accuracy", accuracy, "a float or None")?;
    let mut columns: Vec<Vec<Setting>> = Vec::new();
    for (name, values) in varied {
        let values = values.iter().map(|value| Setting::new(&name, value)).collect::<PyResult<_>>()?;
        columns.push(values);
    }
    let count = columns.first().map_or(1, Vec::len);
    let numbers = Numbers::Double(accuracy.or(base.accuracy));
    let (start, stop) = (base.problem.clone(), Arc::new(AtomicBool::new(false)));
    let (names, seen): (Vec<_>, _) = (quantities.iter().map(|quantity| quantity.name()).collect(), stop.clone());
    let cells = run(py, &stop, move || {
        let problem = |k: usize| {
            let set = |builder, values: &Vec<Setting>| values[k].clone().apply(builder);
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
        let mut texts: Vec<&str> = cells.iter().filter_map(|cell| cell.note()).collect();
        texts.dedup();
        if !texts.is_empty() {
            notes.push((k, texts.join("; ")));
        }
    }
    let columns = (0..names.len()).map(column).collect();
    Ok(Swept(names, columns, notes))
}
