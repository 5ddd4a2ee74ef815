//! The JSON Schema of the outputs, from their types.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};

use super::rows::Document;
use super::schema_chain::ChainSchema;
use super::solve::HistoryJson;
use super::sweep::SweepJson;
use dalembert_compare::{BodiesReport, FileReport, SeriesReport};

/// Output of dalembert solve, sample, reference, compare and sweep, schema 1
///
/// Numbers are JSON numbers in doubles, strings in digits ("1.25") and fractions ("5/4"), and {value, lo, hi} where
/// they are proved. Times are from the start of the scene: the first touch of the ground, or before it with a gap.
/// Where the scene gives modulus and density, impulse, stress, force and energies are in the units named in units,
/// which are per area where it gives none; otherwise impulse and energies are per linear density ρS.
#[derive(JsonSchema)]
#[schemars(untagged)]
#[expect(dead_code, reason = "lists the outputs")]
enum Output<'a> {
    History(HistoryJson<'a>),
    Reference(Document),
    Comparison(FileReport<'a>),
    Comparisons(SeriesReport<'a>),
    ComparisonsOfBodies(BodiesReport<'a>),
    Sweep(SweepJson<'a>),
    Chain(ChainSchema),
}

/// Returns the JSON Schema of the outputs of `solve`, `sample`, `reference`, `compare` and `sweep`.
pub(crate) fn schema() -> Schema {
    SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<Output<'_>>()
}
