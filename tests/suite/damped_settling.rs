//! Damped rods that come to rest: the state at rest is that of statics, the history reaches the time asked for, and it
//! costs no more to ask for more of it.

use crate::common::{close, uniform};
use crate::stripped::{Stripped, damped};
use dalembert::engine::{ContactHistory, Damped, Motion};
use dalembert::{Ending, Error, Estimate, Parameters, Problem, Run, Side};
use dalembert_verify::modal::Modal;

/// `c = L = 1`.
fn rod(gravity: &str, speed: &str, damping: &str, time: i64) -> Problem {
    let mut problem = uniform("1", "1", gravity, speed, Run::Time(time.into()));
    problem = problem.to_builder().damping(damping).build().unwrap();
    problem
}

/// Dropped or pressed under a fixed top: linear from `low` at the ground to `high`.
fn fixed(gravity: &str, low: &str, high: &str, damping: &str, time: i64) -> Problem {
    let rod = Problem::builder().length(1).wave_speed(1).gravity(gravity).damping(damping).fixed_top();
    rod.displacement([("0", low), ("1", high)]).time(time).build().unwrap()
}

fn solve(problem: &Problem) -> Stripped<f64, Damped<f64>> {
    damped(problem, &(), 13.0).unwrap()
}

/// Everything that can be asked at the end: the rod rests with `v`, and `v_x(0)` as it is just above the ground.
fn rests(history: &dyn Motion<f64>, time: i64, v: impl Fn(f64) -> f64, stress: f64) {
    let end = time as f64;
    assert_eq!(history.end(), end);
    let pieces = history.stress_pieces();
    let last = pieces.last().unwrap();
    assert_eq!(last.end, end);
    assert!(pieces.windows(2).all(|pair| pair[0].end == pair[1].start));
    for t in [end, 0.9 * end + 0.123] {
        close("stress", history.strain(&t, Side::Left).unwrap(), stress, 1.0, 1e-11);
        for x in [0.0, 0.31, 1.0] {
            let field = history.field(&x, &t, Side::Right).unwrap();
            close("v", field.displacement, v(x), 1.0, 1e-10);
            close("v_t", field.velocity, 0.0, 1.0, 1e-10);
        }
        // Simpson's rule is exact for v_s.
        let centre = (v(0.0) + 4.0 * v(0.5) + v(1.0)) / 6.0;
        close("h", history.centre(&t).unwrap().0, centre, 1.0, 1e-10);
        close("h'", history.centre(&t).unwrap().1, 0.0, 1.0, 1e-10);
        let energy = history.energy(&t).unwrap();
        close("E", energy.total, energy.translational + energy.vibrational, 1.0, 1e-12);
        close("v(0)", history.ground_end(&t, Side::Left).unwrap().0, v(0.0), 1.0, 1e-10);
        close("v(L)", history.top_end(&t, Side::Left).unwrap().0, v(1.0), 1.0, 1e-10);
    }
    assert!(history.field(&0.5, &(end * 1.01), Side::Right).is_err());
}

#[test]
fn a_rod_on_the_ground_rests_on_its_weight() {
    for (speed, damping, time) in [("3", "0.2", 1_000), ("5", "0.5", 1_000_000), ("1", "1.8", 1_000_000)] {
        let history = solve(&rod("1", speed, damping, time));
        match history.ending() {
            Ending::Rest(_) => assert_ne!(damping, "1.8"),
            Ending::NoBounce(_) => assert_eq!(damping, "1.8"),
            other => panic!("{other:?}"),
        }
        assert!(history.error_estimate() < 1e-10);
        rests(&history, time, |x| 0.5 * x * x - x, -1.0);
        // What came before is as if it had been asked for alone, on both sides of where rest begins.
        let before = solve(&rod("1", speed, damping, 11));
        assert_eq!(before.events(), &history.events()[..before.events().len()]);
        let impulse: f64 = history.contacts().iter().map(|contact| contact.impulse).sum();
        let (h, rate) = history.centre(&history.end()).unwrap();
        let change = rate + speed.parse::<f64>().unwrap() + 2.0 * damping.parse::<f64>().unwrap() * h;
        close("momentum", change, impulse - time as f64, time as f64, 1e-10);
    }
}

