//! `dalembert compare` on three contact codes: it finds what is wrong with them, and nothing where nothing is.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use crate::peers::{BAR, Rod, Row, SCHEMES, Scheme, csv};

const END: f64 = 7.5;

/// What `compare` says of `rows`, as JSON.
fn compare(scene: &str, rows: &[Row], more: &[&str]) -> Value {
    let folder = TempDir::new().unwrap();
    let path: PathBuf = folder.path().join("run.csv");
    std::fs::write(&path, csv(rows)).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_dalembert"))
        .args(["compare", scene, path.to_str().unwrap(), "--format", "json"])
        .args(more)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// `kind quantity` of every hint.
fn hints(report: &Value) -> Vec<String> {
    let text = |value: &Value| value.as_str().unwrap().to_string();
    let hints = report["hints"].as_array().unwrap();
    hints.iter().map(|hint| format!("{} {}", text(&hint["kind"]), text(&hint["quantity"]))).collect()
}

fn bar(rod: Rod, scheme: Scheme) -> Vec<Row> {
    rod.run(scheme, END, |_| true)
}

fn with(rows: &[Row], change: impl Fn(&mut Row)) -> Vec<Row> {
    let mut rows = rows.to_vec();
    rows.iter_mut().for_each(change);
    rows
}

#[test]
fn report() {
    for scheme in SCHEMES {
        let honest = bar(BAR, scheme);
        let mut cases: Vec<(&str, Vec<Row>)> = vec![("honest", honest.clone())];
        cases.push(("density 0.99", bar(Rod { density: 0.99, ..BAR }, scheme)));
        cases.push(("length 0.99", bar(Rod { length: 9.9, ..BAR }, scheme)));
        let dt = honest[1].t;
        cases.push(("half a step late", with(&honest, |row| row.t += dt / 2.0)));
        let mut back = honest.clone();
        for k in 1..back.len() {
            back[k].v = (honest[k].u - honest[k - 1].u) / dt;
        }
        cases.push(("v backward", back));
        cases.push(("late by .1", with(&honest, |row| row.t += 0.1)));
        cases.push(("energy x2", with(&honest, |row| row.energy *= 2.0)));
        cases.push(("sign u", with(&honest, |row| row.u = -row.u)));
        cases.push(("sign v", with(&honest, |row| row.v = -row.v)));
        cases.push(("sign force", with(&honest, |row| row.force = -row.force)));
        cases.push(("origin", with(&honest, |row| row.u += 0.1)));
        cases.push(("missing", BAR.run(scheme, END, |t| !(2.0..4.0).contains(&t))));
        for (name, rows) in cases {
            let report = compare("doyen-ern-piperno", &rows, &[]);
            println!("{scheme:?} {name}: {:?}", hints(&report));
            for hint in report["hints"].as_array().unwrap() {
                println!("      {}", hint["text"].as_str().unwrap());
            }
        }
    }
}
