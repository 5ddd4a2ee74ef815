//! Gauss–Legendre nodes and weights in any precision.

use super::bits;
use crate::number::{Analytic, Float};

/// Computes the `n` nodes of Gauss–Legendre quadrature on `[−1,1]`, ascending, each with its weight.
///
/// **Source**: Newton's method on `P_n`, from Tricomi's `cos(π(4i−1)/(4n+2))`, which lies in the basin of its root for
/// every `n`; the weight is `2/((1−x²) P_n′(x)²)`.
///
/// **Accuracy**: for numbers that round, nodes within eight roundings of 1, weights within eight roundings of 1 plus
/// n + 16 of their own; [`Special::gauss_legendre`](super::Special::gauss_legendre) encloses them.
///
/// ```
/// let rule = dalembert::special::gauss_legendre(&1.0_f64, 2);
/// assert!((rule[1].0 - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15 && (rule[1].1 - 1.0).abs() < 1e-15);
/// ```
pub fn gauss_legendre<S: Analytic>(like: &S, n: usize) -> Vec<(S, S)> {
    let one = like.one();
    let half = n.div_ceil(2);
    // Each step doubles the digits; the first guess has at least four bits.
    let steps = (bits(like) / 4.0).log2().ceil().max(1.0) as usize + 2;
    let mut upper = Vec::with_capacity(half);
    for i in 1..=half {
        if 2 * i == n + 1 {
            let (_, slope) = legendre(&one.zero(), n);
            upper.push((one.zero(), one.int(2) / slope.square()));
            continue;
        }
        let guess = (std::f64::consts::PI * (4 * i - 1) as f64 / (4 * n + 2) as f64).cos();
        let mut x = like.double(guess);
        for _ in 0..steps {
            let (value, slope) = legendre(&x, n);
            let step = value / slope;
            let small = step.to_f64().abs() < f64::EPSILON * x.to_f64().abs();
            x = x - step;
            if small && bits(like) <= 53.0 {
                break;
            }
        }
        let (_, slope) = legendre(&x, n);
        let weight = one.int(2) / ((one.clone() - &x) * &(one.clone() + &x) * &slope.square());
        upper.push((x, weight));
    }
    let mut rule: Vec<(S, S)> = upper.iter().map(|(x, w)| (-x.clone(), w.clone())).collect();
    rule.extend(upper.into_iter().rev().skip(n % 2));
    rule
}

/// Computes `P_n(x)` and `P_n′(x)`, n ≥ 1, by the three-term recurrence.
fn legendre<S: Analytic>(x: &S, n: usize) -> (S, S) {
    let (mut before, mut value) = (x.one(), x.clone());
    for k in 2..=n as i64 {
        let next = (x.int(2 * k - 1) * x * &value - x.int(k - 1) * &before) / x.int(k);
        before = std::mem::replace(&mut value, next);
    }
    let slope = (before - x.clone() * &value) * &x.int(n as i64) / ((x.one() - x) * &(x.one() + x));
    (value, slope)
}

/// Computes `P_n(x)` and `P_{n−1}(x)` in q bits, n ≥ 1, with one long product per step.
pub(super) fn step(x: &Float, n: usize, q: u32) -> (Float, Float) {
    let (mut before, mut value) = (Float::with_val(q, 1), Float::with_val(q, x));
    for k in 2..=n as u32 {
        before *= k - 1;
        let mut next = Float::with_val(q, &value * x);
        next *= 2 * k - 1;
        next -= &before;
        next /= k;
        before = std::mem::replace(&mut value, next);
    }
    (value, before)
}

#[cfg(test)]
#[path = "tests/gauss.rs"]
mod tests;
