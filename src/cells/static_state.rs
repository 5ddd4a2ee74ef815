//! The rod at rest on the ground under a free top, and when a contact without end has become that.

use crate::history::{Energy, Field};
use crate::number::Analytic;
use crate::rod::Parameters;

/// `v_s = (g/2c²)(x² − 2Lx)`: what a contact that never ends tends to.
#[derive(Clone, Debug)]
pub(super) struct StaticState<S> {
    /// `g/c²`.
    curvature: S,
    /// `g`.
    gravity: S,
    /// `L`.
    length: S,
    /// `c²`.
    square: S,
}

impl<S: Analytic> StaticState<S> {
    /// That of `rod`.
    pub(super) fn of(rod: &Parameters<S>) -> Self {
        let square = rod.wave_speed.square();
        let curvature = rod.gravity.clone() / &square;
        StaticState { curvature, square, gravity: rod.gravity.clone(), length: rod.length.clone() }
    }

    /// `v_s`, zero, `v_s′`.
    pub(super) fn field(&self, x: &S) -> Field<S> {
        let strain = (x.clone() - &self.length) * &self.curvature;
        let displacement = (x.clone() - self.length.clone() * x.int(2)) * x * &self.curvature * x.ratio(1, 2);
        Field { displacement, velocity: x.zero(), strain }
    }

    /// `h = −gL²/3c²`, and zero.
    pub(super) fn centre(&self) -> (S, S) {
        let x = &self.length;
        (x.square() * &self.curvature * x.ratio(-1, 3), x.zero())
    }

    /// `E_h = gLh`, `E_z = g²L³/6c²`.
    pub(super) fn energy(&self) -> Energy<S> {
        let translational = self.centre().0 * &self.gravity * &self.length;
        let strain = self.curvature.clone() * &self.length;
        let vibrational = strain.square() * &self.square * &self.length * strain.ratio(1, 6);
        Energy { total: translational.clone() + &vibrational, translational, vibrational }
    }
}

/// The first of `most` round trips after which a contact that lasts from the start on deviates from the static state by less
/// than the roundoff of `max(μ, g t₁)`, in velocities and `c` times strains, for ever.
///
/// With `R = r t₁`, `τ = t/t₁`, `V = max(μ, g t₁)`; `z = v − v_s` has `p = z_t − c z_x`, `q = z_t + c z_x`.
///
/// *Energy.* In the modes `ω = (2n+1)π/t₁` the flow of `(ωa, ȧ)` is `e^{−rt}` times a matrix with entries `cosh Ωt ± rS`,
/// `±ωS`, `S = sinh(Ωt)/Ω`, `Ω² = r² − ω²`, so at most `e^{st}(1 + (r+ω)|S|e^{−st})`, `s = Re Ω` at most that of the lowest mode.
/// `|S|e^{−st} ≤ min(t, 1/|Ω|)` gives `(r+ω)|S|e^{−st} ≤ √3` for `ω ≥ 2r` and `≤ 3rt` below. Modes are orthogonal:
/// `√E(t) ≤ (1 + max(√3, 3rt)) e^{−ρt} √E(0)` with `ρ = r − s`, and `E(0) = ½(μ²L + g²L³/3c²) ≤ 0.55 L V²`.
///
/// *Maximum.* Along a characteristic `p′ = −rp − rq`, and `(c/2)∫q² dt ≤ E` over one crossing of the rod, by the energy that
/// flows through that line; reflections change signs only. Followed from `t/2`, in at most `τ + 2` crossings of `t₁/2`,
/// from `|p|, |q| ≤ μ + gL/c ≤ 1.5 V`, which never grow:
/// `|p|/V ≤ 1.5 e^{−Rτ/2} + 0.53 R (τ+2) (1 + max(√3, 1.5Rτ)) e^{−ρt/2}`.
///
/// The right side falls once it is below the roundoff: each of its factors `τ e^{−ρt/4}` does for `ρt > 4`.
pub(super) fn faded_after<S: Analytic>(rod: &Parameters<S>, most: i64) -> Option<i64> {
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
mod tests {
    use super::*;
    use crate::first_contact::FirstContact;
    use crate::history::Side;

    #[test]
    fn the_closed_form_becomes_the_static_state() {
        for damping in [1.2, 1.6, 2.5] {
            let rod = Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed: 0.5 };
            let k = faded_after(&rod, 1000).unwrap();
            let contact = FirstContact::new(&rod);
            let state = StaticState::of(&rod);
            let t = 2.0 * k as f64;
            let (field, exact) = (contact.field(&0.4, &t, Side::Right).0, state.field(&0.4));
            for (a, b) in
                [(field.displacement, exact.displacement), (field.velocity, 0.0), (field.strain, exact.strain)]
            {
                assert!((a - b).abs() < 1e-12, "{damping} {k} {a} {b}");
            }
            let (energy, exact) = (contact.energy(&t).0, state.energy());
            assert!(
                (energy.total - exact.total).abs() < 1e-12 && (energy.vibrational - exact.vibrational).abs() < 1e-12
            );
            assert!((contact.centre(&t).0.value - state.centre().0).abs() < 1e-12);
        }
        let slow = Parameters { length: 0.5, wave_speed: 1.0, damping: 1e4, gravity: 0.0, speed: 1.0 };
        assert_eq!(faded_after(&slow, 256), None);
    }
}
