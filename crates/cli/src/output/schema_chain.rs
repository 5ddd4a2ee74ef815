//! The JSON Schema of the output of solve for a whole chain.
#![expect(dead_code, reason = "describes the output of another type")]

use std::collections::BTreeMap;

use schemars::JsonSchema;

use super::schema_types::{DerivativeSchema, NumberSchema, UncertaintySchema};
use dalembert_compare::SchemaVersion;

/// Output of solve for a whole chain
#[derive(JsonSchema)]
#[schemars(rename = "chain")]
pub(super) struct ChainSchema {
    schema: SchemaVersion,
    title: Option<String>,
    /// The bodies, from the bottom up.
    bodies: Vec<BodySchema>,
    /// The numbers of the run: double, exact, or digits.
    number: String,
    /// The unit of each measure; null if it is not known.
    units: BTreeMap<String, Option<String>>,
    events: Vec<EventSchema>,
    touches: Vec<TouchSchema>,
    contacts: Vec<ContactSchema>,
    forces: Vec<ForceSchema>,
    /// The last time of the run.
    end: NumberSchema,
    /// The reason of the end.
    ending: String,
    warnings: Vec<String>,
}

#[derive(JsonSchema)]
#[schemars(rename = "chain_body")]
struct BodySchema {
    /// The number of the body, from 1 at the bottom.
    body: usize,
    name: Option<String>,
    length: String,
    /// The mass of a rigid body, whose length is zero; null for a bar.
    mass: Option<String>,
}

/// An impact or a release
#[derive(JsonSchema)]
#[schemars(rename = "chain_event")]
struct EventSchema {
    /// The node: bottom, joint 1 above the first body, top.
    node: String,
    event: EventKindSchema,
    t: NumberSchema,
    /// The rate of the gap that free ends would have just before.
    gap_rate_before: NumberSchema,
    /// The same rate just after.
    gap_rate_after: NumberSchema,
    /// Derivatives by quantity and value.
    #[schemars(skip_serializing_if = "BTreeMap::is_empty")]
    derivatives: BTreeMap<String, BTreeMap<String, DerivativeSchema>>,
    uncertainty: BTreeMap<String, UncertaintySchema>,
}

#[derive(JsonSchema)]
#[schemars(rename = "chain_event_kind", rename_all = "lowercase")]
enum EventKindSchema {
    Impact,
    Release,
}

/// A gap that reaches zero without a contact
#[derive(JsonSchema)]
#[schemars(rename = "chain_touch")]
struct TouchSchema {
    node: String,
    t: NumberSchema,
    uncertainty: BTreeMap<String, UncertaintySchema>,
}

/// A contact at a node
#[derive(JsonSchema)]
#[schemars(rename = "chain_contact")]
struct ContactSchema {
    node: String,
    impact: NumberSchema,
    /// Null if the run ends before.
    release: Option<NumberSchema>,
    /// Null for a contact that goes on beyond the end of exactness.
    impulse: Option<NumberSchema>,
    /// Null for a contact that goes on beyond the end of exactness.
    peak_force: Option<NumberSchema>,
    /// The first time of the greatest force; null where the force is the same, within its bound, over a plateau.
    peak_time: Option<NumberSchema>,
    /// Derivatives by quantity and value.
    #[schemars(skip_serializing_if = "BTreeMap::is_empty")]
    derivatives: BTreeMap<String, BTreeMap<String, DerivativeSchema>>,
    uncertainty: BTreeMap<String, UncertaintySchema>,
}

/// A stretch of time on which the compressive force of a node is linear, or has one Chebyshev series
#[derive(JsonSchema)]
#[schemars(rename = "chain_force")]
struct ForceSchema {
    node: String,
    start: NumberSchema,
    end: NumberSchema,
    force_start: NumberSchema,
    force_end: NumberSchema,
    /// Chebyshev coefficients of a force that is a curve, the first one whole.
    #[schemars(skip_serializing_if = "Vec::is_empty")]
    chebyshev: Vec<NumberSchema>,
    uncertainty: BTreeMap<String, UncertaintySchema>,
}
