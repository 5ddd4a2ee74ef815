//! Stress, field and centre of mass during the first contact, as sums over the rays that have arrived.

use crate::motion::{Field, Side};
use crate::number::Scalar;
use crate::problem::Parameters;
use crate::special::{BoundedSpecial, Ray};

/// The rod that hit the ground undeformed at `t = 0` with uniform velocity `−μ`, during the contact.
///
/// **Source**: (2.19)–(2.28), (3.38), (3.39), with the integrals evaluated term by term.
///
/// **Units**: any consistent units.
///
/// **Accuracy**: *within its own bound*: estimates carry the magnitudes of all terms times the roundings in each,
/// enclosures their ends. Where `r t` is large and `R < π` the terms cancel, and the bound shows it. A time that is a
/// lattice time `k t₁` within its bound is taken for that, a point that a ray is reaching for one on the ray. A value
/// has no finite bound if an enclosure leaves open which rays have arrived.
///
/// ```
/// # use dalembert::{Estimate, Number, Parameters, Problem, Side};
/// # use dalembert::engine::FirstContact;
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
/// let contact = FirstContact::new(&Parameters::<Estimate<f64>>::of(&problem, &())?);
/// let stress = contact.strain(&Estimate::exact(1.0), Side::Right);
/// assert!(*stress.value() == -4.0 && stress.bound() < 1e-14);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FirstContact<N> {
    /// Parameters as given: enclosures with the exact numbers inside, which decide comparisons.
    pub(super) rod: Parameters<N>,
    pub(super) round_trip: N,
    /// `μ`, as a number for sums, like all fields below.
    pub(super) speed: N,
    /// `μ₀`.
    pub(super) critical: N,
    /// `R = r t₁`.
    pub(super) damping: N,
    pub(super) slowness: N,
    pub(super) weightless: bool,
}

/// A time of the first contact in round trips.
#[derive(Clone, Debug)]
pub struct Trips<N> {
    /// `τ = t/t₁`, with the exact number inside if it is known.
    pub(super) exact: N,
    /// `τ` as a number for sums.
    pub(super) number: N,
    /// Number of round trips that have passed.
    pub(super) passed: i64,
    /// Whether the last of them has just passed: `τ` is that number.
    pub(super) on_lattice: bool,
}

impl<N> Trips<N> {
    /// Returns `k` if the time is `k t₁`.
    pub fn lattice(&self) -> Option<i64> {
        self.on_lattice.then_some(self.passed)
    }

    pub(super) fn returned(&self, side: Side) -> i64 {
        (self.passed - i64::from(self.on_lattice && side == Side::Left)).max(0)
    }
}

/// Solutions for `μ = 1, g = 0` and for `μ = 0, μ₀ = 1`.
#[derive(Clone, Debug)]
pub(super) struct Shares<N> {
    pub(super) impact: N,
    pub(super) weight: N,
}

impl<N: Scalar> Shares<N> {
    pub(super) fn minus(&self, other: &Self) -> Self {
        Shares { impact: self.impact.clone() - &other.impact, weight: self.weight.clone() - &other.weight }
    }
}

const MOST_RAYS: i64 = 1 << 20;

/// Adds `(−1)^j term` to `sum`.
fn alternate<N: Scalar>(sum: &mut N, j: i64, term: &N) {
    *sum = if j % 2 == 0 { sum.clone() + term } else { sum.clone() - term };
}

pub(super) fn unknown<N: Scalar>(like: &N) -> N {
    like.zero().widened(&like.double(f64::INFINITY))
}

impl<N: BoundedSpecial> FirstContact<N> {
    /// Builds the first contact of a rod with these parameters.
    pub fn new(rod: &Parameters<N>) -> Self {
        let round_trip = rod.round_trip();
        let critical = rod.gravity.clone() * &round_trip;
        FirstContact {
            speed: rod.speed.clone().without_exact(),
            damping: (rod.damping.clone() * &round_trip).without_exact(),
            weightless: rod.gravity.vanishes() == Ok(true),
            critical: critical.without_exact(),
            slowness: (rod.wave_speed.one() / &rod.wave_speed).without_exact(),
            rod: rod.clone(),
            round_trip,
        }
    }

    /// Returns the parameters.
    pub fn rod(&self) -> &Parameters<N> {
        &self.rod
    }

    /// Returns `t₁ = 2L/c`.
    pub fn round_trip(&self) -> N {
        self.round_trip.clone()
    }

    /// Computes `t/t₁`; `None` if the number of returned rays is undecided.
    #[inline]
    pub fn trips(&self, time: &N) -> Option<Trips<N>> {
        let exact = time.clone() / &self.round_trip;
        let passed = exact.floor_int().filter(|k| *k <= MOST_RAYS)?;
        let whole = exact.int(passed);
        let on_lattice = exact.compare(&whole).ok()?.is_eq();
        let number = if on_lattice { whole.without_exact() } else { exact.clone().without_exact() };
        Some(Trips { exact, number, passed, on_lattice })
    }

