//! Special functions of numbers with a bound: the function of the rounded number, with its roundings and the effect of
//! the errors of the arguments.

use super::bessel::{RoundedSpecial, Special};
use super::gauss::gauss_legendre;
use super::phi;
use super::ray::{Ray, RaySums};
use crate::number::{Bounded, Estimate, Rounded, Scalar};

/// A number with an error bound, an estimate or an enclosure, in which the first contact is computed.
pub trait BoundedSpecial: Special + Bounded {
    /// Returns an exact number near it.
    fn middle(&self) -> Self;

    /// Returns a double near it, and the bound of its distance from the true number.
    fn near(&self) -> (f64, f64);

    /// Returns whether both represent the same number: equal within their bounds, or copies of one enclosure.
    fn coincides(&self, other: &Self) -> bool;
}

impl<S: RoundedSpecial> BoundedSpecial for Estimate<S> {
    fn middle(&self) -> Self {
        Estimate::exact(self.value().clone())
    }

    fn near(&self) -> (f64, f64) {
        let value = self.value().to_f64();
        let rounding = if self.value().bits() == Some(53) { 0.0 } else { value.abs() * f64::EPSILON / 2.0 };
        (value, self.bound() + rounding)
    }

    fn coincides(&self, other: &Self) -> bool {
        self.compare(other).is_ok_and(std::cmp::Ordering::is_eq)
    }
}

/// Error of an argument up to which slopes are evaluated at the argument and enlarged by a hundredth.
const SMALL: f64 = 1e-3;
/// Maximum relative error of a sum that is propagated to first order.
const FIRST_ORDER: f64 = 1.0 / 128.0;
/// Factor that covers the second order of these errors.
const SECOND_ORDER: f64 = 1.03;

impl<S: RoundedSpecial> Special for Estimate<S> {
    /// Computes the value and its error with these slopes. The slope of `e^{−z} I₀` is
    /// `e^{−z}(I₀ − I₁) ≤ e^{−z} I₀ · 2/(1+z)`, by `I₁/I₀ ≥ z/(1+√(1+z²))` (Amos 1974). The slope of `e^{−z} I_n`, half
    /// the difference of `e^{−z}(I_{n−1} − I_n)` and `e^{−z}(I_n − I_{n+1})`, is at most ½, and for n = 1 at most
    /// `1/(1+z)`; it is also `e^{−z}(I_{n+1} + (n/z) I_n − I_n)`, at most `(1 + n/z) e^{−z} I_n`.
    #[inline]
    fn in_scaled(&self, n: u32) -> Self {
        let (value, roundings) = self.value().in_scaled_rounded(n);
        let (z, size) = (self.value().to_f64(), value.to_f64().abs());
        let slope = match n {
            _ if self.bound() > SMALL => 1.0,
            0 => 1.01 * size * (2.0 / (1.0 + z)).min(1.0),
            1 => 1.01 * (1.0 / (1.0 + z)).min(0.5),
            _ if self.bound() * f64::from(n) > SMALL * z => 0.5,
            _ => (1.02 * size * (1.0 + f64::from(n) / z)).min(0.5),
        };
        let rounded = Estimate::rounded(value, roundings);
        Estimate::new(rounded.value().clone(), rounded.error() + slope * self.error())
    }

    #[inline]
    fn ray_start(ray: &Ray<Self>) -> Self {
        let exact = ray.map(|x| x.value().clone());
        let Some(errors) = Errors::of(ray, &exact) else { return upper(ray, [], &|_| []).start };
        if errors.lag > 0.0 {
            return errors.spent(&exact, 0);
        }
        let (value, roundings) = S::ray_start_rounded(&exact);
        Estimate::rounded(value, roundings + SECOND_ORDER * errors.start)
    }

