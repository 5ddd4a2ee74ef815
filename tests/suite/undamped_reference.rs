//! The undamped lattice against the reference values of an independent program.

use crate::common::{close, number, problem, reference};
use crate::stripped::undamped;
use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::{EventKind, Rational, Run, Side};
use serde_json::Value;

fn kind(event: &Value) -> EventKind {
    if event["kind"] == "impact" { EventKind::Impact } else { EventKind::Release }
}

/// The impacts and releases of a case. The list of `mu_2` closes with a `graze` at t = 30 where its computation
/// stopped: by the exact period 12 that is the impact of t = 6 and t = 18 again (see `rational_histories_are_exact`).
fn events(case: &Value) -> Vec<&Value> {
    case["events"].as_array().unwrap().iter().filter(|event| event["kind"] != "graze").collect()
}

/// A run to just beyond the last event of the list, which may be irrational.
fn run(case: &Value) -> Run {
    let last = number(&events(case).last().unwrap()["time"]).to_f64();
    Run::Time((last + 1e-6).to_string().parse().unwrap())
}

#[test]
fn all_events_in_double_precision() {
    for case in reference("undamped_bounces") {
        let name = case["name"].as_str().unwrap();
        let problem = problem(&case, run(&case));
        let history = undamped::<f64>(&problem, &()).unwrap();
        let expected = events(&case);
        let speed = number(&case["impact_speed"]).to_f64();
        let length = number(&case["length"]).to_f64();
        assert_eq!(history.events().len(), expected.len(), "{name}");
        for (event, truth) in history.events().iter().zip(expected) {
            let value = |key: &str| (!truth[key].is_null()).then(|| number(&truth[key]).to_f64());
            let time = value("time").unwrap();
            let place = format!("{name} at {time}");
            assert_eq!(event.kind, kind(truth), "{place}");
            // A landing that v(0,·) reaches with zero slope is a double root: half the digits of its time.
            let (_, before) = history.ground_end(&(event.t - 1e-4), Side::Right).unwrap_or_default();
            let tangential = event.kind == EventKind::Impact && before.abs() < 1e-3;
            let accuracy = if tangential { 1e-7 } else { 1e-12 };
            close(&format!("{place}: time"), event.t, time, length, accuracy);
            assert!((event.t - time).abs() <= event.t_error.max(f64::EPSILON * time), "{place}: the bound holds");
            for (key, ours, scale) in
                [("approach", event.v_end, speed), ("h", event.h, length), ("h_rate", event.h_rate, speed)]
            {
                if let Some(truth) = value(key) {
                    close(&format!("{place}: {key}"), ours, truth, scale, 1e-12);
                }
            }
            let (v, _) = history.ground_end(&event.t, Side::Left).unwrap();
            close(&format!("{place}: v(0,t)"), v, 0.0, length, 1e-12);
        }
    }
}

/// 38 digits, as they are printed. The numbers of the reference have 40.
#[test]
fn all_events_to_38_digits() {
    use dalembert::number::decimal;
    use rug::Float;
    for case in reference("undamped_bounces") {
        let name = case["name"].as_str().unwrap();
        let expected = events(&case);
        let problem = problem(&case, run(&case));
        let history = undamped::<Float>(&problem, &320).unwrap();
        assert_eq!(history.events().len(), expected.len(), "{name}");
        for (event, truth) in history.events().iter().zip(expected) {
            for (key, ours) in
                [("time", &event.t), ("approach", &event.v_end), ("h", &event.h), ("h_rate", &event.h_rate)]
            {
                if truth[key].is_null() {
                    continue;
                }
                let truth = number(&truth[key]).to_rational();
                let ours = ours.to_rational().unwrap();
                let place = format!("{name} at {}: {key}", truth.to_f64());
                if truth.clone().abs() < 1e-30 {
                    assert!(ours.abs() < 1e-60, "{place}");
                } else {
                    // Their 40th digit is rounded: half a unit of it.
                    let error = Rational::from(&ours - &truth) / &truth;
                    assert!(error.abs() <= 5e-40, "{place}: {} against {}", decimal(&ours, 42), decimal(&truth, 42));
                }
            }
        }
    }
}

/// Where the reference shows a rational history, fractions reproduce it exactly and never meet a surd.
#[test]
fn rational_histories_are_exact() {
    for case in reference("undamped_bounces") {
        let name = case["name"].as_str().unwrap();
        if !["mu_2", "mu_3", "doyen_ern_piperno"].contains(&name) {
            continue;
        }
        let history = undamped::<Rational>(&problem(&case, Run::Time(60.into())), &()).unwrap();
        assert_eq!(history.ending(), &dalembert::Ending::Time, "{name}");
        for (event, truth) in history.events().iter().zip(events(&case)) {
            let difference = event.t.clone() - number(&truth["time"]).to_rational();
            assert!(Scalar::to_f64(&difference).abs() < 1e-35, "{name}");
            // Times are multiples of L/c, which decimals cannot say but fractions can.
            let steps =
                event.t.clone() * number(&case["wave_speed"]).to_rational() / number(&case["length"]).to_rational();
            let whole = steps.floor_int().map(|n| steps.int(n));
            assert_eq!(whole.as_ref(), Some(&steps), "{name}");
        }
        let start = history.energy(&Rational::default()).unwrap().total;
        for event in history.events() {
            assert_eq!(history.energy(&event.t).unwrap().total, start, "{name}");
        }
    }
}
