//! Answers: histories, read in columns.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use dalembert::number::{DOUBLE_DIGITS, show};
use dalembert::quantity::{energy_shares, restitution};
use dalembert::solve::Target;
use dalembert::{Answer, Error, Motion, Number, Scalar, Side, Solution};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::problem::number;
use super::run;

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

/// A row of a table: `None` where there is no such number.
type Row = Vec<Option<Cell>>;

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
        query: impl FnOnce(&Solution, &AtomicBool) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let (solution, stop) = (self.solution.clone(), self.stop.clone());
        run(py, &self.stop, move || query(&solution, &stop))
    }
}

#[pymethods]
impl History {
    /// `double`, `exact`, `digits` or `certified`.
    fn kind(&self) -> &'static str {
        match &*self.solution {
            Solution::Double(_) => "double",
            Solution::Exact(_) => "exact",
            Solution::Digits(..) | Solution::DigitsAfter(..) => "digits",
            Solution::Certified(..) => "certified",
        }
    }

    fn end(&self) -> Cell {
        each!(&*self.solution, |history, digits| cell(history.end(), digits))
    }

    fn ending(&self) -> String {
        each!(&*self.solution, |history, _digits| history.ending().to_string())
    }

    fn plan(&self) -> (String, String) {
        each!(&*self.solution, |history, _digits| (
            history.plan().engine.to_string(),
            history.plan().numbers.to_string()
        ))
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = each!(&*self.solution, |history, _digits| history.warnings());
        if let Solution::DigitsAfter(_, digits, end) = &*self.solution {
            warnings.insert(0, format!("{end}; what follows is in {digits} digits"));
        }
        warnings
    }

    fn error_estimate(&self) -> f64 {
        each!(&*self.solution, |history, _digits| history.error_estimate())
    }

    /// `t₁`, the greatest speed, `L`, `c` and `g`.
    fn scales(&self) -> [f64; 5] {
        each!(&*self.solution, |history, _digits| {
            let scales = history.scales();
            [scales.time, scales.velocity, scales.length, scales.wave_speed, scales.gravity].map(|x| x.to_f64())
        })
    }

    /// Rows of kind, error of the time, and time, end velocity, centre, centre velocity.
    fn events(&self, py: Python<'_>) -> PyResult<Vec<(String, f64, Row)>> {
        self.ask(py, |solution, _| each!(solution, |history, digits| events(history, digits)))
    }

    /// Rows of `part`.
    fn table(&self, py: Python<'_>, part: String) -> PyResult<Vec<Row>> {
        self.ask(py, move |solution, _| {
            each!(solution, |history, digits| match part.as_str() {
                "contacts" => contacts(history, digits),
                "restitution" => coefficients(history, digits),
                "flights" => flights(history, digits),
                _ => stress_pieces(history, digits),
            })
        })
    }

    /// Values of `quantity`, one list for each of its numbers, time by time and there point by point.
    fn sample(
        &self,
        py: Python<'_>,
        quantity: &str,
        times: Vec<Bound<'_, PyAny>>,
        points: Vec<Bound<'_, PyAny>>,
        side: &str,
    ) -> PyResult<Vec<Vec<Cell>>> {
        let (quantity, side) = (Quantity::of(quantity)?, side_of(side)?);
        let times = times.iter().map(|time| number("time", time)).collect::<PyResult<Vec<_>>>()?;
        let points = points.iter().map(|point| number("point", point)).collect::<PyResult<Vec<_>>>()?;
        self.ask(py, move |solution, stop| {
            each!(solution, |history, digits| {
                let columns = sample(history, (quantity, side), (&times, &points), stop, exactly)?;
                Ok(columns.iter().map(|column| column.iter().map(|x| cell(x, digits)).collect()).collect())
            })
        })
    }

    /// The same of a history in doubles.
    fn sample_doubles<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        times: PyReadonlyArray1<'py, f64>,
        points: PyReadonlyArray1<'py, f64>,
        side: &str,
    ) -> PyResult<Vec<Bound<'py, PyArray1<f64>>>> {
        let (quantity, side) = (Quantity::of(quantity)?, side_of(side)?);
        let (times, points) = (times.as_slice()?.to_vec(), points.as_slice()?.to_vec());
        let columns = self.ask(py, move |solution, stop| {
            let Solution::Double(history) = solution else { return Err(Error::NoMultiprecision) };
            let lift = |x: &f64, _: &dyn Motion<_>| x.carry();
            let columns = sample(history, (quantity, side), (&times, &points), stop, lift)?;
            Ok(columns
                .into_iter()
                .map(|column| column.into_iter().map(f64::strip).collect())
                .collect::<Vec<Vec<f64>>>())
        })?;
        Ok(columns.into_iter().map(|column| PyArray1::from_vec(py, column)).collect())
    }
}

#[derive(Clone, Copy)]
enum Quantity {
    Strain,
    Ground,
    Top,
    Centre,
    Energy,
    Field,
}

impl Quantity {
    fn of(name: &str) -> PyResult<Self> {
        Ok(match name {
            "strain" => Quantity::Strain,
            "ground" => Quantity::Ground,
            "top" => Quantity::Top,
            "centre" => Quantity::Centre,
            "energy" => Quantity::Energy,
            "field" => Quantity::Field,
            _ => return Err(PyValueError::new_err(format!("found no quantity called {name}"))),
        })
    }

    fn width(self) -> usize {
        match self {
            Quantity::Strain => 1,
            Quantity::Ground | Quantity::Top | Quantity::Centre => 2,
            Quantity::Energy | Quantity::Field => 3,
        }
    }
}

