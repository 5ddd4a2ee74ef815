//! Defect of one step of a run: the difference between the state stored after the step and the exact image of the state
//! stored before it, bounded from the sizes of stored coefficients alone.
//!
//! **Rounding.** A step is a chain of sums and products of its inputs with constants. If no path from an input to the
//! result has more than n roundings of u each, the error of the result is at most `1.01 n u` times the same chain of
//! absolute values, as long as `n u < 0.01`. Sums of absolute coefficients do not grow by integration from 0 to x or by
//! a product with `x` or `xᵏ`, and bound a function on its interval. **Truncation.** The coefficients that integration,
//! products and interpolation drop follow from the same recurrences in absolute values; the remainders of Riemann's and
//! Taylor's sums are added. `docs/proofs.md` lists all constants.

use super::cell::{Cell, terms};
use super::leap::LeapCount;
use super::march::{Medium, Segment, State};
use super::series::{bound, left_by};
use crate::number::Rounded;
use crate::special::RoundedSpecial;

/// Bound of the underflow of doubles in a step; far below a rounding of the longest numbers that are allowed.
const FLOOR: f64 = 1e-290;
/// Upper bound of `Σ yᵏ/k!` for `y ≤ 1`.
const E: f64 = 3.0;

/// Bounds of the defects of steps in a medium.
#[derive(Clone, Debug)]
pub(super) struct Steps {
    pub(super) unit: f64,
    kappa: f64,
    log2_accuracy: f64,
    /// Maximum number of terms of a series.
    pub(super) size: f64,
    /// Truncation errors, by number of terms, of the weights that give `h′` and `z(0)`.
    weights: Vec<f64>,
    /// Truncation errors, by number of terms, of `e^{κs} h′` along a characteristic.
    falls: Vec<f64>,
}

pub(super) fn sizes<S: Rounded>(c: &[S]) -> Vec<f64> {
    c.iter().map(|term| term.to_f64().abs()).collect()
}

/// Integrates absolute values from 0 to x, and returns a bound of the dropped term as a function.
fn integrate(c: &mut [f64]) -> f64 {
    let n = c.len();
    let left = c[n - 1] / n as f64;
    let (mut below, mut start) = (2.0 * c[0], 0.0);
    for k in 1..n {
        let sum = below + c.get(k + 1).unwrap_or(&0.0);
        below = std::mem::replace(&mut c[k], sum / (4.0 * k as f64));
        start += c[k];
    }
    c[0] = start;
    left
}

/// Multiplies absolute values by x, and returns the dropped term.
fn times_x(c: &mut [f64]) -> f64 {
    let left = c.last().map_or(0.0, |last| last / 2.0);
    let mut below = 0.0;
    for k in 0..c.len() {
        let above = c.get(k + 1).copied().unwrap_or(0.0);
        let from_below = if k == 1 { 2.0 * below } else { below };
        below = std::mem::replace(&mut c[k], 0.0);
        c[k] = below / 2.0 + (from_below + above) / 4.0;
    }
    left
}

/// Computes `Σ_{i+j ≥ from} |a_i||b_j|`, where `rest` bounds the sum of the terms of `b` from an index on.
fn beyond(a: &[f64], rest: impl Fn(usize) -> f64, from: usize) -> f64 {
    a.iter().enumerate().map(|(i, a)| a * rest(from.saturating_sub(i))).sum()
}

/// Bounds the error, in roundings, of a value of the series with coefficients of these sizes.
///
/// Clenshaw's recurrence `b_k = 2y b_{k+1} − b_{k+2} + c_k`, `|y| ≤ 1`, rounds by `6|b_{k+1}| + 2|b_{k+2}| + |c_k|` at
/// most, which is equivalent to an error of `c_k`; with `|b_k| ≤ Σ_{j≥k} (j−k+1)|c_j|` the sum is `Σ (2j+1)²|c_j|`. A
/// node is off by 15 roundings, where `T_j(2x−1)` has slopes of `2j²`.
fn values(c: &[f64]) -> f64 {
    c.iter().enumerate().map(|(j, c)| (38.0 * (j * j) as f64 + 1.0) * c).sum()
}

