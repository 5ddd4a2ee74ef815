//! Data sets: named columns and rows, with the text above and below them.

use serde_json::{Value as Json, json};

use super::column::Column;
use dalembert::{Number, Value};

/// A cell of a row.
#[derive(Clone)]
pub(crate) enum Cell {
    /// A text, a count, a flag, a double without a bound, or nothing.
    Plain(Json),
    Number(Value),
    Numbers(Vec<Value>),
}

impl<T: Into<Json>> From<T> for Cell {
    fn from(value: T) -> Self {
        Cell::Plain(value.into())
    }
}

impl Cell {
    /// Returns the cell of a number, empty without one.
    pub(crate) fn number(value: Option<impl Into<Value>>) -> Self {
        value.map_or(Cell::Plain(Json::Null), |value| Cell::Number(value.into()))
    }

    pub(super) fn is_empty(&self) -> bool {
        match self {
            Cell::Plain(value) => value.is_null(),
            Cell::Number(_) => false,
            Cell::Numbers(numbers) => numbers.is_empty(),
        }
    }

    /// Returns the text of the cell; `empty` without a value.
    pub(super) fn text(&self, digits: u32, empty: &str) -> String {
        match self {
            Cell::Plain(Json::Null) => empty.into(),
            Cell::Plain(value) => plain_text(value),
            Cell::Number(number) => number.to_digits(digits),
            Cell::Numbers(numbers) => join(numbers, |number| number.to_digits(digits)),
        }
    }

    /// Returns the text of the cell in a column of a table with numbers up to `greatest`.
    pub(super) fn table_text(&self, digits: u32, greatest: f64) -> String {
        match self {
            Cell::Number(number) => number.to_digits_beside(digits, greatest),
            Cell::Plain(_) | Cell::Numbers(_) => self.text(digits, "–"),
        }
    }

    /// Returns the bounds of the numbers as text.
    pub(super) fn bound_text(&self, digits: u32) -> String {
        match self {
            Cell::Number(number) => number.bound_to_digits(digits).to_string(),
            Cell::Numbers(numbers) => join(numbers, |number| number.bound_to_digits(digits).to_string()),
            Cell::Plain(_) => String::new(),
        }
    }

    pub(super) fn json(&self) -> Json {
        match self {
            Cell::Plain(value) => value.clone(),
            Cell::Number(number) => json!(number),
            Cell::Numbers(numbers) => json!(numbers),
        }
    }

    /// Returns the bounds of the numbers as JSON; null for an enclosure, which has its bound in itself.
    pub(super) fn bound_json(&self) -> Json {
        let bound = |number: &Value| number.ends().is_none().then(|| number.bound());
        match self {
            Cell::Number(number) => json!(bound(number)),
            Cell::Numbers(numbers) => numbers.iter().map(|number| json!(bound(number))).collect(),
            Cell::Plain(_) => Json::Null,
        }
    }

    /// Returns the cell as a double; NaN without a number.
    pub(super) fn to_f64(&self) -> f64 {
        match self {
            Cell::Number(number) => number.to_f64(),
            Cell::Plain(value) => plain_text(value).parse().map_or(f64::NAN, |number: Number| number.to_f64()),
            Cell::Numbers(_) => f64::NAN,
        }
    }
}

/// Returns the greatest magnitude in a column.
pub(super) fn greatest<'a>(cells: impl IntoIterator<Item = &'a Cell>) -> f64 {
    let size = |cell: &Cell| if let Cell::Number(number) = cell { number.to_f64().abs() } else { 0.0 };
    cells.into_iter().map(size).fold(0.0, f64::max)
}

fn join(numbers: &[Value], text: impl Fn(&Value) -> String) -> String {
    numbers.iter().map(text).collect::<Vec<_>>().join(" ")
}

/// Returns a JSON value as text: of an enclosure, its middle.
fn plain_text(value: &Json) -> String {
    match value {
        Json::Null => String::new(),
        Json::String(text) => text.clone(),
        Json::Object(parts) => parts.get("value").map(plain_text).unwrap_or_default(),
        other => other.to_string(),
    }
}

/// Named columns and rows, with the text around them.
#[derive(Clone, Default)]
pub(crate) struct Dataset {
    /// Object with the entries above the rows in JSON; null without any.
    pub(crate) header: Json,
    /// Key of the rows in JSON.
    pub(crate) list: &'static str,
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Vec<Cell>>,
    /// Text above and below a table.
    pub(crate) around: [String; 2],
    /// Comments above a CSV.
    pub(crate) notes: Vec<String>,
    /// Digits of a long number; 0 for doubles and fractions.
    pub(crate) digits: u32,
    /// Shape of the grid that the rows are of, for NPZ.
    pub(crate) shape: Vec<usize>,
    /// Number of columns that each part of a table begins with where it is wider than the page; `None` to keep it wide.
    pub(crate) keys: Option<usize>,
}

impl Dataset {
    /// Returns rows whose values each come with their column.
    pub(crate) fn from_rows(rows: impl Iterator<Item = Vec<(Column, Cell)>>) -> Self {
        let mut data = Dataset::default();
        for row in rows {
            let (columns, cells) = row.into_iter().unzip();
            data.columns = columns;
            data.rows.push(cells);
        }
        data
    }
}