    #[inline]
    fn ray_sums<const K: usize>(
        ray: &Ray<Self>,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
    ) -> RaySums<Self, K> {
        let exact = ray.map(|x| x.value().clone());
        if let Some(errors) = Errors::of(ray, &exact) {
            if errors.lag > 0.0 {
                return RaySums { start: errors.spent(&exact, 0), sums: first.map(|n| errors.spent(&exact, n)) };
            }
            let found = S::ray_sums_rounded(&exact, first, &weight);
            let of = |index: f64| SECOND_ORDER * (errors.start + (index + 1.0) * errors.power);
            if of(found.terms as f64) * exact.xi.unit() <= FIRST_ORDER {
                let relative = of(found.mean);
                let start = found.start_roundings + SECOND_ORDER * errors.start;
                return RaySums {
                    start: Estimate::rounded(found.values.start, start),
                    sums: found.values.sums.map(|sum| Estimate::rounded(sum, found.sum_roundings + relative)),
                };
            }
        }
        upper(ray, first, &weight)
    }

    /// Returns nodes within eight roundings of 1, and weights within eight roundings of 1 plus n + 16 of their own.
    fn gauss_legendre(&self, n: usize) -> Vec<(Self, Self)> {
        let rule = gauss_legendre(self.value(), n).into_iter();
        let own = n as f64 + 16.0;
        rule.map(|(x, w)| (Estimate::new(x, 8.0), Estimate::new(w.clone(), 8.0 + own * w.to_f64()))).collect()
    }

    /// Computes `φ₁(z) = ∫₀¹ e^{zs} ds`, whose slope is smaller than its value.
    fn phi1(&self) -> Self {
        regular(self, phi::phi1(self.value()), 3.0)
    }

    /// Computes `φ₂(z) = ∫₀¹ (1−s) e^{zs} ds`, whose slope is smaller than its value.
    fn phi2(&self) -> Self {
        regular(self, phi::phi2(self.value()), 16.0)
    }
}

fn regular<S: Rounded>(z: &Estimate<S>, value: S, roundings: f64) -> Estimate<S> {
    let growth = if z.bound() > SMALL { z.bound().exp() } else { 1.01 };
    Estimate::rounded(value, roundings + growth * z.error())
}

/// Effects of the errors of ξ, η and r on the sums of a ray, in roundings.
struct Errors {
    /// Error of `e^{−rt} ψ₀`.
    start: f64,
    /// Additional error for each term of the sums beyond the first.
    power: f64,
    /// `r(t − √(ξη))` if it is so great that the ray is negligible; otherwise zero.
    lag: f64,
}

/// Number of bits below a rounding of 1 at which the contribution of a ray is dropped.
const SPENT_BITS: f64 = 64.0;

impl Errors {
    /// Computes the effects; `None` if they are too large for first order.
    ///
    /// With `h = r/2` the terms are `e^{−h(ξ+η)} ξ^{n+m} η^m h^{n−n₀+2m}` times a constant, `m ≥ 0`. In the sum over m
    /// for one n, a power series in `ξη`, the mean of m is `(z/2) I_{n+1}/I_n ≤ z/2 = h√(ξη)`, and at most `h²ξη`.
    /// Therefore the logarithm of `ψ₀` with its exponential has slopes of at most `max(h, min(h²η, h√(η/ξ)))` by ξ; h
    /// by η, since `z/2 ≤ hη`; and `ξ + η` by h, since `z ≤ h(ξ+η)`. The logarithm of a sum over n has additional
    /// slopes `n/ξ` by ξ and `n/h` by h, and the terms beyond the last term N add less than one to the mean of n.
    #[inline]
    fn of<S: Rounded>(ray: &Ray<Estimate<S>>, exact: &Ray<S>) -> Option<Self> {
        let (x, y, r) = (exact.xi.to_f64(), exact.eta.to_f64(), exact.damping.to_f64());
        let (mut dx, dy, dr) = (ray.xi.error(), ray.eta.error(), ray.damping.error());
        if x < 0.0 {
            dx += (exact.xi.magnitude() / exact.xi.roundoff()).to_f64();
        }
        let (x, h) = (x.max(0.0), 0.5 * r);
        let steep = if h * y > 1.0 { (h * y).min((y / x).sqrt()).max(1.0) } else { 1.0 };
        let start = h * (dx * steep + dy) + 0.5 * dr * (x + y);
        let relative = |error: f64, size: f64| if error == 0.0 { 0.0 } else { error / size };
        let unit = exact.xi.unit();
        if start.is_nan() || start * unit * SECOND_ORDER > FIRST_ORDER {
            return None;
        }
        let mut lag = 0.0;
        let goal = (exact.xi.bits().map_or(1e6, f64::from) + SPENT_BITS) * std::f64::consts::LN_2;
        // The lag is at most h η.
        if h * y > goal {
            let apart = y.sqrt() - x.sqrt();
            let found = h * apart * apart * (1.0 - 1e-9) - 1.0;
            lag = if found > goal && h * (x + y) < 1e12 { found } else { 0.0 };
        }
        Some(Errors { start, power: relative(dx, x) + relative(dr, r), lag })
    }

