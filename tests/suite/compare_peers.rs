//! `dalembert compare` on three contact codes: it finds what is wrong with them, and nothing where nothing is.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use crate::peers::{BAR, Rod, Row, SCHEMES, Scheme, csv};

const END: f64 = 7.5;

/// What `compare` says of `rows`, as JSON.
pub(crate) fn compare(scene: &str, rows: &[Row], more: &[&str]) -> Value {
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

/// Three contacts of `rod`, by `scheme`.
fn bar(rod: Rod, scheme: Scheme) -> Vec<Row> {
    rod.run(scheme, END, |_| true)
}

pub(crate) fn with(rows: &[Row], change: impl Fn(&mut Row)) -> Vec<Row> {
    let mut rows = rows.to_vec();
    rows.iter_mut().for_each(change);
    rows
}

/// What the hints of a file are, `kind quantity` each, and their values.
#[track_caller]
fn found(what: &str, rows: &[Row], expected: &[&str]) -> Vec<f64> {
    let report = compare("doyen-ern-piperno", rows, &[]);
    let found = hints(&report);
    for hint in expected {
        assert!(found.iter().any(|found| found == hint), "{what}: no `{hint}` in {found:?}");
    }
    if expected.is_empty() {
        assert_eq!(found, Vec::<String>::new(), "{what}");
    }
    let value = |kind: &&str| {
        let place = found.iter().position(|found| found == kind).unwrap();
        report["hints"][place]["value"].as_f64().unwrap()
    };
    expected.iter().map(value).collect()
}

/// Codes with nothing wrong but their mesh: no hint, coarse or fine.
#[test]
fn honest_codes_get_no_hint() {
    for elements in [50, 400] {
        for scheme in SCHEMES {
            found(&format!("{scheme:?}, {elements}"), &bar(Rod { elements, ..BAR }, scheme), &[]);
        }
    }
}

/// One thing wrong at a time, in each code; the clock of a contact is known to a step, 0.125 % of it.
#[test]
fn what_is_wrong_is_found() {
    for scheme in SCHEMES {
        let what = |fault: &str| format!("{scheme:?}, {fault}");
        let honest = bar(Rod { elements: 200, ..BAR }, scheme);
        let dt = honest[1].t;
        let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() <= by, "{scheme:?}: {a}, expected {b}");
        // t₁ ∝ √ρ and ∝ L.
        let clock = found(&what("mass"), &bar(Rod { density: 0.99, ..BAR }, scheme), &["clock contact"]);
        near(clock[0], -0.005, 0.00125);
        let clock = found(&what("length"), &bar(Rod { length: 9.9, ..BAR }, scheme), &["clock contact"]);
        near(clock[0], -0.01, 0.00125);
        let late = found(&what("half a step"), &with(&honest, |row| row.t += dt / 2.0), &["time_shift h"]);
        near(late[0], dt / 2.0, dt / 8.0);
        // Dropped from where it takes 0.1 to the ground, on a clock that starts with the fall.
        let fall = |k: u32| {
            let left = 0.1 - f64::from(k) * dt;
            let (height, velocity) = ((BAR.speed - BAR.gravity * left / 2.0) * left, BAR.gravity * left - BAR.speed);
            Row { t: 0.1 - left, u: height, v: velocity, h: height, h_rate: velocity, force: 0.0, ..honest[0] }
        };
        let falling = (0..).map(fall).take_while(|row| row.t < 0.1 - dt / 2.0);
        let rows: Vec<Row> = falling.chain(with(&honest, |row| row.t += 0.1)).collect();
        let late = found(&what("late"), &rows, &["time_shift t"]);
        near(late[0], 0.1, dt);
        let late = found(&what("late, from the contact on"), &with(&honest, |row| row.t += 0.1), &["time_shift t"]);
        near(late[0], 0.1, dt);
        let mut between = honest.clone();
        for k in 1..between.len() {
            between[k].v = (honest[k].u - honest[k - 1].u) / dt;
        }
        let late = found(&what("velocity between steps"), &between, &["time_shift v_end"]);
        near(late[0], dt / 2.0, dt / 8.0);
        let factor = found(&what("½"), &with(&honest, |row| row.energy *= 2.0), &["scale E_total"]);
        near(factor[0], 2.0, 0.1);
        found(&what("u down"), &with(&honest, |row| row.u = -row.u), &["sign u_end"]);
        found(&what("v down"), &with(&honest, |row| row.v = -row.v), &["sign v_end"]);
        found(&what("tension"), &with(&honest, |row| row.force = -row.force), &["sign force"]);
        let offset = found(&what("origin"), &with(&honest, |row| row.u += 0.5), &["origin u_end"]);
        near(offset[0], 0.5, 0.05);
        let blind = Rod { elements: 200, ..BAR }.run(scheme, END, |t| !(2.0..4.0).contains(&t));
        assert_eq!(found(&what("no second contact"), &blind, &["missing contact"]), [1.0]);
    }
}