#[test]
fn the_field_goes_over_into_rest_without_a_step() {
    let history = solve(&rod("1", "3", "0.2", 1_000));
    let pieces = history.stress_pieces();
    let begin = pieces.last().unwrap().start;
    assert!(begin < 300.0, "{begin}");
    for t in [begin - 1e-3, begin, begin + 1e-9, begin + 1e-3] {
        for x in [0.2, 0.7, 1.0] {
            let field = history.field(&x, &t, Side::Right).unwrap();
            close("v", field.displacement, 0.5 * x * x - x, 1.0, 1e-11);
            close("v_x", field.strain, x - 1.0, 1.0, 1e-11);
        }
        close("E_z", history.energy(&t).unwrap().vibrational, 1.0 / 6.0, 1.0, 1e-11);
    }
}

#[test]
fn without_gravity_the_rod_stops_in_the_air() {
    for (speed, damping) in [("3", "0.2"), ("5", "0.5"), ("5", "1.2")] {
        let history = solve(&rod("0", speed, damping, 1_000_000));
        assert!(matches!(history.ending(), Ending::NoFurtherImpact(_)), "{:?}", history.ending());
        // h′ + 2rh is constant in flight.
        let release = &history.events()[1];
        let height = release.h + release.h_rate / (2.0 * damping.parse::<f64>().unwrap());
        assert!(history.error_estimate() < 1e-10);
        rests(&history, 1_000_000, |_| height, 0.0);
    }
    // r t₁ > π: a contact that decays without end; nothing tells whether it ends.
    let history = solve(&rod("0", "1", "1.8", 1_000_000));
    assert!(matches!(history.ending(), Ending::Rest(_)), "{:?}", history.ending());
    rests(&history, 1_000_000, |_| 0.0, 0.0);
}

#[test]
fn a_rod_under_a_fixed_top_hangs_or_stands() {
    // v_s′(0) = v(L)/L − gL/2c².
    let hangs = solve(&fixed("1", "3/4", "3/4", "0.4", 100_000));
    assert!(matches!(hangs.ending(), Ending::NoFurtherImpact(_)), "{:?}", hangs.ending());
    rests(&hangs, 100_000, |x| 0.25 + 0.5 * x * x, 0.0);
    let stands = solve(&fixed("1", "1/4", "1/4", "0.4", 100_000));
    assert!(matches!(stands.ending(), Ending::Rest(_)), "{:?}", stands.ending());
    rests(&stands, 100_000, |x| 0.5 * x * x - 0.25 * x, -0.25);
    let pressed = solve(&fixed("0", "0", "-1/2", "0.4", 100_000));
    rests(&pressed, 100_000, |x| -0.5 * x, -0.5);
    // It lands for ever, with ever less speed; the times of such landings are not known well.
    let touches = solve(&fixed("0", "1", "0", "0.4", 100_000));
    assert!(matches!(touches.ending(), Ending::Rest(_)), "{:?}", touches.ending());
    rests(&touches, 100_000, |_| 0.0, 0.0);
}

/// The closed form of the first contact.
fn contact(problem: &Problem) -> Stripped<f64, ContactHistory<Estimate<f64>>> {
    ContactHistory::solve(problem, &()).map(Stripped::new).unwrap()
}

