//! Fits: the values of the scene that explain data best.

use std::fmt::Write as _;

use crate::common::Random;
use dalembert::quantity::UnitSystem;
use dalembert::{Parameter, Problem, Quantity, Side, Top, Units};
use dalembert_compare::data::Source;
use dalembert_compare::{Options, Prepared};
use serde_json::Value;

/// The values of a rod that starts above the ground: length, wave speed, damping, gravity, speed, gap.
fn rod(values: [f64; 6], time: f64) -> Problem {
    let [length, wave_speed, damping, gravity, speed, gap] = values;
    let rod = Problem::builder().length(length).wave_speed(wave_speed).damping(damping).gravity(gravity);
    rod.impact_speed(speed).gap(gap).time(time).build().unwrap()
}

const NAMES: [&str; 6] = ["length", "wave_speed", "damping", "gravity", "impact_speed", "gap"];

/// What of `columns` at `times` is `data`, fitted from `start`.
fn fitted(start: &Problem, names: &[&str], times: &[f64], columns: &[Quantity], data: Vec<Vec<f64>>) -> Value {
    let units = Units::of(start, UnitSystem::Si);
    let all = std::iter::once(times.to_vec()).chain(data).map(Ok).collect();
    let header = std::iter::once("t".to_string()).chain(columns.iter().map(|column| column.name().to_string()));
    let source = Source::arrays("data", header.collect(), all);
    let fit: Vec<Parameter> = names.iter().map(|name| name.parse().unwrap()).collect();
    let options = Options { fit, ..Options::default() };
    let prepared = Prepared::new(start, &units, None, vec![source], &options).unwrap();
    let compared = prepared.compare(std::sync::Arc::new(|_, _| std::ops::ControlFlow::Continue(()))).unwrap();
    compared.json(None, &units)["fit"].clone()
}

/// Six values, each off by up to 5 %: found again to 1e-9 from exact data in at most 20 steps.
#[test]
fn exact_data_give_their_values() {
    let truth = [1.0, 2.0, 0.05, 1.0, 1.0, 0.05];
    let off = [1.03, 0.97, 1.05, 0.96, 1.02, 0.95];
    let mut start = truth;
    start.iter_mut().zip(off).for_each(|(value, off)| *value *= off);
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 25.0).collect();
    let columns = [Quantity::EndDisplacement, Quantity::Strain, Quantity::TopDisplacement];
    let data = rod(truth, 1.6).doubles().unwrap().columns(&columns, &times, Some(Side::Right)).unwrap();
    let fit = fitted(&rod(start, 1.6), &NAMES, &times, &columns, data);
    assert!(fit["steps"].as_u64().unwrap() <= 20, "{fit}");
    assert_eq!(fit["values"].as_array().unwrap().len(), truth.len(), "{fit}");
    for (value, truth) in fit["values"].as_array().unwrap().iter().zip(truth) {
        assert!((value["value"].as_f64().unwrap() / truth - 1.0).abs() <= 1e-9, "{fit}");
    }
}

const RODS: usize = 16;

/// Rods of every size, damped and not, above the ground and on it, each value of the scene off by up to 5 %: found
/// again to 1e-9 from exact data, past the release and into the flight, in at most 20 steps.
#[test]
fn exact_data_of_many_rods_give_their_values() {
    let mut random = Random(1878);
    let columns = [Quantity::EndDisplacement, Quantity::Strain, Quantity::TopDisplacement];
    let (mut found, mut missed) = (0, Vec::new());
    for case in 0..RODS {
        // One in a unit of its own, a rod of rubber, and a bar of steel.
        let [length, wave_speed] = [[1.0, 1.0], [0.3, 60.0], [1.2, 5100.0]][case % 3];
        let [length, wave_speed] = [length, wave_speed].map(|x| x * random.between(0.8, 1.25));
        let trip = 2.0 * length / wave_speed;
        let speed = wave_speed * random.between(0.01, 0.1);
        let gravity = speed / trip / random.between(0.6, 4.0);
        let (damped, above) = (case % 2 == 0, case % 4 < 2);
        let damping = if damped { random.between(0.02, 0.3) / trip } else { 0.0 };
        let gap = if above { speed * trip * random.between(0.05, 0.2) } else { 0.0 };
        let problem = |[length, wave_speed, damping, gravity, speed, gap]: [f64; 6]| {
            let rod = Problem::builder().length(length).wave_speed(wave_speed).gravity(gravity).impact_speed(speed);
            let rod = if damped { rod.damping(damping) } else { rod };
            let rod = if above { rod.gap(gap) } else { rod };
            rod.time(2.2 * trip).build().unwrap()
        };
        let truth = [length, wave_speed, damping, gravity, speed, gap];
        let start = truth.map(|value| value * random.between(0.95, 1.05));
        let names: Vec<&str> =
            NAMES.iter().zip(truth).filter(|(_, value)| *value > 0.0).map(|(name, _)| *name).collect();
        let times: Vec<f64> = (0..=80).map(|k| f64::from(k) / 80.0 * 2.2 * trip).collect();
        let data = problem(truth).doubles().unwrap().columns(&columns, &times, Some(Side::Right)).unwrap();
        let fit = fitted(&problem(start), &names, &times, &columns, data);
        let values = fit["values"].as_array().unwrap();
        let off = values.iter().zip(truth.iter().filter(|value| **value > 0.0));
        let off = off.map(|(value, truth)| (value["value"].as_f64().unwrap() / truth - 1.0).abs()).fold(0.0, f64::max);
        if off <= 1e-9 && fit["steps"].as_u64().unwrap() <= 20 && values.len() == names.len() {
            found += 1;
        } else {
            missed.push(format!("{case}: off by {off:e} in {} steps", fit["steps"]));
        }
    }
    assert!(found == RODS, "{found} of {RODS}: {missed:#?}");
}

