//! Random chains with springs, dashpots and rigid masses: doubles within their bounds of 128 bits.

use std::ops::ControlFlow;

use dalembert::chain::{Body, Chain, ChainRun, Spring};
use dalembert::number::{Scalar, Wide};
use dalembert::{Ending, Estimate, Number, Side};

use crate::common;
use crate::random_chain::Random;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// Returns a chain of bars and rigid masses with springs and dashpots at many of its nodes, if it is one.
fn random_chain(random: &mut Random) -> Option<Chain> {
    let body = |random: &mut Random| match random.below(4) {
        0 => Body::rigid(random.positive()).with_velocity(random.signed()),
        _ => random.body(),
    };
    let lowest = body(random);
    let mut builder = Chain::builder(lowest).bottom(random.end()).top(random.end()).until(5.into());
    let joints = 1 + random.below(3) as usize;
    for _ in 0..joints {
        let (above, gap) = (body(random), random.positive());
        builder = if random.below(3) == 0 { builder.bonded(above) } else { builder.contact(gap, above) };
    }
    for node in 0..=joints + 1 {
        if random.below(3) > 0 {
            let damping = if random.below(2) == 0 { 0.into() } else { random.positive() };
            builder = builder.spring(node, Spring { stiffness: random.positive(), damping });
        }
    }
    let gravity = if random.below(2) == 0 { 0.into() } else { random.positive() };
    builder.gravity(gravity).build().ok().filter(Chain::is_soft)
}

/// Checks that events, forces, gaps and sums of random chains in doubles are within their bounds of those in 128 bits.
/// Returns the number of chains that both tell, of events, and of numbers compared.
fn compare_random_chains(mut random: Random, count: usize) -> [usize; 3] {
    let (mut chains, mut told, mut events, mut compared) = (0, 0, 0, 0);
    let mut differing = Vec::new();
    while chains < count {
        let Some(chain) = random_chain(&mut random) else { continue };
        let observe = |_: usize, _: usize| ControlFlow::Continue(());
        let doubles = ChainRun::<Estimate<f64>>::new(&chain, &(), &observe).unwrap();
        let longer = ChainRun::<Estimate<Wide<2>>>::new(&chain, &(), &observe).unwrap();
        chains += 1;
        let is_told = |run: (&Ending, Option<f64>)| *run.0 == Ending::Time && run.1.is_none();
        if !is_told((doubles.ending(), doubles.undetermined_from()))
            || !is_told((longer.ending(), longer.undetermined_from()))
        {
            continue;
        }
        told += 1;
        let mut check = |place: &str, found: &Estimate<f64>, expected: &Estimate<Wide<2>>| {
            let apart = (expected.clone() - &expected.double(*found.value())).to_f64().abs();
            assert!(
                apart <= found.bound() + 1e-30 * found.value().abs(),
                "{place}: {} ± {:e} is off by {apart:e} in {chain:?}",
                found.value(),
                found.bound()
            );
            compared += 1;
        };
        if doubles.events().len() != longer.events().len() {
            differing.push(format!("{:?} are not {:?} in {chain:?}", doubles.events(), longer.events()));
            continue;
        }
        for (found, expected) in doubles.events().iter().zip(longer.events()) {
            let at = |name: &str| format!("{name} of {:?} at node {}, t = {}", found.kind, found.node, found.t.value());
            check("event", &found.t, &expected.t);
            check(&at("gap rate before"), &found.before, &expected.before);
            check(&at("gap rate after"), &found.after, &expected.after);
            events += 1;
        }
        for (found, expected) in doubles.contacts().iter().zip(longer.contacts()) {
            check("impulse", &found.impulse, &expected.impulse);
            check("peak", &found.peak, &expected.peak);
            check("time of the peak", &found.peak_time, &expected.peak_time);
        }
        for time in ["0.377", "1.713", "3.091", "4.657"] {
            let short = Estimate::<f64>::spelling(&number(time), &());
            let long = Estimate::<Wide<2>>::spelling(&number(time), &());
            for node in 0..=chain.bodies().len() {
                let side = Side::Right;
                check("force", &doubles.force(node, &short, side).unwrap(), &longer.force(node, &long, side).unwrap());
                check("gap", &doubles.gap(node, &short).unwrap(), &longer.gap(node, &long).unwrap());
                let [stored, lost] = doubles.spring_energies(node, &short, Side::Right).unwrap();
                let [long_stored, long_lost] = longer.spring_energies(node, &long, Side::Right).unwrap();
                check("spring energy", &stored, &long_stored);
                check("dissipated", &lost, &long_lost);
            }
            for body in 0..chain.bodies().len() {
                let (found, expected) = (doubles.sums(body, &short).unwrap(), longer.sums(body, &long).unwrap());
                check("centre", &found.displacement, &expected.displacement);
                check("velocity", &found.velocity, &expected.velocity);
                check("kinetic", &found.kinetic, &expected.kinetic);
                check("strain", &found.strain, &expected.strain);
            }
        }
    }
    assert!(differing.is_empty(), "{} chains have other events:\n{}", differing.len(), differing.join("\n"));
    [told, events, compared]
}

#[test]
fn doubles_of_random_chains_are_within_their_bounds() {
    let [told, events, compared] = compare_random_chains(Random(0x2545_f491_4f6c_dd1d), 65);
    assert!(told > 50 && events > 100 && compared > 3_000, "{told} chains, {events} events, {compared} numbers");
}

#[test]
#[ignore = "minutes: make explore"]
fn doubles_of_many_random_chains_are_within_their_bounds() {
    let [told, events, compared] = compare_random_chains(Random(common::Random::explored() | 1), 1000);
    println!("{told} chains, {events} events, {compared} numbers");
    assert!(told > 800 && events > 1_500 && compared > 50_000, "{told} chains, {events} events, {compared} numbers");
}
