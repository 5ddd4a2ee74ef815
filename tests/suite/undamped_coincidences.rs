//! Events that coincide with a ray, and events that nearly do: rounded numbers do not tell the two apart.

use dalembert::engine::Motion;
use dalembert::solve::{Rung, Target};
use dalembert::{
    Estimate, Event, EventKind, Numbers, Plan, Problem, Question, Run, Scene, TypedHistory, Warning, builtin,
};
use proptest::prelude::*;
use rug::{Float, Rational};
use std::sync::Arc;

/// The events with their bounds.
fn events(history: &TypedHistory<f64>) -> Vec<Event<Estimate<f64>>> {
    history.ask(|motion| Ok(motion.events().to_vec()), |_| Vec::new()).unwrap()
}

/// A rod whose sizes are small fractions, as its speed is in units of `g t₁` but for a part in `10^k`: events and rays
/// that would meet miss each other by as much.
fn nearly_meeting() -> impl Strategy<Value = Problem> {
    let size = (1i64..=9, 1i64..=5);
    (size.clone(), size.clone(), size, (1i64..=60, 1i64..=12), prop_oneof![-15i32..=-4, 4i32..=15], 2u32..12).prop_map(
        |(length, wave_speed, gravity, speed, k, impacts)| {
            let [l, c, g] = [length, wave_speed, gravity].map(Rational::from);
            let miss = Rational::from((k.signum(), 10i64.pow(k.unsigned_abs()))) + 1;
            let speed = Rational::from(speed) * &g * 2 * &l / &c * miss;
            let text = |x: Rational| x.to_string();
            let mut problem = crate::common::uniform(&text(l), &text(c), &text(g), &text(speed), Run::Impacts(1));
            problem = problem.with_run(Run::Impacts(impacts)).unwrap();
            problem
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    /// A landing just before a ray and one just after it have other velocities, and the contacts differ from there on;
    /// forty digits tell them apart.
    #[test]
    fn a_near_miss_is_not_a_meeting(problem in nearly_meeting()) {
        let (ours, truth) = (problem.doubles().unwrap(), problem.digits(40).unwrap());
        prop_assert!(ours.warnings().is_empty(), "{:?}", ours.warnings());
        let ours = events(&ours);
        prop_assert_eq!(ours.len(), truth.events().len());
        for (a, b) in ours.iter().zip(truth.events()) {
            prop_assert_eq!(a.kind, b.kind);
            let pairs = [
                (&a.t, &b.t),
                (&a.v_end, &b.v_end),
                (&a.h, &b.h),
                (&a.h_rate, &b.h_rate),
            ];
            for (a, b) in pairs {
                let off = Float::with_val(200, b - a.value()).abs().to_f64();
                // The truth is known to forty digits of the greatest number.
                let own = 1e-30 * b.to_f64().abs().max(1.0);
                prop_assert!(off <= a.bound() + own, "{a:?} {b} at {}", b.to_f64());
            }
        }
    }
}

/// At `μ/(g t₁) = 18` the rod lands as a ray arrives, with `−297.5`. A part in 10¹⁵ more speed, and the landing comes
/// first: the ray's jump of 35 is missing.
#[test]
fn a_landing_before_a_ray_has_its_own_velocity() {
    let velocity = |speed: &str| {
        let rod = crate::common::uniform("7", "4", "5", speed, Run::Impacts(2)).doubles().unwrap();
        let landing = rod.events().iter().filter(|event| event.kind == EventKind::Impact).nth(1).unwrap();
        (rod.rung(), landing.v_end)
    };
    let (rung, found) = velocity("315");
    assert!(rung == Rung::Fractions && (found + 297.5).abs() < 1e-11, "{rung} {found}");
    let (rung, found) = velocity("63000000000000063/200000000000000");
    assert!(matches!(rung, Rung::Bits(_)), "{rung}");
    assert!((found + 332.5).abs() < 1e-11, "{found}");
}

/// What meets exactly is decided by fractions, or by enclosures with exact roots where a time is no fraction.
#[test]
fn a_meeting_is_decided_exactly() {
    let rung = |name: &str| {
        let scene = Scene::parse(builtin::get(name).unwrap().source).unwrap();
        let history = scene.problem.doubles().unwrap();
        assert!(history.warnings().is_empty(), "{:?}", history.warnings());
        history.rung()
    };
    assert_eq!(rung("doyen-ern-piperno"), Rung::Fractions);
    assert!(matches!(rung("mu-1-period-36"), Rung::Enclosures(_)));
}

/// Where enclosures have the same events, doubles answer as before, and warn no more.
#[test]
fn enclosures_confirm_doubles() {
    let problem = Scene::parse(builtin::get("mu-1-period-36").unwrap().source).unwrap().problem;
    let plan = Plan::of(&problem, &Question::run(Numbers::Double(None))).unwrap();
    let observe: dalembert::Observer = Arc::new(dalembert::engine::unobserved);
    let [double, confirmed] =
        [Rung::Double, Rung::Confirmed(384)].map(|rung| f64::run(&problem, &plan, rung, &observe).unwrap());
    assert!(double.warnings().iter().any(|warning| matches!(warning, Warning::Coincidence { .. })));
    assert!(confirmed.warnings().is_empty(), "{:?}", confirmed.warnings());
    let times = |of: &dyn Motion<Estimate<f64>>| of.events().iter().map(|event| event.t.clone()).collect::<Vec<_>>();
    let (ours, theirs) = (times(&*double), times(&*confirmed));
    assert!(ours.len() > 20 && ours.len() == theirs.len());
    for (a, b) in ours.iter().zip(&theirs) {
        assert!(a.value() == b.value() && a.bound() == b.bound(), "{a:?} {b:?}");
    }
}

/// Below the critical speed the end leaves the ground at a root of the stress, and its ray brings q = 0 again two round
/// trips later, in contact: exactly zero, whatever the roundings of the root. Doubles are enough.
#[test]
fn a_kink_keeps_its_zero() {
    for speed in ["0.304", "1.3", "0.7"] {
        let rod = crate::common::uniform("1", "1", "1", speed, Run::Impacts(8)).doubles().unwrap();
        assert_eq!(rod.rung(), Rung::Double, "{speed}");
        assert_eq!(rod.contacts().len(), 8);
    }
}

/// Late in a chaotic run doubles know a ray to some thousandths of a round trip: a time beside it is not on it.
#[test]
fn a_time_beside_an_uncertain_ray_is_not_on_it() {
    let rod =
        crate::common::uniform("0.00206", "0.0008631", "1.138e5", "2.262e6", Run::Time("741.24497".parse().unwrap()));
    let motion = rod.doubles().unwrap();
    // In contact, 0.026 before the ray that ends it.
    assert_eq!(motion.ground_end(741.24497, dalembert::Side::Right).unwrap(), (0.0, 0.0));
}

/// What is no number is no time of any history, whatever numbers it took.
#[test]
fn a_time_that_is_no_number_is_refused() {
    let motion = crate::common::uniform("1", "1", "1", "3", Run::Impacts(2)).doubles().unwrap();
    assert_eq!(motion.rung(), Rung::Fractions);
    let right = dalembert::Side::Right;
    for time in [f64::NAN, f64::INFINITY] {
        assert!(matches!(motion.strain(time, right), Err(dalembert::Error::TimeOutside { .. })));
        assert!(matches!(motion.centre(time), Err(dalembert::Error::TimeOutside { .. })));
    }
    assert!(matches!(motion.at(f64::NAN, 1.0), Err(dalembert::Error::PointOutside { .. })));
}

/// An impact a part in 10¹³ after the end of the run is not in it.
#[test]
fn an_impact_beyond_the_end_is_none() {
    let events = |height: &str| {
        let text = format!(
            "[rod]\nlength = 1\nwave_speed = 1\n[start]\ndisplacement = [[0, \"{height}\"], [1, \"{height}\"]]\n\
             velocity = [[0, -0.7], [1, 4]]\n[gravity]\nacceleration = 1\n[run]\ntime = 4\n"
        );
        Scene::parse(&text).unwrap().problem.doubles().unwrap().events().len()
    };
    // v(0,4) = d + 4 · 1.65 − 8 = d − 1.4.
    assert_eq!(["1.4000000000001", "1.4", "1.3999999999999"].map(events), [0, 1, 1]);
}
