//! Tests of the comparison as one program: small contact codes, seeded faults, fits, conventions.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

use std::sync::Arc;

use dalembert::engine;
use dalembert::{Scene, Units, builtin};
use dalembert_compare::data::Source;
use dalembert_compare::{Options, Prepared};
use serde_json::Value;

mod conventions;
mod faults;
mod fits;
mod peers;
mod verdicts;

/// The scene of this text, or the built-in scene of this name.
fn scene(text: &str) -> Scene {
    Scene::parse(builtin::get(text).map_or(text, |scene| scene.source)).unwrap()
}

/// The report on columns of data as JSON.
fn compare_columns(scene: &Scene, columns: &[(&str, Vec<f64>)], options: &Options) -> Value {
    let units = Units::new(&scene.problem, scene.units);
    let (names, values) = columns.iter().map(|(name, values)| (name.to_string(), Ok(values.clone()))).unzip();
    let source = Source::from_columns("data", names, values);
    let prepared = Prepared::new(&scene.problem, &units, scene.accuracy, vec![source], options).unwrap();
    prepared.compare(Arc::new(engine::unobserved)).unwrap().json(None)
}

/// The report on the rows of a contact code as JSON.
fn compare(text: &str, rows: &[peers::Row], options: &Options) -> Value {
    compare_columns(&scene(text), &peers::columns(rows), options)
}
