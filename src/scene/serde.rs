//! Scenes and problems as data: tables with the keys of a scene file, numbers as texts.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use toml::{Table, Value};

use super::{Scene, Target};

use crate::number::Number;
use crate::problem::{Parameter, Problem, Top, Written};
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

/// Replaces the texts of numbers by numbers of TOML where these spell them.
fn spell_plainly(value: &mut Value) {
    match value {
        Value::Table(table) => table.iter_mut().for_each(|(_, value)| spell_plainly(value)),
        Value::Array(list) => list.iter_mut().for_each(spell_plainly),
        Value::String(text) => {
            let Ok(number) = text.parse::<Number>() else { return };
            let double = Some(number.to_f64()).filter(|x| Written::from(*x).number() == Ok(&number));
            *value = match (text.parse::<i64>(), double) {
                (Ok(whole), _) => whole.into(),
                (_, Some(double)) => double.into(),
                _ => return,
            };
        }
        _ => (),
    }
}

fn target_table(target: &Target) -> Table {
    let (is_over_time, published) = (target.quantity.needs() == Needs::Time, &target.published);
    let entries = [
        ("quantity", Some(target.quantity.name().into())),
        ("time", target.time.as_ref().map(text)),
        ("side", is_over_time.then(|| target.side.name().into())),
        ("contact", (!is_over_time).then(|| Value::from(target.contact as i64))),
        ("origin", target.from_start.then(|| "start".into())),
        ("published", Some(text(&published.value))),
        ("within", published.within.as_ref().map(text)),
        ("source", Some(published.source.as_str().into())),
        ("note", published.note.as_deref().map(Value::from)),
        ("expected", published.differs.then(|| "differs".into())),
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
        let units = UnitSystem::ALL.iter().find(|(_, units)| *units == self.units && *units != UnitSystem::default());
        if let Some((name, _)) = units {
            table.insert("units".into(), (*name).into());
        }
        if let Some((accuracy, run)) = self.accuracy.zip(table.get_mut("run").and_then(Value::as_table_mut)) {
            run.insert("accuracy".into(), accuracy.into());
        }
        if let Some(publication) = &self.publication {
            table.insert("publication".into(), Table::try_from(publication).unwrap_or_default().into());
        }
        if !self.targets.is_empty() {
            let targets: Vec<Value> = self.targets.iter().map(|target| target_table(target).into()).collect();
            table.insert("target".into(), targets.into());
        }
        table.serialize(serializer)
    }
}

/// Builds the scene of a problem in SI units, without a title.
impl From<Problem> for Scene {
    fn from(problem: Problem) -> Self {
        let source = toml::to_string(&problem).unwrap_or_default();
        let (title, units, accuracy) = (None, UnitSystem::default(), None);
        let (publication, targets, lines) = (None, Vec::new(), Vec::new());
        Scene { title, units, problem, accuracy, publication, targets, source, lines }
    }
}

impl Scene {
    /// Returns the scene as TOML, from its values: without the comments of its [source](Scene::source), and with plain
    /// numbers where these spell the same.
    ///
    /// ```
    /// use dalembert::{Problem, Scene};
    /// let rod = Problem::builder().length(1).wave_speed("0.5").impact_speed("10/3").build()?;
    /// let text = Scene::from(rod).to_toml();
    /// assert!(text.contains("[impact]\nspeed = \"10/3\"\n") && text.contains("[rod]\nlength = 1\nwave_speed = 0.5\n"));
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn to_toml(&self) -> String {
        let mut table = Table::try_from(self).unwrap_or_default();
        table.iter_mut().filter(|(_, value)| value.is_table()).for_each(|(_, value)| spell_plainly(value));
        toml::to_string(&table).unwrap_or_default()
    }
}

/// Reads and checks the structure of a scene file. The [source](Scene::source) of the scene is that structure in TOML.
impl<'de> Deserialize<'de> for Scene {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}
