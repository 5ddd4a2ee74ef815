//! The special functions of floats of fixed limbs: in a limb more, so that their own roundings do not count.

use super::bessel::{RoundedSpecial, by_ratios, expansion};
use super::bits;
use super::ray::{Ray, RaySums, RoundedSums};
use crate::number::{Rounded, Scalar, Wide, guarded};

/// Roundings of a limb more in a rounding of the result.
const SPARE: f64 = 18_446_744_073_709_551_616.0;

/// The roundings of a number that had so many in a limb more and is then rounded itself.
fn finished(spare: f64) -> f64 {
    1.001 + spare / SPARE
}

/// `(base)ⁿ/n! ₀F₁(; n+1; y)` for finite `y ≥ 0`, and its roundings, where base and y are exact.
///
/// All terms are positive. The m-th has two roundings more than the one before, and a sum of m terms has m: fewer than
/// `3m`. The terms fall by half at least where the sum ends, so that the rest is less than a rounding; n factors add
/// two each.
fn series<S: Rounded>(y: &S, base: &S, n: u32) -> (S, f64) {
    let (mut term, mut sum, mut m) = (y.one(), y.one(), 0);
    loop {
        m += 1;
        let next = term.clone() * y / y.int(m * (m + i64::from(n)));
        sum = sum + &next;
        let falls = next.clone() + &next < term || next.is_zero();
        term = next;
        if falls && term <= sum.clone() * &y.roundoff() {
            break;
        }
    }
    let power = (1..=i64::from(n)).fold(sum, |product, k| product * base / y.int(k));
    (power, 3.0 * m as f64 + 2.0 + 2.0 * f64::from(n))
}

/// Arguments up to this are left to the series, those beyond it to the expansion at infinity.
fn far<S: Scalar>(like: &S) -> f64 {
    bits(like) + 64.0
}

/// Roundings of the expansion, which has fewer than four in term k, and `2p + 128` terms that are below 1/8 together.
fn expansion_roundings<S: Scalar>(like: &S) -> f64 {
    8.0 * bits(like) + 512.0
}

/// `e^{−z} I_n(z)` and its roundings for `0 ≤ z`, n ≤ 1 or z not [`far`]; the exponential has `2³⁴`, and y, rounded
/// once, passes on at most z of them.
fn in_scaled<const M: usize>(z: &Wide<M>, n: u32) -> (Wide<M>, f64) {
    if z.to_f64() > far(z) {
        return (expansion(z, i64::from(n)), expansion_roundings(z));
    }
    let half = *z / z.int(2);
    let (value, roundings) = series(&half.square(), &half, n);
    (value * (-*z).raw_exp(), roundings + z.to_f64() + EXP)
}

/// Roundings of an exponential, of its argument and of the product with it.
const EXP: f64 = 68_719_476_736.0;

/// `e^{−rt} ψ₀` and its roundings, for `ξ ≥ 0`.
///
/// `y = (r/2)² ξη` has three roundings, and passes on at most `z/2` times as many; the expansion passes on fewer than
/// it has. Either exponent has at most ten roundings of itself; beyond `2³¹` there is nothing left of the value.
fn start<const M: usize>(ray: &Ray<Wide<M>>) -> (Wide<M>, f64) {
    let (half, product) = (ray.half(), ray.xi * ray.eta);
    let y = half.square() * product;
    let z = 2.0 * y.to_f64().sqrt();
    if !z.is_finite() || y.is_negative() {
        return (y.double(f64::NAN), f64::INFINITY);
    }
    let sum = ray.eta + ray.xi;
    if z <= far(&y) {
        let (value, roundings) = series(&y, &half, 0);
        return (value * (-(half * sum)).raw_exp(), roundings + 2.0 * z + EXP);
    }
    let Some(root) = product.try_sqrt() else { return (y.double(f64::NAN), f64::INFINITY) };
    let lag = half * (ray.eta - ray.xi).square() / (sum + root + root);
    let value = expansion(&(ray.damping * root), 0) * (-lag).raw_exp();
    (value, 2.0 * expansion_roundings(&y) + EXP)
}

/// A ray that arrives now may do so a rounding later.
fn arrived<const N: usize, const M: usize>(ray: &Ray<Wide<N>>) -> Ray<Wide<M>> {
    let ray = ray.map(Wide::resized::<M>);
    let xi = if ray.xi.is_negative() { ray.xi.zero() } else { ray.xi };
    Ray { xi, ..ray }
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
            let (value, spare) = start::<M>(&arrived(ray));
            (value.resized(), finished(spare))
        })
    }

    fn ray_sums_rounded<const K: usize>(
        ray: &Ray<Self>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RoundedSums<Self, K> {
        guarded!(N, M => {
            let ray: Ray<Wide<M>> = arrived(ray);
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
