//! Special functions of long numbers; the sums of a ray by the backward three-term recurrence without divisions.

use super::bessel::{RoundedSpecial, by_ratios};
use super::hypergeometric::{arrived, far, in_scaled, start};
use super::ray::{Ray, RaySums, RoundedSums};
use crate::number::float::Pow;
use crate::number::{Float, Scalar};

/// Upper bound on the roundings of [`backward`].
const SUM_ROUNDINGS: f64 = 2.0;

/// Returns the number with 32 bits to spare.
fn longer(x: &Float) -> Float {
    Float::with_val(x.prec() + 32, x)
}

/// Rounds a number that had so many roundings in 32 bits more, and returns its roundings now: infinitely many if there
/// is no value.
fn finished((value, spare): (Float, f64), bits: u32) -> (Float, f64) {
    let roundings = (1.0 + spare * 2f64.powi(-32)).max(1.000_100_2);
    (Float::with_val(bits, &value), if value.is_nan() { f64::INFINITY } else { roundings })
}

impl RoundedSpecial for Float {
    fn in_scaled_rounded(&self, n: u32) -> (Float, f64) {
        if !Float::is_finite(self) || self.is_sign_negative() {
            return (self.double(f64::NAN), f64::INFINITY);
        }
        if n > 1 && self.to_f64() > far(self) {
            return by_ratios(self, n, self.in_scaled_rounded(0));
        }
        finished(in_scaled(&longer(self), n), self.prec())
    }

    fn ray_start_rounded(ray: &Ray<Float>) -> (Float, f64) {
        finished(start(&arrived(ray, longer)), ray.xi.prec())
    }

