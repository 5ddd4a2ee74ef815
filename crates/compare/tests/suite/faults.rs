//! Causes that were once named wrongly: damping, soft contacts, causes that are alike, velocities of Verlet's scheme.

use dalembert::{Quantity, Side};
use dalembert_compare::Options;
use serde_json::Value;

use crate::conventions::with;
use crate::peers::{self, BAR, Rod, Row, SCHEMES, Scheme};
use crate::{compare, compare_columns, scene};

const END: f64 = 4.5;

fn hints(report: &Value) -> Vec<Value> {
    report["hints"].as_array().unwrap().clone()
}

fn kinds(hints: &[Value]) -> Vec<&str> {
    hints.iter().map(|hint| hint["kind"].as_str().unwrap()).collect()
}

fn number(hint: &Value, key: &str) -> f64 {
    hint[key].as_f64().unwrap()
}

/// The scene of the bar with a damping, and some columns of the exact motion of another damping.
fn damped(in_scene: f64, in_data: f64, columns: &[Quantity]) -> Value {
    let [in_scene, in_data] = [in_scene, in_data].map(|damping| scene(&Rod { damping, ..BAR }.scene(END)));
    let times: Vec<f64> = (0..=450).map(|k| f64::from(k) / 100.0).collect();
    let exact = in_data.problem.doubles().unwrap();
    let values = exact.columns(columns, &times, Some(Side::Right)).unwrap();
    let names = columns.iter().map(|column| column.name()).zip(values);
    let data: Vec<(&str, Vec<f64>)> = std::iter::once(("t", times)).chain(names).collect();
    compare_columns(&in_scene, &data, &Options::default())
}

/// Exact data of another damping, and of none, are told their damping, whichever columns there are.
#[test]
fn damping_is_named() {
    let all = [Quantity::EndDisplacement, Quantity::EndVelocity, Quantity::Force, Quantity::TopDisplacement];
    let mut count = 0;
    for (in_scene, in_data) in [(0.0, 0.05), (0.0, 0.3), (0.3, 0.4), (0.3, 0.0)] {
        for columns in [&all[..], &all[..1], &all[2..3]] {
            let found = hints(&damped(in_scene, in_data, columns));
            let damping = found.iter().find(|hint| hint["kind"] == "damping");
            let damping = damping.unwrap_or_else(|| panic!("{in_scene} {in_data} {columns:?}: {found:#?}"));
            let (value, error) = (number(damping, "value"), number(damping, "error"));
            assert!((value - in_data).abs() <= (2.0 * error).max(0.02 * in_data), "{in_data}: {found:#?}");
            count += usize::from(damping["asserted"] == true);
        }
    }
    assert!(count >= 9, "{count} of 12 asserted");
}

/// The damping of contact codes.
#[test]
fn damping_of_schemes_is_named() {
    for scheme in [Scheme::Moreau(0.5), Scheme::Theta(0.5, 0.5), Scheme::Hht(4.0)] {
        let rows = Rod { elements: 80, damping: 0.3, ..BAR }.run(scheme, END);
        let found = hints(&compare("doyen-ern-piperno", &rows, &Options::default()));
        assert_eq!(kinds(&found)[0], "damping", "{scheme:?}: {found:#?}");
        assert!((number(&found[0], "value") - 0.3).abs() <= 0.06, "{scheme:?}: {found:#?}");
    }
}

