//! The values of the scene that explain data best.

use serde::Serialize;

use super::agree::Agreement;
use super::least::{Least, least};
use super::model::{Model, solved};
use super::norms::{Compared, Grid};
use super::ours::Ours;
use crate::error::Error;
use crate::problem::{Parameter, Problem};
use crate::quantity::Quantity;
use crate::solve::History;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct FittedValue {
    pub(crate) name: String,
    pub(crate) scene: f64,
    pub(crate) value: f64,
    /// Its standard error, from what remains.
    pub(crate) error: f64,
}

#[derive(Debug)]
pub(crate) struct Fit {
    pub(crate) values: Vec<FittedValue>,
    pub(crate) steps: usize,
    pub(crate) settled: bool,
    pub(crate) history: History<f64>,
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    #[error(
        "found {0} to be fitted, expected one that the scene has: a material, a start above the ground, an impact, \
         or points of a start"
    )]
    Absent(String),
    #[error("found {samples} values in the data, expected more than the {unknowns} that are to be fitted")]
    TooFew { samples: usize, unknowns: usize },
    #[error("found data that do not tell {0} apart, expected fewer values to be fitted, or more columns")]
    NotTold(String),
}

/// So many samples of a column are fitted at most.
const SAMPLES: usize = 4000;
/// So many steps a fit takes at most, in all.
const STEPS: usize = 20;
/// The share of a value that difference quotients are taken over: the root of the accuracy of the values.
const WIDTH: f64 = 1e-6;

/// Residuals of a problem; derivatives are taken of it.
type Residuals<'a> = &'a dyn Fn(&Problem) -> Option<Vec<f64>>;

fn varied(problem: &Problem, parameters: &[Parameter], values: &[f64]) -> Option<Problem> {
    let set = |problem: Problem, (parameter, value): (&Parameter, &f64)| parameter.set(&problem, *value).ok();
    parameters.iter().zip(values).try_fold(problem.clone(), set)
}

