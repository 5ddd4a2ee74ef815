//! The damped march against values from programs that share no code with it.

use crate::common::{close, number, problem, reference};
use crate::stripped::damped;
use dalembert::engine::Motion;
use dalembert::{Ending, EventKind, Run, Side};

/// A string or number as a double.
fn value(json: &serde_json::Value) -> f64 {
    number(json).to_f64()
}

#[test]
fn repeated_bounces_are_those_of_the_volterra_equation() {
    for case in reference("damped_bounces") {
        let name = case["name"].as_str().unwrap();
        let problem = problem(&case, Run::Time(number(&case["time"])));
        let history = damped::<f64>(&problem, &(), 12.0).unwrap();
        assert_eq!(*history.ending(), Ending::Time);
        assert_eq!(history.end(), number(&case["time"]).to_f64());
        let expected = case["events"].as_array().unwrap();
        let events = &history.events()[1..];
        assert_eq!(events.len(), expected.len(), "{name}");
        for (event, expected) in events.iter().zip(expected) {
            let kind = if expected["kind"] == "release" { EventKind::Release } else { EventKind::Impact };
            assert_eq!(event.kind, kind, "{name}");
            let time = value(&expected["time"]);
            assert!((event.t - time).abs() <= event.t_error.max(1e-11), "{name} {event:?} {expected}");
            close(name, event.h, value(&expected["h"]), 1.0, 1e-11);
            close(name, event.h_rate, value(&expected["h_rate"]), 1.0, 1e-11);
        }
        assert!(history.error_estimate() < 1e-10 && history.warnings().is_empty(), "{name}");
    }
}

#[test]
fn the_first_contact_is_that_of_the_series() {
    for case in reference("first_contact") {
        let name = case["name"].as_str().unwrap();
        let bounce = case["bounce_time"].as_str().map(|_| value(&case["bounce_time"]));
        let list = |key: &str| -> Vec<Vec<f64>> {
            let rows = case[key].as_array().map(Vec::as_slice).unwrap_or_default();
            rows.iter().map(|row| row.as_array().unwrap().iter().map(value).collect()).collect()
        };
        let (stress, motion, field) = (list("stress"), list("motion"), list("field"));
        let last = stress.iter().chain(&motion).map(|row| row[0]).fold(bounce.unwrap_or(0.0), f64::max);
        let problem = problem(&case, Run::Time(format!("{:?}", last * 1.01).parse().unwrap()));
        let history = damped::<f64>(&problem, &(), 13.0).unwrap();
        let [length, c, gravity, speed] =
            ["length", "wave_speed", "gravity", "impact_speed"].map(|key| value(&case[key]));
        let t1 = 2.0 * length / c;
        let unit = speed.max(t1 * gravity);
        let near = |what: &str, found: f64, expected: f64, unit: f64| {
            close(&format!("{name}: {what}"), found / unit, expected / unit, 1.0, 1e-12);
        };
        match bounce {
            Some(t) => near("bounce", history.events()[1].t, t, t1),
            None => assert_eq!(history.events().len(), 1, "{name}"),
        }
        for row in stress {
            near("stress", history.strain(&row[0], Side::Right).unwrap(), row[1], unit / c);
        }
        for row in motion {
            let (h, rate) = history.centre(&row[0]).unwrap();
            near("centre", h, row[1], unit * t1);
            near("rate", rate, row[2], unit);
        }
        for row in field {
            let found = history.field(&row[0], &row[1], Side::Right).unwrap();
            near("v", found.displacement, row[2], unit * t1);
            near("v_t", found.velocity, row[3], unit);
            near("v_x", found.strain, row[4], unit / c);
        }
        if let (Some(t), true) = (bounce, case["bounce_energy"].is_object()) {
            let energy = history.energy(&t).unwrap();
            let expected = &case["bounce_energy"];
            near("energy", energy.total, value(&expected["total"]), unit * unit * length);
            near("vibrational energy", energy.vibrational, value(&expected["vibrational"]), unit * unit * length);
        }
    }
}
