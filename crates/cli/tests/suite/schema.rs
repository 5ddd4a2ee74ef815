//! The JSON Schema of the outputs: what it says is what is written, at every level.

use std::cell::RefCell;
use std::collections::HashMap;

use jsonschema::Validator;
use serde_json::Value;

use crate::command::{Folder, json, quiet};

/// The schema, in which an object with other keys than those that are named is refused; each form of it is prepared
/// once.
struct Strict {
    schema: Value,
    all: Validator,
    forms: RefCell<HashMap<String, Validator>>,
}

fn strict_schema() -> Strict {
    fn refuse_others(schema: &mut Value) {
        match schema {
            Value::Object(object) => {
                if object.contains_key("properties") && !object.contains_key("additionalProperties") {
                    object.insert("additionalProperties".into(), false.into());
                }
                object.values_mut().for_each(refuse_others);
            }
            Value::Array(list) => list.iter_mut().for_each(refuse_others),
            _ => (),
        }
    }
    let mut schema = serde_json::from_str(&quiet("schema")).unwrap();
    refuse_others(&mut schema);
    Strict { all: jsonschema::validator_for(&schema).unwrap(), schema, forms: RefCell::default() }
}

/// Holds `value` against the form of this name, and against the whole schema.
#[track_caller]
fn holds(strict: &Strict, form: &str, value: &Value) -> bool {
    let mut forms = strict.forms.borrow_mut();
    let one = forms.entry(form.to_string()).or_insert_with(|| {
        let mut one = strict.schema.clone();
        one.as_object_mut().unwrap().remove("anyOf");
        one["$ref"] = format!("#/$defs/{form}").into();
        jsonschema::validator_for(&one).unwrap()
    });
    for error in one.iter_errors(value) {
        eprintln!("{form}: {}: {error}", error.instance_path);
    }
    one.is_valid(value) && strict.all.is_valid(value)
}

#[test]
fn every_output_is_what_the_schema_says() {
    let schema = strict_schema();
    let check = |form: &str, args: &str| {
        let value = json(args);
        assert!(holds(&schema, form, &value), "{args}");
    };
    let folder = Folder::new();
    // Penetration, a pull, energy that is twice theirs, a contact that is missing: as much of the report as there may
    // be.
    let row = |k: i32, n: i32| {
        let t = 10.0 * f64::from(k) / f64::from(n);
        format!("{t},{},{},{},{}\n", -t.sin(), (3.0 * t).cos(), 900.0 + t, t)
    };
    let [run, fine] = [("run.csv", 100), ("fine.csv", 200)].map(|(name, n)| {
        let rows: String = (0..=n).map(|k| row(k, n)).collect();
        folder.write(name, format!("t,u_end,force,E_total,h_rate\n{rows}"))
    });
    for scene in ["doyen-ern-piperno", "figure-4-r02", "getfem-dynamic-contact"] {
        check("history", &format!("solve {scene}"));
        check("reference", &format!("sample {scene} --quantity energy --times 0,1/4 --uncertainty"));
        check("reference", &format!("sample {scene} --quantity field --times 0,1/4"));
        check("reference", &format!("reference {scene}"));
        check("reference", &format!("reference {scene} --times 0,1/2 --points 0..1:3"));
        // Drag dominates the flights of the second scene, which a warning says.
        check("comparison", &format!("compare {scene} {run} --quiet"));
        check("comparisons", &format!("compare {scene} {run} {fine} --quiet"));
    }
    let bars = folder.write("bars.csv", "t,u_top.1,force.1\n0,0,0\n0.1,0.01,0\n0.2,0.01,0.04\n");
    check("comparisons_of_bodies", &format!("compare openfoam-7-1-2 {bars} --quiet"));
    // A point that has an answer, and one that has none.
    check("sweep", "sweep figure-4-r02 --vary impact.speed=1,5 --quantity bounce_time,energy");
    for numbers in ["--exact", "--certified"] {
        check("history", &format!("solve paper-strong {numbers}"));
        check("reference", &format!("reference paper-strong {numbers}"));
    }
    for scene in ["schwarz-three-bars", "mpm-py-pile", "hopkinson-bar", "rose-column"] {
        for numbers in ["", "--digits 20", "--certified"] {
            check("chain", &format!("solve {scene} {numbers}"));
            let sample = format!("sample {scene} --times 1e-4,1/5000");
            check("reference", &format!("{sample} --uncertainty {numbers}"));
            check("reference", &format!("{sample} --side both {numbers}"));
        }
    }
    check("chain", "solve openfoam-7-1-2 --exact");
    check("chain", "solve openfoam-7-1-2 --exact --derivatives joint.1.gap,body.1.length");
    check("chain", "solve saint-venant-mass");
    check("reference", "sample openfoam-7-1-2 --exact --times 1/5 --quantity force.1");
    // At the second landing of the first, and at the touch of the second, the sides differ or there is none.
    for scene in ["doyen-ern-piperno", "mu-1-period-36"] {
        check("history", &format!("solve {scene} --derivatives impact_speed,length --quiet"));
    }
    check("history", "solve doyen-ern-piperno --exact --derivatives impact_speed,modulus");
    let sample = "sample getfem-dynamic-contact --quantity end --times 1 --exact";
    check("reference", &format!("{sample} --derivatives length"));
    let sample = "sample siconos-impacting-bar --quantity end --times 0 --exact";
    check("reference", &format!("{sample} --digits 9 --quiet"));
}

/// The check sees what is wrong.
#[test]
fn what_is_not_so_is_seen() {
    let schema = strict_schema();
    let right = json("reference paper-strong --columns t,u_end");
    let spoil: [fn(&mut Value); 4] = [
        |value| value["schema"] = 2.into(),
        |value| drop(value.as_object_mut().unwrap().remove("cite")),
        |value| value["rows"][0][0] = true.into(),
        |value| value["column"] = 1.into(),
    ];
    for spoil in spoil {
        let mut value = right.clone();
        spoil(&mut value);
        assert!(!holds(&schema, "reference", &value));
    }
}
