//! Answers: histories, read in columns.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use dalembert::number::{DOUBLE_DIGITS, show};
use dalembert::quantity::{energy_shares, flights, restitution};
use dalembert::solve::Target;
use dalembert::{Answer, Column, Error, Measure, Motion, Number, Scalar, Side, Solution, Units};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

use super::problem::number;
use super::{refuse, run};

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
        (None, None) => Cell::Text(show(x, if digits == 0 { DOUBLE_DIGITS } else { digits })),
    }
}

/// Numbers of one quantity.
enum Found {
    /// What is absent is no number.
    Doubles(Vec<f64>),
    Cells(Vec<Option<Cell>>),
}

impl Found {
    fn of<'a, N: Scalar>(values: impl Iterator<Item = Option<&'a N>>, of: &N, digits: u32) -> Self {
        if of.as_double().is_some() {
            return Found::Doubles(values.map(|x| x.and_then(Scalar::as_double).unwrap_or(f64::NAN)).collect());
        }
        Found::Cells(values.map(|x| x.map(|x| cell(x, digits))).collect())
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

/// Times or points as Python gives them: an array, which is for histories in doubles, or numbers of any type.
#[derive(FromPyObject)]
pub(crate) enum Given<'py> {
    Doubles(PyReadonlyArray1<'py, f64>),
    Numbers(Vec<Bound<'py, PyAny>>),
}

enum Places {
    Doubles(Vec<f64>),
    Numbers(Vec<Number>),
}

impl Given<'_> {
    fn read(&self, name: &str) -> PyResult<Places> {
        Ok(match self {
            Given::Doubles(list) => Places::Doubles(list.as_slice()?.to_vec()),
            Given::Numbers(list) => Places::Numbers(list.iter().map(|x| number(name, x)).collect::<PyResult<_>>()?),
        })
    }
}

impl Places {
    /// In the numbers of an attempt.
    fn lift<S: Target>(&self, history: &dalembert::History<S>, motion: &dyn Motion<S::Carried>) -> Vec<S::Carried> {
        let precision = motion.end().precision();
        match self {
            Places::Doubles(list) => list.iter().map(|x| history.end().double(*x).carry()).collect(),
            Places::Numbers(list) => list.iter().map(|x| S::Carried::from_number(x, &precision)).collect(),
        }
    }
}

/// Evaluates `$body` for the history inside `$solution`, whatever its numbers; `$digits` of them are to be given.
macro_rules! each {
    ($solution:expr, |$history:ident, $digits:ident| $body:expr) => {
        match $solution {
            Solution::Double($history) => each!(0, $digits, $body),
            Solution::Exact($history) => each!(0, $digits, $body),
            Solution::Digits($history, n) | Solution::DigitsAfter($history, n, _) => each!(*n, $digits, $body),
            Solution::Certified($history, n) => each!(*n, $digits, $body),
        }
    };
    ($n:expr, $digits:ident, $body:expr) => {{
        let $digits: u32 = $n;
        let _ = $digits;
        $body
    }};
}

/// What happened, and what can be asked of it.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct History {
    solution: Arc<Solution>,
    stop: Arc<AtomicBool>,
}