/// Bounds the sum of the coefficients of `e^{z x}` from the n-th on, `|z| ≤ 2`: `|c_k| ≤ 2e^{|z|} (|z|/4)ᵏ/k!`, each at
/// most half of the one before.
fn exponential_rest(z: f64, n: usize) -> f64 {
    let mut term = 4.0 * z.abs().exp();
    for k in 1..=n {
        term *= z.abs() / (4.0 * k as f64);
    }
    term
}

impl Steps {
    pub(super) fn of<S: RoundedSpecial>(medium: &Medium<S>) -> Self {
        let (kappa, size) = (medium.kappa.to_f64(), medium.basis.size());
        let depth = kappa * medium.longest.to_f64();
        let grown = (4.0 * depth).exp();
        let weights = (0..=size).map(|n| left_by(n, 1.5 * grown, grown, 3.0 * depth)).collect();
        let falls = (0..=size).map(|n| left_by(n, 1.5, 1.0, depth)).collect();
        let log2_accuracy = medium.log2_accuracy;
        Steps { unit: medium.kappa.unit(), kappa, log2_accuracy, size: size as f64, weights, falls }
    }

    fn accuracy(&self) -> f64 {
        self.log2_accuracy.exp2()
    }

    /// Bounds the error of coefficients through values of size `most`, each off by `roundings` roundings of it.
    fn through(&self, most: f64, roundings: f64) -> f64 {
        2.0 * self.size * (self.size + 64.0 + roundings) * self.unit * most
    }

    /// Bounds the error of a series through values of another on part of its interval, each off by [`values`].
    fn anew(&self, c: &[f64]) -> f64 {
        let size: f64 = c.iter().sum();
        2.0 * self.size * self.unit * values(c) + self.through(size, 0.0)
    }

    fn product(&self, (a, of_a): (&[f64], f64), (b, of_b): (&[f64], f64)) -> f64 {
        2.0 * self.size * self.unit * (of_b * values(a) + of_a * values(b)) + self.through(of_a * of_b, 0.0)
    }

    /// Bounds the defect of both outgoing sides of a cell; also returns the size of the greater incoming side.
    pub(super) fn cell<S: RoundedSpecial>(&self, medium: &Medium<S>, cell: &Cell<'_, S>) -> (f64, f64) {
        let y = cell.depth.0.to_f64() * cell.depth.1.to_f64();
        let count = terms(y, self.log2_accuracy).min(medium.basis.powers.len() - 1);
        let (mut p, mut q) = (sizes(&cell.p), sizes(&cell.q));
        let (of_p, of_q): (f64, f64) = (p.iter().sum(), q.iter().sum());
        let (short_p, short_q) = (p.len(), q.len());
        // The missing part of J^{k+1}, and its value at the end, at most 1/(k+1)! of the data, enter with yᵏ/k! or
        // less.
        let (mut left, mut factor, mut whole) = (self.accuracy() * (of_p + of_q), 1.0, 1.0);
        for k in 0..=count {
            left += 2.0 * E * factor * (integrate(&mut p) + integrate(&mut q));
            whole /= (k + 1) as f64;
            // Powers with more terms than the side.
            for (short, other) in [(short_p, of_q), (short_q, of_p)] {
                if k >= short {
                    left += factor * whole * other * bound(&medium.basis.powers[k], short);
                }
            }
            factor *= y / (k + 1) as f64;
        }
        let paths = (count as f64 + 2.0) * (self.size + 24.0);
        let offset = cell.offset.to_f64().abs();
        let shifted = if offset > 0.0 { 2.0 * self.grown(offset, cell.depth.0.to_f64(), short_p) } else { 0.0 };
        (left + 2.0 * E * paths * self.unit * (of_p + of_q) + shifted + FLOOR, of_p.max(of_q))
    }

    /// Bounds the error of `factor · e^{z x}` in n terms.
    fn grown(&self, factor: f64, z: f64, n: usize) -> f64 {
        factor * (3.0 * exponential_rest(z, n) + self.through(E, 32.0))
    }

    pub(super) fn joining(&self, least: f64, size: f64) -> f64 {
        least * size + self.through(38.0 * self.size * size, 0.0)
    }

