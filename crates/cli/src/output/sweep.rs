//! Sweeps: a row for each point.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::column::Column;
use super::dataset::{Cell, Dataset};
use super::schema_types::{NumberSchema, UncertaintySchema};
use super::table::wrapped;
use crate::sweep::{Axis, Point, PointNumber, Sweep};
use crate::terminal;
use dalembert::number::{DOUBLE_DIGITS, Estimate, Number, Rounded, show};
use dalembert_compare::SchemaVersion;

/// Returns the notes on the numbers of a point, each once.
fn notes(point: &Point) -> String {
    let mut notes: Vec<&str> = Vec::new();
    for note in point.numbers.iter().filter_map(|cell| cell.note.as_deref()) {
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    notes.join("; ")
}

/// Returns a number without digits beyond its uncertainty.
fn shown(cell: &PointNumber) -> Cell {
    match (cell.value.as_f64(), cell.uncertainty.as_f64()) {
        (Some(value), Some(bound)) => show(&Estimate::new(value, bound / value.unit()), DOUBLE_DIGITS).into(),
        _ if cell.value.is_null() => "".into(),
        _ => cell.value.clone().into(),
    }
}

/// The header of a sweep.
#[derive(JsonSchema, Serialize)]
struct SweepHeader<'a> {
    schema: SchemaVersion,
    title: Option<&'a str>,
    number: String,
    /// The time of quantities over time.
    time: Option<String>,
    /// The unit of each quantity; empty where there is none or none is known.
    #[schemars(with = "BTreeMap<String, String>")]
    units: Map<String, Value>,
    /// The axes of the grid; the last one runs fastest.
    vary: Vec<AxisJson<'a>>,
}

#[derive(JsonSchema, Serialize)]
struct AxisJson<'a> {
    path: String,
    #[schemars(with = "Vec<String>")]
    values: &'a [Number],
}

impl<'a> From<&'a Axis> for AxisJson<'a> {
    fn from(Axis { parameter, values }: &'a Axis) -> Self {
        AxisJson { path: parameter.full_path(), values }
    }
}

/// A sweep as JSON.
#[derive(JsonSchema)]
#[schemars(rename = "sweep")]
#[expect(dead_code, reason = "describes the rows of the data set")]
pub(super) struct SweepJson<'a> {
    #[serde(flatten)]
    header: SweepHeader<'a>,
    points: Vec<PointRow>,
}

#[derive(JsonSchema)]
#[expect(dead_code, reason = "describes a row of the data set")]
struct PointRow {
    /// The place in the whole grid.
    point: usize,
    at: BTreeMap<String, String>,
    values: BTreeMap<String, Option<NumberSchema>>,
    uncertainty: BTreeMap<String, UncertaintySchema>,
    /// The reasons why values are null.
    notes: BTreeMap<String, Option<String>>,
}

/// Returns the columns of a sweep; a table has one of notes where there are any.
fn columns(sweep: &Sweep, noted: bool) -> Vec<Column> {
    let axis = |path: String| Column::new(path.clone()).keyed(format!("at/{path}"));
    let axes = sweep.grid.axes.iter().map(|it| axis(it.parameter.full_path()));
    let numbers = sweep.units().into_iter().flat_map(|(name, unit)| {
        let head = if unit.is_empty() { name.clone() } else { format!("{name} [{unit}]") };
        [
            Column::table(head),
            Column::data(name.clone()).keyed(format!("values/{name}")).with_unit(unit),
            Column::data(format!("{name}_uncertainty")).keyed(format!("uncertainty/{name}")).with_unit(unit),
            Column::json(format!("notes/{name}")),
        ]
    });
    let notes = [Column::csv("note").text()].into_iter().chain(noted.then(|| Column::table("note")));
    [Column::new("point")].into_iter().chain(axes).chain(numbers).chain(notes).collect()
}

/// Returns a row for each point; a table has the notes below it, each once.
pub(crate) fn sweep_data(sweep: &Sweep, points: &[Point], title: Option<&str>) -> Dataset {
    let noted = points.iter().any(|point| !notes(point).is_empty());
    let mut below: Vec<String> = Vec::new();
    let mut row = |point: &Point| {
        let mut row: Vec<Cell> = vec![point.index.into()];
        row.extend(sweep.grid.values(point.index).iter().map(|(_, value)| value.to_string().into()));
        for cell in &point.numbers {
            let [value, uncertainty] = [&cell.value, &cell.uncertainty].map(|value| value.clone().into());
            row.extend([shown(cell), value, uncertainty, cell.note.clone().into()]);
        }
        let note = notes(point);
        let known = below.iter().position(|other| *other == note).unwrap_or(below.len());
        let mark = if note.is_empty() { String::new() } else { format!("[{}]", known + 1) };
        if known == below.len() && !note.is_empty() {
            below.push(note.clone());
        }
        row.extend([note.into(), mark.into()]);
        row
    };
    let rows = points.iter().map(&mut row).collect();
    let below = below
        .iter()
        .enumerate()
        .map(|(k, note)| wrapped(&format!("[{}] {note}", k + 1), terminal::width(), "    ") + "\n");
    let below: String = below.collect();
    let header = SweepHeader {
        schema: SchemaVersion,
        title,
        number: sweep.request.numbers.to_string(),
        time: sweep.request.time.as_ref().map(Number::to_string),
        units: sweep.units().into_iter().map(|(name, unit)| (name, unit.into())).collect(),
        vary: sweep.grid.axes.iter().map(AxisJson::from).collect(),
    };
    Dataset {
        header: json!(header),
        list: "points",
        columns: columns(sweep, noted),
        rows,
        around: [String::new(), if noted { format!("\n\n{below}") } else { "\n".into() }],
        shape: sweep.grid.axes.iter().map(|axis| axis.values.len()).collect(),
        ..Dataset::default()
    }
}
