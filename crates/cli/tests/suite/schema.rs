//! The JSON Schema of the outputs: what it says is what is written, at every level.

use std::fs;

use serde_json::Value;

use crate::command::{json, quiet};

fn is_of(kind: &str, value: &Value) -> bool {
    match kind {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("no type {other}"),
    }
}

/// Holds `value` against `schema`, whose words are those used below; a key that the schema does not name is refused.
fn holds(schema: &Value, root: &Value, value: &Value, path: &str) -> Result<(), String> {
    if let Some(name) = schema["$ref"].as_str() {
        let definition = &root["$defs"][name.trim_start_matches("#/$defs/")];
        assert!(definition.is_object(), "no definition {name}");
        holds(definition, root, value, path)?;
    }
    for word in schema.as_object().unwrap().keys() {
        let known = ["$ref", "$schema", "$defs", "title", "description", "oneOf", "type", "const", "enum", "required"];
        assert!(known.contains(&word.as_str()) || ["properties", "additionalProperties", "items"].contains(&&**word));
    }
    if let Some(forms) = schema["oneOf"].as_array() {
        let tried: Vec<_> = forms.iter().map(|form| holds(form, root, value, path)).collect();
        if tried.iter().filter(|tried| tried.is_ok()).count() != 1 {
            return Err(format!("{path}: not one of its forms: {tried:?}"));
        }
    }
    let kinds = [&schema["type"]].into_iter().chain(schema["type"].as_array().into_iter().flatten());
    let kinds: Vec<&str> = kinds.filter_map(Value::as_str).collect();
    if !kinds.is_empty() && !kinds.iter().any(|kind| is_of(kind, value)) {
        return Err(format!("{path}: {value} is none of {kinds:?}"));
    }
    let constant = schema.get("const").is_none_or(|constant| constant == value);
    let listed = schema["enum"].as_array().is_none_or(|known| known.contains(value) || value.is_null());
    if !constant || !listed {
        return Err(format!("{path}: {value} is not as the schema says"));
    }
    if let Some(object) = value.as_object() {
        for key in schema["required"].as_array().into_iter().flatten() {
            object.get(key.as_str().unwrap()).ok_or_else(|| format!("{path}: no {key}"))?;
        }
        let (known, others) = (schema["properties"].as_object(), schema.get("additionalProperties"));
        for (key, value) in object {
            match (known.and_then(|known| known.get(key)).or(others), known) {
                (Some(inner), _) => holds(inner, root, value, &format!("{path}.{key}"))?,
                (None, Some(_)) => return Err(format!("{path}: the schema has no {key}")),
                (None, None) => {}
            }
        }
    }
    for item in value.as_array().into_iter().flatten().filter(|_| schema.get("items").is_some()) {
        holds(&schema["items"], root, item, &format!("{path}[]"))?;
    }
    Ok(())
}

#[test]
fn every_output_is_what_the_schema_says() {
    let schema: Value = serde_json::from_str(&quiet(&["schema"])).unwrap();
    let check = |form: &str, args: &[&str]| {
        let value = json(&[args, &["--format", "json"]].concat());
        holds(&schema["$defs"][form], &schema, &value, form).unwrap();
        // And of all forms it is that one.
        holds(&schema, &schema, &value, form).unwrap();
    };
    let folder = tempfile::tempdir().unwrap();
    let [run, fine] = ["run.csv", "fine.csv"].map(|name| folder.path().join(name).to_str().unwrap().to_string());
    // Penetration, a pull, energy that is twice theirs, a contact that is missing: as much of the report as there may
    // be.
    let row = |k: i32, n: i32| {
        let t = 10.0 * f64::from(k) / f64::from(n);
        format!("{t},{},{},{},{}\n", -t.sin(), (3.0 * t).cos(), 900.0 + t, t)
    };
    for (name, n) in [(&run, 100), (&fine, 200)] {
        let rows: String = (0..=n).map(|k| row(k, n)).collect();
        fs::write(name, format!("t,u_end,force,E_total,h_rate\n{rows}")).unwrap();
    }
    for scene in ["doyen-ern-piperno", "figure-4-r02", "getfem-dynamic-contact"] {
        check("history", &["solve", scene]);
        check("samples", &["sample", scene, "--quantity", "energy", "--times", "0,1/4"]);
        check("reference", &["reference", scene]);
        check("reference", &["reference", scene, "--times", "0,1/2", "--points", "0..1:3"]);
        check("comparison", &["compare", scene, &run]);
        check("comparisons", &["compare", scene, &run, &fine]);
    }
    // A point that has an answer, and one that has none.
    check("sweep", &["sweep", "figure-4-r02", "--vary", "impact.speed=1,5", "--quantity", "bounce_time,energy"]);
    if cfg!(feature = "mp") {
        for numbers in ["--exact", "--certified"] {
            check("history", &["solve", "paper-strong", numbers]);
            check("reference", &["reference", "paper-strong", numbers]);
        }
        // At the second landing of the first, and at the touch of the second, the sides differ or there is none.
        for scene in ["doyen-ern-piperno", "mu-1-period-36"] {
            check("history", &["solve", scene, "--derivatives", "impact_speed,length"]);
        }
        check("history", &["solve", "doyen-ern-piperno", "--exact", "--derivatives", "impact_speed,modulus"]);
    }
}

/// The check sees what is wrong.
#[test]
fn what_is_not_so_is_seen() {
    let schema: Value = serde_json::from_str(&quiet(&["schema"])).unwrap();
    let right = json(&["reference", "paper-strong", "--columns", "t,u_end", "--format", "json"]);
    let spoil: [fn(&mut Value); 4] = [
        |value| value["schema"] = 2.into(),
        |value| drop(value.as_object_mut().unwrap().remove("cite")),
        |value| value["rows"][0][0] = Value::Null,
        |value| value["column"] = 1.into(),
    ];
    for spoil in spoil {
        let mut value = right.clone();
        spoil(&mut value);
        assert!(holds(&schema["$defs"]["reference"], &schema, &value, "").is_err());
    }
}
