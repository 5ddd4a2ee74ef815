//! Proved digits of undamped histories: fifty of every number of the reference, tangential landings by exact
//! arithmetic, and nothing where nothing can be proved.

use crate::common::{number, problem, reference};
use crate::stripped::undamped;
use dalembert::engine::{Motion, Undamped};
use dalembert::number::{IntervalPrecision, Scalar};
use dalembert::{Ending, EventKind, Interval, Problem, Reason, Run, Side};
use rug::{Float, Rational};
use serde_json::Value;
use std::cmp::Ordering;

const DIGITS: u32 = 50;

/// What the reference's decimal `text` stands for: itself, give or take one unit of its last digit.
fn meant(text: &Value) -> (Rational, Rational) {
    let value = number(text).to_rational();
    let text = text.as_str().unwrap();
    if text.contains('/') || !text.contains('.') {
        return (value.clone(), value);
    }
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let places = mantissa.split_once('.').map_or(0, |(_, after)| after.len() as i32);
    let unit = Rational::from((1, 10)).pow_signed(places - exponent.parse::<i32>().unwrap());
    (value.clone() - &unit, value + unit)
}

trait Power {
    fn pow_signed(self, n: i32) -> Self;
}

impl Power for Rational {
    fn pow_signed(self, n: i32) -> Self {
        use rug::ops::Pow;
        self.pow(n)
    }
}

/// The enclosure has `DIGITS` digits, of itself or, where that is zero, of `scale`; and what the reference says lies in
/// it.
fn proved(name: &str, ours: &Interval, theirs: &Value, scale: f64) {
    let size = Float::with_val(64, ours.mid().abs_ref()).to_f64().max(if ours.sign().is_err() { scale } else { 0.0 });
    assert!(ours.radius() <= size * 1e-50, "{name}: {ours:?}");
    let (low, high) = meant(theirs);
    assert!(*ours.hi() >= low && *ours.lo() <= high, "{name}: {ours:?} against {theirs}");
}

#[test]
fn fifty_digits_of_every_event_of_the_reference() {
    for case in reference("undamped_bounces") {
        let name = case["name"].as_str().unwrap();
        let expected: Vec<&Value> =
            case["events"].as_array().unwrap().iter().filter(|event| event["kind"] != "graze").collect();
        let last = number(&expected.last().unwrap()["time"]).to_f64();
        let problem = problem(&case, Run::Time((last + 1e-6).to_string().parse().unwrap()));
        let history = problem.certified(DIGITS).unwrap();
        let events = history.events();
        assert_eq!(events.len(), expected.len(), "{name}");
        let (speed, length) = (number(&case["impact_speed"]).to_f64(), number(&case["length"]).to_f64());
        for (event, truth) in events.iter().zip(expected) {
            let kind = if truth["kind"] == "impact" { EventKind::Impact } else { EventKind::Release };
            assert_eq!(event.kind, kind, "{name}");
            for (key, ours, scale) in [
                ("time", &event.t, 1.0),
                ("approach", &event.v_end, speed),
                ("h", &event.h, length),
                ("h_rate", &event.h_rate, speed),
            ] {
                if !truth[key].is_null() {
                    proved(&format!("{name}: {key} at {}", truth["time"]), ours, &truth[key], scale);
                }
            }
        }
    }
}

fn rod(speed: &str, time: &str) -> Problem {
    let mut problem = Problem::uniform(1.into(), 1.into(), 1.into(), speed.parse().unwrap());
    problem = problem.with_run(Run::Time(time.parse().unwrap())).unwrap();
    problem
}

