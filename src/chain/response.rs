//! Bounds of the response of a linear system that takes up no energy, element by element.
//!
//! For `x′ = Ax` with `xᵀAx ≤ 0`, these are bounds of `sup |e^{At}|` and `∫ |e^{At}| dt`. The matrices `e^{At}` at
//! times that double each time come from squares; the bounds over twice a time from `e^{A(t+s)} = e^{At} e^{As}`.

/// A square matrix by rows.
type Matrix = Vec<Vec<f64>>;

/// Bounds of the response of a system that decays.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Response {
    /// `sup |e^{At}|` over all times.
    pub(super) peak: Matrix,
    /// `∫₀^∞ |e^{At}| dt`.
    pub(super) integral: Matrix,
    /// A time after which `|e^{At}|` is within `left`.
    pub(super) time: f64,
    pub(super) left: Matrix,
}

/// Greatest product of `|A|` and the first time.
const FIRST: f64 = 1.0 / 16.0;

/// Terms of the series over the first time.
const TERMS: usize = 16;

/// Bound of the terms that are left out, `2 · 16⁻¹⁷/17!`.
const TAIL: f64 = 1e-34;

/// Greatest number of times that the first time is doubled.
const MOST_DOUBLINGS: usize = 60;

/// Row sum of `|e^{At}|` at which the rest of the integral is a geometric series.
const SMALL: f64 = 1.0 / 64.0;

/// Applies a function to the elements of two matrices.
fn each(a: &Matrix, b: &Matrix, f: impl Fn(f64, f64) -> f64) -> Matrix {
    a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect()).collect()
}

/// Returns the product of two matrices.
fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let row = |row: &Vec<f64>| (0..b.len()).map(|j| row.iter().zip(b).map(|(x, b)| x * b[j]).sum()).collect();
    a.iter().map(row).collect()
}

/// Returns the smaller elements of both products: exponentials of one matrix commute, and so do the bounds.
fn after(a: &Matrix, b: &Matrix) -> Matrix {
    each(&product(a, b), &product(b, a), f64::min)
}

/// Returns the matrix times a factor.
fn times(a: &Matrix, factor: f64) -> Matrix {
    a.iter().map(|row| row.iter().map(|x| x * factor).collect()).collect()
}

/// Returns the absolute values.
fn magnitudes(a: &Matrix) -> Matrix {
    a.iter().map(|row| row.iter().map(|x| x.abs()).collect()).collect()
}

/// Returns the greatest sum of a row of absolute values.
fn norm(a: &Matrix) -> f64 {
    a.iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
}

/// Returns the unit matrix.
fn unit(count: usize) -> Matrix {
    (0..count).map(|i| (0..count).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}

impl Response {
    /// Returns bounds of the response of a system that takes up no energy; `None` if it does not decay within a number
    /// of doublings, or is not finite. The elements of `a` may be off by a few roundings.
    ///
    /// **Accuracy**: upper bounds. A matrix is carried with a bound of the error of each element: that of a square is
    /// `|E|δ + δ|E| + δ²` and its roundings, `(n + 2) u |E||E|`. Each bound is raised by more than its own roundings.
    pub(super) fn new(a: &Matrix) -> Option<Response> {
        let count = a.len();
        let size = norm(a);
        if size == 0.0 || !a.iter().flatten().all(|x| x.is_finite()) || !size.is_finite() {
            return None;
        }
        let roundings = (count as f64 + 4.0) * f64::EPSILON;
        let up = 1.0 + 4.0 * roundings * TERMS as f64;
        let mut time = FIRST / size;
        let step = times(a, time);
        // `e^{At}`, `e^{|A|t}` and `∫ e^{|A|s} ds` over the first time.
        let mut exponential = unit(count);
        let [mut peak, mut integral] = [unit(count), times(&unit(count), time)];
        let (mut term, mut whole) = (unit(count), unit(count));
        for k in 1..=TERMS {
            term = times(&product(&step, &term), 1.0 / k as f64);
            whole = times(&product(&magnitudes(&step), &whole), 1.0 / k as f64);
            exponential = each(&exponential, &term, |sum, term| sum + term);
            peak = each(&peak, &whole, |sum, term| sum + term);
            integral = each(&integral, &whole, |sum, term| sum + term * time / (k + 1) as f64);
        }
        let mut error = each(&peak, &peak, |x, _| x * 4.0 * roundings * TERMS as f64 + TAIL);
        let within = |x: f64| if x > 1.0 { 1.0 } else { x };
        peak = peak.iter().map(|row| row.iter().map(|x| within(x * up)).collect()).collect();
        integral = times(&integral, up);
        for _ in 0..MOST_DOUBLINGS {
            let bound = each(&magnitudes(&exponential), &error, |x, error| within((x + error) * up));
            if norm(&bound) <= SMALL {
                return Some(Response::decayed(peak, integral, (time, bound), up));
            }
            integral = each(&integral, &after(&bound, &integral), |near, far| (near + far) * up);
            peak = each(&peak, &after(&bound, &peak), |near, far| within(near.max(far * up)));
            let known = magnitudes(&exponential);
            let crossed = each(&product(&known, &error), &product(&error, &known), |a, b| a + b);
            let rounded = times(&product(&known, &known), roundings);
            let squared = each(&product(&error, &error), &rounded, |a, b| a + b);
            error = each(&crossed, &squared, |a, b| (a + b) * up);
            exponential = product(&exponential, &exponential);
            time *= 2.0;
        }
        None
    }

    /// Returns the response of a system of which no more than `bound` is left after a time: `Σ Bᵏ ∫` is the integral
    /// over all times.
    fn decayed(peak: Matrix, integral: Matrix, (time, bound): (f64, Matrix), up: f64) -> Response {
        let (mut whole, mut more) = (integral.clone(), integral);
        for _ in 0..TERMS {
            more = after(&bound, &more);
            whole = each(&whole, &more, |sum, more| (sum + more) * up);
        }
        // The rest is less than the last term times `n Σ 64⁻ᵏ`.
        let rest = more.iter().flatten().copied().fold(0.0, f64::max) * more.len() as f64;
        let left = after(&bound, &peak);
        Response {
            integral: whole.into_iter().map(|row| row.into_iter().map(|x| x + rest).collect()).collect(),
            left: left.iter().map(|row| row.iter().map(|x| (x * up).min(1.0)).collect()).collect(),
            peak,
            time,
        }
    }
}
