//! Balances and symmetries of random chains, exactly in fractions.

use std::ops::ControlFlow;

use super::random_chain::Random;
use crate::chain::node::Gap;
use crate::chain::{Body, BodyMaterial, Chain, ChainRun, End, Joint, Points};
use crate::motion::Side;
use crate::number::{Number, Rational};

type Run = ChainRun<Rational>;

fn run(chain: &Chain) -> Run {
    Run::new(chain, &(), &|_, _| ControlFlow::Continue(())).unwrap()
}

fn zero() -> Rational {
    Rational::default()
}

fn ratio(p: i64, q: i64) -> Rational {
    Rational::from(p) / Rational::from(q)
}

/// Returns the impulse of the force of a node, and its work on the body below or above, up to the end of the run.
fn integrals(run: &Run, node: usize, body: usize, is_top: bool) -> [Rational; 2] {
    let stages = &run.nodes[node];
    let mut sums = [zero(), zero()];
    for (k, stage) in stages.iter().enumerate() {
        let (from, to) = (&stage.from, stages.get(k + 1).map_or(&run.end, |next| &next.from));
        if from >= to {
            continue;
        }
        let middle = (from.clone() + to) / Rational::from(2);
        let at = |time: &Rational, side: Side| {
            let velocity = run.end_field(body, is_top, time, side).unwrap().velocity;
            [run.force(node, time, side).unwrap(), velocity]
        };
        let [a, m, b] = [at(from, Side::Right), at(&middle, Side::Right), at(to, Side::Left)];
        // Simpson's rule is exact: force and velocity are linear.
        let simpson = |f: &dyn Fn(&[Rational; 2]) -> Rational| {
            (f(&a) + f(&m) * Rational::from(4) + f(&b)) * (to.clone() - from) / Rational::from(6)
        };
        sums[0] += simpson(&|[force, _]| force.clone());
        sums[1] += simpson(&|[force, velocity]| force.clone() * velocity);
    }
    sums
}

/// Checks momentum of each body and energy of the chain from the start to the end of the run.
fn balances(chain: &Chain, run: &Run) {
    let bodies = chain.bodies().len();
    let mut gained = zero();
    for (body, bar) in run.bars.iter().enumerate() {
        let mass = bar.impedance.clone() * &bar.length / &bar.wave_speed;
        let [before, after] = [&zero(), &run.end].map(|t| run.sums(body, t).unwrap());
        let [below, work_below] = integrals(run, body, body, false);
        let [above, work_above] = integrals(run, body + 1, body, true);
        let weight = mass.clone() * &run.gravity * &run.end;
        assert_eq!(mass * (after.velocity - before.velocity), below - above - weight, "momentum of {chain:?}");
        let energy = after.kinetic + after.strain + after.potential - before.kinetic - before.strain - before.potential;
        assert_eq!(energy, work_below.clone() - &work_above, "energy of body {body} of {chain:?}");
        gained += work_below - work_above;
    }
    let outside = integrals(run, 0, 0, false)[1].clone() - &integrals(run, bodies, bodies - 1, true)[1];
    assert_eq!(gained, outside, "work inside of {chain:?}");
}

/// Returns the occurrences at nodes, for comparison.
/// Checks that the gap of each joint is its first one and what the displacements of both ends add: zero where the joint
/// is bonded. Returns the number of open gaps.
fn gaps_follow_displacements(chain: &Chain, run: &Run) -> usize {
    let mut open = 0;
    for node in 1..chain.bodies().len() {
        let apart = |t: &Rational| {
            let end = |body, is_top| run.end_field(body, is_top, t, Side::Right).unwrap().displacement;
            end(node, false) - end(node - 1, true)
        };
        for part in [ratio(1, 7), ratio(5, 11), ratio(12, 13)] {
            let t = run.end().clone() * part;
            let expected = apart(&t) - apart(&zero()) + chain.start_gap(node).unwrap_or_default();
            let gap = run.gap(node, &t).unwrap();
            assert_eq!(gap, expected, "{chain:?} at {t}, node {node}");
            open += usize::from(gap > zero());
        }
    }
    open
}

fn events(run: &Run) -> Vec<(usize, String, Rational)> {
    run.events().iter().map(|event| (event.node, event.kind.to_string(), event.t.clone())).collect()
}

fn number(x: &Rational) -> Number {
    Number::of_rational(x).unwrap()
}

/// Applies `value` to the values of points, and `place` to their places.
fn mapped(points: &Points, place: impl Fn(Rational) -> Rational, value: impl Fn(Rational) -> Rational) -> Points {
    points.iter().map(|(x, v)| (number(&place(x.to_rational())), number(&value(v.to_rational())))).collect()
}

fn forces(run: &Run, node: usize) -> Vec<[Rational; 4]> {
    let pieces = run.force_pieces(node).into_iter();
    pieces.map(|piece| [piece.start, piece.end, piece.first, piece.last]).collect()
}

