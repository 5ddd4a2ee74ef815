//! Cost of the derivatives of all events by one value, as a multiple of the run that has them: a line for each scene,
//! with the rung that the run was settled by.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use dalembert::{Parameter, Problem, Quantity, Run, Scene, builtin};

const EVENT: [Quantity; 4] =
    [Quantity::EventTime, Quantity::EventVelocity, Quantity::EventCentre, Quantity::EventCentreVelocity];

/// The median of some runs, in seconds.
fn seconds(mut run: impl FnMut()) -> f64 {
    let begin = Instant::now();
    let mut times = Vec::new();
    while times.len() < 3 || times.len() < 31 && begin.elapsed().as_secs_f64() < 0.3 {
        let begin = Instant::now();
        run();
        times.push(begin.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn rod(damping: &str, speed: &str, impacts: u32) -> Problem {
    let mut problem = Problem::uniform(1.into(), 1.into(), 1.into(), speed.parse().unwrap());
    problem = problem.to_builder().damping(damping).build().unwrap();
    problem = problem.with_run(Run::Impacts(impacts)).unwrap();
    problem
}

fn scenes() -> Vec<(String, Problem)> {
    let shipped = builtin::ALL.iter().map(|scene| {
        let problem = Scene::parse(scene.source).unwrap().problem;
        (scene.name.to_owned(), problem)
    });
    let rods = [("", 1), ("", 10), ("", 100), ("0.001", 10), ("0.02", 5), ("0.02", 10), ("0.1", 10)].map(|(r, n)| {
        let shown = if r.is_empty() { "0" } else { r };
        (format!("r = {shown}, μ = 3/2 g t₁, {n} impacts"), rod(r, "3", n))
    });
    let general = [1, 10, 30].map(|n| (format!("r = 0, μ = 1.37 g, {n} impacts"), rod("", "1.37", n)));
    shipped.chain(rods).chain(general).collect()
}

fn main() {
    // `cargo bench` and `cargo test` call it with arguments of their own.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    println!("{:44} {:>10} {:>9} {:>9} {:>9} {:>9}  rung", "scene", "run, ms", "speed", "length", "gravity", "damping");
    for (name, problem) in scenes() {
        let Ok(history) = problem.doubles() else { continue };
        let plain = seconds(|| {
            black_box(black_box(&problem).doubles().unwrap().events().len());
        });
        let ratio = |by: Parameter| {
            // A rod without damping or gravity is another problem than one with some.
            let other = match by {
                Parameter::Damping => problem.damping().is_none(),
                Parameter::Gravity => problem.gravity().is_none(),
                _ => false,
            };
            if other || history.derivatives(by, &EVENT).is_err() {
                return "-".to_owned();
            }
            let time = seconds(|| {
                black_box(history.derivatives(by, &EVENT).unwrap());
            });
            format!("{:.1}", time / plain)
        };
        let [speed, length, gravity, damping] =
            [Parameter::ImpactSpeed, Parameter::Length, Parameter::Gravity, Parameter::Damping].map(ratio);
        let (ms, rung) = (plain * 1e3, history.rung());
        println!("{name:44} {ms:10.4} {speed:>9} {length:>9} {gravity:>9} {damping:>9}  {rung:?}");
    }
}
