//! Sweeps: a row for each point.

use std::io::{self, Cursor};

use serde_json::{Map, Value, json};

use super::table::{WIDTH, wrapped};
use super::writer::Npz;
use crate::aligned::table;
use crate::number::{DOUBLE_DIGITS, Estimate, Rounded, show};
use crate::sweep::{Point, Sweep};

/// A value as text: that of an enclosure is its middle.
fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Object(parts) => parts.get("value").map(text).unwrap_or_default(),
        other => other.to_string(),
    }
}

fn double(value: &Value) -> f64 {
    text(value).parse().unwrap_or(f64::NAN)
}

/// What is said of the numbers of a point, each once.
fn notes(point: &Point) -> String {
    let mut notes: Vec<&str> = Vec::new();
    for note in point.cells.iter().filter_map(|cell| cell.note.as_deref()) {
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    notes.join("; ")
}

fn rows(sweep: &Sweep, points: &[Point], uncertainty: bool) -> (Vec<String>, Vec<Vec<String>>) {
    let mut header = vec!["point".to_string()];
    header.extend(sweep.grid.axes.iter().map(|axis| axis.path.to_string()));
    for quantity in &sweep.asked.quantities {
        header.push(quantity.name().into());
        header.extend(uncertainty.then(|| format!("{}_uncertainty", quantity.name())));
    }
    header.push("note".into());
    let row = |point: &Point| {
        let mut row = vec![point.index.to_string()];
        row.extend(sweep.grid.values(point.index).iter().map(ToString::to_string));
        for cell in &point.cells {
            row.push(text(&cell.value));
            row.extend(uncertainty.then(|| text(&cell.uncertainty)));
        }
        row.push(notes(point));
        row
    };
    (header, points.iter().map(row).collect())
}

/// A table for a person, with the notes below it, each once, and no digit of a double beyond its uncertainty.
pub(crate) fn sweep_table(sweep: &Sweep, points: &[Point]) -> String {
    let (mut header, mut rows) = rows(sweep, points, false);
    let mut below: Vec<String> = Vec::new();
    for (row, point) in rows.iter_mut().zip(points) {
        let first = 1 + sweep.grid.axes.len();
        for (text, cell) in row.iter_mut().skip(first).zip(&point.cells) {
            if let (Some(value), Some(bound)) = (cell.value.as_f64(), cell.uncertainty.as_f64()) {
                *text = show(&Estimate::new(value, bound / value.unit()), DOUBLE_DIGITS);
            }
        }
        for note in row.last_mut().into_iter().filter(|note| !note.is_empty()) {
            let known = below.iter().position(|other| other == note).unwrap_or(below.len());
            if known == below.len() {
                below.push(note.clone());
            }
            *note = format!("[{}]", known + 1);
        }
    }
    if below.is_empty() {
        header.pop();
        rows.iter_mut().for_each(|row| row.truncate(header.len()));
    }
    let table = table(&header.iter().map(String::as_str).collect::<Vec<_>>(), rows, 0);
    let notes = below.iter().enumerate().map(|(k, note)| wrapped(&format!("[{}] {note}", k + 1), WIDTH, "    ") + "\n");
    let space = if below.is_empty() { "" } else { "\n" };
    format!("{table}\n{space}{}", notes.collect::<String>())
}

/// CSV with a header.
pub(crate) fn sweep_csv(sweep: &Sweep, points: &[Point]) -> Result<String, csv::Error> {
    let (header, rows) = rows(sweep, points, true);
    super::csv::write("", header, rows)
}

/// JSON, schema 1.
pub(crate) fn sweep_json(sweep: &Sweep, points: &[Point], title: Option<&str>) -> Value {
    let names = || sweep.asked.quantities.iter().map(|quantity| quantity.name().to_string());
    let vary = sweep.grid.axes.iter().map(|axis| json!({"path": axis.path, "values": axis.values}));
    let rows = points.iter().map(|point| {
        let at = sweep.grid.axes.iter().zip(sweep.grid.values(point.index));
        let of =
            |value: fn(&crate::sweep::Cell) -> Value| names().zip(point.cells.iter().map(value)).collect::<Map<_, _>>();
        json!({
            "point": point.index,
            "at": at.map(|(axis, value)| (axis.path.to_string(), value.to_string().into())).collect::<Map<_, _>>(),
            "values": of(|cell| cell.value.clone()),
            "uncertainty": of(|cell| cell.uncertainty.clone()),
            "notes": of(|cell| cell.note.clone().into()),
        })
    });
    json!({
        "schema": 1,
        "title": title,
        "number": sweep.asked.numbers.to_string(),
        "time": sweep.asked.time,
        "vary": vary.collect::<Vec<_>>(),
        "points": rows.collect::<Vec<_>>(),
    })
}

/// NPZ: doubles, a list for each column; `shape` is that of the whole grid, and numbers that are missing are NaN.
pub(crate) fn sweep_npz(sweep: &Sweep, points: &[Point]) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let mut npz = Npz::new(&mut bytes, true);
    let count = &[points.len()];
    let shape: Vec<i64> = sweep.grid.axes.iter().map(|axis| axis.values.len() as i64).collect();
    npz.add("shape", &[shape.len()], shape)?;
    npz.add("point", count, points.iter().map(|point| point.index as i64).collect())?;
    for (k, axis) in sweep.grid.axes.iter().enumerate() {
        npz.add(axis.path, count, points.iter().map(|point| sweep.grid.values(point.index)[k].to_f64()).collect())?;
    }
    for (k, quantity) in sweep.asked.quantities.iter().enumerate() {
        let name = quantity.name();
        npz.add(name, count, points.iter().map(|point| double(&point.cells[k].value)).collect())?;
        let bounds = points.iter().map(|point| double(&point.cells[k].uncertainty)).collect();
        npz.add(&format!("{name}_uncertainty"), count, bounds)?;
    }
    npz.finish()?;
    Ok(bytes.into_inner())
}
