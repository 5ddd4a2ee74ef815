//! The first contact in enclosures: what is proved, to how many digits, and that it is the truth.

use dalembert::engine::{Bounce, ContactHistory, FirstContact, Motion};
use dalembert::number::{Answer, IntervalPrecision, Scalar};
use dalembert::reason::NoBounceReason;
use dalembert::{Ending, Energy, Error, Interval, Number, Parameters, Problem, Reason, Side};
use dalembert_verify::modal::Modal;
use proptest::prelude::*;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use serde_json::Value;
use std::str::FromStr;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// L, c, r, g, μ.
fn problem([length, wave_speed, damping, gravity, speed]: [&str; 5]) -> Problem {
    let mut problem = Problem::uniform(number(length), number(wave_speed), number(gravity), number(speed));
    problem = problem.to_builder().damping(number(damping)).build().unwrap();
    problem
}

/// With as many bits as it takes.
fn solve(problem: &Problem, bits: u32) -> ContactHistory<Interval> {
    let mut bits = bits;
    loop {
        match ContactHistory::solve(problem, &IntervalPrecision::with_exact(bits)) {
            Err(Error::NotDecided { .. }) => bits *= 2,
            contact => return contact.unwrap(),
        }
        assert!(bits < 20_000, "undecided");
    }
}

/// A time or a point as a person wrote it, with as many bits as the history.
fn exactly(contact: &ContactHistory<Interval>, number: &Number) -> Interval {
    Interval::from_number(number, &IntervalPrecision::with_exact(contact.end().lo().prec()))
}

fn cases() -> Vec<Value> {
    serde_json::from_str(include_str!("../reference/first_contact.json")).unwrap()
}

fn power_of_ten(n: i32) -> Rational {
    let power = Rational::from(Integer::from(10).pow(n.unsigned_abs()));
    if n < 0 { power.recip() } else { power }
}

/// An enclosure that is narrower than `10^−digits`, relative to itself, or to `scale` where it holds zero, and that
/// reaches what the printed truth can be: `± 0.6` of its last digit. Zeros are printed as what was left of them.
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
        let scales = contact.scales();
        let (time, speed) = (scales.time.to_f64(), scales.velocity.to_f64());
        let strain = speed / scales.wave_speed.to_f64();
        let at = |value: &Value| exactly(&contact, &number(value.as_str().unwrap()));
        for row in case["stress"].as_array().unwrap() {
            let stress = contact.strain(&at(&row[0]), Side::Right).unwrap();
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
        check(&format!("{name} t_b"), &bounce.t, &case["bounce_time"], time, digits);
        check(&format!("{name} h(t_b)"), &bounce.h, &case["bounce_h"], speed * time, digits);
        check(&format!("{name} h′(t_b)"), &bounce.h_rate, &case["bounce_h_rate"], speed, digits);
        let energy = contact.energy(&bounce.t).unwrap();
        let unit = speed * speed * scales.length.to_f64();
        let truth = &case["bounce_energy"];
        check(&format!("{name} E"), &energy.total, &truth["total"], unit, digits);
        check(&format!("{name} E_h"), &energy.translational, &truth["translational"], unit, digits);
        check(&format!("{name} E_z"), &energy.vibrational, &truth["vibrational"], unit, digits);
        let start = contact.energy(&exactly(&contact, &Number::from(0))).unwrap().translational;
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
        let time = &contact.events()[1].t;
        assert!((time.mid().to_f64() - near).abs() < 1e-14, "{damping}");
        let width = time.width();
        assert!(width.hi().to_rational().unwrap() < power_of_ten(-1001), "{damping}: {}", width.text());
        println!("r = {damping}: {:?}", started.elapsed());
    }
}

fn damped([damping, gravity, speed]: [&str; 3]) -> Problem {
    problem(["1/2", "1", damping, gravity, speed])
}

fn no_bounce(problem: &Problem) -> NoBounceReason {
    match solve(problem, 128).ending() {
        Ending::NoBounce(Reason::NoBounce(reason)) => reason.clone(),
        other => panic!("{other:?}"),
    }
}

