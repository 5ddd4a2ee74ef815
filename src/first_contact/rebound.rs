//! After the bounce: the free flight of the centre of mass and the coefficients of restitution.

use super::field::{Estimate, FirstContact};
use crate::number::Analytic;
use crate::rod::Parameters;
use crate::special::{log_mean, log_rest, phi1, phi2};

/// The motion of the centre of mass from `t_b` on, up to the next impact.
///
/// **Source**: (3.40)–(3.45), Remark 2, section 4.
///
/// **Units**: any consistent units; energies are per linear density.
///
/// ```
/// # use dalembert::{rod::Parameters, first_contact::FirstContact};
/// // r = 0, μ = 4 > μ₀ = 2: h⁰ = −2/3, h¹ = μ, and the top of the flight at t = 6.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 4.0 };
/// let rebound = FirstContact::new(&rod).rebound(&2.0);
/// let (time, height) = rebound.highest().unwrap();
/// assert!((time - 6.0_f64).abs() < 1e-14 && (height - 22.0_f64 / 3.0).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Rebound<S> {
    /// `t_b`.
    pub time: S,
    /// `h⁰ = h(t_b)`.
    pub centre: Estimate<S>,
    /// `h¹ = h′(t_b)`.
    pub velocity: Estimate<S>,
    pub(super) rod: Parameters<S>,
}

impl<S: Analytic> FirstContact<S> {
    /// What follows when the ground lets go at `time`.
    pub fn rebound(&self, time: &S) -> Rebound<S> {
        let (centre, velocity) = self.centre(time);
        Rebound { time: time.clone(), centre, velocity, rod: self.rod.clone() }
    }
}

impl<S: Analytic> Rebound<S> {
    /// `h(t)` and `h′(t)` in flight.
    ///
    /// **Source**: (3.43), (3.44), with `φ₁` and `φ₂` for the quotients by `2r` and `4r²`.
    ///
    /// **Accuracy**: that of `h⁰` and `h¹`, and 32 roundings.
    pub fn flight(&self, time: &S) -> (S, S) {
        let (start, speed, g) = (&self.centre.value, &self.velocity.value, &self.rod.gravity);
        let since = time.clone() - &self.time;
        let fall = -(self.rod.damping.int(2) * &self.rod.damping * &since);
        let slowed = phi1(&fall) * &since;
        let drop = phi2(&fall) * &since.square() * g;
        let height = start.clone() + slowed.clone() * speed - drop;
        (height, fall.exp() * speed - slowed * g)
    }

    /// `t*` and `h_max = h(t*)`: the top of the flight, provided that no impact comes first.
    ///
    /// **Source**: Remark 2, with `λ` and `λ₂` for the quotients by `2r` and `4r²`.
    ///
    /// **Accuracy**: that of `h⁰` and `h¹`, and 64 roundings.
    ///
    /// **Errors**: `None` where `g = 0`. Where the centre does not rise, the top is the bounce itself.
    pub fn highest(&self) -> Option<(S, S)> {
        let (start, speed, g) = (&self.centre.value, &self.velocity.value, &self.rod.gravity);
        if g.is_zero() {
            return None;
        }
        if !speed.is_positive() {
            return Some((self.time.clone(), start.clone()));
        }
        let drag = self.rod.damping.int(2) * &self.rod.damping * speed / g;
        let rise = speed.clone() / g;
        let height = start.clone() + log_rest(&drag) * &rise * speed;
        Some((self.time.clone() + log_mean(&drag) * &rise, height))
    }

    /// `E_h = L h′²/2 + L g h` at `t_b`: the translational energy.
    ///
    /// **Source**: (3.63).
    ///
    /// **Accuracy**: the bound follows from those of `h⁰` and `h¹`.
    pub fn translational_energy(&self) -> Estimate<S> {
        translational(&self.rod, &self.centre, &self.velocity)
    }

    /// `e_P = −P(t_b)/P(0) = h¹/μ`: the momentum coefficient of restitution.
    ///
    /// **Source**: section 4.1.
    ///
    /// **Errors**: `None` where `μ = 0`.
    pub fn momentum_restitution(&self) -> Option<S> {
        (!self.rod.speed.is_zero()).then(|| self.velocity.value.clone() / &self.rod.speed)
    }

    /// `e_E² = E_h(t_b)/E_h(0)`: the square of the energy coefficient of restitution.
    ///
    /// **Source**: (4.71). For `t_b = t₁` and `μ → ∞`, `e_E` tends to `2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`, not to the
    /// `e^{−R}` of (4.75).
    ///
    /// **Errors**: `None` where `E_h(t_b) < 0`, where the paper leaves it undefined, and where `μ = 0`.
    pub fn energy_restitution_squared(&self) -> Option<S> {
        let mu = &self.rod.speed;
        if mu.is_zero() {
            return None;
        }
        let rise = self.centre.value.int(2) * &self.rod.gravity * &self.centre.value / mu / mu;
        let squared = (self.velocity.value.clone() / mu).square() + rise;
        (!squared.is_negative()).then_some(squared)
    }
}

/// (3.63), with its bound.
pub(super) fn translational<S: Analytic>(
    rod: &Parameters<S>,
    centre: &Estimate<S>,
    velocity: &Estimate<S>,
) -> Estimate<S> {
    let (length, g) = (&rod.length, &rod.gravity);
    let kinetic = velocity.value.square() * length / length.int(2);
    let potential = centre.value.clone() * g * length;
    let size = kinetic.to_f64().abs() + potential.to_f64().abs();
    let (l, speed) = (length.to_f64(), velocity.value.to_f64().abs() + velocity.error);
    let error = l * (speed * velocity.error + g.to_f64() * centre.error);
    let rounding = 6.0 * size * 2f64.powf(length.log2_roundoff());
    Estimate { value: kinetic + potential, error: error + rounding }
}
