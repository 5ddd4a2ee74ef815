//! Conventions of other codes, and the audit of what they keep.

use dalembert_compare::{Axis, Compression, Options};
use serde_json::Value;

use crate::compare;
use crate::peers::{BAR, Rod, Row, Scheme};

const END: f64 = 7.5;

/// Returns the run of `rod` by `scheme` through three contacts.
fn bar(rod: Rod, scheme: Scheme) -> Vec<Row> {
    rod.run(scheme, END)
}

pub(crate) fn with(rows: &[Row], change: impl Fn(&mut Row)) -> Vec<Row> {
    let mut rows = rows.to_vec();
    rows.iter_mut().for_each(change);
    rows
}

/// The options undo what the hints name.
#[test]
fn conventions_are_undone() {
    let honest = bar(Rod { elements: 100, ..BAR }, Scheme::Redistribution);
    let plain = compare("doyen-ern-piperno", &honest, &Options::default());
    let dt = honest[1].t;
    let other = with(&honest, |row| {
        (row.u, row.v, row.h, row.h_rate) = (-row.u, -row.v, -row.h, -row.h_rate);
        (row.u_top, row.v_top) = (-row.u_top, -row.v_top);
        (row.force, row.energy, row.t) = (-row.force, 2.0 * row.energy, row.t - 4.0 * dt);
    });
    let options = Options {
        axis: Axis::Down,
        compression: Some(Compression::Negative),
        energy_scale: Some("1/2".parse().unwrap()),
        shift: Some(format!("{:e}", 4.0 * dt).parse().unwrap()),
        ..Options::default()
    };
    let undone = compare("doyen-ern-piperno", &other, &options);
    assert_eq!(undone["hints"], serde_json::json!([]));
    for (a, b) in plain["quantities"].as_array().unwrap().iter().zip(undone["quantities"].as_array().unwrap()) {
        let l2 = |value: &Value| value["l2"]["relative"].as_f64().unwrap();
        assert!((l2(a) - l2(b)).abs() <= 1e-9 * l2(a), "{a} {b}");
    }
}

/// The audit of three codes against values by hand.
#[test]
fn the_audit_of_codes() {
    let audit = |scheme| compare("doyen-ern-piperno", &bar(BAR, scheme), &Options::default())["audit"].clone();
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
