//! Data sets as JSON, CSV and NPZ.

use std::io::{self, Cursor};

use serde_json::{Map, Value as Json};

use super::column::{Column, Kind};
use super::dataset::{Cell, Dataset};
use super::npz::Npz;
use crate::failure::{Failure, cannot};
use crate::file::Format;
use dalembert::number::DOUBLE_DIGITS;

/// Key of the bounds of a row, each under the key of its number.
const UNCERTAINTY: &str = "uncertainty";
/// Prefix of the keys of numbers that stand in an object of their own; their bounds do without it.
const VALUES: &str = "values/";

impl Dataset {
    /// Returns the header and an object for each row; without a header the list of objects.
    pub(crate) fn json(&self) -> Json {
        let rows = Json::from(self.objects());
        let Json::Object(mut document) = self.header.clone() else { return rows };
        document.insert(self.list.into(), rows);
        document.into()
    }

    pub(super) fn objects(&self) -> Vec<Json> {
        self.rows.iter().map(|row| object(self, row)).collect()
    }

    /// Returns the rows below the names of their columns, the bounds of numbers in columns after all others, and the
    /// notes in comments above, which readers of CSV skip.
    pub(crate) fn csv(&self) -> Result<String, csv::Error> {
        let digits = if self.digits == 0 { DOUBLE_DIGITS } else { self.digits };
        let named = |column: &&Column| column.name.is_some();
        let with_unit = |column: &Column, suffix: &str| {
            let name = column.csv_name();
            if column.unit.is_empty() { format!("{name}{suffix}") } else { format!("{name}{suffix} [{}]", column.unit) }
        };
        let bounded = || self.columns.iter().filter(named).filter(|column| column.is_bounded);
        let names = self.columns.iter().filter(named).map(|column| with_unit(column, ""));
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(names.chain(bounded().map(|column| with_unit(column, "_uncertainty"))))?;
        for row in &self.rows {
            let cells = || self.columns.iter().zip(row).filter(|(column, _)| named(column));
            for (_, cell) in cells() {
                writer.write_field(cell.text(digits, ""))?;
            }
            for (_, cell) in cells().filter(|(column, _)| column.is_bounded) {
                writer.write_field(cell.bound_text(digits))?;
            }
            writer.write_record(None::<&[u8]>)?;
        }
        let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        let comments: String = self.notes.iter().map(|note| format!("# {note}\n")).collect::<Vec<_>>().concat();
        Ok(comments + &String::from_utf8_lossy(&bytes))
    }

    /// Returns an array for each column, of whole numbers where all are, otherwise of doubles, NaN where a number is
    /// missing; and the shape of the grid.
    pub(crate) fn npz(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Cursor::new(Vec::new());
        let mut npz = Npz::new(&mut bytes, true);
        let count = &[self.rows.len()];
        if !self.shape.is_empty() {
            npz.add("shape", &[self.shape.len()], self.shape.iter().map(|n| *n as i64).collect())?;
        }
        for (k, column) in self.columns.iter().enumerate() {
            let cells = self.rows.iter().map(|row| &row[k]);
            let Some(name) = column.name.as_deref().filter(|_| column.kind != Kind::Word) else { continue };
            let whole = |cell: &Cell| if let Cell::Plain(value) = cell { value.as_i64() } else { None };
            match cells.clone().map(whole).collect::<Option<Vec<i64>>>().filter(|all| !all.is_empty()) {
                Some(whole) => npz.add(name, count, whole)?,
                None => npz.add(name, count, cells.map(Cell::to_f64).collect())?,
            }
        }
        npz.finish()?;
        Ok(bytes.into_inner())
    }
}

/// Returns rows as the bytes of a file.
pub(crate) fn rows_bytes(data: &Dataset, format: Format) -> Result<Vec<u8>, Failure> {
    match format {
        Format::Table => Ok(data.table().into_bytes()),
        Format::Json => Ok(json_bytes(&data.json())),
        Format::Npz => data.npz().map_err(cannot("write NPZ")),
        _ => Ok(data.csv().map_err(|error| failure!("cannot write CSV: {error}"))?.into_bytes()),
    }
}

/// Returns JSON as the bytes of a file.
pub(crate) fn json_bytes(value: &Json) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

/// Returns a row as an object, with the bounds of its numbers.
fn object(data: &Dataset, row: &[Cell]) -> Json {
    let (mut object, mut bounds) = (Map::new(), Map::new());
    for (column, cell) in data.columns.iter().zip(row) {
        let Some(key) = column.key.as_deref() else { continue };
        if column.is_optional && cell.is_empty() {
            continue;
        }
        insert(&mut object, key, cell.json());
        if column.is_bounded {
            insert(&mut bounds, key.trim_start_matches(VALUES), cell.bound_json());
        }
    }
    if !bounds.is_empty() {
        object.insert(UNCERTAINTY.into(), bounds.into());
    }
    object.into()
}

/// Inserts `value` under `key`, in which a `/` follows the name of an object inside.
fn insert(object: &mut Map<String, Json>, key: &str, value: Json) {
    match key.split_once('/') {
        None => drop(object.insert(key.into(), value)),
        Some((outer, inner)) => {
            if let Json::Object(object) = object.entry(outer).or_insert_with(|| Map::new().into()) {
                insert(object, inner, value);
            }
        }
    }
}
