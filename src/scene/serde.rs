//! Scenes and problems as data: tables with the keys of a scene file, numbers as texts.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use toml::{Table, Value};

use super::{Scene, Target};

use crate::number::Number;
use crate::problem::{Parameter, Problem, Top};
use crate::quantity::{Needs, UnitSystem};

/// Writes the parameters that are given, in the tables of a scene file.
fn problem_table(problem: &Problem) -> Table {
    let mut tables = Table::new();
    for parameter in Parameter::ALL.iter().copied() {
        let value = match (parameter, parameter.given(problem), parameter.list(problem)) {
            (Parameter::Top, ..) if problem.top() == Top::Fixed => Value::from("fixed"),
            // A scene file has a whole number of impacts.
            (Parameter::Impacts, Some(count), _) => Value::from(count.to_f64() as i64),
            (_, Some(number), _) => text(&number),
            (_, None, Some(points)) if !points.is_empty() => {
                points.iter().map(|(x, value)| Value::from(vec![text(x), text(value)])).collect::<Vec<_>>().into()
            }
            _ => continue,
        };
        let (table, key) = parameter.table_and_key();
        let table = tables.entry(table).or_insert_with(|| Table::new().into());
        if let Some(table) = table.as_table_mut() {
            table.insert(key.into(), value);
        }
    }
    tables
}

fn text(number: &Number) -> Value {
    Value::from(number.to_string())
}

fn target_table(target: &Target) -> Table {
    let is_over_time = target.quantity.needs() == Needs::Time;
    let entries = [
        ("quantity", Some(target.quantity.name().into())),
        ("time", target.time.as_ref().map(text)),
        ("side", is_over_time.then(|| target.side.name().into())),
        ("contact", (!is_over_time).then(|| Value::from(target.contact as i64))),
        ("origin", target.from_start.then(|| "start".into())),
        ("published", Some(text(&target.published))),
        ("within", target.within.as_ref().map(text)),
        ("source", Some(target.source.as_str().into())),
    ];
    entries.into_iter().filter_map(|(key, value)| Some((key.to_string(), value?))).collect()
}

/// Reads a scene from data that have the keys of a scene file.
fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Scene, D::Error> {
    let table = Table::deserialize(deserializer)?;
    let text = toml::to_string(&table).map_err(D::Error::custom)?;
    Scene::parse(&text)
        .map_err(|error| D::Error::custom(format_args!("found {}, expected {}", error.found, error.expected)))
}

/// Writes the tables of a scene file; numbers are texts, which keep fractions as they are.
impl Serialize for Problem {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        problem_table(self).serialize(serializer)
    }
}

/// Reads and checks the tables of a scene file.
impl<'de> Deserialize<'de> for Problem {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer).map(|scene| scene.problem)
    }
}

/// Writes the structure of a scene file; numbers are texts, which keep fractions as they are.
impl Serialize for Scene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut table = problem_table(&self.problem);
        if let Some(title) = &self.title {
            table.insert("title".into(), title.as_str().into());
        }
        if let Some((name, _)) = UnitSystem::ALL.iter().find(|(_, units)| *units == self.units) {
            table.insert("units".into(), (*name).into());
        }
        if let Some((accuracy, run)) = self.accuracy.zip(table.get_mut("run").and_then(Value::as_table_mut)) {
            run.insert("accuracy".into(), accuracy.into());
        }
        if !self.targets.is_empty() {
            let targets: Vec<Value> = self.targets.iter().map(|target| target_table(target).into()).collect();
            table.insert("target".into(), targets.into());
        }
        table.serialize(serializer)
    }
}

/// Reads and checks the structure of a scene file. The [source](Scene::source) of the scene is that structure in TOML.
impl<'de> Deserialize<'de> for Scene {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}
