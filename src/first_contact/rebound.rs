//! The free flight of the centre of mass after the bounce, and the coefficients of restitution.

use super::field::FirstContact;
use crate::number::Bounded;
use crate::problem::Parameters;
use crate::special::{BoundedSpecial, log_mean, log_rest};

/// The motion of the centre of mass from `t_b` on, up to the next impact.
///
/// **Source**: (3.40)–(3.45), Remark 2, section 4.
///
/// **Units**: any consistent units; energies are per linear density.
///
/// ```
/// # use dalembert::{Estimate, Parameters};
/// # use dalembert::engine::FirstContact;
/// // r = 0, μ = 4 > μ₀ = 2: h⁰ = −2/3, h¹ = μ, and the top of the flight at t = 6.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 4.0 };
/// let rebound = FirstContact::new(&rod.carry()).rebound(&Estimate::exact(2.0));
/// let (time, height) = rebound.highest().unwrap();
/// assert!((time.value() - 6.0).abs() < 1e-14 && (height.value() - 22.0 / 3.0).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Rebound<N> {
    /// `t_b`.
    pub time: N,
    /// `h⁰ = h(t_b)`.
    pub centre: N,
    /// `h¹ = h′(t_b)`.
    pub velocity: N,
    pub(super) rod: Parameters<N>,
}

impl<N: BoundedSpecial> FirstContact<N> {
    /// Computes the motion of the centre of mass after a release at `time`.
    pub fn rebound(&self, time: &N) -> Rebound<N> {
        let (centre, velocity) = self.centre(time);
        Rebound { time: time.clone(), centre, velocity, rod: self.rod.clone() }
    }
}

impl<N: BoundedSpecial> Rebound<N> {
    /// Computes `h(t)` and `h′(t)` in flight.
    ///
    /// **Source**: (3.43), (3.44), with `φ₁` and `φ₂` for the quotients by `2r` and `4r²`.
    ///
    /// **Accuracy**: *within its own bound*.
    pub fn flight(&self, time: &N) -> (N, N) {
        let (start, speed, g) = (&self.centre, &self.velocity, &self.rod.gravity);
        let since = time.clone() - &self.time;
        let fall = -(self.rod.damping.int(2) * &self.rod.damping * &since);
        let slowed = fall.phi1() * &since;
        let drop = fall.phi2() * &since.square() * g;
        let height = start.clone() + slowed.clone() * speed - drop;
        (height, fall.exp() * speed - slowed * g)
    }

    /// Computes `t*` and `h_max = h(t*)`: the top of the flight, provided that no impact comes first.
    ///
    /// **Source**: Remark 2, with `λ` and `λ₂` for the quotients by `2r` and `4r²`.
    ///
    /// **Accuracy**: *within its own bound*.
    ///
    /// **Errors**: `None` if `g = 0`, and if the centre does not rise or may not.
    pub fn highest(&self) -> Option<(N, N)> {
        let (start, speed, g) = (&self.centre, &self.velocity, &self.rod.gravity);
        if g.vanishes() != Ok(false) || speed.positive() != Ok(true) {
            return None;
        }
        let drag = self.rod.damping.int(2) * &self.rod.damping * speed / g;
        let rise = speed.clone() / g;
        let height = start.clone() + log_rest(&drag) * &rise * speed;
        Some((self.time.clone() + log_mean(&drag) * &rise, height))
    }

    /// Computes `e_P = −P(t_b)/P(0) = h¹/μ`: the momentum coefficient of restitution.
    ///
    /// **Source**: section 4.1.
    ///
    /// **Errors**: `None` if `μ = 0`.
    pub fn momentum_restitution(&self) -> Option<N> {
        (self.rod.speed.vanishes() != Ok(true)).then(|| self.velocity.clone() / &self.rod.speed)
    }

    /// Computes `e_E² = E_h(t_b)/E_h(0)`: the square of the energy coefficient of restitution.
    ///
    /// **Source**: (4.71). For `t_b = t₁` and `μ → ∞`, `e_E` tends to `2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`, not to the
    /// `e^{−R}` of (4.75).
    ///
    /// **Errors**: `None` if `E_h(t_b) < 0`, where the paper leaves it undefined, and if `μ = 0`.
    pub fn energy_restitution_squared(&self) -> Option<N> {
        let mu = &self.rod.speed;
        if mu.vanishes() == Ok(true) {
            return None;
        }
        let rise = self.centre.int(2) * &self.rod.gravity * &self.centre;
        let squared = (self.velocity.square() + rise) / mu.square();
        (squared.negative() != Ok(true)).then_some(squared)
    }
}

/// Computes the translational energy (3.63).
pub(super) fn translational<N: Bounded>(rod: &Parameters<N>, centre: &N, velocity: &N) -> N {
    let kinetic = velocity.square() / velocity.int(2);
    ((kinetic + centre.clone() * &rod.gravity) * &rod.length).without_exact()
}
