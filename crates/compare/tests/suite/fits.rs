//! Fits: the values of the scene that explain data best.

use dalembert::quantity::UnitSystem;
use dalembert::{Parameter, Problem, Quantity, Side, Top, Units};
use dalembert_compare::data::Source;
use dalembert_compare::{Options, Prepared};
use serde_json::Value;

/// A sequence of pseudorandom numbers (SplitMix64).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * (((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// The values of a rod that starts above the ground: length, wave speed, damping, gravity, speed, gap.
fn rod(values: [f64; 6], time: f64) -> Problem {
    let [length, wave_speed, damping, gravity, speed, gap] = values;
    let rod = Problem::builder().length(length).wave_speed(wave_speed).damping(damping).gravity(gravity);
    rod.impact_speed(speed).gap(gap).time(time).build().unwrap()
}

const NAMES: [&str; 6] = ["length", "wave_speed", "damping", "gravity", "impact_speed", "gap"];

/// What of `columns` at `times` is `data`, fitted from `start`.
fn fitted(start: &Problem, names: &[&str], times: &[f64], columns: &[Quantity], data: Vec<Vec<f64>>) -> Value {
    let units = Units::new(start, UnitSystem::Si);
    let all = std::iter::once(times.to_vec()).chain(data).map(Ok).collect();
    let header = std::iter::once("t".to_string()).chain(columns.iter().map(|column| column.name().to_string()));
    let source = Source::from_columns("data", header.collect(), all);
    let fit: Vec<Parameter> = names.iter().map(|name| name.parse().unwrap()).collect();
    let options = Options { fit, ..Options::default() };
    let prepared = Prepared::new(start, &units, None, vec![source], &options).unwrap();
    let compared = prepared.compare(std::sync::Arc::new(|_, _| std::ops::ControlFlow::Continue(()))).unwrap();
    compared.json(None)["fit"].clone()
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

/// Every combination of a size, of damping and of a gap, once.
const RODS: usize = 12;

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
        let problem = |values| rod(values, 2.2 * trip);
        let truth = [length, wave_speed, damping, gravity, speed, gap];
        let start = truth.map(|value| value * random.between(0.95, 1.05));
        let names: Vec<&str> =
            NAMES.iter().zip(truth).filter(|(_, value)| *value > 0.0).map(|(name, _)| *name).collect();
        let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 40.0 * 2.2 * trip).collect();
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
        // 61 samples of noise: the standard deviation of their correlation is 1/8.
        assert!(fit["correlation"].as_f64().unwrap().abs() < 0.5, "{fit}");
        for (value, truth) in fit["values"].as_array().unwrap().iter().zip([1.0, 9.81]) {
            let off = (value["value"].as_f64().unwrap() - truth).abs();
            count += 1;
            within += usize::from(off <= 2.0 * value["error"].as_f64().unwrap());
        }
    }
    println!("{within} of {count}");
    assert!(count == 400 && within >= 365, "{within} of {count}");
}