    /// Bounds the defect of cutting a segment, apart from the truncation of the two parts.
    pub(super) fn cut<S: RoundedSpecial>(&self, segment: &Segment<S>) -> f64 {
        2.0 * self.anew(&sizes(&segment.q)) + FLOOR
    }

    pub(super) fn trace<S: RoundedSpecial>(&self, medium: &Medium<S>, segment: &Segment<S>, contact: bool) -> f64 {
        let depth = self.kappa * segment.len.to_f64();
        let offset = if contact { 0.0 } else { medium.offset.to_f64().abs() };
        let mut u = sizes(&segment.q);
        let mut off = FLOOR;
        if offset > 0.0 {
            off += self.grown(offset, depth, u.len());
            for (k, c) in u.iter_mut().enumerate() {
                *c += offset * exponential_rest(depth, k);
            }
        }
        u.resize(u.len().max(medium.terms(&segment.len, 2.0)), 0.0);
        let norm: f64 = u.iter().sum();
        let y = depth * depth;
        let count = terms(y, self.log2_accuracy).min(medium.basis.powers.len() - 1);
        let mut sum = vec![0.0; u.len()];
        let mut layers = Vec::with_capacity(count + 1);
        // A layer enters with yᵏ/k!, and the missing part of the next one with κ len of that.
        let mut factor = 1.0;
        for k in 0..=count {
            let mut next = u.clone();
            off += 2.0 * E * factor * depth * integrate(&mut next);
            for (u, next) in u.iter_mut().zip(&next) {
                *u += depth * next;
            }
            layers.push((std::mem::replace(&mut u, next), factor));
            factor *= y / (k + 1) as f64;
        }
        for (k, (layer, factor)) in layers.into_iter().enumerate().rev() {
            if k < count {
                let next = y / (k + 1) as f64;
                off += E * factor * next * times_x(&mut sum);
                sum.iter_mut().for_each(|c| *c *= next);
            }
            sum.iter_mut().zip(layer).for_each(|(sum, c)| *sum += c);
        }
        off += 2.0 * self.accuracy() * norm + 2.0 * E * (count as f64 + 2.0) * (self.size + 24.0) * self.unit * norm;
        // The product with e^{−2κ len x}, truncated to `kept` terms.
        let rest = |n: usize| exponential_rest(2.0 * depth, n);
        let kept = medium.terms(&segment.len, 4.0);
        let lost = beyond(&sum, rest, kept) + 3.0 * rest(self.size as usize) * norm;
        let of_sum: f64 = sum.iter().sum();
        let decay: Vec<f64> = (0..self.size as usize).map(|n| 0.5 * rest(n)).collect();
        let product = self.product((&sum, of_sum), (&decay, E * E)) + self.through(E * E * of_sum, 64.0);
        off + 2.0 * lost + product + 4.0 * self.unit * medium.slope.to_f64().abs()
    }

    /// Bounds the error of `h′` and of `h` over a strip, whose first terms have the size `first`.
    pub(super) fn rigid(&self, len: f64, first: f64) -> f64 {
        let fall = 4.0 * self.kappa * len;
        let n = self.size as usize;
        // The series of x^k ends with 2^{1−2k}, which bounds Taylor's terms beyond the series.
        let beyond = (1..n).fold(64.0, |term, k| term * fall / (4.0 * k as f64));
        first * fall.exp() * (self.accuracy() + beyond + 16.0 * (self.size + 16.0).powi(2) * self.unit) + FLOOR
    }

    /// Bounds the error of `h′` or `z(0)` as weighted means of `q`, which may contain functions of size `shifts`.
    pub(super) fn weighed<S: RoundedSpecial>(&self, state: &State<S>, shifts: f64) -> f64 {
        let n = self.size as usize;
        let rest = |n: usize| self.weights[n];
        let whole = self.weights[0];
        let of = |segment: &Segment<S>| {
            let q = sizes(&segment.q);
            let shifted: f64 = (0..q.len()).map(|j| shifts * self.falls[j] * self.weights[n - j]).sum();
            let norm = q.iter().sum::<f64>() + 2.0 * shifts * self.falls[0];
            let product = self.product((&q, norm), (&self.weights, whole)) + self.through(whole * norm, 64.0);
            let off = 4.0 * (beyond(&q, rest, n) + shifted) + product;
            off * segment.len.to_f64()
        };
        2.0 * state.segments.iter().map(of).sum::<f64>() + FLOOR
    }

