//! The bounce time `t_b`: the first root or jump of the stress, or the reason why there is none.

use super::field::{Estimate, FirstContact, Sum};
use super::search::{FirstRoot, coefficients, first_root};
use crate::history::Side;
use crate::number::Analytic;
#[cfg(feature = "mp")]
use crate::rod::Parameters;
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

/// Cells `(k t₁, (k+1) t₁)` that are searched.
const MOST_CELLS: i64 = 256;

impl<S: Analytic> FirstContact<S> {
    /// `t_b` (1.10): the end of the first contact.
    ///
    /// **Source**: Theorem 1, with (2.32) in closed form: `t_b = t₁` where `μ (2 − I₀(R)) > μ₀ (I₀(R) + I₁(R))`.
    /// Later cells are searched one by one on a Chebyshev sum whose rest is bounded, see [`Bounce::Undecided`] for
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
        let (mu, mu0) = (&self.rod.speed, &self.critical);
        let total = mu.clone() + mu0;
        if mu.is_negative() || !total.is_finite() || !self.damping.is_finite() {
            let why = "an impact speed below zero, or a number that is not finite".into();
            return Bounce::Undecided { until: mu.zero(), why, digits: false };
        }
        if total.is_zero() {
            return Bounce::Never { reason: "neither speed nor gravity: nothing moves".into() };
        }
        // By far the most frequent answer.
        let (value, error) = self.force(&mu.one(), 1);
        if value < -error {
            return Bounce::At { time: self.round_trip.clone(), kind: BounceKind::Jump, error: 0.0 };
        }
        let first = match self.lowest_mode() {
            Ok(first) => first,
            Err(answer) => return answer,
        };
        for k in first..=MOST_CELLS {
            let start = mu.int(k);
            let (value, error) = self.force(&start, k);
            if value < -error.clone() {
                let time = start * &self.round_trip;
                return Bounce::At { time, kind: BounceKind::Jump, error: 0.0 };
            }
            if value <= error {
                let why = format!("just after t = {k} t₁ the stress cannot be told from zero");
                return Bounce::Undecided { until: start * &self.round_trip, why, digits: true };
            }
            if let Some(end) = self.cell(k) {
                return end;
            }
            let looked = k <= 4 || k.count_ones() <= 2 && k % 2 == 0;
            if looked && let Some(reason) = self.settled(k) {
                return Bounce::Never { reason };
            }
        }
        let until = mu.int(MOST_CELLS + 1) * &self.round_trip;
        Bounce::Undecided {
            until,
            why: format!("no bounce in {MOST_CELLS} round trips, which is the limit"),
            digits: false,
        }
    }

    /// `(μ e^{−rt}H_r + μ₀ e^{−rt}G_r/t₁)/(μ + μ₀)` with `k` returning rays, positive in contact; and its rounding
    /// error.
    fn force(&self, trips: &S, k: i64) -> (S, S) {
        let parts = self.ground(trips, k);
        let total = self.rod.speed.clone() + &self.critical;
        let (alpha, beta) = (self.rod.speed.clone() / &total, self.critical.clone() / &total);
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
    /// up to `π/Ω_0`, so a look at τ = 1 and at τ = k is enough for all between. Before, `H_r = I₀ > 0`. As long as
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
                let reason = format!(
                    "r t₁ = {r:.6} ≥ π: the lowest mode is overdamped and has taken over; at t₁ it presses with {lowest:.4} \
                     where all others pull with less than {:.4}, and it outgrows them from there",
                    rest(1.0)
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
            let why = format!(
                "r t₁ = {r} is just below π: no bounce within the limit of {MOST_CELLS} round trips; without gravity it comes \
                 at about {:.4e} t₁",
                PI / s
            );
            return Err(Bounce::Undecided { until: self.round_trip.int(k) * &self.round_trip, why, digits: false });
        }
        Ok(k)
    }

    /// Whether, at `k t₁`, the transient is below the static stress everywhere in the rod: then it stays so.
    fn settled(&self, k: i64) -> Option<String> {
        const NODES: usize = 24;
        if self.critical.is_zero() {
            return None;
        }
        let trips = self.damping.int(k);
        let total = self.rod.speed.clone() + &self.critical;
        let (alpha, beta) = (self.rod.speed.clone() / &total, self.critical.clone() / &total);
        let (mut upward, mut downward) = (Vec::with_capacity(NODES + 1), Vec::with_capacity(NODES + 1));
        let mut roundings = 0.0f64;
        let share = beta.to_f64() / 2.0;
        for j in 0..=NODES {
            let node = (std::f64::consts::PI * j as f64 / NODES as f64).cos();
            // The ends belong to the open interval: their rays are those that have arrived inside.
            let a = trips.double((0.25 + 0.25 * node).clamp(1e-12, 0.5 - 1e-12));
            let [_, rate, slope] = self.field_parts(&a, &trips, Side::Right)?;
            let velocity = rate.impact.value * &alpha + rate.weight.value * &beta;
            let held = a - trips.ratio(1, 2);
            let strain = slope.impact.value * &alpha + (slope.weight.value - held) * &beta;
            let (up, down) = ((velocity.clone() - &strain).to_f64(), (velocity + strain).to_f64());
            if up.abs().max(down.abs()) > share {
                return None;
            }
            upward.push(up);
            downward.push(down);
            roundings +=
                rate.impact.roundings + rate.weight.roundings + slope.impact.roundings + slope.weight.roundings;
        }
        let size = |values: &[f64]| coefficients(values).iter().map(|c| c.abs()).sum::<f64>();
        // Interpolation in a, from the ellipse ρ = 8 around the rod.
        let interpolation =
            4.0 * self.amplitude(k as f64, (8.0 - 1.0 / 8.0) / 8.0, 1.0, 1.0) * 8f64.powi(-(NODES as i32));
        // Nodes at the ends were moved by 10⁻¹².
        let rest = interpolation + self.bound(roundings) + 1e-9;
        let largest = size(&upward).max(size(&downward)) + rest;
        (largest < share * (1.0 - 1e-9)).then(|| {
            let part = largest / share;
            format!(
                "from t = {k} t₁ on the transient stays below {part:.4} of the static stress gL/c², and the rod settles under its weight"
            )
        })
    }

    /// The first root inside `(k t₁, (k+1) t₁)`, where the stress is compressive at the left end; `None` where there
    /// is none.
    ///
    /// Chebyshev interpolation in n + 1 points is off by at most `4Mρ⁻ⁿ/(ρ−1)`. The ellipse with `ρ + 1/ρ = 4k + 2`
    /// stays in Re τ ≥ 0, where `|e^{−Rτ}I₀(R√(τ²−j²))| ≤ 1`, because `(Re √(τ²−j²))² ≤ (Re τ)²`; so each ray adds at
    /// most 1 to the impact's share and, integrated from j, at most 2k + 1 to the weight's: `M ≤ (2k+1)²`.
    fn cell(&self, k: i64) -> Option<Bounce<S>> {
        let at = |x: f64| self.damping.int(k) + (self.damping.double(x) + self.damping.one()) / self.damping.int(2);
        let lost =
            |why: String| Some(Bounce::Undecided { until: self.damping.int(k) * &self.round_trip, why, digits: true });
        let probes = [-1.0, 0.0, 1.0].map(|x| self.force(&at(x), k).0.magnitude());
        let mut scale = probes[0].zero();
        for probe in probes {
            if probe > scale {
                scale = probe;
            }
        }
        if scale.is_zero() {
            return lost(format!(
                "between {k} t₁ and {} t₁ the stress is below every number that this precision holds",
                k + 1
            ));
        }
        let width = 2.0 * k as f64 + 1.0;
        let rho = width + (width * width - 1.0).sqrt();
        let log_bound = 2.0 * width.ln() - scale.ln().to_f64() + (4.0 / (rho - 1.0)).ln();
        let n = ((log_bound + 35.0) / rho.ln()).ceil().clamp(8.0, 4000.0) as usize;
        let mut values = Vec::with_capacity(n + 1);
        let mut rounding = 0.0f64;
        for j in 0..=n {
            let (value, error) = self.force(&at((std::f64::consts::PI * j as f64 / n as f64).cos()), k);
            values.push((value / &scale).to_f64());
            rounding = rounding.max((error / &scale).to_f64());
        }
        let sum = coefficients(&values);
        let steep: f64 = (0u32..).zip(&sum).map(|(n, c)| f64::from(n * n) * c.abs()).sum();
        let total: f64 = sum.iter().map(|c| c.abs()).sum();
        let argument = 2f64.powf(self.damping.log2_roundoff().max(-53.0)) * 4.0 * (k as f64 + 1.0) * steep;
        // The interpolant of errors is at most 1 + (2/π) ln n < 6.3 times as large for n ≤ 4000.
        let error =
            (log_bound - n as f64 * rho.ln()).exp() + 6.3 * rounding + argument + 1e-15 * (n as f64 + 4.0) * total;
        if rounding.is_nan() || rounding > 1e-7 {
            return lost(format!("between {k} t₁ and {} t₁ rounding reaches {rounding:.1e} of the stress", k + 1));
        }
        let sign = |x: f64| {
            let (value, error) = self.force(&at(x), k);
            (value.magnitude() > error).then(|| value.is_positive())
        };
        match first_root(&sum, error, sign) {
            FirstRoot::None => None,
            FirstRoot::Unclear(x) => {
                lost(format!("near t = {:.9} t₁ the stress cannot be told from zero", at(x).to_f64()))
            }
            FirstRoot::Between { lo, hi, slope } => {
                Some(self.refine(k, at(lo), at(hi), &(scale.double(2.0 * slope) * &scale)))
            }
        }
    }

    /// The root in a bracket on which the force falls at least as fast as `slope`: the Illinois variant of regula
    /// falsi.
    fn refine(&self, k: i64, lo: S, hi: S, slope: &S) -> Bounce<S> {
        let (mut a, mut b) = (lo, hi);
        let (mut fa, mut fb) = (self.force(&a, k).0, self.force(&b, k).0);
        let unit = roundoff(&a);
        let mut best = (b.clone(), fb.magnitude(), self.force(&b, k).1);
        for _ in 0..400 {
            let step = fb.clone() * &(b.clone() - &a) / (fb.clone() - &fa);
            if !step.is_finite() {
                break;
            }
            let c = b.clone() - &step;
            let (fc, error) = self.force(&c, k);
            let (size, moved) = (fc.magnitude(), (c.clone() - &b).magnitude());
            if size <= best.1 {
                best = (c.clone(), size.clone(), error.clone());
            }
            if size <= error.clone() / error.int(16) || moved <= unit.clone() * &c {
                break;
            }
            if fc.is_positive() == fb.is_positive() {
                fa = fa.clone() / fa.int(2);
            } else {
                a = b;
                fa = fb;
            }
            b = c;
            fb = fc;
        }
        let (root, size, error) = best;
        let off = ((size + &error) / slope + unit * &root.int(4) * &root).to_f64();
        Bounce::At { error: off * self.round_trip.to_f64(), time: root * &self.round_trip, kind: BounceKind::Root }
    }
}

