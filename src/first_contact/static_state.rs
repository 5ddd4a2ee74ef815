//! The rod at rest on the ground under a free top, and the time from which a contact without end is at rest.

use crate::error::Error;
use crate::motion::moments::{Moments, of_stretches};
use crate::motion::{Energy, Field, Stretch};
use crate::number::Scalar;
use crate::problem::Parameters;

/// `v_s = (g/2c²)(x² − 2Lx)`: the limit of a contact that never ends, with the bound of the remaining transient from
/// [`faded_after`].
#[derive(Clone, Debug)]
pub(super) struct StaticState<'a, N> {
    rod: &'a Parameters<N>,
    /// `g/c²`.
    curvature: N,
    /// Bound of the remaining transient in velocities: a roundoff of `μ + g t₁`.
    left: N,
}

impl<'a, N: Scalar> StaticState<'a, N> {
    pub(super) fn of(rod: &'a Parameters<N>) -> Self {
        let curvature = rod.gravity.clone() / rod.wave_speed.square();
        let left = (rod.critical_speed() + &rod.speed) * &rod.length.roundoff();
        StaticState { rod, curvature, left }
    }

    /// Bounds the remaining transient in displacements, from the strain along the rod.
    fn left_height(&self) -> N {
        self.left.clone() * &self.rod.length / &self.rod.wave_speed
    }

    /// Returns `v_s`, zero, `v_s′`.
    pub(super) fn field(&self, x: &N) -> Field<N> {
        let length = &self.rod.length;
        let strain = (x.clone() - length) * &self.curvature;
        let displacement = (x.clone() - length.clone() * x.int(2)) * x * &self.curvature * x.ratio(1, 2);
        Field {
            displacement: displacement.widened(&self.left_height()),
            velocity: x.zero().widened(&self.left),
            strain: strain.widened(&(self.left.clone() / &self.rod.wave_speed)),
        }
    }

    pub(super) fn moments(&self, points: &[N]) -> Result<Vec<Moments<N>>, Error> {
        let length = &self.rod.length;
        let (zero, slope) = (length.zero(), self.curvature.clone());
        let stretch = Stretch {
            from: zero.clone(),
            width: length.clone(),
            displacement: zero.clone(),
            velocity: [zero.clone(), zero],
            strain: [-(slope.clone() * length), slope],
        };
        let left = [self.left_height(), self.left.clone(), self.left.clone() / &self.rod.wave_speed];
        let mut cells = of_stretches(&[stretch], points)?;
        for (cell, pair) in cells.iter_mut().zip(points.windows(2)) {
            let width = pair[1].clone() - &pair[0];
            for (moments, left) in cell.iter_mut().zip(&left) {
                let mut by = left.clone();
                for value in moments {
                    by = by * &width;
                    *value = value.clone().widened(&by);
                }
            }
        }
        Ok(cells)
    }

    /// Returns `h = −gL²/3c²`, and zero.
    pub(super) fn centre(&self) -> (N, N) {
        let x = &self.rod.length;
        let height = x.square() * &self.curvature * x.ratio(-1, 3);
        (height.widened(&self.left_height()), x.zero().widened(&self.left))
    }

    /// Computes `E_h = gLh`, `E_z = g²L³/6c²`; a transient of velocity and `c` times strain δ adds at most `L (gL/c +
    /// δ) δ` to the second and `L δ²/2` to the first.
    pub(super) fn energy(&self) -> Energy<N> {
        let Parameters { length, gravity, .. } = self.rod;
        let left = self.left.square() * length;
        let translational = (self.centre().0 * gravity * length).widened(&left);
        let [_, vibrational] = self.energy_parts();
        Energy { total: translational.clone() + &vibrational, translational, vibrational }
    }

    /// Computes the kinetic energy, that of the transient, and the strain energy: `E_z` with the transient.
    pub(super) fn energy_parts(&self) -> [N; 2] {
        let Parameters { length, gravity, wave_speed, .. } = self.rod;
        let left = self.left.square() * length;
        let pressed = gravity.clone() * length / wave_speed;
        let strain = pressed.square() * length / length.int(6);
        [length.zero().widened(&left), strain.widened(&(left + pressed * &self.left * length))]
    }
}

/// Finds the first of `most` round trips after which a contact that lasts from the start on deviates from the static
/// state by less than the roundoff of `max(μ, g t₁)`, in velocities and `c` times strains, at all later times.
///
/// With `R = r t₁`, `τ = t/t₁`, `V = max(μ, g t₁)`; `z = v − v_s` has `p = z_t − c z_x`, `q = z_t + c z_x`.
///
/// *Energy.* In the modes `ω = (2n+1)π/t₁` the flow of `(ωa, ȧ)` is `e^{−rt}` times a matrix with entries
/// `cosh Ωt ± rS`, `±ωS`, `S = sinh(Ωt)/Ω`, `Ω² = r² − ω²`, so at most `e^{st}(1 + (r+ω)|S|e^{−st})`, `s = Re Ω` at
/// most that of the lowest mode. `|S|e^{−st} ≤ min(t, 1/|Ω|)` gives `(r+ω)|S|e^{−st} ≤ √3` for `ω ≥ 2r` and `≤ 3rt`
/// below. Modes are orthogonal: `√E(t) ≤ (1 + max(√3, 3rt)) e^{−ρt} √E(0)` with `ρ = r − s`, and
/// `E(0) = ½(μ²L + g²L³/3c²) ≤ 0.55 L V²`.
///
/// *Maximum.* Along a characteristic `p′ = −rp − rq`, and `(c/2)∫q² dt ≤ E` over one crossing of the rod, by the energy
/// that flows through that line; reflections change signs only. A path from `t/2` on has at most `τ + 2` crossings of
/// `t₁/2`, and starts from `|p|, |q| ≤ μ + gL/c ≤ 1.5 V`, which never grow: `|p|/V ≤ 1.5 e^{−Rτ/2} + 0.53 R (τ+2) (1 +
/// max(√3, 1.5Rτ)) e^{−ρt/2}`.
///
/// The right side falls once it is below the roundoff: each of its factors `τ e^{−ρt/4}` falls for `ρt > 4`.
pub(super) fn faded_after<N: Scalar>(rod: &Parameters<N>, most: i64) -> Option<i64> {
    use std::f64::consts::{LN_2, PI};
    let damping = (rod.damping.clone() * rod.round_trip()).to_f64();
    let rate = if damping > PI { PI * PI / (damping + (damping * damping - PI * PI).sqrt()) } else { damping };
    let goal = rod.damping.log2_roundoff() * LN_2;
    (1..=most).find(|k| {
        let trips = *k as f64;
        let start = 1.5f64.ln() - damping * trips / 2.0;
        let flow = 1.0 + (1.5 * damping * trips).max(3f64.sqrt());
        let rest = (0.53 * damping * (trips + 2.0) * flow).ln() - rate * trips / 2.0;
        rate * trips > 8.0 && start.max(rest) + LN_2 < goal
    })
}

#[cfg(test)]
#[path = "tests/static_state.rs"]
mod tests;
