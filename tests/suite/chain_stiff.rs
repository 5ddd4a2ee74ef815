//! Stiff springs beside rigid masses against closed forms.

use std::ops::ControlFlow;

use dalembert::chain::{ChainColumn, ChainRun};
use dalembert::number::{Number, Scalar};
use dalembert::{ChainScene, Estimate, EventKind, Numbers, Side};

const TIMES: [f64; 5] = [0.001, 0.25, 0.5, 1.0, 1.875];

/// Returns the force between a mass m and bars of impedance one that meet through springs of stiffness k at the speed
/// one, before a reflection returns.
///
/// **Source**: `f′ = k(1 − f − V)` and `mV′ = count · f`, so that `f″ + kf′ + count (k/m) f = 0` with f(0) = 0 and
/// f′(0) = k.
fn force(k: f64, per_mass: f64, t: f64) -> f64 {
    let root = (k * k - 4.0 * k * per_mass).sqrt();
    let [slow, fast] = [-2.0 * k * per_mass / (k + root), -(k + root) / 2.0];
    k * ((slow * t).exp() - (fast * t).exp()) / root
}

fn run(scene: &str) -> ChainRun<Estimate<f64>> {
    let chain = ChainScene::parse(scene).unwrap().chain;
    ChainRun::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap()
}

/// Holds the forces at a node against the closed form; `per_mass` is the number of springs over the mass.
fn check(run: &ChainRun<Estimate<f64>>, node: usize, (k, per_mass): (f64, f64)) {
    for t in TIMES {
        let time = Estimate::<f64>::spelling(&t.to_string().parse::<Number>().unwrap(), &());
        let found = run.force(node, &time, Side::Right).unwrap();
        let (truth, place) = (force(k, per_mass, t), format!("k = {k:e}, t = {t}"));
        // The closed form has some roundings of its own.
        let off = (found.value() - truth).abs();
        assert!(off <= found.bound() + 4e-15, "{place}: {found:?} is off by {off:e}");
        assert!(found.bound() < 1e-12, "{place}: {found:?}");
    }
}

/// A bar that strikes a mass through a spring of 10³ … 10¹² EA/L.
#[test]
fn a_stiff_spring_between_a_mass_and_a_bar_costs_no_more_pieces() {
    for decade in 3..=12 {
        let scene = format!(
            "[[body]]\nmass = 1\nvelocity = 0\n\
             [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = -1\njoint = {{ stiffness = 1e{decade} }}\n\
             [ends]\nbottom = \"free\"\n[run]\ntime = 3"
        );
        let (run, k) = (run(&scene), 10f64.powi(decade));
        assert!(run.pieces() < 200, "{} pieces for 1e{decade}", run.pieces());
        check(&run, 1, (k, 1.0));
        // A rigid contact ends with the reflection at t = 2; the spring, a few times 1/k later.
        let release = run.contacts()[0].release.clone().unwrap();
        let late = (release.value() - 2.0) * k;
        assert!((0.1..1.0).contains(&late), "released {late}/k late for 1e{decade}");
    }
}

/// A mass that moves between two half-infinite bars at rest, bonded to them by two stiff springs.
#[test]
fn a_mass_between_two_stiff_springs_follows_the_closed_form() {
    let bar = |more: &str| format!("[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = 0\n{more}");
    for decade in [4, 7, 10] {
        let joint = format!("joint = {{ stiffness = 1e{decade}, bonded = true }}\n");
        let scene = format!(
            "{}[[body]]\nmass = 3\nvelocity = -1\n{joint}{}[ends]\nbottom = {{ infinite = 1 }}\ntop = {{ infinite = 1 }}\n\
             [run]\ntime = 2",
            bar(""),
            bar(&joint)
        );
        let (run, k) = (run(&scene), 10f64.powi(decade));
        assert!(run.pieces() < 200, "{} pieces for 1e{decade}", run.pieces());
        check(&run, 1, (k, 2.0 / 3.0));
    }
}

/// Returns the force of a spring k below a mass m under a bar of impedance one, all of which moves down at the speed
/// one, before a reflection returns.
///
/// **Source**: `mV′ = f − (V + 1)` and `f′ = −kV`, so that `mf″ + f′ + kf = k` with f(0) = 0 and f′(0) = k.
fn force_below_a_mass(k: f64, m: f64, t: f64) -> f64 {
    let square = 1.0 - 4.0 * m * k;
    if square < 0.0 {
        let [decay, rate] = [0.5 / m, (-square).sqrt() / (2.0 * m)];
        return 1.0 - (-decay * t).exp() * ((rate * t).cos() + (decay - k) / rate * (rate * t).sin());
    }
    let [slow, fast] = [-2.0 * k / (1.0 + square.sqrt()), -(1.0 + square.sqrt()) / (2.0 * m)];
    let share = (k + fast) / (slow - fast);
    1.0 + share * (slow * t).exp() - (1.0 + share) * (fast * t).exp()
}

