//! Stress, field and centre of mass during the first contact, as sums over the rays that have arrived.

use crate::history::{Field, Side};
use crate::number::{Analytic, Scalar};
use crate::rod::Parameters;
use crate::special::{Ray, i1_scaled, negative_power, phi1, phi2};

/// A value and how far it may be off.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate<S> {
    /// The value.
    pub value: S,
    /// A bound of the rounding errors in it, from the magnitudes that were added up; infinite where nothing is known.
    /// Zero for enclosures, which hold it in themselves.
    pub error: f64,
}

/// The rod that hit the ground undeformed at `t = 0` with uniform velocity `−μ`, while the contact lasts.
///
/// **Source**: (2.19)–(2.28), (3.38), (3.39), with the integrals done term by term.
///
/// **Units**: any consistent units.
///
/// **Accuracy**: each [`Estimate`] carries the bound of its own rounding errors: the magnitudes of all terms, times the
/// roundings in each. Where `r t` is large and `R < π` the terms cancel, and the bound says so.
///
/// ```
/// # use dalembert::{Number, Problem, rod::Parameters, first_contact::FirstContact, history::Side};
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
/// let contact = FirstContact::new(&Parameters::<f64>::of(&problem, &())?);
/// assert_eq!(contact.stress(&1.0, Side::Right).value, -4.0);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FirstContact<S> {
    pub(super) rod: Parameters<S>,
    pub(super) round_trip: S,
    /// `μ₀`.
    pub(super) critical: S,
    /// `R = r t₁`.
    pub(super) damping: S,
}

/// The solutions for `μ = 1, g = 0` and for `μ = 0, g = 1`, and their roundings, in units of the roundoff.
#[derive(Clone, Debug)]
pub(super) struct Parts<S> {
    pub(super) impact: Sum<S>,
    pub(super) weight: Sum<S>,
}

/// A sum that remembers how much rounding went into it.
#[derive(Clone, Debug)]
pub(super) struct Sum<S> {
    pub(super) value: S,
    pub(super) roundings: f64,
}

impl<S: Analytic> Sum<S> {
    fn new(value: S, roundings: f64) -> Self {
        let roundings = value.to_f64().abs() * roundings;
        Sum { value, roundings }
    }

    /// Adds `term`, which has `roundings` relative ones; eight more are for what is done with it.
    fn add(&mut self, term: S, roundings: f64) {
        let size = term.to_f64().abs();
        self.value = self.value.clone() + term;
        self.roundings += size * (roundings + 8.0) + self.value.to_f64().abs();
    }
}

/// More rays than this are not summed.
const MOST_RAYS: i64 = 1 << 20;

/// `(−1)^j term`.
fn alternate<S: Scalar>(j: i64, term: S) -> S {
    if j % 2 == 0 { term } else { -term }
}

impl<S: Analytic> FirstContact<S> {
    /// The first contact of a rod with these parameters.
    pub fn new(rod: &Parameters<S>) -> Self {
        let round_trip = rod.round_trip();
        let damping = rod.damping.clone() * &round_trip;
        FirstContact { critical: rod.critical_speed(), rod: rod.clone(), round_trip, damping }
    }

    /// `t₁ = 2L/c`.
    pub fn round_trip(&self) -> S {
        self.round_trip.clone()
    }

    /// `t/t₁`, and exactly k within rounding of the k-th lattice time.
    pub(super) fn trips(&self, time: &S) -> S {
        let trips = time.clone() / &self.round_trip;
        let nearest = (trips.clone() + trips.ratio(1, 2)).floor_int();
        match nearest {
            Some(k) if time.meets(&(self.round_trip.int(k) * &self.round_trip)) => time.int(k),
            _ => trips,
        }
    }

    /// How many lattice times `k t₁`, `k ≥ 1`, have passed: `None` beyond what is summed.
    pub(super) fn passed(trips: &S, side: Side) -> Option<i64> {
        let whole = trips.floor_int()?;
        let whole = if side == Side::Left && *trips == trips.int(whole) { whole - 1 } else { whole };
        (whole <= MOST_RAYS).then_some(whole.max(0))
    }

    /// The bound that `roundings` stand for.
    pub(super) fn bound(&self, roundings: f64) -> f64 {
        if S::RIGOROUS {
            return 0.0;
        }
        // Below the least double a bound is still no promise of exactness.
        (roundings * negative_power(-self.damping.log2_roundoff())).max(f64::MIN_POSITIVE)
    }