    /// Computes the sums by the recurrence without divisions if it applies, otherwise by the ratios.
    fn ray_sums_rounded<const K: usize>(
        ray: &Ray<Float>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RoundedSums<Float, K> {
        let ray = arrived(ray, Float::clone);
        let terms = ray.terms(first.iter().copied().max().unwrap_or(1));
        if let Some((start, sums)) = backward(&ray, terms, first, &weight) {
            let (start, start_roundings) = finished(start, ray.xi.prec());
            let values = RaySums { start, sums };
            return RoundedSums { values, start_roundings, sum_roundings: SUM_ROUNDINGS, terms, mean: terms as f64 };
        }
        ray.sums_by_ratios(first, weight, Float::ray_start_rounded(&ray))
    }
}

/// Maximum number of terms of this recurrence; the recurrence of the ratios handles more.
const MOST_TERMS: i64 = 100_000;
/// Minimum precision of a term.
const FEWEST_BITS: u32 = 64;

/// Computes `e^{−rt} ψ₀` and `e^{−rt} Σ_{n≥n₀} c_n (r/2)^{n−n₀} ψ_n` with fewer than two roundings; `None` if this
/// method does not apply: for `r ξ = 0`, too many terms, or a first weight below 1.
///
/// **Source**: `f_n = (r/2)ⁿ ψ_n` obeys `f_{n−1} = (n f_n + w f_{n+1})/x` with `x = rξ/2`, `w = rη/2`. The recurrence
/// runs downwards from `f_N = 1`, `f_{N+1} = 0`, and the sums over f are divided by f₀ once.
///
/// **Accuracy**: the ratios `σ_n = f_n/f_{n−1} = x/(n + wσ_{n+1})` inherit the relative error of their successor times
/// `θ_n = wσ_nσ_{n+1}/x = I_{n+1}/I_{n−1} < 1`, and `f_{n−1}` adds its own error `τ_n ≤ 6·2^{−p_n}`: coefficients cut
/// to `p_n` bits, two products, a product with n, a sum. The error of `σ_n` is therefore at most
/// `Σ_{j≥n} τ_j Π_{k=n}^{j−1} θ_k`. The bits grow with the terms, `2^{−p_n} ≤ 4·2^{−W} max(1, f_{n₀}/f_{n−1})` for the
/// greatest n₀, so `τ_j Π θ_k` is at most `24·2^{−W} (f_{n₀}/f_{n−1} Π θ_k/σ_k + 1)`. Here
/// `θ_k/σ_k = wσ_{k+1}/x < 2w/(k + ½ + √((k+½)² + z²)) = b_k` (Segura 2011), which decreases with k. With
/// `B = Σ_{j≥1} Π_{k<j} b_k`, the error of `σ_n` is at most `24·2^{−W} (B f_{n₀}/f_{n−1} + N)`. The error of `f_n/f₀`,
/// a product of n ratios, is at most `24·2^{−W} (B n f_{n₀}/f_n + N²)`, since f decreases with n. In the sum it has the
/// weight `c_n f_n/S` with `c_n ≤ n³` and `S ≥ f_{n₀}`. The total is `24·2^{−W} (B N⁵ + N²)`, and W makes it less than
/// a tenth of a rounding. N is chosen so that the start with `f_{N+1} = 0` and the omitted terms contribute less than
/// another tenth.
///
/// Dropping the spare bits rounds the number once more.
fn backward<const K: usize>(
    ray: &Ray<Float>,
    terms: i64,
    first: [i64; K],
    weight: impl Fn(i64) -> [i64; K],
) -> Option<((Float, f64), [Float; K])> {
    let (xi, eta, half) = (&ray.xi, &ray.eta, &ray.half());
    let p = xi.prec();
    let last = first.iter().copied().max().unwrap_or(1);
    let x = Float::with_val(p + 64, half * xi);
    let grows = first.iter().enumerate().any(|(k, n)| *n < 1 || weight(*n)[k] < 1);
    if !(x.is_finite() && x > 0) || terms >= MOST_TERMS || grows {
        return None;
    }
    let w = Float::with_val(p + 64, half * eta);
    let n = terms as f64;
    let spread = spread(ray.argument(), w.to_f64(), terms);
    let extra = (spread + 5.0 * n.log2() + 1.0).ceil() + 8.0;
    if extra.is_nan() || extra >= f64::from(p) {
        return None;
    }
    let full = p + extra as u32;
    // One rounding for x or w and one for the quotient, within the τ_n above.
    let (x, w) = (Float::with_val(full + 8, half * xi), Float::with_val(full + 8, half * eta));
    let (by_x, by_w) = (Float::with_val(full + 8, x.recip_ref()), Float::with_val(full + 8, &w / &x));
    let start = start(&ray.map(longer));
    if start.0.is_nan() {
        return None;
    }

    let mut bits = FEWEST_BITS + extra as u32;
    loop {
        let (sums, zeroth, reached) = descend((terms, last), (&by_x, &by_w), (bits, full), (&first, &weight));
        if reached < full {
            // The terms grew by fewer bits than needed: restart with more bits.
            bits += full - reached + 8;
            continue;
        }
        let factor = Float::with_val(full, &start.0 / &zeroth);
        let mut k = 0;
        let sums = sums.map(|sum| {
            let power = Float::with_val(full, half.pow(first[k] as u32));
            k += 1;
            Float::with_val(p, sum * &factor / power)
        });
        return Some((start, sums));
    }
}

/// Returns `log₂ B` plus a margin.
fn spread(argument: f64, w: f64, terms: i64) -> f64 {
    let z = argument * (1.0 - 1e-12);
    let (mut log, mut greatest) = (0.0f64, 0.0f64);
    for k in 1..=terms {
        let m = k as f64 + 0.5;
        log += (2.0 * w / (m + (m * m + z * z).sqrt())).log2();
        greatest = greatest.max(log);
    }
    greatest + ((terms + 1) as f64).log2() + 1.0
}

/// Returns the sums over f, f₀, and the precision of the term `last`; precisions range from `bits` to `full`.
fn descend<const K: usize>(
    (terms, last): (i64, i64),
    (by_x, by_w): (&Float, &Float),
    (bits, full): (u32, u32),
    (first, weight): (&[i64; K], &impl Fn(i64) -> [i64; K]),
) -> ([Float; K], Float, u32) {
    let mut sums: [Float; K] = std::array::from_fn(|_| Float::new(full));
    let (mut value, mut above) = (Float::with_val(bits, 1), Float::new(bits));
    let (mut precision, mut reached) = (bits.min(full), bits);
    let (mut cut_x, mut cut_w) = (Float::with_val(precision, by_x), Float::with_val(precision, by_w));
    for n in (1..=terms).rev() {
        if n >= first.iter().copied().min().unwrap_or(1) {
            let weights = weight(n);
            for k in 0..K {
                if n >= first[k] && weights[k] != 0 {
                    sums[k] += Float::with_val(precision, &value) * weights[k];
                }
            }
        }
        if n == last {
            reached = precision;
        }
        let mut next = Float::with_val(precision, &value * &cut_x);
        let grown = i64::from(bits) + i64::from(next.get_exp().unwrap_or(0)) + i64::from(n.ilog2());
        let grown = grown.max(i64::from(bits)).min(i64::from(full)) as u32;
        if grown > precision {
            // The precision is rounded up to whole words, and the product is repeated with it.
            precision = grown.next_multiple_of(64).min(full);
            (cut_x, cut_w) = (Float::with_val(precision, by_x), Float::with_val(precision, by_w));
            next = Float::with_val(precision, &value * &cut_x);
        }
        next *= n;
        above *= &cut_w;
        next += &above;
        above = std::mem::replace(&mut value, next);
    }
    (sums, value, reached)
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/long.rs"]
mod tests;
