//! Minimisation of a sum of squares by the method of Levenberg and Marquardt.

/// The result of a minimisation.
#[derive(Clone, Debug)]
pub(super) struct LeastSquares {
    pub(super) values: Vec<f64>,
    pub(super) errors: Vec<f64>,
    pub(super) steps: usize,
    /// Whether the last step was within rounding of the values.
    pub(super) settled: bool,
}

/// Share of the square of a derivative below which the part that is independent of the derivatives before it is
/// rounding; derivatives are known to about 1e-6.
const INDEPENDENT: f64 = 1e-11;

/// Number of stretches of samples whose errors are taken for independent.
const BATCHES: usize = 20;

/// Solves `A x = b` with a symmetric positive matrix by Cholesky's decomposition; `None` for other matrices.
fn solve(matrix: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    let count = right.len();
    let mut lower = vec![vec![0.0; count]; count];
    for i in 0..count {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest: f64 = matrix[i][j] - sum;
            lower[i][j] = match i == j {
                true if rest > INDEPENDENT * matrix[i][i] => rest.sqrt(),
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

/// Minimises `Σ r²` from `start` in at most `most` steps, by the method of Levenberg and Marquardt in unknowns divided
/// by `scales`. `residuals` returns those of so many `columns`, one after the other, or `None` where there is no
/// answer, and `linear` their derivatives; NaN is left out. `None` where the residuals do not determine the unknowns.
///
/// **Accuracy**: a standard error is the greater of two: that of independent residuals of one size, from the normal
/// matrix, and that of the means of [`BATCHES`] stretches of samples, which is right where neighbours have the same
/// error, as the error of a scheme. Both are the same for noise.
pub(super) fn least_squares(
    start: &[f64],
    scales: &[f64],
    columns: usize,
    most: usize,
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
    linear: impl Fn(&[f64], &[f64]) -> Option<Vec<Vec<f64>>>,
) -> Option<LeastSquares> {
    let count = start.len();
    let mut values = start.to_vec();
    let mut now = residuals(&values)?;
    let (mut damping, mut settled, mut steps) = (0.0, false, 0);
    let mut normal = vec![vec![0.0; count]; count];
    let mut slopes = vec![vec![0.0; now.len()]; count];
    while steps < most && !settled {
        slopes = linear(&values, &now)?;
        // Slopes at samples that are left out do not count either.
        let kept: Vec<usize> = (0..now.len()).filter(|k| !now[*k].is_nan()).collect();
        let dot = |i: usize, r: &[f64]| kept.iter().map(|k| slopes[i][*k] * r[*k]).sum::<f64>() * scales[i];
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
            let is_small = step.iter().all(|step| step.abs() <= 1e-12);
            match residuals(&next) {
                Some(tried) if sum_of_squares(&tried) <= sum_of_squares(&now) => {
                    (values, now, damping, settled) = (next, tried, damping / 10.0, is_small);
                    break;
                }
                // No step is better.
                _ if is_small || tries > 12 => {
                    settled = true;
                    break;
                }
                _ => (damping, tries) = ((damping * 10.0f64).max(1e-3), tries + 1),
            }
        }
    }
    let errors = standard_errors(&normal, &slopes, scales, &now, columns)?;
    Some(LeastSquares { values, errors, steps, settled })
}

/// Computes the standard errors of unknowns with this normal matrix from the residuals, which are those of so many
/// `columns`, and their `slopes`.
fn standard_errors(
    normal: &[Vec<f64>],
    slopes: &[Vec<f64>],
    scales: &[f64],
    residuals: &[f64],
    columns: usize,
) -> Option<Vec<f64>> {
    let count = scales.len();
    let kept = residuals.iter().filter(|r| !r.is_nan()).count();
    let variance = sum_of_squares(residuals) / kept.saturating_sub(count).max(1) as f64;
    let samples = (residuals.len() / columns).max(1);
    let batches = BATCHES.min(samples);
    let error = |i: usize| {
        let unit: Vec<f64> = (0..count).map(|j| f64::from(u8::from(i == j))).collect();
        let row = solve(normal, &unit)?;
        // The part of the value that each stretch of residuals adds. All together add nothing.
        let mut sums = vec![0.0; batches];
        for (k, residual) in residuals.iter().enumerate().filter(|(_, residual)| !residual.is_nan()) {
            let slope: f64 = (0..count).map(|j| row[j] * slopes[j][k] * scales[j]).sum();
            sums[k % samples * batches / samples] += slope * residual;
        }
        let together = sum_of_squares(&sums) * batches as f64 / batches.saturating_sub(1).max(1) as f64;
        Some((variance * row[i]).max(together).sqrt() * scales[i])
    };
    (0..count).map(error).collect()
}

/// Returns the sum of the squares of the values that are numbers.
fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().filter(|value| !value.is_nan()).map(|value| value * value).sum()
}

#[cfg(test)]
#[path = "tests/least_squares.rs"]
mod tests;
