//! The questions of `conformance` in long numbers and enclosures.

use std::sync::Arc;

use crate::conformance::{both, conforms, lattice, rod, undamped};
use dalembert::engine::{ContactHistory, Damped, Motion, Pair, unobserved};
use dalembert::number::{IntervalPrecision, Scalar};
use dalembert::solve::{Rung, Target};
use dalembert::{Estimate, Float, Interval, Numbers, Observer, Plan, Problem, Question, Run, Side};

/// The planned engine in the numbers of a rung, read in numbers `S`.
fn read<S: Target>(problem: &Problem, rung: Rung) -> Arc<dyn Motion<S::Carried>> {
    let question = match rung {
        Rung::Enclosures(_) if problem.damping().is_some() => Question::first_contact(Numbers::default()),
        _ => Question::run(Numbers::default()),
    };
    let plan = Plan::of(problem, &question).unwrap();
    S::run(problem, &plan, rung, &(Arc::new(unobserved) as Observer)).unwrap()
}

#[test]
fn long_numbers_conform() {
    for problem in undamped() {
        let in_doubles = conforms(&*read::<f64>(&problem, Rung::Bits(200)));
        let compared = [conforms(&lattice::<Estimate<Float>>(&problem, &200)), in_doubles];
        assert!(compared.iter().all(|compared| *compared > 250), "{compared:?}");
    }
    let in_doubles = conforms(&*read::<f64>(&rod("3", Some("1/10"), Run::Impacts(3)), Rung::Bits(128)));
    assert!(in_doubles > 250, "{in_doubles}");
    for motion in both::<Float>(&128, 20.0) {
        let compared = conforms(&*motion);
        assert!(compared > 250, "{compared}");
    }
}

#[test]
fn enclosures_conform() {
    let (precision, rung) = (IntervalPrecision::with_exact(200), Rung::Enclosures(200));
    for problem in undamped() {
        let (in_doubles, in_floats) =
            (conforms(&*read::<f64>(&problem, rung)), conforms(&*read::<Float>(&problem, rung)));
        let compared = [conforms(&lattice::<Interval>(&problem, &precision)), in_doubles, in_floats];
        assert!(compared.iter().all(|compared| *compared > 150), "{compared:?}");
    }
    let problem = rod("3", Some("1/10"), Run::Impacts(1));
    let contact = ContactHistory::<Interval>::solve(&problem, &precision).unwrap();
    let compared = [conforms(&contact), conforms(&*read::<f64>(&problem, rung))];
    assert!(compared.iter().all(|compared| *compared > 100), "{compared:?}");
}

fn meets(a: &Estimate<Float>, b: &Estimate<Float>) {
    let off = (a.value().clone() - b.value()).to_f64().abs();
    assert!(off <= a.bound() + b.bound(), "{a:?} {b:?}");
    assert!(a.bound() <= 8.0 * b.bound() + 1e-60, "{a:?} {b:?}");
}

/// A motion in numbers on the stack answers in long numbers as one in MPFR's does.
#[test]
fn both_kinds_of_long_numbers_answer_alike() {
    for damping in [None, Some("1/10")] {
        let problem = rod("3", damping, Run::Impacts(3));
        let ours = read::<Float>(&problem, Rung::Bits(256));
        let other: Arc<dyn Motion<Estimate<Float>>> = match damping {
            None => Arc::new(lattice(&problem, &256)),
            Some(_) => Arc::new(Damped::<Float>::solve(&problem, &256, 20.0).unwrap()),
        };
        assert_eq!(ours.ending(), other.ending());
        assert_eq!(ours.events().len(), other.events().len());
        meets(&ours.end(), &other.end());
        for (a, b) in ours.events().iter().zip(other.events()) {
            assert_eq!(a.t.value().prec(), 256);
            [(&a.t, &b.t), (&a.v_end, &b.v_end), (&a.h, &b.h), (&a.h_rate, &b.h_rate)]
                .into_iter()
                .for_each(|(a, b)| meets(a, b));
            // Each is asked about its own time of the event.
            for side in [Side::Left, Side::Right] {
                meets(&ours.strain(&a.t, side).unwrap(), &other.strain(&b.t, side).unwrap());
            }
        }
        let like = ours.end();
        let (point, time) = (like.ratio(1, 3), like.ratio(5, 3));
        let [a, b] = [&ours, &other].map(|motion| motion.field(&point, &time, Side::Left).unwrap());
        a.numbers().into_iter().zip(b.numbers()).for_each(|(a, b)| meets(a, b));
        for pair in [Pair::GroundEnd, Pair::Centre, Pair::Energy, Pair::EnergyParts] {
            let [a, b] = [&ours, &other].map(|motion| motion.pair(pair, &time, Side::Left).unwrap());
            a.iter().zip(&b).for_each(|(a, b)| meets(a, b));
        }
        let points = [like.zero(), like.ratio(1, 2), like.one()];
        let [a, b] = [&ours, &other].map(|motion| motion.moments(&time, &points).unwrap());
        a.iter().flatten().flatten().zip(b.iter().flatten().flatten()).for_each(|(a, b)| meets(a, b));
    }
}