#[test]
fn momentum_and_energy_balance() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut contacts, mut gravity, mut gaps) = (0, 0, 0);
    for _ in 0..BALANCED {
        let chain = random.chain();
        let run = run(&chain);
        balances(&chain, &run);
        gaps += gaps_follow_displacements(&chain, &run);
        gravity += usize::from(!chain.gravity().is_zero());
        contacts += run.events().len();
        for touching in run.nodes.iter().flatten() {
            assert!(!matches!(&touching.gap, Gap::Open { at, .. } if *at < zero()));
        }
    }
    assert!(gravity > BALANCED / 3 && contacts > BALANCED, "{gravity} with gravity, {contacts} events");
    assert!(gaps > BALANCED, "{gaps} open gaps");
}

/// Number of random chains that are balanced; fewer in the slower fractions of a build without GMP.
const BALANCED: usize = if cfg!(feature = "mp") { 2000 } else { 200 };
/// Number of random chains of the symmetries, times three.
const COUNT: usize = 300;

#[test]
fn scaled_masses_scale_forces() {
    let mut random = Random(3);
    let mut compared = 0;
    for _ in 0..COUNT / 3 {
        let chain = random.chain();
        let by = |x: &Number| number(&(x.to_rational() * ratio(7, 3)));
        let mut heavier = chain.clone();
        for body in &mut heavier.bodies {
            let BodyMaterial::Impedance { impedance, .. } = &mut body.material else { unreachable!() };
            *impedance = by(impedance);
        }
        for end in &mut heavier.ends {
            match end {
                End::Force(points) => *points = mapped(points, |t| t, |f| f * ratio(7, 3)),
                End::Infinite { impedance: Some(impedance), .. } => *impedance = by(impedance),
                _ => (),
            }
        }
        let (one, other) = (run(&chain), run(&heavier));
        assert_eq!(events(&one), events(&other), "{chain:?}");
        for node in 0..=chain.bodies().len() {
            let expected = forces(&one, node).into_iter().map(|[a, b, f, g]| [a, b, f * ratio(7, 3), g * ratio(7, 3)]);
            assert_eq!(expected.collect::<Vec<_>>(), forces(&other, node));
            compared += 1;
        }
    }
    assert!(compared > COUNT);
}

#[test]
fn a_cut_changes_nothing() {
    let mut random = Random(5);
    let mut compared = 0;
    for _ in 0..COUNT / 3 {
        let chain = random.chain();
        let whole = &chain.bodies[0];
        let BodyMaterial::Impedance { wave_speed, impedance } = whole.material.clone() else { unreachable!() };
        let length = whole.length.to_rational();
        let at = length.clone() * ratio(2, 5);
        let part = |points: &Points, is_upper: bool| match &points[..] {
            [(_, a), (_, b)] => {
                let [a, b] = [a, b].map(Number::to_rational);
                let middle = (b.clone() - &a) * ratio(2, 5) + &a;
                let (size, ends) =
                    if is_upper { (length.clone() - &at, [middle, b]) } else { (at.clone(), [a, middle]) };
                [zero(), size].iter().map(number).zip(ends.iter().map(number)).collect()
            }
            _ => Vec::new(),
        };
        let cut = |is_upper: bool| {
            let size = if is_upper { length.clone() - &at } else { at.clone() };
            let body = Body::new(number(&size), wave_speed.clone(), impedance.clone());
            body.with_start(part(&whole.velocity, is_upper), part(&whole.displacement, is_upper))
        };
        let mut other = chain.clone();
        other.bodies.splice(0..1, [cut(false), cut(true)]);
        other.joints.insert(0, Joint::Bonded);
        let (one, two) = (run(&chain), run(&other));
        let moved: Vec<_> =
            events(&one).into_iter().map(|(node, kind, t)| (node + usize::from(node > 0), kind, t)).collect();
        assert_eq!(moved, events(&two), "{chain:?}");
        for node in 0..=chain.bodies().len() {
            assert_eq!(forces(&one, node), forces(&two, node + usize::from(node > 0)), "{chain:?}");
            compared += 1;
        }
    }
    assert!(compared > COUNT);
}

#[test]
fn motion_with_the_frame_changes_nothing() {
    let mut random = Random(7);
    let mut compared = 0;
    while compared < COUNT / 3 {
        let chain = random.chain();
        if chain.ends.iter().any(|end| matches!(end, End::Infinite { .. })) {
            continue;
        }
        let speed = ratio(3, 2);
        let mut moving = chain.clone();
        let shift = |points: &Points| match points.is_empty() {
            true => vec![(0.into(), number(&speed))],
            false => mapped(points, |t| t, |v| v + &speed),
        };
        for body in &mut moving.bodies {
            body.velocity = match body.velocity.is_empty() {
                true => body.clone().with_velocity(number(&speed)).velocity,
                false => mapped(&body.velocity, |x| x, |v| v + &speed),
            };
        }
        for end in &mut moving.ends {
            if let End::Velocity(points) | End::Ground { velocity: points, .. } = end {
                *points = shift(points);
            }
        }
        let (one, other) = (run(&chain), run(&moving));
        assert_eq!(events(&one), events(&other), "{chain:?}");
        (0..=chain.bodies().len()).for_each(|node| assert_eq!(forces(&one, node), forces(&other, node)));
        compared += 1;
    }
}

