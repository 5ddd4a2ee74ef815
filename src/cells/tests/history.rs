use super::*;
use crate::motion::Motion;
use crate::{Number, Reason};

fn plain(history: &Damped<f64>) -> Course<f64> {
    history.course().clone().map(Estimate::into_value)
}

/// Builds a rod with c = L = 1.
fn rod(gravity: i64, speed: i64, damping: &str, run: Run) -> Problem {
    let mut problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(gravity), Number::from(speed));
    problem = problem.to_builder().damping(damping).build().unwrap();
    problem = problem.with_run(run).unwrap();
    problem
}

#[test]
fn shorter_cells_change_nothing() {
    for damping in ["0.01", "0.3", "2.6"] {
        let problem = rod(1, 4, damping, Run::Time(Number::from(14)));
        let coarse = Damped::<f64>::solve(&problem, &(), 12.0).unwrap();
        let task = Task { problem: &problem, precision: &(), effort: Effort::of(12.0), observe: &unobserved };
        let fine = Damped::<f64>::march_shortened(&task, 5, false).unwrap();
        assert!(fine.pieces.len() > 4 * coarse.pieces.len() / 3);
        assert_eq!(coarse.events().len(), fine.events().len());
        for (a, b) in plain(&coarse).events.iter().zip(plain(&fine).events) {
            assert!((a.t - b.t).abs() < 1e-12, "{damping} {a:?} {b:?}");
            assert!((a.h - b.h).abs() < 1e-12 && (a.h_rate - b.h_rate).abs() < 1e-12);
        }
        for k in 0..50 {
            let t = 0.28 * f64::from(k) + 0.013;
            for x in [0.0, 0.37, 1.0] {
                let of = |history: &Damped<f64>| history.field_of(&x, &t, Side::Right).unwrap();
                let (a, b) = (of(&coarse), of(&fine));
                let off = [a.displacement - b.displacement, a.velocity - b.velocity, a.strain - b.strain];
                assert!(off.iter().all(|d| d.abs() < 1e-12), "{damping} {x} {t} {off:?}");
            }
        }
    }
}

#[test]
fn a_run_that_takes_too_much_ends_where_it_is() {
    let problem = rod(1, 4, "0.01", Run::Time(Number::from(40)));
    let task = |effort| Task { problem: &problem, precision: &(), effort, observe: &unobserved };
    let solve = |effort| Damped::<f64>::march(&task(effort), false).unwrap();
    let (whole, part) = (solve(Effort::of(12.0)), solve(Effort { cells: 100, ..Effort::of(12.0) }));
    let Ending::Undecided(Reason::Effort { cells, rays }) = part.course.ending else {
        panic!("{}", part.course.ending)
    };
    let (known, all) = (plain(&part), plain(&whole));
    assert!(cells > 100 && rays > 1 && known.end < all.end);
    assert!(known.events.len() > 2 && known.events.len() < all.events.len());
    assert_eq!(known.events, all.events[..known.events.len()]);
    let centre = |of: &Damped<f64>| of.centre_of(&known.end).unwrap();
    assert_eq!(centre(&part), centre(&whole));
    assert!(matches!(part.centre(&whole.end()), Err(Error::TimeOutside { .. })));
}

#[test]
fn energy_is_lost_to_damping_alone() {
    // E(t) − E(0) = −2r ∫∫ v_t²: Gauss in time between all times at which rays meet each other or an end.
    let problem = rod(1, 3, "0.3", Run::Time(Number::from(7)));
    let history = Damped::<f64>::solve(&problem, &(), 13.0).unwrap();
    assert!(history.events().len() >= 3);
    let end = history.end().value() / 2.0;
    let rays: Vec<f64> = history.pieces.iter().map(|piece| piece.from).collect();
    let mut times = vec![0.0, end];
    for a in &rays {
        times.extend([*a, a + 0.5]);
        times.extend(rays.iter().filter(|b| (*a - **b).abs() <= 1.0).map(|b| 0.5 * (a + b)));
    }
    times.retain(|t| (0.0..=end).contains(t));
    times.sort_by(f64::total_cmp);
    let mut lost = 0.0;
    for pair in times.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
        for (x, w) in history.medium.rule(&history.medium.longest) {
            let t = pair[0] + x * (pair[1] - pair[0]);
            let motion: f64 =
                history.record().line(&t, &0.5).iter().map(|node| node.weight * node.velocity().powi(2)).sum();
            lost += w * (pair[1] - pair[0]) * motion;
        }
    }
    // The units are V = 3, t₁ = 2, c t₁ = 2.
    let lost = 2.0 * 0.3 * lost * 9.0 * 2.0 * 2.0;
    let energy = |time: f64| *history.energy(&Estimate::exact(time)).unwrap().total.value();
    let change = energy(2.0 * end) - energy(0.0);
    assert!((change + lost).abs() < 1e-11, "{change} {lost}");
    assert!((energy(0.0) - 4.5).abs() < 1e-13);
}
