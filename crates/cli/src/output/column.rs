//! Columns of tables, of CSV, JSON and NPZ.

use std::borrow::Cow;

use dalembert::quantity::{Quantity, Units};

/// The kind of values in a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Numbers.
    #[default]
    Number,
    /// Bounds of the errors of numbers.
    Bound,
    /// Sides of a jump: −1, 0 and 1 stand for left, both and right.
    Side,
    /// 0 or 1.
    Flag,
    /// Words.
    Word,
}

/// A column, with its names in each format and what a header tells of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Column {
    /// Head in a table.
    pub(super) head: Option<Cow<'static, str>>,
    /// Name in CSV and NPZ.
    pub(super) name: Option<Cow<'static, str>>,
    /// Key in JSON, with `/` before a key inside.
    pub(super) key: Option<Cow<'static, str>>,
    pub(super) symbol: Cow<'static, str>,
    pub(super) meaning: Cow<'static, str>,
    /// Empty if there is none or none is known.
    pub(super) unit: &'static str,
    pub(super) kind: Kind,
    /// Whether CSV and JSON have the bounds of its numbers too.
    pub(super) is_bounded: bool,
    /// Whether JSON leaves it out where it is empty.
    pub(super) is_optional: bool,
    /// Whether it tells rows apart: a time or a place.
    pub(super) is_key: bool,
}

impl Column {
    fn in_formats(head: bool, name: bool, key: bool, text: Cow<'static, str>) -> Self {
        let [head, name, key] = [head, name, key].map(|there| there.then(|| text.clone()));
        Column { head, name, key, ..Column::default() }
    }

    /// Returns a column of every format.
    pub(crate) fn new(name: impl Into<Cow<'static, str>>) -> Self {
        Column::in_formats(true, true, true, name.into())
    }

    /// Returns the column of a quantity.
    pub(crate) fn from_quantity(quantity: Quantity, units: &Units) -> Self {
        let kind = match quantity {
            Quantity::Side => Kind::Side,
            Quantity::Contact => Kind::Flag,
            _ => Kind::Number,
        };
        let (symbol, meaning) = (quantity.symbol().into(), quantity.meaning().into());
        let is_key = matches!(quantity, Quantity::Time | Quantity::Point);
        Column { symbol, meaning, unit: quantity.unit(units), kind, is_key, ..Column::new(quantity.name()) }
    }

    /// Returns a column of tables.
    pub(crate) fn table(head: impl Into<Cow<'static, str>>) -> Self {
        Column::in_formats(true, false, false, head.into())
    }

    /// Returns a column of CSV, NPZ and JSON.
    pub(crate) fn data(name: impl Into<Cow<'static, str>>) -> Self {
        Column::in_formats(false, true, true, name.into())
    }

    /// Returns a column of CSV and NPZ.
    pub(crate) fn csv(name: impl Into<Cow<'static, str>>) -> Self {
        Column::in_formats(false, true, false, name.into())
    }

    /// Returns a column of JSON.
    pub(crate) fn json(key: impl Into<Cow<'static, str>>) -> Self {
        Column::in_formats(false, false, true, key.into())
    }

    /// Returns the column with this head in tables.
    pub(crate) fn headed(self, head: impl Into<Cow<'static, str>>) -> Self {
        Column { head: Some(head.into()), ..self }
    }

    /// Returns the column with this name in CSV.
    pub(crate) fn named(self, name: impl Into<Cow<'static, str>>) -> Self {
        Column { name: Some(name.into()), ..self }
    }

    /// Returns the column with this key in JSON.
    pub(crate) fn keyed(self, key: impl Into<Cow<'static, str>>) -> Self {
        Column { key: Some(key.into()), ..self }
    }

    pub(crate) fn text(self) -> Self {
        Column { kind: Kind::Word, ..self }
    }

    pub(crate) fn with_meaning(self, meaning: impl Into<Cow<'static, str>>) -> Self {
        Column { meaning: meaning.into(), ..self }
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

    /// Returns the column of the bounds of its numbers.
    pub(super) fn bounds(&self) -> Self {
        let meaning = format!("bound of the error of {}", self.csv_name()).into();
        let name = format!("{}_uncertainty", self.csv_name());
        Column { meaning, unit: self.unit, kind: Kind::Bound, ..Column::new(name) }
    }

    pub(super) fn has_bound(&self) -> bool {
        self.kind == Kind::Number
    }

    /// Returns the name in CSV and NPZ, empty for a column of other formats.
    pub(super) fn csv_name(&self) -> &str {
        self.name.as_deref().unwrap_or_default()
    }
}
