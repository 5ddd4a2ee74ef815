//! The bounce time `t_b`: the first root or jump of the stress, or the reason why there is none.

use std::cmp::Ordering;

use super::field::{FirstContact, Sum};
use crate::history::Side;
use crate::modal::Modal;
use crate::number::Analytic;
use crate::special::roundoff;

/// How the contact ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Bounce<S> {
    /// The ground lets go.
    At {
        /// `t_b`.
        time: S,
        /// At a jump of the stress or at a root.
        kind: BounceKind,
        /// How far `time` may be off; zero for a jump, whose time is `k t₁`.
        error: f64,
    },
    /// The stress never becomes tensile.
    Never {
        /// Why.
        reason: String,
    },
    /// Neither could be shown.
    Undecided {
        /// Up to here there is no bounce.
        until: S,
        /// What stands in the way.
        why: String,
        /// Whether a longer number could settle it.
        digits: bool,
    },
}

/// What the stress does at the bounce.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BounceKind {
    /// It jumps to a tensile value at a lattice time `k t₁`.
    Jump,
    /// It rises through zero.
    Root,
}

/// How the search for the bounce ends.
pub(crate) enum Found<S> {
    /// With an answer.
    Answer(Bounce<S>),
    /// At the jump after this many round trips.
    Jump(i64),
    /// At a root.
    Root(Bracket<S>),
}

/// A part of a cell that holds the first root of the stress, and no other.
pub(crate) struct Bracket<S> {
    /// The cell, by the round trips before it.
    pub(crate) cell: i64,
    /// Its ends, as numbers of round trips.
    pub(crate) from: S,
    /// See `from`.
    pub(crate) to: S,
    /// The force falls at least so fast in each round trip.
    pub(crate) slope: S,
}

/// Where the stress comes from.
#[derive(Clone, Debug)]
pub(super) enum Route<S> {
    /// The rays that have returned.
    Rays,
    /// The modes.
    Modes(Modal<S>),
}

/// Cells `(k t₁, (k+1) t₁)` that are searched.
const MOST_CELLS: i64 = 256;

impl<S: Analytic> FirstContact<S> {
    /// `t_b` (1.10): the end of the first contact.
    ///
    /// **Source**: Theorem 1, with (2.32) in closed form: `t_b = t₁` where `μ (2 − I₀(R)) > μ₀ (I₀(R) + I₁(R))`.
    /// Without damping Corollary 1 says all. Later cells are searched one by one on a Chebyshev sum whose rest is bounded, see [`Bounce::Undecided`] for
    /// when that fails. "Never" is shown in one of two ways. For `R ≥ π`: the kernel `H_r` is positive, because its
    /// lowest mode, overdamped, exceeds the sum of all others from `t₁` on. For `R < π`: at some lattice time
    /// `|v_t ∓ c(v_x − v_s′)| < gL/c` throughout the rod; this largest Riemann invariant of the transient cannot
    /// grow, since `(∂_t ± c∂_x) p_± = −r (p₊ + p₋)`, and so the static stress wins at all later times.
    ///
    /// **Accuracy**: `error` bounds the rounding errors and the width of the last bracket. No root is reported that
    /// is not bracketed by signs beyond the rounding errors.
    ///
    /// ```
    /// # use dalembert::{Number, Problem, rod::Parameters, first_contact::{Bounce, BounceKind, FirstContact}};
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
    /// let contact = FirstContact::new(&Parameters::<f64>::of(&problem, &())?);
    /// assert_eq!(contact.bounce(), Bounce::At { time: 2.0, kind: BounceKind::Jump, error: 0.0 });
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn bounce(&self) -> Bounce<S> {
        self.bounce_by(&Route::Rays)
    }

    /// The same, with the stress from `route`.
    pub(super) fn bounce_by(&self, route: &Route<S>) -> Bounce<S> {
        match self.search(route) {
            Found::Jump(k) => {
                let time = self.round_trip.int(k) * &self.round_trip;
                Bounce::At { time, kind: BounceKind::Jump, error: 0.0 }
            }
            Found::Root(bracket) => self.refine(route, bracket),
            Found::Answer(answer) => answer,
        }
    }