    /// `factor (μ impact + μ₀ weight)`.
    pub(super) fn combine(&self, parts: &Parts<S>, factor: &S) -> Estimate<S> {
        let impact = parts.impact.value.clone() * &self.rod.speed;
        let weight = parts.weight.value.clone() * &self.critical;
        let (mu, mu0) = (self.rod.speed.to_f64().abs(), self.critical.to_f64().abs());
        let roundings = mu * parts.impact.roundings + mu0 * parts.weight.roundings;
        let size = impact.to_f64().abs() + weight.to_f64().abs();
        let error = self.bound((roundings + 6.0 * size) * factor.to_f64().abs());
        Estimate { value: (impact + weight) * factor, error }
    }

    /// `e^{−rt} H_r` and `e^{−rt} G_r/t₁` with the first `k` returning rays: `v_x(0,t) = −(μ · + μ₀ ·)/c`.
    pub(super) fn ground(&self, trips: &S, k: i64) -> Parts<S> {
        let zero = trips.zero();
        let mut parts = Parts { impact: Sum::new(zero.clone(), 0.0), weight: Sum::new(zero, 0.0) };
        for j in 0..=k {
            let ray = Ray::new(&self.damping, &trips.int(j), trips);
            if j == 0 {
                // `G_r = t (I₀ + I₁)` before the first return.
                let (start, roundings) = ray.start();
                if !self.critical.is_zero() {
                    let both = start.clone() + i1_scaled(&(self.damping.clone() * trips));
                    parts.weight.add(both * trips, roundings + 4.0);
                }
                parts.impact.add(start, roundings);
                continue;
            }
            let twice = trips.int(2);
            if self.critical.is_zero() {
                let (start, roundings) = ray.start();
                parts.impact.add(alternate(j, start * &twice), roundings);
                continue;
            }
            let sums = ray.sums([1], |n| [n]);
            let [force] = sums.sums;
            parts.impact.add(alternate(j, sums.start * &twice), sums.start_roundings);
            parts.weight.add(alternate(j, force * &twice), sums.sum_roundings);
        }
        parts
    }

    /// `v_x(0,t) = e^{−rt} Ψ_r(t)`: the stress at the ground divided by the modulus.
    ///
    /// **Source**: (2.28).
    pub fn stress(&self, time: &S, side: Side) -> Estimate<S> {
        let trips = self.trips(time);
        match Self::passed(&trips, side) {
            Some(k) => self.combine(&self.ground(&trips, k), &(-(trips.one() / &self.rod.wave_speed))),
            None => Estimate { value: trips.zero(), error: f64::INFINITY },
        }
    }

    /// `e^{−rt} H_r(t)`, with its sign and jumps as in (2.27): the stress for `μ = c` and `g = 0`, turned around.
    pub fn impact_kernel(&self, time: &S, side: Side) -> Estimate<S> {
        self.kernel(time, side, |parts| parts.impact, &time.one())
    }

    /// `e^{−rt} G_r(t)`, `G_r = ∫₀ᵗ e^{r(t−τ)} H_r(τ) dτ`: the weight's share of (2.28). Zero terms are summed for
    /// `g = 0`.
    pub fn weight_kernel(&self, time: &S, side: Side) -> Estimate<S> {
        self.kernel(time, side, |parts| parts.weight, &self.round_trip)
    }

    fn kernel(&self, time: &S, side: Side, part: impl Fn(Parts<S>) -> Sum<S>, unit: &S) -> Estimate<S> {
        let trips = self.trips(time);
        match Self::passed(&trips, side) {
            Some(k) => {
                let sum = part(self.ground(&trips, k));
                let error = self.bound(sum.roundings * unit.to_f64());
                Estimate { value: sum.value * unit, error }
            }
            None => Estimate { value: trips.zero(), error: f64::INFINITY },
        }
    }

    /// `V`, `V_t`, `V_x` at the travel time `a` from the ground, `0 ≤ a ≤ 1/2`.
    pub(super) fn field_parts(&self, a: &S, trips: &S, side: Side) -> Option<[Parts<S>; 3]> {
        let arrived = |_, travel: &S, _| if travel.meets(trips) { side == Side::Right } else { travel < trips };
        self.field_of(a, trips, arrived)
    }

