//! Answers: histories, read in columns.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use dalembert::engine::Motion;
use dalembert::number::{Answer, Scalar, show};
use dalembert::quantity::{Needs, Slice, Table, slices};
use dalembert::solve::Derivatives;
use dalembert::{Derivative, Error, Number, Parameter, Problem, Quantity, Side, Solution, Units};
use dalembert_plot::Drawing;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

use super::number::number;
use super::{one_of, refuse, run};

/// A number as Python gets it: a float, the text of a fraction or of a decimal, or both ends of an enclosure.
#[derive(IntoPyObject)]
enum Cell {
    Double(f64),
    Text(String),
    Ends([String; 2]),
}

fn cell<N: Scalar>(x: &N, digits: u32) -> Cell {
    match (x.as_double(), x.ends(digits)) {
        (Some(value), _) => Cell::Double(value),
        (None, Some(ends)) => Cell::Ends(ends),
        (None, None) if digits == 0 => Cell::Text(x.text()),
        (None, None) => Cell::Text(show(x, digits)),
    }
}

/// Numbers of one quantity; what is absent is NaN among doubles.
enum Found {
    Doubles(Vec<f64>),
    Cells(Vec<Option<Cell>>),
}

impl Found {
    fn of<'a, N: Scalar>(values: impl Iterator<Item = Option<&'a N>>, of: &N, digits: u32) -> Self {
        match of.as_double() {
            Some(_) => Found::Doubles(values.map(|x| x.and_then(Scalar::as_double).unwrap_or(f64::NAN)).collect()),
            None => Found::Cells(values.map(|x| x.map(|x| cell(x, digits))).collect()),
        }
    }

    fn all<N: Scalar>(columns: &[Vec<N>], of: &N, digits: u32) -> Vec<Self> {
        columns.iter().map(|column| Found::of(column.iter().map(Some), of, digits)).collect()
    }
}

impl<'py> IntoPyObject<'py> for Found {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        match self {
            Found::Doubles(column) => Ok(PyArray1::from_vec(py, column).into_any()),
            Found::Cells(column) => column.into_bound_py_any(py),
        }
    }
}

/// Times or points.
enum Places {
    Doubles(Vec<f64>),
    Numbers(Vec<Number>),
}

/// Times or points as Python gives them: an array, which is for histories in doubles, or numbers of any type.
fn places(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Places> {
    if let Ok(list) = given.extract::<PyReadonlyArray1<'_, f64>>() {
        return Ok(Places::Doubles(list.as_slice()?.to_vec()));
    }
    Ok(Places::Numbers(given.try_iter()?.map(|x| number(name, &x?)).collect::<PyResult<_>>()?))
}

impl Places {
    /// As they are written.
    fn numbers(self) -> Vec<Number> {
        let spelled = |x: f64| format!("{x:e}").parse().unwrap_or_else(|_| Number::from(0));
        match self {
            Places::Doubles(list) => list.into_iter().map(spelled).collect(),
            Places::Numbers(list) => list,
        }
    }

    /// In the numbers of an attempt.
    fn lift<N: Scalar>(&self, motion: &dyn Motion<N>) -> Vec<N> {
        let end = motion.end();
        match self {
            Places::Doubles(list) => list.iter().map(|x| end.double(*x)).collect(),
            // Digits that a history gave for an event stand for it.
            Places::Numbers(list) if end.as_double().is_none() => {
                list.iter().map(|x| N::from_number(x, &end.precision())).collect()
            }
            Places::Numbers(list) => list.iter().map(|x| N::spelling(x, &end.precision())).collect(),
        }
    }
}

/// Evaluates `$body` for the history inside `$solution`, whatever its numbers; `$digits` of them are to be given.
macro_rules! each {
    ($solution:expr, |$history:ident, $digits:pat_param| $body:expr) => {
        match ($solution, &0) {
            (Solution::Double($history), $digits) => $body,
            (Solution::Exact($history), $digits) => $body,
            (Solution::Digits($history, $digits) | Solution::DigitsAfter($history, $digits, _), _) => $body,
            (Solution::Certified($history, $digits), _) => $body,
        }
    };
}

/// What a history lists, by name.
const LISTS: [(&str, Table); 4] =
    [("events", Table::Events), ("contacts", Table::Contacts), ("flights", Table::Flights), ("stress", Table::Stress)];