    /// The search for the bounce, up to a bracket.
    pub(super) fn search(&self, route: &Route<S>) -> Found<S> {
        let (mu, mu0) = (&self.rod.speed, &self.critical);
        let total = mu.clone() + mu0;
        if mu.is_negative() || !total.is_finite() || !self.damping.is_finite() {
            let why = "an impact speed below zero, or a number that is not finite".into();
            return Found::Answer(Bounce::Undecided { until: mu.zero(), why, digits: false });
        }
        if total.is_zero() {
            return Found::Answer(Bounce::Never { reason: "neither speed nor gravity: nothing moves".into() });
        }
        if self.damping.is_zero() && mu.is_positive() {
            return Found::Answer(self.undamped_bounce());
        }
        // By far the most frequent answer.
        let (value, error) = self.force(route, &mu.one(), 1);
        if value < -error {
            return Found::Jump(1);
        }
        let first = match self.lowest_mode() {
            Ok(first) => first,
            Err(answer) => return Found::Answer(answer),
        };
        for k in first..=MOST_CELLS {
            let start = mu.int(k);
            let (value, error) = self.force(route, &start, k);
            if value < -error.clone() {
                return Found::Jump(k);
            }
            if value.partial_cmp(&error) != Some(Ordering::Greater) {
                let why = format!("just after t = {k} t₁ the stress cannot be told from zero");
                return Found::Answer(Bounce::Undecided { until: start * &self.round_trip, why, digits: true });
            }
            match self.cell(route, k) {
                Ok(None) => (),
                Ok(Some(bracket)) => return Found::Root(bracket),
                Err(why) => {
                    let until = start * &self.round_trip;
                    return Found::Answer(Bounce::Undecided { until, why, digits: true });
                }
            }
            let looked = k <= 4 || k.count_ones() <= 2 && k % 2 == 0;
            if looked && let Some(reason) = self.settled(k) {
                return Found::Answer(Bounce::Never { reason });
            }
        }
        let until = mu.int(MOST_CELLS + 1) * &self.round_trip;
        let why = format!("no bounce in {MOST_CELLS} round trips, which is the limit");
        Found::Answer(Bounce::Undecided { until, why, digits: false })
    }

    /// Corollary 1, which also settles `μ = μ₀`, where the stress is zero just after `t₁` and rises from there.
    fn undamped_bounce(&self) -> Bounce<S> {
        let (mu, mu0, t1) = (&self.rod.speed, &self.critical, &self.round_trip);
        let blur = roundoff(mu) * &mu.int(8);
        if *mu >= *mu0 {
            let sure = S::RIGOROUS || *mu > mu0.clone() + blur.clone() * mu0 || mu0.is_zero();
            let error = if sure { 0.0 } else { (blur * t1).to_f64() };
            return Bounce::At { time: t1.clone(), kind: BounceKind::Jump, error };
        }
        let time = t1.int(2) * t1 - mu.clone() / &self.rod.gravity;
        Bounce::At { error: (blur * &time).to_f64(), time, kind: BounceKind::Root }
    }

    /// `(μ e^{−rt}H_r + μ₀ e^{−rt}G_r/t₁)/(μ + μ₀)` with `k` returning rays, positive in contact; and its rounding
    /// error.
    pub(super) fn force(&self, route: &Route<S>, trips: &S, k: i64) -> (S, S) {
        let total = self.rod.speed.clone() + &self.critical;
        let (alpha, beta) = (self.rod.speed.clone() / &total, self.critical.clone() / &total);
        if let Route::Modes(modal) = route {
            let side = if *trips == trips.int(k + 1) { Side::Left } else { Side::Right };
            let [impact, weight] = modal.ground(trips, side);
            let unit = roundoff(trips).to_f64() * 8.0;
            let bound = |e: &crate::first_contact::Estimate<S>| e.error + unit * e.value.to_f64().abs();
            let error = alpha.double(bound(&impact)) * &alpha + beta.double(bound(&weight)) * &beta;
            return (impact.value * &alpha + weight.value * &beta, error);
        }
        let parts = self.ground(trips, k);
        if S::RIGOROUS {
            return (parts.impact.value * &alpha + parts.weight.value * &beta, trips.zero());
        }
        let bound = |sum: &Sum<S>, share: &S| share.double(sum.roundings + 8.0 * sum.value.to_f64().abs()) * share;
        let error = bound(&parts.impact, &alpha) + &bound(&parts.weight, &beta);
        (parts.impact.value * &alpha + parts.weight.value * &beta, error * &roundoff(trips))
    }