    /// The same with those rays, the j-th of a travel time, upwards or downwards, that have `arrived`.
    pub(super) fn field_of(&self, a: &S, trips: &S, arrived: impl Fn(i64, &S, bool) -> bool) -> Option<[Parts<S>; 3]> {
        let (r, one) = (&self.damping, trips.one());
        let fall = -(r.int(2) * r * trips);
        let (fallen, dropped) = (-(phi1(&fall) * trips), -(phi2(&fall) * &trips.square()));
        let free = 6.0 + 2.0 * fall.to_f64().abs().min(64.0);
        let mut value = Parts { impact: Sum::new(fallen.clone(), free), weight: Sum::new(dropped, free + 16.0) };
        let mut rate = Parts { impact: Sum::new(-fall.exp(), free), weight: Sum::new(fallen, free) };
        let mut slope = Parts { impact: Sum::new(one.zero(), 0.0), weight: Sum::new(one.zero(), 0.0) };
        let rays = Self::passed(trips, Side::Right)?;
        let quarter = r.square() / r.int(2);
        for j in 0..=rays {
            for (travel, down) in [(r.int(j) + a, false), (r.int(j + 1) - a, true)] {
                if !arrived(j, &travel, down) {
                    continue;
                }
                let ray = Ray::new(r, &travel, trips);
                let sums = ray.sums([1, 2, 2, 1, 1], |n| {
                    let odd = n % 2;
                    [odd, 1 - odd, n * n / 4, n, (n * n + 1) / 2]
                });
                let [odd, even, u2, force, rise] = sums.sums;
                let (near, far) = (sums.start_roundings, sums.sum_roundings);
                value.impact.add(alternate(j, odd.clone()), far);
                value.weight.add(alternate(j, u2.clone()), far);
                // ∂_t U − R U, for both parts.
                rate.impact.add(alternate(j, sums.start.clone()), near);
                rate.impact.add(alternate(j, even * &quarter), far);
                rate.impact.add(alternate(j + 1, odd * r), far);
                rate.weight.add(alternate(j, rise), far);
                rate.weight.add(alternate(j + 1, u2 * r), far);
                // ∂_a U has the sign of the ray's direction.
                let turn = if down { j } else { j + 1 };
                slope.impact.add(alternate(turn, sums.start), near);
                slope.weight.add(alternate(turn, force), far);
            }
        }
        Some([value, rate, slope])
    }

    /// `v`, `v_t`, `v_x` at `(x,t)`, with one bound for each.
    ///
    /// **Source**: (2.22)–(2.24).
    pub fn field(&self, point: &S, time: &S, side: Side) -> (Field<S>, [f64; 3]) {
        let trips = self.trips(time);
        let a =
            if *point == self.rod.length { point.ratio(1, 2) } else { point.clone() / &self.rod.length / point.int(2) };
        let one = trips.one();
        let Some([value, rate, slope]) = self.field_parts(&a, &trips, side) else {
            let zero = || one.zero();
            return (Field { displacement: zero(), velocity: zero(), strain: zero() }, [f64::INFINITY; 3]);
        };
        let displacement = self.combine(&value, &self.round_trip);
        let velocity = self.combine(&rate, &one);
        let strain = self.combine(&slope, &(one.clone() / &self.rod.wave_speed));
        let errors = [displacement.error, velocity.error, strain.error];
        (Field { displacement: displacement.value, velocity: velocity.value, strain: strain.value }, errors)
    }

