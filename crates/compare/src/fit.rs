//! The values of the scene that explain data best, by least squares.

use schemars::JsonSchema;
use serde::Serialize;

use super::agreement::Agreement;
use super::least_squares::{LeastSquares, least_squares};
use super::model::{Model, derivatives, solve_beyond};
use super::norms::{ComparedColumn, Grid};
use super::reference::Reference;
use dalembert::Error;
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::Quantity;
use dalembert::solve::TypedHistory;

/// A value of the scene as it was fitted.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct FittedValue {
    pub(crate) name: String,
    /// The value in the scene.
    pub(crate) scene: f64,
    pub(crate) value: f64,
    /// The standard error, from the scatter of the residuals. It does not contain the shift by the error of a scheme.
    pub(crate) error: f64,
}

/// The result of a fit.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct Fit {
    pub(crate) values: Vec<FittedValue>,
    pub(crate) steps: usize,
    pub(crate) settled: bool,
    /// The correlation of the residuals of neighbouring samples: near zero for noise, near one for the error of a
    /// scheme, whose shift of the values is not in their standard errors. Null where all residuals are zero.
    pub(crate) correlation: Option<f64>,
    /// The history with the fitted values.
    #[serde(skip)]
    pub(crate) history: TypedHistory<f64>,
}

/// The reason why values cannot be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
pub enum FitError {
    #[error(
        "found {0} to be fitted, expected one that the scene has: a material, a start above the ground, an impact, \
         points of a start, or for the stiffness a ground or joint with one"
    )]
    Absent(String),
    #[error("found {samples} values in the data, expected more than the {unknowns} that are to be fitted")]
    TooFew { samples: usize, unknowns: usize },
    #[error("found data that do not tell {0} apart, expected fewer values to be fitted, or more columns")]
    NotTold(String),
}

/// Largest number of samples of a column in a fit.
const SAMPLES: usize = 4000;
/// Largest number of steps of a fit, in all stages.
const STEPS: usize = 20;
/// Share of a value over which a difference quotient is taken: the root of the accuracy of the values.
const WIDTH: f64 = 1e-6;

/// The residuals of a stage of a fit, by columns; NaN for samples that are left out.
trait Residuals {
    /// Returns the residuals in `problem`; `None` where that has no answer.
    fn residuals(&self, problem: &Problem) -> Option<Vec<f64>>;

    /// Returns the derivatives of the residuals by a value of the problem of `history`; `None` where the library has
    /// none.
    fn derivatives(&self, history: &TypedHistory<f64>, by: Parameter) -> Option<Vec<f64>>;
}

/// The residuals of the first two stages: those of a [`Model`].
impl Residuals for Model<'_> {
    fn residuals(&self, problem: &Problem) -> Option<Vec<f64>> {
        Some(self.errors(&self.values(problem, |time| time).ok()?).concat())
    }

    fn derivatives(&self, history: &TypedHistory<f64>, by: Parameter) -> Option<Vec<f64>> {
        let slopes = self.derivatives(history, by)?.concat();
        Some(slopes.into_iter().map(|slope| -slope).collect())
    }
}

/// The residuals of the last stage: every `stride`-th sample that is more than two steps away from a jump.
struct Pointwise<'a> {
    columns: &'a [ComparedColumn],
    grid: Grid,
    stride: usize,
    step: f64,
    /// The weight of each column.
    weights: Vec<f64>,
}

impl<'a> Pointwise<'a> {
    fn new(agreement: &'a Agreement) -> Self {
        let (times, columns) = (&agreement.grid.times, agreement.quantities.as_slice());
        let stride = times.len().div_ceil(SAMPLES);
        let grid = Grid::new(times.iter().copied().step_by(stride).collect(), None);
        Pointwise { columns, grid, stride, step: agreement.step, weights: vec![1.0; columns.len()] }
    }

    fn quantities(&self) -> Vec<Quantity> {
        self.columns.iter().map(|column| column.what).collect()
    }

    fn last(&self) -> f64 {
        self.grid.times.last().copied().unwrap_or_default()
    }

