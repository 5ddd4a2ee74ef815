//! Stress, field, centre of mass and energy as sums over the modes.

use dalembert::number::{Analytic, Estimate, Scalar};
use dalembert::problem::Parameters;
use dalembert::special::{RoundedSpecial, phi1};
use dalembert::{Field, Side};

use super::sums::{MOST_MODES, SpaceFactor, TimeFactor, series, within};

/// The first contact by its modes.
///
/// **Source**: separation of variables in (2.11); the closed sums are derived above.
///
/// **Units**: any consistent units.
///
/// **Accuracy**: each [`Estimate`] carries the proved bound of the modes left out and of the rounding errors.
///
/// ```
/// # use dalembert::{Parameters, Side};
/// # use dalembert_verify::modal::Modal;
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 3.0 };
/// let stress = Modal::new(&rod, 64).strain(&1.0, Side::Right);
/// assert!((stress.value() + 4.0_f64).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Modal<S> {
    rod: Parameters<Estimate<S>>,
    round_trip: Estimate<S>,
    /// `μ₀`.
    critical: Estimate<S>,
    /// `R`.
    pub(super) damping: Estimate<S>,
    pub(super) modes: i64,
}

impl<S: RoundedSpecial> Modal<S> {
    /// Prepares the sums over at least `modes` modes.
    pub fn new(rod: &Parameters<S>, modes: u32) -> Self {
        let rod = rod.carry();
        let round_trip = rod.round_trip();
        let damping = rod.damping.clone() * &round_trip;
        Modal { critical: rod.critical_speed(), rod, round_trip, damping, modes: i64::from(modes.max(2)) }
    }

    /// Computes `v_x(0,t)`: the stress at the ground divided by the modulus.
    ///
    /// **Source**: (2.28).
    pub fn strain(&self, time: &S, side: Side) -> Estimate<S> {
        let [impact, weight] = self.ground(&self.trips(time), side);
        self.combine(impact, weight, &(-self.rod.wave_speed.one() / &self.rod.wave_speed))
    }

    /// Computes `e^{−rt} H_r` and `e^{−rt} G_r/t₁` at `t/t₁`; without gravity the second is zero.
    fn ground(&self, trips: &Estimate<S>, side: Side) -> [Estimate<S>; 2] {
        let ground = trips.zero();
        let first = series(0, TimeFactor::Sine, SpaceFactor::Cosine);
        if self.critical.value().is_zero() {
            let [impact] = self.sums(trips, &ground, side, [first]);
            return [impact, ground];
        }
        let [impact, weight] =
            self.sums(trips, &ground, side, [first, series(2, TimeFactor::Rising, SpaceFactor::Cosine)]);
        [impact, trips.ratio(1, 2) - weight]
    }

    /// Computes `v`, `v_t`, `v_x` at `(x,t)`.
    ///
    /// **Source**: (2.24).
    pub fn field(&self, point: &S, time: &S, side: Side) -> Field<Estimate<S>> {
        let trips = self.trips(time);
        let a = Estimate::exact(point.clone()) / &self.rod.length / trips.int(2);
        let list = [
            series(1, TimeFactor::Sine, SpaceFactor::Sine),
            series(1, TimeFactor::Falling, SpaceFactor::Sine),
            series(0, TimeFactor::Sine, SpaceFactor::Cosine),
            series(3, TimeFactor::Rising, SpaceFactor::Sine),
            series(2, TimeFactor::Rising, SpaceFactor::Cosine),
        ];
        let [fallen, slowed, force, sag, bend] = self.sums(&trips, &a, side, list);
        let one = trips.one();
        let half = one.ratio(1, 2);
        let sag = sag - a.clone() * &(one.clone() - &a) * &half;
        let bend = bend + &a - half;
        Field {
            displacement: self.combine(-fallen.clone(), sag, &self.round_trip),
            velocity: self.combine(-slowed, -fallen, &one),
            strain: self.combine(-force, bend, &(one.clone() / &self.rod.wave_speed)),
        }
    }

    /// Computes `h(t)` and `h′(t) = P/L`: the centre of mass.
    ///
    /// **Source**: (3.38), (3.39).
    pub fn centre(&self, time: &S) -> (Estimate<S>, Estimate<S>) {
        let trips = self.trips(time);
        let list = [
            series(2, TimeFactor::Sine, SpaceFactor::Mean),
            series(2, TimeFactor::Falling, SpaceFactor::Mean),
            series(4, TimeFactor::Rising, SpaceFactor::Mean),
        ];
        let two = trips.int(2);
        let [fallen, slowed, sag] = self.sums(&trips, &trips.zero(), Side::Right, list).map(|sum| sum * &two);
        let sag = sag - two.ratio(1, 12);
        let height = self.combine(-fallen.clone(), sag, &self.round_trip);
        (height, self.combine(-slowed, -fallen, &two.one()))
    }

