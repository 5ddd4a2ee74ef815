#![allow(clippy::unwrap_used)]
use super::*;
use dalembert::engine::FirstContact;
use dalembert::number::Answer;

fn problem(damping: Option<&str>) -> Problem {
    let number = |text: &str| text.parse().unwrap();
    let mut problem = Problem::uniform(number("1"), number("1"), number("1"), number("3"));
    problem = problem.with_run(Run::Time(number("1.5"))).unwrap();
    problem = problem.to_builder().damping(damping.map_or(0.into(), number)).build().unwrap();
    problem
}

/// Without damping the march is exact but for rounding while events fall on steps: Corollary 1, and
/// h = −μt − gt²/2 + (c/L)(μt²/2 + gt³/6) at t = 3/2, whose mean over cells is of second order.
#[test]
fn without_damping() {
    let found = march(&problem(None), 16).unwrap();
    assert!((found.strain + 4.5).abs() < 1e-13, "{found:?}");
    let centre = -4.5 - 1.125 + (3.375 + 0.5625);
    assert!((found.state_at(1.5).unwrap().centre - centre).abs() < 1.0 / (16.0 * 16.0), "{found:?} {centre}");
    let released = march(&problem(None).with_run(Run::Impacts(1)).unwrap(), 16).unwrap();
    assert!((released.events[1].1 - 2.0).abs() < 1.0 / 16.0, "{released:?}");
}

/// With damping its first order shows: the error stays below the `r t dt E` that a ray which damping sees a quarter
/// of a step late can add.
#[test]
fn with_damping() {
    let problem = problem(Some("0.2"));
    let rod = Parameters::<f64>::of(&problem, &()).unwrap();
    let truth = FirstContact::new(&rod.carry()).energy(&1.5.carry()).total.into_value();
    for cells in [16, 64, 256] {
        let wrong = (march(&problem, cells).unwrap().state_at(1.5).unwrap().energy - truth).abs();
        assert!(wrong < 0.2 * 1.5 / cells as f64 * truth, "{cells}: {wrong:e}");
    }
}