/// μ = 1 lands at t = 31 with speed zero, after landings at 3 + √2, 7 + √3, …: no interval can tell that from a graze
/// or a flight over the ground, the exact number can. After t = 36 all is as before.
#[test]
fn a_tangential_landing_is_proved_by_exact_arithmetic() {
    let problem = rod("1", "80");
    let exact = IntervalPrecision::with_exact(192);
    let events = Undamped::<Interval>::solve(&problem, &exact).unwrap().events().to_vec();
    let touch = events.iter().find(|event| event.t.contains(&31.into())).unwrap();
    assert_eq!(touch.kind, EventKind::Impact);
    assert_eq!(touch.v_end.vanishes(), Ok(true));
    // One period later, and everything in between is the same again.
    let first: Vec<_> = events.iter().filter(|event| *event.t.hi() < 36).collect();
    for (before, after) in first.iter().zip(&events[first.len()..]) {
        let later = before.t.clone() + &before.t.int(36);
        assert_eq!(later.compare(&after.t), Ok(Ordering::Equal), "{later:?} {:?}", after.t);
        assert_eq!(before.h.compare(&after.h), Ok(Ordering::Equal));
    }
    assert_eq!(first.len(), 16);
    // Intervals alone leave it open, however many bits they have.
    for bits in [192, 1024] {
        let alone = IntervalPrecision::bits(bits);
        let history = Undamped::<Interval>::solve(&problem, &alone).unwrap();
        let end = history.end();
        let Ending::Undecided(Reason::Touch { spread, .. }) = history.ending() else { panic!("{}", history.ending()) };
        assert!(*end.hi() < 31.0, "{end:?}");
        // What is there holds, and what may come is the same but for the width of what is known.
        assert!(*spread > 0.0 && spread.log2() < 20.0 - f64::from(bits), "{spread:e}");
        for (ours, exact) in history.events().iter().zip(&events) {
            assert!(ours.t.meet(&exact.t).is_some() && ours.kind == exact.kind);
        }
    }
}

/// The steel bar's wave speed √(E/ρ) is no fraction; lattice times are still met exactly.
#[test]
fn irrational_wave_speeds_keep_their_coincidences() {
    let source = dalembert::builtin::get("siconos-impacting-bar").unwrap().source;
    let scene = dalembert::Scene::parse(source).unwrap();
    let history = scene.problem.certified(DIGITS).unwrap();
    let contact = history.contacts()[0].clone();
    let length = Float::with_val(400, 2);
    let t1 = length / (Float::with_val(400, 210e9) / 7800u32).sqrt();
    // After the touch at gap/μ = 5e-5/0.1.
    let t1 = t1 + Float::with_val(400, 1) / 2000;
    let to = contact.release.unwrap();
    assert!(*to.lo() <= t1 && *to.hi() >= t1 && to.radius() < 1e-50, "{to:?}");
}

/// Every enclosure of a run holds the rounded numbers of a run with more bits that knows nothing of intervals.
#[test]
fn digits_of_another_run_lie_inside() {
    for (speed, time) in [("3/2", "60"), ("0.7", "40"), ("1.9", "30"), ("12345.678", "24000")] {
        let problem = rod(speed, time);
        let float = undamped::<Float>(&problem, &700).unwrap();
        let history = problem.certified(40).unwrap();
        let mut proved: Vec<Interval> = history.events().iter().map(|event| event.t.clone()).collect();
        for k in 1..8i64 {
            let t = history.end().clone() * &history.end().ratio(k, 8);
            let (h, rate) = history.centre(t.clone()).unwrap();
            let (energy, end) =
                (history.energy(t.clone()).unwrap(), history.ground_end(t.clone(), Side::Right).unwrap().0);
            proved.extend([h, rate, energy.vibrational, end, history.strain(t, Side::Left).unwrap()]);
        }
        let mut rounded: Vec<Float> = float.events().iter().map(|event| event.t.clone()).collect();
        for k in 1..8u32 {
            let t = float.end() * k / 8u32;
            let (h, rate) = float.centre(&t).unwrap();
            let energy = float.energy(&t).unwrap();
            rounded.extend([h, rate, energy.vibrational, float.ground_end(&t, Side::Right).unwrap().0]);
            rounded.push(float.strain(&t, Side::Left).unwrap());
        }
        assert_eq!(proved.len(), rounded.len());
        for (k, (interval, x)) in proved.iter().zip(rounded).enumerate() {
            let inside = *interval.lo() <= x && *interval.hi() >= x;
            let off = Float::with_val(64, interval.mid() - &x).abs();
            assert!(inside || off <= interval.radius() + 1e-150, "μ = {speed}, number {k}: {interval:?} {x}");
        }
    }
}
