//! What one ray of the lattice carries to a point: positive sums over `ψ_n`, in one backward pass.
//!
//! `ψ_n(ξ,η) = (ξⁿ/n!) ₀F₁(; n+1; r²ξη/4)` with `ξ = t − a`, `η = t + a` for the travel time `a`. The ratios
//! `ρ_n = ψ_n/ψ_{n−1}` obey `ρ_n = ξ/(n + (r²η/4) ρ_{n+1})`, which has no cancellation, is stable downwards, and is
//! `ξ/n` at `r = 0`: no formula here divides by `r`.

#[cfg(feature = "mp")]
use std::any::Any;

#[cfg(feature = "mp")]
use super::{backward::Backward, many::same};
use super::{bits, enclosed, i0_scaled, negative_power};
use crate::number::Analytic;

/// A ray of travel time `a` at age `t`: `ξ = t − a`, `η = t + a`, damping `r`.
#[derive(Clone, Debug)]
pub struct Ray<S> {
    xi: S,
    eta: S,
    /// `r/2`.
    half: S,
    /// `r √(ξη)`, as a double: it decides how many terms are taken, nothing else.
    argument: f64,
}

/// Sums of one ray, with the bound of their relative error in units of the roundoff.
#[derive(Clone, Debug)]
pub struct RaySums<S, const K: usize> {
    /// `e^{−rt} ψ₀ = e^{−rt} I₀(r√(ξη))`.
    pub start: S,
    /// `e^{−rt} Σ_{n≥n₀} c_n (r/2)^{n−n₀} ψ_n`.
    pub sums: [S; K],
    /// Roundings in `start`.
    pub start_roundings: f64,
    /// Roundings in `sums`.
    pub sum_roundings: f64,
}

/// No ray asks for more terms than this; only damping beyond `r t ≈ 10¹⁰` could.
const MOST_TERMS: i64 = 4_000_000;

impl<S: Analytic> Ray<S> {
    /// The ray of travel time `a ≤ t`.
    pub fn new(damping: &S, travel: &S, time: &S) -> Self {
        let (xi, eta) = (time.clone() - travel, time.clone() + travel);
        // A ray that arrives now may do so a rounding later.
        let xi = if !S::RIGOROUS && xi.is_negative() { xi.zero() } else { xi };
        let half = damping.clone() / damping.int(2);
        let argument = damping.to_f64() * (xi.to_f64().max(0.0) * eta.to_f64()).sqrt();
        Ray { xi, eta, half, argument }
    }

    /// `a = 0`, `t = 1` and damping `z`: `(r/2)ⁿ ψ_n = I_n(z)`.
    pub(super) fn at_source(z: &S) -> Self {
        Ray::new(z, &z.zero(), &z.one())
    }

    /// `I_k(z)/I_{k−1}(z) (ξ/η)^{1/2}` for k = 1 … n.
    pub(super) fn ratios(&self, n: i64) -> Vec<S> {
        let (terms, mut sigma, _) = self.cut(n);
        let mut ratios = Vec::new();
        for k in (1..=terms.max(n + 2)).rev() {
            sigma = self.ratio(k, &sigma) * &self.half;
            if k <= n {
                ratios.push(sigma.clone());
            }
        }
        ratios
    }

    /// Where the sums that need the terms up to `first` begin: the last term N, `σ_{N+1}`, and what lies beyond; zero but for
    /// enclosures.
    fn cut(&self, first: i64) -> (i64, S, S) {
        let zero = self.xi.zero();
        if !S::RIGOROUS {
            return (self.terms(first), zero.clone(), zero);
        }
        let cut = enclosed::cut(&self.half, &self.xi, &self.eta, first.max(1) + 1);
        // From zero to the bound: a denominator with less than zero in it could hold a zero.
        let middle = cut.ratio / zero.int(2);
        (cut.terms, middle.clone().widened(&middle), zero.widened(&cut.rest))
    }

    /// `ρ_n` from `σ_{n+1} = (r/2) ρ_{n+1}`; `(r/2) η σ` cannot overflow, since `σ < 1`.
    #[inline]
    fn ratio(&self, n: i64, next: &S) -> S {
        self.xi.clone() / (self.half.clone() * &self.eta * next + self.xi.int(n))
    }

