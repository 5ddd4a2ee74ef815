//! End of the contact: the bounce time `t_b`, the first root or jump of the stress, or the reason why there is none.

use super::field::FirstContact;
use super::outcome::{Bounce, BounceKind};
use super::round_trip::{Kernels, Search};
use crate::reason::{Doubt, NoBounceReason};
use crate::special::BoundedSpecial;

/// Number of cells `(k t₁, (k+1) t₁)` that are searched.
const MOST_CELLS: i64 = 256;

impl<N: BoundedSpecial> FirstContact<N> {
    /// Computes `t_b` (1.10): the end of the first contact.
    ///
    /// **Source**: Theorem 1, with (2.32) in closed form: `t_b = t₁` where `μ (2 − I₀(R)) > μ₀ (I₀(R) + I₁(R))`.
    /// Without damping Corollary 1 gives the complete result. Later cells are searched one by one on a Chebyshev sum
    /// with a bounded truncation error; [`Doubt`] lists the obstacles. "Never" is proved in one of two ways. For `R ≥
    /// π`: the kernel `H_r` is positive, because its lowest mode, overdamped, exceeds the sum of all others from `t₁`
    /// on. For `R < π`: at some lattice time `|v_t ∓ c(v_x − v_s′)| < gL/c` throughout the rod; this largest Riemann
    /// invariant of the transient cannot grow, since `(∂_t ± c∂_x) p_± = −r (p₊ + p₋)`, and so the static stress
    /// exceeds it at all later times.
    ///
    /// **Accuracy**: *within its own bound*. Every root returned is bracketed by signs beyond the bounds of the stress.
    ///
    /// ```
    /// # use dalembert::{Estimate, Number, Parameters, Problem};
    /// # use dalembert::engine::{Bounce, BounceKind, FirstContact};
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
    /// let contact = FirstContact::new(&Parameters::<Estimate<f64>>::of(&problem, &())?);
    /// let bounce = contact.bounce();
    /// assert!(matches!(bounce, Bounce::At { time, kind: BounceKind::Jump, .. } if *time.value() == 2.0));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn bounce(&self) -> Bounce<N> {
        self.search(&Search { contact: self, kernels: None })
    }

    /// Computes `t_b` likewise for one of many speeds of one damping, which share its `kernels`.
    pub fn bounce_sharing(&self, kernels: &Kernels<N>) -> Bounce<N> {
        self.search(&Search { contact: self, kernels: Some(kernels) })
    }

    fn search(&self, search: &Search<'_, N>) -> Bounce<N> {
        let (mu, total) = (&self.speed, self.total_speed());
        let undecided =
            |k: i64, why: Doubt| Bounce::Undecided { until: self.round_trip.int(k) * &self.round_trip, why };
        if mu.negative() == Ok(true) || !total.is_finite() || !self.damping.is_finite() {
            return undecided(0, Doubt::Parameters);
        }
        match (total.vanishes(), self.damping.vanishes(), mu.positive()) {
            (Ok(true), ..) => return Bounce::Never(NoBounceReason::NothingMoves),
            (_, Ok(true), Ok(true)) => return self.undamped_bounce(),
            _ => (),
        }
        let jump = |k: i64| {
            let trips = self.lattice(k);
            Bounce::At { time: trips.exact.clone() * &self.round_trip, trips, kind: BounceKind::Jump }
        };
        // The most frequent result by far.
        if self.force(&mu.one(), 1).negative() == Ok(true) {
            return jump(1);
        }
        let first = match self.lowest_mode(search) {
            Ok(first) => first,
            Err(answer) => return *answer,
        };
        for k in first..=MOST_CELLS {
            let after = self.force(&mu.int(k), k);
            if after.negative() == Ok(true) {
                return jump(k);
            }
            if after.positive() != Ok(true) {
                return undecided(k, Doubt::AtLattice(k));
            }
            match search.cell(k) {
                Ok(None) => (),
                Ok(Some(bracket)) => return search.refine(bracket),
                Err(why) => return undecided(k, why),
            }
            let looked = k <= 4 || k.count_ones() <= 2 && k % 2 == 0;
            if looked && let Some(reason) = self.settled(k, search.kernels) {
                return Bounce::Never(reason);
            }
        }
        undecided(MOST_CELLS + 1, Doubt::NoneFound(MOST_CELLS))
    }

    /// Applies Corollary 1, which also settles `μ = μ₀`, where the stress is zero just after `t₁` and rises from there.
    fn undamped_bounce(&self) -> Bounce<N> {
        let (mu, mu0, t1) = (&self.rod.speed, self.rod.gravity.clone() * &self.round_trip, &self.round_trip);
        let Ok(order) = mu.compare(&mu0) else {
            return Bounce::Undecided { until: t1.clone(), why: Doubt::Sizes };
        };
        if order.is_lt() {
            let time = t1.int(2) * t1 - mu.clone() / &self.rod.gravity;
            return match self.trips(&time) {
                Some(trips) => Bounce::At { time, trips, kind: BounceKind::Root },
                None => Bounce::Undecided { until: t1.clone(), why: Doubt::NearZero(2.0) },
            };
        }
        let mut time = t1.clone();
        if order.is_eq() {
            // If both are equal within a bound, the release is later by the part that the bound leaves open.
            time = time.widened(&((mu.clone() - mu0) / &self.rod.gravity));
        }
        Bounce::At { time, trips: self.lattice(1), kind: BounceKind::Jump }
    }

    /// Tests the lowest mode: the result is "never" for `R ≥ π`, otherwise the first cell that has to be searched.
    ///
    /// `H_r = 4 Σ S_n`, `S_n = sin(Ω_n τ)/Ω_n`, `Ω_n² = ω_n² − R²`, `ω_n = (2n+1)π`, `τ = t/t₁`. Overdamped modes are
    /// positive. For `ω_n ≥ 2R`, `|S_n − sin(ω_nτ)/ω_n| ≤ (R²/2Ω_n)(τ/Ω_n + 1/Ω_n²)`, and `4 Σ_{all} sin(ω_nτ)/ω_n =
    /// ±1`, with `Ω_n² ≥ ¾ω_n²`, `Σ_{n≥N} ω_n⁻² ≤ ω_N⁻² + 1/2πω_N`, `Σ_{n≥N} ω_n⁻³ ≤ ω_N⁻³ + 1/4πω_N²`. Those between
    /// are at most τ and `1/Ω_n`. All others together are at most `b₀ + b₁τ`. For `R ≥ π`, `S_0` is convex, so one test
    /// at τ = 1 suffices for all later times; for `R < π` it is concave up to `π/Ω_0`, so tests at τ = 1 and at τ = k
    /// suffice for all between. Late, modes up to `R²τ/4`, which lag behind, are bounded by their sizes too: from k to
    /// k + 1 the lowest is at least the lesser of both ends, and all others at most their values at k + 1. The doubles
    /// here face margins of one part in 10⁹: r and π are known to 10⁻¹⁶, so is R − π to `10⁻¹⁶/s²`, and below s = 10⁻⁶
    /// nothing depends on s. Before, `H_r = I₀ > 0`. As long as H_r > 0, G_r > 0.
    fn lowest_mode(&self, search: &Search<'_, N>) -> Result<i64, Box<Bounce<N>>> {
        use std::f64::consts::PI;
        let answer = |bounce| Err(Box::new(bounce));
        let pi = self.damping.pi();
        let apart = self.damping.clone() - &pi;
        let overdamped = match apart.sign() {
            Ok(order) if order.is_ne() => order.is_gt(),
            _ => return answer(Bounce::Undecided { until: self.round_trip.clone(), why: Doubt::NearPi }),
        };
        let r = self.damping.near().0;
        let s = (apart * &(self.damping.clone() + &pi)).near().0.abs().sqrt();
        // The coefficients b₀ and b₁, with the modes below `limit`, at least 2R, bounded by their sizes.
        let bounds = |limit: f64| {
            let (mut others, mut growth, mut square_wave) = (0.0, 0.0, 1.0 + 4.0 / PI);
            let mut omega = 3.0 * PI;
            // Beyond R = 3·10⁶, sinh(s)/s overflows long before the modes in question, R/π of them, matter.
            while omega < limit && omega < 2e7 {
                square_wave += 4.0 / omega;
                let below = omega * omega - r * r;
                if below > 0.25 {
                    others += 4.0 / below.sqrt();
                } else if below > -1e-9 * omega {
                    growth += 4.0;
                }
                omega += 2.0 * PI;
            }
            let squares = 1.0 / (omega * omega) + 1.0 / (2.0 * PI * omega);
            let cubes = 1.0 / omega.powi(3) + 1.0 / (4.0 * PI * omega * omega);
            growth += 4.0 * r * r / 1.5 * squares;
            others += square_wave + 4.0 * r * r / (2.0 * 0.75f64.powf(1.5)) * cubes;
            (others, growth)
        };
        let (others, growth) = bounds(2.0 * r);
        let rest = |trips: f64| (others + growth * trips) * (1.0 + 1e-9);
        if overdamped {
            let lowest = if s < 1e-6 { 4.0 } else { 4.0 * s.sinh() / s };
            if lowest > rest(1.0) && 4.0 * s.cosh() > growth {
                let margin = lowest / rest(1.0);
                return answer(Bounce::Never(NoBounceReason::Overdamped { damping_ratio: r, margin }));
            }
            return Ok(1);
        }
        let holds = |k: f64| s * k < PI && 4.0 * (s * k).sin() > rest(k) * s;
        if !holds(1.0) {
            return Ok(1);
        }
        let mut k = 1i64;
        while k <= MOST_CELLS && holds(k as f64 + 1.0) {
            k += 1;
        }
        let holds_late = |from: f64, to: f64| {
            let (others, growth) = bounds((2.0 * r).max(r * r * to / 4.0));
            let rest = (others + growth * to) * (1.0 + 1e-9);
            s * to < PI && 4.0 * (s * from).sin().min((s * to).sin()) > rest * s
        };
        while k <= MOST_CELLS && holds_late(k as f64, k as f64 + 1.0) {
            k += 1;
        }
        if k > MOST_CELLS {
            // The force is positive up to here, whether or not the transient has died away before.
            if let Some(reason) = [1, 2, 4, 8, 16].into_iter().find_map(|k| self.settled(k, search.kernels)) {
                return answer(Bounce::Never(reason));
            }
            let why = Doubt::Late { damping_ratio: r, cells: MOST_CELLS, expected: PI / s };
            let until = self.round_trip.int(k) * &self.round_trip;
            return answer(Bounce::Undecided { until, why });
        }
        Ok(k)
    }
}
