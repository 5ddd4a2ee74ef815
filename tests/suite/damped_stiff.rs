//! Real rods: thousands of round trips in a flight, then hop after hop. In doubles, against thirty digits of a march
//! that goes strip by strip and does not take flights apart.

use crate::common::{number, reference};
use crate::stripped::Stripped;
use crate::stripped::damped;
use dalembert::engine::{Damped, Motion};
use dalembert::{EventKind, Number, Problem, Run, Side, Warning};
use serde_json::Value;

/// The rod of a case, dropped.
fn rod(case: &Value) -> Problem {
    let of = |key: &str| number(&case[key]);
    let rod = Problem::builder().length(of("length")).material(of("modulus"), of("density"), "1e-4");
    let rod = rod.gravity(of("gravity")).damping(of("damping")).drop_height(of("drop_height"));
    rod.impacts(u32::try_from(case["impacts"].as_u64().unwrap()).unwrap()).build().unwrap()
}

fn solve(problem: &Problem) -> Stripped<f64, Damped<f64>> {
    damped(problem, &(), 13.0).unwrap()
}

#[test]
fn twenty_impacts_are_right_to_twelve_digits() {
    for case in reference("stiff_bounces") {
        let name = case["name"].as_str().unwrap();
        let history = solve(&rod(&case));
        let truth = case["events"].as_array().unwrap();
        assert_eq!(history.events().len(), truth.len(), "{name}");
        for (k, (event, truth)) in history.events().iter().zip(truth).enumerate() {
            let value = |k: usize| number(&truth[k]).to_f64();
            let (time, end, centre) = (value(1), value(2), value(3));
            assert_eq!(event.kind == EventKind::Impact, truth[0] == "impact", "{name} {k}");
            let speed = end.abs().max(centre.abs());
            let off =
                [(event.t - time) / time.max(1e-300), (event.v_end - end) / speed, (event.h_rate - centre) / speed];
            // The first velocity has the rounding of √(2gh), and h′ of an impact that of ten round trips.
            assert!(off[0].abs() < 1e-12 && off[1].abs() < 1e-12 && off[2].abs() < 1e-11, "{name} {k}: {off:?}");
        }
    }
}

/// What r loses in its last digits is not magnified from impact to impact.
#[test]
fn the_twentieth_impact_is_as_well_known_as_the_damping() {
    for case in reference("stiff_bounces").iter().take(3) {
        let plain = rod(case);
        let mut other = plain.clone();
        let damping = plain.damping().unwrap().to_f64() * (1.0 + 1e-14);
        other = other.to_builder().damping(format!("{damping:e}").parse::<Number>().unwrap()).build().unwrap();
        let (a, b) = (solve(&plain), solve(&other));
        for (a, b) in a.events().iter().zip(b.events()).filter(|(a, _)| a.kind == EventKind::Impact) {
            assert!((a.v_end / b.v_end - 1.0).abs() < 1e-13, "{a:?} {b:?}");
            assert!((a.t - b.t).abs() <= 1e-13 * a.t, "{a:?} {b:?}");
        }
    }
}

/// What is asked in the middle of a flight that was leapt over obeys the laws of motion.
#[test]
fn a_leap_can_be_asked_at_any_time() {
    let case = &reference("stiff_bounces")[0];
    let history = solve(&rod(case));
    let flight = (history.events()[3].t, history.events()[4].t);
    let (length, c) = (0.5, history.scales().wave_speed);
    for share in [0.011, 0.3, 0.5, 0.77, 0.993] {
        let t = flight.0 + share * (flight.1 - flight.0);
        let (h, rate) = history.centre(&t).unwrap();
        // Simpson's rule over many points, as v has kinks.
        let n = 400;
        let value = |k: usize| history.field(&(length * k as f64 / n as f64), &t, Side::Right).unwrap();
        let weight = |k: usize| if k == 0 || k == n { 0.5 } else { 1.0 } / n as f64;
        let (mean, speed) = (0..=n).fold((0.0, 0.0), |(mean, speed), k| {
            let field = value(k);
            (mean + weight(k) * field.displacement, speed + weight(k) * field.velocity)
        });
        assert!((mean - h).abs() < 1e-6 * rate.abs().max(0.01) * length / c * 1e3, "{mean} {h}");
        assert!((speed - rate).abs() < 1e-4 * rate.abs().max(0.01), "{speed} {rate}");
        let end = history.ground_end(&t, Side::Right).unwrap();
        let field = history.field(&0.0, &t, Side::Right).unwrap();
        assert_eq!((end.0, end.1), (field.displacement, field.velocity));
        assert_eq!(history.strain(&t, Side::Right).unwrap(), 0.0);
        // The end moves as its velocity says.
        let dt = 1e-3 * length / c;
        let later = history.ground_end(&(t + dt), Side::Left).unwrap();
        assert!((later.0 - end.0 - 0.5 * dt * (end.1 + later.1)).abs() < 1e-3 * dt * end.1.abs().max(1e-3), "{share}");
    }
}

