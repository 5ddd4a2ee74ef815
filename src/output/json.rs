//! JSON: numbers in double precision, strings otherwise.

use serde_json::{Value, json};

use super::record::{Finished, Head, Quantity, Record, Sample, bound_json, json as number_json};
use crate::motion::Ending;
use crate::number::Scalar;
use crate::solve::ExactnessEnd;

/// The JSON Schema of [`history_json`] and [`samples_json`].
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
    let contacts = record.contacts.iter().map(|Finished { contact, restitution, shares, energy }| {
        let mut value = json!({
            "from": number(&contact.from),
            "to": optional(contact.to.as_ref()),
            "impulse": number(&contact.impulse),
            "peak_stress": number(&contact.peak_stress),
            "restitution": {
                "momentum": optional(restitution.momentum.as_ref().ok()),
                "energy_squared": optional(restitution.energy_squared.as_ref().ok()),
                "translational_part": optional(shares.translational.as_ref()),
                "energy_kept": optional(shares.kept.as_ref()),
            },
            "energy": energy.as_ref().map(|energy| json!({
                "total": number(&energy.total),
                "translational": number(&energy.translational),
                "vibrational": number(&energy.vibrational),
            })),
        });
        let reasons = [
            ("momentum", restitution.momentum.as_ref().err()),
            ("energy_squared", restitution.energy_squared.as_ref().err()),
        ];
        for (name, reason) in reasons {
            if let Some(reason) = reason {
                value["restitution"]["undefined"][name] = reason.to_string().into();
            }
        }
        if let Some((stiffness, line)) = &record.forces {
            value["force"] = json!({
                "peak": number(&-(contact.peak_stress.clone() * stiffness)),
                "impulse": number(&(contact.impulse.clone() * line)),
            });
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
            "left": number(&piece.left),
            "right": number(&piece.right),
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
    let rows = samples.iter().map(|sample| {
        let bounds =
            quantity.names().iter().zip(&sample.values).map(|(name, x)| (name.to_string(), bound_json(x, head.digits)));
        let values = quantity.names().iter().zip(&sample.values).map(|(name, x)| (name.to_string(), number(x)));
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
        "exact_until": head.exact_until.as_ref().map(exact_until_json),
        "rows": rows.collect::<Vec<_>>(),
        "warnings": warnings_json(head),
    })
}
