//! What the paper says of whole curves: each follows from a formula that is evaluated here on its own. Single numbers
//! stand in the catalogue of `check`.

use dalembert::engine::{Bounce, BounceKind, FirstContact};
use dalembert::{Estimate, Parameters, Side};
use dalembert_verify::modal::Modal;
use dalembert_verify::paper::UndampedContact;

fn rod(damping: f64, gravity: f64, speed: f64) -> Parameters<f64> {
    Parameters { length: 1.0, wave_speed: 1.0, damping, gravity, speed }
}

fn contact(damping: f64, gravity: f64, speed: f64) -> FirstContact<Estimate<f64>> {
    FirstContact::new(&rod(damping, gravity, speed).carry())
}

fn known(x: f64) -> Estimate<f64> {
    Estimate::exact(x)
}

/// `E_h/E` and `E/E(0)` at t = 2.
fn factors(contact: &FirstContact<Estimate<f64>>) -> (f64, f64) {
    let energy = contact.energy(&known(2.0));
    let (total, rod) = (energy.total.into_value(), contact.rod());
    (energy.translational.into_value() / total, total / (rod.speed.value().powi(2) * rod.length.value() / 2.0))
}

/// `I_n`, by the integral after (2.22), (2.16) for n = 0: the first kind, whatever the text says.
fn bessel(n: u32, z: f64) -> f64 {
    let count = 40u32;
    let angle = |k: u32| 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(count);
    (0..count).map(|k| (f64::from(n) * angle(k)).cos() * (z * angle(k).cos()).exp()).sum::<f64>() / f64::from(count)
}

/// The right-hand side of (2.32), in closed form: the black dots of Figure 4.
fn dot(damping: f64) -> f64 {
    let r = 2.0 * damping;
    2.0 * (bessel(0, r) + bessel(1, r)) / (2.0 - bessel(0, r))
}

fn bounce(damping: f64, speed: f64) -> (f64, BounceKind) {
    match contact(damping, 1.0, speed).bounce() {
        Bounce::At { time, kind, .. } => (time.into_value(), kind),
        other => panic!("{damping} {speed}: {other:?}"),
    }
}

/// (4.75): `lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`, which stands in the catalogue, is `e^{−R}(1 + R³/24 + …)`;
/// with gravity the rest falls like μ₀/μ.
#[test]
fn how_restitution_tends_to_its_limit() {
    let limit = |r: f64| 2.0 * (-r).exp() * (bessel(0, r) - bessel(1, r)) - (-2.0 * r).exp();
    for damping in [0.1, 0.2, 0.3] {
        for speed in [1e3, 1e6] {
            let found = contact(damping, 1.0, speed).rebound(&known(2.0));
            let off = (found.energy_restitution_squared().unwrap().value().sqrt() - limit(2.0 * damping)).abs();
            assert!(off < 4.0 / speed && off > 1e-3 / speed, "{damping} {speed}: {off:e}");
        }
    }
    for r in [0.02f64, 0.05] {
        let found = (limit(r) * r.exp() - 1.0) / r.powi(3);
        assert!((found - 1.0 / 24.0).abs() < r / 10.0, "{r}: {found}");
    }
}

/// (4.73): the two factors, whose limits stand in the catalogue, multiply to `e_E²`; at μ = 10⁹ both are at their
/// limits.
#[test]
fn the_factors_of_restitution() {
    for damping in [0.1, 0.2, 0.3] {
        let weightless = contact(damping, 0.0, 1.0);
        let (share, left) = factors(&weightless);
        let squared = *weightless.rebound(&known(2.0)).energy_restitution_squared().unwrap().value();
        assert!((share * left - squared).abs() < 1e-14, "{damping}: {share} {left} {squared}");
        let (far_share, far_left) = factors(&contact(damping, 1.0, 1e9));
        assert!((far_share - share).abs() < 1e-8 && (far_left - left).abs() * (4.0 * damping).exp() < 1e-8);
    }
}