/// theory: g = 0, c = 1, t₁ = 1: a bounce exactly where r < π.
#[test]
fn bounce_or_none_on_both_sides_of_pi() {
    for damping in ["3.15", "3.3", "3.1415926535897932384626433832795028842"] {
        let reason = no_bounce(&damped([damping, "0", "1"]));
        assert!(matches!(reason, NoBounceReason::Overdamped { .. }), "{reason}");
    }
    // With gravity the static stress wins, however near to π.
    let reason = no_bounce(&damped(["3.14159265358979323846264338327950288419716939937510", "1", "1"]));
    assert!(matches!(reason, NoBounceReason::SettlesUnderWeight { .. }), "{reason}");
    for (damping, truth) in [
        ("3.13", "11.66136670144388438415940577414071411946"),
        ("3.135", "15.33318837004014558549067344667885556140"),
        ("3.14", "31.40409847658940057227989202780933895332"),
    ] {
        let contact = solve(&damped([damping, "0", "1"]), 512);
        check(damping, &contact.events()[1].t, &Value::from(truth), 1.0, 50);
    }
}

/// `c = L = g = 1`, `r = 0.2`: at the threshold of (2.32) the bounce leaves `t₁`.
#[test]
fn both_sides_of_the_threshold() {
    let below = solve(&problem(["1", "1", "0.2", "1", "2.59364495455919430337818987448"]), 128);
    let (lattice, time) = (below.bounce().unwrap().1, &below.events()[1].t);
    assert_eq!(lattice, None);
    assert!(*time.lo() > 2 && *time.hi() < 2.00001, "{}", time.text());
    let above = solve(&problem(["1", "1", "0.2", "1", "2.59364495456119430337818987448"]), 128);
    assert_eq!(above.bounce().unwrap().1, Some(1));
    assert_eq!(above.events()[1].t.width().to_f64(), 0.0);
}

#[test]
fn the_least_and_the_greatest_damping() {
    // 1e-300: t_b is 2t₁ − μ/g but for 1e-300.
    for (damping, digits) in [("1e-9", 8), ("1e-300", 280)] {
        let contact = solve(&problem(["1", "1", damping, "1", "3/2"]), 1100);
        let off = contact.events()[1].t.clone() - exactly(&contact, &number("5/2"));
        assert!(off.magnitude().hi().to_rational().unwrap() < power_of_ten(-digits), "{damping}: {}", off.text());
        assert!(contact.events()[1].t.radius() < 1e-250);
    }
    let contact = solve(&problem(["1", "1", "25", "1", "1"]), 256);
    assert!(matches!(contact.ending(), Ending::NoBounce(_)), "{:?}", contact.ending());
    let stress = contact.strain(&exactly(&contact, &Number::from(3)), Side::Right).unwrap();
    assert!(stress.radius() < 1e-30, "{}", stress.text());
}

fn holds(found: &Interval, truth: &Float, slack: f64) -> bool {
    let slack = truth.clone().abs() * slack + 1e-300;
    Float::with_val(2000, found.lo() - truth) <= slack && Float::with_val(2000, truth - found.hi()) <= slack
}

/// Every value that can be asked for, at some times of the contact and at its end.
fn everything(contact: &ContactHistory<Interval>, times: &[&str]) -> Vec<Interval> {
    let mut times: Vec<Interval> = times.iter().map(|t| exactly(contact, &number(t))).collect();
    times.retain(|t| t.hi() < contact.end().lo());
    times.push(contact.end());
    let mut list = vec![contact.contacts()[0].impulse.clone(), contact.contacts()[0].peak_strain.clone()];
    for event in contact.events() {
        list.extend([event.t.clone(), event.v_end.clone(), event.h.clone()]);
        list.push(event.h_rate.clone());
    }
    for t in &times {
        for side in [Side::Left, Side::Right] {
            list.push(contact.strain(t, side).unwrap());
            let field = contact.field(&exactly(contact, &number("0.3")), t, side).unwrap();
            list.extend([field.displacement, field.velocity, field.strain]);
            let (top, speed) = contact.top_end(t, side).unwrap();
            list.extend([top, speed]);
        }
        let energy = contact.energy(t).unwrap();
        list.extend([energy.total, energy.translational, energy.vibrational]);
    }
    list
}

const CASES: [[&str; 5]; 10] = [
    ["1", "1", "0", "1", "3"],
    ["1", "1", "0", "1", "3/2"],
    ["1", "1", "0.2", "1", "5"],
    ["1", "1", "0.3", "1", "2"],
    ["1/3", "0.7", "0.1", "2", "1/7"],
    ["1/2", "1", "3", "0", "1"],
    ["1", "1", "1", "1", "1"],
    ["1", "1", "2.5", "1", "1/4"],
    ["1", "1", "25", "1", "1"],
    ["1", "5000", "12", "9.81", "1"],
];

