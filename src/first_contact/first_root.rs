//! First sign change of a smooth function on `[−1,1]`, from its Chebyshev coefficients and a bound of their truncation.

/// Result of the search for the first sign change from `+` to `−`.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FirstRoot {
    /// No sign change: the function is positive, except perhaps at its ends.
    None,
    /// Exactly one root in `[lo, hi]`, none before it, and a slope of at most `−slope` throughout.
    Between { lo: f64, hi: f64, slope: f64 },
    /// A place near which the function is not separated from zero.
    Unclear(f64),
}

/// Sign at a point: `Some(true)` above zero, `Some(false)` below, `None` unknown.
pub(super) type Sign = Option<bool>;

/// Computes the Chebyshev coefficients of the polynomial through `values` at `cos(πj/n)`, j = 0 … n.
pub(super) fn coefficients(values: &[f64]) -> Vec<f64> {
    let n = values.len().saturating_sub(1).max(1);
    let step = std::f64::consts::PI / n as f64;
    let cosines: Vec<f64> = (0..2 * n).map(|j| (step * j as f64).cos()).collect();
    let ends = |j: usize| if j == 0 || j == n { 0.5 } else { 1.0 };
    let term = |k: usize, j: usize| values[j] * cosines[(j * k) % (2 * n)] * ends(j);
    (0..values.len()).map(|k| (0..values.len()).map(|j| term(k, j)).sum::<f64>() * 2.0 / n as f64 * ends(k)).collect()
}

/// Computes the Chebyshev coefficients of the derivative: `d_{k−1} = d_{k+1} + 2k c_k`, the first one halved.
pub(super) fn derivative(sum: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; sum.len() + 1];
    for k in (1..sum.len()).rev() {
        result[k - 1] = result[k + 1] + 2.0 * k as f64 * sum[k];
    }
    result[0] *= 0.5;
    result.truncate(sum.len().saturating_sub(1).max(1));
    result
}

/// Computes Clenshaw's sum and its derivative.
pub(super) fn evaluate(coefficients: &[f64], x: f64) -> (f64, f64) {
    let (mut b1, mut b2, mut d1, mut d2) = (0.0, 0.0, 0.0, 0.0);
    for &c in coefficients.iter().skip(1).rev() {
        let d = 2.0 * b1 + 2.0 * x * d1 - d2;
        let b = c + 2.0 * x * b1 - b2;
        (d2, d1, b2, b1) = (d1, d, b1, b);
    }
    (coefficients.first().copied().unwrap_or(0.0) + x * b1 - b2, b1 + x * d1 - d2)
}

/// Finds the first sign change of a function whose distance from the Chebyshev sum is at most `error`; `sign` gives the
/// sign more accurately where the sum alone leaves it open.
///
/// `B = Σ |c_n| n²(n²−1)/3` bounds the sum's second derivative. On an interval of width w the sum stays above its
/// lesser end minus B w²/8, and its slope keeps its sign where |f′(middle)| > B w/2, less the difference of the slopes
/// of function and sum, at most `4(n+1)²·error`. This holds because the difference has two parts, whose bounds add up
/// to `error`. The part of rounded values is a polynomial of degree n, and by Markov's inequality its slope is n² times
/// its size. The other, of a function that is at most M on the ellipse ρ ≥ 5.8, is `Σ_{k>n} a_k (T_k − T_m)` with the
/// alias m ≤ n of k and `|a_k| ≤ 2Mρ^{−k}`: at most `4Mρ^{−n}/(ρ−1) = e`, and for n ≥ 8 its slope is at most `4M
/// Σ_{k>n} k² ρ^{−k} ≤ 4M(n+1)² ρ^{−n−1}/(1 − 1.27/5.8) < 1.3(n+1)² e`.
///
/// Intervals are treated from the left. Each begins with a plus, and none is skipped without proof, so no earlier root
/// is missed. The interval with the root is cut until the slope is known within a factor of two.
pub(super) fn first_root(sum: &[f64], error: f64, sign: impl Fn(f64) -> Sign) -> FirstRoot {
    let bend =
        (0u32..).zip(sum).map(|(n, c)| (f64::from(n).powi(4) - f64::from(n).powi(2)) * c.abs() / 3.0).sum::<f64>()
            * (1.0 + 1e-9);
    let steepness = 4.0 * (sum.len() * sum.len()) as f64 * error;
    let known = |x: f64| {
        let (value, _) = evaluate(sum, x);
        if value.abs() > error { Some(value > 0.0) } else { sign(x) }
    };
    if known(-1.0) != Some(true) {
        return FirstRoot::Unclear(-1.0);
    }
    let mut stack = vec![(-1.0f64, 1.0f64)];
    while let Some((lo, hi)) = stack.pop() {
        let width = hi - lo;
        let lowest = evaluate(sum, lo).0.min(evaluate(sum, hi).0) - bend * width * width / 8.0;
        if lowest > error {
            continue;
        }
        let slope = evaluate(sum, 0.5 * (lo + hi)).1.abs() - bend * width / 2.0 - steepness;
        if slope > 0.0 {
            match known(hi) {
                Some(true) => continue,
                Some(false) => {
                    // Cuts the interval until the slope is at least half of its middle value.
                    let (mut a, mut b, mut least) = (lo, hi, slope);
                    for _ in 0..40 {
                        let mid = 0.5 * (a + b);
                        let middle = evaluate(sum, mid).1.abs();
                        least = least.max(middle - bend * (b - a) / 2.0 - steepness);
                        if least >= 0.5 * middle {
                            break;
                        }
                        match known(mid) {
                            Some(true) => a = mid,
                            Some(false) => b = mid,
                            None => break,
                        }
                    }
                    return FirstRoot::Between { lo: a, hi: b, slope: least };
                }
                // The function falls towards a value that is not separated from zero.
                None => {}
            }
        }
        if width < 1e-9 {
            return FirstRoot::Unclear(lo);
        }
        // A cut where the function is not positive has a root to its left, and the left part is treated first.
        let cut = if known(0.5 * (lo + hi)).is_some() { 0.5 * (lo + hi) } else { lo + 0.381_966 * width };
        stack.push((cut, hi));
        stack.push((lo, cut));
    }
    FirstRoot::None
}

#[cfg(test)]
#[path = "tests/first_root.rs"]
mod tests;
