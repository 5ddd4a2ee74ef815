//! The bounds that undamped histories carry, against the same histories in 400 bits; and times on rays and at the end.

use crate::stripped::{undamped, undamped_within};
use dalembert::engine::{Limits, Motion, Undamped};
use dalembert::number::{Answer, Scalar};
use dalembert::{Estimate, Event, Number, Problem, Run, Scene, Side, Top};
use proptest::prelude::*;
use rug::{Float, Rational};

const TRUTH: u32 = 400;

type Rounded = Undamped<Estimate<f64>>;
type Truth = Undamped<Estimate<Float>>;

fn number(thousandths: i64) -> Number {
    format!("{thousandths}e-3").parse().unwrap()
}

/// Scenes in decimals, which doubles do not hold: uniform impacts and piecewise-linear starts, with and without
/// gravity.
fn scene() -> impl Strategy<Value = Problem> {
    let sizes = (100i64..3000, 100i64..9000, 0i64..12_000, 50i64..20_000);
    (sizes, any::<bool>(), any::<bool>(), 1i64..999, -900i64..900).prop_map(|((l, c, g, mu), fixed, profile, x, v)| {
        let mut problem = Problem::uniform(number(l), number(c), number(if g < 1500 { 0 } else { g }), number(mu));
        problem = problem.to_builder().top(if fixed { Top::Fixed } else { Top::Free }).build().unwrap();
        if profile {
            let at = |part: i64| -> Number { format!("{}e-6", l * part).parse().unwrap() };
            let top = number(if fixed { 0 } else { -mu });
            let displaced = [(at(0), number(v.max(0))), (at(x), number(300)), (at(1000), number(40))];
            let moving = [(at(0), number(-mu)), (at(x), number(v)), (at(1000), top)];
            problem = problem.to_builder().displacement(displaced).velocity(moving).build().unwrap();
        }
        // Some ten round trips.
        problem = problem.with_run(Run::Time(format!("{}/{}", 21 * l, c).parse().unwrap())).unwrap();
        problem
    })
}

/// Whether `ours` lies within its own bound of `truth`, whose bound is nothing beside it.
fn covered(what: &str, ours: &Estimate<f64>, truth: &Estimate<Float>) -> Result<(), TestCaseError> {
    let error = Float::with_val(TRUTH, truth.value() - ours.value()).abs().to_f64();
    prop_assert!(error <= ours.bound(), "{}: {:e} is off by {:e} > {:e}", what, ours.value(), error, ours.bound());
    prop_assert!(truth.log2_error() < -300.0);
    Ok(())
}