/// A mass of 10⁻¹² … 10⁻² of a bar below it, bonded to the ground by a spring: together they decay in a time of m/Z, or
/// the mass decays before the spring does.
#[test]
fn a_light_mass_between_a_spring_and_a_bar_costs_no_more_pieces() {
    let mut compared = 0;
    for decade in 2..=12 {
        for k in [10.0, 1e4, 1e7] {
            let scene = format!(
                "[[body]]\nmass = 1e-{decade}\nvelocity = -1\n\
                 [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = -1\njoint = \"bonded\"\n\
                 [ends]\nbottom = {{ stiffness = {k} }}\n[run]\ntime = 3"
            );
            let (run, m) = (run(&scene), 10f64.powi(-decade));
            // An oscillation of many periods before it has decayed has its own pieces.
            let periods = (k * m).sqrt();
            assert!((run.pieces() as f64) < 2000.0 + 1000.0 * periods, "{} pieces, m = {m:e}, k = {k:e}", run.pieces());
            for t in TIMES {
                let time = Estimate::<f64>::spelling(&t.to_string().parse::<Number>().unwrap(), &());
                let found = run.force(0, &time, Side::Right).unwrap();
                let off = (found.value() - force_below_a_mass(k, m, t)).abs();
                let place = format!("m = {m:e}, k = {k:e}, t = {t}: {found:?} is off by {off:e}");
                // The exponents of the closed form are known to a rounding of `k t` and of `√(k/m) t`.
                let own = 1e-15 * (4.0 + (k / m).sqrt() * t * (-t / (2.0 * m)).exp() + k * t * (-k * t).exp());
                assert!(off <= found.bound() + own, "{place}");
                assert!(found.bound() < 1e-9, "{place}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 165);
}

/// A mass between two bars with springs of 10⁵ and 10⁹ EA/L: the slow spring decays while the fast one follows.
#[test]
fn springs_of_different_stiffness_beside_a_mass_keep_the_energy() {
    let scene = "[[body]]\nlength = 1\nmodulus = 1\ndensity = 1\n\
                 [[body]]\nmass = 0.7\ngap = 0.05\njoint = { stiffness = 1e5 }\n\
                 [[body]]\nlength = 1.3\nmodulus = 2\ndensity = 1\nvelocity = -1\ngap = 0.02\n\
                 joint = { stiffness = 1e9 }\n[run]\ntime = 4";
    let run = run(scene);
    assert!(run.pieces() < 2000 && run.events().len() == 4, "{} pieces, {:?}", run.pieces(), run.events());
    for time in ["0.021", "0.3", "0.9", "2.1", "3.7"] {
        let time = Estimate::<f64>::spelling(&time.parse::<Number>().unwrap(), &());
        let mut energy = 0.0;
        for body in 0..3 {
            let sums = run.sums(body, &time).unwrap();
            energy += sums.kinetic.value() + sums.strain.value();
        }
        for node in [1, 2] {
            energy += run.spring_energies(node, &time, Side::Right).unwrap()[0].value();
        }
        assert!((energy - 0.65).abs() < 1e-12, "{energy} at {}", time.value());
    }
}

/// Two opposite pushes on a mass, one of which begins later by less than a rounding of doubles. They balance before and
/// after, but one acts alone in between.
#[test]
fn opposite_pushes_on_a_mass_within_a_rounding_are_within_its_bound() {
    let bar = |joint: &str| format!("[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = 0\n{joint}");
    let end = |from: &str| {
        format!("{{ force = [[0, 0], [\"{from}\", 0], [\"{from}\", 1], [\"0.500001\", 1], [\"0.500001\", 0]] }}")
    };
    let scene = format!(
        "{}[[body]]\nmass = 1\nvelocity = 0\njoint = \"bonded\"\n{}[ends]\nbottom = {}\ntop = {}\n[run]\ntime = 2",
        bar(""),
        bar("joint = \"bonded\"\n"),
        end("1/2"),
        end("0.50000000000000001")
    );
    let time = Estimate::<f64>::spelling(&"1.50001".parse::<Number>().unwrap(), &());
    let velocity = run(&scene).sums(1, &time).unwrap().velocity;
    // A wave doubles at the mass, and the impulse of the wave that begins later is smaller by 1e-17.
    let truth = 2e-17;
    assert!(velocity.bound() > truth && velocity.bound() < 1e-14, "{velocity:?}");
}

/// Bars that strike a mass whose time, m/Z, is less than a rounding of the time at which its waves return.
///
/// **Source**: the mass rests at first, so that the forces are 1 and 2, and ends at −1/3; the waves that return move
/// the ends at −1 and 1.
#[test]
fn waves_shorter_than_a_rounding_of_their_time_are_not_lost() {
    for decade in [3, 15, 16, 17, 18, 20] {
        let scene = format!(
            "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = 1\n\
             [[body]]\nmass = 1e-{decade}\nvelocity = 0\n\
             [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 2\nvelocity = -1\n[run]\ntime = 3"
        );
        let history = ChainScene::parse(&scene).unwrap().chain.solve(Numbers::default()).unwrap();
        let events = history.listing().unwrap().events.clone();
        for (node, rate) in [(1, 2.0 / 3.0), (2, 4.0 / 3.0)] {
            let event = events.iter().find(|event| event.kind == EventKind::Release && event.node == node).unwrap();
            let (found, bound) = (event.after.to_f64(), event.after.bound().to_f64());
            assert!((found - rate).abs() <= bound + 1e-15, "{found} ± {bound} at joint {node} for 1e-{decade}");
        }
    }
}

/// A load that rises and falls within a rounding of its time is a doubt of doubles beside a mass: what happens
/// meanwhile is not known. The same load over a longer time is none.
#[test]
fn a_load_that_rises_and_falls_within_a_rounding_is_a_doubt() {
    let doubt = |middle: &str, last: &str| {
        let scene = format!(
            "[[body]]\nmass = 1\nvelocity = 0\n\
             [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = 0\njoint = \"bonded\"\n\
             [ends]\nbottom = \"free\"\n\
             top = {{ force = [[0, 0], [\"0.5\", 0], [\"{middle}\", 1], [\"{last}\", 0]] }}\n[run]\ntime = 2"
        );
        run(&scene).undetermined_from()
    };
    assert!(doubt("0.50000000000000001", "0.50000000000000002").is_some_and(|t| (t - 0.5).abs() < 1e-9));
    assert_eq!(doubt("0.6", "0.7"), None);
}

/// The same load on a bar: doubles have no bound of its slope, and longer numbers answer. The impulse of 1e-17 pulls or
/// pushes the centre of a mass of one from t = 1/2 on.
#[test]
fn a_number_without_a_bound_in_doubles_comes_from_longer_numbers() {
    let scene = "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n[ends]\nbottom = \"free\"\n\
        top = { force = [[0, 0], [\"0.5\", 0], [\"0.50000000000000001\", 1], [\"0.50000000000000002\", 0]] }\n\
        [run]\ntime = 2";
    let chain = ChainScene::parse(scene).unwrap().chain;
    let history = chain.solve(Numbers::default()).unwrap();
    let rate = ChainColumn::read("h_rate.1", &chain).unwrap();
    let found = history.value(rate, &"0.7".parse().unwrap(), Side::Right).unwrap();
    assert!((found.to_f64().abs() - 1e-17).abs() < 1e-26 && found.bound().to_f64() < 1e-24, "{found}");
}

/// A light mass that strikes a clamped bar: its force decays as `e^(−t/m)`, far below all roundings, and does not
/// vanish until the reflection returns at t = 2. The release follows at 2 + m.
///
/// **Source**: the second piece of the delay equation, `(1 + 2(t − 2)/m) e^(−(t − 2)/m)` times the sign that makes it
/// end at t − 2 = m, but for `e^(−2/m)`.
#[test]
fn the_force_of_a_light_mass_decays_without_a_doubt() {
    for decade in 2..=10 {
        let scene = format!(
            "[ends]\nbottom = \"fixed\"\n[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n\
             [[body]]\nmass = 1e-{decade}\nvelocity = -1\n[run]\ntime = 3"
        );
        let chain = ChainScene::parse(&scene).unwrap().chain;
        let history = chain.solve(Numbers::default()).unwrap();
        let listing = history.listing().unwrap();
        let release = listing.contacts[0].release.as_ref().unwrap();
        let off = (release.to_f64() - 2.0 - 10f64.powi(-decade)).abs();
        assert!(off <= release.bound().to_f64() + 1e-15, "{release:?} is off by {off:e} for 1e-{decade}");
        assert_eq!(history.warnings(), [], "for 1e-{decade}");
    }
}