    /// Bounds the defect of adding functions of x of this size to `q`.
    pub(super) fn shift<S: RoundedSpecial>(&self, state: &State<S>, size: f64) -> f64 {
        let of = |segment: &Segment<S>| {
            let len = segment.len.to_f64();
            3.0 * size * left_by(segment.q.len(), 1.5, len, self.kappa * len)
                + self.through(8.0 * size, 128.0)
                + 2.0 * self.unit * bound(&segment.q, 0)
        };
        state.segments.iter().map(of).sum::<f64>() + FLOOR
    }

    /// Bounds the defect of the first state, through values that are rounded data of this size over pieces of the rod
    /// no shorter than `least`.
    pub(super) fn start<S: RoundedSpecial>(&self, state: &State<S>, size: f64, least: f64) -> f64 {
        let size = 64.0 * size;
        let of = |segment: &Segment<S>| {
            let depth = self.kappa * segment.len.to_f64();
            3.0 * left_by(segment.q.len(), size, size, depth) + self.through(size, 512.0 + 16.0 / least)
        };
        2.0 * state.segments.iter().map(of).sum::<f64>() + FLOOR
    }

    /// Bounds the factor by which a leap amplifies `|q|` and the height it is given: the sum of its parts in absolute
    /// values, where an antiderivative of mean zero is at most half of a function.
    fn gain(&self, count: &LeapCount, trips: f64) -> f64 {
        let r = 2.0 * self.kappa;
        let lag = 2.0 * (1.0 - (1.0 - r * r / 4.0).max(0.0).sqrt());
        let (mut turn, mut term) = (1.0, 1.0);
        for m in 1..=count.order {
            term *= (2.0 * m as f64 - 1.0) / (2.0 * m as f64) * r * r / 4.0;
            turn += term;
        }
        64.0 * turn * (4.0 * self.kappa + lag * (1.0 + trips)).exp()
    }

    /// Bounds the defect of a leap from a state of this size; `stray` bounds its remaining `h′` and the height's error.
    pub(super) fn leap(&self, count: &LeapCount, trips: f64, (segments, size): (usize, f64), stray: f64) -> f64 {
        let (n, order, layers) = (self.size, count.order as f64, count.layers as f64);
        let powers = count.powers as f64;
        // The antiderivatives from q to Z and back are added to those that the circle counts.
        let integrals = count.integrals + 4.0;
        let paths = 64.0 * n * (segments as f64 + 3.0) * (n + 8.0) * integrals + powers * (order + 8.0);
        let left = 64.0 * (trips + layers + 16.0) * self.accuracy() + self.passed(count.powers, trips);
        self.gain(count, trips) * ((paths * self.unit + left) * size + count.dropped * (1.0 + size) + stray) + FLOOR
    }

    /// Bounds the truncation of `e^{nG}` after `powers` powers of `D⁻¹`: by Cauchy's estimate on a circle within `1/R`,
    /// with `‖D⁻ᵏ‖ ≤ 1.39 · 0.18ᵏ`.
    fn passed(&self, powers: usize, trips: f64) -> f64 {
        const INVERSE: f64 = 0.18;
        let r = 2.0 * self.kappa;
        let on = |part: f64| {
            let (ratio, square) = (INVERSE * r / part, part * part);
            let grown = trips * r * (1.0 - (1.0 - square).sqrt()) / part;
            grown * std::f64::consts::LOG2_E + (powers as f64 + 1.0) * ratio.log2() - (1.0 - ratio).log2()
        };
        let parts = (1..64).map(|k| f64::from(k) / 64.0).chain([0.99, 0.999]).filter(|part| *part > 2.0 * INVERSE * r);
        2.0 * parts.map(on).fold(f64::INFINITY, f64::min).exp2()
    }
}

#[cfg(test)]
#[path = "tests/defect.rs"]
mod tests;