    /// What the lowest mode settles at once: "never" for `R ≥ π`, and otherwise the first cell that need be searched.
    ///
    /// `H_r = 4 Σ S_n`, `S_n = sin(Ω_n τ)/Ω_n`, `Ω_n² = ω_n² − R²`, `ω_n = (2n+1)π`, `τ = t/t₁`. Overdamped modes are
    /// positive. For `ω_n ≥ 2R`, `|S_n − sin(ω_nτ)/ω_n| ≤ (R²/2Ω_n)(τ/Ω_n + 1/Ω_n²)`, and
    /// `4 Σ_{all} sin(ω_nτ)/ω_n = ±1`, with `Ω_n² ≥ ¾ω_n²`, `Σ_{n≥N} ω_n⁻² ≤ ω_N⁻² + 1/2πω_N`,
    /// `Σ_{n≥N} ω_n⁻³ ≤ ω_N⁻³ + 1/4πω_N²`. Those between are at most τ and `1/Ω_n`. All others together are at most
    /// `b₀ + b₁τ`. For `R ≥ π`, `S_0` is convex, so one look at τ = 1 is enough for ever; for `R < π` it is concave
    /// up to `π/Ω_0`, so a look at τ = 1 and at τ = k is enough for all between. The doubles here stand against margins of one part
    /// in 10⁹: r and π are known to 10⁻¹⁶, so is R − π to `10⁻¹⁶/s²`, and below s = 10⁻⁶ nothing depends on s. Before, `H_r = I₀ > 0`. As long as
    /// H_r > 0, G_r > 0.
    fn lowest_mode(&self) -> Result<i64, Bounce<S>> {
        use std::f64::consts::PI;
        let pi = self.damping.pi();
        let margin = roundoff(&pi) * &pi.int(16);
        if (self.damping.clone() - &pi).magnitude() < margin {
            let why = "r t₁ cannot be told from π, from which on there is no bounce".into();
            return Err(Bounce::Undecided { until: self.round_trip.clone(), why, digits: true });
        }
        let r = self.damping.to_f64();
        let square = ((self.damping.clone() - &pi) * &(self.damping.clone() + &pi)).to_f64();
        let s = square.abs().sqrt();
        let overdamped = self.damping > pi;
        let (mut others, mut growth, mut square_wave) = (0.0, 0.0, 1.0 + 4.0 / PI);
        let mut omega = 3.0 * PI;
        // With R beyond 3·10⁶, sinh(s)/s overflows long before the modes in question, R/π of them, matter.
        while omega < 2.0 * r && omega < 2e7 {
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
        let rest = |trips: f64| (others + growth * trips) * (1.0 + 1e-9);
        if overdamped {
            let lowest = if s < 1e-6 { 4.0 } else { 4.0 * s.sinh() / s };
            if lowest > rest(1.0) && 4.0 * s.cosh() > growth {
                let ratio = lowest / rest(1.0);
                let times = if ratio < 1000.0 { format!("{ratio:.3}") } else { "more than 1000".into() };
                let reason = format!(
                    "r t₁ = {r:.6} ≥ π: the lowest mode is overdamped; at t₁ it presses {times} times as hard as all \
                     others together could pull, and it outgrows them from there"
                );
                return Err(Bounce::Never { reason });
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
        if k > MOST_CELLS {
            // The force is positive up to here, whether or not the transient has died away before.
            if let Some(reason) = [1, 2, 4, 8, 16].into_iter().find_map(|k| self.settled(k)) {
                return Err(Bounce::Never { reason });
            }
            let why = format!(
                "r t₁ = {r} is just below π: no bounce within the limit of {MOST_CELLS} round trips; without gravity it comes \
                 at about {:.4e} t₁",
                PI / s
            );
            return Err(Bounce::Undecided { until: self.round_trip.int(k) * &self.round_trip, why, digits: false });
        }
        Ok(k)
    }
}