impl FirstContact<f64> {
    /// `t_b`, with as many digits in between as it takes, up to some thousand, to be sure of `accuracy`, relative.
    ///
    /// **Source**: [`FirstContact::bounce`], in doubles first. Without the feature `mp` that is also the last word.
    ///
    /// **Accuracy**: `error` says what was reached.
    ///
    /// ```
    /// # use dalembert::{rod::Parameters, first_contact::{Bounce, FirstContact}};
    /// // g = 0, R = 3.135: the terms are e⁴⁸, their sum is of order one.
    /// let rod = Parameters { length: 0.5, wave_speed: 1.0, damping: 3.135, gravity: 0.0, speed: 1.0 };
    /// # #[cfg(feature = "mp")] {
    /// let Bounce::At { time, .. } = FirstContact::new(&rod).bounce_within(1e-12) else { panic!("it bounces") };
    /// assert!((time - 15.33318837004014).abs() < 1e-11);
    /// # }
    /// ```
    pub fn bounce_within(&self, accuracy: f64) -> Bounce<f64> {
        let bounce = self.bounce();
        #[cfg(feature = "mp")]
        if !good(&bounce, accuracy) {
            return escalate(&self.rod, accuracy).unwrap_or(bounce);
        }
        let _ = accuracy;
        bounce
    }