#[test]
fn a_contact_without_end_is_known_at_all_times() {
    for (gravity, damping) in [("1", "1.8"), ("1", "1.2"), ("0", "1.8")] {
        let problem = rod(gravity, "1/2", damping, 1_000_000);
        let parameters = Parameters::<f64>::of(&problem, &()).unwrap();
        let history = contact(&problem);
        assert!(matches!(history.ending(), Ending::NoBounce(_)), "{:?}", history.ending());
        let g = parameters.gravity;
        rests(&history, 1_000_000, |x| g * (0.5 * x * x - x), -g);
        assert_eq!(history.stress_pieces().last().unwrap().chebyshev, vec![-g]);
    }
    // Too slow: after 256 round trips it still moves.
    let problem = rod("0", "1", "1e4", 1_000_000);
    assert_eq!(contact(&problem).end(), 512.0);
}

#[test]
fn damping_that_cells_cannot_follow_is_refused_by_name() {
    let found = Damped::<f64>::solve(&fixed("0", "0", "-1/2", "2000", 1), &(), 12.0).unwrap_err();
    assert_eq!(found, Error::DampingTooStrong { found: 4000.0, most: 2000.0 });
    let text = found.to_string();
    assert!(text.contains("4000") && text.contains("expected at most 2000"), "{text}");
}

/// Late in a contact that lasts, the rays of the closed form cancel: what is printed of it is within its bound of the
/// sum over modes, which does not.
#[test]
fn late_in_a_contact_every_value_is_within_its_bound() {
    for (gravity, speed, damping) in [("1", "0.001", "0.01"), ("1", "0.01", "0.1"), ("3", "1", "1.5")] {
        let mut problem = uniform("1/2", "1", gravity, speed, Run::Time(250.into()));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let history = problem.doubles().unwrap();
        let modal = Modal::new(&Parameters::<f64>::of(&problem, &()).unwrap(), 4096);
        for t in [0.7, 3.3, 20.3, 50.7, 100.2, 249.3] {
            let time = Estimate::exact(t);
            let centre = history.ask(|motion| motion.centre(&time), |(h, rate)| vec![h, rate]).unwrap();
            let strain = history.ask(|motion| motion.strain(&time, Side::Right), |strain| vec![strain]).unwrap();
            let (h, rate) = modal.centre(&t);
            let truths = [h, rate, modal.strain(&t, Side::Right)];
            for (ours, truth) in [centre.0, centre.1, strain].iter().zip(truths) {
                let apart = (ours.value() - truth.value()).abs();
                assert!(apart <= ours.bound() + truth.bound(), "r = {damping}, t = {t}: {ours:?} {truth:?}");
                // Longer numbers are taken where there are any.
                let settled = ours.bound() <= 1e-8;
                assert!(settled && truth.bound() <= 1e-8, "r = {damping}, t = {t}: {ours:?} {truth:?}");
            }
        }
    }
}

/// A landing all but meets a ray, and what is left of the vibration is a sliver of 10⁻⁶ of the rod: its energy is off
/// by what the sliver's width is, which is much against the root of its mean square.
#[test]
fn the_energy_of_a_sliver_is_within_its_bound() {
    let rods = [
        ("1", "4/5", "6", "300000003/20000000", "1/500000000000", 11.1129768),
        ("6", "9/4", "2/5", "5666666661/156250000", "3/16000000000000", 262.262411),
        ("4/3", "7/3", "1/3", "40/21", "7/400000000000", 20.7783463),
    ];
    for (length, wave_speed, gravity, speed, damping, time) in rods {
        let mut problem = uniform(length, wave_speed, gravity, speed, Run::Impacts(3));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let motion = problem.to_builder().time(time + 1.0).build().unwrap();
        let ours =
            motion.doubles().unwrap().ask(|motion| motion.energy(&Estimate::exact(time)), |_| Vec::new()).unwrap();
        let truth = motion.digits(40).unwrap();
        let at = rug::Float::with_val(300, rug::Float::parse(time.to_string()).unwrap());
        let apart = (truth.energy(at).unwrap().vibrational - ours.vibrational.value()).to_f64().abs();
        assert!(apart <= ours.vibrational.bound(), "{time}: {:?} off by {apart:e}", ours.vibrational);
    }
}
