//! Least squares in a few unknowns.

#[derive(Clone, Debug)]
pub(super) struct Least {
    pub(super) values: Vec<f64>,
    pub(super) errors: Vec<f64>,
    pub(super) steps: usize,
    /// Whether the last step was within rounding of the values.
    pub(super) settled: bool,
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
pub(super) fn least(
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
#[path = "tests/least.rs"]
mod tests;
