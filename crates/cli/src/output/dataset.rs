//! What is written: named columns and rows, with what stands above and below them. Each format has one writer.

use std::borrow::Cow;
use std::rc::Rc;

use serde_json::Value;

use super::json::{bound_json, number_json};
use dalembert::number::{Number, Scalar, bound_of_log2, show, shown_bound};

/// A number of any system, as writers ask it.
pub(crate) trait Shown {
    fn printed(&self, digits: u32) -> String;
    fn printed_bound(&self, digits: u32) -> String;
    fn json(&self, digits: u32) -> Value;
    fn json_bound(&self, digits: u32) -> Value;
    fn double(&self) -> f64;
}

impl<S: Scalar> Shown for S {
    fn printed(&self, digits: u32) -> String {
        show(self, digits)
    }
    fn printed_bound(&self, digits: u32) -> String {
        bound_of_log2(shown_bound(self, digits))
    }
    fn json(&self, digits: u32) -> Value {
        number_json(self, digits)
    }
    fn json_bound(&self, digits: u32) -> Value {
        bound_json(self, digits)
    }
    fn double(&self) -> f64 {
        self.to_f64()
    }
}

/// A number that several rows show.
pub(crate) type Shared = Rc<dyn Shown>;

#[derive(Clone)]
pub(crate) enum Cell {
    /// A text, a count, a flag, a double without a bound, or nothing.
    Plain(Value),
    /// A number that carries its bound.
    Number(Shared),
    Numbers(Vec<Shared>),
}

impl<T: Into<Value>> From<T> for Cell {
    fn from(value: T) -> Self {
        Cell::Plain(value.into())
    }
}

impl Cell {
    pub(crate) const EMPTY: Self = Cell::Plain(Value::Null);

    pub(crate) fn number(x: &impl Scalar) -> Self {
        Cell::Number(Rc::new(x.clone()))
    }

    pub(crate) fn optional<S: Scalar>(x: Option<&S>) -> Self {
        x.map_or(Cell::EMPTY, Cell::number)
    }

    pub(crate) fn numbers(all: &[impl Scalar]) -> Self {
        Cell::Numbers(all.iter().map(|x| Rc::new(x.clone()) as Shared).collect())
    }

    pub(super) fn shared(x: Option<&Shared>) -> Self {
        x.map_or(Cell::EMPTY, |x| Cell::Number(x.clone()))
    }

    pub(super) fn is_empty(&self) -> bool {
        match self {
            Cell::Plain(value) => value.is_null(),
            Cell::Number(_) => false,
            Cell::Numbers(numbers) => numbers.is_empty(),
        }
    }

    /// As text; `none` where there is nothing.
    pub(super) fn text(&self, digits: u32, none: &str) -> String {
        match self {
            Cell::Plain(Value::Null) => none.into(),
            Cell::Plain(value) => plain(value),
            Cell::Number(x) => x.printed(digits),
            Cell::Numbers(numbers) => numbers.iter().map(|x| x.printed(digits)).collect::<Vec<_>>().join(" "),
        }
    }

    /// The bound of a number, as a text; nothing beside what is none.
    pub(super) fn bound(&self, digits: u32) -> Self {
        match self {
            Cell::Number(x) => x.printed_bound(digits).into(),
            Cell::Plain(_) | Cell::Numbers(_) => Cell::EMPTY,
        }
    }

    /// As a double; not a number where there is none.
    pub(super) fn double(&self) -> f64 {
        match self {
            Cell::Number(x) => x.double(),
            Cell::Plain(value) => plain(value).parse().map_or(f64::NAN, |number: Number| number.to_f64()),
            Cell::Numbers(_) => f64::NAN,
        }
    }
}

/// A value as text: that of an enclosure is its middle.
fn plain(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Object(parts) => parts.get("value").map(plain).unwrap_or_default(),
        other => other.to_string(),
    }
}