fn covered_event(ours: &Event<Estimate<f64>>, truth: &Event<Estimate<Float>>) -> Result<(), TestCaseError> {
    prop_assert_eq!(ours.kind, truth.kind);
    let place = format!("{:?} at {}", ours.kind, ours.t.value());
    covered(&place, &ours.t, &truth.t)?;
    covered(&format!("v_t, {place}"), &ours.v_end, &truth.v_end)?;
    covered(&format!("h, {place}"), &ours.h, &truth.h)?;
    covered(&format!("h′, {place}"), &ours.h_rate, &truth.h_rate)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    /// The bound of each event covers the truth, that of a landing after a release that a ray brings included, whose
    /// time is as uncertain as the ray; and so does that of each value at a time.
    #[test]
    fn bounds_cover_the_truth(problem in scene()) {
        let (ours, truth) = (Rounded::solve(&problem, &()).unwrap(), Truth::solve(&problem, &TRUTH).unwrap());
        prop_assert_eq!(ours.undetermined_from(), None);
        prop_assert_eq!(ours.events().len(), truth.events().len());
        for (ours, truth) in ours.events().iter().zip(truth.events()) {
            covered_event(ours, truth)?;
        }
        for (a, b) in ours.contacts().iter().zip(truth.contacts()) {
            covered("impulse", &a.impulse, &b.impulse)?;
            covered("peak", &a.peak_strain, &b.peak_strain)?;
        }
        for k in 1..12 {
            // The same number in both, and far from any ray, on which a double would be taken to lie.
            let t = *ours.end().value() * (f64::from(k) * std::f64::consts::SQRT_2 / 17.0);
            let (time, exact) = (Estimate::exact(t), Estimate::exact(Float::with_val(TRUTH, t)));
            for (what, a, b) in [
                ("ground", ours.ground_end(&time, Side::Left).unwrap(), truth.ground_end(&exact, Side::Left).unwrap()),
                ("top", ours.top_end(&time, Side::Left).unwrap(), truth.top_end(&exact, Side::Left).unwrap()),
                ("centre", ours.centre(&time).unwrap(), truth.centre(&exact).unwrap()),
            ] {
                covered(&format!("{what} at {t}"), &a.0, &b.0)?;
                covered(&format!("velocity of the {what} at {t}"), &a.1, &b.1)?;
            }
            let (a, b) = (ours.energy(&time).unwrap(), truth.energy(&exact).unwrap());
            covered("E", &a.total, &b.total)?;
            covered("E_z", &a.vibrational, &b.vibrational)?;
            covered("stress", &ours.strain(&time, Side::Left).unwrap(), &truth.strain(&exact, Side::Left).unwrap())?;
        }
    }

    /// A time gives the same whether it is the last one or not: on rays, at events and elsewhere, on both sides.
    #[test]
    fn the_last_time_is_like_any_other(problem in scene(), part in 1i64..40) {
        let whole = undamped::<f64>(&problem, &()).unwrap();
        let round_trip = whole.scales().time;
        // A ray of the start that is at an end of the rod, an event, a break of the profile, and a time of no note.
        let event = whole.events().last().map_or(1.0, |event| event.t);
        let mut times = vec![round_trip * (part % 20) as f64 / 2.0, event, event + round_trip, 0.123 * part as f64];
        times.retain(|time| *time > 0.0 && *time < whole.end());
        for time in times {
            let run = Run::Time(time.to_string().parse().unwrap());
            let alone = undamped::<f64>(&problem.with_run(run).unwrap(), &()).unwrap();
            for side in [Side::Left, Side::Right] {
                let place = format!("{side:?} of {time}");
                prop_assert_eq!(alone.strain(&time, side), whole.strain(&time, side), "stress, {}", place);
                prop_assert_eq!(alone.ground_end(&time, side), whole.ground_end(&time, side), "ground, {}", place);
                prop_assert_eq!(alone.top_end(&time, side), whole.top_end(&time, side), "top, {}", place);
                prop_assert_eq!(alone.centre(&time), whole.centre(&time), "centre, {}", place);
                prop_assert_eq!(alone.energy(&time), whole.energy(&time), "energy, {}", place);
            }
        }
    }
}

fn sampled<S: Answer>(problem: &Problem, precision: &S::Precision, time: &str, until: &str) -> [[S; 3]; 2] {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let history = undamped::<S>(&problem.with_run(Run::Time(number(until))).unwrap(), precision).unwrap();
    let time = S::from_number(&number(time), precision);
    [Side::Left, Side::Right].map(|side| {
        let field = history.field(&history.scales().length, &time, side).unwrap();
        [history.strain(&time, side).unwrap(), history.top_end(&time, side).unwrap().1, field.strain]
    })
}

