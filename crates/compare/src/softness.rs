//! The part of a difference from rigid contact that a yielding contact accounts for.

use schemars::JsonSchema;
use serde::Serialize;

use super::agreement::Agreement;
use super::norms::{Norm, Norms};

/// L² norms of a column: the difference of the data from rigid contact, and its two parts.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct SoftColumn {
    pub name: &'static str,
    /// The data minus the exact values with rigid contact.
    pub from_rigid: Norm,
    /// The exact values with the yielding contact minus those with rigid contact.
    pub contact: Norm,
    /// The data minus the exact values with the yielding contact.
    pub scheme: Norm,
}

/// Returns the parts of each column; `soft` and `rigid` compare the same data.
pub(crate) fn parts(soft: &Agreement, rigid: &Agreement) -> Vec<SoftColumn> {
    let part = |(soft_column, rigid_column): (&super::norms::ComparedColumn, &super::norms::ComparedColumn)| {
        let contact = Norms::new(&soft.grid, &rigid_column.ours, &soft_column.ours, 0.0, 0, |_| true);
        SoftColumn {
            name: soft_column.what.name(),
            from_rigid: rigid_column.norms.l2,
            contact: contact.l2,
            scheme: soft_column.norms.l2,
        }
    };
    soft.quantities.iter().zip(&rigid.quantities).map(part).collect()
}