    /// Returns the residuals of each column.
    fn by_column(&self, problem: &Problem) -> Result<Vec<Vec<f64>>, Error> {
        let history = solve_beyond(problem, self.last())?;
        let reference = Reference::new(&history)?;
        let all = reference.values(&self.quantities(), &self.grid)?;
        let residuals = |((column, values), weight): ((&ComparedColumn, Vec<f64>), &f64)| {
            let rays = reference.nearest_rays(column.what, &self.grid);
            let residual = |k: usize| match rays.get(k) {
                Some(ray) if (ray - self.grid.times[k]).abs() <= 2.0 * self.step => f64::NAN,
                _ => (column.theirs[k * self.stride] - values[k]) / weight,
            };
            (0..self.grid.times.len()).map(residual).collect()
        };
        Ok(self.columns.iter().zip(all).zip(&self.weights).map(residuals).collect())
    }

    /// Returns the same residuals, those of each column divided by their root mean square in `problem`.
    fn weighted(self, problem: &Problem) -> Result<Self, Error> {
        let weights = self.by_column(problem)?.iter().map(|column| root_mean_square(column)).collect();
        Ok(Pointwise { weights, ..self })
    }
}

impl Residuals for Pointwise<'_> {
    fn residuals(&self, problem: &Problem) -> Option<Vec<f64>> {
        Some(self.by_column(problem).ok()?.concat())
    }

    fn derivatives(&self, history: &TypedHistory<f64>, by: Parameter) -> Option<Vec<f64>> {
        let all = derivatives(history, by, &self.quantities(), &self.grid.times)?;
        let scaled = |(slopes, weight): (Vec<f64>, &f64)| slopes.into_iter().map(|slope| -slope / weight).collect();
        Some(all.into_iter().zip(&self.weights).map(scaled).collect::<Vec<Vec<f64>>>().concat())
    }
}

/// Returns the correlation of neighbouring values of the columns that are both numbers; `None` where all are zero.
fn correlation(columns: &[Vec<f64>]) -> Option<f64> {
    let pairs = columns.iter().flat_map(|column| column.windows(2)).filter(|pair| !(pair[0] * pair[1]).is_nan());
    let (mut products, mut squares) = (0.0, 0.0);
    for pair in pairs {
        products += pair[0] * pair[1];
        squares += f64::midpoint(pair[0] * pair[0], pair[1] * pair[1]);
    }
    (squares > 0.0).then(|| products / squares)
}

/// Returns the root of the mean square of the values that are numbers; 1 where it is zero.
fn root_mean_square(values: &[f64]) -> f64 {
    let numbers = values.iter().filter(|value| !value.is_nan());
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), value| (sum + value * value, count + 1.0));
    if count > 0.0 && sum > 0.0 { f64::sqrt(sum / count) } else { 1.0 }
}

/// The unknowns of a fit.
struct Unknowns<'a> {
    problem: &'a Problem,
    parameters: &'a [Parameter],
    /// The natural size of each value.
    sizes: Vec<f64>,
    columns: usize,
    /// The end of the data.
    last: f64,
}

impl Unknowns<'_> {
    fn problem_with(&self, values: &[f64]) -> Option<Problem> {
        let set = |problem: Problem, (parameter, value): (&Parameter, &f64)| parameter.set(&problem, *value).ok();
        self.parameters.iter().zip(values).try_fold(self.problem.clone(), set)
    }

    /// Returns the derivatives of the residuals, which are `now`, by each unknown: those of the library where it has
    /// them, otherwise difference quotients. A sample that is left out on either side has the quotient zero.
    fn slopes(&self, stage: &dyn Residuals, values: &[f64], now: &[f64]) -> Option<Vec<Vec<f64>>> {
        let history = solve_beyond(&self.problem_with(values)?, self.last).ok();
        let quotient = |i: usize| {
            let mut next = values.to_vec();
            next[i] += WIDTH * self.sizes[i];
            let (width, next) = (next[i] - values[i], stage.residuals(&self.problem_with(&next)?)?);
            let slope = |(now, next): (&f64, &f64)| if (next - now).is_nan() { 0.0 } else { (next - now) / width };
            Some(now.iter().zip(&next).map(slope).collect())
        };
        let slope = |i: usize| {
            let exact = history.as_ref().and_then(|history| stage.derivatives(history, self.parameters[i]));
            exact.or_else(|| quotient(i))
        };
        (0..values.len()).map(slope).collect()
    }

    /// Minimises the residuals of a stage from `values` in at most `steps` steps.
    fn minimize(&self, stage: &dyn Residuals, values: &[f64], steps: usize) -> Option<LeastSquares> {
        let residuals = |values: &[f64]| stage.residuals(&self.problem_with(values)?);
        let slopes = |values: &[f64], now: &[f64]| self.slopes(stage, values, now);
        least_squares(values, &self.sizes, self.columns, steps, residuals, slopes)
    }
}

