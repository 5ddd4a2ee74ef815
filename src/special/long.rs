//! The special functions of long numbers.

use rug::Float;

use super::backward::Backward;
use super::bessel::{RoundedSpecial, by_ratios};
use super::bits;
use super::hypergeometric::{damped_start, in_scaled_bounded};
use super::ray::{Ray, RaySums, RoundedSums};

/// `Backward::sums` has fewer.
const SUM_ROUNDINGS: f64 = 2.0;

/// A ray that arrives now may do so a rounding later.
fn arrived(ray: &Ray<Float>) -> Ray<Float> {
    let xi = if ray.xi.is_sign_negative() { Float::new(ray.xi.prec()) } else { ray.xi.clone() };
    Ray { xi, ..ray.clone() }
}

impl RoundedSpecial for Float {
    fn in_scaled_rounded(&self, n: u32) -> (Float, f64) {
        if n <= 1 || self.to_f64() <= bits(self) + 64.0 {
            return in_scaled_bounded(self, n);
        }
        by_ratios(self, n, in_scaled_bounded(self, 0))
    }

    fn ray_start_rounded(ray: &Ray<Float>) -> (Float, f64) {
        let ray = arrived(ray);
        match damped_start(&ray.half(), &ray.xi, &ray.eta) {
            Some(start) => start.rounded(ray.xi.prec()),
            None => (Float::with_val(ray.xi.prec(), rug::float::Special::Nan), f64::INFINITY),
        }
    }

    /// By the recurrence without divisions where it can be, by the ratios elsewhere.
    fn ray_sums_rounded<const K: usize>(
        ray: &Ray<Float>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RoundedSums<Float, K> {
        let ray = arrived(ray);
        let terms = ray.terms(first.iter().copied().max().unwrap_or(1));
        if let Some((start, sums)) = Backward::new(&ray, terms).sums(first, &weight) {
            let (start, start_roundings) = start.rounded(ray.xi.prec());
            let values = RaySums { start, sums };
            return RoundedSums { values, start_roundings, sum_roundings: SUM_ROUNDINGS, terms, mean: terms as f64 };
        }
        ray.sums_by_ratios(first, weight, Float::ray_start_rounded(&ray))
    }
}

#[cfg(test)]
#[path = "tests/long.rs"]
mod tests;