    /// A bound of `v_t`, `c v_x` and `v_t − h′` where the travel time a is complex, at most `δ = beyond` from the rod.
    ///
    /// Let X, Y be `|ξ|`, `|η|` of one ray. The coefficients of every ψ_n are positive, so `|ψ_n(ξ,η)| ≤ ψ_n(X,Y)`, and
    /// `(R/2)ⁿ ψ_n(X,Y) = qⁿ I_n(z)` with `q² = X/Y`, `z² = R²XY`. Let `A = e^{−Rτ} Σ_{n≥0} qⁿI_n`; then A is at most `e^{Rκ}`, as
    /// - `Σ_{n≥0} qⁿI_n ≤ Σ_ℤ qⁿI_n = e^{R(X+Y)/2}`, and ξ and η are at most δ from real values with the sum 2τ: `κ ≤ δ`;
    /// - `(X+Y)/2` is also at most the root of the mean of X² and Y², `√(τ² + |a|²)`: `κ ≤ √(τ²+2δ²) − τ` where `Re a < 0`;
    /// - otherwise q ≤ 1 and `Σ_{n≥0} qⁿI_n ≤ (e^z + I₀)/2 ≤ e^z`. For `Im a = y`, `(XY)² = (τ² − x² + y²)² + 4x²y²` is convex in x²,
    ///   so at most what it is at x = 0, `(τ²+y²)²`, or at x = τ + δ, where X ≤ √2 δ, Y ≤ 2(τ+δ): κ is at most the greater of
    ///   `√(τ²+δ²) − τ` and `√(3δ(τ+δ)) − τ`.
    ///
    /// Further X ≤ s = τ + δ, and
    /// - the impact adds `I₀ + 2Σ(±q)ⁿI_n` to `v_t` and `I₀` to `c v_x`, at most 2A each;
    /// - by `2n I_n = z(I_{n−1} − I_{n+1}) ≤ z I_{n−1}`, the weight's `(2/R) Σ n qⁿ I_n` in `c v_x` is at most XA, and
    ///   `(2/R) Σ n² qⁿ I_n ≤ X(1 + RX/2)A`; in `v_t` no coefficient exceeds `n² + ½`: at most `X(3/2 + RX/2)A`.
    ///
    /// No more than 2τ + 2 rays have arrived, free fall is at most μ + μ₀τ, and h′ is a mean of the real `v_t`.
    pub(super) fn amplitude(&self, tau: f64, beyond: f64, mu: f64, mu0: f64) -> f64 {
        let (r, s) = (self.damping.to_f64(), tau + beyond);
        let each = 2.0 * mu + 2.0 * mu0 * s * (1.0 + r * s);
        let square = 2.0 * beyond * beyond;
        let mean = square / ((tau * tau + square).sqrt() + tau);
        let growth = beyond.min(mean.max((3.0 * beyond * s).sqrt() - tau));
        ((4.0 * tau + 6.0) * each * (r * growth).exp()).max(1e-150)
    }

    /// `h(t)` and `h′(t) = P/L`: the centre of mass, relative to its place in the undeformed rod on the ground.
    ///
    /// **Source**: (3.38), (3.39).
    pub fn centre(&self, time: &S) -> (Estimate<S>, Estimate<S>) {
        self.centre_at(&self.trips(time))
    }

    /// The same at `t/t₁`.
    pub(super) fn centre_at(&self, trips: &S) -> (Estimate<S>, Estimate<S>) {
        match self.centre_parts(trips) {
            Some([height, rate]) => (self.combine(&height, &self.round_trip), self.combine(&rate, &trips.one())),
            None => {
                let unknown = Estimate { value: trips.zero(), error: f64::INFINITY };
                (unknown.clone(), unknown)
            }
        }
    }

    /// `h/t₁` and `h′` for `μ = 1` and for `μ₀ = 1`.
    pub(super) fn centre_parts(&self, trips: &S) -> Option<[Parts<S>; 2]> {
        let r = &self.damping;
        let rays = Self::passed(trips, Side::Left)?;
        let fall = -(r.int(2) * r * trips);
        let (fallen, dropped) = (-(phi1(&fall) * trips), -(phi2(&fall) * &trips.square()));
        let free = 6.0 + 2.0 * fall.to_f64().abs().min(64.0);
        let mut height = Parts { impact: Sum::new(fallen.clone(), free), weight: Sum::new(dropped, free + 16.0) };
        let mut rate = Parts { impact: Sum::new(-fall.exp(), free), weight: Sum::new(fallen, free) };
        for j in 0..=rays {
            let ray = Ray::new(r, &r.int(j), trips);
            let sums = ray.sums([2, 3, 1, 2], |n| {
                let (even, odd) = ((n + 1) % 2, n % 2);
                let cube = n * (n * n - 1);
                let b = if n % 2 == 0 { n * (n * n - 4) / 24 } else { cube / 24 };
                let slope = if n % 2 == 0 { n * (n * n + 2) / 12 } else { cube / 12 };
                [even * n / 2, b, odd * n, slope]
            });
            let [b1, b2, d1, d2] = sums.sums;
            // c/L is 2 in these units; every ray but the first counts twice.
            let factor = r.int(if j == 0 { 2 } else { 4 });
            let damped = factor.clone() * r;
            let far = sums.sum_roundings;
            height.impact.add(alternate(j, b1.clone() * &factor), far);
            height.weight.add(alternate(j, b2.clone() * &factor), far);
            rate.impact.add(alternate(j, d1 * &factor), far);
            rate.impact.add(alternate(j + 1, b1 * &damped), far);
            rate.weight.add(alternate(j, d2 * &factor), far);
            rate.weight.add(alternate(j + 1, b2 * &damped), far);
        }
        Some([height, rate])
    }
}