/// Figure 4: right of its dots `t_b = t₁`; left of them the curves go on, with `t_b > t₁`, and join continuously in
/// `t_b`.
#[test]
fn figure_4() {
    assert_eq!(dot(0.0), 2.0);
    assert!((dot(0.2) - 2.593_644_954_560_194).abs() < 1e-14);
    for damping in [0.0, 0.1, 0.2, 0.3] {
        let threshold = dot(damping);
        assert_eq!(bounce(damping, threshold * (1.0 + 1e-9)), (2.0, BounceKind::Jump));
        let (time, kind) = bounce(damping, threshold * (1.0 - 1e-9));
        assert!(kind == BounceKind::Root && time > 2.0 && time < 2.0 + 1e-7, "{damping}: {time}");
        let mut last = f64::INFINITY;
        for k in 1..=50 {
            let speed = 0.25 * f64::from(k);
            let time = match contact(damping, 1.0, speed).bounce() {
                Bounce::At { time, .. } => time,
                // A slow rod stays on the ground: part (i) of Theorem 1.
                Bounce::Never(_) if damping > 0.0 && speed < threshold => continue,
                other => panic!("{damping} {speed}: {other:?}"),
            };
            let time = time.into_value();
            assert_eq!(time == 2.0, speed >= threshold, "{damping} {speed}");
            assert!(time <= last, "a faster rod does not stay longer");
            last = time;
            // e_E² by the modes, which share nothing with the closed forms.
            let modal = Modal::new(&rod(damping, 1.0, speed), 512);
            let (h, rate) = modal.centre(&time);
            let expected = (rate.value() * rate.value() + 2.0 * h.value()) / (speed * speed);
            let error = (4.0 * (rate.value().abs() * rate.bound() + h.bound())) / (speed * speed) + 1e-11;
            match contact(damping, 1.0, speed).rebound(&known(time)).energy_restitution_squared() {
                Some(found) => {
                    assert!((found.value() - expected).abs() <= error, "{damping} {speed}: {found:?} {expected}");
                }
                // Undefined where E_h < 0.
                None => assert!(expected < error, "{damping} {speed}: {expected}"),
            }
        }
    }
}

/// Figures 5 to 7, g = L = c = 1, μ from 3.2 to 12.5: the factors of (4.73) at `t₁`; for r = 0 those of Theorem 2.
#[test]
fn figures_5_to_7() {
    for damping in [0.0, 0.1, 0.2, 0.3] {
        let mut before = 0.0;
        for k in 0..20 {
            let speed = 3.2 + 9.3 * f64::from(k) / 19.0;
            let rod = rod(damping, 1.0, speed);
            let (share, retained) = factors(&contact(damping, 1.0, speed));
            let modal = Modal::new(&rod, 1024);
            let (energy, (h, rate)) = (modal.energy(&2.0), modal.centre(&2.0));
            let start = 0.5 * speed * speed;
            assert!((retained - energy.value() / start).abs() <= energy.bound() / start + 1e-13, "{damping} {speed}");
            let translational = 0.5 * rate.value() * rate.value() + h.value();
            assert!(
                (share - translational / energy.value()).abs() <= 4.0 * energy.bound() + 1e-11,
                "{damping} {speed}"
            );
            // Figure 5: all curves rise and stay below one.
            assert!(share > before && share < 1.0, "{damping} {speed}: {share}");
            before = share;
            if damping == 0.0 {
                assert!((share - (1.0 - 4.0 / (3.0 * speed * speed))).abs() < 1e-14 && (retained - 1.0).abs() < 1e-14);
            }
        }
    }
}

/// Theorem 2, Figures 2 and 3: the least restitution is 5/9, at `2μ₀/3`.
#[test]
fn figures_2_and_3() {
    let least = |speed: f64| UndampedContact::new(&rod(0.0, 1.0, speed)).unwrap().energy_restitution_squared().unwrap();
    assert!((least(4.0 / 3.0) - 5.0 / 9.0).abs() < 1e-15);
    for k in 1..400 {
        let speed = 0.02 * f64::from(k);
        assert!(least(speed) >= 5.0 / 9.0 - 1e-15);
        if speed == 2.0 {
            // μ = μ₀ and r = 10⁻³⁰⁰: doubles alone cannot say on which side of the threshold.
            continue;
        }
        let (time, _) = bounce(1e-300, speed);
        let found = contact(1e-300, 1.0, speed).rebound(&known(time)).energy_restitution_squared().unwrap();
        assert!((found.value() - least(speed)).abs() < 1e-11, "{speed}: {found:?}");
    }
}

/// After (3.42), "Ψ_r = 0 on (t₁,t_b)": the contact lasts there, and the stress is compressive; it vanishes from t_b
/// on.
#[test]
fn the_rod_is_compressed_until_it_leaves() {
    for (damping, speed) in [(0.1, 1.0), (0.2, 2.0), (0.3, 2.0)] {
        let (time, _) = bounce(damping, speed);
        let contact = contact(damping, 1.0, speed);
        for k in 1..20 {
            let t = 2.0 + (time - 2.0) * f64::from(k) / 20.0;
            let stress = contact.strain(&known(t), Side::Right);
            assert!(*stress.value() < -stress.bound(), "{damping} {t}: {stress:?}");
        }
    }
}
