//! The questions of `conformance` in long numbers and enclosures.

use std::sync::Arc;

use crate::conformance::{both, conforms, lattice, rod, undamped};
use dalembert::engine::{ContactHistory, Motion, unobserved};
use dalembert::number::IntervalPrecision;
use dalembert::solve::{Rung, Target};
use dalembert::{Estimate, Float, Interval, Numbers, Observer, Plan, Problem, Question, Run};

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
