//! JSON: an object for each row.

use serde_json::{Map, Value};

use crate::mapped::mapped;
use crate::output::dataset::{Cell, Dataset};

/// The JSON Schema of histories, samples, golden files, comparisons and sweeps.
pub(crate) const SCHEMA: &str = include_str!("../schema.json");

/// Where the bounds of numbers stand in a row, each under the key of its number.
const UNCERTAINTY: &str = "uncertainty";
/// Where numbers may stand apart from the keys of a row; their bounds do without it.
const VALUES: &str = "values/";

impl Dataset {
    /// The header, and an object for each row; without a header the list of these.
    pub(crate) fn json(&self) -> Value {
        if self.header.is_empty() {
            return self.objects().into();
        }
        let header = self.header.iter().map(|(key, value)| ((*key).to_string(), value.clone()));
        header.chain([(self.list.to_string(), self.objects().into())]).collect()
    }

    /// The rows as objects.
    pub(in crate::output) fn objects(&self) -> Vec<Value> {
        mapped(&self.rows, |row| object(self, row))
    }
}

fn object(data: &Dataset, row: &[Cell]) -> Value {
    let (mut object, mut bounds) = (Map::new(), Map::new());
    for (column, cell) in data.columns.iter().zip(row) {
        let Some(key) = column.key.as_deref() else { continue };
        if column.is_optional && cell.is_empty() {
            continue;
        }
        let (value, bound) = match cell {
            Cell::Plain(value) => (value.clone(), Value::Null),
            Cell::Number(x) => (x.json(data.digits), x.json_bound(data.digits)),
            Cell::Numbers(all) => {
                let (values, bounds) =
                    (mapped(all, |x| x.json(data.digits)), mapped(all, |x| x.json_bound(data.digits)));
                (values.into(), bounds.into())
            }
        };
        insert(&mut object, key, value);
        if column.is_bounded {
            insert(&mut bounds, key.trim_start_matches(VALUES), bound);
        }
    }
    if !bounds.is_empty() {
        object.insert(UNCERTAINTY.into(), bounds.into());
    }
    object.into()
}

/// Puts `value` under `key`, which names the objects that it is in before a `/`.
fn insert(object: &mut Map<String, Value>, key: &str, value: Value) {
    match key.split_once('/') {
        None => drop(object.insert(key.into(), value)),
        Some((outer, inner)) => {
            if let Value::Object(object) = object.entry(outer).or_insert_with(|| Map::new().into()) {
                insert(object, inner, value);
            }
        }
    }
}
