//! `Motion::rates`, velocity and strain on a grid at once, against the field point by point: two ways to the same
//! numbers in every engine, at both ends, at rest, and across flights that are leapt over.

use crate::conformance::grid;
use dalembert::chain::Spring;
use dalembert::number::{Answer, Scalar};
use dalembert::solve::unobserved;
use dalembert::{Error, Estimate, Numbers, Plan, Problem, Question, Side, TypedHistory};

/// What differs by more than the bounds.
fn differences(name: &str, problem: &Problem, parts: usize) -> Vec<String> {
    let history = problem.doubles().unwrap();
    let end = *history.end();
    let (length, round) = (problem.length().to_f64(), history.scales().time);
    // Points and times of rays among them: halves of the rod, quarters of round trips, events.
    let mut times: Vec<f64> = (0..=parts).map(|k| end * k as f64 / parts as f64).collect();
    times.extend((1..12).map(|k| 0.25 * round * f64::from(k)).filter(|time| *time < end));
    times.extend(history.events().iter().map(|event| event.t));
    // At the end itself there are no later times, and a ray may arrive there.
    times.retain(|time| *time < end * (1.0 - 1e-9));
    times.sort_by(f64::total_cmp);
    // Only times are in order.
    let points = [0.5, 0.0, 0.77, 0.013, 1.0, 0.25].map(|x| (x * length).carry());
    let carried: Vec<_> = times.iter().map(Answer::carry).collect();
    let rates = history.ask(|motion| motion.rates(&grid(&points, &carried)), |_| Vec::new()).unwrap();
    assert_eq!(rates.len(), points.len() * times.len());
    let (scale, c) = (history.scales().velocity, history.scales().wave_speed);
    let (mut compared, mut found) = (0, Vec::new());
    for (time, row) in carried.iter().zip(rates.chunks(points.len())) {
        for (point, [velocity, strain]) in points.iter().zip(row) {
            let at = |side| history.ask(|motion| motion.field(point, time, side), |_| Vec::new()).unwrap();
            let (left, right) = (at(Side::Left), at(Side::Right));
            let off = |x: &Estimate<f64>, y: &Estimate<f64>| (x.to_f64() - y.to_f64()).abs() / scale;
            // On a ray there are several values.
            if off(&left.velocity, &right.velocity).max(c * off(&left.strain, &right.strain)) > 1e-12 {
                continue;
            }
            compared += 1;
            let (x, t) = (point.to_f64(), time.to_f64());
            for (ours, fields, speed) in [(velocity, &right.velocity, 1.0), (strain, &right.strain, c)] {
                let apart = speed * off(ours, fields);
                let most = speed * (ours.bound() + fields.bound()) / scale + 1e-12;
                if apart.is_nan() || apart > most {
                    found.push(format!("{name}: x = {x}, t = {t}: {apart:e} {most:e}"));
                }
            }
        }
    }
    assert!(10 * compared > 8 * rates.len(), "{name}: {compared} of {}", rates.len());
    found
}

#[test]
fn grids_have_the_values_of_the_field() {
    let rod = || Problem::builder().length(2).wave_speed(3).gravity(1).impact_speed("1.7");
    let scenes = [
        ("undamped", rod().impacts(6)),
        ("undamped, from above", rod().gap("0.4").impacts(2)),
        ("held", rod().fixed_top().impacts(4)),
        ("damped", rod().damping("0.3").impacts(4)),
        ("damped, long flights", rod().damping("0.01").impact_speed(40).impacts(2)),
        ("damped and held", rod().damping("0.2").fixed_top().impacts(3)),
        ("damped, at rest in the end", rod().damping(2).time(60)),
        ("damped, from above", rod().damping("0.1").gap("0.4").impacts(2)),
    ];
    let found = scenes.into_iter().flat_map(|(name, problem)| differences(name, &problem.build().unwrap(), 40));
    assert_eq!(found.collect::<Vec<_>>(), Vec::<String>::new());
}

/// A plan in doubles takes no longer numbers, for damped rods and for bodies of chains.
#[test]
fn plans_in_doubles_stay_in_doubles() {
    let damped = Problem::builder().length(1).wave_speed(1).gravity(1).damping("0.1").impact_speed(20).impacts(15);
    let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).build().unwrap();
    let spring = Spring { stiffness: 20.into(), damping: 0.into() };
    for problem in [damped.build().unwrap(), rod.on_spring(spring, 3.into()).unwrap()] {
        let plan = Plan::of(&problem, &Question::run(Numbers::Double(Some(1e-15)))).unwrap();
        let bound = |plan: &Plan| {
            let history = TypedHistory::<f64>::solve(&problem, plan, unobserved()).unwrap();
            let release = &history.ask(|motion| Ok(motion.events()[1].t.clone()), |t| vec![t]).unwrap();
            release.log2_error()
        };
        let [doubles, longer] = [plan.clone().in_doubles(), plan].map(|plan| bound(&plan));
        assert!(doubles > longer + 3.0, "{doubles} {longer}");
    }
}

#[test]
fn a_point_or_a_time_outside_is_refused() {
    for damping in ["0", "0.1"] {
        let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).gravity(1).damping(damping).impacts(2);
        let history = rod.build().unwrap().doubles().unwrap();
        let ask = |point: f64, time: f64| {
            history.ask(|motion| motion.rates(&[(point.carry(), time.carry())]), |_| Vec::new()).unwrap_err()
        };
        for time in [1.0, *history.end() * 0.9] {
            assert!(matches!(ask(1.5, time), Error::PointOutside { .. }), "{damping} {time}");
        }
        assert!(matches!(ask(0.5, -1.0), Error::TimeOutside { .. }));
        assert!(matches!(ask(0.5, 1e9), Error::BeyondEnd { .. }));
    }
}
