//! The first contact in enclosures: what is proved, to how many digits, and that it is the truth.
#![cfg(feature = "mp")]
#![allow(clippy::unwrap_used, clippy::panic)]

use dalembert::Problem;
use dalembert::certified::ProvedContact;
use dalembert::history::{Ending, History, Side};
use dalembert::number::{Interval, Number, Scalar};
use rug::ops::Pow;
use rug::{Integer, Rational};
use serde_json::Value;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// L, c, r, g, μ.
fn problem([length, wave_speed, damping, gravity, speed]: [&str; 5]) -> Problem {
    let mut problem = Problem::uniform(number(length), number(wave_speed), number(gravity), number(speed));
    problem.rod.damping = Some(number(damping)).filter(|r| !r.is_zero());
    problem
}

/// With as many bits as it takes.
fn solve(problem: &Problem, bits: u32) -> ProvedContact {
    let mut bits = bits;
    loop {
        if let Some(contact) = ProvedContact::solve(problem, bits).unwrap() {
            return contact;
        }
        bits *= 2;
        assert!(bits < 20_000, "undecided");
    }
}

fn cases() -> Vec<Value> {
    serde_json::from_str(include_str!("reference/first_contact.json")).unwrap()
}

fn power_of_ten(n: i32) -> Rational {
    let power = Rational::from(Integer::from(10).pow(n.unsigned_abs()));
    if n < 0 { power.recip() } else { power }
}

/// An enclosure that is narrower than `10^−digits`, relative to itself, or to `scale` where it holds zero, and that reaches
/// what the printed truth can be: `± 0.6` of its last digit. Zeros are printed as what was left of them.
fn check(what: &str, found: &Interval, truth: &Value, scale: f64, digits: i32) {
    let text = truth.as_str().unwrap();
    let value = number(text).to_rational();
    let (mantissa, exponent) = text.split_once('e').map_or((text, 0), |(m, e)| (m, e.parse().unwrap()));
    let places = mantissa.split_once('.').map(|(_, places)| places.len() as i32);
    let slack = places.map_or(Rational::new(), |n| power_of_ten(exponent - n) * Rational::from((6, 10)));
    let (lo, hi) = (found.lo().to_rational().unwrap(), found.hi().to_rational().unwrap());
    let gone = value.clone().abs() < power_of_ten(-45) && lo <= 0 && hi >= 0;
    let holds = lo <= Rational::from(&value + &slack) && hi >= Rational::from(&value - &slack);
    assert!(holds || gone, "{what}: {} is not {text}", found.text());
    let zero = lo <= 0 && hi >= 0;
    let size = if zero { Rational::from_f64(scale).unwrap() } else { value.abs() };
    let width = Rational::from(&hi - &lo) / size;
    assert!(width < power_of_ten(-digits), "{what}: relative width {}", width.to_f64());
}

fn proved(digits: i32, bits: u32) {
    for case in cases() {
        let name = case["name"].as_str().unwrap();
        let read = |key: &str| case[key].as_str().unwrap();
        let problem =
            problem([read("length"), read("wave_speed"), read("damping"), read("gravity"), read("impact_speed")]);
        let contact = solve(&problem, bits);
        let form = contact.form();
        let scales = contact.scales();
        let (time, speed) = (scales.time.to_f64(), scales.velocity.to_f64());
        let strain = speed / scales.wave_speed.to_f64();
        let at = |value: &Value| form.time(&number(value.as_str().unwrap()));
        for row in case["stress"].as_array().unwrap() {
            let stress = contact.stress(&at(&row[0]), Side::Right).unwrap();
            check(&format!("{name} stress"), &stress, &row[1], strain, digits);
        }
        for row in case["motion"].as_array().unwrap() {
            let (height, velocity) = contact.centre(&at(&row[0])).unwrap();
            check(&format!("{name} h"), &height, &row[1], speed * time, digits);
            check(&format!("{name} h′"), &velocity, &row[2], speed, digits);
        }
        for row in case["field"].as_array().unwrap() {
            let field = contact.field(&at(&row[0]), &at(&row[1]), Side::Right).unwrap();
            check(&format!("{name} v"), &field.displacement, &row[2], speed * time, digits);
            check(&format!("{name} v_t"), &field.velocity, &row[3], speed, digits);
            check(&format!("{name} v_x"), &field.strain, &row[4], strain, digits);
        }
        if case["bounce_time"].is_null() {
            assert!(matches!(contact.ending(), Ending::NoBounce(_)), "{name}: {:?}", contact.ending());
            continue;
        }
        let bounce = &contact.events()[1];
        check(&format!("{name} t_b"), &bounce.time, &case["bounce_time"], time, digits);
        check(&format!("{name} h(t_b)"), &bounce.centre, &case["bounce_h"], speed * time, digits);
        check(&format!("{name} h′(t_b)"), &bounce.centre_velocity, &case["bounce_h_rate"], speed, digits);
        let energy = contact.energy(&bounce.time).unwrap();
        let unit = speed * speed * scales.length.to_f64();
        let truth = &case["bounce_energy"];
        check(&format!("{name} E"), &energy.total, &truth["total"], unit, digits);
        check(&format!("{name} E_h"), &energy.translational, &truth["translational"], unit, digits);
        check(&format!("{name} E_z"), &energy.vibrational, &truth["vibrational"], unit, digits);
        let start = contact.energy(&form.time(&Number::from(0))).unwrap().translational;
        let squared = energy.translational / start;
        check(&format!("{name} e_E²"), &squared, &truth["restitution_energy_squared"], 1.0, digits);
    }
}