    /// Computes `E(t)`: the energy, by Parseval's equation `(L/4) Σ (b² + ω²q²) + L g h` for `v_t = Σ b sin`,
    /// `c v_x = Σ ωq cos`.
    ///
    /// **Source**: (3.54).
    ///
    /// **Accuracy**: the bound falls like `N⁻²`. `b² + ω²q²` is `16ε²μ²e^{−2Rτ}(1 − 2RCS + 2R²S²)` for the impact,
    /// whose first term has the closed sum 2. Where `ω ≥ 2R`, `ωS` is below 1.16 and `RS` below 0.58, so the rest is at
    /// most `16ε³ (3.7 R μ² e^{−2Rτ} + 9.7 μμ₀ e^{−Rτ} + 8 μ₀² ε)`, and `Σ_{n≥N} ε³ ≤ 1/(16π³N²)`.
    pub fn energy(&self, time: &S) -> Estimate<S> {
        let trips = self.trips(time);
        let (height, _) = self.centre(time);
        let (mu, mu0, r) = (&self.rod.speed, &self.critical, &self.damping);
        let pi = trips.pi();
        let modes = self.modes.max((r.to_f64() / std::f64::consts::PI) as i64 + 2).min(MOST_MODES);
        let fade = (-(r.clone() * &trips)).exp();
        let leading = (mu.clone() * &fade).square() * &trips.int(16);
        let mut sum = trips.zero();
        for n in (0..modes).rev() {
            let omega = pi.clone() * &trips.int(2 * n + 1);
            let [s, falling, rising] = self.direct(&omega, &trips);
            let four = trips.int(4) / &omega;
            let rate = -(falling * mu + s.clone() * mu0) * &four;
            let held = (trips.one() - &rising) / &omega * mu0;
            let strain = -(s * &omega * mu + held) * &four;
            sum = sum + (rate.square() + strain.square() - leading.clone() / &omega.square());
        }
        sum = sum + leading / &trips.int(8);
        let (m, m0, f) = (mu.to_f64(), mu0.to_f64(), fade.to_f64());
        let n = modes as f64;
        let tail = (3.7 * r.to_f64() * m * m * f * f + 9.7 * m * m0 * f + 8.0 * m0 * m0 / n) / n / n / 31.0;
        let tail = if modes == MOST_MODES && std::f64::consts::PI * n < r.to_f64() { f64::INFINITY } else { tail };
        let elastic = within(sum, tail.ln()) / &trips.int(4);
        (elastic + height * &self.rod.gravity) * &self.rod.length
    }

    /// Returns `t/t₁`: exactly k at the k-th lattice time.
    fn trips(&self, time: &S) -> Estimate<S> {
        let (trips, period) = (Estimate::exact(time.clone()) / &self.round_trip, self.round_trip.value());
        match (trips.value().clone() + time.ratio(1, 2)).floor_int() {
            Some(k) if time.meets(&(period.int(k) * period)) => trips.int(k),
            _ => trips,
        }
    }

    /// Returns `(μ impact + μ₀ weight) factor`.
    fn combine(&self, impact: Estimate<S>, weight: Estimate<S>, factor: &Estimate<S>) -> Estimate<S> {
        (impact * &self.rod.speed + weight * &self.critical) * factor
    }

    /// Computes damped `S`, `C − RS`, `C + RS` of one mode.
    ///
    /// `q = (ω−R)(ω+R)` is off by less than `8uω(ω+R)`, with the rounding of R, and `|dS/dq| = |τC − S|/2|q|` and
    /// `|dC/dq| = τ|S|/2` are below `min(τ³/6, (τ + |q|^{−1/2})/2|q|)` and `min(τ²/2, τ|q|^{−1/2}/2)` times the growth,
    /// 1 or `cosh κτ`.
    pub(super) fn direct(&self, omega: &Estimate<S>, trips: &Estimate<S>) -> [Estimate<S>; 3] {
        let [c, s, q] = self.cosine_and_sine(omega.value(), trips.value());
        let (w, r, tau, q) = (omega.to_f64(), self.damping.to_f64(), trips.to_f64(), q.to_f64());
        let growth = if q < 0.0 { c.to_f64().abs() } else { (-r * tau).exp() };
        let root = q.abs().sqrt();
        let blur = 8.0 * w * (w + r) * growth;
        let relative = 12.0 + 4.0 * r * tau;
        let off_s = blur * (tau.powi(3) / 6.0).min((tau + 1.0 / root) / (2.0 * q.abs())) + relative * s.to_f64().abs();
        let off_c = blur * (tau * tau / 2.0).min(tau / (2.0 * root)) + relative * growth;
        let (c, s) = (Estimate::new(c, off_c), Estimate::new(s, off_s));
        let damped = s.clone() * &self.damping;
        [s, c.clone() - &damped, c + &damped]
    }

    /// Computes `e^{−Rτ} C` and `e^{−Rτ} S`, regular where `ω = R`, and `Ω²`.
    ///
    /// For `ω < R`, with `κ² = R² − ω²`: `e^{−Rτ} cosh κτ = e^{−(R−κ)τ} (1 + e^{−2κτ})/2`, the sine
    /// `τ e^{−(R−κ)τ} φ₁(−2κτ)`, and `R − κ = ω²/(R + κ)`.
    fn cosine_and_sine(&self, omega: &S, trips: &S) -> [S; 3] {
        let r = self.damping.value();
        let square = (omega.clone() - r) * &(omega.clone() + r);
        if square.is_negative() {
            let kappa = (-square.clone()).sqrt();
            let slow = (-(omega.square() / &(r.clone() + &kappa) * trips)).exp();
            let fall = -(kappa * trips * &trips.int(2));
            let even = (fall.exp() + trips.one()) / &trips.int(2);
            return [even * &slow, phi1(&fall) * trips * &slow, square];
        }
        let frequency = square.sqrt();
        let fade = (-(r.clone() * trips)).exp();
        let angle = frequency.clone() * trips;
        let sine = if frequency.is_zero() { trips.clone() } else { angle.sin() / &frequency };
        [angle.cos() * &fade, sine * &fade, square]
    }
}
