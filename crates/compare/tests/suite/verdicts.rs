//! Hints for many schemes, meshes and steps, each right and with one fault.

use std::sync::LazyLock;

use dalembert::{Problem, Quantity, Side};
use dalembert_compare::Options;
use serde_json::Value;

use crate::conventions::with;
use crate::peers::{BAR, Rod, Row, SCHEMES, STEEL, Scheme};
use crate::{compare, compare_columns};

/// A run to the middle of the second contact.
const END: f64 = 4.5;
/// The end of the run of the steel bar, whose flight is long: the contact and three round trips.
const STEEL_END: f64 = 1.2e-3;

/// Returns runs with one fault of the size that a code may have: its kind, its value, and the run.
fn faults(rod: Rod, scheme: Scheme) -> Vec<(&'static str, f64, Vec<Row>)> {
    let right = rod.run(scheme, END);
    let dt = right[1].t;
    let extra = 1.0 / rod.elements as f64;
    let late = (0.02 / dt).round() * dt;
    let values = [("wave_speed", 0.03), ("wave_speed", -0.03), ("mass", 0.06), ("length", 0.03)];
    let others =
        [("start_velocity", 0.03), ("gravity", -1.0), ("gravity", -0.1), ("clock", 0.03), ("time_shift", late)];
    let mut faults: Vec<_> =
        values.into_iter().chain(others).map(|(kind, p)| (kind, p, off(rod, scheme, kind, p))).collect();
    faults.extend([
        ("force_factor", 1e-3, with(&right, |row| row.force *= 1e-3)),
        ("force_factor", 1e6, with(&right, |row| row.force *= 1e6)),
        ("factor", 1e3, with(&right, |row| row.u *= 1e3)),
        ("energy_factor", 2.0, with(&right, |row| row.energy *= 2.0)),
        ("sign", -1.0, with(&right, |row| row.u = -row.u)),
        ("sign", -1.0, with(&right, |row| row.force = -row.force)),
        ("origin", 0.5, with(&right, |row| row.u_top += 0.5)),
        // Displacements from the start, heights as they are.
        ("origin", -0.5, with(&right, |row| (row.u, row.u_top) = (row.u - 0.5, row.u_top - 0.5))),
        ("half_step", dt / 2.0, {
            let mut rows = right.clone();
            for k in 1..rows.len() {
                rows[k].v = (right[k].u - right[k - 1].u) / dt;
                rows[k].v_top = (right[k].u_top - right[k - 1].u_top) / dt;
                rows[k].h_rate = (right[k].h - right[k - 1].h) / dt;
            }
            rows
        }),
    ]);
    // Redistribution leaves no mass at the ground.
    if scheme != Scheme::Redistribution {
        faults.push(("end_mass", extra, Rod { ends: 2.0, ..rod }.run(scheme, END)));
    }
    // The velocities of some schemes are the differences of u anyway.
    let moved = |rows: &[Row]| right.iter().zip(rows).any(|(a, b)| (a.v_top - b.v_top).abs() > 1e-9 * rod.speed);
    faults.retain(|(kind, _, rows)| *kind != "half_step" || moved(rows));
    faults
}

/// Returns a run with a value of the scene or the clock off by the share `p`, or late by the time `p`.
fn off(rod: Rod, scheme: Scheme, kind: &str, p: f64) -> Vec<Row> {
    let run = |rod: Rod| rod.run(scheme, END);
    match kind {
        "wave_speed" => run(Rod { modulus: rod.modulus * (1.0 + p) * (1.0 + p), ..rod }),
        "mass" => run(Rod { density: rod.density * (1.0 + p), ..rod }),
        "length" => run(Rod { length: rod.length * (1.0 + p), ..rod }),
        "start_velocity" => run(Rod { speed: rod.speed * (1.0 + p), ..rod }),
        "gravity" => run(Rod { gravity: rod.gravity * (1.0 + p), ..rod }),
        "damping" => run(Rod { damping: p, ..rod }),
        "clock" => with(&run(rod), |row| row.t *= 1.0 + p),
        "time_shift" => with(&run(rod), |row| row.t += p),
        other => panic!("{other}"),
    }
}

