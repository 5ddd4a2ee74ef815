//! The first contact in doubles at the extremes of every parameter. Single hard cases stand in the catalogue of
//! `check`.

use crate::common::{bounce_time, first_contact};
use dalembert::engine::FirstContact;
use dalembert::{Ending, Estimate, Parameters, Reason, Side};
use dalembert_verify::modal::Modal;

fn rod(damping: f64, gravity: f64, length: f64, speed: f64) -> Parameters<f64> {
    Parameters { length, wave_speed: 1.0, damping, gravity, speed }
}

fn contact(rod: &Parameters<f64>) -> FirstContact<Estimate<f64>> {
    FirstContact::new(&rod.carry())
}

fn known(x: f64) -> Estimate<f64> {
    Estimate::exact(x)
}

/// Values with their bounds: finite where the parameters are, and as far from the modes as both bounds allow. `value ±
/// error` of two routes that share nothing.
fn same(what: &str, a: &Estimate<f64>, b: &Estimate<f64>) {
    assert!(a.value().is_finite() && a.error().is_finite(), "{what}: {a:?}");
    assert!((a.value() - b.value()).abs() <= a.bound() + b.bound(), "{what}: {a:?} {b:?}");
}

/// R from 10⁻³⁰⁰ to 10⁴ and μ/μ₀ from 10⁻⁸ to 10⁸, on a ray from both sides and off it.
#[test]
fn every_size_of_damping_and_speed() {
    for damping in [0.0, 1e-300, 1e-150, 1e-30, 1e-9, 1e-4, 0.1, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4] {
        for speed in [1e-8, 1e-4, 1.0, 1e4, 1e8] {
            let rod = rod(damping, 1.0, 0.5, speed);
            let (contact, modal) = (contact(&rod), Modal::new(&rod, 256));
            let scale = speed + 1.0;
            for trips in [1e-8, 0.4, 1.0, 2.0, 2.5, 7.0f64] {
                let sides = if trips.fract() == 0.0 { &[Side::Left, Side::Right][..] } else { &[Side::Right] };
                for side in sides.iter().copied() {
                    let name = format!("R = {damping:e}, M = {speed:e}, τ = {trips}, {side:?}");
                    let stress = contact.strain(&known(trips), side);
                    same(&name, &stress, &modal.strain(&trips, side));
                    assert!(stress.bound() < 1e-11 * scale, "{name}: {stress:?}");
                    let field = contact.field(&known(0.25), &known(trips), side);
                    let values = [&field.displacement, &field.velocity, &field.strain];
                    assert!(values.iter().all(|v| v.value().is_finite()), "{name}: {field:?}");
                    assert!(values.iter().all(|v| v.bound() < 1e-10 * scale), "{name}: {field:?}");
                }
                let (h, p) = contact.centre(&known(trips));
                let (height, rate) = modal.centre(&trips);
                same("h", &h, &height);
                same("h′", &p, &rate);
                let energy = contact.energy(&known(trips));
                let positive = *energy.vibrational.value() >= 0.0;
                assert!(energy.total.value().is_finite() && positive, "{damping} {speed} {trips}");
            }
        }
    }
}

/// Strong damping, g t₁ = 1: after the first return the rod creeps to its static state; by the diffusion that is left,
/// `−c v_x → ½ − Σ (4/ω²) e^{−(R−κ)τ}`, the overdamped modes alone.
#[test]
fn strong_damping_diffuses() {
    for damping in [50.0f64, 1e3, 1e4] {
        let contact = contact(&rod(damping, 1.0, 0.5, 1e-8));
        for tau in [2.5f64, 8.5] {
            let mut truth = 0.5;
            for n in 0..4000u32 {
                let w = std::f64::consts::PI * f64::from(2 * n + 1);
                if w < 0.9 * damping {
                    let kappa = (damping * damping - w * w).sqrt();
                    // C + RS = e^{κτ}(1 + R/κ)/2 up to e^{−2κτ}.
                    let slow = (-w * w / (damping + kappa) * tau).exp() * (1.0 + damping / kappa) / 2.0;
                    truth -= 4.0 / (w * w) * slow;
                }
            }
            let stress = contact.strain(&known(tau), Side::Right);
            assert!((stress.value() + truth).abs() < 2e-8 + stress.bound(), "{damping} {tau}: {stress:?} {truth}");
        }
    }
}

/// Below R = π the bounce is late, and never a rounding error; so close to π that it cannot be found, it is undecided,
/// which takes longer numbers to say. The catalogue of `check` shows that there is none from π on.
#[test]
fn below_pi() {
    for damping in [2.0, 2.5, 2.9, 3.0, 3.1] {
        let (time, _) = bounce_time(&first_contact(&rod(damping, 0.0, 0.5, 1.0), 1e-9)).unwrap();
        let stress = |t: f64| Modal::new(&rod(damping, 0.0, 0.5, 1.0), 2048).strain(&t, Side::Right);
        let (before, after) = (stress(time * (1.0 - 1e-7)), stress(time * (1.0 + 1e-7)));
        assert!(*before.value() < -before.bound() && *after.value() > after.bound(), "{damping}: {before:?} {after:?}");
    }
    for damping in [3.141_592, 3.141_592_653_589_793] {
        let found = first_contact(&rod(damping, 0.0, 0.5, 1.0), 1e-9);
        assert!(matches!(found.ending(), Ending::Undecided(Reason::Doubt(_))), "{damping}: {}", found.ending());
    }
}

/// Steel, rubber and a column of water, and each in units that differ by 10^±8: the same rod, t_b in new units.
#[test]
fn units_do_not_matter() {
    // L, c, r, g, μ: a steel bar, a rubber rod, a kilometre of water behind a valve, without weight.
    for (l, c, r, g, mu) in [
        (1.0, 5000.0, 12.0, 9.81, 1.0),
        (0.1, 40.0, 30.0, 9.81, 0.03),
        (0.1, 40.0, 30.0, 9.81, 3.0),
        (1000.0, 1200.0, 0.05, 0.0, 2.0),
    ] {
        let time = |metre: f64, second: f64| {
            let rod = Parameters {
                length: l * metre,
                wave_speed: c * metre / second,
                damping: r / second,
                gravity: g * metre / second / second,
                speed: mu * metre / second,
            };
            let contact = contact(&rod);
            let (time, _) = bounce_time(&first_contact(&rod, 1e-11)).unwrap();
            let squared = contact.rebound(&known(time)).energy_restitution_squared().map(Estimate::into_value);
            let energy = contact.energy(&known(time)).total;
            let useful = energy.bound() <= 1e-10 * rod.speed.powi(2) * rod.length;
            assert!(energy.value().is_finite() && useful, "{energy:?}");
            same("E", &energy, &Modal::new(&rod, 512).energy(&time));
            (time / second, squared)
        };
        let (plain, squared) = time(1.0, 1.0);
        for (metre, second) in [(1e8, 1.0), (1e-8, 1.0), (1.0, 1e8), (1.0, 1e-8), (1e8, 1e-8), (1e-8, 1e8)] {
            let (other, again) = time(metre, second);
            assert!((other / plain - 1.0).abs() < 2e-11, "{metre} {second}: {plain} {other}");
            match (squared, again) {
                (Some(a), Some(b)) => assert!((a - b).abs() < 1e-10 * a.max(1e-3), "{a} {b}"),
                (a, b) => assert_eq!(a.is_some(), b.is_some()),
            }
        }
    }
}
