//! Chebyshev series on the unit interval: integration, products with `x`, restriction, and the number of terms needed.

use std::sync::LazyLock;

use crate::number::Rounded;

/// Tables shared by all series of a solution. A series is `c₀ + c₁T₁(2x−1) + c₂T₂(2x−1) + …` on `0 ≤ x ≤ 1`.
#[derive(Clone, Debug)]
pub(super) struct Basis<S> {
    /// Chebyshev nodes in `0 … 1`.
    nodes: Vec<S>,
    /// `cos(πm/2N)`, `m = 0 … 4N−1`.
    cosines: Vec<S>,
    /// `1/4k`.
    quarter: Vec<S>,
    /// The series of `xᵏ`.
    pub(super) powers: Vec<Vec<S>>,
}

impl<S: Rounded> Basis<S> {
    /// Builds the tables for series of up to `size` terms and powers up to `x^terms`.
    pub(super) fn new(like: &S, size: usize, terms: usize) -> Self {
        let size = size.max(4);
        let whole = |n: usize| like.int(i64::try_from(n).unwrap_or(i64::MAX));
        let step = like.pi() / whole(2 * size);
        let cosines: Vec<S> = (0..4 * size).map(|m| (step.clone() * whole(m)).cos()).collect();
        let nodes = (0..size).map(|j| (cosines[2 * j + 1].clone() + like.one()) * like.ratio(1, 2)).collect();
        let quarter = (0..=size).map(|k| like.one() / whole(4 * k.max(1))).collect();
        let mut powers = vec![vec![like.one()]];
        for k in 0..terms {
            let mut next = powers[k].clone();
            next.push(like.zero());
            times_x(&mut next);
            powers.push(next);
        }
        Basis { nodes, cosines, quarter, powers }
    }