struct Said {
    hints: Vec<(String, f64, f64)>,
    /// Kind, column and value.
    told_from: Vec<(String, String, f64)>,
}

fn said(scene: &str, rows: &[Row]) -> Said {
    let report: Value = compare(scene, rows, &Options::default());
    let list = |key: &str| report[key].as_array().unwrap().clone();
    let number = |value: &Value, key: &str| value[key].as_f64().unwrap();
    let text = |value: &Value, key: &str| value[key].as_str().unwrap().to_string();
    let hint = |hint: &Value| (text(hint, "kind"), number(hint, "value"), number(hint, "error"));
    let told = |told: &Value| (text(told, "kind"), text(told, "quantity"), number(told, "value"));
    Said { hints: list("hints").iter().map(hint).collect(), told_from: list("told_from").iter().map(told).collect() }
}

/// The right run of each scheme in 80 elements, as both tests of faults need it.
static RIGHT: LazyLock<Vec<Said>> = LazyLock::new(|| {
    let right = |scheme| said("doyen-ern-piperno", &Rod { elements: 80, ..BAR }.run(scheme, END));
    SCHEMES.map(right).into()
});

/// Returns whether a fault is named, its value within twice its standard error or a fifth.
fn is_named(hints: &[(String, f64, f64)], kind: &str, value: f64) -> bool {
    hints.iter().any(|hint| hint.0 == kind && (hint.1 - value).abs() <= (2.0 * hint.2).max(0.2 * value.abs()))
}

/// Runs without a fault besides their mesh and their step: at most one in 25 gets a hint.
#[test]
fn right_runs_get_no_hint() {
    let other = [Scheme::Moreau(0.2), Scheme::Theta(0.5, 1.0), Scheme::Theta(0.6, 0.5), Scheme::Hht(16.0)];
    let with_damping = [Scheme::Moreau(0.5), Scheme::Theta(0.5, 0.5), Scheme::Hht(4.0)];
    let mut runs: Vec<(Rod, Scheme, f64)> = Vec::new();
    for elements in [40, 80, 160] {
        runs.extend(SCHEMES.map(|scheme| (Rod { elements, ..BAR }, scheme, END)));
    }
    runs.extend(other.map(|scheme| (Rod { elements: 60, ..BAR }, scheme, END)));
    runs.extend(SCHEMES.into_iter().chain(other).map(|scheme| (Rod { elements: 50, ..STEEL }, scheme, STEEL_END)));
    for scheme in with_damping {
        runs.push((Rod { elements: 40, damping: 0.3, ..BAR }, scheme, END));
        runs.push((Rod { elements: 40, damping: 12.0, ..STEEL }, scheme, STEEL_END));
    }
    let mut alarms = Vec::new();
    for (rod, scheme, end) in &runs {
        let scene = rod.scene(*end);
        let hints = said(&scene, &rod.run(*scheme, *end)).hints;
        if !hints.is_empty() {
            alarms.push(format!("{scene}, {scheme:?}, {}: {hints:?}", rod.elements));
        }
    }
    println!("{} of {} right runs: {alarms:#?}", alarms.len(), runs.len());
    assert!(runs.len() == 50 && 25 * alarms.len() <= runs.len(), "{alarms:#?}");
}

/// A report that names no number says from what size on one would have been named; that of the right run of each scheme
/// is held to it. Faults of every scheme, backward Euler and HHT included: each that is as great as that is named.
/// Those below it are drowned by the errors of their scheme, and may be named or not: they are only counted.
#[test]
fn faults_are_named() {
    let (mut count, mut told, mut broken) = (0, 0, Vec::new());
    for (scheme, right) in SCHEMES.into_iter().zip(&*RIGHT) {
        let rod = Rod { elements: 80, ..BAR };
        for (kind, value, rows) in faults(rod, scheme) {
            let changed = |pick: fn(&Row) -> f64, of: &[Row]| of.iter().map(pick).fold(0.0f64, |a, b| a.max(b.abs()));
            // Factors as their share; a sign is a factor of −1.
            let (key, size) = match kind {
                "force_factor" => (("force_factor", "force"), (1.0 - value).abs()),
                "factor" => (("factor", "u_end"), value - 1.0),
                "energy_factor" => (("energy_factor", "E_total"), value - 1.0),
                "origin" => (("origin", "u_top"), value.abs()),
                "sign" if changed(|row| row.force.min(0.0), &rows) > 1.0 => (("force_factor", "force"), 2.0),
                "sign" => (("factor", "u_end"), 2.0),
                _ => ((kind, "all"), value.abs()),
            };
            let from = right.told_from.iter().find(|told| (told.0.as_str(), told.1.as_str()) == key);
            count += 1;
            let Some(from) = from.filter(|told| size >= told.2) else { continue };
            told += 1;
            let found = said("doyen-ern-piperno", &rows).hints;
            if !is_named(&found, kind, value) {
                broken.push(format!("{scheme:?}, {kind} {value}, from {}: {found:?}", from.2));
            }
        }
    }
    println!("{told} of {count} faults have to be named");
    assert!(broken.is_empty(), "{broken:#?}");
    assert!(count == 167 && told >= 60, "{told} of {count}");
}