impl Fit {
    /// The values of `parameters` that explain `columns` best, from those of the problem of `ours`.
    ///
    /// **Source**: Levenberg and Marquardt's method in three stages, the residuals of the first two as in `model`: up
    /// to the second impact, then over all times, then sample by sample where no jump is within two steps. In the last
    /// stage each column weighs by what remained of it.
    pub(super) fn of(
        ours: &Ours<'_>,
        agreement: &Agreement,
        parameters: &[Parameter],
    ) -> Result<Result<Self, FitError>, Error> {
        let problem = ours.history.problem();
        if let Some(absent) = parameters.iter().find(|parameter| parameter.value(problem).is_none()) {
            return Ok(Err(FitError::Absent(absent.to_string())));
        }
        let start: Vec<f64> = parameters.iter().filter_map(|parameter| parameter.value(problem)).collect();
        let (history, grid, columns) = (ours.history, &agreement.grid, &agreement.quantities);
        let samples = grid.times.len() * columns.len();
        if samples <= parameters.len() {
            return Ok(Err(FitError::TooFew { samples, unknowns: parameters.len() }));
        }
        let scales = history.scales();
        let scale = |(parameter, value): (&Parameter, &f64)| match parameter {
            _ if *value != 0.0 => value.abs(),
            Parameter::Damping => 0.01 / scales.time,
            Parameter::Gravity => scales.velocity / scales.time,
            Parameter::Gap => scales.velocity * scales.time,
            _ => scales.velocity,
        };
        let sizes: Vec<f64> = parameters.iter().zip(&start).map(scale).collect();
        let release = history.contacts().iter().find_map(|contact| contact.to).unwrap_or(f64::INFINITY);
        let second = history.events().iter().map(|event| event.time).find(|time| *time > release);
        let last = grid.times.last().copied().unwrap_or_default();
        let (mut values, mut left) = (start.clone(), STEPS);
        let run = |values: &[f64], most: usize, residuals: Residuals<'_>| {
            let of = |values: &[f64]| residuals(&varied(problem, parameters, values)?);
            // Difference quotients of our own runs. What is left out on either side of one has none.
            let linear = |values: &[f64], now: &[f64]| {
                let by = |i: usize| {
                    let mut next = values.to_vec();
                    next[i] += WIDTH * sizes[i];
                    let (width, next) = (next[i] - values[i], of(&next)?);
                    let slope =
                        |(now, next): (&f64, &f64)| if (next - now).is_nan() { 0.0 } else { (next - now) / width };
                    Some(now.iter().zip(&next).map(slope).collect())
                };
                (0..values.len()).map(by).collect()
            };
            least(values, &sizes, (most, columns.len()), of, linear)
        };
        // Up to the second impact, and over all times.
        for until in [second.unwrap_or(last), last] {
            let model = Model::of(ours, agreement, until, SAMPLES / 10)?;
            let residuals = |problem: &Problem| Some(model.errors(&model.values(problem, |time| time).ok()?).concat());
            // The start may be far from the data; half a dozen steps bring it near. What only later times or the
            // samples one by one tell is left for them.
            if let Some(found) = run(&values, left.min(STEPS / 3), &residuals) {
                (values, left) = (found.values, left - found.steps);
            }
        }
        let near = varied(problem, parameters, &values).unwrap_or_else(|| problem.clone());
        let stride = grid.times.len().div_ceil(SAMPLES);
        let weights = pointwise(&near, columns, &grid.times, (stride, agreement.step), None)?;
        let weights: Vec<f64> = weights.iter().map(|column| rms(column)).collect();
        let residuals = |problem: &Problem| {
            let all = pointwise(problem, columns, &grid.times, (stride, agreement.step), Some(&weights)).ok()?;
            Some(all.concat())
        };
        let Some(Least { values, errors, steps, settled }) = run(&values, left, &residuals) else {
            let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
            return Ok(Err(FitError::NotTold(names.join(", "))));
        };
        let problem = varied(problem, parameters, &values).unwrap_or(near);
        let history = solved(&problem, last)?;
        let fitted = |k: usize| FittedValue {
            name: parameters[k].to_string(),
            scene: start[k],
            value: values[k],
            error: errors[k],
        };
        let values = (0..parameters.len()).map(fitted).collect();
        Ok(Ok(Fit { values, steps: STEPS - left + steps, settled, history }))
    }
}

fn rms(values: &[f64]) -> f64 {
    let told = values.iter().filter(|value| !value.is_nan());
    let (sum, count) = told.fold((0.0, 0.0), |(sum, count), value| (sum + value * value, count + 1.0));
    if count > 0.0 && sum > 0.0 { f64::sqrt(sum / count) } else { 1.0 }
}

/// `theirs − ours` of each column at every `stride`-th sample, divided by its weight; no number within two steps of a
/// jump.
fn pointwise(
    problem: &Problem,
    columns: &[Compared],
    times: &[f64],
    (stride, step): (usize, f64),
    weights: Option<&[f64]>,
) -> Result<Vec<Vec<f64>>, Error> {
    let history = solved(problem, times.last().copied().unwrap_or_default())?;
    let ours = Ours::of(&history)?;
    let kept: Vec<f64> = times.iter().copied().step_by(stride).collect();
    let grid = Grid::new(kept, None);
    let whats: Vec<Quantity> = columns.iter().map(|column| column.what).collect();
    let all = ours.values(&whats, &grid)?;
    let of = |((column, values), place): ((&Compared, Vec<f64>), usize)| {
        let weight = weights.map_or(1.0, |weights| weights[place]);
        let passing = ours.passing(column.what, &grid);
        let error = |k: usize| match passing.get(k) {
            Some(jump) if (jump - grid.times[k]).abs() <= 2.0 * step => f64::NAN,
            _ => (column.theirs[k * stride] - values[k]) / weight,
        };
        (0..grid.times.len()).map(error).collect()
    };
    Ok(columns.iter().zip(all).zip(0..).map(of).collect())
}
