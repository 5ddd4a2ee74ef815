//! Floats of fixed limbs, each beside MPFR of the same bits in the same run: a product and a sum as the march writes
//! them, division, square root, exp, and a march of ten damped impacts.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use dalembert::engine::Damped;
use dalembert::number::{Analytic, Wide};
use dalembert::special::RoundedSpecial;
use dalembert::{Float, Number, Problem, Run};

/// Numbers between −1 and 1 with digits to the end.
fn numbers<S: Analytic>(like: &S) -> Vec<S> {
    (0..100).map(|k| (like.int(3 * k + 1).sqrt() * &like.int(1 - 2 * (k % 2))) / like.int(20)).collect()
}

type Group<'a> = BenchmarkGroup<'a, criterion::measurement::WallTime>;

fn operations<S: Analytic>(group: &mut Group<'_>, name: &str, like: &S) {
    let (list, x) = (numbers(like), like.int(2).sqrt() / like.int(3));
    let mut each = |operation: &str, of: &dyn Fn(&S) -> S| {
        group.bench_function(format!("{operation}, {name}"), |b| {
            b.iter(|| list.iter().for_each(|y| drop(black_box(of(black_box(y))))));
        });
    };
    each("100 quotients", &|y| x.clone() / y);
    each("100 square roots", &|y| y.magnitude().sqrt());
    each("100 exp", &|y| y.exp());
    group.bench_function(format!("100 products and sums, {name}"), |b| {
        b.iter(|| black_box(&list).iter().fold(x.clone(), |sum, y| sum.clone() * &x + y));
    });
}

fn arithmetic(criterion: &mut Criterion) {
    fn beside<const N: usize>(criterion: &mut Criterion) {
        let mut group = criterion.benchmark_group(format!("{} bits", 64 * N));
        operations(&mut group, "limbs", &Wide::<N>::from(1));
        operations(&mut group, "MPFR", &Float::with_val(64 * N as u32, 1));
        group.finish();
    }
    beside::<2>(criterion);
    beside::<3>(criterion);
    beside::<4>(criterion);
    beside::<6>(criterion);
}

/// Ten impacts with c = L = g = 1, r = 1/10, μ = 10, to 15 digits.
fn march(criterion: &mut Criterion) {
    let number = Number::from;
    let mut problem = Problem::uniform(number(1), number(1), number(1), number(10));
    problem = problem.to_builder().damping("0.1").build().unwrap();
    problem = problem.with_run(Run::Impacts(10)).unwrap();
    let mut group = criterion.benchmark_group("ten damped impacts to 15 digits");
    group.sample_size(10);
    fn run<S: RoundedSpecial>(group: &mut Group<'_>, name: &str, problem: &Problem, precision: &S::Precision) {
        group.bench_function(name, |b| b.iter(|| Damped::<S>::solve(black_box(problem), precision, 15.0).unwrap()));
    }
    run::<f64>(&mut group, "doubles", &problem, &());
    run::<Wide<2>>(&mut group, "128 bits, limbs", &problem, &());
    run::<Float>(&mut group, "128 bits, MPFR", &problem, &128);
    run::<Wide<3>>(&mut group, "192 bits, limbs", &problem, &());
    run::<Float>(&mut group, "192 bits, MPFR", &problem, &192);
    run::<Wide<4>>(&mut group, "256 bits, limbs", &problem, &());
    run::<Float>(&mut group, "256 bits, MPFR", &problem, &256);
    group.finish();
}

criterion_group!(benches, arithmetic, march);
criterion_main!(benches);