/// A column, and where it is written.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// The head in a table.
    pub(super) head: Option<Cow<'static, str>>,
    /// The name in CSV and NPZ.
    pub(super) name: Option<Cow<'static, str>>,
    /// The key in JSON, with `/` before a key inside.
    pub(super) key: Option<Cow<'static, str>>,
    /// Empty where there is none.
    pub(super) unit: &'static str,
    /// Whether its values are words.
    pub(super) is_text: bool,
    /// Whether CSV and JSON have the bounds of its numbers too.
    pub(super) is_bounded: bool,
    /// Whether JSON leaves it out where it is empty.
    pub(super) is_optional: bool,
}

impl Column {
    fn at(head: bool, name: bool, key: bool, text: Cow<'static, str>) -> Self {
        let [head, name, key] = [head, name, key].map(|there| there.then(|| text.clone()));
        Column { head, name, key, unit: "", is_text: false, is_bounded: false, is_optional: false }
    }

    /// In every format.
    pub(crate) fn new(name: impl Into<Cow<'static, str>>) -> Self {
        Column::at(true, true, true, name.into())
    }

    /// In tables only.
    pub(crate) fn table(head: impl Into<Cow<'static, str>>) -> Self {
        Column::at(true, false, false, head.into())
    }

    /// In CSV, NPZ and JSON.
    pub(crate) fn data(name: impl Into<Cow<'static, str>>) -> Self {
        Column::at(false, true, true, name.into())
    }

    /// In CSV and NPZ only.
    pub(crate) fn csv(name: impl Into<Cow<'static, str>>) -> Self {
        Column::at(false, true, false, name.into())
    }

    /// In JSON only.
    pub(crate) fn json(key: impl Into<Cow<'static, str>>) -> Self {
        Column::at(false, false, true, key.into())
    }

    /// With this head in tables.
    pub(crate) fn headed(self, head: impl Into<Cow<'static, str>>) -> Self {
        Column { head: Some(head.into()), ..self }
    }

    /// With this name in CSV.
    pub(crate) fn named(self, name: impl Into<Cow<'static, str>>) -> Self {
        Column { name: Some(name.into()), ..self }
    }

    /// With this key in JSON.
    pub(crate) fn keyed(self, key: impl Into<Cow<'static, str>>) -> Self {
        Column { key: Some(key.into()), ..self }
    }

    pub(crate) fn text(self) -> Self {
        Column { is_text: true, ..self }
    }

    pub(crate) fn with_unit(self, unit: &'static str) -> Self {
        Column { unit, ..self }
    }

    pub(crate) fn bounded(self) -> Self {
        Column { is_bounded: true, ..self }
    }

    pub(crate) fn optional(self) -> Self {
        Column { is_optional: true, ..self }
    }
}

/// Named columns and rows, with the text around them.
#[derive(Clone, Default)]
pub(crate) struct Dataset {
    /// What JSON has above the rows, in its order.
    pub(crate) header: Vec<(&'static str, Value)>,
    /// The key of the rows in JSON.
    pub(crate) list: &'static str,
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Vec<Cell>>,
    /// Text above and below a table.
    pub(crate) around: [String; 2],
    /// What the numbers do not say, which a CSV has in comments.
    pub(crate) notes: Vec<String>,
    /// Digits that a long number has; 0 for doubles and fractions.
    pub(crate) digits: u32,
    /// The shape of the grid that the rows are of, which NPZ has.
    pub(crate) shape: Vec<usize>,
    /// How many columns each part of a table begins with that is too wide for a page; `None` where it is left wide.
    pub(crate) keys: Option<usize>,
}

impl Dataset {
    /// Rows whose values each come with their column.
    pub(crate) fn of(rows: impl Iterator<Item = Vec<(Column, Cell)>>) -> Self {
        let mut data = Dataset::default();
        for row in rows {
            let (columns, cells) = row.into_iter().unzip();
            data.columns = columns;
            data.rows.push(cells);
        }
        data
    }
}