    /// How many terms leave a relative rest below the roundoff, for weights that grow no faster than n³, from index
    /// `first` on.
    ///
    /// With z = r√(ξη): `I_n/I_{n−1} < z/(n−½+√((n−½)²+z²))` (Amos 1974, Segura 2011), so `(r/2)ρ_n < rξ/(n−½+√(…))`.
    /// These bounds fall with n: the rest after n is at most its first term times the geometric series of the ratio
    /// there. Starting the recurrence with ρ = 0 changes `ρ_k` by the product of `(I_n/I_{n−1})(I_{n+1}/I_n)` from k
    /// on, which the second product bounds by its square.
    fn terms(&self, first: i64) -> i64 {
        let z = self.argument * (1.0 + 1e-12);
        let reach = 2.0 * self.half.to_f64() * self.xi.to_f64().max(0.0) * (1.0 + 1e-12);
        let (mut rest, mut square) = (1.0f64, 1.0f64);
        let mut goal = bits(&self.xi) + 6.0;
        let mut n = first;
        if reach == 0.0 {
            return first + 1;
        }
        if z < 4.0 && goal < 100.0 {
            // The same with the root left out, `I_n/I_{n−1} < z/(2n−1)`, and without divisions.
            let (limit, z_square) = (negative_power(goal.ceil()), z * z);
            let mut size = 1.0f64;
            while n < 64 {
                n += 1;
                let (m, below) = (n as f64, (2 * n - 1) as f64);
                rest *= reach;
                square *= z_square;
                size *= below;
                // From n = 10 on the ratio, with the growth of the weights, is below 1/2.
                if n >= 10 && 2.0 * rest * m * m * m <= limit * size && square <= limit * size * size {
                    return n;
                }
            }
            return n;
        }
        let unit = 2f64.powi(-300);
        let small = |goal: f64| if goal > 600.0 { 0.0 } else { negative_power(goal.ceil()) };
        let mut limit = small(goal);
        loop {
            n += 1;
            let m = n as f64;
            let below = (m - 0.5) + ((m - 0.5) * (m - 0.5) + z * z).sqrt();
            let step = reach / below;
            rest *= step;
            square *= (z / below) * (z / below);
            let growth = step * (1.0 + 1.0 / m).powi(3);
            if growth < 1.0 && rest * m * m * m <= limit * (1.0 - growth) && square <= limit {
                return n;
            }
            if rest < unit && square < unit && goal > 600.0 {
                rest /= unit;
                square /= unit;
                goal -= 300.0;
                limit = small(goal);
            }
            if n >= MOST_TERMS {
                return n;
            }
        }
    }

    /// `e^{−rt} ψ₀`, without overflow: `e^{−r(t−u)} · e^{−ru} I₀(ru)` with `u = √(ξη)`, `t − u = a²/(t+u)`; and its
    /// roundings.
    pub fn start(&self) -> (S, f64) {
        if S::RIGOROUS {
            return (enclosed::ray_start(&self.half, &self.xi, &self.eta), 0.0);
        }
        if let Some(start) = self.long_start() {
            return start;
        }
        let two = self.xi.int(2);
        let u = (self.xi.clone() * &self.eta).sqrt();
        let damping = self.half.clone() * &two;
        let bessel = i0_scaled(&(damping.clone() * &u));
        let roundings = if bits(&self.xi) <= 53.0 { 8.0 } else { 8.0 + 4.0 * self.argument + 4.0 * bits(&self.xi) };
        if self.xi == self.eta {
            return (bessel, roundings);
        }
        let travel = (self.eta.clone() - &self.xi) / &two;
        let time = (self.eta.clone() + &self.xi) / &two;
        let lag = travel.square() / (time + &u) * &damping;
        let exponent = lag.to_f64();
        (bessel * &(-lag).exp(), roundings + 4.0 + 6.0 * exponent)
    }

    /// `e^{−rt} Σ_{n≥n₀} c_n (r/2)^{n−n₀} ψ_n` for K sequences `c`, each from its own `n₀ ≥ 1`, in one pass.
    ///
    /// **Accuracy**: the weights are not negative, so the relative error is at most `sum_roundings` roundings. With N
    /// terms, each ratio adds 4 roundings and passes on those of its successor times `I_{n+1}/I_{n−1}`; summed over n
    /// by `asinh s ≥ 0.88 s` (s ≤ 1) that is at most `4N + 2.3 z (2 + ln 2N)`; Horner adds 3 for each term. Long numbers take a
    /// recurrence without divisions, with less than that.
    pub fn sums<const K: usize>(&self, first: [i64; K], weight: impl Fn(i64) -> [i64; K]) -> RaySums<S, K> {
        let last = first.iter().copied().max().unwrap_or(1);
        if let Some(sums) = self.long_sums(last, first, &weight) {
            return sums;
        }
        self.sums_by_ratios(first, weight)
    }