/// The march in forty digits, and that in doubles, of a rod that flies hundreds of round trips.
#[test]
fn longer_numbers_agree() {
    use rug::Float;
    let mut problem = rod(&reference("stiff_bounces")[1]);
    problem = problem.with_run(Run::Impacts(4)).unwrap();
    let double = damped::<f64>(&problem, &(), 13.0).unwrap();
    let long = damped::<Float>(&problem, &200, 40.0).unwrap();
    let longer = damped::<Float>(&problem, &300, 60.0).unwrap();
    assert_eq!(double.events().len(), long.events().len());
    for ((double, long), longer) in double.events().iter().zip(long.events()).zip(longer.events()) {
        let gap = Float::with_val(300, &long.t - &longer.t).abs().to_f64();
        assert!(gap <= long.t_error && long.t_error < 1e-30, "{gap:e} {:e}", long.t_error);
        assert!((double.t - long.t.to_f64()).abs() <= 1e-14 * double.t);
    }
}

/// Ever shorter hops at every second return of a ray: found, with their bound, as far as doubles tell them apart; then
/// said.
#[test]
fn hops_are_found_or_said() {
    let mut problem =
        Problem::uniform("1.1".parse().unwrap(), "2.3".parse().unwrap(), "0.8".parse().unwrap(), 20.into());
    problem = problem.to_builder().damping("0.35").run(Run::Time(40.into())).build().unwrap();
    let history = solve(&problem);
    let events = history.events();
    // 25 digits of the strip-by-strip march.
    for (kind, time) in [
        (EventKind::Release, 34.06779607991695),
        (EventKind::Impact, 34.067796128031155),
        (EventKind::Release, 35.98083960525844),
        (EventKind::Impact, 35.980839606315236),
        (EventKind::Release, 37.89388308455289),
        (EventKind::Impact, 37.89388308457664),
    ] {
        let found = events.iter().filter(|event| event.kind == kind).find(|event| (event.t - time).abs() < 1e-9);
        let off = (found.unwrap().t - time).abs();
        assert!(off < 1e-12 && off <= found.unwrap().t_error, "{found:?} {time}");
    }
    assert!(history.error_estimate() < 1e-8);
    // The pair at t = 39.80692656283, 5e-13 apart, is not resolved.
    let warnings = history.carried().warnings();
    let hops = |warning: &Warning| match warning {
        Warning::HopsUnresolved { from, longest, .. } => *from < 37.9 && *longest > 5e-13 && *longest < 1e-7,
        _ => false,
    };
    assert!(warnings.iter().any(hops), "{warnings:?}");
}

/// No stretch of the stress history is shorter than what its ends may be off, in the scenes that had such spikes.
#[test]
fn no_stress_piece_is_shorter_than_its_own_uncertainty() {
    for (length, damping, speed, gravity) in [
        ("1", "0.2", "2", "1"),
        ("1/2", "2.6", "1", "0"),
        ("1", "0.1", "3", "1"),
        ("1", "0.05", "1", "1"),
        ("1", "0.3", "7", "1"),
    ] {
        let number = |text: &str| text.parse::<Number>().unwrap();
        let mut problem = Problem::uniform(number(length), 1.into(), number(gravity), number(speed));
        problem = problem.to_builder().damping(number(damping)).run(Run::Impacts(6)).build().unwrap();
        let history = solve(&problem);
        let off = history.events().iter().map(|event| event.t_error).fold(0.0, f64::max);
        for piece in history.stress_pieces() {
            assert!(piece.end - piece.start > off.max(1e-13), "{damping} {speed}: {piece:?}");
        }
    }
}
