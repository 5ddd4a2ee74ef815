//! Damped scenes as a user solves them, against the reference values of independent programs and the table of hard
//! cases.

use crate::common::{close, number, problem, reference};
use dalembert::quantity::{Quantity, ValueQuery};
use dalembert::solve::Rung;
use dalembert::{Ending, EventKind, Number, Numbers, Parameters, Plan, Problem, Question, Run, Side, TypedHistory};
use serde_json::Value;
use std::sync::Arc;

fn in_doubles(problem: &Problem, accuracy: Option<f64>) -> TypedHistory<f64> {
    let plan = Plan::of(problem, &Question::run(Numbers::Double(accuracy))).unwrap();
    TypedHistory::solve(problem, &plan, Arc::new(dalembert::engine::unobserved)).unwrap()
}

fn items(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

/// The times, in the order of the reference, at which a first contact is asked about.
fn last_time(case: &Value) -> Number {
    let bounce = &case["bounce_time"];
    if bounce.is_null() { number(&items(&case["stress"])[1][0]) } else { number(bounce) }
}

/// A run to just beyond the bounce, which may be irrational.
fn run(case: &Value) -> Run {
    let last = last_time(case).to_f64() * (1.0 + 1e-9);
    Run::Time(format!("{last:e}").parse().unwrap())
}

#[test]
fn every_first_contact_in_doubles() {
    for case in reference("first_contact") {
        let name = case["name"].as_str().unwrap();
        let problem = problem(&case, run(&case));
        let history = in_doubles(&problem, None);
        let rod = Parameters::<f64>::of(&problem, &()).unwrap();
        let speed = rod.speed.max(rod.critical_speed());
        let (rise, strain) = (speed * rod.round_trip(), speed / rod.wave_speed);
        let f = |value: &Value| number(value).to_f64();
        for row in items(&case["stress"]) {
            let ours = history.strain(f(&row[0]), Side::Right).unwrap();
            close(&format!("{name}: stress at {}", row[0]), ours, f(&row[1]), 0.0, 1e-12);
        }
        for row in items(&case["motion"]) {
            let (h, rate) = history.centre(f(&row[0])).unwrap();
            close(&format!("{name}: h at {}", row[0]), h, f(&row[1]), 1e-3 * rise, 1e-12);
            close(&format!("{name}: h' at {}", row[0]), rate, f(&row[2]), 1e-3 * speed, 1e-12);
        }
        for row in items(&case["field"]) {
            let ours = history.at(f(&row[0]), f(&row[1])).unwrap();
            let place = format!("{name} at x = {}, t = {}", row[0], row[1]);
            close(&format!("{place}: v"), ours.displacement, f(&row[2]), 1e-2 * rise, 1e-12);
            close(&format!("{place}: v_t"), ours.velocity, f(&row[3]), 1e-2 * speed, 1e-12);
            close(&format!("{place}: v_x"), ours.strain, f(&row[4]), 1e-2 * strain, 1e-12);
        }
        let bounce = &case["bounce_time"];
        if bounce.is_null() {
            assert!(history.events().iter().all(|event| event.kind == EventKind::Impact), "{name}");
            continue;
        }
        let release = &history.events()[1];
        assert_eq!(release.kind, EventKind::Release, "{name}");
        close(&format!("{name}: t_b"), release.t, f(bounce), 0.0, 1e-12);
        close(&format!("{name}: h(t_b)"), release.h, f(&case["bounce_h"]), 1e-3 * rise, 1e-12);
        close(&format!("{name}: h'(t_b)"), release.h_rate, f(&case["bounce_h_rate"]), 1e-3 * speed, 1e-12);
        let energy = history.energy(release.t).unwrap();
        let truth = &case["bounce_energy"];
        let start = 0.5 * rod.speed * rod.speed * rod.length;
        close(&format!("{name}: E"), energy.total, f(&truth["total"]), 1e-3 * start, 1e-12);
        close(&format!("{name}: E_h"), energy.translational, f(&truth["translational"]), 1e-3 * start, 1e-12);
        close(&format!("{name}: E_z"), energy.vibrational, f(&truth["vibrational"]), 1e-3 * start, 1e-12);
    }
}

/// Thirty digits of everything, each relative to itself.
#[test]
fn every_first_contact_to_thirty_digits() {
    use rug::{Float, Rational};
    for case in reference("first_contact") {
        let name = case["name"].as_str().unwrap();
        let problem = problem(&case, run(&case));
        let history = problem.digits(30).unwrap();
        let bits = history.end().prec();
        let lift = |value: &Value| Float::with_val(bits, number(value).to_rational());
        // The reference has 34 to 45 digits; its times have 30, its zeros are below 1e-40 of their scale.
        let same = |what: &str, ours: &Float, truth: &Value| {
            let truth = number(truth).to_rational();
            let ours = ours.to_rational().unwrap();
            let error = Rational::from(&ours - &truth).abs();
            let scale = truth.clone().abs().max(Rational::from((1, 1_000_000)));
            let accuracy = number(&Value::from("1e-29")).to_rational();
            assert!(error <= scale * accuracy, "{name}: {what}: {} against {}", ours.to_f64(), truth.to_f64());
        };
        for row in items(&case["stress"]) {
            same("stress", &history.strain(lift(&row[0]), Side::Right).unwrap(), &row[1]);
        }
        for row in items(&case["motion"]) {
            let (h, rate) = history.centre(lift(&row[0])).unwrap();
            same("h", &h, &row[1]);
            same("h'", &rate, &row[2]);
        }
        for row in items(&case["field"]) {
            let field = history.at(lift(&row[0]), lift(&row[1])).unwrap();
            same("v", &field.displacement, &row[2]);
            same("v_t", &field.velocity, &row[3]);
            same("v_x", &field.strain, &row[4]);
        }
        if case["bounce_time"].is_null() {
            continue;
        }
        let release = history.events()[1].clone();
        same("t_b", &release.t, &case["bounce_time"]);
        same("h(t_b)", &release.h, &case["bounce_h"]);
        same("h'(t_b)", &release.h_rate, &case["bounce_h_rate"]);
        let energy = history.energy(release.t.clone()).unwrap();
        same("E", &energy.total, &case["bounce_energy"]["total"]);
        same("E_h", &energy.translational, &case["bounce_energy"]["translational"]);
        same("E_z", &energy.vibrational, &case["bounce_energy"]["vibrational"]);
    }
}

/// Later impacts to 1e-9, for an accuracy of 1e-10; the start is the first event here and not in the file.
#[test]
fn later_impacts() {
    for case in reference("damped_bounces") {
        let name = case["name"].as_str().unwrap();
        let history = in_doubles(&problem(&case, Run::Time(number(&case["time"]))), Some(1e-10));
        let expected = items(&case["events"]);
        assert_eq!(history.events().len(), expected.len() + 1, "{name}");
        for (event, truth) in history.events()[1..].iter().zip(expected) {
            let value = |key: &str| truth[key].as_f64().unwrap();
            assert_eq!(event.kind == EventKind::Impact, truth["kind"] == "impact", "{name}");
            close(&format!("{name}: time"), event.t, value("time"), 1.0, 1e-9);
            close(&format!("{name}: h"), event.h, value("h"), 1.0, 1e-9);
            close(&format!("{name}: h'"), event.h_rate, value("h_rate"), 1.0, 1e-9);
        }
    }
}

/// The rod of section 4 of the hard cases: g = 0, c = 1, t₁ = 1, μ = 1.
fn late(damping: &str) -> Problem {
    let mut problem = crate::common::uniform("1/2", "1", "0", "1", Run::Impacts(1));
    problem = problem.to_builder().damping(damping).build().unwrap();
    problem
}
#[test]
fn late_bounces_are_no_rounding_noise() {
    for (damping, truth) in [
        ("3.13", "11.66136670144388438415940577414071411946"),
        ("3.135", "15.33318837004014558549067344667885556140"),
        ("3.14", "31.40409847658940057227989202780933895332"),
    ] {
        let release = in_doubles(&late(damping), None).events()[1].clone();
        assert_eq!(release.kind, EventKind::Release);
        // Doubles carry r = 3.14 itself only to 1e-16, but the scene's decimal is exact.
        close(damping, release.t, truth.parse().unwrap(), 0.0, 1e-15);
    }
}

#[test]
fn an_overdamped_rod_without_gravity_never_bounces() {
    for damping in ["3.15", "3.3", "10", "1e4"] {
        let history = in_doubles(&late(damping), None);
        assert!(matches!(history.ending(), Ending::NoBounce(_)), "{damping}: {:?}", history.ending());
        assert_eq!(history.events().len(), 1);
        let end = *history.end();
        for k in 1..200 {
            let time = end * f64::from(k) / 200.0;
            assert!(history.strain(time, Side::Right).unwrap() <= 0.0, "{damping} at {time}");
        }
    }
}

/// On either side of the threshold of (2.32): a root just after t₁ = 2 on the left, exactly 2 on the right.
#[test]
fn the_threshold_of_the_first_bounce() {
    let near = |speed: &str| {
        let mut problem = crate::common::uniform("1", "1", "1", speed, Run::Impacts(1));
        problem = problem.to_builder().damping("0.2").build().unwrap();
        in_doubles(&problem, None).events()[1].t
    };
    let below = near("2.59364495455930337818987448");
    assert!(below > 2.0 && below < 2.0 + 1e-9, "{below}");
    let left = near("2.59364495456019330337818987448");
    assert!((2.0..2.0 + 1e-11).contains(&left), "{left}");
    assert_eq!(near("2.59364495456019530337818987448"), 2.0);
}

/// Every accuracy that is asked for is met, by the history in many bits and by what the error estimate says.
#[test]
fn the_ladder_of_accuracies() {
    let mut problem = crate::common::uniform("1", "1", "1", "3", Run::Time(11.into()));
    problem = problem.to_builder().damping("0.1").build().unwrap();
    let truth = problem.digits(25).unwrap();
    for exponent in [2, 4, 6, 8, 10, 12, 13] {
        let accuracy = 10f64.powi(-exponent);
        let history = in_doubles(&problem, Some(accuracy));
        let scales = history.scales();
        assert!(history.error_estimate() <= accuracy, "{accuracy:e}");
        assert_eq!(history.events().len(), truth.events().len());
        for (ours, truth) in history.events().iter().zip(truth.events()) {
            close("time", ours.t, truth.t.to_f64(), scales.time, accuracy);
            close("h", ours.h, truth.h.to_f64(), scales.time * scales.velocity, accuracy);
            close("h'", ours.h_rate, truth.h_rate.to_f64(), scales.velocity, accuracy);
        }
    }
}

/// Later impacts to fifty digits: two runs of different precision agree in all of them.
#[test]
fn later_impacts_to_fifty_digits() {
    let mut problem = crate::common::uniform("1", "1", "1", "1", Run::Time(13.into()));
    problem = problem.to_builder().damping("0.05").build().unwrap();
    let (a, b) = (problem.digits(50).unwrap(), problem.digits(60).unwrap());
    assert_eq!(a.events().len(), 7);
    for (a, b) in a.events().iter().zip(b.events()) {
        for (x, y) in [(&a.t, &b.t), (&a.h, &b.h), (&a.h_rate, &b.h_rate)] {
            let error = (x.clone() - y).abs();
            assert!(error <= y.clone().abs() * 1e-50, "{} against {}", x, y);
        }
    }
}

/// A thousand digits of the first contact: the closed form at two precisions.
#[test]
fn a_first_contact_to_a_thousand_digits() {
    let digits = |n: u32| late("2.6").digits(n).unwrap().events()[1].t.clone();
    let (a, b) = (digits(1000), digits(1020));
    let error = (rug::Float::with_val(4000, &a) - &b).abs();
    assert!(error <= rug::Float::with_val(64, rug::Float::parse("1e-1000").unwrap()), "{error}");
}

/// The times of ten impacts are known as well as was asked for, relative to the greatest number of the answer, and the
/// bound of the whole run covers what many digits say.
#[test]
fn ten_impacts_know_how_far_they_are_off() {
    for (damping, speed) in [("0.001", "3"), ("0.01", "3"), ("0.02", "10"), ("0.1", "10")] {
        let mut problem = crate::common::uniform("1", "1", "1", speed, Run::Impacts(10));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let history = in_doubles(&problem, Some(1e-10));
        let truth = problem.digits(20).unwrap();
        let (scales, estimate) = (history.scales(), history.error_estimate());
        let worst = history.events().iter().fold(0.0, |worst: f64, event| worst.max(event.t_error));
        assert!(worst <= 1e-10 * history.end(), "{damping} {speed}: {worst:e}");
        assert_eq!(history.events().len(), 20);
        for (ours, truth) in history.events().iter().zip(truth.events()) {
            close("time", ours.t, truth.t.to_f64(), scales.time, estimate);
            close("h", ours.h, truth.h.to_f64(), scales.time * scales.velocity, estimate);
            close("h'", ours.h_rate, truth.h_rate.to_f64(), scales.velocity, estimate);
        }
    }
}

/// Ordinary rods need no long numbers: the bound of ten impacts and of the flights between them stays below the
/// accuracy.
#[test]
fn ordinary_rods_are_settled_in_doubles() {
    for damping in ["0.001", "0.003", "0.01", "0.03", "0.05", "0.1"] {
        let mut problem = crate::common::uniform("1", "1", "1", "3", Run::Impacts(10));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let history = problem.doubles().unwrap();
        assert_eq!(history.events().len(), 20);
        assert_eq!(history.flights().unwrap().len(), 10);
        assert_eq!(history.rung(), Rung::Double, "r = {damping}");
    }
}

/// A run says how far it is, from its beginning to its end and never backwards: in round trips, or in contacts.
#[test]
fn a_damped_run_is_observed() {
    use std::sync::{Arc, Mutex};
    let observed = |problem: &Problem| -> Vec<usize> {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let plan = Plan::of(problem, &Question::run(Numbers::Double(Some(1e-2)))).unwrap();
        let note = seen.clone();
        let observe = move |done, _| {
            note.lock().unwrap().push(done);
            std::ops::ControlFlow::Continue(())
        };
        plan.solve(problem, Arc::new(observe)).unwrap();
        let seen = seen.lock().unwrap();
        seen.clone()
    };
    let rod = || Problem::builder().length(1).wave_speed(1).damping("0.01").gravity(1).impact_speed(3);
    let trips = observed(&rod().time(40).build().unwrap());
    assert!(trips.is_sorted() && [19, 20].contains(trips.last().unwrap()) && trips.len() > 5, "{trips:?}");
    let contacts = observed(&rod().impacts(3).build().unwrap());
    assert!(contacts.is_sorted() && contacts[0] == 1 && *contacts.last().unwrap() == 3, "{contacts:?}");
}

/// The vibration after an impact may have far less energy than a rounding of the time brings to the end next to the
/// ray that releases it: 1.3e-14 of 22.
#[test]
fn the_energy_of_a_weak_vibration_is_within_its_bound() {
    for damping in ["1e-2", "1e-3", "5e-4", "1.62036e-4", "1e-5"] {
        let rod = Problem::builder().length(5).wave_speed(4).damping(damping).gap("45/8").impact_speed(3);
        let rod = rod.impacts(2).build().unwrap();
        let query = ValueQuery { quantity: Quantity::VibrationalAfter, point: None, time: None, side: Side::Right };
        let [found, truth] = [Numbers::Double(None), Numbers::Digits(30)]
            .map(|numbers| rod.solve_in(numbers).unwrap().query(&query).unwrap().unwrap());
        let (off, bound) = ((found.to_f64() - truth.to_f64()).abs(), found.bound().to_f64());
        assert!(off <= bound && bound < 1e-11, "{damping}: {off:e}, bound {bound:e}");
    }
}
