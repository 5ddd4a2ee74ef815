//! What is asked of the modes: stress, field, centre of mass, energy.

use crate::first_contact::Estimate;
use crate::history::{Field, Side};
use crate::number::Analytic;
use crate::rod::Parameters;
use crate::special::{negative_power, phi1};

use super::sums::{MOST_MODES, Motion, Shape, series};

/// The first contact by its modes.
///
/// **Source**: separation of variables in (2.11); the closed sums are derived above.
///
/// **Units**: any consistent units.
///
/// **Accuracy**: each [`Estimate`] carries the proved bound of the modes left out and of the rounding errors.
///
/// ```
/// # use dalembert::{rod::Parameters, modal::Modal, history::Side};
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 3.0 };
/// let stress = Modal::new(&rod, 64).stress(&1.0, Side::Right);
/// assert!((stress.value + 4.0_f64).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Modal<S> {
    rod: Parameters<S>,
    round_trip: S,
    /// `μ₀`.
    critical: S,
    /// `R`.
    pub(super) damping: S,
    pub(super) modes: i64,
}

impl<S: Analytic> Modal<S> {
    /// The sum over at least `modes` modes.
    pub fn new(rod: &Parameters<S>, modes: u32) -> Self {
        let round_trip = rod.round_trip();
        let damping = rod.damping.clone() * &round_trip;
        Modal { critical: rod.critical_speed(), rod: rod.clone(), round_trip, damping, modes: i64::from(modes.max(2)) }
    }

    /// `v_x(0,t)`: the stress at the ground divided by the modulus.
    ///
    /// **Source**: (2.28).
    pub fn stress(&self, time: &S, side: Side) -> Estimate<S> {
        let [impact, weight] = self.ground(&self.trips(time), side);
        let c = &self.rod.wave_speed;
        let (mu, mu0) = (&self.rod.speed, &self.critical);
        let value = -(impact.value * mu + weight.value * mu0) / c;
        let error = (impact.error * mu.to_f64().abs() + weight.error * mu0.to_f64().abs()) / c.to_f64();
        self.finish(value, error)
    }

    /// `e^{−rt} H_r` and `e^{−rt} G_r/t₁` at `t/t₁`; the second is left out where nothing weighs.
    pub(crate) fn ground(&self, trips: &S, side: Side) -> [Estimate<S>; 2] {
        let ground = trips.zero();
        let first = series(0, Motion::Sine, Shape::Cosine);
        if self.critical.is_zero() {
            let [impact] = self.sums(trips, &ground, side, [first]);
            return [impact, Estimate { value: trips.zero(), error: 0.0 }];
        }
        let [impact, weight] = self.sums(trips, &ground, side, [first, series(2, Motion::Rising, Shape::Cosine)]);
        let weight = Estimate { value: trips.ratio(1, 2) - weight.value, error: weight.error };
        [impact, weight]
    }

    /// `v`, `v_t`, `v_x` at `(x,t)`, with one bound for each.
    ///
    /// **Source**: (2.24).
    pub fn field(&self, point: &S, time: &S, side: Side) -> (Field<S>, [f64; 3]) {
        let trips = self.trips(time);
        let a = point.clone() / &self.rod.length / point.int(2);
        let list = [
            series(1, Motion::Sine, Shape::Sine),
            series(1, Motion::Falling, Shape::Sine),
            series(0, Motion::Sine, Shape::Cosine),
            series(3, Motion::Rising, Shape::Sine),
            series(2, Motion::Rising, Shape::Cosine),
        ];
        let [fallen, slowed, force, sag, bend] = self.sums(&trips, &a, side, list);
        let (one, half) = (a.one(), a.ratio(1, 2));
        let sag = Estimate { value: sag.value - a.clone() * &(one.clone() - &a) * &half, error: sag.error };
        let bend = Estimate { value: bend.value + &a - &half, error: bend.error };
        let displacement = self.combine(&fallen, &sag, &self.round_trip);
        let velocity = self.combine(&slowed, &negative(fallen), &one);
        let strain = self.combine(&force, &bend, &(one.clone() / &self.rod.wave_speed));
        let errors = [displacement.error, velocity.error, strain.error];
        (Field { displacement: displacement.value, velocity: velocity.value, strain: strain.value }, errors)
    }

    /// `h(t)` and `h′(t) = P/L`: the centre of mass.
    ///
    /// **Source**: (3.38), (3.39).
    pub fn centre(&self, time: &S) -> (Estimate<S>, Estimate<S>) {
        let trips = self.trips(time);
        let list = [
            series(2, Motion::Sine, Shape::Mean),
            series(2, Motion::Falling, Shape::Mean),
            series(4, Motion::Rising, Shape::Mean),
        ];
        let twice = |e: Estimate<S>| Estimate { value: e.value * &trips.int(2), error: 2.0 * e.error };
        let [fallen, slowed, sag] = self.sums(&trips, &trips.zero(), Side::Right, list).map(twice);
        let sag = Estimate { value: sag.value - trips.ratio(1, 12), error: sag.error };
        let height = self.combine(&fallen, &sag, &self.round_trip);
        (height, self.combine(&slowed, &negative(fallen), &trips.one()))
    }

