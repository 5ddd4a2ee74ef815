//! Damped runs that are proved: every enclosure holds what more digits and other programs say.

use crate::common::{number, problem, reference};
use dalembert::number::Scalar;
use dalembert::{Ending, EventKind, Float, History, Interval, Number, Problem, Question, Run, Side};
use dalembert::{Numbers, Plan, Solution};

fn rod(damping: &str, speed: &str, gravity: &str, impacts: u32) -> Problem {
    let mut rod = Problem::uniform(1.into(), 1.into(), number_of(gravity), number_of(speed));
    (rod.rod.damping, rod.run) = (Some(number_of(damping)), Run::Impacts(impacts));
    rod
}

fn number_of(text: &str) -> Number {
    text.parse().unwrap()
}

/// Whether an enclosure holds a number that is known to so many digits of itself or of 1.
fn holds(what: &str, found: &Interval, truth: &Float, digits: i32) {
    let slack = Float::with_val(64, 10f64.powi(-digits)) * Float::with_val(64, truth.clone().abs() + 1);
    let (low, high) = (Float::with_val(400, truth - &slack), Float::with_val(400, truth + &slack));
    assert!(*found.lo() <= high && *found.hi() >= low, "{what}: {} is not {truth}", found.text());
}

/// Events, contacts and values between them, held against an unproved run in many more digits; how many were compared.
fn compare(name: &str, proved: &History<Interval>, digits: &History<Float>) -> usize {
    let mut count = 0;
    let mut check = |what: &str, found: &Interval, truth: &Float| {
        holds(&format!("{name}: {what}"), found, truth, 55);
        count += 1;
    };
    assert_eq!(proved.events().len(), digits.events().len(), "{name}");
    for (a, b) in proved.events().iter().zip(digits.events()) {
        assert_eq!(a.kind, b.kind);
        check("time", &a.time, &b.time);
        check("velocity", &a.end_velocity, &b.end_velocity);
        check("centre", &a.centre, &b.centre);
        check("rate", &a.centre_velocity, &b.centre_velocity);
    }
    for (a, b) in proved.contacts().iter().zip(digits.contacts()) {
        check("impulse", &a.impulse, &b.impulse);
        check("peak", &a.peak_strain, &b.peak_strain);
    }
    let end = digits.end().to_f64();
    for k in 1..6 {
        let at = number_of(&format!("{:.6}", end * f64::from(k) / 6.3));
        let point = number_of("0.375");
        let enclosed = |text: &Number| <Interval as Scalar>::from_number(text, &proved.end().precision());
        let long = |text: &Number| <Float as Scalar>::from_number(text, &digits.end().precision());
        let (time, place) = (enclosed(&at), enclosed(&point));
        let (long_time, long_place) = (long(&at), long(&point));
        let (a, b) = (proved.centre(time.clone()).unwrap(), digits.centre(long_time.clone()).unwrap());
        check("h", &a.0, &b.0);
        check("h′", &a.1, &b.1);
        let (a, b) = (proved.energy(time.clone()).unwrap(), digits.energy(long_time.clone()).unwrap());
        check("energy", &a.total, &b.total);
        check("vibration", &a.vibrational, &b.vibrational);
        let a = &proved.field(&[place], std::slice::from_ref(&time), Side::Right).unwrap()[0];
        let b = &digits.field(&[long_place], std::slice::from_ref(&long_time), Side::Right).unwrap()[0];
        check("v", &a.displacement, &b.displacement);
        check("v_t", &a.velocity, &b.velocity);
        check("v_x", &a.strain, &b.strain);
        let (a, b) = (proved.strain(time, Side::Right).unwrap(), digits.strain(long_time, Side::Right).unwrap());
        check("strain", &a, &b);
    }
    count
}

#[test]
fn enclosures_hold_what_more_digits_say() {
    let mut count = 0;
    for (damping, speed, gravity, impacts) in [("0.1", "3", "1", 3), ("0.2", "6", "1", 2)] {
        let problem = rod(damping, speed, gravity, impacts);
        let (proved, digits) = (problem.certified(20).unwrap(), problem.digits(60).unwrap());
        assert_eq!(*proved.ending(), Ending::NextImpact, "{damping} {speed}");
        count += compare(&format!("{damping} {speed}"), &proved, &digits);
    }
    assert!(count >= 110, "{count}");
}

#[test]
fn the_reference_values_are_proved_to_fifty_digits() {
    let mut count = 0;
    // Those of a short run that bounce at a ray.
    for case in [&reference("damped_bounces")[0], &reference("damped_bounces")[2]] {
        let name = case["name"].as_str().unwrap();
        let problem = problem(case, Run::Time(number(&case["time"])));
        let history = problem.certified(50).unwrap();
        let expected = case["events"].as_array().unwrap();
        assert_eq!(history.events().len(), expected.len() + 1, "{name}");
        for (event, expected) in history.events()[1..].iter().zip(expected) {
            let kind = if expected["kind"] == "release" { EventKind::Release } else { EventKind::Impact };
            assert_eq!(event.kind, kind, "{name}");
            assert!(event.time.radius() < 1e-48, "{name}: {}", event.time.text());
            for (found, key) in [(&event.time, "time"), (&event.centre, "h"), (&event.centre_velocity, "h_rate")] {
                let truth = Float::with_val(64, number(&expected[key]).to_f64());
                // What the other program gives is right to some 1e-11.
                holds(name, found, &truth, 10);
                count += 1;
            }
        }
    }
    assert!(count >= 18, "{count}");
}

#[test]
fn a_plan_of_proved_digits_follows_all_impacts() {
    let problem = rod("0.1", "3", "1", 2);
    let plan = Plan::of(&problem, &Question::run(Numbers::Certified(15))).unwrap();
    let solution = plan.solve(&problem, std::sync::Arc::new(|_, _| std::ops::ControlFlow::Continue(()))).unwrap();
    let Solution::Certified(history, 15) = solution else { panic!("no proof") };
    assert_eq!(history.events().len(), 4);
    // From another program.
    assert!((history.events()[2].time.mid().to_f64() - 6.113_251_158_753_762).abs() < 1e-14);
}
