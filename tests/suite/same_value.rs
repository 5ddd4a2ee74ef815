//! A value is the same whether it is asked alone or with others, in any order, and in every number system: on rays, at
//! events and at ordinary times, from both sides, of random rods with and without damping.

use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::solve::{Rung, Target};
use dalembert::{
    Error, Float, Interval, Number, Numbers, Plan, Problem, Question, Rational, Run, Side, Top, TypedHistory,
};
use proptest::prelude::*;
use std::sync::Arc;

use crate::common::compares;

/// A rod in small fractions, so that rays, events and breaks of the start often meet; `R` between 1/50 and 3. The part
/// `strained` of them starts bent.
fn scene(damped: bool, strained: f64) -> impl Strategy<Value = Problem> {
    let rod = ((1i64..=6, 1i64..=5), (1i64..=6, 1i64..=5), any::<bool>());
    let motion = ((1i64..=12, 1i64..=4), prop::option::weighted(0.8, 1i64..=5), (0.0f64..1.0, -3i64..=3));
    (rod, motion, 1i64..=150).prop_map(move |((length, c, fixed), (speed, gravity, (part, bend)), tenths)| {
        let number = |(p, q): (i64, i64)| format!("{p}/{q}").parse::<Number>().unwrap();
        let mut rod = Problem::builder().length(number(length)).wave_speed(number(c));
        if damped {
            // R = r 2L/c.
            rod = rod.damping(number((tenths * c.0 * length.1, 100 * c.1 * length.0)));
        }
        if let Some(g) = gravity {
            rod = rod.gravity(number((g, 2)));
        }
        if fixed {
            rod = rod.top(dalembert::Top::Fixed);
        }
        let rod = match (part < strained).then_some(bend) {
            // Bent in its middle, and let go there with a jump of the velocity.
            Some(bend) => {
                let at = |part: i64| number((part * length.0, 3 * length.1));
                let top = if fixed { 0 } else { -1 };
                let velocity = [(at(0), -1), (at(1), -1), (at(1), bend), (at(3), top)];
                rod.displacement([(at(0), number((0, 1))), (at(1), number((bend, 9))), (at(3), number((1, 9)))])
                    .velocity(velocity.map(|(x, v)| (x, number((v, 1)))))
            }
            None => rod.impact_speed(number(speed)),
        };
        let trips = number((7 * length.0 * c.1, length.1 * c.0));
        rod.time(trips).build().unwrap()
    })
}

/// The engine of the plan, in the first numbers that settle the order of events.
fn run<S: Target>(problem: &Problem, question: &Question) -> Option<Arc<dyn Motion<S::Carried>>> {
    let plan = Plan::of(problem, question).ok()?;
    for rung in [plan.rung, Rung::Bits(192), Rung::Bits(512)] {
        let rung = match (plan.rung, rung) {
            (Rung::Enclosures(_), Rung::Bits(bits)) => Rung::Enclosures(bits),
            _ => rung,
        };
        match S::run(problem, &plan, rung, &(Arc::new(dalembert::engine::unobserved) as dalembert::Observer)) {
            Err(Error::Open(_) | Error::NotDecided { .. }) => (),
            Err(Error::TooManyPieces { .. }) => return None,
            found => return Some(found.unwrap()),
        }
    }
    None
}

