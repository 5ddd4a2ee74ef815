//! JSON: numbers in double precision, strings otherwise.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::record::{CONTACT, Finished, Head, Quantity, Record, Sample, sampled};
use crate::motion::Ending;
use crate::number::{Scalar, bound_json, number_json};
use crate::quantity::{Measure, Units};
use crate::solve::ExactnessEnd;

/// The JSON Schema of histories, samples, golden files, comparisons and sweeps.
pub const SCHEMA: &str = include_str!("schema.json");

/// The whole history, schema 1.
pub fn history_json<S: Scalar>(record: &Record<S>, head: &Head) -> Value {
    let number = |x: &S| number_json(x, head.digits);
    let optional = |x: Option<&S>| x.map_or(Value::Null, number);
    let events = record.events.iter().map(|event| {
        json!({
            "kind": event.kind,
            "time": number(&event.time),
            "end_velocity": number(&event.end_velocity),
            "centre": number(&event.centre),
            "centre_velocity": number(&event.centre_velocity),
            "uncertainty": {
                "time": bound_json(&event.time, head.digits),
                "end_velocity": bound_json(&event.end_velocity, head.digits),
                "centre": bound_json(&event.centre, head.digits),
                "centre_velocity": bound_json(&event.centre_velocity, head.digits),
            },
        })
    });
    let contacts = record.contacts.iter().map(|finished| {
        let Finished { restitution, shares, energy, .. } = finished;
        let present = CONTACT.iter().filter(|column| column.is_present(&head.units));
        let values = finished.columns(&head.units);
        let columns: BTreeMap<&str, Value> =
            present.zip(&values).map(|(column, value)| (column.name, optional(value.as_ref()))).collect();
        let get = |name| columns.get(name).cloned().unwrap_or(Value::Null);
        let mut value = json!({
            "from": get("from"),
            "to": get("to"),
            "impulse": get("impulse"),
            "peak_strain": get("peak_strain"),
            "restitution": {
                "momentum": get("restitution_momentum"),
                "energy_squared": get("restitution_energy_squared"),
                "translational_part": optional(shares.translational.as_ref()),
                "energy_kept": optional(shares.kept.as_ref()),
            },
            "energy": energy.as_ref().map(|_| json!({
                "total": get("total"),
                "translational": get("translational"),
                "vibrational": get("vibrational"),
            })),
        });
        if head.units.has_material() {
            value["peak_stress"] = get("peak_stress");
            value["peak_force"] = get("peak_force");
        }
        let reasons = [
            ("momentum", restitution.momentum.as_ref().err()),
            ("energy_squared", restitution.energy_squared.as_ref().err()),
        ];
        for (name, reason) in reasons {
            if let Some(reason) = reason {
                value["restitution"]["undefined"][name] = reason.to_string().into();
            }
        }
        value
    });
    let flights = record.flights.iter().map(|flight| {
        json!({
            "from": number(&flight.from),
            "to": optional(flight.to.as_ref()),
            "highest": flight.highest.as_ref().map(|(time, centre)| {
                json!({"time": number(time), "centre": number(centre)})
            }),
        })
    });
    let pieces = record.stress.iter().map(|piece| {
        let mut value = json!({
            "from": number(&piece.from),
            "to": number(&piece.to),
            "strain_from": number(&piece.left),
            "strain_to": number(&piece.right),
        });
        if !piece.chebyshev.is_empty() {
            value["chebyshev"] = piece.chebyshev.iter().map(number).collect();
        }
        value
    });
    json!({
        "schema": 1,
        "title": head.title,
        "number": head.number,
        "effects": head.effects,
        "units": units_json(&head.units),
        "exact_until": head.exact_until.as_ref().map(exact_until_json),
        "events": events.collect::<Vec<_>>(),
        "contacts": contacts.collect::<Vec<_>>(),
        "flights": flights.collect::<Vec<_>>(),
        "stress": {"pieces": pieces.collect::<Vec<_>>()},
        "end": ending_json(&record.end.1, number(&record.end.0)),
        "error_estimate": record.error,
        "digits_lost": record.lost.map(|(_, digits)| digits),
        "warnings": warnings_json(head),
    })
}

/// The name of each unit, null where it is not known; impulse and energy are per `ρS` without a material.
fn units_json(units: &Units) -> Value {
    use Measure::{Energy, Force, Impulse, Length, Stress, Time, Velocity};
    let measures = [Time, Length, Velocity, Stress, Force, Impulse, Energy];
    let name = |measure: Measure| Some(units.name(measure)).filter(|name| !name.is_empty());
    let names = measures.map(|measure| (measure.name().to_string(), json!(name(measure))));
    Value::Object(names.into_iter().collect())
}

fn ending_json(ending: &Ending, time: Value) -> Value {
    match ending {
        Ending::ExactnessEnds { .. } => {
            let mut value = json!({"time": time, "reason": "exactness ends"});
            if let (Some(value), Value::Object(more)) = (value.as_object_mut(), exactness_json(ending)) {
                value.extend(more);
            }
            value
        }
        other => json!({"time": time, "reason": other.to_string()}),
    }
}

fn exact_until_json(end: &ExactnessEnd) -> Value {
    match end {
        ExactnessEnd::Event(ending) => exactness_json(ending),
        parameter => json!({"reason": parameter.to_string()}),
    }
}

fn warnings_json(head: &Head) -> Vec<String> {
    head.warnings.iter().map(ToString::to_string).collect()
}

/// The event at no fraction, before which exactness ends.
fn exactness_json(ending: &Ending) -> Value {
    match ending {
        Ending::ExactnessEnds { kind: event, time: surd, near } => {
            json!({"event": event, "surd": surd, "near": near})
        }
        other => json!({"reason": other.to_string()}),
    }
}

/// Samples, schema 1.
pub fn samples_json<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> Value {
    let number = |x: &S| number_json(x, head.digits);
    let (columns, values) = sampled(samples, quantity, &head.units);
    let rows = samples.iter().zip(&values).map(|(sample, values)| {
        let named = columns.iter().map(|column| column.name.to_string());
        let bounds = named.clone().zip(values.iter().map(|x| bound_json(x, head.digits)));
        let values = named.zip(values.iter().map(number));
        json!({
            "time": number(&sample.time),
            "point": sample.point.as_ref().map(number),
            "side": sample.side,
            "values": values.collect::<serde_json::Map<_, _>>(),
            "uncertainty": bounds.collect::<serde_json::Map<_, _>>(),
        })
    });
    json!({
        "schema": 1,
        "title": head.title,
        "number": head.number,
        "quantity": quantity.name(),
        "units": units_json(&head.units),
        "exact_until": head.exact_until.as_ref().map(exact_until_json),
        "rows": rows.collect::<Vec<_>>(),
        "warnings": warnings_json(head),
    })
}