    /// Returns the k-th lattice time, in round trips.
    pub(super) fn lattice(&self, k: i64) -> Trips<N> {
        let exact = self.round_trip.int(k);
        Trips { number: exact.clone().without_exact(), exact, passed: k, on_lattice: true }
    }

    /// Computes `μ + μ₀`, a bound of `|v_t|` and `|c v_x|`. With `z = v − v_s`, `|z_t ± c z_x|` is at most `μ + μ₀/2`
    /// at the start and never grows, and `|c v_s′| ≤ μ₀/2`.
    pub(super) fn total_speed(&self) -> N {
        self.speed.clone() + &self.critical
    }

    /// Computes `μ impact + μ₀ weight`.
    pub(super) fn weighted(&self, shares: &Shares<N>) -> N {
        let impact = shares.impact.clone() * &self.speed;
        if self.weightless { impact } else { impact + shares.weight.clone() * &self.critical }
    }

    /// Computes `e^{−rt} H_r` and `e^{−rt} G_r/t₁` with the first `k` returning rays: `v_x(0,t) = −(μ · + μ₀ ·)/c`.
    pub(super) fn ground(&self, trips: &N, k: i64) -> Shares<N> {
        let z = self.damping.clone() * trips;
        let start = z.in_scaled(0);
        // `G_r = t (I₀ + I₁)` before the first return.
        let weight = if self.weightless { trips.zero() } else { (start.clone() + z.in_scaled(1)) * trips };
        let shares = Shares { impact: start, weight };
        if k < 1 {
            return shares;
        }
        let (returned, two) = (self.returned(trips, k), trips.int(2));
        Shares { impact: shares.impact + returned.impact * &two, weight: shares.weight + returned.weight * &two }
    }

    /// Sums the returning rays once; apart, as the first round trip is the most frequent and has none.
    #[inline(never)]
    fn returned(&self, trips: &N, k: i64) -> Shares<N> {
        let mut returned = Shares { impact: trips.zero(), weight: trips.zero() };
        for j in 1..=k {
            let ray = Ray::new(&self.damping, &trips.int(j), trips);
            if self.weightless {
                alternate(&mut returned.impact, j, &ray.start());
                continue;
            }
            let sums = ray.sums([1], |n| [n]);
            alternate(&mut returned.impact, j, &sums.start);
            alternate(&mut returned.weight, j, &sums.sums[0]);
        }
        returned
    }

    /// Computes `v_x(0,t) = e^{−rt} Ψ_r(t)`: the stress at the ground divided by the modulus.
    ///
    /// **Source**: (2.28).
    pub fn strain(&self, time: &N, side: Side) -> N {
        self.trips(time).as_ref().map_or_else(|| unknown(time), |trips| self.stress_at(trips, side))
    }

    pub(super) fn stress_at(&self, trips: &Trips<N>, side: Side) -> N {
        self.stress_in_cell(&trips.number, trips.returned(side))
    }

    /// Computes the stress with `k` returned rays.
    pub(super) fn stress_in_cell(&self, trips: &N, k: i64) -> N {
        -(self.weighted(&self.ground(trips, k)) * &self.slowness)
    }

    /// Computes `V`, `V_t`, `V_x` at the travel time `a` from the ground, `0 ≤ a ≤ 1/2`, with the numbers `arrived` of
    /// upward and downward rays that have arrived.
    pub(super) fn field_shares(&self, a: &N, trips: &N, arrived: [i64; 2], free: &[Shares<N>; 2]) -> [Shares<N>; 3] {
        let r = &self.damping;
        let [mut value, mut rate] = free.clone();
        let mut slope = Shares { impact: r.zero(), weight: r.zero() };
        let half_square = r.square() / r.int(2);
        for j in 0..arrived[0].max(arrived[1]) {
            for (travel, down) in [(r.int(j) + a, false), (r.int(j + 1) - a, true)] {
                if j >= arrived[usize::from(down)] {
                    continue;
                }
                let sums = Ray::new(r, &travel, trips).sums([1, 2, 2, 1, 1], |n| {
                    let odd = n % 2;
                    [odd, 1 - odd, n * n / 4, n, (n * n + 1) / 2]
                });
                let [odd, even, u2, force, rise] = sums.sums;
                alternate(&mut value.impact, j, &odd);
                alternate(&mut value.weight, j, &u2);
                // The difference ∂_t U − R U, for both parts.
                alternate(&mut rate.impact, j, &(even * &half_square + &sums.start - odd * r));
                alternate(&mut rate.weight, j, &(rise - u2 * r));
                // The derivative ∂_a U has the sign of the ray's direction.
                let turn = if down { j } else { j + 1 };
                alternate(&mut slope.impact, turn, &sums.start);
                alternate(&mut slope.weight, turn, &force);
            }
        }
        [value, rate, slope]
    }

