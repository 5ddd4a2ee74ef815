//! What data `compare` reads: units in names, folders of arrays, and files as others write them.

use std::fs;

use ndarray::Array1;
use ndarray_npy::WriteNpyExt;
use serde_json::Value;

use crate::command::Folder;

/// E = ρ = S = c = L = 1, μ = 1: contact on [0, 2] with a force of 1 N.
const SCENE: &str = "[rod]\nlength = 1\nmodulus = 1\ndensity = 1\narea = 1\n[impact]\nspeed = 1\n[run]\ntime = 4\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("rod.toml", SCENE);
    folder
}

/// Every relative and absolute L2.
fn norms(report: &Value) -> Vec<(String, f64)> {
    let norm = |quantity: &Value| {
        let name = quantity["name"].as_str().unwrap().to_string();
        (name, quantity["l2"]["absolute"].as_f64().unwrap())
    };
    report["quantities"].as_array().unwrap().iter().map(norm).collect()
}

/// The same data in other units are the same data, and it is said.
#[test]
fn units_in_names() {
    let folder = folder();
    let rows = [[0.0, 0.0, 1.0, 0.5], [1.0, 0.01, 1.0, 0.5], [2.0, 0.0, 0.75, 0.5], [3.0, 1.0, 0.0, 0.5]];
    let written = |header: &str, units: [f64; 4]| {
        let row = |row: &[f64; 4]| (0..4).map(|k| (row[k] / units[k]).to_string()).collect::<Vec<_>>().join(",") + "\n";
        folder.write("run.csv", header.to_string() + "\n" + &rows.iter().map(row).collect::<String>());
        folder.json("compare rod.toml run.csv")
    };
    let plain = written("t,u,force,E_total", [1.0; 4]);
    assert_eq!(plain["notes"], serde_json::json!([]));
    for (header, units, said) in [
        ("t [s],u [m],force [N],E_total [J]", [1.0; 4], None),
        (
            "t [ms],u [mm],force [kN],E_total [N mm]",
            [1e-3, 1e-3, 1e3, 1e-3],
            Some("units: t [ms] in s, u [mm] in m, force [kN] in N, E_total [N mm] in J"),
        ),
        ("time (µs),u (in),force (lbf),E_total (kg m^2/s^2)", [1e-6, 0.0254, 4.4482216152605, 1.0], Some("units: ")),
    ] {
        let other = written(header, units);
        match said {
            None => assert_eq!(other["notes"], serde_json::json!([])),
            Some(said) => assert!(other["notes"][0].as_str().unwrap().starts_with(said), "{}", other["notes"]),
        }
        for ((name, a), (_, b)) in norms(&plain).into_iter().zip(norms(&other)) {
            assert!((a - b).abs() <= 1e-12 * a, "{header}, {name}: {a} {b}");
        }
    }
    // Names apart by white space, a unit beside each.
    folder.write("run.dat", "# t [ms]  u [m]\n0 0\n1000 0\n2000 0\n3000 1\n");
    assert_eq!(norms(&folder.json("compare rod.toml run.dat")), [("u_end".into(), 0.0)]);
    // What measures something else is refused; a map takes a column as it is.
    folder.write("run.csv", "t,force [MPa]\n0,1\n1,1\n");
    let said = "found the column `force [MPa]`, expected it in N as in the scene";
    folder.refused("compare rod.toml run.csv", &[said]);
    folder.run("compare rod.toml run.csv --map t=t,force=1").text(0);
}

/// A scene without units has numbers without units: they are taken as they are, and it is said.
#[test]
fn units_without_units() {
    let folder = folder();
    let scene = SCENE.replace("modulus = 1\ndensity = 1\narea = 1", "wave_speed = 1");
    folder.write("rod.toml", scene);
    folder.write("run.csv", "t [ms],u\n0,0\n1,0\n2,0\n");
    let report = folder.json("compare rod.toml run.csv");
    assert_eq!(report["notes"], serde_json::json!(["units: t [ms] as it is, the scene having no units"]));
}

/// A folder holds a quantity a file, called as the file is.
#[test]
fn a_folder_of_arrays() {
    let folder = folder();
    fs::create_dir(folder.path("arrays")).unwrap();
    let refused = |said: &str| folder.refused("compare rod.toml arrays", &[said]);
    refused("arrays: cannot be read: found no .npy in the folder");
    let write = |name: &str, values: Vec<f64>| {
        Array1::from(values).write_npy(fs::File::create(folder.path(&format!("arrays/{name}"))).unwrap()).unwrap();
    };
    write("t.npy", vec![0.0, 1.0, 3.0]);
    write("u.npy", vec![0.0, 0.0, 1.0]);
    write("contact_force.npy", vec![1.0, 1.0, 0.0]);
    write("mesh.npy", vec![1.0, 2.0]);
    let report = folder.json("compare rod.toml arrays");
    assert_eq!(norms(&report), [("force".into(), 0.0), ("u_end".into(), 0.0)]);
    assert_eq!(report["notes"], serde_json::json!(["not used: mesh"]));
    write("u.npy", vec![0.0, 0.0]);
    refused("`u`: found 2 rows, expected 3 as in `t`");
}
