//! Energies, restitution and flight.

use dalembert::engine::FirstContact;
use dalembert::number::Answer;
use dalembert::special::RoundedSpecial;
use dalembert::{Estimate, Number, Parameters};
use dalembert_verify::paper::UndampedContact;
use serde_json::Value;

fn rod(damping: f64, gravity: f64, speed: f64) -> FirstContact<Estimate<f64>> {
    FirstContact::new(&Parameters { length: 1.0, wave_speed: 1.0, damping, gravity, speed }.carry())
}

fn known(x: f64) -> Estimate<f64> {
    Estimate::exact(x)
}

fn reference<S: RoundedSpecial>(precision: &S::Precision, accuracy: f64) {
    let cases: Vec<Value> = serde_json::from_str(include_str!("../reference/first_contact.json")).unwrap();
    for case in cases {
        let Some(tb) = case["bounce_time"].as_str() else { continue };
        let name = case["name"].as_str().unwrap();
        let lift = |text: &str| S::from_number(&text.parse::<Number>().unwrap(), precision);
        let read = |value: &Value| lift(value.as_str().unwrap());
        let contact = FirstContact::new(
            &Parameters {
                length: read(&case["length"]),
                wave_speed: read(&case["wave_speed"]),
                damping: read(&case["damping"]),
                gravity: read(&case["gravity"]),
                speed: read(&case["impact_speed"]),
            }
            .carry(),
        );
        let (speed, length) = (read(&case["impact_speed"]).to_f64(), read(&case["length"]).to_f64());
        let lattice = (lift(tb).to_f64() / contact.round_trip().value().to_f64()) == 1.0;
        let time = if lattice { contact.round_trip() } else { lift(tb).carry() };
        let energy = contact.energy(&time);
        let rebound = contact.rebound(&time);
        let truth = &case["bounce_energy"];
        let check = |what: &str, found: &Estimate<S>, truth: &Value, scale: f64| {
            let (truth, bound) = (read(truth), found.bound());
            let wrong = (found.value().clone() - &truth).to_f64().abs();
            let size = truth.to_f64().abs().max(scale);
            assert!(wrong <= accuracy * size, "{name} {what}: {found:?}, expected {truth:?}, off by {wrong:e}");
            let slack = 1e-33 * size + 16.0 * 2f64.powf(truth.log2_roundoff()) * size;
            assert!(wrong <= bound + slack, "{name} {what}: off by {wrong:e}, bound {bound:e}");
        };
        let natural = 0.5 * speed * speed * length;
        check("E", &energy.total, &truth["total"], 1e-3 * natural);
        check("E_h", &energy.translational, &truth["translational"], 1e-3 * natural);
        // A late bounce has little energy left, of which v_t and v_x know no more than a part of μ.
        let scale = if lattice { 0.0 } else { 1e-3 * natural };
        check("E_z", &energy.vibrational, &truth["vibrational"], scale);
        let squared = rebound.energy_restitution_squared();
        match (&squared, truth["restitution_energy_squared"].as_str()) {
            (Some(found), Some(_)) => check("e_E²", found, &truth["restitution_energy_squared"], 1e-3),
            (None, None) => {}
            (found, truth) => {
                // The reference prints negative values as they are.
                let negative = truth.is_some_and(|t| t.starts_with('-'));
                assert!(found.is_none() && negative, "{name}: {found:?} {truth:?}");
            }
        }
        check("h⁰", &rebound.centre, &case["bounce_h"], 0.1 * speed * contact.round_trip().value().to_f64());
        check("h¹", &rebound.velocity, &case["bounce_h_rate"], 0.1 * speed);
    }
}

#[test]
fn reference_in_doubles() {
    reference::<f64>(&(), 1e-12);
}
#[test]
fn reference_in_many_digits() {
    reference::<rug::Float>(&200, 1e-33);
}

/// Without damping, against Theorem 2, for the smallest shares too: μ = 100 m/s on a steel bar has E_z/E ≈ 5·10⁻¹⁰.
#[test]
fn the_smallest_vibrations_keep_their_digits() {
    for speed in [3.0, 100.0, 1e5, 1e8] {
        let steel = Parameters { length: 1.0, wave_speed: 5000.0, damping: 0.0, gravity: 9.81, speed };
        let contact = FirstContact::new(&steel.carry());
        let vibrational = contact.energy(&contact.round_trip()).vibrational;
        let truth = UndampedContact::new(&steel).unwrap().vibrational_energy_at_bounce();
        assert!((vibrational.value() - truth).abs() < 1e-13 * truth, "{speed}: {vibrational:?} {truth}");
        assert!(vibrational.bound() < 1e-12 * truth, "{speed} {vibrational:?}");
    }
}