/// Numbers and how far each may be off, to the left and to the right.
type Sides = [(Found, Found); 2];

/// What happened, and what can be asked of it.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct History {
    solution: Arc<Solution>,
    /// What was solved, and the units of its numbers.
    solved: (Problem, Units),
    stop: Arc<AtomicBool>,
}

impl History {
    pub(crate) fn new(solution: Solution, solved: (Problem, Units), stop: Arc<AtomicBool>) -> Self {
        History { solution: Arc::new(solution), solved, stop }
    }

    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        query: impl FnOnce(&Solution) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let solution = self.solution.clone();
        run(py, &self.stop, move || query(&solution))
    }
}

#[pymethods]
impl History {
    /// `double`, `exact`, `digits` or `certified`; the end; why it is the end, the engine, and what was asked;
    /// warnings; `t₁`, the greatest speed, `L`, `c` and `g`.
    // Without long numbers there are no enclosures to have scales.
    #[allow(unreachable_code)]
    fn facts(&self) -> (&'static str, Cell, [String; 3], Vec<String>, [f64; 5]) {
        let (kind, first) = match &*self.solution {
            Solution::Double(_) => ("double", None),
            Solution::Exact(_) => ("exact", None),
            Solution::Digits(..) => ("digits", None),
            Solution::DigitsAfter(_, n, end) => ("digits", Some(format!("{end}; what follows is in {n} digits"))),
            Solution::Certified(..) => ("certified", None),
        };
        each!(&*self.solution, |history, digits| {
            let (plan, scales) = (history.plan(), history.scales());
            let about = [history.ending().to_string(), plan.engine.to_string(), plan.numbers.to_string()];
            let warnings = first.into_iter().chain(history.warnings().iter().map(ToString::to_string)).collect();
            let scales = [scales.time, scales.velocity, scales.length, scales.wave_speed, scales.gravity];
            (kind, cell(history.end(), *digits), about, warnings, scales.map(|x| Scalar::to_f64(&x)))
        })
    }

    /// The sheet of pictures that tells the scene, as SVG.
    fn sheet(&self, py: Python<'_>) -> PyResult<String> {
        let units = self.solved.1.clone();
        self.ask(py, move |solution| {
            each!(solution, |history, _| Drawing::default().draw(history, units)).map(|drawn| drawn.svg)
        })
    }

    /// The first and the last time of that sheet.
    fn span(&self, py: Python<'_>) -> PyResult<[f64; 2]> {
        self.ask(py, move |solution| each!(solution, |history, _| Drawing::default().drawn_span(history)))
    }

    fn error_estimate(&self) -> f64 {
        each!(&*self.solution, |history, _| history.error_estimate())
    }

    /// Kind and error of the time of each event.
    fn kinds(&self) -> (Vec<String>, Vec<f64>) {
        each!(&*self.solution, |history, _| {
            history.events().iter().map(|event| (event.kind.to_string(), event.t_error)).unzip()
        })
    }