    /// Returns zero for a negligible ray, with a bound of its contribution from `ψ_first` on.
    ///
    /// The terms `f_n = hⁿψ_n` obey `n f_n ≤ hξ f_{n−1}`, so `Σ n³ f_n ≤ (x³ + 3x² + x) Σ f_n` with `x = hξ`, and
    /// `Σ_{n≥0} f_n = Σ qⁿI_n ≤ e^z` for `q² = ξ/η ≤ 1`.
    #[cold]
    fn spent<S: Rounded>(&self, exact: &Ray<S>, first: i64) -> Estimate<S> {
        let (h, x) = (0.5 * exact.damping.to_f64(), exact.xi.to_f64().max(0.0));
        let reach = h * x;
        let weight = if first == 0 {
            0.0
        } else {
            (4.0 * reach * (reach + 1.0) * (reach + 2.0)).log2() - first as f64 * h.log2()
        };
        let log = weight - self.lag * std::f64::consts::LOG2_E - exact.xi.log2_roundoff();
        Estimate::new(exact.xi.zero(), log.exp2().max(f64::MIN_POSITIVE))
    }
}

/// Returns zeros with the bounds that the greatest arguments give: without the exponential, the sums increase with each
/// argument. The start is bounded this way only if its own errors are too large for first order.
#[cold]
fn upper<S: RoundedSpecial, const K: usize>(
    ray: &Ray<Estimate<S>>,
    first: [i64; K],
    weight: &dyn Fn(i64) -> [i64; K],
) -> RaySums<Estimate<S>, K> {
    let exact = ray.map(|x| x.value().clone());
    let most = ray.map(|x| {
        let value = x.value().clone();
        let value = if value < value.zero() { value.zero() } else { value };
        let off = x.value().magnitude() - &value + value.double(2.0 * x.error()) * &value.roundoff();
        value + off
    });
    let size = |ray: &Ray<S>| ray.half() * &(ray.xi.clone() + &ray.eta);
    // The exponents of the greatest and the least arguments differ by at most twice that, because a product is convex.
    let growth = 2.1 * (2.02 * (size(&most) - size(&exact)).to_f64().abs()).exp();
    let within = |most: S| {
        let bound = (most.clone() / most.roundoff()).to_f64() * growth;
        let bound = if bound.is_nan() { f64::INFINITY } else { bound.max(f64::MIN_POSITIVE) };
        Estimate::new(most.zero(), bound)
    };
    let start = match Errors::of(ray, &exact) {
        Some(_) => Estimate::ray_start(ray),
        None => within(S::ray_start_rounded(&most).0),
    };
    RaySums { start, sums: S::ray_sums_rounded(&most, first, weight).values.sums.map(within) }
}

#[cfg(test)]
#[path = "tests/estimated.rs"]
mod tests;
