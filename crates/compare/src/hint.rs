//! Hints at causes of the misfit of data.

use schemars::JsonSchema;
use serde::Serialize;

/// A cause of the misfit.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Hint {
    /// The name of the cause, such as `wave_speed`.
    pub(crate) kind: &'static str,
    /// The column that it concerns; `all` for all of them.
    pub(crate) quantity: &'static str,
    pub(crate) value: f64,
    /// The standard error of the value; zero for a count.
    pub(crate) error: f64,
    /// Whether no other cause explains the data about as well.
    pub(crate) asserted: bool,
    pub(crate) text: String,
}

/// The least size of a wrong number that would be named: a share, a time, or an offset.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Detectable {
    pub(crate) kind: &'static str,
    pub(crate) quantity: &'static str,
    pub(crate) value: f64,
}

impl Hint {
    /// Builds the hint at a cause that is certain and concerns all columns.
    pub(super) fn new(kind: &'static str, value: f64, text: String) -> Self {
        Hint { kind, quantity: "all", value, error: 0.0, asserted: true, text }
    }
}