    /// `v_x(0,t)` to `accuracy`, relative, as far as longer numbers reach; and the bits that were used, 53 for doubles.
    ///
    /// **Source**: [`FirstContact::stress`]. Without the feature `mp` doubles are all there is.
    ///
    /// **Accuracy**: the estimate's `error` says what was reached.
    pub fn stress_within(&self, time: f64, side: Side, accuracy: f64) -> (Estimate<f64>, u32) {
        let stress = self.stress(&time, side);
        let enough = |found: &Estimate<f64>| found.error <= accuracy * found.value.abs();
        if enough(&stress) || stress.error.is_infinite() {
            return (stress, 53);
        }
        #[cfg(feature = "mp")]
        {
            use crate::number::Scalar;
            // A lattice time as doubles compute it is meant to be that lattice time.
            let trips = self.trips(&time);
            let whole = trips.floor_int().filter(|k| trips == *k as f64);
            for bits in LADDER {
                let long = longer(&self.rod, bits);
                let time = match whole {
                    Some(k) => long.round_trip() * k,
                    None => rug::Float::with_val(bits, time),
                };
                let found = long.stress(&time, side);
                let value = found.value.to_f64();
                let found = Estimate { value, error: found.error + 2f64.powi(-53) * value.abs() };
                if enough(&found) {
                    return (found, bits);
                }
            }
        }
        (stress, 53)
    }
}