/// Faults a fiftieth greater than the least that would be named, in both directions, are named.
#[test]
fn faults_at_their_limits_are_named() {
    let (mut count, mut broken) = (0, Vec::new());
    for (scheme, right) in SCHEMES.into_iter().zip(&*RIGHT) {
        let rod = Rod { elements: 80, ..BAR };
        let is_damped = matches!(scheme, Scheme::Moreau(_) | Scheme::Theta(..) | Scheme::Hht(_));
        for (kind, _, limit) in right.told_from.iter().filter(|told| told.1 == "all") {
            // A damping is positive, and some schemes have none.
            let values = if kind == "damping" { &[1.02][usize::from(!is_damped)..] } else { &[1.02, -1.02] };
            for value in values.iter().map(|part| part * limit) {
                count += 1;
                let found = said("doyen-ern-piperno", &off(rod, scheme, kind, value)).hints;
                if !is_named(&found, kind, value) {
                    broken.push(format!("{scheme:?}, {kind} {value}: {found:?}"));
                }
            }
        }
    }
    println!("{count} at their limits");
    assert!(count >= 50 && broken.is_empty(), "{count}: {broken:#?}");
}

/// A bar of 0.99 of the mass, as that of Siconos' reference file: only its energy before the contact shows it.
#[test]
fn a_mass_is_told_before_the_contact() {
    let scene = crate::scene("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = 0.5 }\nrun.time = 3\n");
    let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).gap("0.5").time(3).build().unwrap();
    let columns = [Quantity::EndDisplacement, Quantity::EndVelocity, Quantity::KineticEnergy];
    let times: Vec<f64> = (0..=300).map(|k| f64::from(k) / 100.0).collect();
    let exact = rod.doubles().unwrap().columns(&columns, &times, Some(Side::Right)).unwrap();
    let run = |mass: f64, speed: f64| {
        let mut columns = ["t", "u", "v", "kinetic"].map(|name| (name, Vec::new()));
        for (k, time) in times.iter().enumerate() {
            // Chatter at the ground, and energy that is lost there.
            let (chatter, kept) = if *time < 0.5 { (0.0, 1.0) } else { (0.3 * (900.0 * time).sin(), 0.95) };
            let (u, v, kinetic) = (exact[0][k], exact[1][k], exact[2][k]);
            let kinetic = format!("{:.6e}", kinetic * mass * kept * speed * speed).parse().unwrap();
            let row = [*time, u, v * speed + chatter, kinetic];
            columns.iter_mut().zip(row).for_each(|((_, values), value)| values.push(value));
        }
        let report = compare_columns(&scene, &columns, &Options::default());
        report["hints"].as_array().unwrap().clone()
    };
    let hints = run(0.99, 1.0);
    assert!(hints.len() == 1 && hints[0]["kind"] == "mass", "{hints:?}");
    let [value, error] = ["value", "error"].map(|key| hints[0][key].as_f64().unwrap());
    assert!((value + 0.01).abs() <= 2.0 * error && error < 1e-4, "{hints:?}");
    // Nothing is wrong with the mass of these: one is right, and the other one faster.
    for hints in [run(1.0, 1.0), run(1.0, 1.01)] {
        assert!(hints.iter().all(|hint| hint["kind"] != "mass"), "{hints:?}");
    }
}