type Values<S> = Vec<(&'static str, S)>;

/// Every quantity at `time` from `side`.
fn values<S: Scalar>(motion: &dyn Motion<S>, time: &S, side: Side) -> Result<Values<S>, Error> {
    let third = motion.scales().length / time.int(3);
    let ((v, v_t), (top, top_t)) = (motion.ground_end(time, side)?, motion.top_end(time, side)?);
    let ((h, rate), energy, field) = (motion.centre(time)?, motion.energy(time)?, motion.field(&third, time, side)?);
    Ok(vec![
        ("v_x(0,t)", motion.strain(time, side)?),
        ("v(0,t)", v),
        ("v_t(0,t)", v_t),
        ("v(L,t)", top),
        ("v_t(L,t)", top_t),
        ("h", h),
        ("h′", rate),
        ("E", energy.total),
        ("E_h", energy.translational),
        ("E_z", energy.vibrational),
        ("v(L/3,t)", field.displacement),
        ("v_t(L/3,t)", field.velocity),
        ("v_x(L/3,t)", field.strain),
    ])
}

/// Whether two accounts agree within the bounds of both and the rounding to doubles in which they are compared.
fn same<A: Scalar, B: Scalar>(what: &str, ours: &Values<A>, truth: &Values<B>) -> Result<usize, TestCaseError> {
    for ((name, a), (_, b)) in ours.iter().zip(truth) {
        // An enclosure is read as its farther end; a logarithm is a double.
        let bound = (a.log2_error().exp2().max(a.width().to_f64()) + b.log2_error().exp2()) * (1.0 + 1e-12);
        let (a, b) = (a.to_f64(), b.to_f64());
        let rounding = 2.0 * f64::EPSILON * a.abs().max(b.abs());
        prop_assert!((a - b).abs() <= bound + rounding, "{} {}: {:e} {:e} ± {:e}", what, name, a, b, bound);
    }
    Ok(ours.len())
}

/// In `numbers`: as part of the whole run, and asked alone, against the `truth`. A time that either history does not
/// reach, and a run that these numbers refuse, compares nothing.
fn in_numbers<S: Target, T: Scalar>(
    problem: &Problem,
    numbers: Numbers,
    times: &[Number],
    truth: &dyn Motion<T>,
) -> Result<usize, TestCaseError> {
    let Some(whole) = run::<S>(problem, &Question::run(numbers)) else { return Ok(0) };
    let mut compared = 0;
    let precision = whole.end().precision();
    for (k, time) in times.iter().enumerate() {
        let exact = T::from_number(time, &truth.end().precision());
        let lifted = S::Carried::from_number(time, &precision);
        // Two rays and an ordinary time.
        let alone = || run::<S>(problem, &Question::between(time.clone(), time.clone(), numbers));
        let alone = if k % 3 == 2 { alone() } else { None };
        for side in [Side::Left, Side::Right] {
            let Ok(truth) = values(truth, &exact, side) else { continue };
            let place = format!("{numbers} {side:?} of {time}");
            if let Ok(ours) = values(&*whole, &lifted, side) {
                compared += same(&place, &ours, &truth)?;
            }
            if let Some(alone) = &alone
                && let Ok(ours) = values(&**alone, &S::Carried::from_number(time, &alone.end().precision()), side)
            {
                compared += same(&format!("{place}, alone"), &ours, &truth)?;
            }
        }
    }
    // As many events before either history ends, and as many in all where they end alike.
    let known = whole.end().to_f64().min(truth.end().to_f64()) * (1.0 - 1e-9);
    let before = |time: f64| time < known;
    let ours = whole.events().iter().filter(|event| before(event.t.to_f64())).count();
    let exact = truth.events().iter().filter(|event| before(event.t.to_f64())).count();
    prop_assert_eq!(ours, exact, "{}: events before {}", numbers, known);
    if whole.ending() == truth.ending() {
        prop_assert_eq!(whole.events().len(), truth.events().len(), "{}", numbers);
    }
    // At each event by the time that this history has for it.
    for (ours, exact) in whole.events().iter().zip(truth.events()) {
        prop_assert_eq!(ours.kind, exact.kind, "{}: {:?} {:?}", numbers, ours, exact);
        for side in [Side::Left, Side::Right] {
            let (Ok(found), Ok(truth)) = (values(&*whole, &ours.t, side), values(truth, &exact.t, side)) else {
                continue;
            };
            compared += same(&format!("{numbers} {side:?} of event {ours:?}"), &found, &truth)?;
        }
    }
    Ok(compared)
}

/// Times on rays of the start, half-way between them, and of no note.
fn times(problem: &Problem) -> Vec<Number> {
    let rod = (&problem.length().to_rational(), problem.material());
    let dalembert::Material::WaveSpeed(c) = rod.1 else { panic!("a wave speed is given") };
    let half_trip = rod.0.clone() / c.to_rational();
    let number = |x: Rational| x.to_string().parse::<Number>().unwrap();
    let rays = [0i64, 1, 2, 3, 4, 6].map(|k| number(half_trip.clone() * k));
    rays.into_iter()
        .chain([(1i64, 2i64), (7, 3), (4, 3), (19, 7)].map(|k| number(half_trip.clone() * k.0 / k.1)))
        .collect()
}

/// Asked in one order and in the other, each time of a history of its own: settled to the same digits, on rays at times
/// that no double holds, too, although a question before may have called for longer numbers.
fn in_any_order(problem: &Problem, times: &[Number]) -> Result<usize, TestCaseError> {
    let ask = |history: &TypedHistory<f64>, time: &Number| -> Vec<f64> {
        let t = time.to_f64();
        let sides = [Side::Left, Side::Right].map(|side| {
            let ((v, v_t), (top, top_t)) = (history.ground_end(t, side)?, history.top_end(t, side)?);
            Ok::<_, Error>([history.strain(t, side)?, v, v_t, top, top_t])
        });
        let (Ok((h, rate)), Ok(energy)) = (history.centre(t), history.energy(t)) else { return Vec::new() };
        sides.into_iter().flatten().flatten().chain([h, rate, energy.total, energy.vibrational]).collect()
    };
    let Ok(history) = problem.doubles() else { return Ok(0) };
    let mut compared = 0;
    let forward: Vec<_> = times.iter().map(|time| ask(&history, time)).collect();
    let again = problem.doubles().unwrap();
    let mut backward: Vec<_> = times.iter().rev().map(|time| ask(&again, time)).collect();
    backward.reverse();
    for ((time, a), b) in times.iter().zip(forward).zip(backward) {
        prop_assert_eq!(a.len(), b.len());
        let scale = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (k, (a, b)) in a.iter().zip(&b).enumerate() {
            prop_assert!(
                (a - b).abs() <= 2.0 * dalembert::solve::DEFAULT_ACCURACY * scale,
                "{} of {}: {} {}",
                k,
                time,
                a,
                b
            );
        }
        compared += a.len();
    }
    Ok(compared)
}

/// Doubles, digits, fractions and enclosures, and any order. Fractions end at the first irrational root.
#[test]
fn undamped() {
    compares(160, [160, 160, 160, 160, 160], scene(false, 0.3), |problem| {
        let times = times(&problem);
        let Some(truth) = run::<Float>(&problem, &Question::run(Numbers::Digits(40))) else { return Ok([0; 5]) };
        Ok([
            in_numbers::<f64, _>(&problem, Numbers::Double(None), &times, &*truth)?,
            in_numbers::<Float, _>(&problem, Numbers::Digits(12), &times, &*truth)?,
            in_numbers::<Rational, _>(&problem, Numbers::Exact, &times, &*truth)?,
            in_numbers::<Interval, _>(&problem, Numbers::Certified(12), &times, &*truth)?,
            in_any_order(&problem, &times)?,
        ])
    });
}

#[test]
fn damped() {
    compares(16, [16, 16, 6, 16], scene(true, 0.0), every_number_system_but_fractions);
}

#[test]
fn damped_and_strained() {
    compares(4, [4, 4, 0, 4], scene(true, 1.0), every_number_system_but_fractions);
}

/// A damped rod.
fn every_number_system_but_fractions(problem: Problem) -> Result<[usize; 4], TestCaseError> {
    let times = times(&problem);
    let Some(truth) = run::<Float>(&problem, &Question::run(Numbers::Digits(25))) else { return Ok([0; 4]) };
    Ok([
        in_numbers::<f64, _>(&problem, Numbers::Double(None), &times, &*truth)?,
        in_numbers::<Float, _>(&problem, Numbers::Digits(12), &times, &*truth)?,
        in_numbers::<Interval, _>(&problem, Numbers::Certified(12), &times, &*truth)?,
        in_any_order(&problem, &times)?,
    ])
}

/// A run in doubles and the same run in longer numbers, both asked by doubles: rays at times that no double holds are
/// met in both.
#[test]
fn rays_are_met_by_rounded_times() {
    for (rod, damping, fixed) in [(("4", "3/4"), Some("39/200"), false), (("3/7", "1/3"), None, true)] {
        let number = |text: &str| text.parse::<Number>().unwrap();
        let mut problem = Problem::builder().length(number(rod.0)).wave_speed(number(rod.1)).gravity(number("1"));
        problem = problem.impact_speed(number("3")).time(number("30"));
        if let Some(r) = damping {
            problem = problem.damping(number(r));
        }
        if fixed {
            problem = problem.top(dalembert::Top::Fixed);
        }
        let problem = problem.build().unwrap();
        let plan = Plan::of(&problem, &Question::run(Numbers::Double(None))).unwrap();
        let observe = Arc::new(dalembert::engine::unobserved) as dalembert::Observer;
        let [double, long] =
            [Rung::Double, Rung::Bits(192)].map(|rung| f64::run(&problem, &plan, rung, &observe).unwrap());
        let mut jumps = 0;
        for time in times(&problem).iter().map(|time| <f64 as dalembert::number::Answer>::carry(&time.to_f64())) {
            let found = [Side::Left, Side::Right].map(|side| {
                let (ours, theirs) = (values(&*double, &time, side).ok()?, values(&*long, &time, side).ok()?);
                same(&format!("{side:?} of {time:?}"), &ours, &theirs).unwrap();
                Some(ours)
            });
            if let [Some(left), Some(right)] = found {
                jumps += left.iter().zip(&right).filter(|(a, b)| (a.1.to_f64() - b.1.to_f64()).abs() > 1e-3).count();
            }
        }
        assert!(jumps >= 4, "{jumps}");
    }
}

/// At `t = 0⁻` every engine has the given data, at the ends and at a jump of the velocity, too.
#[test]
fn before_the_start_there_is_what_is_given() {
    let number = |text: &str| text.parse::<Number>().unwrap();
    for (damping, fixed) in [(None, false), (None, true), (Some("1/100"), false), (Some("2"), true)] {
        let mut problem = Problem::builder()
            .length(1)
            .wave_speed(1)
            .displacement([("0", "0"), ("1/3", "0"), ("1", "1/9")].map(|(x, v)| (number(x), number(v))))
            .velocity([("0", "-1"), ("1/3", "-1"), ("1/3", "2"), ("1", "0")].map(|(x, v)| (number(x), number(v))))
            .time(3);
        if let Some(r) = damping {
            problem = problem.damping(number(r));
        }
        if fixed {
            problem = problem.top(dalembert::Top::Fixed);
        }
        let history = problem.build().unwrap().doubles().unwrap();
        let third = 1.0 / 3.0;
        for (x, expected) in [
            (0.0, [0.0, -1.0, 0.0]),
            (0.25, [0.0, -1.0, 0.0]),
            (2.0 * third, [1.0 / 18.0, 1.0, 1.0 / 6.0]),
            (1.0, [1.0 / 9.0, 0.0, 1.0 / 6.0]),
        ] {
            let found = history.field(&[x], &[0.0], Side::Left).unwrap().remove(0);
            for (a, b) in [found.displacement, found.velocity, found.strain].iter().zip(expected) {
                assert!((a - b).abs() < 1e-14, "{damping:?} {fixed} at {x}: {found:?}");
            }
        }
        assert_eq!(history.top_end(0.0, Side::Left).unwrap().1, 0.0);
        assert_eq!(
            (history.ground_end(0.0, Side::Left).unwrap().1, history.strain(0.0, Side::Left).unwrap()),
            (-1.0, 0.0)
        );
    }
}

/// The top of a rod whose length no double holds is its top in longer numbers as well.
#[test]
fn the_top_is_the_top_in_longer_numbers() {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let mut problem = Problem::uniform(number("1/3"), 1.into(), 1.into(), number("2.433"));
    problem = problem.with_run(Run::Time(80.into())).unwrap();
    let motion = problem.doubles().unwrap();
    assert!(matches!(motion.rung(), Rung::Bits(_)), "{:?}", motion.rung());
    for k in 1..40 {
        // A free top has no strain.
        assert_eq!(motion.at(1.0 / 3.0, 2.0 * f64::from(k) - 0.3217).unwrap().strain, 0.0);
    }
}

/// A place that spells the length is the top, in whatever numbers: a fixed one stands still from the start on.
#[test]
fn the_top_is_where_the_length_is() {
    for length in ["1.2855", "2/5", "4/3"] {
        let top: Number = length.parse().unwrap();
        let rod = Problem::builder().length(length).wave_speed("0.86874").gravity("0.117388").top(Top::Fixed);
        let rod = rod.displacement([("0", "0"), (length, "0.5")]).velocity([("0", "-1"), (length, "0.25")]).impacts(2);
        let problem = rod.build().unwrap();
        fn still<S: Target>(history: &TypedHistory<S>, top: &Number) -> f64 {
            let velocity = history.ask(
                |motion| {
                    let precision = motion.end().precision();
                    let [top, zero] = [top, &Number::from(0)].map(|number| S::Carried::spelling(number, &precision));
                    Ok::<_, Error>(motion.field(&top, &zero, Side::Right)?.velocity)
                },
                |velocity| vec![velocity],
            );
            velocity.unwrap().to_f64()
        }
        let found = [
            still(&problem.doubles().unwrap(), &top),
            still(&problem.digits(5).unwrap(), &top),
            still(&problem.digits(28).unwrap(), &top),
            still(&problem.certified(12).unwrap(), &top),
        ];
        assert_eq!(found, [0.0; 4], "{length}");
    }
}
