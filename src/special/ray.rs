//! Contribution of one ray of the lattice to a point: positive sums over `ψ_n`, in one backward pass.
//!
//! The functions are `ψ_n(ξ,η) = (ξⁿ/n!) ₀F₁(; n+1; r²ξη/4)` with `ξ = t − a`, `η = t + a` for the travel time `a`. The
//! ratios `ρ_n = ψ_n/ψ_{n−1}` obey `ρ_n = ξ/(n + (r²η/4) ρ_{n+1})`. This recurrence has no cancellation, is stable
//! downwards, and gives `ξ/n` at `r = 0`: no formula here divides by `r`.

use crate::number::{Analytic, Rounded, Scalar};

/// A ray of travel time `a` at age `t`: `ξ = t − a`, `η = t + a`, damping `r`.
#[derive(Clone, Debug)]
pub struct Ray<S> {
    pub(super) xi: S,
    pub(super) eta: S,
    pub(super) damping: S,
}

/// The sums of one ray.
#[derive(Clone, Debug)]
pub struct RaySums<S, const K: usize> {
    /// `e^{−rt} ψ₀ = e^{−rt} I₀(r√(ξη))`.
    pub start: S,
    /// `e^{−rt} Σ_{n≥n₀} c_n (r/2)^{n−n₀} ψ_n`.
    pub sums: [S; K],
}

/// The sums of one ray whose ξ, η and r are exact, with the bound of their relative error in roundings.
#[derive(Clone, Debug)]
pub struct RoundedSums<S, const K: usize> {
    /// The values.
    pub values: RaySums<S, K>,
    /// Roundings in `start`.
    pub start_roundings: f64,
    /// Roundings in `sums`.
    pub sum_roundings: f64,
    /// The last summed term; all later terms are below a roundoff.
    pub terms: i64,
    /// Upper bound on the mean index, weighted by the terms of a sum.
    pub mean: f64,
}

/// Maximum number of terms of a ray; only damping beyond `r t ≈ 10¹⁰` requires more.
pub(super) const MOST_TERMS: i64 = 4_000_000;

impl<S: Analytic> Ray<S> {
    /// Returns the ray of travel time `a ≤ t`.
    pub fn new(damping: &S, travel: &S, time: &S) -> Self {
        Ray { xi: time.clone() - travel, eta: time.clone() + travel, damping: damping.clone() }
    }

    /// Returns the ray of travel time zero: `ξ = η = t`.
    pub fn at_source(damping: &S, time: &S) -> Self {
        Ray { xi: time.clone(), eta: time.clone(), damping: damping.clone() }
    }

    pub(super) fn map<T>(&self, f: impl Fn(&S) -> T) -> Ray<T> {
        Ray { xi: f(&self.xi), eta: f(&self.eta), damping: f(&self.damping) }
    }
}

impl<S: Rounded> Ray<S> {
    /// Returns `r/2`.
    pub(super) fn half(&self) -> S {
        self.damping.clone() / self.damping.int(2)
    }

    /// Returns `r √(ξη)`.
    pub(super) fn argument(&self) -> f64 {
        self.damping.to_f64() * (self.xi.to_f64().max(0.0) * self.eta.to_f64()).sqrt()
    }

    /// Returns `I_k(z)/I_{k−1}(z) (ξ/η)^{1/2}` for k = 1 … n.
    pub(super) fn ratios(&self, n: i64) -> Vec<S> {
        let (half, mut sigma) = (self.half(), self.xi.zero());
        let mut ratios = Vec::new();
        for k in (1..=self.terms(n).max(n + 2)).rev() {
            sigma = self.ratio(k, &sigma, &half) * &half;
            if k <= n {
                ratios.push(sigma.clone());
            }
        }
        ratios
    }

    /// Returns `ρ_n` from `σ_{n+1} = (r/2) ρ_{n+1}`; `(r/2) η σ` cannot overflow, since `σ < 1`.
    #[inline]
    fn ratio(&self, n: i64, next: &S, half: &S) -> S {
        self.xi.clone() / (half.clone() * &self.eta * next + self.xi.int(n))
    }