/// Rays whose times doubles do not hold, asked alone and with later times, against fractions.
#[test]
fn both_sides_of_a_ray() {
    let weak = crate::common::uniform("3/5", "4/5", "5/2", "3/8", Run::Impacts(1));
    let strong = crate::common::uniform("3/5", "1/3", "3", "1593/25", Run::Impacts(1));
    for (problem, time, later) in
        [(&weak, "3/2", "2"), (&weak, "9/4", "3"), (&strong, "18/5", "4"), (&strong, "9/5", "4")]
    {
        let exact = sampled::<Rational>(problem, &(), time, later);
        for until in [time, later] {
            let (doubles, digits) =
                (sampled::<f64>(problem, &(), time, until), sampled::<Float>(problem, &120, time, until));
            assert_eq!(sampled::<Rational>(problem, &(), time, until), exact);
            for ((a, b), truth) in doubles.iter().flatten().zip(digits.iter().flatten()).zip(exact.iter().flatten()) {
                crate::common::close(time, *a, Scalar::to_f64(truth), 1.0, 1e-13);
                crate::common::close(time, Scalar::to_f64(b), Scalar::to_f64(truth), 1.0, 1e-15);
            }
        }
    }
    // −(μ + g t₁)/c is what is left of t₁ = 3/2, and q has turned by 2μ to its right.
    let [left, right] = sampled::<f64>(&weak, &(), "3/2", "3/2");
    crate::common::close("left", left[0], -5.15625, 1.0, 1e-15);
    crate::common::close("right", right[0], -4.21875, 1.0, 1e-15);
    let velocities = sampled::<Rational>(&weak, &(), "9/4", "9/4").map(|[_, velocity, _]| velocity);
    assert_eq!(velocities, [Rational::from((9, 4)), Rational::from((3, 2))]);
    // After μ > g t₁ the end leaves the ground at t₁ = 18/5.
    assert_eq!(sampled::<Float>(&strong, &90, "18/5", "18/5")[1][0], 0);
}

/// From when on events are not determined does not depend on what is forgotten on the way, or how far the history goes.
#[test]
fn determined_up_to_one_and_the_same_time() {
    let run = |until: i64, keep_from: usize| {
        let problem = crate::common::uniform("1", "1", "1", "3/2", Run::Time(until.into()));
        let limits = Limits { keep_from, ..Limits::default() };
        let history = undamped_within::<f64>(&problem, &(), limits).unwrap();
        (history.carried().undetermined_from(), history.warnings().to_vec())
    };
    let (time, warnings) = run(160, 0);
    assert!((100.0..160.0).contains(&time.unwrap()) && warnings.len() == 1, "{time:?} {warnings:?}");
    assert_eq!(run(160, 75), (time, warnings.clone()));
    assert_eq!(run(200, 99), (time, warnings));
    assert_eq!(run(100, 0), (None, Vec::new()));
    // Up to there each event is where 400 bits have it, within its bound.
    let problem = crate::common::uniform("1", "1", "1", "3/2", Run::Time(100.into()));
    let (ours, truth) = (Rounded::solve(&problem, &()).unwrap(), Truth::solve(&problem, &TRUTH).unwrap());
    assert_eq!(ours.events().len(), truth.events().len());
    for (ours, truth) in ours.events().iter().zip(truth.events()) {
        covered_event(ours, truth).unwrap();
    }
}

/// A steel bar that lands ten times after thousands of round trips each: the bound covers the truth, and is far below
/// what a loss of all digits would be.
#[test]
fn ten_impacts_of_a_steel_bar() {
    let scene = "rod = { length = 0.5, modulus = 210e9, density = 7850, area = 1e-4 }\nimpact = { drop_height = 1 }\n\
                 gravity = { acceleration = 9.81 }\nrun = { impacts = 10 }";
    let problem = Scene::parse(scene).unwrap().problem;
    let (ours, truth) = (Rounded::solve(&problem, &()).unwrap(), Truth::solve(&problem, &TRUTH).unwrap());
    assert_eq!(ours.events().len(), 20);
    for (ours, truth) in ours.events().iter().zip(truth.events()) {
        covered_event(ours, truth).unwrap();
    }
    let (impacts, lost) = ours.digits_lost().unwrap();
    assert!(impacts == 10 && lost < 10.0, "{lost}");
    assert_eq!(ours.undetermined_from(), None);
}