    /// The columns of a table, by name.
    fn table(&self, py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<Vec<(&'static str, Found)>> {
        let table = one_of("table", table, &LISTS)?;
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let of = history.end().carry();
                let found = |(quantity, column): (Quantity, Vec<Option<_>>)| {
                    (quantity.name(), Found::of(column.iter().map(Option::as_ref), &of, *digits))
                };
                Ok(history.ask_table(table)?.into_iter().map(found).collect())
            })
        })
    }

    /// Derivatives by a value of the problem from the left and from the right, and how far each may be off.
    fn derivatives(&self, py: Python<'_>, by: &str, table: &Bound<'_, PyAny>) -> PyResult<Vec<(&'static str, Sides)>> {
        let by: Parameter = by.parse().map_err(refuse)?;
        let table = one_of("table", table, &LISTS)?;
        let with_material = self.solved.1.has_material();
        let listed = table.quantities().iter().copied().filter(|quantity| quantity.is_listed(with_material));
        let quantities: Vec<Quantity> = listed.collect();
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                Ok(sides(&history.derivatives(by, &quantities)?, &quantities, &history.end().carry(), *digits))
            })
        })
    }

    /// The same of columns at times, or of the field at points.
    fn derivatives_at(
        &self,
        py: Python<'_>,
        by: &str,
        names: Vec<String>,
        at: [Bound<'_, PyAny>; 2],
        side: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<(&'static str, Sides)>> {
        let by: Parameter = by.parse().map_err(refuse)?;
        let [times, points] = &at;
        let (times, points) = (places("time", times)?.numbers(), places("point", points)?.numbers());
        let needs = if points.is_empty() { Needs::Time } else { Needs::PointAndTime };
        let (quantities, side) = (named(&names, needs)?, side_of(side)?);
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let found = history.derivatives_at(by, &quantities, &times, &points, side)?;
                Ok(sides(&found, &quantities, &history.end().carry(), *digits))
            })
        })
    }

    /// Values of columns at times. Without a side a time has two rows where two limits differ.
    fn columns(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        times: &Bound<'_, PyAny>,
        side: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Found>> {
        let columns = named(&names, Needs::Time)?;
        let (times, side) = (places("time", times)?, side.map(side_of).transpose()?);
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let found = history.ask_columns(&columns, side, |motion| Ok(times.lift(motion)))?;
                Ok(Found::all(&found, &history.end().carry(), *digits))
            })
        })
    }

    /// `v`, `v_t`, `v_x` at each point at the time beside it.
    fn field(
        &self,
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<Found>> {
        let (points, times, side) = (places("point", points)?, places("time", times)?, side_of(side)?);
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let found = history.ask(
                    |motion| {
                        let mut columns = [vec![], vec![], vec![]];
                        for (point, time) in points.lift(motion).iter().zip(&times.lift(motion)) {
                            let field = motion.field(point, time, side)?;
                            for (column, x) in
                                columns.iter_mut().zip([field.displacement, field.velocity, field.strain])
                            {
                                column.push(x);
                            }
                        }
                        Ok(columns)
                    },
                    |columns| columns.iter().flatten().collect(),
                )?;
                Ok(Found::all(&found, &history.end().carry(), *digits))
            })
        })
    }

    /// `v`, `v_t`, `v_x` time by time, and there point by point or cell by cell.
    fn grid(
        &self,
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        side: &Bound<'_, PyAny>,
        kind: &Bound<'_, PyAny>,
    ) -> PyResult<Vec<Found>> {
        let (points, times, side) = (places("point", points)?, places("time", times)?, side_of(side)?);
        let kinds = [("points", Slice::Points), ("averages", Slice::Averages), ("p1", Slice::P1)];
        let slice = one_of("kind", kind, &kinds)?;
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let found = history.ask(
                    |motion| {
                        let (points, times) = (points.lift(motion), times.lift(motion));
                        Ok(slices(motion, slice, &points, &times, Some(side))?.split_off(3))
                    },
                    |columns| columns.iter().flatten().collect(),
                )?;
                Ok(Found::all(&found, &history.end().carry(), *digits))
            })
        })
    }
}

/// The columns of these names.
fn named(names: &[String], needs: Needs) -> PyResult<Vec<Quantity>> {
    let column = |name: &String| {
        let known = || needs.quantities().map(Quantity::name).collect::<Vec<_>>().join(", ");
        needs.named(name).ok_or_else(|| refuse(format!("found column {name}, expected one of {}", known())))
    };
    names.iter().map(column).collect()
}

/// Columns of derivatives of `quantities`.
fn sides<N: Scalar>(rows: &Derivatives<N>, quantities: &[Quantity], of: &N, digits: u32) -> Vec<(&'static str, Sides)> {
    let side = |k: usize, left: bool| {
        let value = |row: &Vec<Option<Derivative<N>>>| {
            let [a, b] = row.get(k)?.as_ref()?.sides();
            if left { a } else { b }.ok().cloned()
        };
        let values: Vec<Option<N>> = rows.iter().map(value).collect();
        let bounds = values.iter().map(|x| x.as_ref().map_or(f64::NAN, |x| x.log2_error().exp2())).collect();
        (Found::of(values.iter().map(Option::as_ref), of, digits), Found::Doubles(bounds))
    };
    quantities.iter().enumerate().map(|(k, q)| (q.name(), [side(k, true), side(k, false)])).collect()
}

fn side_of(side: &Bound<'_, PyAny>) -> PyResult<Side> {
    one_of("side", side, &[("left", Side::Left), ("right", Side::Right)])
}
