//! Pictures, as multiples of solving alone: ten undamped and ten damped bounces, drawn as a sheet of four.

#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dalembert::{Problem, Units};
use dalembert_plot::Drawing;

fn plot(criterion: &mut Criterion) {
    for (name, damping) in [("undamped", "0"), ("damped", "0.01")] {
        let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).damping(damping);
        let rod = rod.impacts(10).build().unwrap();
        criterion.bench_function(&format!("ten {name} bounces, solved"), |b| b.iter(|| black_box(&rod).doubles()));
        criterion.bench_function(&format!("ten {name} bounces, solved and drawn"), |b| {
            b.iter(|| Drawing::default().draw(&black_box(&rod).doubles().unwrap(), Units::default()).unwrap());
        });
    }
}

criterion_group!(benches, plot);
criterion_main!(benches);