    /// Returns the maximum number of terms of a series.
    pub(super) fn size(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn nodes(&self) -> &[S] {
        &self.nodes
    }

    /// Computes the first `terms` coefficients of the interpolant through `values` at the nodes.
    pub(super) fn through(&self, values: &[S], terms: usize) -> Vec<S> {
        let size = self.size();
        let scale = self.nodes[0].ratio(2, i64::try_from(size).unwrap_or(i64::MAX));
        let coefficient = |k: usize| {
            let mut sum = self.nodes[0].zero();
            for (j, value) in values.iter().enumerate() {
                sum = sum + value.clone() * &self.cosines[k * (2 * j + 1) % (4 * size)];
            }
            let sum = sum * &scale;
            if k == 0 { sum * self.nodes[0].ratio(1, 2) } else { sum }
        };
        (0..terms.min(size)).map(coefficient).collect()
    }

    /// Computes the series on `from ≤ x ≤ to`, as a series on the unit interval.
    pub(super) fn restrict(&self, c: &[S], from: &S, to: &S, terms: usize) -> Vec<S> {
        let width = to.clone() - from;
        let values: Vec<S> = self.nodes.iter().map(|x| evaluate(c, &(width.clone() * x + from))).collect();
        self.through(&values, terms)
    }

    /// Integrates from 0 to x, in place; drops the term beyond the last one.
    pub(super) fn integrate(&self, c: &mut [S]) {
        let Some(first) = c.first() else { return };
        // 4k·b_k = c_{k−1} − c_{k+1}, with c₀ doubled; b₀ makes the value at x = 0 vanish.
        let mut below = first.clone() + first;
        let mut start = first.zero();
        for k in 1..c.len() {
            let difference = match c.get(k + 1) {
                Some(above) => below - above,
                None => below,
            };
            below = std::mem::replace(&mut c[k], difference * &self.quarter[k]);
            start = if k % 2 == 1 { start + &c[k] } else { start - &c[k] };
        }
        c[0] = start;
    }

    /// Computes `start + len ∫₀ˣ`; drops the term beyond the last one.
    pub(super) fn primitive(&self, c: &[S], len: &S, start: &S) -> Vec<S> {
        let mut area = c.to_vec();
        self.integrate(&mut area);
        scale(&mut area, len);
        area[0] = area[0].clone() + start;
        area
    }

    /// Computes the series of `e^{rate·x}` with `terms` terms, for `|rate|` up to about 2.
    pub(super) fn exponential(&self, rate: &S, terms: usize) -> Vec<S> {
        let values: Vec<S> = self.nodes.iter().map(|x| (x.clone() * rate).exp()).collect();
        self.through(&values, terms)
    }

    pub(super) fn product(&self, a: &[S], b: &[S], terms: usize) -> Vec<S> {
        let values: Vec<S> = self.nodes.iter().map(|x| evaluate(a, x) * evaluate(b, x)).collect();
        self.through(&values, terms)
    }
}

/// Adds `factor · series` to `target`, truncated to the length of `target`.
pub(super) fn add_scaled<S: Rounded>(target: &mut [S], series: &[S], factor: &S) {
    for (t, s) in target.iter_mut().zip(series) {
        *t = s.clone() * factor + &*t;
    }
}

/// Multiplies `series` by `factor`.
pub(super) fn scale<S: Rounded>(series: &mut [S], factor: &S) {
    for term in series {
        *term = factor.clone() * &*term;
    }
}

/// Multiplies by `x`, in place; drops the term beyond the last one.
pub(super) fn times_x<S: Rounded>(c: &mut [S]) {
    let Some(first) = c.first() else { return };
    let (half, quarter) = (first.ratio(1, 2), first.ratio(1, 4));
    let mut below = first.zero();
    for k in 0..c.len() {
        let above = c.get(k + 1).map_or_else(|| below.zero(), Clone::clone);
        // xT_k = T_k/2 + (T_{k+1} + T_{|k−1|})/4.
        let from_below = if k == 1 { below.clone() + &below } else { below };
        let here = c[k].clone() * &half + (from_below + above) * &quarter;
        below = std::mem::replace(&mut c[k], here);
    }
}

/// Evaluates a series at `x`, by Clenshaw's recurrence.
pub(super) fn evaluate<S: Rounded>(c: &[S], x: &S) -> S {
    let two_u = x.clone() * x.int(4) - x.int(2);
    let (mut b1, mut b2) = (x.zero(), x.zero());
    for k in (1..c.len()).rev() {
        let b0 = two_u.clone() * &b1 - &b2 + &c[k];
        b2 = std::mem::replace(&mut b1, b0);
    }
    match c.first() {
        Some(first) => two_u * x.ratio(1, 2) * b1 - b2 + first,
        None => b1,
    }
}

/// Evaluates a series at several points, as [`evaluate`] does; the recurrences run side by side, which lets the
/// processor vectorise those in doubles.
pub(super) fn evaluate_all<S: Rounded>(c: &[S], xs: &[S]) -> Vec<S> {
    let Some(first) = c.first() else { return xs.iter().map(S::zero).collect() };
    let mut states: Vec<[S; 3]> = xs.iter().map(|x| [x.clone() * x.int(4) - x.int(2), x.zero(), x.zero()]).collect();
    for term in c[1..].iter().rev() {
        for [two_u, b1, b2] in &mut states {
            let b0 = two_u.clone() * &*b1 - &*b2 + term;
            *b2 = std::mem::replace(b1, b0);
        }
    }
    states.into_iter().map(|[two_u, b1, b2]| two_u * first.ratio(1, 2) * b1 - b2 + first).collect()
}

pub(super) fn at_one<S: Rounded>(c: &[S], zero: &S) -> S {
    c.iter().fold(zero.clone(), |sum, term| sum + term)
}

pub(super) fn at_zero<S: Rounded>(c: &[S], zero: &S) -> S {
    c.iter().enumerate().fold(zero.clone(), |sum, (k, term)| if k % 2 == 0 { sum + term } else { sum - term })
}

pub(super) fn smaller<S: Rounded>(a: S, b: S) -> S {
    if b < a { b } else { a }
}

/// Computes `∫₀¹`: an even term of order k has the integral `1/(1 − k²)`.
pub(super) fn integral<S: Rounded>(c: &[S]) -> S {
    let first = &c[0];
    let even = c.iter().zip(0i64..).step_by(2).skip(1);
    even.fold(first.clone(), |sum, (term, k)| sum - term.clone() / first.int(k * k - 1))
}

/// Computes the derivative: `c′_{k−1} = c′_{k+1} + 4k c_k`, `c′₀` halved.
pub(super) fn derivative<S: Rounded>(c: &[S]) -> Vec<S> {
    let Some(first) = c.first() else { return Vec::new() };
    let mut d = vec![first.zero(); c.len().max(2) + 1];
    for k in (1..c.len()).rev() {
        d[k - 1] = d[k + 1].clone() + c[k].clone() * first.int(4 * i64::try_from(k).unwrap_or(0));
    }
    d[0] = d[0].clone() * first.ratio(1, 2);
    d.truncate(c.len().saturating_sub(1).max(1));
    d
}

/// Bounds a series on its interval by `Σ|c_k|` from `k = first` on, as a double.
pub(super) fn bound<S: Rounded>(c: &[S], first: usize) -> f64 {
    c.iter().skip(first).map(|term| term.to_f64().abs()).sum()
}

/// Bounds the distance of a series from its first term by `Σ_{k≥1}|c_k|`. In numbers longer than doubles this sum and
/// the first term may differ by less than the roundings of the sum, which are added; in doubles the bounds it is
/// compared with are greater.
pub(super) fn spread<S: Rounded>(c: &[S]) -> f64 {
    let sum = bound(c, 1);
    match c.first() {
        // A sum of n terms has an error of at most n/2 of its roundings, and each term one rounding of its own.
        Some(first) if first.log2_roundoff() < DOUBLE_BITS => {
            sum + (c.len() as f64 + 1.0) * f64::EPSILON * (sum + first.to_f64().abs())
        }
        _ => sum,
    }
}

const DOUBLE_BITS: f64 = -60.0;

/// Returns the number of Chebyshev terms that represent an entire function with `|f(s)| ≤ (a + b|s|) e^{θ|s|}` for
/// every complex `s` to `2^log2_accuracy` on `0 ≤ s ≤ 1`.
///
/// On the Bernstein ellipse of parameter `ρ > 1` around the unit interval `|s| ≤ σ = ½ + (ρ + 1/ρ)/4`, hence `|c_k| ≤
/// 2F ρ^{−k}` with `F = (a + bσ)e^{θσ}`, and the truncation error after `n` terms is at most `2F ρ^{−n}/(1 − 1/ρ)`. The
/// result is the smallest `n` over a grid of `ρ`: every `ρ` gives a valid bound.
pub(super) fn terms_for(a: f64, b: f64, theta: f64, log2_accuracy: f64) -> usize {
    let terms = on_ellipses(a, b, theta).map(|(log2_rho, log2_left)| (log2_left - log2_accuracy) / log2_rho);
    terms.fold(f64::INFINITY, f64::min).ceil().clamp(3.0, 4096.0) as usize
}

/// Bounds the truncation error after `terms` Chebyshev terms of such a function.
pub(super) fn left_by(terms: usize, a: f64, b: f64, theta: f64) -> f64 {
    let left = on_ellipses(a, b, theta).map(|(log2_rho, log2_left)| log2_left - terms as f64 * log2_rho);
    left.fold(f64::INFINITY, f64::min).exp2()
}

/// Returns `log₂ρ` and `log₂` of `2F/(1 − 1/ρ)` for a grid of ellipses.
fn on_ellipses(a: f64, b: f64, theta: f64) -> impl Iterator<Item = (f64, f64)> {
    ELLIPSES.iter().map(move |Ellipse { log2_rho, sigma, log2_rest }| {
        let log2_f = (a + b * sigma).log2() + theta * sigma * std::f64::consts::LOG2_E;
        (*log2_rho, 1.0 + log2_f - log2_rest)
    })
}

/// A Bernstein ellipse around the unit interval.
struct Ellipse {
    log2_rho: f64,
    /// Greatest `|s|` on the ellipse.
    sigma: f64,
    /// `log₂(1 − 1/ρ)`.
    log2_rest: f64,
}

static ELLIPSES: LazyLock<[Ellipse; 80]> = LazyLock::new(|| {
    std::array::from_fn(|j| {
        let log2_rho = (j as f64 + 1.0) * 0.25;
        let rho = log2_rho.exp2();
        let sigma = 0.5 + (rho + 1.0 / rho) / 4.0;
        Ellipse { log2_rho, sigma, log2_rest: (1.0 - 1.0 / rho).log2() }
    })
});

#[cfg(test)]
#[path = "tests/series.rs"]
mod tests;
