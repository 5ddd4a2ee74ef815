//! The first contact in doubles: one stress value, one restitution, one energy, and Figure 4 with the part left of
//! its dots.

#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use dalembert::first_contact::{Bounce, FirstContact};
use dalembert::motion::Side;
use dalembert::number::Estimate;
use dalembert::problem::Parameters;
use dalembert::special::{i0_scaled, i1_scaled};
use dalembert::{Numbers, Plan, Problem, Question};

fn rod(damping: f64, speed: f64) -> Parameters<Estimate<f64>> {
    Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed }.carry()
}

fn restitution(damping: f64, speed: f64) -> Option<f64> {
    let contact = FirstContact::new(&rod(damping, speed));
    match contact.bounce() {
        Bounce::At { time, .. } => contact.rebound(&time).energy_restitution_squared().map(Estimate::into_value),
        _ => None,
    }
}

fn first_contact(criterion: &mut Criterion) {
    let contact = FirstContact::new(&rod(0.2, 5.0));
    // What a machine takes for two Bessel functions: the floor of everything below.
    criterion.bench_function("e^{−z} I₀(z) and I₁(z)", |b| {
        b.iter(|| i0_scaled(black_box(&0.26_f64)) + i1_scaled(black_box(&0.26_f64)));
    });
    criterion.bench_function("stress in the first round trip", |b| {
        b.iter(|| contact.strain(black_box(&Estimate::exact(1.3)), Side::Right));
    });
    criterion.bench_function("restitution, bounce at t₁", |b| b.iter(|| restitution(black_box(0.2), black_box(5.0))));
    criterion
        .bench_function("restitution, bounce after t₁", |b| b.iter(|| restitution(black_box(0.2), black_box(1.0))));
    criterion.bench_function("energy at t₁", |b| b.iter(|| contact.energy(black_box(&Estimate::exact(2.0)))));
    let late = Problem::uniform("1/2".parse().unwrap(), 1.into(), 0.into(), 1.into());
    let late = late.to_builder().damping(3).build().unwrap();
    let plan = Plan::of(&late, &Question::first_contact(Numbers::Double(Some(1e-12)))).unwrap();
    criterion.bench_function("t_b to 1e-12, g = 0, R = 3", |b| {
        b.iter(|| plan.solve(black_box(&late), Arc::new(dalembert::lattice::unobserved)).unwrap());
    });
    criterion.bench_function("figure 4, 4 × 1000 speeds", |b| {
        b.iter(|| {
            let mut sum = 0.0;
            for damping in [0.0, 0.1, 0.2, 0.3] {
                for k in 1..=1000 {
                    sum += restitution(damping, 12.5e-3 * f64::from(k)).unwrap_or(0.0);
                }
            }
            sum
        });
    });
}

criterion_group!(benches, first_contact);
criterion_main!(benches);