/// More bits only narrow what fewer bits have said.
#[test]
fn more_bits_lie_within_fewer() {
    // The energy at R = 50 alone would take longer than all the rest.
    for case in CASES.into_iter().filter(|case| case[2] != "25") {
        let times = ["2/3", "2"];
        let few = everything(&solve(&problem(case), 200), &times);
        let many = everything(&solve(&problem(case), 400), &times);
        assert_eq!(few.len(), many.len(), "{case:?}");
        for (k, (few, many)) in few.iter().zip(&many).enumerate() {
            assert!(few.meet(many).is_some(), "{case:?} {k}: {} {}", few.text(), many.text());
            let narrow = many.radius() <= few.radius() && many.radius() <= few.mid().abs() * 1e-60 + 1e-60;
            assert!(narrow, "{case:?} {k}: {} {}", few.text(), many.text());
        }
    }
}

/// The same closed forms in ordinary numbers of many more bits lie inside.
#[test]
fn ordinary_numbers_lie_inside() {
    for case in CASES {
        let proved = solve(&problem(case), 200);
        let rod = Parameters::<Float>::of(&problem(case), &500).unwrap();
        let contact = FirstContact::new(&rod.carry());
        match contact.bounce() {
            Bounce::At { time, .. } => assert!(holds(&proved.events()[1].t, time.value(), 1e-120), "{case:?}"),
            Bounce::Never(_) => assert!(proved.bounce().is_none(), "{case:?}"),
            Bounce::Undecided { why, .. } => panic!("{case:?}: {why}"),
        }
        let stress = |time: &Float, side| contact.strain(&time.carry(), side).into_value();
        let mut deepest = stress(&Float::with_val(500, 0), Side::Right);
        let end = proved.end().mid();
        for k in 1..200u32 {
            let time = Float::with_val(500, &end * k) / 200u32;
            let stress = stress(&time, Side::Left);
            if k % 20 == 1 {
                let at = exactly(&proved, &Number::from(0)) + Interval::between(time.clone(), time.clone());
                assert!(holds(&proved.strain(&at, Side::Left).unwrap(), &stress, 1e-120), "{case:?}");
                let (height, velocity) = proved.centre(&at).unwrap();
                assert!(holds(&height, contact.centre(&time.carry()).0.value(), 1e-120), "{case:?}");
                assert!(holds(&velocity, contact.centre(&time.carry()).1.value(), 1e-120), "{case:?}");
            }
            if stress < deepest {
                deepest = stress;
            }
        }
        let peak = &proved.contacts()[0].peak_strain;
        assert!(*peak.lo() <= deepest, "{case:?}: {} {deepest}", peak.text());
        assert!(Float::with_val(200, peak.hi() - &deepest) < 0.02 * deepest.clone().abs(), "{case:?}: {}", peak.text());
        assert!(peak.radius() < 1e-50, "{case:?}: {}", peak.text());
    }
}