    /// Returns the number of terms that leave a relative rest below the roundoff, for weights that grow no faster than
    /// n³, from index `first` on.
    ///
    /// With z = r√(ξη): `I_n/I_{n−1} < z/(n−½+√((n−½)²+z²))` (Amos 1974, Segura 2011), so `(r/2)ρ_n < rξ/(n−½+√(…))`.
    /// These bounds decrease with n: the rest after n is at most its first term times the geometric series of the ratio
    /// there. Starting the recurrence with ρ = 0 changes `ρ_k` by the product of `(I_n/I_{n−1})(I_{n+1}/I_n)` from k
    /// on, which the second product bounds by its square.
    pub(super) fn terms(&self, first: i64) -> i64 {
        let z = self.argument() * (1.0 + 1e-12);
        let reach = self.damping.to_f64() * self.xi.to_f64().max(0.0) * (1.0 + 1e-12);
        let (mut rest, mut square) = (1.0f64, 1.0f64);
        let mut goal = bits(&self.xi) + 6.0;
        let mut n = first;
        if reach == 0.0 || !z.is_finite() {
            return first + 1;
        }
        if z < 4.0 && goal < 100.0 {
            // The same bounds without the root, `I_n/I_{n−1} < z/(2n−1)`, and without divisions.
            let (limit, z_square) = (negative_power(goal.ceil()), z * z);
            let mut size = 1.0f64;
            while n < 64 {
                n += 1;
                let (m, below) = (n as f64, (2 * n - 1) as f64);
                rest *= reach;
                square *= z_square;
                size *= below;
                // The ratio, with the growth of the weights, is below 1/2 from n = 10 on.
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

    /// Bounds the mean index over the terms of a sum from index `first` on, for weights with
    /// `c_n ≤ 1.2 (n/n₀)³ c_{n₀}`, which all weights here satisfy.
    ///
    /// Since `(r/2)ρ_n < rξ/(2n − 1)`, for `x = rξ ≤ 1` the terms relative to the first are
    /// `T_j ≤ 1.2 (1 + j/n₀)³ x/((2n₀+1)(2n₀+3)⋯(2n₀+2j−1))`, and `Σ j T_j` is greatest for `n₀ = 1`: less than
    /// `10.6 x`.
    fn mean_index(&self, first: i64, terms: i64) -> f64 {
        let reach = self.damping.to_f64() * self.xi.to_f64().max(0.0);
        if reach <= 1.0 { (first as f64 + 10.6 * reach).min(terms as f64) } else { terms as f64 }
    }

    /// Computes the sums by the ratios, from `e^{−rt} ψ₀` with its roundings.
    ///
    /// **Accuracy**: the weights are nonnegative, so the relative error is at most `sum_roundings` roundings. In the
    /// n-th term each ratio adds 4 roundings and inherits those of its successor times `I_{n+1}/I_{n−1}`; summed over
    /// all N by `asinh s ≥ 0.88 s` (s ≤ 1) that is at most `4n + 2.3 z (2 + ln 2N)`. Horner's rule adds 3n. The mean of
    /// n enters the result.
    #[inline]
    pub(super) fn sums_by_ratios<const K: usize>(
        &self,
        first: [i64; K],
        weight: impl Fn(i64) -> [i64; K],
        (start, start_roundings): (S, f64),
    ) -> RoundedSums<S, K> {
        let last = first.iter().copied().max().unwrap_or(1);
        let (terms, half) = (self.terms(last), self.half());
        let mut sigma = self.xi.zero();
        let mut sums: [S; K] = std::array::from_fn(|_| self.xi.zero());
        // The factors of ψ_n = ψ_0 ρ_1 ⋯ ρ_n up to n₀ are multiplied at the end of the pass, when n comes down to n₀.
        let mut heads: [S; K] = std::array::from_fn(|_| start.clone());
        for n in (1..=terms).rev() {
            let weights = weight(n);
            for k in 0..K {
                if n >= first[k] {
                    sums[k] = sums[k].clone() * &sigma + self.xi.int(weights[k]);
                }
            }
            let rho = self.ratio(n, &sigma, &half);
            sigma = rho.clone() * &half;
            if n <= last {
                for k in 0..K {
                    if n <= first[k] {
                        heads[k] = heads[k].clone() * &rho;
                    }
                }
            }
        }
        let sums = std::array::from_fn(|k| sums[k].clone() * &heads[k]);
        let (n, mean) = (terms as f64, self.mean_index(last, terms));
        let sum_roundings = if terms >= MOST_TERMS {
            f64::INFINITY
        } else {
            start_roundings + 16.0 + 7.0 * mean + 2.3 * self.argument() * (2.0 + (2.0 * n).ln())
        };
        RoundedSums { values: RaySums { start, sums }, start_roundings, sum_roundings, terms, mean }
    }
}

/// Returns the number of bits of the significand, limited to those that sums carry.
pub(super) fn bits<S: Scalar>(like: &S) -> f64 {
    (-like.log2_roundoff()).clamp(1.0, 1e6)
}

/// Returns `2^{−n}` for the integer part of n; zero below the normal doubles.
#[inline]
fn negative_power(n: f64) -> f64 {
    if (0.0..1022.0).contains(&n) { f64::from_bits((1023 - n as u64) << 52) } else { 0.0 }
}