/// g = 0: to lowest order v_x = R²(2a − 1)/4 · μ/c, so E_z/E(0) → R⁴/48, which a difference would lose at once.
#[test]
fn vibrations_of_order_r_to_the_fourth() {
    for damping in [1e-3, 1e-6, 1e-12, 1e-30] {
        let energy = rod(damping, 0.0, 1.0).energy(&known(2.0));
        let r: f64 = 2.0 * damping;
        let ratio = energy.vibrational.value() / 0.5 / r.powi(4);
        assert!((ratio - 1.0 / 48.0).abs() < 0.1 * r + 1e-15, "{damping}: {ratio}");
    }
    for (damping, speed) in [(0.0024f64, 100.0f64), (0.1, 5.0), (0.4, 50.0), (0.5, 1e9)] {
        let short = rod(damping, 1.0, speed).energy(&known(2.0)).vibrational;
        let lift = |x: f64| rug::Float::with_val(400, x);
        let long = Parameters {
            length: lift(1.0),
            wave_speed: lift(1.0),
            damping: lift(damping),
            gravity: lift(1.0),
            speed: lift(speed),
        };
        // Far from t₁ by a hair the plain path is taken; 400 bits have enough digits for it.
        let near = lift(2.0) * (1.0 - lift(1e-60));
        let exact = FirstContact::new(&long.carry()).energy(&Estimate::exact(near));
        let truth = exact.vibrational.value().to_f64();
        let wrong = (short.value() - truth).abs();
        assert!(wrong < 1e-13 * truth && wrong <= short.bound(), "{damping} {speed}: {wrong:e} {truth:e}");
    }
}

/// The corrected limit of (4.75) and the factors of (4.73).
#[test]
fn limit_of_restitution() {
    let limits =
        [(0.1, 0.818_990_81, 1.000_668_92), (0.2, 0.671_948_93, 1.005_413_37), (0.3, 0.553_131_36, 1.018_665_83)];
    for (damping, limit, seventh) in limits {
        let contact = rod(damping, 1.0, 1e12);
        let squared = contact.rebound(&known(2.0)).energy_restitution_squared().unwrap().into_value();
        assert!((squared.sqrt() - limit).abs() < 6e-9, "{damping} {}", squared.sqrt());
        let energy = contact.energy(&known(2.0));
        let (share, retained) = (energy.translational.value() / energy.total.value(), energy.total.value() / 5e23);
        assert!((share * retained - squared).abs() < 1e-14);
        assert!((retained * (4.0 * damping).exp() - seventh).abs() < 6e-9, "{damping} {retained}");
    }
}

/// (3.59), and Remark 2's printed form where nothing cancels.
#[test]
fn flight_obeys_its_equation() {
    let contact = rod(0.3, 1.0, 10.0);
    let rebound = contact.rebound(&known(2.0));
    let (h0, h1) = (*rebound.centre.value(), *rebound.velocity.value());
    let flight = |t: f64| {
        let (h, rate) = rebound.flight(&known(t));
        (h.into_value(), rate.into_value())
    };
    let r = 0.3f64;
    let rise = (1.0 + 2.0 * r * h1).ln();
    let (time, height) = rebound.highest().unwrap();
    let (time, height) = (time.into_value(), height.into_value());
    assert!((time - (2.0 + rise / (2.0 * r))).abs() < 1e-13);
    assert!((height - ((h1 + 2.0 * r * h0) / (2.0 * r) - rise / (4.0 * r * r))).abs() < 1e-12);
    let (h, velocity) = flight(time);
    assert!((h - height).abs() < 1e-13 && velocity.abs() < 1e-13);
    let step = 1e-4;
    let [(before, _), (now, speed), (after, _)] = [3.0 - step, 3.0, 3.0 + step].map(flight);
    let second = (after - 2.0 * now + before) / (step * step);
    assert!((second + 2.0 * r * speed + 1.0).abs() < 1e-6);
    let undamped =
        UndampedContact::new(&Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 4.0 });
    let exact = undamped.unwrap();
    let flying = rod(1e-300, 1.0, 4.0).rebound(&known(2.0));
    for t in [2.0, 3.5, 6.0] {
        let ((h, v), (truth, rate)) = (flying.flight(&known(t)), exact.centre(&t));
        assert!((h.value() - truth).abs() < 1e-14 * 10.0 && (v.value() - rate).abs() < 1e-14);
    }
}