    /// Computes the free fall at `t/t₁`, common to all points of the rod: `v/t₁` and `v_t`.
    pub(super) fn free_fall(&self, trips: &N) -> [Shares<N>; 2] {
        let fall = -(self.damping.int(2) * &self.damping * trips);
        let (fallen, dropped) = (-(fall.phi1() * trips), -(fall.phi2() * &trips.square()));
        let rate = Shares { impact: -fall.exp(), weight: fallen.clone() };
        [Shares { impact: fallen, weight: dropped }, rate]
    }

    /// Computes `v`, `v_t`, `v_x` at `(x,t)`.
    ///
    /// **Source**: (2.22)–(2.24).
    pub fn field(&self, point: &N, time: &N, side: Side) -> Field<N> {
        let trips = self.trips(time);
        trips.map_or_else(|| nowhere(time), |trips| self.field_at(point, &trips, side))
    }

    pub(super) fn field_at(&self, point: &N, trips: &Trips<N>, side: Side) -> Field<N> {
        let top = point.compare(&self.rod.length).is_ok_and(std::cmp::Ordering::is_eq);
        let a = if top { point.ratio(1, 2) } else { point.clone() / &self.rod.length / point.int(2) };
        // The j-th upward ray arrives after j + a round trips, the j-th downward ray after j + 1 − a.
        let count = |reach: N| {
            let whole = reach.floor_int()?;
            let just = side == Side::Left && reach.compare(&reach.int(whole)).ok()?.is_eq();
            Some(whole + i64::from(!just))
        };
        let lattice = trips.on_lattice.then(|| trips.exact.int(trips.passed));
        let tau = lattice.as_ref().unwrap_or(&trips.exact);
        let arrived = (count(tau.clone() - &a), count(tau.clone() - a.one() + &a));
        let (Some(up), Some(down)) = arrived else { return nowhere(point) };
        let a = a.without_exact();
        let shares = self.field_shares(&a, &trips.number, [up, down], &self.free_fall(&trips.number));
        let [displacement, velocity, strain] = shares.map(|shares| self.weighted(&shares));
        Field {
            displacement: (displacement * &self.round_trip).without_exact(),
            velocity,
            strain: strain * &self.slowness,
        }
    }

    /// Computes `log₂` of a bound of `|v_t|/μ` and `c|v_x|/μ` from τ round trips on, if a rod without weight has faded
    /// so far that only this bound matters: the rays cancel, and numbers that tell when the stress is zero have twice
    /// the bits by which it has faded.
    ///
    /// For `g = 0`, `W = e^{Rτ} v` obeys `W_ττ − W_xx = R² W` in lengths `c t₁`, so `W_τ ± W_x`, which are reflected at
    /// both ends without growing, are at most their initial value μ plus `R² ∫ sup|W|`. For `R < π` no mode of W grows
    /// faster than τ, as `Ω_n² = ω_n² − R² > 0`, and for n ≥ 1 `Ω_n ≥ π√((2n+1)² − 1)`: with coefficients
    /// `4μ/((2n+1)π)` at first, `sup|W| ≤ 2μ(τ+1)`. So `|v_τ ± v_x| ≤ e^{−Rτ}(sup|W_τ ± W_x| + R sup|W|) ≤ e^{−Rτ} μ (1
    /// + R(τ+1))²`, which falls from `R(τ+1) = 1` on.
    pub(crate) fn faded(&self, tau: f64) -> Option<f64> {
        let r = self.damping.to_f64();
        let growth = 1.0 + r * (tau + 1.0);
        if !self.weightless || r >= std::f64::consts::PI || growth < 2.0 {
            return None;
        }
        // A thousandth less, for the roundings of R and τ.
        let bound = 2.0 * growth.log2() - 0.999 * r * tau * std::f64::consts::LOG2_E;
        (bound <= (0.25 * self.damping.log2_roundoff()).min(FADED_BITS)).then_some(bound)
    }