/// Bits that are tried where doubles do not suffice.
#[cfg(feature = "mp")]
const LADDER: [u32; 6] = [128, 256, 512, 1024, 2048, 4096];

/// The same rod, exactly, in longer numbers.
#[cfg(feature = "mp")]
fn longer(rod: &Parameters<f64>, bits: u32) -> FirstContact<rug::Float> {
    let lift = |x: f64| rug::Float::with_val(bits, x);
    FirstContact::new(&Parameters {
        length: lift(rod.length),
        wave_speed: lift(rod.wave_speed),
        damping: lift(rod.damping),
        gravity: lift(rod.gravity),
        speed: lift(rod.speed),
    })
}

/// Whether more digits would add nothing.
#[cfg(feature = "mp")]
fn good<S: Analytic>(bounce: &Bounce<S>, accuracy: f64) -> bool {
    match bounce {
        Bounce::At { time, error, .. } => *error <= accuracy * time.to_f64(),
        Bounce::Never { .. } => true,
        Bounce::Undecided { digits, .. } => !digits,
    }
}

/// The bounce from the same parameters, exact in longer numbers.
#[cfg(feature = "mp")]
fn escalate(rod: &Parameters<f64>, accuracy: f64) -> Option<Bounce<f64>> {
    let mut last = None;
    for bits in LADDER {
        let bounce = longer(rod, bits).bounce();
        let enough = good(&bounce, accuracy);
        last = Some(match bounce {
            Bounce::At { time, kind, error } => {
                Bounce::At { error: error + 2f64.powi(-53) * time.to_f64(), time: time.to_f64(), kind }
            }
            Bounce::Never { reason } => Bounce::Never { reason },
            Bounce::Undecided { until, why, digits } => Bounce::Undecided { until: until.to_f64(), why, digits },
        });
        if enough {
            break;
        }
    }
    last
}
