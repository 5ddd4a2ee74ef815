//! The undamped lattice: a first contact end to end, and pieces against the number of impacts.
//!
//! Each group has its own yardstick in the same run: `sqrt` for the first contact (one square root and a few sums are
//! what Corollary 1 itself takes), and the elements of `march` are pieces, so that its throughput is pieces per second.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use dalembert::engine::{Limits, Motion, Scaled, Undamped, Until, march, unobserved};
use dalembert::number::Bounded;
use dalembert::{Estimate, Numbers, Plan, Problem, Question, Run, Scene, builtin};

fn problem(speed: &str, run: Run) -> Problem {
    let one = || "1".parse().unwrap();
    let mut problem = Problem::uniform(one(), one(), one(), speed.parse().unwrap());
    problem = problem.with_run(run).unwrap();
    problem
}

fn first_contact(c: &mut Criterion) {
    let mut group = c.benchmark_group("first contact");
    let scene = Scene::parse(builtin::get("paper-weak").unwrap().source).unwrap();
    group.bench_function("scene to events and contacts, f64", |b| {
        b.iter(|| {
            let history = Undamped::<Estimate<f64>>::solve(black_box(&scene.problem), &()).unwrap();
            (history.events().len(), *history.contacts()[0].impulse.value())
        });
    });
    let question = Question::run(Numbers::default());
    group.bench_function("plan", |b| b.iter(|| Plan::of(black_box(&scene.problem), &question).unwrap()));
    group.bench_function("closed form of the bounce time, f64", |b| {
        b.iter(|| {
            let rod = dalembert::Parameters::<f64>::of(black_box(&scene.problem), &()).unwrap();
            dalembert_verify::paper::UndampedContact::new(&rod).unwrap().bounce_time()
        });
    });
    group.bench_function("scene to events and contacts, fractions", |b| {
        let problem = problem("3", Run::Impacts(1));
        b.iter(|| {
            let history = Undamped::<rug::Rational>::solve(black_box(&problem), &()).unwrap();
            (history.events().len(), history.contacts().len())
        });
    });
    group.finish();
}

/// The march alone: `periodic` keeps few breaks, `general` gains some with every event.
fn pieces<S: Bounded>(c: &mut Criterion, name: &str, precision: &S::Precision, speeds: &[(&str, &str, &[u32])]) {
    let mut group = c.benchmark_group(format!("march, {name}"));
    for (label, speed, impacts) in speeds {
        for impacts in *impacts {
            let scaled = Scaled::<S>::of(&problem(speed, Run::Impacts(*impacts)), precision).unwrap();
            let run = || march(&scaled, &Until::Contacts(*impacts), Limits::default(), &unobserved).unwrap();
            let count = run().trace.count();
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::new(*label, format!("{impacts} impacts, {count} pieces")), |b| {
                b.iter(run)
            });
        }
    }
    group.finish();
}

fn all_pieces(c: &mut Criterion) {
    const ALL: &[u32] = &[10, 100, 1000];
    pieces::<Estimate<f64>>(
        c,
        "f64",
        &(),
        &[("periodic", "3", ALL), ("tangential", "1", ALL), ("general", "3/2", ALL)],
    );
    {
        pieces::<rug::Rational>(c, "fractions", &(), &[("periodic", "3", ALL)]);
        pieces::<Estimate<rug::Float>>(c, "256 bits", &256, &[("periodic", "3", ALL), ("general", "3/2", &[10, 100])]);
    }
}

criterion_group!(benches, first_contact, all_pieces);
criterion_main!(benches);
