//! The field at a point of the rod.

use serde::Serialize;

use crate::number::Scalar;

/// The displacement and its derivatives at a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(bound = "S: Scalar")]
pub struct Field<S> {
    /// `v`.
    #[serde(serialize_with = "Scalar::serialize")]
    pub displacement: S,
    /// `v_t`.
    #[serde(serialize_with = "Scalar::serialize")]
    pub velocity: S,
    /// `v_x`.
    #[serde(serialize_with = "Scalar::serialize")]
    pub strain: S,
}

impl<S> Field<S> {
    /// The same values in other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Field<T> {
        Field { displacement: f(self.displacement), velocity: f(self.velocity), strain: f(self.strain) }
    }

    /// Every number in it.
    pub(crate) fn numbers(&self) -> [&S; 3] {
        [&self.displacement, &self.velocity, &self.strain]
    }
}