/// A force that is twice at every second step and none between has the same impulse: chatter is no hint, and a factor
/// shows behind it.
#[test]
fn a_factor_behind_chatter() {
    for scheme in SCHEMES {
        let chatter = |factor: f64| {
            let mut rows = bar(Rod { elements: 200, ..BAR }, scheme);
            rows.iter_mut().enumerate().for_each(|(k, row)| row.force *= factor * 2.0 * (k % 2) as f64);
            rows
        };
        found(&format!("{scheme:?}, chatter"), &chatter(1.0), &[]);
        for factor in [2.0, 1e-3] {
            let value = found(&format!("{scheme:?}, chatter × {factor}"), &chatter(factor), &["scale force"]);
            // The ends of a contact are known to a step, 1/400 of it.
            assert!((value[0] / factor - 1.0).abs() < 0.01, "{scheme:?}: {value:?}");
        }
    }
}

/// The options undo what the hints name.
#[test]
fn conventions_are_undone() {
    let honest = bar(Rod { elements: 100, ..BAR }, Scheme::Redistribution);
    let plain = compare("doyen-ern-piperno", &honest, &[]);
    let dt = honest[1].t;
    let other = with(&honest, |row| {
        (row.u, row.v, row.h, row.h_rate) = (-row.u, -row.v, -row.h, -row.h_rate);
        (row.force, row.energy, row.t) = (-row.force, 2.0 * row.energy, row.t - 4.0 * dt);
    });
    let (shift, more) = (format!("{:e}", 4.0 * dt), ["--axis", "down", "--compression", "-", "--energy-scale", "1/2"]);
    let undone = compare("doyen-ern-piperno", &other, &[&more[..], &["--shift", &shift]].concat());
    assert_eq!(undone["hints"], serde_json::json!([]));
    for (a, b) in plain["quantities"].as_array().unwrap().iter().zip(undone["quantities"].as_array().unwrap()) {
        let l2 = |value: &Value| value["l2"]["relative"].as_f64().unwrap();
        assert!((l2(a) - l2(b)).abs() <= 1e-9 * l2(a), "{a} {b}");
    }
}

/// The audit by hand: what a code keeps, it keeps.
#[test]
fn the_audit_of_codes() {
    let audit = |scheme| compare("doyen-ern-piperno", &bar(BAR, scheme), &[])["audit"].clone();
    let penalty = audit(Scheme::Penalty);
    // F = m₀/dt² u: 500 N press it in by 500 (h/c)²/(ρSh/2) = 0.0277.
    let depth = penalty["penetration"]["value"].as_f64().unwrap();
    assert!((depth - 500.0 * (0.025f64 / 30.0).powi(2) / 0.0125).abs() < 1e-4, "{depth}");
    let projection = audit(Scheme::Projection);
    assert_eq!((&projection["penetration"]["value"], &projection["tension"]["value"]), (&0.0.into(), &0.0.into()));
    // Half an element is stopped at each of three impacts, at 10, 10/3 and 10.
    let lost = -projection["energy_change"]["change"].as_f64().unwrap();
    assert!(lost > 0.0125 / 2.0 * 100.0, "{lost}");
    // A symplectic scheme without a mass to stop: the energy of about a node comes and goes.
    let redistribution = audit(Scheme::Redistribution);
    assert!(redistribution["energy_change"]["relative"].as_f64().unwrap().abs() < 0.005, "{redistribution}");
    // ∫F is a sum over steps in each of them: out of balance by less than a step of the greatest force.
    for audit in [penalty, projection, redistribution] {
        assert!(audit["momentum"].as_f64().unwrap().abs() < 3.0 * 500.0 * 0.025 / 30.0, "{audit}");
        assert_eq!((&audit["missed"], &audit["invented"]), (&0.into(), &0.into()));
    }
}
