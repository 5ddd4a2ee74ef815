//! Chains of bars in doubles with bounds: the elements are wave pieces, so that the throughput is breaks per second.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use dalembert::Estimate;
use dalembert::chain::{Body, Chain, ChainRun, End, Joint, Spring};
use dalembert::number::{Number, Wide};

/// Two bars of impedance 1 and 2 between walls; the second one has this length.
fn two_bars(length: &str, joint: Joint, until: i64) -> Chain {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let wall = || End::Ground { gap: number("0.1"), velocity: Vec::new() };
    let lower = Body::new(1.into(), 1.into(), 1.into()).with_velocity(number("0.3"));
    let upper = Body::new(number(length), 1.into(), 2.into()).with_velocity((-1).into());
    let builder = Chain::builder(lower).bottom(wall()).top(wall()).until(until.into());
    let builder = match joint {
        Joint::Contact { gap } => builder.contact(gap, upper),
        Joint::Bonded => builder.bonded(upper),
    };
    builder.build().unwrap()
}

fn breaks(c: &mut Criterion) {
    let contact = || Joint::Contact { gap: "0.1".parse().unwrap() };
    let cases = [
        ("bonded, 7:5", "5/7", Joint::Bonded, 20),
        ("bonded, 7:5", "5/7", Joint::Bonded, 40),
        ("in contact, 3:2", "2/3", contact(), 20),
        ("in contact, 3:2", "2/3", contact(), 40),
        // Out of the cache: 72 000 and 220 000 breaks.
        ("in contact, 3:2", "2/3", contact(), 80),
        ("bonded, 7:5", "5/7", Joint::Bonded, 80),
    ];
    let mut group = c.benchmark_group("chain, a break");
    group.sample_size(30);
    for (name, length, joint, until) in cases {
        let chain = two_bars(length, joint, until);
        let run = |chain: &Chain| ChainRun::<Estimate<f64>>::new(chain, &(), &|_, _| ControlFlow::Continue(()));
        let pieces = run(&chain).unwrap().pieces();
        group.throughput(Throughput::Elements(pieces as u64));
        group.bench_with_input(BenchmarkId::new(name, until), &chain, |b, chain| {
            b.iter(|| run(black_box(chain)).unwrap().pieces());
        });
    }
    group.finish();
}

/// A free rod on a spring of 100 EA/L under gravity, up to its tenth contact, and a mass on a clamped rod up to its
/// release.
fn soft(c: &mut Criterion) {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let rod = |speed: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(speed.into());
    let ground = End::Ground { gap: 0.into(), velocity: Vec::new() };
    let spring = Spring { stiffness: 100.into(), damping: 0.into() };
    let bounces = Chain::builder(rod(-1)).bottom(ground).spring(0, spring).gravity(1.into()).until(number("22.9"));
    let mass = Body::rigid(6.into()).with_velocity((-1).into());
    let struck = Chain::builder(rod(0)).bottom(End::Velocity(Vec::new())).contact(0.into(), mass).until(8.into());
    let mut group = c.benchmark_group("soft chain, a piece");
    group.sample_size(10);
    for (name, chain) in [("ten contacts on 100 EA/L", bounces), ("a mass on a clamped rod", struck)] {
        let chain = chain.build().unwrap();
        let doubles =
            || ChainRun::<Estimate<f64>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap().pieces();
        let limbs =
            || ChainRun::<Estimate<Wide<2>>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap().pieces();
        group.throughput(Throughput::Elements(doubles() as u64));
        group.bench_function(BenchmarkId::new(name, "doubles"), |b| b.iter(|| black_box(doubles())));
        group.throughput(Throughput::Elements(limbs() as u64));
        group.bench_function(BenchmarkId::new(name, "128 bits"), |b| b.iter(|| black_box(limbs())));
    }
    group.finish();
}

criterion_group!(benches, breaks, soft);
criterion_main!(benches);