/// A held rod that starts compressed: a point of its start and its length, whose points go with it.
#[test]
fn a_start_is_fitted() {
    let rod = |length: f64, pushed: f64| {
        let rod = Problem::builder().length(length).wave_speed(1).top(Top::Fixed);
        rod.displacement([(0.0, pushed), (length / 2.0, pushed / 4.0), (length, 0.0)]).time(3).build().unwrap()
    };
    let times: Vec<f64> = (0..=60).map(|k| f64::from(k) / 20.0).collect();
    let columns = [Quantity::EndDisplacement, Quantity::Strain];
    let data = rod(1.0, 0.5).doubles().unwrap().columns(&columns, &times, Some(Side::Right)).unwrap();
    let names = ["length", "displacement[0]", "displacement[1]"];
    let fit = fitted(&rod(1.03, 0.48), &names, &times, &columns, data);
    for ((value, name), truth) in fit["values"].as_array().unwrap().iter().zip(names).zip([1.0, 0.5, 0.125]) {
        assert!(value["name"] == name && (value["value"].as_f64().unwrap() / truth - 1.0).abs() <= 1e-9, "{fit}");
    }
}

/// Without a force, a stress or a strain only L/c is told: no numbers are made up.
#[test]
fn what_data_do_not_tell() {
    let problem = rod([1.0, 2.0, 0.0, 1.0, 1.0, 0.05], 2.0);
    let folder = tempfile::TempDir::new().unwrap();
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 20.0).collect();
    let data = problem.doubles().unwrap().columns(&[Quantity::EndDisplacement], &times, Some(Side::Right)).unwrap();
    let mut text = String::from("t,u\n");
    times.iter().zip(&data[0]).for_each(|(time, u)| writeln!(text, "{time},{u:e}").unwrap());
    std::fs::write(folder.path().join("run.csv"), text).unwrap();
    let scene =
        "rod = { length = 1, wave_speed = 2.1 }\ngravity.acceleration = 1\nimpact = { speed = 1, gap = 0.05 }\n";
    std::fs::write(folder.path().join("rod.toml"), scene).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_dalembert"));
    let command = command.args(["compare", "rod.toml", "run.csv", "--fit", "length,wave_speed"]);
    let output = command.current_dir(folder.path()).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("run.csv: found data that do not tell length, wave_speed apart"), "{error}");
}

/// Two hundred measured bounces, with noise of 1e-4: impact speed and gravity within two standard errors in 95 %. Of
/// 200 × 2 values, each within two errors with a chance of 0.954, fewer than 365 are so once in 2,000.
#[test]
fn noisy_data_give_honest_errors() {
    let problem = |speed: f64, gravity: f64| rod([1.0, 20.0, 0.0, gravity, speed, 0.05], 0.6);
    let times: Vec<f64> = (0..=60).map(|k| f64::from(k) / 100.0).collect();
    let columns = [Quantity::Centre];
    let exact = problem(1.0, 9.81).doubles().unwrap().columns(&columns, &times, Some(Side::Right)).unwrap();
    // Twelve of its numbers make one of a normal distribution.
    let mut random = Random(1878);
    let (mut count, mut within) = (0, 0);
    for _ in 0..200 {
        let noisy = exact[0]
            .iter()
            .map(|h| h + 1e-4 * ((0..12).map(|_| random.between(0.0, 1.0)).sum::<f64>() - 6.0))
            .collect();
        let fit = fitted(&problem(1.02, 9.7), &["impact_speed", "gravity"], &times, &columns, vec![noisy]);
        for (value, truth) in fit["values"].as_array().unwrap().iter().zip([1.0, 9.81]) {
            let off = (value["value"].as_f64().unwrap() - truth).abs();
            count += 1;
            within += usize::from(off <= 2.0 * value["error"].as_f64().unwrap());
        }
    }
    println!("{within} of {count}");
    assert!(count == 400 && within >= 365, "{within} of {count}");
}

/// The examples: a measured bounce, whose truth is 0.42 and 9.81, and bounds for CI.
#[test]
fn the_examples() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let args = ["compare", "bounce.toml", "bounce.csv", "--fit", "speed,gravity", "--format", "json"];
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_dalembert"));
    let output = command.args(args).current_dir(folder).output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    for (value, truth) in report["fit"]["values"].as_array().unwrap().iter().zip([0.42, 9.81]) {
        let [value, error] = ["value", "error"].map(|key| value[key].as_f64().unwrap());
        assert!((value - truth).abs() <= 2.0 * error && error < 1e-3 * truth, "{report}");
    }
}
