//! The types that stand for numbers, bounds and rows in the JSON Schema of the outputs.
#![expect(dead_code, reason = "describes how values of the library are written")]

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, json};

use dalembert::Quantity;
use dalembert::quantity::{Needs, Table};

/// A number: of JSON in doubles, a text in digits ("1.25") and fractions ("5/4"), and both ends where they are proved.
#[derive(JsonSchema)]
#[schemars(rename = "number", untagged)]
pub(super) enum NumberSchema {
    Double(f64),
    Text(String),
    Enclosure { value: String, lo: String, hi: String },
}

/// The bound of the error of a number, the rounding of its printed text included: null where the number has both ends
/// or the bound is not known, a text where the bound is below the least double.
#[derive(JsonSchema)]
#[schemars(rename = "bound", untagged)]
pub(super) enum BoundSchema {
    Double(Option<f64>),
    Text(String),
}

/// The bound of each number under the key of the number; of a list, one for each item.
#[derive(JsonSchema)]
#[schemars(rename = "uncertainty", untagged)]
pub(super) enum UncertaintySchema {
    Bound(BoundSchema),
    List(Vec<BoundSchema>),
    Inner(BTreeMap<String, UncertaintySchema>),
}

/// A derivative by a value of the scene. Where the sides differ, left and right, and under undefined the reason why a
/// side has none.
#[derive(JsonSchema)]
#[schemars(rename = "derivative", untagged)]
pub(super) enum DerivativeSchema {
    Both(NumberSchema),
    Sides {
        #[schemars(skip_serializing_if = "Option::is_none")]
        left: Option<Option<NumberSchema>>,
        #[schemars(skip_serializing_if = "Option::is_none")]
        right: Option<Option<NumberSchema>>,
        #[schemars(skip_serializing_if = "Option::is_none")]
        undefined: Option<BTreeMap<String, String>>,
    },
}

/// Defines the schema of the rows of a table.
macro_rules! rows {
    ($($row:ident: $table:ident, $name:literal;)*) => {$(
        pub(super) struct $row;

        impl JsonSchema for $row {
            fn schema_name() -> Cow<'static, str> {
                $name.into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                row_schema(Table::$table.quantities(), generator)
            }
        }
    )*};
}

rows! {
    EventRow: Events, "event";
    ContactRow: Contacts, "contact";
    FlightRow: Flights, "flight";
    StressRow: Stress, "stress_piece";
}

/// Returns the schema of a row of `quantities` of one kind. Only the beginning of a contact or a flight is known in any
/// case; stresses and forces are there with a material only.
fn row_schema(quantities: &[Quantity], generator: &mut SchemaGenerator) -> Schema {
    let (number, optional) =
        (generator.subschema_for::<NumberSchema>(), generator.subschema_for::<Option<NumberSchema>>());
    let mut properties = Map::new();
    for (k, quantity) in quantities.iter().enumerate() {
        let is_known = k == 0 || matches!(quantity.needs(), Needs::Event | Needs::Piece);
        let mut schema = if is_known { number.clone() } else { optional.clone() };
        schema.insert("description".into(), quantity.meaning().into());
        properties.insert(quantity.name().into(), schema.to_value());
    }
    let listed = quantities.iter().filter(|quantity| quantity.is_listed(false)).map(|quantity| quantity.name());
    let mut required: Vec<&str> = listed.chain(["uncertainty"]).collect();
    let uncertainty = generator.subschema_for::<BTreeMap<String, UncertaintySchema>>();
    properties.insert("uncertainty".into(), uncertainty.to_value());
    let derivatives = generator.subschema_for::<BTreeMap<String, BTreeMap<String, DerivativeSchema>>>();
    match quantities[0].needs() {
        Needs::Event => {
            properties.insert("kind".into(), json!({"enum": ["impact", "release"]}));
            properties.insert("derivatives".into(), derivatives.to_value());
            required.push("kind");
        }
        Needs::Contact => {
            properties.insert("derivatives".into(), derivatives.to_value());
            let description = "The reasons why e_P or e_E2 is null.";
            properties.insert("undefined".into(), json!({"description": description, "type": "object"}));
        }
        Needs::Piece => {
            let coefficients = generator.subschema_for::<Vec<NumberSchema>>();
            properties.insert("chebyshev".into(), coefficients.to_value());
        }
        _ => (),
    }
    json_schema!({"type": "object", "required": required, "properties": properties})
}