impl Fit {
    /// Finds the values of `parameters` that explain the data best, from those of the problem of `reference`.
    ///
    /// **Source**: the method of Levenberg and Marquardt in three stages: with the signals of a [`Model`] up to the
    /// second impact, then over all times, then sample by sample where no jump is within two steps. In the last stage
    /// each column is divided by the root mean square of its residuals.
    pub(super) fn new(
        reference: &Reference<'_>,
        agreement: &Agreement,
        parameters: &[Parameter],
    ) -> Result<Result<Self, FitError>, Error> {
        let history = reference.history;
        let problem = history.problem();
        if let Some(absent) = parameters.iter().find(|parameter| parameter.value(problem).is_none()) {
            return Ok(Err(FitError::Absent(absent.to_string())));
        }
        let start: Vec<f64> = parameters.iter().filter_map(|parameter| parameter.value(problem)).collect();
        let columns = agreement.quantities.len();
        let samples = agreement.grid.times.len() * columns;
        if samples <= parameters.len() {
            return Ok(Err(FitError::TooFew { samples, unknowns: parameters.len() }));
        }
        let scales = history.scales();
        let size = |(parameter, value): (&Parameter, &f64)| match parameter {
            _ if *value != 0.0 => value.abs(),
            Parameter::Damping => 0.01 / scales.time,
            Parameter::Gravity => scales.velocity / scales.time,
            Parameter::Gap => scales.velocity * scales.time,
            _ => scales.velocity,
        };
        let sizes = parameters.iter().zip(&start).map(size).collect();
        let last = agreement.grid.times.last().copied().unwrap_or_default();
        let unknowns = Unknowns { problem, parameters, sizes, columns, last };
        let release = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
        let second = history.events().iter().map(|event| event.t).find(|time| *time > release);
        let (mut values, mut left) = (start.clone(), STEPS);
        for until in [second.unwrap_or(last), last] {
            let model = Model::new(reference, agreement, until, SAMPLES / 10)?;
            // Half a dozen steps bring a start that is far from the data near them. Values that only later times or
            // single samples determine are left to the next stage.
            if let Some(found) = unknowns.minimize(&model, &values, left.min(STEPS / 3)) {
                (values, left) = (found.values, left - found.steps);
            }
        }
        let near = unknowns.problem_with(&values).unwrap_or_else(|| problem.clone());
        let stage = Pointwise::new(agreement).weighted(&near)?;
        let Some(LeastSquares { values, errors, steps, settled }) = unknowns.minimize(&stage, &values, left) else {
            let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
            return Ok(Err(FitError::NotTold(names.join(", "))));
        };
        let best = unknowns.problem_with(&values).unwrap_or(near);
        let correlation = correlation(&stage.by_column(&best)?);
        let history = solve_beyond(&best, last)?;
        let fitted = |k: usize| FittedValue {
            name: parameters[k].to_string(),
            scene: start[k],
            value: values[k],
            error: errors[k],
        };
        let values = (0..parameters.len()).map(fitted).collect();
        Ok(Ok(Fit { values, steps: STEPS - left + steps, settled, correlation, history }))
    }
}
