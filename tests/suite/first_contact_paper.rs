//! The closed forms against the paper's own integrals, done by quadrature that shares no code with them.

use dalembert::engine::FirstContact;
use dalembert::{Estimate, Parameters, Side};
use dalembert_verify::paper::PrintedIntegrals;

fn known(x: f64) -> Estimate<f64> {
    Estimate::exact(x)
}

#[test]
fn closed_forms_are_the_paper_s_integrals() {
    for [l, c, r, g, mu] in [[1.0, 1.5, 0.7, 0.9, 1.3], [0.5, 1.0, 2.6, 0.0, 1.0], [2.0, 1.0, 0.05, 3.0, 0.2]] {
        let rod = Parameters { length: l, wave_speed: c, damping: r, gravity: g, speed: mu };
        let (contact, paper) = (FirstContact::new(&rod.carry()), PrintedIntegrals::new(&rod, 1e-6));
        let t1 = 2.0 * l / c;
        let speed = mu + g * t1;
        for trips in [0.13, 0.71, 1.37, 2.62] {
            let t = trips * t1;
            for part in [0.0, 0.21, 0.83, 1.0] {
                let x = part * l;
                let field = contact.field(&known(x), &known(t), Side::Right);
                let truth = paper.field(x, t);
                let found = [&field.displacement, &field.velocity, &field.strain];
                for (k, scale) in [speed * t1, speed, speed / c].into_iter().enumerate() {
                    let wrong = (found[k].value() - truth[k]).abs();
                    assert!(wrong < 1e-11 * scale, "r = {r}, x = {x}, t = {t}, {k}: {:?} {}", found[k], truth[k]);
                    assert!(found[k].bound() < 1e-12 * scale, "{k} {:?}", found[k]);
                }
            }
            let stress = contact.strain(&known(t), Side::Right).into_value();
            let truth = paper.strain(t);
            assert!((stress - truth).abs() < 1e-11 * speed / c, "r = {r}, t = {t}: {stress} {truth}");
            // The stress for μ = c and g = 0, turned around.
            let light = Parameters { gravity: 0.0, speed: c, ..rod };
            let kernel = -FirstContact::new(&light.carry()).strain(&known(t), Side::Right).into_value();
            assert!((kernel - (-r * t).exp() * paper.impact_kernel(t)).abs() < 1e-12);
            let (height, velocity) = contact.centre(&known(t));
            let (height, velocity) = (height.value(), velocity.value());
            let momentum = paper.momentum(t);
            assert!((velocity * l - momentum).abs() < 1e-10 * speed * l, "{} {momentum}", velocity * l);
            // (3.39), as the mean of (2.24).
            let mean = paper.centre(t);
            assert!((height - mean).abs() < 1e-10 * speed * t1, "{} {mean}", height);
        }
    }
}

/// Both limits on a ray, and Proposition 2: `[v_x] = e^{−rt} [φᵉ]/2c` along each characteristic.
#[test]
fn jumps_are_those_of_proposition_2() {
    let (r, mu) = (0.4f64, 1.7f64);
    let contact =
        FirstContact::new(&Parameters { length: 1.0, wave_speed: 1.0, damping: r, gravity: 0.6, speed: mu }.carry());
    // At the ground both families cross: a jump of 2μ/c at t₁, upwards; downwards at 2t₁.
    for (t, sign) in [(2.0f64, 1.0), (4.0, -1.0), (6.0, 1.0)] {
        let jump = contact.strain(&known(t), Side::Right).value() - contact.strain(&known(t), Side::Left).value();
        assert!((jump - sign * 2.0 * mu * (-r * t).exp()).abs() < 1e-14, "{t} {jump}");
    }
    // On the first ray up, x = ct: v_t from −μ's share to that of the ground.
    let [left, right] = [Side::Left, Side::Right].map(|side| contact.field(&known(0.5), &known(0.5), side));
    let decay = (-0.5 * r).exp();
    assert!((right.velocity.value() - left.velocity.value() - mu * decay).abs() < 1e-15);
    assert!((right.strain.value() - left.strain.value() + mu * decay).abs() < 1e-15);
    assert_eq!(right.displacement.value(), left.displacement.value());
}

/// Scaled sums stay finite and accurate where `e^{rt}` overflows: the rod settles on `v_s = (g/2c²)(x² − 2Lx)`.
#[test]
fn strong_damping() {
    for r in [25.0, 500.0, 5e3] {
        let contact = FirstContact::new(
            &Parameters { length: 1.0, wave_speed: 1.0, damping: r, gravity: 1.0, speed: 1.0 }.carry(),
        );
        // The first cell: −c v_x = μ e^{−rt}I₀(rt) + g t e^{−rt}(I₀ + I₁)(rt), asymptotically.
        let z = 1.9 * r;
        let leading = 1.0 / (2.0 * std::f64::consts::PI * z).sqrt();
        let (i0e, i1e) =
            (leading * (1.0 + 0.125 / z + 0.0703125 / (z * z)), leading * (1.0 - 0.375 / z - 0.1171875 / (z * z)));
        let expected = -(i0e + 1.9 * (i0e + i1e));
        let stress = contact.strain(&known(1.9), Side::Right);
        assert!((stress.value() / expected - 1.0).abs() < 0.2 / z.powi(3) + 1e-12, "{r} {stress:?} {expected}");
        let field = contact.field(&known(0.7), &known(1.9), Side::Right);
        let all = [&field.displacement, &field.velocity, &field.strain];
        assert!(*field.displacement.value() < 0.0 && all.iter().all(|x| x.bound() < 1e-9), "{r} {field:?}");
    }
}