/// Values on both sides of a ray differ by the jump that it carries, and the wrong bits never decide on which side it
/// is.
#[test]
fn times_on_rays_are_told_from_times_beside_them() {
    // t₁ = 20/21, and a ray is at x = 1/6 at t = 5/21 + k t₁.
    let contact = solve(&problem(["1/3", "0.7", "0.1", "2", "1/7"]), 256);
    let form = contact.form();
    let point = exactly(&contact, &number("1/6"));
    let at = |time: &str, side| form.field(&point, &exactly(&contact, &number(time)), side);
    for time in ["5/21", "15/21"] {
        let (before, after) = (at(time, Side::Left), at(time, Side::Right));
        let jump = after.velocity.clone() - &before.velocity;
        assert!(jump.magnitude().mid() > 0.1, "{}", jump.text());
        // 10⁻¹⁰⁰ beside the ray, where 256 bits do not tell, but the fractions do.
        let zeros = "0".repeat(100);
        let ray = time.trim_end_matches("/21");
        let beside = |sign: &str| {
            let numerator = Integer::from_str(&format!("{ray}{zeros}")).unwrap();
            let numerator = if sign == "-" { numerator - 21 } else { numerator + 21 };
            form.field(&point, &exactly(&contact, &number(&format!("{numerator}/21{zeros}"))), Side::Right)
        };
        assert!(beside("-").velocity.meet(&before.velocity).is_some());
        assert!(beside("+").velocity.meet(&after.velocity).is_some());
    }
    let continuous = at("6/21", Side::Right).velocity - &at("6/21", Side::Left).velocity;
    assert!(continuous.contains(&Rational::new()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// The modes, another route to (2.28) with proved bounds of its own, agree.
    #[test]
    fn modes_agree(r in 0u32..400, g in 0u32..30, mu in 1u32..40, t in 1u32..390) {
        let texts = [r, g, mu, t].map(|n| format!("{n}/100"));
        let problem = problem(["1/2", "1", &texts[0], &format!("{g}/10"), &format!("{mu}/10")]);
        let precision = IntervalPrecision::with_exact(192);
        let form = FirstContact::new(&Parameters::<Interval>::of(&problem, &precision).unwrap());
        let proved = form.strain(&Interval::from_number(&number(&texts[3]), &precision), Side::Right);
        let rod = Parameters::<Float>::of(&problem, &192).unwrap();
        let time = Float::with_val(192, &number(&texts[3]).to_rational());
        let modes = Modal::new(&rod, 256).strain(&time, Side::Right);
        let off = (modes.value().clone() - proved.mid()).abs();
        prop_assert!(off <= modes.bound() * (1.0 + 1e-9) + proved.radius(), "{modes:?} {}", proved.text());
    }
}

/// Between its points, too, the stress lies where its pieces say.
/// Halfway through a round trip the ray is at the top, and rounding does not say from which side: energies are narrow.
#[test]
fn energies_where_a_ray_turns_at_the_top() {
    let contact = solve(&problem(["1", "5000", "12", "9.81", "1"]), 100);
    let half = exactly(&contact, &number("0.0002"));
    for time in [half.clone(), half.clone().widened(&half.roundoff())] {
        let Energy { total, vibrational, .. } = contact.energy(&time).unwrap();
        for energy in [&total, &vibrational] {
            let width = Float::with_val(53, energy.hi() - energy.lo()).to_f64();
            assert!(width < 1e-20, "{energy:?}");
        }
        // E(0) = ½, of which damping has taken 2r ∫∫ v_t² ≤ 2r t · 2 E.
        assert!(total.hi().to_f64() < 0.5 && total.lo().to_f64() > 0.5 - 2.0 * 12.0 * 2e-4);
    }
}

#[test]
fn pieces_hold_the_stress() {
    for case in [CASES[2], CASES[3], CASES[5], CASES[7]] {
        let contact = solve(&problem(case), 160);
        let pieces = contact.stress_pieces();
        assert_eq!(*pieces[0].start.hi(), 0);
        assert!(pieces.last().unwrap().end.meet(&contact.end()).is_some());
        for piece in pieces.iter().take(3) {
            for part in [1, 4, 9] {
                let x = piece.start.ratio(part, 5) - piece.start.one();
                let time = (piece.end.clone() - &piece.start) * &piece.start.ratio(part, 10) + &piece.start;
                let (mut before, mut value) = (piece.start.zero(), piece.start.zero());
                for c in piece.chebyshev.iter().skip(1).rev() {
                    let next = x.clone() * &x.int(2) * &value - &before + c;
                    before = std::mem::replace(&mut value, next);
                }
                let sum = piece.chebyshev[0].clone() + &(x * &value) - &before;
                let direct = contact.strain(&time, Side::Right).unwrap();
                assert!(sum.meet(&direct).is_some(), "{case:?}: {} {}", sum.text(), direct.text());
                assert!(piece.chebyshev.iter().all(|c| c.radius() < 1e-40), "{case:?}");
            }
        }
    }
}

/// What `--certified` prints: digits for every number of the record, with restitution and flight.
#[test]
fn every_number_has_its_proved_digits() {
    let history = problem(["1", "1", "0.3", "1", "2"]).certified(100).unwrap();
    let (time, e) = (history.contacts()[0].release.clone().unwrap(), history.restitution(0).unwrap());
    check("t_b", &time, &Value::from("3.97277918129047974002999995477923813872379549"), 1.0, 100);
    check("e_P", &e.e_p.unwrap(), &Value::from("-0.28693309509651477688219222890632650211"), 1.0, 100);
}