fn side_of(side: &str) -> PyResult<Side> {
    match side {
        "left" => Ok(Side::Left),
        "right" => Ok(Side::Right),
        _ => Err(PyValueError::new_err(format!("found side = '{side}', expected 'left' or 'right'"))),
    }
}

/// A number in the precision of an attempt.
fn exactly<N: Scalar>(number: &Number, motion: &dyn Motion<N>) -> N {
    N::from_number(number, &motion.end().precision())
}

/// Values of a quantity, one list for each of its numbers, settled together.
fn sample<S: Target, T>(
    history: &dalembert::History<S>,
    (quantity, side): (Quantity, Side),
    (times, points): (&[T], &[T]),
    stop: &AtomicBool,
    lift: impl Fn(&T, &dyn Motion<S::Carried>) -> S::Carried,
) -> Result<Vec<Vec<S::Carried>>, Error> {
    let query = |motion: &dyn Motion<S::Carried>| {
        let mut columns: Vec<Vec<S::Carried>> = vec![Vec::new(); quantity.width()];
        let mut take = |values: &[&S::Carried]| {
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push((*value).clone()));
        };
        for time in times {
            if stop.load(Ordering::Relaxed) {
                return Err(Error::Interrupted);
            }
            let time = lift(time, motion);
            let pair = |(a, b)| [a, b];
            match quantity {
                Quantity::Strain => take(&[&motion.stress(&time, side)?]),
                Quantity::Ground => take(&pair(motion.ground_end(&time, side)?).each_ref()),
                Quantity::Top => take(&pair(motion.top_end(&time, side)?).each_ref()),
                Quantity::Centre => take(&pair(motion.centre(&time)?).each_ref()),
                Quantity::Energy => {
                    let energy = motion.energy(&time)?;
                    take(&[&energy.total, &energy.translational, &energy.vibrational]);
                }
                Quantity::Field => {
                    for point in points {
                        let field = motion.field(&lift(point, motion), &time, side)?;
                        take(&[&field.displacement, &field.velocity, &field.strain]);
                    }
                }
            }
        }
        Ok(columns)
    };
    history.ask(query, |columns| columns.iter().flatten().collect())
}

fn events<S: Target>(history: &dalembert::History<S>, digits: u32) -> Result<Vec<(String, f64, Row)>, Error> {
    let found = history.ask(
        |motion| Ok(motion.events().to_vec()),
        |events| events.iter().flat_map(|e| [&e.time, &e.end_velocity, &e.centre, &e.centre_velocity]).collect(),
    )?;
    let row = |e: &dalembert::Event<S::Carried>| {
        [&e.time, &e.end_velocity, &e.centre, &e.centre_velocity].map(|x| Some(cell(x, digits))).into()
    };
    Ok(found.iter().map(|event| (event.kind.to_string(), event.time_error, row(event))).collect())
}

/// Settles and shows rows of numbers.
fn rows<S: Target>(
    history: &dalembert::History<S>,
    digits: u32,
    query: impl Fn(&dyn Motion<S::Carried>) -> Result<Vec<Vec<Option<S::Carried>>>, Error>,
) -> Result<Vec<Row>, Error> {
    let found = history.ask(query, |rows| rows.iter().flatten().flatten().collect())?;
    Ok(found.iter().map(|row| row.iter().map(|x| x.as_ref().map(|x| cell(x, digits))).collect()).collect())
}

/// `from`, `to`, impulse, peak strain.
fn contacts<S: Target>(history: &dalembert::History<S>, digits: u32) -> Result<Vec<Row>, Error> {
    rows(history, digits, |motion| {
        let row = |c: &dalembert::Contact<S::Carried>| {
            let c = c.clone();
            vec![Some(c.from), c.to, Some(c.impulse), Some(c.peak_stress)]
        };
        Ok(motion.contacts().iter().map(row).collect())
    })
}

/// `e_P`, `e_E²` and the two factors of the latter, of every contact.
fn coefficients<S: Target>(history: &dalembert::History<S>, digits: u32) -> Result<Vec<Row>, Error> {
    rows(history, digits, |motion| {
        let row = |contact: &dalembert::Contact<S::Carried>| {
            let (e, shares) = (restitution(motion, contact)?, energy_shares(motion, contact)?);
            Ok(vec![e.momentum.ok(), e.energy_squared.ok(), shares.translational, shares.kept])
        };
        motion.contacts().iter().map(row).collect()
    })
}

/// `from`, `to`, and where and how high the centre of mass turns.
fn flights<S: Target>(history: &dalembert::History<S>, digits: u32) -> Result<Vec<Row>, Error> {
    rows(history, digits, |motion| {
        let flights = dalembert::quantity::flights(motion)?.into_iter();
        let row = |flight: dalembert::Flight<S::Carried>| {
            let (time, height) = flight.highest.unzip();
            vec![Some(flight.from), flight.to, time, height]
        };
        Ok(flights.map(row).collect())
    })
}

/// `from`, `to`, the strain at both, and the Chebyshev coefficients where it is not linear.
fn stress_pieces<S: Target>(history: &dalembert::History<S>, digits: u32) -> Result<Vec<Row>, Error> {
    rows(history, digits, |motion| {
        let row = |piece: dalembert::StressPiece<S::Carried>| {
            let ends = [piece.from, piece.to, piece.left, piece.right].into_iter();
            ends.chain(piece.chebyshev).map(Some).collect()
        };
        Ok(motion.stress_pieces().into_iter().map(row).collect())
    })
}