/// The columns of a first-order upwind scheme for the invariants of the bar, at a CFL number of 0.9.
fn upwind(cells: usize) -> Vec<(&'static str, Vec<f64>)> {
    let (wave_speed, gravity, share) = (30.0, 10.0, 0.9);
    let step = share * 10.0 / cells as f64 / wave_speed;
    let (mut p, mut q) = (vec![-10.0; cells], vec![-10.0; cells]);
    let mut columns = vec![("t", vec![]), ("u_end", vec![]), ("v_end", vec![]), ("force", vec![])];
    let mut u = 0.0f64;
    for k in 0..(END / step) as usize {
        let arriving = q[0];
        let pressed = u <= 0.0 && arriving < 0.0;
        let (v, leaving) = if pressed { (0.0, -arriving) } else { (arriving, arriving) };
        let row = [k as f64 * step, u, v, if pressed { -arriving * wave_speed } else { 0.0 }];
        columns.iter_mut().zip(row).for_each(|((_, column), value)| column.push(value));
        u = (u + v * step).max(0.0);
        let top = p[cells - 1];
        let upward = |k: usize| p[k] - share * (p[k] - if k == 0 { leaving } else { p[k - 1] }) - gravity * step;
        let downward = |k: usize| q[k] - share * (q[k] - q.get(k + 1).unwrap_or(&top)) - gravity * step;
        (p, q) = ((0..cells).map(upward).collect(), (0..cells).map(downward).collect());
    }
    columns
}

/// A scheme that takes up energy by itself looks damped; that its damping is wrong is not asserted.
#[test]
fn the_dissipation_of_a_scheme_is_not_asserted_as_damping() {
    for cells in [100, 200, 400] {
        let found = hints(&compare_columns(&scene("doyen-ern-piperno"), &upwind(cells), &Options::default()));
        assert_eq!(kinds(&found)[..2], ["damping", "numerical_damping"], "{cells}: {found:#?}");
        assert!(found[..2].iter().all(|hint| hint["asserted"] == false), "{cells}: {found:#?}");
    }
}

/// A gap of a few samples in a contact is chatter, whatever flights come after the data.
#[test]
fn flights_after_the_data_do_not_make_chatter_a_contact() {
    let scene = scene(&Rod { damping: 0.1, ..BAR }.scene(6.5));
    let times: Vec<f64> = (0..=4000).map(|k| f64::from(k) * 0.0015).collect();
    let exact = scene.problem.doubles().unwrap();
    let shortest = exact.contacts().windows(2).map(|pair| pair[1].impact - pair[0].release.unwrap());
    assert!(shortest.fold(1.0, f64::min) < 0.014, "no short flight after the data");
    let mut force = exact.columns(&[Quantity::Force], &times, Some(Side::Right)).unwrap().swap_remove(0);
    let gap = times.iter().zip(&mut force).filter(|(t, _)| (4.8..4.8045).contains(*t));
    let closed = gap.map(|(_, force)| std::mem::take(force)).filter(|force| *force > 0.0).count();
    let report = compare_columns(&scene, &[("t", times), ("force", force)], &Options::default());
    assert!(closed == 3 && report["audit"]["invented"] == 0, "{closed} {}", report["audit"]);
}

/// Some columns of a contact code.
fn columns_of(rows: &[Row], names: &[&str]) -> Vec<(&'static str, Vec<f64>)> {
    peers::columns(rows).into_iter().filter(|(name, _)| names.contains(name)).collect()
}

/// A penalty of an eighth of the stiffness of an element is too soft, and is told by its penetration.
#[test]
fn soft_contact_is_named() {
    let bar = scene("doyen-ern-piperno");
    for (spring, elements) in [(0.125, 80), (0.25, 50)] {
        let rod = Rod { elements, ..BAR };
        let rows = rod.run(Scheme::Hht(spring), END);
        let softness = BAR.length / elements as f64 / spring;
        for names in [&["t", "u", "v", "force", "u_top", "v_top", "h", "h_rate", "E_total"][..], &["t", "u", "force"]] {
            let found = hints(&compare_columns(&bar, &columns_of(&rows, names), &Options::default()));
            assert_eq!(kinds(&found).first(), Some(&"soft_contact"), "{spring} {names:?}: {found:#?}");
            let value = number(&found[0], "value") * BAR.length;
            assert!((value / softness - 1.0).abs() < 0.2 && found[0]["asserted"] == true, "{softness}: {found:#?}");
        }
    }
}

/// A rod of unit length, wave speed and mass that hits the ground at unit speed.
const UNIT: Rod = Rod { length: 1.0, modulus: 1.0, speed: 1.0, ..BAR };

/// The columns of the tests of soft contacts.
const MANY_AND_FEW: [&[&str]; 2] =
    [&["t", "u", "v", "force", "u_top", "v_top", "h", "h_rate", "E_total"], &["t", "u", "force"]];