    /// `E(t)`: the energy, by Parseval's equation `(L/4) Σ (b² + ω²q²) + L g h` for `v_t = Σ b sin`, `c v_x = Σ ωq cos`.
    ///
    /// **Source**: (3.54).
    ///
    /// **Accuracy**: the bound falls like `N⁻²`. `b² + ω²q²` is `16ε²μ²e^{−2Rτ}(1 − 2RCS + 2R²S²)` for the impact, whose first
    /// term has the closed sum 2. Where `ω ≥ 2R`, `ωS` is below 1.16 and `RS` below 0.58, so the rest is at most
    /// `16ε³ (3.7 R μ² e^{−2Rτ} + 9.7 μμ₀ e^{−Rτ} + 8 μ₀² ε)`, and `Σ_{n≥N} ε³ ≤ 1/(16π³N²)`.
    pub fn energy(&self, time: &S) -> Estimate<S> {
        let trips = self.trips(time);
        let (height, _) = self.centre(time);
        let (mu, mu0, r) = (&self.rod.speed, &self.critical, &self.damping);
        let pi = trips.pi();
        let modes = self.modes.max((r.to_f64() / std::f64::consts::PI) as i64 + 2).min(MOST_MODES);
        let fade = (-(r.clone() * &trips)).exp();
        let leading = (mu.clone() * &fade).square() * &trips.int(16);
        let mut sum = trips.zero();
        let mut largest = 0.0f64;
        for n in (0..modes).rev() {
            let omega = pi.clone() * &trips.int(2 * n + 1);
            let (c, s) = self.pair(&omega, &trips);
            let damped = s.clone() * r;
            let four = trips.int(4) / &omega;
            let rate = -((c.clone() - &damped) * mu + s.clone() * mu0) * &four;
            let held = (trips.one() - &(c + &damped)) / &omega * mu0;
            let strain = -(s * &omega * mu + held) * &four;
            let part = rate.square() + strain.square();
            largest += part.to_f64();
            sum = sum + (part - leading.clone() / &omega.square());
        }
        sum = sum + leading / &trips.int(8);
        let (m, m0, f) = (mu.to_f64(), mu0.to_f64(), fade.to_f64());
        let n = modes as f64;
        let tail = (3.7 * r.to_f64() * m * m * f * f + 9.7 * m * m0 * f + 8.0 * m0 * m0 / n) / n / n / 31.0;
        let tail = if modes == MOST_MODES && std::f64::consts::PI * n < r.to_f64() { f64::INFINITY } else { tail };
        // Each mode has the roundings of its frequency, 16R²τ² at most near R = ω, and of its phase, 8ωτ.
        let turned = r.to_f64() * trips.to_f64();
        let phases = 160.0 * trips.to_f64() * (m * f + m0).powi(2) * (1.0 + n.ln());
        let each = (largest + 2.0 * m * m * f * f) * (n + 60.0 + 12.0 * turned + 40.0 * turned * turned);
        let rounding = self.unit() * (each + phases);
        let (length, gravity) = (&self.rod.length, &self.rod.gravity);
        let error = length.to_f64() * ((tail + rounding) / 4.0 + gravity.to_f64() * height.error);
        let value = (sum / &trips.int(4) + height.value * gravity) * length;
        self.finish(value, error)
    }

    /// `t/t₁`, and exactly k at the k-th lattice time.
    fn trips(&self, time: &S) -> S {
        let trips = time.clone() / &self.round_trip;
        match (trips.clone() + trips.ratio(1, 2)).floor_int() {
            Some(k) if time.meets(&(self.round_trip.int(k) * &self.round_trip)) => time.int(k),
            _ => trips,
        }
    }

    pub(super) fn unit(&self) -> f64 {
        negative_power(-self.damping.log2_roundoff())
    }

    /// `−μ impact + μ₀ weight`, times `factor`.
    fn combine(&self, impact: &Estimate<S>, weight: &Estimate<S>, factor: &S) -> Estimate<S> {
        let (mu, mu0) = (&self.rod.speed, &self.critical);
        let value = (weight.value.clone() * mu0 - impact.value.clone() * mu) * factor;
        let error = impact.error * mu.to_f64().abs() + weight.error * mu0.to_f64().abs();
        self.finish(value, error * factor.to_f64().abs())
    }

    /// A value that is no number is not known.
    fn finish(&self, value: S, error: f64) -> Estimate<S> {
        let known = value.is_finite() && !error.is_nan();
        let error = if known { error + 8.0 * self.unit() * value.to_f64().abs() } else { f64::INFINITY };
        Estimate { value, error: error.max(f64::MIN_POSITIVE) }
    }

    /// `e^{−Rτ} C` and `e^{−Rτ} S`, regular where `ω = R`.
    ///
    /// For `ω < R`, with `κ² = R² − ω²`: `e^{−Rτ} cosh κτ = e^{−(R−κ)τ} (1 + e^{−2κτ})/2`, the sine
    /// `τ e^{−(R−κ)τ} φ₁(−2κτ)`, and `R − κ = ω²/(R + κ)`.
    pub(super) fn pair(&self, omega: &S, trips: &S) -> (S, S) {
        let r = &self.damping;
        let square = (omega.clone() - r) * &(omega.clone() + r);
        if square.is_negative() {
            let kappa = (-square).sqrt();
            let slow = (-(omega.square() / &(r.clone() + &kappa) * trips)).exp();
            let fall = -(kappa * trips * &trips.int(2));
            let even = (fall.exp() + trips.one()) / &trips.int(2);
            return (even * &slow, phi1(&fall) * trips * &slow);
        }
        let frequency = square.sqrt();
        let fade = (-(r.clone() * trips)).exp();
        let angle = frequency.clone() * trips;
        let sine = if frequency.is_zero() { trips.clone() } else { angle.sin() / &frequency };
        (angle.cos() * &fade, sine * &fade)
    }
}

fn negative<S: Analytic>(estimate: Estimate<S>) -> Estimate<S> {
    Estimate { value: -estimate.value, error: estimate.error }
}