#[test]
fn fifty_digits_of_every_reference_value() {
    proved(50, 256);
}

/// `t_b/t₁` from 1000 digits on, in the three cases of Figure 1.
#[test]
fn a_thousand_digits_of_figure_one() {
    for (damping, near) in [("2.6", 1.788481033298875), ("2.9", 2.553022499313244), ("3.0", 3.299026051445772)] {
        let started = std::time::Instant::now();
        let contact = solve(&problem(["1/2", "1", damping, "0", "1"]), 3400);
        let time = &contact.events()[1].time;
        assert!((time.mid().to_f64() - near).abs() < 1e-14, "{damping}");
        let width = time.width();
        assert!(width.hi().to_rational().unwrap() < power_of_ten(-1001), "{damping}: {}", width.text());
        println!("r = {damping}: {:?}", started.elapsed());
    }
}

fn damped([damping, gravity, speed]: [&str; 3]) -> Problem {
    problem(["1/2", "1", damping, gravity, speed])
}

fn no_bounce(problem: &Problem) -> String {
    match solve(problem, 128).ending() {
        Ending::NoBounce(reason) => reason.clone(),
        other => panic!("{other:?}"),
    }
}

/// theory: g = 0, c = 1, t₁ = 1: a bounce exactly where r < π.
#[test]
fn bounce_or_none_on_both_sides_of_pi() {
    for damping in ["3.15", "3.3", "3.1415926535897932384626433832795028842"] {
        let reason = no_bounce(&damped([damping, "0", "1"]));
        assert!(reason.contains("overdamped"), "{reason}");
    }
    for (damping, truth) in [
        ("3.13", "11.66136670144388438415940577414071411946"),
        ("3.135", "15.33318837004014558549067344667885556140"),
        ("3.14", "31.40409847658940057227989202780933895332"),
    ] {
        let contact = solve(&damped([damping, "0", "1"]), 512);
        check(damping, &contact.events()[1].time, &Value::from(truth), 1.0, 50);
    }
}

/// `c = L = g = 1`, `r = 0.2`: at the threshold of (2.32) the bounce leaves `t₁`.
#[test]
fn both_sides_of_the_threshold() {
    let below = solve(&problem(["1", "1", "0.2", "1", "2.59364495455919430337818987448"]), 128);
    let (lattice, time) = (below.bounce().unwrap().1, &below.events()[1].time);
    assert_eq!(lattice, None);
    assert!(*time.lo() > 2 && *time.hi() < 2.00001, "{}", time.text());
    let above = solve(&problem(["1", "1", "0.2", "1", "2.59364495456119430337818987448"]), 128);
    assert_eq!(above.bounce().unwrap().1, Some(1));
    assert_eq!(above.events()[1].time.width().to_f64(), 0.0);
}

#[test]
fn the_least_and_the_greatest_damping() {
    // 1e-300: t_b is 2t₁ − μ/g but for 1e-300.
    for (damping, digits) in [("1e-9", 8), ("1e-300", 280)] {
        let contact = solve(&problem(["1", "1", damping, "1", "3/2"]), 1100);
        let off = contact.events()[1].time.clone() - contact.form().time(&number("5/2"));
        assert!(off.magnitude().hi().to_rational().unwrap() < power_of_ten(-digits), "{damping}: {}", off.text());
        assert!(contact.events()[1].time.radius() < 1e-250);
    }
    let contact = solve(&problem(["1", "1", "25", "1", "1"]), 256);
    assert!(matches!(contact.ending(), Ending::NoBounce(_)), "{:?}", contact.ending());
    let stress = contact.stress(&contact.form().time(&Number::from(3)), Side::Right).unwrap();
    assert!(stress.radius() < 1e-30, "{}", stress.text());
}