/// A penalty of up to 100 EA/L is told by its effects where the mesh and the steps are so fine that it dominates.
#[test]
fn stiff_penalties_on_fine_meshes_are_named() {
    for (gravity, penalty) in [0.0, 0.3].into_iter().flat_map(|g| [20.0, 40.0, 100.0].map(|k| (g, k))) {
        let rod = Rod { gravity, ..UNIT };
        let rows = rod.run(Scheme::Hht(penalty / rod.elements as f64), END);
        for names in MANY_AND_FEW {
            let report = compare_columns(&scene(&rod.scene(END)), &columns_of(&rows, names), &Options::default());
            let found = hints(&report);
            let soft = &found[0];
            assert!(soft["kind"] == "soft_contact" && soft["asserted"] == true, "{gravity} {penalty}: {found:#?}");
            // The mesh and the steps yield too, by a share of an element.
            let off = number(soft, "value") - 1.0 / penalty;
            assert!(off.abs() <= 0.5 / rod.elements as f64, "{gravity} {penalty}: {found:#?}");
        }
    }
}

/// Schemes with rigid contact are not called soft, on coarse meshes and on fine ones.
#[test]
fn rigid_contacts_are_not_soft() {
    let rigid = SCHEMES.into_iter().filter(|scheme| !matches!(scheme, Scheme::Penalty | Scheme::Hht(_)));
    for (scheme, elements) in rigid.flat_map(|scheme| [20, 100, 400].map(|elements| (scheme, elements))) {
        for gravity in [0.0, 0.3] {
            let rod = Rod { gravity, elements, ..UNIT };
            let rows = rod.run(scheme, END);
            for names in MANY_AND_FEW {
                let report = compare_columns(&scene(&rod.scene(END)), &columns_of(&rows, names), &Options::default());
                let found = hints(&report);
                assert!(!kinds(&found).contains(&"soft_contact"), "{scheme:?} {elements} {gravity}: {found:#?}");
            }
        }
    }
}

/// Beside a rod on a spring, data of another stiffness are told by how much it is off, and those of the same one by
/// nothing.
#[test]
fn another_stiffness_is_named() {
    let options = Options { contact_stiffness: Some("20".parse().unwrap()), ..Options::default() };
    for (gravity, share) in [0.0, 0.3].into_iter().flat_map(|g| [-0.5, 0.0, 0.5].map(|p| (g, p))) {
        let rod = Rod { gravity, elements: 100, ..UNIT };
        let rows = rod.run(Scheme::Hht(20.0 * (1.0 + share) / rod.elements as f64), END);
        // The energy of the spring is not that of the rod.
        for names in [&["t", "u", "v", "force", "u_top", "v_top", "h", "h_rate"][..], &["t", "u", "force"]] {
            let report = compare_columns(&scene(&rod.scene(END)), &columns_of(&rows, names), &options);
            let found = hints(&report);
            if share == 0.0 {
                assert!(found.is_empty(), "{gravity}: {found:#?}");
                continue;
            }
            assert!(kinds(&found) == ["contact_stiffness"] && found[0]["asserted"] == true, "{share}: {found:#?}");
            let (value, error) = (number(&found[0], "value"), number(&found[0], "error"));
            assert!((value - share).abs() <= 2.0 * error && error < share.abs() / 2.0, "{share}: {found:#?}");
            let text = found[0]["text"].as_str().unwrap();
            let sign = if share > 0.0 { '+' } else { '−' };
            assert!(text.starts_with(&format!("contact stiffness off by {sign}")), "{text}");
        }
    }
}

