//! Columns of rows.

use std::borrow::Cow;

use dalembert::quantity::{Quantity, Units};

/// The kind of values in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Numbers.
    Number,
    /// Bounds of the errors of numbers.
    Bound,
    /// Sides of a jump: −1, 0 and 1 stand for left, both and right.
    Side,
    /// 0 or 1.
    Flag,
}

/// A column of rows.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) name: Cow<'static, str>,
    pub(crate) symbol: Cow<'static, str>,
    pub(crate) meaning: Cow<'static, str>,
    /// Empty if there is none or none is known.
    pub(crate) unit: &'static str,
    pub(crate) kind: Kind,
}

impl Column {
    /// Returns the column of a quantity.
    pub(crate) fn new(quantity: Quantity, units: &Units) -> Self {
        let kind = match quantity {
            Quantity::Side => Kind::Side,
            Quantity::Contact => Kind::Flag,
            _ => Kind::Number,
        };
        let (name, symbol, meaning) = (quantity.name().into(), quantity.symbol().into(), quantity.meaning().into());
        Column { name, symbol, meaning, unit: quantity.unit(units), kind }
    }

    pub(super) fn has_bound(&self) -> bool {
        self.kind == Kind::Number
    }
}