    /// Bounds `v_t`, `c v_x` and `v_t − h′` where the travel time a is complex, at most `δ = beyond` from the rod.
    ///
    /// Let X, Y be `|ξ|`, `|η|` of one ray. The coefficients of every ψ_n are positive, so `|ψ_n(ξ,η)| ≤ ψ_n(X,Y)`, and
    /// `(R/2)ⁿ ψ_n(X,Y) = qⁿ I_n(z)` with `q² = X/Y`, `z² = R²XY`. Let `A = e^{−Rτ} Σ_{n≥0} qⁿI_n`; then A is at most
    /// `e^{Rκ}`, as
    /// - `Σ_{n≥0} qⁿI_n ≤ Σ_ℤ qⁿI_n = e^{R(X+Y)/2}`, and ξ and η are at most δ from real values with the sum 2τ:
    ///   `κ ≤ δ`;
    /// - `(X+Y)/2` is also at most the root of the mean of X² and Y², `√(τ² + |a|²)`: `κ ≤ √(τ²+2δ²) − τ` where
    ///   `Re a < 0`;
    /// - otherwise q ≤ 1 and `Σ_{n≥0} qⁿI_n ≤ (e^z + I₀)/2 ≤ e^z`. For `Im a = y`, `(XY)² = (τ² − x² + y²)² + 4x²y²` is
    ///   convex in x², so at most what it is at x = 0, `(τ²+y²)²`, or at x = τ + δ, where X ≤ √2 δ, Y ≤ 2(τ+δ): κ is at
    ///   most the greater of `√(τ²+δ²) − τ` and `√(3δ(τ+δ)) − τ`.
    ///
    /// Further X ≤ s = τ + δ, and
    /// - the impact adds `I₀ + 2Σ(±q)ⁿI_n` to `v_t` and `I₀` to `c v_x`, at most 2A each;
    /// - by `2n I_n = z(I_{n−1} − I_{n+1}) ≤ z I_{n−1}`, the weight's `(2/R) Σ n qⁿ I_n` in `c v_x` is at most XA, and
    ///   `(2/R) Σ n² qⁿ I_n ≤ X(1 + RX/2)A`; in `v_t` no coefficient exceeds `n² + ½`: at most `X(3/2 + RX/2)A`.
    ///
    /// At most 2τ + 2 rays have arrived, free fall is at most μ + μ₀τ, and h′ is a mean of the real `v_t`.
    pub(super) fn amplitude(&self, tau: f64, beyond: f64, mu: f64, mu0: f64) -> f64 {
        let (r, s) = (self.damping.to_f64(), tau + beyond);
        let each = 2.0 * mu + 2.0 * mu0 * s * (1.0 + r * s);
        let square = 2.0 * beyond * beyond;
        let mean = square / ((tau * tau + square).sqrt() + tau);
        let growth = beyond.min(mean.max((3.0 * beyond * s).sqrt() - tau));
        ((4.0 * tau + 6.0) * each * (r * growth).exp()).max(1e-150)
    }

    /// Computes `h(t)` and `h′(t) = P/L` of the centre of mass, relative to its place in the undeformed rod on the
    /// ground.
    ///
    /// **Source**: (3.38), (3.39).
    pub fn centre(&self, time: &N) -> (N, N) {
        let trips = self.trips(time);
        trips.as_ref().map_or_else(|| (unknown(time), unknown(time)), |trips| self.centre_at(trips))
    }

    pub(super) fn centre_at(&self, trips: &Trips<N>) -> (N, N) {
        let [height, rate] = self.centre_shares(&trips.number, trips.returned(Side::Left));
        ((self.weighted(&height) * &self.round_trip).without_exact(), self.weighted(&rate))
    }

    /// Computes `h/t₁` and `h′`, with `k` returned rays.
    pub(super) fn centre_shares(&self, trips: &N, k: i64) -> [Shares<N>; 2] {
        let r = &self.damping;
        let [mut height, mut rate] = self.free_fall(trips);
        for j in 0..=k {
            let ray = if j == 0 { Ray::at_source(r, trips) } else { Ray::new(r, &r.int(j), trips) };
            // c/L is 2 in these units; every ray but the first counts twice.
            let factor = if j == 0 { 2 } else { 4 };
            let sums = ray.sums([2, 3, 1, 2], |n| {
                let (even, odd) = ((n + 1) % 2, n % 2);
                let cube = n * (n * n - 1);
                let b = if n % 2 == 0 { n * (n * n - 4) / 24 } else { cube / 24 };
                let slope = if n % 2 == 0 { n * (n * n + 2) / 12 } else { cube / 12 };
                [even * n / 2, b, odd * n, slope].map(|weight| factor * weight)
            });
            let [b1, b2, d1, d2] = sums.sums;
            alternate(&mut rate.impact, j, &(d1 - b1.clone() * r));
            alternate(&mut rate.weight, j, &(d2 - b2.clone() * r));
            alternate(&mut height.impact, j, &b1);
            alternate(&mut height.weight, j, &b2);
        }
        [height, rate]
    }
}

/// `log₂` of the size below which only a bound of the motion matters.
const FADED_BITS: f64 = -128.0;

fn nowhere<N: Scalar>(like: &N) -> Field<N> {
    Field { displacement: unknown(like), velocity: unknown(like), strain: unknown(like) }
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/field.rs"]
mod tests;