/// The top alone does not tell a contact that is soft by an element of a coarse mesh from a longer rod: both are
/// listed, and neither is asserted.
#[test]
fn causes_that_are_alike_are_both_listed() {
    let bar = scene("rod = { length = 10, modulus = 900, density = 1, area = 1 }\nimpact.speed = 10\nrun.time = 3\n");
    let rows = Rod { elements: 16, gravity: 0.0, ..BAR }.run(Scheme::Hht(1.0), 3.0);
    let found = hints(&compare_columns(&bar, &columns_of(&rows, &["t", "u_top"]), &Options::default()));
    let kinds_found = kinds(&found);
    assert!(kinds_found.contains(&"soft_contact") && kinds_found.contains(&"length"), "{found:#?}");
    assert!(found.iter().all(|hint| hint["asserted"] == false), "{found:#?}");
    // Without gravity, and by displacements alone, only L/c is known.
    let text = |length: f64| {
        format!("rod = {{ length = {length}, wave_speed = 30 }}\nimpact = {{ speed = 10, gap = 2 }}\nrun.time = 3\n")
    };
    let times: Vec<f64> = (0..=300).map(|k| f64::from(k) / 100.0).collect();
    let exact = scene(&text(10.4)).problem.doubles().unwrap();
    let u = exact.columns(&[Quantity::EndDisplacement], &times, Some(Side::Right)).unwrap().remove(0);
    let found = hints(&compare_columns(&scene(&text(10.0)), &[("t", times), ("u", u)], &Options::default()));
    let kinds = kinds(&found);
    assert!(kinds.contains(&"length") && kinds.contains(&"wave_speed"), "{found:#?}");
    assert!(found.iter().all(|hint| hint["asserted"] == false), "{found:#?}");
}

/// Verlet's scheme without gravity in its first step: its velocities lag by half a step, but belong to whole steps.
#[test]
fn velocities_at_whole_steps_are_not_between_two() {
    let rod = Rod { elements: 80, ..BAR };
    let right = rod.run(Scheme::Penalty, END);
    let dt = right[1].t;
    let lag = rod.gravity * dt / 2.0;
    let late = with(&right, |row| {
        (row.u_top, row.v_top, row.h, row.h_rate) =
            (row.u_top - lag * row.t, row.v_top - lag, row.h - lag * row.t, row.h_rate - lag);
    });
    let clock = with(&right, |row| row.t *= 1.03);
    for rows in [late, clock] {
        let found = hints(&compare("doyen-ern-piperno", &rows, &Options::default()));
        assert!(found.iter().all(|hint| hint["kind"] != "half_step"), "{found:#?}");
    }
}

/// The columns of the exact motion of a scene at `times`, the limits from later times.
fn exact(text: &str, columns: &[Quantity], times: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
    let values = scene(text).problem.doubles().unwrap().columns(columns, times, Some(Side::Right)).unwrap();
    let names = columns.iter().map(|column| column.name()).zip(values);
    std::iter::once(("t", times.to_vec())).chain(names).collect()
}

const ENDS: [Quantity; 2] = [Quantity::EndDisplacement, Quantity::EndVelocity];

/// A row with a side has the value at its time, though a jump follows within the rounding of the written times.
#[test]
fn rows_with_a_side_keep_their_value_before_a_jump() {
    // The end lands at 3 + √2; 4.4 may be any time from 4.35 to 4.45.
    let times: Vec<f64> = (0..=44).map(|k| f64::from(k) / 10.0).collect();
    let mut data = exact("paper-weak", &ENDS, &times);
    data.push(("side", vec![1.0; times.len()]));
    let report = compare_columns(&scene("paper-weak"), &data, &Options::default());
    for column in report["quantities"].as_array().unwrap() {
        assert_eq!(column["linf"]["absolute"], 0.0, "{column}");
    }
}

/// A gap that is not that of the scene is named, or asked for beside the shift in time that it causes.
#[test]
fn a_gap_is_named() {
    let text = |gap: &str| {
        format!(
            "rod = {{ length = 0.5, modulus = 210e9, density = 7850, area = 1e-4 }}\n\
             impact = {{ speed = 2, gap = {gap} }}\ngravity.acceleration = 9.81\nrun.time = 1.5e-3"
        )
    };
    let times: Vec<f64> = (0..=300).map(|k| f64::from(k) * 5e-6).collect();
    let of = |columns: &[Quantity]| {
        let data = exact(&text("1.2e-3"), columns, &times);
        hints(&compare_columns(&scene(&text("1e-3")), &data, &Options::default())).swap_remove(0)
    };
    let gap = of(&ENDS[..1]);
    assert!(gap["kind"] == "gap" && (number(&gap, "value") - 0.2).abs() < 1e-3, "{gap}");
    // Velocities tell the shift of their jumps as well as the gap.
    let shift = of(&ENDS);
    assert!(shift["text"].as_str().unwrap().contains("or is the gap longer by 0.000199"), "{shift}");
}

