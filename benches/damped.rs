//! The damped rod: later impacts end to end, cost against simulated time and against damping, many digits, and what the
//! cells cost where there is no damping, beside the lattice that is used there.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use dalembert::engine::{Damped, Motion, Undamped};
use dalembert::{Estimate, Number, Numbers, Plan, Problem, Question, Run, Scene, TypedHistory};

/// A rod with c = L = g = 1, t₁ = 2.
fn rod(damping: &str, speed: &str, run: Run) -> Problem {
    let one = || Number::from(1);
    let mut problem = Problem::uniform(one(), one(), one(), speed.parse().unwrap());
    problem = problem.to_builder().damping(damping).build().unwrap();
    problem = problem.with_run(run).unwrap();
    problem
}

/// A rod under a fixed top, pressed on the ground, without gravity: it lands and leaves every `3 t₁/2` for ever, and
/// has as many rays after a thousand round trips as at the start.
fn periodic(trips: i64) -> Problem {
    let rod = Problem::builder().length(1).wave_speed(1).damping("1e-300").fixed_top();
    rod.displacement([(0, "1/2"), (1, "0")]).time(2 * trips).build().unwrap()
}

/// The events of a run in doubles, as planned, and their error.
fn planned(problem: &Problem, plan: &Plan) -> (usize, f64) {
    let observe = std::sync::Arc::new(dalembert::engine::unobserved);
    let motion = TypedHistory::<f64>::solve(black_box(problem), plan, observe).unwrap();
    (motion.events().len(), motion.error_estimate())
}

/// Weakly damped real rods with twenty impacts: thousands of round trips between two of them.
fn real(c: &mut Criterion) {
    let mut group = c.benchmark_group("twenty impacts of a real rod to 1e-9");
    let question = Question::run(Numbers::default());
    let rods = [
        ("steel", "0.5", "5172", "50", "1"),
        ("polymer", "0.06051", "2000", "0.7393", "0.7968"),
        ("wood", "0.07598", "4000", "0.6227", "0.02784"),
        ("rubber", "1", "50", "1", "0.1"),
    ];
    for (name, length, wave_speed, damping, height) in rods {
        let scene = format!(
            "rod = {{ length = {length}, wave_speed = {wave_speed}, damping = {damping} }}\n\
             impact = {{ drop_height = {height} }}\ngravity = {{ acceleration = 9.81 }}\nrun = {{ impacts = 20 }}"
        );
        let problem = Scene::parse(&scene).unwrap().problem;
        let plan = Plan::of(&problem, &question).unwrap();
        group.sample_size(10).bench_function(name, |b| b.iter(|| planned(&problem, &plan)));
    }
    group.finish();
}

fn impacts(c: &mut Criterion) {
    let mut group = c.benchmark_group("ten impacts to 1e-10");
    let question = Question::run(Numbers::Double(Some(1e-10)));
    for (damping, speed) in [("0.001", "3"), ("0.01", "3"), ("0.02", "10"), ("0.1", "10")] {
        let problem = rod(damping, speed, Run::Impacts(10));
        let plan = Plan::of(&problem, &question).unwrap();
        group.bench_function(format!("r = {damping}, μ = {speed}"), |b| b.iter(|| planned(&problem, &plan)));
    }
    group.finish();
    {
        let problem = rod("0.1", "3", Run::Impacts(2));
        let mut group = c.benchmark_group("50 digits");
        group.sample_size(10).bench_function("second contact, r = 0.1, μ = 3", |b| {
            b.iter(|| black_box(&problem).digits(50).unwrap().contacts().len());
        });
        group.finish();
    }
}

/// The elements are round trips.
fn time(c: &mut Criterion) {
    let mut group = c.benchmark_group("simulated time");
    group.sample_size(10);
    let march = |problem: &Problem| Damped::<f64>::solve(black_box(problem), &(), 12.0).unwrap().events().len();
    for trips in [10, 100, 1000] {
        group.throughput(Throughput::Elements(trips as u64));
        let problem = periodic(trips);
        group.bench_function(BenchmarkId::new("few rays, for ever", trips), |b| b.iter(|| march(&problem)));
        let problem = rod("0.5", "5", Run::Time(Number::from(2 * trips)));
        group.bench_function(BenchmarkId::new("settling", trips), |b| b.iter(|| march(&problem)));
    }
    group.finish();
    let mut group = c.benchmark_group("damping, ten round trips");
    for damping in ["1e-6", "0.01", "0.1", "1", "5", "10", "20", "50"] {
        let problem = rod(damping, "3", Run::Time(Number::from(20)));
        group.bench_function(BenchmarkId::new("r t₁ = 2 ×", damping), |b| b.iter(|| march(&problem)));
    }
    group.finish();
}

/// Without damping a plan takes the lattice, whose code knows no damping; this is what cells would take for the same
/// scene.
fn undamped(c: &mut Criterion) {
    let mut group = c.benchmark_group("without damping");
    let question = Question::run(Numbers::default());
    for impacts in [1, 10] {
        let problem = rod("", "3", Run::Impacts(impacts));
        assert!(problem.damping().is_none());
        group.bench_function(BenchmarkId::new("lattice, called directly", impacts), |b| {
            b.iter(|| Undamped::<Estimate<f64>>::solve(black_box(&problem), &()).unwrap().events().len());
        });
        let plan = Plan::of(&problem, &question).unwrap();
        group.bench_function(BenchmarkId::new("scene with no damping, as planned", impacts), |b| {
            b.iter(|| planned(&problem, &plan));
        });
        group.bench_function(BenchmarkId::new("cells with r = 0", impacts), |b| {
            b.iter(|| Damped::<f64>::solve(black_box(&problem), &(), 12.0).unwrap().events().len());
        });
    }
    group.finish();
}

criterion_group!(benches, impacts, real, time, undamped);
criterion_main!(benches);
