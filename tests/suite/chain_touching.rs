//! Soft chains whose bodies touch at the start, and whose breaks meet by different ways: doubles decide them without a
//! doubt. Against closed forms and proofs.

use std::ops::ControlFlow;

use dalembert::chain::{Body, Chain, ChainColumn, ChainHistory, ChainRun, End, Spring};
use dalembert::{ChainScene, Estimate, EventKind, Number, Numbers, Side};

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

fn spring(stiffness: &str, damping: &str) -> Spring {
    Spring { stiffness: number(stiffness), damping: number(damping) }
}

/// Returns node, kind and time of each event.
fn events(history: &ChainHistory) -> Vec<(usize, EventKind, f64)> {
    let listing = history.listing().unwrap();
    listing.events.iter().map(|event| (event.node, event.kind, event.t.to_f64())).collect()
}

fn is_decided_by_doubles(chain: &Chain) -> bool {
    let run = ChainRun::<Estimate<f64>>::new(chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
    run.undetermined_from().is_none() && *run.ending() == dalembert::Ending::Time
}

/// **Source**: with `ω² = k/m` the compressions of both springs are `(sin ωs ± sin(√3 ωs)/√3)/2ω` until the first is
/// zero, and that of the other one is harmonic with `√2 ω` then.
#[test]
fn a_cradle_of_masses_that_touch_follows_its_modes() {
    let mass = |velocity: i64| Body::rigid(1.into()).with_velocity(velocity.into());
    for gap in ["0", "0.1"] {
        let builder = Chain::builder(mass(1)).contact(number(gap), mass(0)).contact(0.into(), mass(0));
        let springs = [1, 2].into_iter().fold(builder, |builder, node| builder.spring(node, spring("100", "0")));
        let chain = springs.until(1.into()).build().unwrap();
        assert!(is_decided_by_doubles(&chain), "gap {gap}");
        for numbers in [Numbers::Double(None), Numbers::Certified(20)] {
            let history = chain.solve(numbers).unwrap();
            assert!(history.warnings().is_empty(), "{numbers}");
            let found = events(&history);
            let begun = gap.parse::<f64>().unwrap();
            let kinds: Vec<(usize, EventKind)> = found.iter().map(|(node, kind, _)| (*node, *kind)).collect();
            let [impact, release] = [EventKind::Impact, EventKind::Release];
            assert_eq!(kinds, [(1, impact), (2, impact), (1, release), (2, release)]);
            assert!((found[0].2 - begun).abs() < 1e-15 && found[0].2 == found[1].2, "{found:?}");
            let (omega, root) = (10.0, 3f64.sqrt());
            let s = found[2].2 - begun;
            let modes = [(omega * s).sin(), (root * omega * s).sin() / root];
            assert!((modes[0] + modes[1]).abs() < 1e-13, "{modes:?}");
            let depth = (modes[0] - modes[1]) / (2.0 * omega);
            let rate = ((omega * s).cos() - (root * omega * s).cos()) / 2.0;
            let fast = 2f64.sqrt() * omega;
            let last = s + (std::f64::consts::PI - (fast * depth).atan2(rate)) / fast;
            assert!((found[3].2 - begun - last).abs() < 1e-13, "{} for {last}", found[3].2 - begun);
        }
    }
}

/// Returns the value of a column, with its bound.
fn value(history: &ChainHistory, name: &str, t: &str) -> [f64; 2] {
    let column = ChainColumn::read(name, history.chain()).unwrap();
    let found = history.value(column, &number(t), Side::Right).unwrap();
    [found.to_f64(), found.log2_error().exp2()]
}

/// **Source**: two masses on two springs without a load have the frequencies `ω² = (3 ± √5)/2`, and move from the start
/// to and fro about `−2` and `−3`.
#[test]
fn a_stack_that_touches_its_springs_is_loaded_at_once() {
    for velocity in ["0", "-0.3", "-1/3"] {
        let v = number(velocity).to_f64();
        let mass = || Body::rigid(1.into()).with_velocity(number(velocity));
        let chain = Chain::builder(mass())
            .bottom(End::Ground { gap: 0.into(), velocity: Vec::new() })
            .contact(0.into(), mass())
            .spring(0, spring("1", "0"))
            .spring(1, spring("1", "0"))
            .gravity(1.into())
            .until(30.into())
            .build()
            .unwrap();
        assert!(is_decided_by_doubles(&chain));
        // Each mode has the shape (1, 2 − ω²) and takes its share of (−2, −3), and of the velocities.
        let squares = [-1.0, 1.0].map(|sign| (3.0 + sign * 5f64.sqrt()) / 2.0);
        let [a, b] = squares.map(|square| 2.0 - square);
        let shares = [(-3.0 + 2.0 * b) / (a - b), (3.0 - 2.0 * a) / (a - b)];
        let speeds = [v * (1.0 - b) / (a - b), v * (a - 1.0) / (a - b)];
        let mode = |k: usize, t: f64| {
            let omega = squares[k].sqrt();
            shares[k] * (1.0 - (omega * t).cos()) + speeds[k] * (omega * t).sin() / omega
        };
        for numbers in [Numbers::Double(None), Numbers::Certified(20)] {
            let history = chain.solve(numbers).unwrap();
            assert!(history.warnings().is_empty(), "{numbers}");
            let found = events(&history);
            assert_eq!(found[..2], [(0, EventKind::Impact, 0.0), (1, EventKind::Impact, 0.0)]);
            let (node, kind, t) = found[2];
            assert_eq!(kind, EventKind::Release);
            let places = |t: f64| [mode(0, t) + mode(1, t), a * mode(0, t) + b * mode(1, t)];
            let [low, high] = places(t);
            let compression = if node == 0 { -low } else { low - high };
            assert!(compression.abs() < 1e-12, "{compression} at {t}");
            for (name, expected) in ["u_end.1", "u_end.2"].into_iter().zip(places(0.5)) {
                let [found, _] = value(&history, name, "0.5");
                assert!((found - expected).abs() < 1e-13, "{name} {found} for {expected}");
            }
        }
    }
}

/// Bodies that fly together at a velocity that no double holds: nothing happens before they land, and their energy
/// stays.
#[test]
fn bodies_that_fly_together_do_not_touch_each_other() {
    let bar = Body::new(1.into(), 1.into(), 1.into()).with_velocity(number("-1/3"));
    let chain = Chain::builder(bar)
        .bottom(End::Ground { gap: 1.into(), velocity: Vec::new() })
        .contact(0.into(), Body::rigid(2.into()).with_velocity(number("-1/3")))
        .spring(1, spring("5", "0"))
        .gravity(number("1/2"))
        .until(5.into())
        .build()
        .unwrap();
    assert!(is_decided_by_doubles(&chain));
    for numbers in [Numbers::Double(None), Numbers::Certified(20)] {
        let history = chain.solve(numbers).unwrap();
        assert!(history.warnings().is_empty(), "{numbers}");
        // 1 − t/3 − t²/4 = 0.
        let landing = (10f64.sqrt() - 1.0) * 2.0 / 3.0;
        let first = &events(&history)[0];
        assert!(first.0 == 0 && (first.2 - landing).abs() < 1e-14, "{first:?} for {landing}");
        let flown = ["u_end.1", "u_end.2", "h.1"].map(|name| value(&history, name, "1.25")[0]);
        let height = -1.25 / 3.0 - 1.25 * 1.25 / 4.0;
        assert!(flown.iter().all(|found| (found - height).abs() < 1e-14), "{flown:?} for {height}");
        let energy = |t: &str| {
            let parts = ["E_total.1", "E_total.2", "spring_energy.1"].map(|name| value(&history, name, t));
            parts.iter().fold([0.0, 0.0], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
        };
        let [begun, _] = energy("0");
        assert!((begun - 1.5 / 9.0).abs() < 1e-15, "{begun}");
        for t in ["1", "2", "2.5", "3.7", "4.9"] {
            let [now, bound] = energy(t);
            assert!((now - begun).abs() <= bound + 1e-15 && bound < 1e-9, "{now} ± {bound} at {t}");
        }
    }
}

/// Masses that fly together and land in a row of springs: each contact closes as the first does. **Source**: after the
/// landing the masses move as `t³`, `t⁵` and `t⁶`, so that the last gap falls from zero at once.
#[test]
fn masses_that_land_together_close_together() {
    let text = r#"
[[body]]
mass = 2
velocity = 1
[[body]]
mass = "1/3"
velocity = 1
joint = { stiffness = 37.5, bonded = true }
[[body]]
mass = 3
velocity = 1
joint = { stiffness = 1, damping = 0.3 }
[[body]]
mass = 0.5
velocity = 1
joint = { stiffness = 37.5, damping = 0.5 }
[ends]
bottom = { gap = 0.05, stiffness = 1 }
top = "free"
[gravity]
acceleration = 9.81
[run]
time = 1
"#;
    let chain = ChainScene::parse(text).unwrap().chain;
    assert!(is_decided_by_doubles(&chain));
    // −1/20 = t − 9.81 t²/2.
    let landing = (1.0 + (1.0f64 + 0.1 * 9.81).sqrt()) / 9.81;
    for numbers in [Numbers::Double(None), Numbers::Certified(15)] {
        let found = events(&chain.solve(numbers).unwrap());
        let nodes: Vec<usize> = found.iter().map(|(node, ..)| *node).collect();
        assert_eq!(nodes, [0, 2, 3]);
        assert!(
            found.iter().all(|(_, kind, t)| *kind == EventKind::Impact && (t - landing).abs() < 1e-14),
            "{found:?}"
        );
    }
}

/// Waves that have left one break by different ways, and meet in a closed contact, come at one time.
#[test]
fn breaks_that_meet_by_different_ways_come_at_one_time() {
    let text = r#"
[[body]]
length = 1
wave_speed = 1
impedance = "1/2"
velocity = [[0, -1], [1, -0.5]]
strain = [[0, -0.2], ["1/3", -0.2], ["1/3", 0.05], [1, 0]]
[[body]]
length = "1/4"
wave_speed = 1
impedance = "1/2"
velocity = [[0, 1], ["1/8", -0.5], ["1/8", 0], ["1/4", 1]]
displacement = [[0, 0.1], ["1/16", 0.05], ["1/4", -0.1]]
[[body]]
mass = 6
velocity = -0.5
joint = { stiffness = 1, damping = 0.3 }
[ends]
bottom = { velocity = [[0, -0.3], ["1/2", 1], [2, -0.3], [2, 0], [3, 0]], gap = "1/4", stiffness = 1000, damping = 0 }
top = { gap = 0.1, stiffness = 200, damping = 0 }
[gravity]
acceleration = 2
[run]
time = 4
"#;
    let chain = ChainScene::parse(text).unwrap().chain;
    assert!(is_decided_by_doubles(&chain));
    let proved = chain.with_until(number("3/2")).unwrap().solve(Numbers::Certified(15)).unwrap();
    let found = chain.solve(Numbers::Double(None)).unwrap();
    assert!(found.warnings().is_empty() && proved.warnings().is_empty());
    let [found, proved] = [events(&found), events(&proved)];
    assert!(proved.len() > 7, "{proved:?}");
    for ((node, kind, t), (other_node, other_kind, other)) in found.iter().zip(&proved) {
        assert!(node == other_node && kind == other_kind && (t - other).abs() < 1e-11, "{found:?} {proved:?}");
    }
}

/// Breaks that reach a contact at rest, at a time that no double holds, decide it by their Taylor series: from a bar
/// that a third one has struck, and from a load with a kink.
#[test]
fn contacts_at_rest_are_decided_by_breaks_that_leave_zero() {
    let struck = "body = [\n{ length = 1, wave_speed = 1, impedance = 1 },\n\
                  { length = 1, wave_speed = 1.3, impedance = 3, joint = { stiffness = 20 } },\n\
                  { length = 0.7, wave_speed = 0.9, impedance = 1, velocity = -1, joint = { stiffness = 20 } },\n]\n\
                  ends.bottom = { gap = 0, stiffness = 20 }\ngravity.acceleration = 0.5\nrun.time = 5";
    let loaded = "body = [\n{ length = 1, wave_speed = 1, impedance = 1 },\n\
                  { length = 1, wave_speed = 3, impedance = 2, joint = { stiffness = 7 } },\n]\n\
                  [ends]\nbottom = 'fixed'\ntop = { force = [[0, 0], [0.4, 0], [1, -1]] }\n[run]\ntime = 2";
    let [default, proved] = [Numbers::Double(None), Numbers::Certified(15)];
    // The wave needs 1/1.3 from the struck joint to the one below, and 1/3 from the load to the joint.
    let cases = [(struck, default, 1.0 / 1.3), (struck, proved, 1.0 / 1.3), (loaded, default, 0.4 + 1.0 / 3.0)];
    for (scene, numbers, at) in cases {
        let chain = ChainScene::parse(scene).unwrap().chain;
        assert!(is_decided_by_doubles(&chain), "{scene}");
        let history = chain.solve(numbers).unwrap();
        assert!(history.warnings().is_empty(), "{numbers}: {scene}");
        let found = events(&history);
        let is_struck = |(node, kind, t): &(usize, EventKind, f64)| {
            *node == 1 && *kind == EventKind::Impact && (t - at).abs() < 1e-15
        };
        assert!(found.iter().any(is_struck), "{numbers}: {found:?}");
    }
}

/// A bar and a mass that lies on it fall at −1 together, so that nothing acts between them until the bar hits the
/// ground at 1/3: its end has −1 before and 0 after that, although no enclosure tells the event from 1/3.
#[test]
fn both_limits_at_an_event_are_told() {
    let text = "body = [{ length = 1, wave_speed = 1, impedance = 1, velocity = -1 },\n\
                { mass = 1, gap = 0, velocity = -1 }]\nends.bottom = { gap = '1/3' }\nrun.time = 4";
    let chain = ChainScene::parse(text).unwrap().chain;
    assert!(is_decided_by_doubles(&chain));
    let column = |name: &str| ChainColumn::read(name, &chain).unwrap();
    for numbers in [Numbers::Double(None), Numbers::Digits(20), Numbers::Certified(15)] {
        let history = chain.solve(numbers).unwrap();
        for (side, velocity, force) in [(Side::Left, -1.0, 0.0), (Side::Right, 0.0, 1.0)] {
            for (name, expected) in [("v_end.1", velocity), ("force.bottom", force)] {
                let found = history.value_at_event(column(name), 0, side).unwrap();
                let off = (found.to_f64() - expected).abs();
                assert!(off <= found.bound().to_f64() && off < 1e-14, "{numbers} {name} {side:?}: {found:?}");
                assert!(found.bound().to_f64() < 1e-14, "{numbers} {name} {side:?}: {found:?}");
            }
        }
    }
}

/// A damped stop comes back just before a front pushes it again, and closes just after it: the gap at the front is
/// 1.2e-5, known within 1.2e-4. Doubles do not tell this from a stop that is still behind, which closes at the front,
/// and say so.
#[test]
fn a_stop_that_has_just_come_back_closes_after_the_front() {
    let text = "body = [{ length = 1, wave_speed = '5/3', impedance = 1, velocity = -0.5 },\n\
        { length = 1, wave_speed = '2/3', impedance = '4/3', velocity = [[0, 3], [1, 4]], gap = '5/3' },\n\
        { length = 3, wave_speed = 1.5, impedance = 0.5, velocity = [[0, 0], [3, -0.5]], gap = 2,\n\
          displacement = [[0, 0], [3, -0.5]], joint = { stiffness = '4/3', damping = 0.25 } },\n\
        { length = 0.5, wave_speed = 5, impedance = 1, velocity = [[0, '4/3'], [0.5, -0.5]],\n\
          displacement = [[0, 0], [0.5, 1.5]], joint = { stiffness = 3, bonded = true } }]\n\
        ends = { bottom = { infinite = 0.5 }, top = { gap = 0.5, stiffness = 0.5, damping = 4 } }\nrun.time = 4.3";
    let chain = ChainScene::parse(text).unwrap().chain;
    let run = ChainRun::<Estimate<f64>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
    assert!(run.undetermined_from().is_some_and(|from| from < 4.224), "{:?}", run.undetermined_from());
    let found = events(&chain.solve(Numbers::Double(None)).unwrap());
    let closes = |(node, kind, t): &(usize, EventKind, f64)| {
        *node == 4 && *kind == EventKind::Impact && (t - 4.2239816387967).abs() < 1e-12
    };
    assert!(found.iter().any(closes), "{found:?}");
}
