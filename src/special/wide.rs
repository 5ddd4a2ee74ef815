//! The special functions of floats of fixed limbs: in a limb more, so that their own roundings do not count.

use super::bessel::{RoundedSpecial, by_ratios};
use super::hypergeometric::{arrived, far, in_scaled, start};
use super::ray::{Ray, RaySums, RoundedSums};
use crate::number::{Rounded, Scalar, Wide, guarded};

/// Roundings of a limb more in a rounding of the result.
const SPARE: f64 = 18_446_744_073_709_551_616.0;

/// The roundings of a number that had so many in a limb more and is then rounded itself.
fn finished(spare: f64) -> f64 {
    1.001 + spare / SPARE
}

impl<const N: usize> RoundedSpecial for Wide<N> {
    fn in_scaled_rounded(&self, n: u32) -> (Self, f64) {
        if !self.is_finite() || self.is_negative() {
            return (self.double(f64::NAN), f64::INFINITY);
        }
        if n > 1 && self.to_f64() > far(self) {
            return by_ratios(self, n, self.in_scaled_rounded(0));
        }
        guarded!(N, M => {
            let (value, spare) = in_scaled(&self.resized::<M>(), n);
            (value.resized(), finished(spare))
        })
    }

    fn ray_start_rounded(ray: &Ray<Self>) -> (Self, f64) {
        guarded!(N, M => {
            let (value, spare) = start(&arrived(ray, Wide::resized::<M>));
            (value.resized(), finished(spare))
        })
    }

    fn ray_sums_rounded<const K: usize>(
        ray: &Ray<Self>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RoundedSums<Self, K> {
        guarded!(N, M => {
            let ray = arrived(ray, Wide::resized::<M>);
            let found = ray.sums_by_ratios(first, &weight, start(&ray));
            RoundedSums {
                values: RaySums {
                    start: found.values.start.resized(),
                    sums: found.values.sums.map(|sum| sum.resized()),
                },
                start_roundings: finished(found.start_roundings),
                sum_roundings: finished(found.sum_roundings),
                terms: found.terms,
                mean: found.mean,
            }
        })
    }
}

#[cfg(test)]
#[path = "tests/wide.rs"]
mod tests;
