//! Times of up to sixty digits beside an event: each represents exactly the number that it spells.

use dalembert::chain::{Body, Chain, ChainColumn, End};
use dalembert::number::List;
use dalembert::quantity::Slice;
use dalembert::{Ending, Number, Numbers, Problem, Quantity, Scene, Side, Value};

fn problem(text: &str) -> Problem {
    Scene::parse(text).unwrap().problem
}

/// Returns `time` with its last digit raised by `units`.
fn moved(time: &str, units: i64) -> String {
    let point = time.find('.').unwrap();
    let digits: String = time.chars().filter(char::is_ascii_digit).collect();
    let mut digits: Vec<u8> = digits.bytes().map(|digit| digit - b'0').collect();
    let mut carry = units;
    for digit in digits.iter_mut().rev() {
        let sum = i64::from(*digit) + carry;
        (*digit, carry) = (sum.rem_euclid(10) as u8, sum.div_euclid(10));
    }
    let mut text: String = digits.into_iter().map(|digit| char::from(digit + b'0')).collect();
    text.insert(point, '.');
    text
}

/// Just before each event the rod is in the state that the event ends, and just after it in the one that it begins; the
/// end that lands has fallen as far as its speed says.
#[test]
fn times_beside_events_are_told_apart() {
    let mut compared = 0;
    for scene in [
        "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.1\n[impact]\nspeed = 3\n[gravity]\nacceleration = 1\n",
        "[rod]\nlength = 1.1483\nwave_speed = 1.8219\ndamping = 0.0765\n[impact]\nspeed = 0.887\n\
         [gravity]\nacceleration = 2.324\n",
        "[rod]\nlength = \"4/3\"\nwave_speed = 1.7\n[impact]\nspeed = 0.9\n[gravity]\nacceleration = 0.8\n",
    ] {
        let problem = problem(&format!("{scene}[run]\nimpacts = 3\n"));
        let exact = problem.solve_in(Numbers::Digits(120)).unwrap();
        for numbers in [Numbers::default(), Numbers::Digits(12), Numbers::Certified(15)] {
            let history = problem.solve_in(numbers).unwrap();
            for event in &exact.events().unwrap()[1..] {
                for places in [28, 44] {
                    let time = event.t.to_digits(places);
                    for (units, before) in [(-2i64, true), (2, false)] {
                        let time = moved(&time, units);
                        let ask = |of: &dalembert::History, quantity| -> Value {
                            of.at_time(quantity, time.parse::<Number>().unwrap(), Side::Right).unwrap()
                        };
                        let lands = event.kind == dalembert::EventKind::Impact;
                        let contact = ask(&history, Quantity::Contact);
                        assert_eq!(contact.to_f64() == 1.0, lands != before, "{scene} {numbers} {time} {contact:?}");
                        for quantity in [Quantity::EndDisplacement, Quantity::EndVelocity, Quantity::Strain] {
                            let (ours, truth) = (ask(&history, quantity), ask(&exact, quantity));
                            let off = (ours.to_f64() - truth.to_f64()).abs();
                            let bound = ours.bound().to_f64() + truth.bound().to_f64();
                            assert!(off <= bound, "{scene} {numbers} {time} {quantity}: {ours:?} {truth:?}");
                            compared += 1;
                        }
                        if lands && before {
                            let height = ask(&history, Quantity::EndDisplacement).to_f64();
                            let fall = -event.v_end.to_f64() * 10f64.powi(1 - places as i32);
                            assert!(height > fall && height < 60.0 * fall, "{scene} {time}: {height:e} {fall:e}");
                        }
                    }
                }
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

/// A ray of the second impact passes points at the times at which runs end; on either side of it the rod has the
/// velocity and the strain that fractions give.
#[test]
fn points_on_a_ray_at_the_end_of_a_run() {
    let scene = include_str!("../../src/scene/builtin/doyen-ern-piperno.toml");
    let (mut compared, mut jumps) = (0, 0);
    // x = 30 (t − 8/3), going up, and x = 10 − 30 (t − 3), coming back.
    for (point, time) in
        [("10/3", "25/9"), ("80/9", "80/27"), ("550/61", "185/61"), ("10/7", "19/7"), ("70/9", "83/27")]
    {
        let [points, times] = [point, time].map(|x| List::Numbers(vec![x.parse().unwrap()]));
        let problem = problem(&scene.replace("impacts = 6", &format!("time = \"{time}\"")));
        let ask = |numbers: Numbers, side: Side| {
            let history = problem.solve_in(numbers).unwrap();
            history.sample_field(Slice::Points, &(&points).into(), &(&times).into(), Some(side)).unwrap()
        };
        let sides = [Side::Left, Side::Right].map(|side| (side, ask(Numbers::Exact, side)));
        jumps += usize::from(sides[0].1[4][0].to_f64() != sides[1].1[4][0].to_f64());
        for numbers in [Numbers::default(), Numbers::Digits(20), Numbers::Digits(40), Numbers::Certified(15)] {
            for (side, truth) in &sides {
                for (ours, truth) in ask(numbers, *side)[3..].iter().zip(&truth[3..]) {
                    let (ours, truth) = (&ours[0], &truth[0]);
                    let off = (ours.to_f64() - truth.to_f64()).abs();
                    let bound = ours.bound().to_f64() + 4.0 * f64::EPSILON * truth.to_f64().abs();
                    assert!(off <= bound && bound < 1e-9, "{point} {time} {side} {numbers}: {ours:?} {truth:?}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared == 120 && jumps >= 4, "{compared} {jumps}");
}

/// A bar falls from 1/2 with the speed 1 under gravity 1 and lands at √2 − 1: times of up to sixty digits beside that
/// are before or after it.
#[test]
fn times_beside_an_impact_of_a_chain_are_told_apart() {
    let bar = Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
    let ground = End::Ground { gap: "1/2".parse().unwrap(), velocity: Vec::new() };
    let chain = Chain::builder(bar).bottom(ground).gravity(1.into()).until(2.into()).build().unwrap();
    let root = "0.414213562373095048801688724209698078569671875376948073176679737990732478462107";
    let force = ChainColumn::read("force.bottom", &chain).unwrap();
    for numbers in [Numbers::default(), Numbers::Double(Some(1e-13)), Numbers::Digits(20)] {
        let history = chain.solve(numbers).unwrap();
        for digits in [20, 36, 38, 40, 50, 60] {
            for (units, pressed) in [(-1, false), (2, true)] {
                let time = moved(&root[..2 + digits], units).parse().unwrap();
                let found = history.value(force, &time, Side::Right).unwrap();
                // Z times the speed √2 of the end.
                let truth = if pressed { std::f64::consts::SQRT_2 } else { 0.0 };
                let off = (found.to_f64() - truth).abs();
                assert!(off <= found.bound().to_f64() + 4e-16 && off < 1e-9, "{numbers} {digits} {units}: {found:?}");
            }
        }
    }
}

/// An exact history ends before an irrational impact, also where gravity is so weak that its time is the difference of
/// two numbers that almost agree.
#[test]
fn exactness_ends_before_an_impact_under_weak_gravity() {
    for gravity in ["1e-3", "1e-10", "1e-18", "1e-30"] {
        // gap = v t + g t²/2.
        let (gap, g): (f64, f64) = (1.0 / 3.0, gravity.parse().unwrap());
        let truth = 2.0 * gap / (1.0 + (1.0 + 2.0 * g * gap).sqrt());
        let check = |ending: &Ending, end: f64, left: f64| {
            let Ending::ExactnessEnds { near, .. } = ending else { panic!("{gravity}: {ending:?}") };
            assert!((near - truth).abs() <= 2e-16, "{gravity}: {near} {truth}");
            assert!(end <= truth && end > truth - 1e-5 && left >= 0.0, "{gravity}: {end} {truth} {left:e}");
        };
        let bar = Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
        let ground = End::Ground { gap: "1/3".parse().unwrap(), velocity: Vec::new() };
        let chain = Chain::builder(bar).bottom(ground).gravity(gravity.parse().unwrap()).until(3.into());
        let chain = chain.build().unwrap();
        let history = chain.solve(Numbers::Exact).unwrap();
        let end = &history.listing().unwrap().end;
        let column = ChainColumn::read("gap.bottom", &chain).unwrap();
        let last = history.value(column, &end.to_string().parse().unwrap(), Side::Left).unwrap();
        check(&history.ending().unwrap(), end.to_f64(), last.to_f64());
        // A rod is refused where its speed is more than 1e12 times that which gravity gives it in a round trip.
        if g < 1e-12 {
            continue;
        }
        let rod = Problem::builder().length(1).wave_speed(1).gravity(gravity).impact_speed(1).gap("1/3").time(3);
        let history = rod.build().unwrap().exact().unwrap();
        let left = history.ground_end(history.end().clone(), Side::Left).unwrap().0.to_f64();
        check(history.ending(), history.end().to_f64(), left);
    }
}
