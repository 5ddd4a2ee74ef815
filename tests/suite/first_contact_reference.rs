//! The reference values of an independent ball-arithmetic program.

use dalembert::engine::FirstContact;
use dalembert::number::{Answer, Scalar};
use dalembert::special::RoundedSpecial;
use dalembert::{Estimate, Number, Parameters, Side};
use serde_json::Value;

fn cases() -> Vec<Value> {
    serde_json::from_str(include_str!("../reference/first_contact.json")).unwrap()
}

fn number<S: Scalar>(value: &Value, precision: &S::Precision) -> S {
    S::from_number(&value.as_str().unwrap().parse::<Number>().unwrap(), precision)
}

fn parameters<S: RoundedSpecial>(case: &Value, precision: &S::Precision) -> Parameters<S> {
    let read = |key: &str| number(&case[key], precision);
    Parameters {
        length: read("length"),
        wave_speed: read("wave_speed"),
        damping: read("damping"),
        gravity: read("gravity"),
        speed: read("impact_speed"),
    }
}

/// `found` against `truth`: relative to it, or to `scale` where that is larger; and the estimate's own bound must hold.
fn check<S: RoundedSpecial>(what: &str, found: Estimate<S>, truth: &S, scale: f64, accuracy: f64) {
    let wrong = (found.value().clone() - truth).to_f64().abs();
    let size = truth.to_f64().abs().max(scale);
    assert!(wrong <= accuracy * size, "{what}: {found:?}, expected {truth:?}: off by {wrong:e}");
    // The arguments are rounded too, and the printed truth has 40 digits.
    let slack = 1e-39 * size + 8.0 * 2f64.powf(truth.log2_roundoff()) * size;
    assert!(wrong <= found.bound() + slack, "{what}: off by {wrong:e}, bound {:e}", found.bound());
    assert!(found.bound() <= 64.0 * accuracy * size, "{what}: bound {:e} says nothing", found.bound());
}

fn values<S: RoundedSpecial>(precision: &S::Precision, accuracy: f64) {
    for case in cases() {
        let name = case["name"].as_str().unwrap();
        let rod = parameters::<S>(&case, precision);
        let contact = FirstContact::new(&rod.carry());
        let t1 = rod.round_trip().to_f64();
        let speed = rod.speed.to_f64() + rod.critical_speed().to_f64();
        let strain = speed / rod.wave_speed.to_f64();
        let read = |value: &Value| number::<S>(value, precision);
        let exactly = |value: &Value| read(value).carry();
        for row in case["stress"].as_array().unwrap() {
            let found = contact.strain(&exactly(&row[0]), Side::Right);
            check(&format!("{name} stress"), found, &read(&row[1]), strain * 1e-3, accuracy);
        }
        for row in case["motion"].as_array().unwrap() {
            let (height, velocity) = contact.centre(&exactly(&row[0]));
            check(&format!("{name} h"), height, &read(&row[1]), 0.1 * speed * t1, accuracy);
            check(&format!("{name} h′"), velocity, &read(&row[2]), 0.1 * speed, accuracy);
        }
        for row in case["field"].as_array().unwrap() {
            let field = contact.field(&exactly(&row[0]), &exactly(&row[1]), Side::Right);
            let found = [(field.displacement, speed * t1), (field.velocity, speed), (field.strain, strain)];
            for (k, (found, scale)) in found.into_iter().enumerate() {
                check(&format!("{name} field {k}"), found, &read(&row[k + 2]), 0.1 * scale, accuracy);
            }
        }
    }
}

#[test]
fn values_in_doubles() {
    values::<f64>(&(), 1e-12);
}
#[test]
fn values_in_forty_digits() {
    values::<rug::Float>(&160, 1e-37);
}
