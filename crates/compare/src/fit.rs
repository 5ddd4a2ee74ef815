//! The values of the scene that explain data best, by least squares.

use serde::Serialize;

use super::agree::Agreement;
use super::model::{Model, solved};
use super::norms::{Compared, Grid};
use super::ours::Ours;
use dalembert::Error;
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::Quantity;
use dalembert::solve::TypedHistory;

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
    pub(crate) history: TypedHistory<f64>,
}

/// Why values cannot be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
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
        let release = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
        let second = history.events().iter().map(|event| event.t).find(|time| *time > release);
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

#[derive(Clone, Debug)]
struct Least {
    values: Vec<f64>,
    errors: Vec<f64>,
    steps: usize,
    /// Whether the last step was within rounding of the values.
    settled: bool,
}

/// Derivatives are known to about 1e-6: what is left of the square of one, when those before it are taken out, is
/// rounding below this share.
const TOLD: f64 = 1e-11;

/// Stretches of samples whose errors are taken for independent.
const BATCHES: usize = 20;

/// Solves `A x = b` of a symmetric positive matrix, by Cholesky's decomposition; `None` where it is none.
fn solve(matrix: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    let count = right.len();
    let mut lower = vec![vec![0.0; count]; count];
    for i in 0..count {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest: f64 = matrix[i][j] - sum;
            lower[i][j] = match i == j {
                true if rest > TOLD * matrix[i][i] => rest.sqrt(),
                true => return None,
                false => rest / lower[j][j],
            };
        }
    }
    let mut x = right.to_vec();
    for i in 0..count {
        x[i] = (x[i] - (0..i).map(|k| lower[i][k] * x[k]).sum::<f64>()) / lower[i][i];
    }
    for i in (0..count).rev() {
        x[i] = (x[i] - (i + 1..count).map(|k| lower[k][i] * x[k]).sum::<f64>()) / lower[i][i];
    }
    Some(x)
}

/// The values that leave the least of `Σ r²`, from `start` in at most `most` steps, by Levenberg and Marquardt's method
/// in unknowns divided by `scales`. `residuals` is `None` where there is no answer, and `linear` gives their
/// derivatives. What is no number is left out. `None` where the residuals do not tell the unknowns apart. They are
/// those of so many columns, one after the other.
///
/// **Accuracy**: a standard error is the greater of two: that of independent residuals of one size, from the normal
/// matrix, and that of the means of [`BATCHES`] stretches of samples, which is right where neighbours are off alike, as
/// by what a scheme does wrong. Both are the same for noise.
fn least(
    start: &[f64],
    scales: &[f64],
    (most, columns): (usize, usize),
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
    linear: impl Fn(&[f64], &[f64]) -> Option<Vec<Vec<f64>>>,
) -> Option<Least> {
    let square = |r: &[f64]| r.iter().filter(|r| !r.is_nan()).map(|r| r * r).sum::<f64>();
    let count = start.len();
    let mut values = start.to_vec();
    let mut now = residuals(&values)?;
    let (mut damping, mut settled, mut steps) = (0.0, false, 0);
    let mut normal = vec![vec![0.0; count]; count];
    let mut slopes = vec![vec![0.0; now.len()]; count];
    while steps < most && !settled {
        slopes = linear(&values, &now)?;
        let told = |pair: &(&f64, &f64)| !pair.1.is_nan();
        let dot =
            |i: usize, r: &[f64]| slopes[i].iter().zip(r).filter(told).map(|(a, b)| a * b).sum::<f64>() * scales[i];
        let row = |i: usize| (0..count).map(|j| dot(i, &slopes[j]) * scales[j]).collect();
        normal = (0..count).map(row).collect();
        let right: Vec<f64> = (0..count).map(|i| -dot(i, &now)).collect();
        solve(&normal, &right)?;
        steps += 1;
        let mut tries = 0;
        loop {
            let mut damped = normal.clone();
            (0..count).for_each(|i| damped[i][i] *= 1.0 + damping);
            let step = solve(&damped, &right)?;
            let next: Vec<f64> = (0..count).map(|i| values[i] + step[i] * scales[i]).collect();
            let small = step.iter().all(|step| step.abs() <= 1e-12);
            match residuals(&next) {
                Some(tried) if square(&tried) <= square(&now) => {
                    (values, now, damping, settled) = (next, tried, damping / 10.0, small);
                    break;
                }
                // No better is to be had.
                _ if small || tries > 12 => {
                    settled = true;
                    break;
                }
                _ => (damping, tries) = ((damping * 10.0f64).max(1e-3), tries + 1),
            }
        }
    }
    let told = now.iter().filter(|r| !r.is_nan()).count();
    let variance = square(&now) / told.saturating_sub(count).max(1) as f64;
    let samples = (now.len() / columns).max(1);
    let batches = BATCHES.min(samples);
    let error = |i: usize| {
        let unit: Vec<f64> = (0..count).map(|j| f64::from(u8::from(i == j))).collect();
        let row = solve(&normal, &unit)?;
        // What each residual adds to the value, by stretches. Together they add nothing.
        let mut sums = vec![0.0; batches];
        for (k, residual) in now.iter().enumerate().filter(|(_, residual)| !residual.is_nan()) {
            let slope: f64 = (0..count).map(|j| row[j] * slopes[j][k] * scales[j]).sum();
            sums[k % samples * batches / samples] += slope * residual;
        }
        let together = square(&sums) * batches as f64 / batches.saturating_sub(1).max(1) as f64;
        Some((variance * row[i]).max(together).sqrt() * scales[i])
    };
    let errors = (0..count).map(error).collect::<Option<_>>()?;
    Some(Least { values, errors, steps, settled })
}

#[cfg(test)]
#[path = "tests/fit.rs"]
mod tests;
