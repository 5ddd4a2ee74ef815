//! The damped march against values from programs that share no code with it.

use dalembert::damped::Damped;
use dalembert::history::{Ending, EventKind, History, Side};
use dalembert::rod::Run;
use dalembert::{Number, Problem};
use serde_json::Value;

fn read(name: &str) -> Vec<Value> {
    let path = format!("{}/tests/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(case: &Value, key: &str) -> Number {
    case[key].as_str().unwrap().parse().unwrap()
}

fn problem(case: &Value) -> Problem {
    let [length, speed, gravity, impact] =
        ["length", "wave_speed", "gravity", "impact_speed"].map(|key| number(case, key));
    let mut problem = Problem::uniform(length, speed, gravity, impact);
    problem.rod.damping = Some(number(case, "damping"));
    problem
}

fn float(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

#[test]
fn repeated_bounces_are_those_of_the_volterra_equation() {
    for case in read("damped_bounces.json") {
        let name = case["name"].as_str().unwrap();
        let mut problem = problem(&case);
        problem.run = Run::Time(number(&case, "time"));
        let history = Damped::<f64>::solve(&problem, &(), 10.0).unwrap();
        assert_eq!(*history.ending(), Ending::Time);
        assert_eq!(history.end(), number(&case, "time").to_f64());
        let expected = case["events"].as_array().unwrap();
        let events = &history.events()[1..];
        assert_eq!(events.len(), expected.len(), "{name}");
        for (event, expected) in events.iter().zip(expected) {
            let kind = if expected["kind"] == "release" { EventKind::Release } else { EventKind::Impact };
            assert_eq!(event.kind, kind, "{name}");
            let off = [
                event.time - float(&expected["time"]),
                event.centre - float(&expected["h"]),
                event.centre_velocity - float(&expected["h_rate"]),
            ];
            println!("{name} {off:?} {:e}", event.time_error);
            assert!(off.iter().all(|d| d.abs() < 1e-9), "{name} {event:?} {expected}");
        }
        println!("{name} {:e} {:?}", history.error_estimate(), history.warnings());
        assert!(history.error_estimate() < 1e-9 && history.warnings().is_empty(), "{name}");
    }
}

#[test]
fn the_first_contact_is_that_of_the_series() {
    for case in read("first_contact.json") {
        let name = case["name"].as_str().unwrap();
        let mut problem = problem(&case);
        let bounce = case["bounce_time"].as_str().map(|t| t.parse::<f64>().unwrap());
        let list = |key: &str| -> Vec<Vec<f64>> {
            let rows = case[key].as_array().map(Vec::as_slice).unwrap_or_default();
            rows.iter().map(|row| row.as_array().unwrap().iter().map(float).collect()).collect()
        };
        let (stress, motion, field) = (list("stress"), list("motion"), list("field"));
        let last = stress.iter().chain(&motion).map(|row| row[0]).fold(bounce.unwrap_or(0.0), f64::max);
        problem.run = Run::Time(format!("{:?}", last * 1.01).parse().unwrap());
        let history = Damped::<f64>::solve(&problem, &(), 13.0).unwrap();
        let scale = number(&case, "impact_speed").to_f64();
        let t1 = 2.0 * number(&case, "length").to_f64() / number(&case, "wave_speed").to_f64();
        let unit = scale.max(t1 * number(&case, "gravity").to_f64());
        let c = number(&case, "wave_speed").to_f64();
        let near = |found: f64, expected: f64, unit: f64, what: &str| {
            let off = (found - expected).abs() / unit;
            assert!(off < 1e-11, "{name} {what}: {found} {expected} off {off:e}");
        };
        match bounce {
            Some(t) => near(history.events()[1].time, t, t1, "bounce"),
            None => assert_eq!(history.events().len(), 1, "{name}"),
        }
        for row in stress {
            near(history.stress(&row[0], Side::Right).unwrap(), row[1], unit / c, "stress");
        }
        for row in motion {
            let (h, rate) = history.centre(&row[0]).unwrap();
            near(h, row[1], unit * t1, "centre");
            near(rate, row[2], unit, "rate");
        }
        for row in field {
            let found = history.field(&row[0], &row[1], Side::Right).unwrap();
            near(found.displacement, row[2], unit * t1, "v");
            near(found.velocity, row[3], unit, "v_t");
            near(found.strain, row[4], unit / c, "v_x");
        }
        if let (Some(t), true) = (bounce, case["bounce_energy"].is_object()) {
            let energy = history.energy(&t).unwrap();
            let expected = &case["bounce_energy"];
            let length = number(&case, "length").to_f64();
            near(energy.total, float(&expected["total"]), unit * unit * length, "energy");
            near(energy.vibrational, float(&expected["vibrational"]), unit * unit * length, "vibrational energy");
        }
    }
}
