//! Cost of a proof: the same answers in doubles, in long numbers and in enclosures, with the exact numbers inside
//! and without; and the march of a chaotic history, a piece at a time.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dalembert::engine::{ContactHistory, FirstContact, Limits, Motion, Scaled, Undamped, Until, march, unobserved};
use dalembert::number::{Answer, IntervalPrecision, Scalar};
use dalembert::{Estimate, Interval, Number, Parameters, Problem, Run, Side};
use rug::Float;

fn rod(damping: &str, gravity: &str, length: &str, speed: &str) -> Problem {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let mut problem = Problem::uniform(number(length), 1.into(), number(gravity), number(speed));
    problem = problem.to_builder().damping(number(damping)).build().unwrap();
    problem
}

/// μ = 1 to t = 36, with a tangential landing and irrational times: events and centre of mass.
fn undamped(c: &mut Criterion) {
    let mut group = c.benchmark_group("μ = 1 to t = 36");
    let mut problem = rod("0", "1", "1", "1");
    problem = problem.with_run(Run::Time(36.into())).unwrap();
    group.bench_function("doubles", |b| {
        b.iter(|| Undamped::<Estimate<f64>>::solve(black_box(&problem), &()).unwrap().events().len());
    });
    for bits in [256, 3400] {
        group.bench_function(format!("{bits} bits"), |b| {
            b.iter(|| Undamped::<Estimate<Float>>::solve(black_box(&problem), &bits).unwrap().events().len());
        });
        group.bench_function(format!("{bits} bits, proved"), |b| {
            let exact = IntervalPrecision::with_exact(bits);
            b.iter(|| Undamped::<Interval>::solve(black_box(&problem), &exact).unwrap().events().len());
        });
    }
    group.finish();
}

/// The first contact of Figure 1, r = 3.0, whose bounce comes in the fourth round trip.
fn first_contact(c: &mut Criterion) {
    let mut group = c.benchmark_group("first contact, R = 3");
    let problem = rod("3", "0", "1/2", "1");
    for bits in [256u32, 3400] {
        let precision = IntervalPrecision::with_exact(bits);
        let contact = FirstContact::new(&Parameters::<Float>::of(&problem, &bits).unwrap().carry());
        let form = FirstContact::new(&Parameters::<Interval>::of(&problem, &precision).unwrap());
        let time = Float::with_val(bits, 2.5).carry();
        let proved = Interval::from_number(&"5/2".parse().unwrap(), &precision);
        group.bench_function(format!("stress, {bits} bits"), |b| {
            b.iter(|| contact.strain(black_box(&time), Side::Right));
        });
        group.bench_function(format!("stress, {bits} bits, proved"), |b| {
            b.iter(|| form.strain(black_box(&proved), Side::Right));
        });
        group.bench_function(format!("t_b, {bits} bits"), |b| b.iter(|| black_box(&contact).bounce()));
        group.bench_function(format!("t_b, {bits} bits, proved"), |b| {
            b.iter(|| ContactHistory::<Interval>::solve(black_box(&problem), &precision).unwrap());
        });
    }
    let problem = rod("0.2", "1", "1", "5");
    let precision = IntervalPrecision::with_exact(3400);
    let contact = ContactHistory::<Interval>::solve(&problem, &precision).unwrap();
    group.sample_size(10);
    group.bench_function("E_z of figure 4, 3400 bits, proved", |b| {
        b.iter(|| contact.energy(black_box(&contact.end())).unwrap().vibrational);
    });
    group.finish();
}

/// Ten damped impacts, r = 0.1, μ = 10: the march in doubles, and the one whose events are proved.
fn bounces(c: &mut Criterion) {
    let mut group = c.benchmark_group("ten damped impacts");
    let mut problem = rod("0.1", "1", "1", "10");
    problem = problem.with_run(Run::Impacts(10)).unwrap();
    group.sample_size(10);
    group.bench_function("doubles", |b| b.iter(|| black_box(&problem).doubles().unwrap().events().len()));
    for digits in [15, 30] {
        group.bench_function(format!("{digits} proved digits"), |b| {
            b.iter(|| black_box(&problem).certified(digits).unwrap().events().len());
        });
    }
    group.bench_function("30 digits", |b| b.iter(|| black_box(&problem).digits(30).unwrap().events().len()));
    group.finish();
}

/// A piece of the chaotic march, μ = 3/2 to t = 200, with what is behind forgotten.
fn chaotic(c: &mut Criterion) {
    let mut group = c.benchmark_group("chaotic, a piece");
    let mut problem = rod("0", "1", "1", "3/2");
    problem = problem.with_run(Run::Time(200.into())).unwrap();
    let limits = Limits::keeping_from(&problem, 200.0);
    let scaled = Scaled::<Estimate<Float>>::of(&problem, &240).unwrap();
    let until = Until::Time { trip: 100, age: Estimate::exact(Float::new(240)) };
    let pieces = std::cell::Cell::new(0);
    let count = |_, now| {
        pieces.set(now as u64);
        ControlFlow::Continue(())
    };
    march(&scaled, &until, Limits::default(), &count).unwrap();
    group.throughput(Throughput::Elements(pieces.get()));
    group.bench_function("240 bits", |b| b.iter(|| march(black_box(&scaled), &until, limits, &unobserved).unwrap()));
    let scaled = Scaled::<Estimate<f64>>::of(&problem, &()).unwrap();
    let until = Until::Time { trip: 100, age: Estimate::exact(0.0) };
    group.bench_function("doubles, which lose it at t = 105", |b| {
        b.iter(|| march(black_box(&scaled), &until, limits, &unobserved).unwrap());
    });
    group.finish();
}

criterion_group!(benches, undamped, first_contact, bounces, chaotic);
criterion_main!(benches);