/// Displacements and velocities in millimetres, a body that starts the other way, and columns of zeros have one hint.
#[test]
fn data_in_another_unit_of_another_start_or_of_zeros_have_one_hint() {
    let text = BAR.scene(END);
    let times: Vec<f64> = (0..=200).map(|k| f64::from(k) / 50.0).collect();
    let mut data = exact(&text, &ENDS, &times);
    data[1..].iter_mut().flat_map(|(_, values)| values).for_each(|value| *value *= 1000.0);
    let up = vec![
        ("t", times.clone()),
        ("u_end", times.iter().map(|t| 10.0 * t - 5.0 * t * t).collect()),
        ("v_end", times.iter().map(|t| 10.0 - 10.0 * t).collect()),
    ];
    let zeros = vec![("t", times.clone()), ("force", vec![0.0; times.len()])];
    for (data, kind, value) in [(data, "factor", 1000.0), (up, "start_velocity", -1.0), (zeros, "empty", 0.0)] {
        let found = hints(&compare_columns(&scene(&text), &data, &Options::default()));
        assert_eq!((kinds(&found), number(&found[0], "value").round()), (vec![kind], value), "{found:#?}");
    }
}

/// An energy without that of the weight is not the energy of an unstable scheme.
#[test]
fn a_missing_potential_energy_is_asked_after() {
    let text = BAR.scene(END);
    let times: Vec<f64> = (0..=450).map(|k| f64::from(k) / 100.0).collect();
    let parts = exact(&text, &[Quantity::KineticEnergy, Quantity::StrainEnergy], &times);
    let sums = parts[1].1.iter().zip(&parts[2].1).map(|(kinetic, strain)| kinetic + strain).collect();
    let data = vec![("t", times.clone()), ("E_total", sums)];
    let found = hints(&compare_columns(&scene(&text), &data, &Options::default()));
    assert_eq!(kinds(&found), ["no_potential"], "{found:#?}");
    let whole = exact(&text, &[Quantity::Energy], &times);
    assert_eq!(hints(&compare_columns(&scene(&text), &whole, &Options::default())), [] as [Value; 0]);
}

/// Noise of a thousandth in flight does not make one contact of all.
#[test]
fn noise_of_a_force_makes_no_contact() {
    let text = BAR.scene(END);
    let times: Vec<f64> = (0..=1800).map(|k| f64::from(k) / 400.0).collect();
    let mut data = exact(&text, &[Quantity::Force], &times);
    let most = data[1].1.iter().copied().fold(0.0, f64::max);
    let noise = |k: usize| 1e-3 * most * (1.7 * k as f64 * k as f64).sin();
    data[1].1.iter_mut().enumerate().for_each(|(k, force)| *force += noise(k));
    let report = compare_columns(&scene(&text), &data, &Options::default());
    assert_eq!([&report["audit"]["missed"], &report["audit"]["invented"]], [0, 0], "{}", report["contacts"]);
}

/// A rod that is compressed before its contact has another kinetic energy at the speed of its end than one that moves
/// as one: it accuses no mass.
#[test]
fn a_deforming_rod_accuses_no_mass() {
    let text = "getfem-dynamic-contact";
    let times: Vec<f64> = (0..=200).map(|k| f64::from(k) / 100.0).collect();
    let mut data = exact(text, &[Quantity::EndVelocity, Quantity::KineticEnergy], &times);
    data[2].1.iter_mut().for_each(|energy| *energy *= 0.995);
    let found = hints(&compare_columns(&scene(text), &data, &Options::default()));
    assert!(!kinds(&found).contains(&"mass"), "{found:#?}");
}