    fn sums_by_ratios<const K: usize>(&self, first: [i64; K], weight: impl Fn(i64) -> [i64; K]) -> RaySums<S, K> {
        let last = first.iter().copied().max().unwrap_or(1);
        let (terms, mut sigma, rest) = self.cut(last);
        let (start, start_roundings) = self.start();
        let mut sums: [S; K] = std::array::from_fn(|_| rest.clone());
        // ψ_n = ψ_0 ρ_1 ⋯ ρ_n: the last factors are at hand when the pass comes down to n₀.
        let mut heads: [S; K] = std::array::from_fn(|_| start.clone());
        for n in (1..=terms).rev() {
            let weights = weight(n);
            for k in 0..K {
                if n >= first[k] {
                    sums[k] = sums[k].clone() * &sigma + self.xi.int(weights[k]);
                }
            }
            let rho = self.ratio(n, &sigma);
            sigma = rho.clone() * &self.half;
            if n <= last {
                for k in 0..K {
                    if n <= first[k] {
                        heads[k] = heads[k].clone() * &rho;
                    }
                }
            }
        }
        let sums = std::array::from_fn(|k| sums[k].clone() * &heads[k]);
        let n = terms as f64;
        let sum_roundings = if terms >= MOST_TERMS {
            f64::INFINITY
        } else {
            start_roundings + 16.0 + 7.0 * n + 2.3 * self.argument * (2.0 + (2.0 * n).ln())
        };
        RaySums { start, sums, start_roundings, sum_roundings }
    }
}

#[cfg(feature = "mp")]
impl<S: Analytic> Ray<S> {
    fn long(&self, terms: i64) -> Option<Backward<'_>> {
        let float = |x| (x as &dyn Any).downcast_ref::<rug::Float>();
        let (xi, eta, half) = (float(&self.xi)?, float(&self.eta)?, float(&self.half)?);
        Some(Backward { xi, eta, half, argument: self.argument, terms })
    }

    fn long_start(&self) -> Option<(S, f64)> {
        let start = self.long(0)?.start()?;
        let value = rug::Float::with_val(bits(&self.xi) as u32, &start.long);
        Some((same(value)?, start.roundings))
    }

    fn long_sums<const K: usize>(
        &self,
        last: i64,
        first: [i64; K],
        weight: &impl Fn(i64) -> [i64; K],
    ) -> Option<RaySums<S, K>> {
        if !(&self.xi as &dyn Any).is::<rug::Float>() {
            return None;
        }
        let terms = self.terms(last);
        let (start, sums, sum_roundings) = self.long(terms)?.sums(first, weight)?;
        let value = rug::Float::with_val(bits(&self.xi) as u32, &start.long);
        Some(RaySums { start: same(value)?, sums: same(sums)?, start_roundings: start.roundings, sum_roundings })
    }
}

#[cfg(not(feature = "mp"))]
impl<S: Analytic> Ray<S> {
    #[inline]
    fn long_start(&self) -> Option<(S, f64)> {
        None
    }

    #[inline]
    fn long_sums<const K: usize>(&self, _: i64, _: [i64; K], _: &impl Fn(i64) -> [i64; K]) -> Option<RaySums<S, K>> {
        None
    }
}

#[cfg(all(test, feature = "mp"))]
mod tests {
    use super::*;
    use rug::Float;

    /// By ratios with twice the precision, for the same numbers, which then are exact.
    #[test]
    fn the_recurrence_without_divisions_keeps_its_bound() {
        let weight = |n: i64| {
            let (even, odd) = ((n + 1) % 2, n % 2);
            let cube = n * (n * n - 1);
            let b = if n % 2 == 0 { n * (n * n - 4) / 24 } else { cube / 24 };
            [odd, even, n * n / 4, n, b, (n * n + 1) / 2]
        };
        let first = [1, 2, 2, 1, 3, 1];
        for p in [64u32, 200, 1000, 2100] {
            for damping in [1e-300, 1e-9, 0.3, 3.0, 20.0, 60.0] {
                for (travel, time) in [(0.0, 1.0), (0.5, 0.501), (0.5, 0.5 + 1e-9), (1.0, 1.9), (3.0, 7.3)] {
                    if damping * time > f64::from(p) {
                        continue;
                    }
                    let third = Float::with_val(p, 3).recip() >> 40;
                    let number = |x: f64| Float::with_val(p, x) * (Float::with_val(p, 1) + &third);
                    let ray = Ray::new(&number(damping), &number(travel), &number(time));
                    let long = |x: &Float| Float::with_val(2 * p, x);
                    let exact =
                        Ray { xi: long(&ray.xi), eta: long(&ray.eta), half: long(&ray.half), argument: ray.argument };
                    let (found, sure) = (ray.sums(first, weight), exact.sums_by_ratios(first, weight));
                    let off = |value: &Float, exact: &Float| {
                        let wrong = Float::with_val(64, value - exact) / exact;
                        (wrong.abs() << p).to_f64()
                    };
                    // The numbers are exact here: less than 1.2 roundings and two for what is multiplied at the end.
                    let case = format!("{p} {damping} {travel} {time}");
                    assert!(off(&found.start, &sure.start) <= 1.1, "{case}");
                    for (value, exact) in found.sums.iter().zip(&sure.sums) {
                        assert!(off(value, exact) < 3.5, "{case} {}", off(value, exact));
                    }
                    assert!(found.sum_roundings < sure.sum_roundings);
                }
            }
        }
    }
}