#[test]
fn a_mirror_changes_nothing() {
    let mut random = Random(11);
    let mut compared = 0;
    while compared < COUNT / 3 {
        let chain = random.chain().clone();
        if !chain.gravity().is_zero() {
            continue;
        }
        let mut mirrored = chain.clone();
        mirrored.bodies.reverse();
        mirrored.joints.reverse();
        mirrored.ends.reverse();
        for body in &mut mirrored.bodies {
            let length = body.length.to_rational();
            for points in [&mut body.velocity, &mut body.displacement] {
                *points = mapped(points, |x| length.clone() - x, |v| -v);
                points.reverse();
            }
        }
        for end in &mut mirrored.ends {
            if let End::Velocity(points) | End::Ground { velocity: points, .. } = end {
                *points = mapped(points, |t| t, |v| -v);
            }
        }
        let (one, other) = (run(&chain), run(&mirrored));
        let top = chain.bodies().len();
        let mut expected: Vec<_> = events(&one).into_iter().map(|(node, kind, t)| (top - node, kind, t)).collect();
        expected.sort_by(|a, b| a.2.cmp(&b.2).then(a.0.cmp(&b.0)));
        assert_eq!(expected, events(&other), "{chain:?}");
        (0..=top).for_each(|node| assert_eq!(forces(&one, node), forces(&other, top - node)));
        compared += 1;
    }
}

#[test]
fn a_ground_that_accelerates_away_leaves_a_gap() {
    // From rest, at −t up to t = 1: the gap is t²/2, and then t − 1/2.
    let ground = End::Ground { gap: 0.into(), velocity: vec![(0.into(), 0.into()), (1.into(), (-1).into())] };
    let bar = Body::new(1.into(), 1.into(), 1.into());
    let run = run(&Chain::builder(bar).bottom(ground).until(5.into()).build().unwrap());
    assert!(run.events().is_empty());
    for (t, gap) in [(ratio(1, 2), ratio(1, 8)), (ratio(1, 1), ratio(1, 2)), (ratio(2, 1), ratio(3, 2))] {
        assert_eq!(run.gap(0, &t).unwrap(), gap);
    }
}

#[test]
fn closed_forms_of_two_and_three_bars() {
    let text = |x: &str| x.parse::<Number>().unwrap();
    let numbers = |list: &[[&str; 4]]| -> Vec<[Rational; 4]> {
        list.iter().map(|row| row.map(|x| text(x).to_rational())).collect()
    };
    // OpenFOAM 7.1.2: E = 49 and 100.
    let bar = |modulus: i64| Body::elastic(10.into(), modulus.into(), text("0.01"), 1.into());
    let striker = bar(49).with_velocity(text("0.1"));
    let chain = Chain::builder(striker).contact(text("0.01"), bar(100)).until(text("1/2")).build().unwrap();
    let expected = numbers(&[
        ["0", "1/10", "0", "0"],
        ["1/10", "3/10", "7/170", "7/170"],
        ["3/10", "27/70", "21/2890", "21/2890"],
        ["27/70", "1/2", "0", "0"],
    ]);
    assert_eq!(forces(&run(&chain), 1), expected);
    // Three bars of Mota, Tezaur and Hoy.
    let bar = |velocity: i64| {
        Body::elastic(text("0.25"), text("1e9"), 1000.into(), text("1e-6")).with_velocity(velocity.into())
    };
    let chain = Chain::builder(bar(100)).contact(text("0.02"), bar(0)).contact(text("0.02"), bar(-100));
    let found = run(&chain.until(text("2e-3")).build().unwrap());
    let expected = numbers(&[
        ["0", "2e-4", "0", "0"],
        ["2e-4", "4.5e-4", "50", "50"],
        ["4.5e-4", "7e-4", "100", "100"],
        ["7e-4", "9.5e-4", "50", "50"],
        ["9.5e-4", "2e-3", "0", "0"],
    ]);
    assert_eq!(forces(&found, 1), expected);
    // A striker of Z = 9/4 on a half-infinite bar of Z = 1 is never released.
    let striker = Body::new(1.into(), 1.into(), text("9/4")).with_velocity((-1).into());
    let infinite = End::Infinite { impedance: Some(1.into()), gap: Some(0.into()) };
    let found = run(&Chain::builder(striker).bottom(infinite).until(9.into()).build().unwrap());
    for (n, [from, _, force, _]) in (0..).zip(forces(&found, 0)) {
        let power = (0..n).fold(ratio(9, 13), |f, _| f * ratio(5, 13));
        assert_eq!([from, force], [Rational::from(2 * n), power]);
    }
    assert_eq!(found.events().len(), 1);
}
