//! Special functions of enclosures: the function of the middle, with its proved bound as the width.

use super::bessel::Special;
use super::estimated::BoundedSpecial;
use super::gauss::{gauss_legendre, step};
use super::ray::{Ray, RaySums};
use crate::number::float::{Round, down, rounded, up};
use crate::number::{Estimate, Float, Interval, Scalar};

/// Returns the middle with the radius as its bound.
fn estimate(x: &Interval) -> Estimate<Float> {
    x.estimate(x.lo().prec())
}

impl Special for Interval {
    fn in_scaled(&self, n: u32) -> Self {
        Interval::within(&estimate(self).in_scaled(n))
    }

    fn ray_start(ray: &Ray<Self>) -> Self {
        Interval::within(&ray.map(estimate).start())
    }

    fn ray_sums<const K: usize>(
        ray: &Ray<Self>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RaySums<Self, K> {
        let found = ray.map(estimate).sums(first, weight);
        RaySums { start: Interval::within(&found.start), sums: found.sums.map(|sum| Interval::within(&sum)) }
    }

    fn gauss_legendre(&self, n: usize) -> Vec<(Self, Self)> {
        enclosed_rule(self.lo().prec(), n)
    }
}

impl BoundedSpecial for Interval {
    fn middle(&self) -> Self {
        let middle = self.mid();
        Interval::between(middle.clone(), middle)
    }

    fn near(&self) -> (f64, f64) {
        let value = self.mid().to_f64();
        let middle = Float::with_val(64, value);
        let far = |end: &Float| rounded(64, end - &middle, Round::AwayZero).abs().to_f64_round(Round::Up);
        (value, far(self.lo()).max(far(self.hi())))
    }

    fn coincides(&self, other: &Self) -> bool {
        // Equal exact numbers may be held by enclosures of different widths.
        let copies = || self.lo() == other.lo() && self.hi() == other.hi();
        self.compare(other).map_or_else(|_| copies(), std::cmp::Ordering::is_eq)
    }
}

/// Returns the number of bits that the recurrence may lose, rounded up.
fn grown(n: usize) -> u32 {
    (1.28 * n as f64) as u32 + 6
}

/// Encloses each node by Newton's method, whose last step proves it. Let `δ` bound the distance to the nearest root by
/// `n |P/P′|`, which holds because `P′/P` is the sum of n fractions `1/(x − x_i)`. Taylor's formula gives
/// `x_i ∈ x − P/P′ ± δ² max|P″|/2|P′|` and `P′(x_i) ∈ P′ + P″(x)(x_i − x) ± δ² max|P‴|/2`. On [−1,1], `P″` is greatest
/// at 1, `(n−1)n(n+1)(n+2)/8 < (n+1)⁴/8`, `P‴ < (n+1)⁶/48`; and `(1−x²)P″ = 2xP′ − n(n+1)P`. If there are as many
/// disjoint nodes as `P_n` has roots, they enclose one root each. The weight is `2/((1−x²) P′²)`. If this proof fails,
/// nodes and weights are the whole line, and so is every integral by this rule.
fn enclosed_rule(bits: u32, n: usize) -> Vec<(Interval, Interval)> {
    let size = (n as f64 + 2.0).log2().ceil() as u32;
    // Bits before the last step, then before each earlier step: a step leaves the squared error times `x/(1−x²) < n²`.
    let mut ladder = vec![bits / 2 + 3 * size + 8];
    while ladder[ladder.len() - 1] > 90 - 2 * size.min(20) {
        ladder.push(ladder[ladder.len() - 1] / 2 + size + 4);
    }
    let near = gauss_legendre(&1.0f64, n);
    let upper = near.into_iter().skip(n / 2).map(|(x, _)| {
        let mut x = Float::with_val(64, x);
        for digits in ladder.iter().rev() {
            let q = digits + grown(n) + 2 * size;
            let (value, before) = step(&x, n, q);
            let square = Float::with_val(q, 1) - Float::with_val(q, x.square_ref());
            let slope = (before - Float::with_val(q, &value * &x)) * n as u32 / square;
            x = Float::with_val(q, &x - &(value / slope));
            x.set_prec(*digits);
        }
        if n % 2 == 1 && x.to_f64().abs() < 1e-9 {
            x = Float::new(64);
        }
        prove(&x, n, bits)
    });
    let upper: Vec<(Interval, Interval)> = upper.collect();
    let mut rule: Vec<_> = upper.iter().skip(n % 2).rev().map(|(x, w)| (-x.clone(), w.clone())).collect();
    rule.extend(upper);
    let apart = |pair: &[(Interval, Interval)]| pair[0].0.hi() < pair[1].0.lo();
    if rule.windows(2).all(apart) { rule } else { vec![(Interval::everything(bits), Interval::everything(bits)); n] }
}

/// Encloses the root next to x, inside (−1,1), and its weight.
///
/// The recurrence runs in `q` bits. Each step adds less than `9·2^−q` to the error of its value, because `|P_k| ≤ 1`,
/// and errors grow as `e_k ≤ 2e_{k−1} + e_{k−2}`, by less than the factor `1 + √2` per step. The total is less than
/// `2^{1.28n + 4 − q}`, which becomes the width.
fn prove(x: &Float, n: usize, bits: u32) -> (Interval, Interval) {
    let (m, q) = (n as i64, bits + grown(n) + 5 * (n as u32 + 2).ilog2() + 24);
    let (value, before) = step(x, n, q);
    let off = Float::with_val(64, 1) >> (q - grown(n));
    let around = |y: &Float| Interval::between(Float::with_val(q, y - &off), Float::with_val(q, y + &off));
    let (value, before) = (around(&value), around(&before));
    let one = value.one();
    let point = one.zero() + &Interval::between(x.clone(), x.clone());
    let square = |x: &Interval| (one.clone() - x) * &(one.clone() + x);
    let slope = (before - point.clone() * &value) * &one.int(m) / square(&point);
    let step = value.clone() / &slope;
    let (second, third) = (one.int(m + 1).square().square() / one.int(16), one.int(m + 1).square() / one.int(6));
    let away = (step.magnitude() * &one.int(m)).square() * &second;
    let node = (point.clone() - step).widened(&(away.clone() / &slope));
    let bend = (point.clone() * &slope * &one.int(2) - value * &one.int(m * (m + 1))) / square(&point);
    let slope = (slope + bend * &(node.clone() - &point)).widened(&(away * third));
    let weight = one.int(2) / (square(&node) * &slope.square());
    let rounded = |x: Interval| Interval::between(down(bits, x.lo()), up(bits, x.hi()));
    (rounded(node), rounded(weight))
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/enclosed.rs"]
mod tests;