impl History {
    pub(crate) fn new(solution: Solution, stop: Arc<AtomicBool>) -> Self {
        History { solution: Arc::new(solution), stop }
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
            (kind, cell(history.end(), digits), about, warnings, scales.map(|x| x.to_f64()))
        })
    }

    fn error_estimate(&self) -> f64 {
        each!(&*self.solution, |history, _digits| history.error_estimate())
    }

    /// Whether stresses and forces have a unit.
    fn has_material(&self) -> bool {
        each!(&*self.solution, |history, _digits| history.units().has_material())
    }

    /// Kind and error of the time of each event.
    fn kinds(&self) -> Vec<(String, f64)> {
        each!(&*self.solution, |history, _digits| {
            history.events().iter().map(|event| (event.kind.to_string(), event.time_error)).collect()
        })
    }

    /// The columns of a table.
    fn table(&self, py: Python<'_>, part: String) -> PyResult<Vec<Found>> {
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let rows = history.ask(
                    |motion| rows(motion, &part, &history.units()),
                    |rows| rows.iter().flatten().flatten().collect(),
                )?;
                let of = history.end().carry();
                let column = |k: usize| Found::of(rows.iter().map(|row| row[k].as_ref()), &of, digits);
                Ok([0, 1, 2, 3].map(column).into())
            })
        })
    }

    /// Values of columns at times. Without a side a time has two rows where two limits differ.
    fn columns(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        times: Given<'_>,
        side: Option<&str>,
    ) -> PyResult<Vec<Found>> {
        let column = |name: &String| {
            let known = || Column::ALL.map(Column::name).join(", ");
            Column::named(name).ok_or_else(|| refuse(format!("found column {name}, expected one of {}", known())))
        };
        let columns = names.iter().map(column).collect::<PyResult<Vec<_>>>()?;
        let (times, side) = (times.read("time")?, side.map(side_of).transpose()?);
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let found = history.ask_columns(&columns, side, |motion| Ok(times.lift(history, motion)))?;
                Ok(Found::all(&found, &history.end().carry(), digits))
            })
        })
    }

    /// `v`, `v_t`, `v_x` time by time, and there point by point.
    fn field(&self, py: Python<'_>, points: Given<'_>, times: Given<'_>, side: &str) -> PyResult<Vec<Found>> {
        let (points, times, side) = (points.read("point")?, times.read("time")?, side_of(side)?);
        self.ask(py, move |solution| {
            each!(solution, |history, digits| {
                let query = |motion: &dyn Motion<_>| {
                    let points = points.lift(history, motion);
                    let mut columns = vec![Vec::new(); 3];
                    for time in times.lift(history, motion) {
                        for point in &points {
                            let field = motion.field(point, &time, side)?;
                            let values = [field.displacement, field.velocity, field.strain];
                            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
                        }
                    }
                    Ok(columns)
                };
                let found = history.ask(query, |columns| columns.iter().flatten().collect())?;
                Ok(Found::all(&found, &history.end().carry(), digits))
            })
        })
    }
}

fn side_of(side: &str) -> PyResult<Side> {
    match side {
        "left" => Ok(Side::Left),
        "right" => Ok(Side::Right),
        _ => Err(refuse(format!("found side = '{side}', expected 'left' or 'right'"))),
    }
}

/// The rows of a table.
fn rows<N: Scalar>(motion: &dyn Motion<N>, part: &str, units: &Units) -> Result<Vec<[Option<N>; 4]>, Error> {
    let (events, contacts) = (motion.events().iter().cloned(), motion.contacts().iter().cloned());
    let measured = |measure, x: &N| units.factor::<N>(measure, &x.precision()).map(|factor| x.clone() * factor);
    Ok(match part {
        "events" => events.map(|e| [e.time, e.end_velocity, e.centre, e.centre_velocity].map(Some)).collect(),
        "contacts" => {
            let impulse = |x: &N| measured(Measure::Impulse, x);
            contacts.map(|c| [Some(c.from), c.to, impulse(&c.impulse), Some(c.peak_strain)]).collect()
        }
        "peaks" => {
            let peaks = |peak: &N| [measured(Measure::Stress, peak), measured(Measure::Force, peak), None, None];
            contacts.map(|c| peaks(&c.peak_strain)).collect()
        }
        "restitution" => {
            let of = |contact| {
                let (e, shares) = (restitution(motion, &contact)?, energy_shares(motion, &contact)?);
                Ok([e.momentum.ok(), e.energy_squared.ok(), shares.translational, shares.kept])
            };
            contacts.map(of).collect::<Result<_, Error>>()?
        }
        "flights" => {
            let flights = flights(motion)?.into_iter().map(|f| (f.from, f.to, f.highest.unzip()));
            flights.map(|(from, to, (time, height))| [Some(from), to, time, height]).collect()
        }
        _ => motion.stress_pieces().into_iter().map(|p| [p.from, p.to, p.left, p.right].map(Some)).collect(),
    })
}
