//! Values at chosen times, and published ones beside ours.

use serde_json::Value;

use crate::command::{Folder, Run, json, keys, quiet, refused, refused_with, run, run_with};

/// The names of the columns.
pub(crate) fn names(file: &Value) -> Vec<&str> {
    file["columns"].as_array().unwrap().iter().map(|column| column["name"].as_str().unwrap()).collect()
}

/// The values of a column, row by row.
#[track_caller]
pub(crate) fn column<'a>(file: &'a Value, name: &str) -> Vec<&'a Value> {
    let place = names(file).iter().position(|known| *known == name);
    let place = place.unwrap_or_else(|| panic!("no column {name}"));
    file["rows"].as_array().unwrap().iter().map(|row| &row[place]).collect()
}

#[test]
fn samples() {
    let out = quiet("sample paper-strong --quantity strain --times 1,2 --side left");
    let cells: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(cells[0], ["t", "side", "strain"]);
    // −(μ + g t)/c.
    assert_eq!(cells[2..], [["1", "left", "-4"], ["2", "left", "-5"]]);

    for (quantity, names) in [
        ("strain", &["strain"][..]),
        ("end", &["u_end", "v_end"]),
        ("top", &["u_top", "v_top"]),
        ("centre", &["h", "h_rate"]),
        ("energy", &["E_total", "E_h", "E_z"]),
        ("field", &["u", "v", "strain"]),
        ("u_end", &["u_end"]),
        ("E_z,end", &["E_z", "u_end", "v_end"]),
    ] {
        let args = format!("sample paper-strong --quantity {quantity} --times 0..2:3");
        let file = json(&args);
        let keys: &[&str] = if quantity == "field" { &["t", "side", "x"] } else { &["t", "side"] };
        let expected = [keys, names].concat();
        assert_eq!(self::names(&file), expected);
        // The field has two ends and the middle for each time.
        assert_eq!(file["rows"].as_array().unwrap().len(), if quantity == "field" { 9 } else { 3 });
        for name in names {
            assert!(column(&file, name).iter().all(|value| value.is_number()), "{quantity}: {name}");
        }
        assert_eq!(column(&file, "t").last().unwrap(), &&Value::from(2.0));
        let csv = quiet(&format!("{args} --format csv --bare --uncertainty"));
        let head: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
        assert_eq!(head.iter().filter(|name| name.ends_with("_uncertainty")).count(), expected.len() - 1);
        assert!(head.contains(&format!("{}_uncertainty", names[0]).as_str()), "{head:?}");
        assert_eq!(csv.lines().count(), file["rows"].as_array().unwrap().len() + 1);
    }
    refused("sample paper-strong --quantity end,top,u_end --times 1", &["--quantity u_end twice"]);
    refused(
        "sample paper-strong --quantity field,energy --times 1",
        &["found the quantity energy along the rod, expected one of field"],
    );
}

/// `reference` is `sample` with other defaults.
#[test]
fn a_golden_file_is_a_sample() {
    let both = "doyen-ern-piperno --times 0..2:5 --quantity";
    let golden = quiet(&format!("reference {both} t,side,u_end,force"));
    let sample = format!("sample {both} u_end,force --side both --format csv");
    assert_eq!(golden, quiet(&sample));
    let golden = quiet(&format!("reference {both} end --format table --side right"));
    assert!(golden.starts_with("         u_end"), "{golden}");
    // The stress is the strain times the modulus, at points and in the mean of cells.
    let args = "sample doyen-ern-piperno --times 1/3 --points 0..10:3";
    for field in ["points", "averages", "p1"] {
        let file = json(&format!("{args} --quantity strain,stress --field {field}"));
        for (strain, stress) in column(&file, "strain").into_iter().zip(column(&file, "stress")) {
            let (strain, stress) = (strain.as_f64().unwrap(), stress.as_f64().unwrap());
            assert!((stress - 900.0 * strain).abs() <= 1e-12 * stress.abs(), "{strain} {stress}");
        }
    }
}
#[test]
fn samples_in_fractions_have_two_sides() {
    let at = |side| {
        let args = "sample paper-strong --quantity field --times 2 --points 0,1/3 --exact";
        json(&format!("{args} --side {side}"))
    };
    // At the release: −(μ + 2g)/c before it, nothing after it.
    assert_eq!(column(&at("left"), "strain")[0], "-5");
    assert_eq!(column(&at("right"), "strain")[0], "0");
    assert_eq!(column(&at("right"), "x")[1], "1/3");
    // A zero in digits is a zero, not what rounding leaves of it.
    let args = "sample doyen-ern-piperno --quantity centre --times 0 --digits 38";
    assert_eq!(column(&json(args), "h")[0], "0");
}

/// The published values of the built-in scenes: ours round to them, or are within what the scene says.
#[test]
fn published_values_beside_ours() {
    let rows = json("scenes ansys-vm265 --targets");
    let rows = rows.as_array().unwrap();
    for row in rows {
        keys(row, "quantity t published ours difference within agrees expected source note");
    }
    // gap/μ, and 2L/c after it.
    let close = |value: &Value, truth: f64| assert!((value.as_f64().unwrap() - truth).abs() < 1e-12 * truth, "{value}");
    close(&rows[0]["ours"], 0.01 / 202.2);
    close(&rows[2]["ours"], 0.01 / 202.2 + 20.0 / (3e7f64 / 0.73e-3).sqrt());
    assert_eq!((&rows[0]["quantity"], &rows[0]["t"]), (&"impact".into(), &Value::Null));

    let table = quiet("scenes code-aster-sdnv100 --targets");
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
    assert!(table.contains("E_total, J                   2e-6      3200.0     3200            0\n"), "{table}");
    assert!(table.contains("E_total, J                  yes to 5e-2 (2)\n"), "{table}");
    let csv = quiet("scenes ansys-vm85 --targets --format csv");
    assert!(
        csv.starts_with(
            "quantity,unit,t,published,ours,difference,within,agrees,expected,source,note\nimpact,s,,0.0064,0.0064,0,"
        ),
        "{csv}"
    );

    // One half off is seen as that.
    let scene = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n[[target]]\nquantity = 'release'\n\
                 published = 2.5\nsource = 'nowhere'\n";
    let found = run_with("scenes - --targets --format json", scene);
    let (rows, code) = (found.json(), found.code);
    assert_eq!((&rows[0]["ours"], &rows[0]["difference"]), (&2.0.into(), &(-0.5).into()));
    assert_eq!((code, &rows[0]["within"], &rows[0]["agrees"]), (Some(1), &0.05.into(), &false.into()));
    // Unless the scene says so.
    let wide = scene.replace("published", "within = 0.5\npublished");
    assert_eq!(run_with("scenes - --targets", &wide).code, Some(0));

    // All scenes of a folder, and all that are built in.
    let folder = Folder::new();
    let scenes = [folder.write("a.toml", scene), folder.write("b.toml", &wide)];
    folder.write("notes.txt", "no scene");
    let shown = folder.path("");
    let found = run(&format!("scenes {shown} --targets --format json"));
    let (rows, code) = (found.json(), found.code);
    let said = |k: usize| (rows[k]["scene"].as_str().unwrap().ends_with("b.toml"), &rows[k]["agrees"]);
    assert_eq!((code, said(0), said(1)), (Some(1), (false, &false.into()), (true, &true.into())));
    let Run { out, code, .. } = run(&format!("scenes {shown} --targets"));
    assert!(
        code == Some(1) && out.contains("NO to 5e-2 (1)") && out.ends_with("2 published values: 1 agree, 1 differ\n"),
        "{out}"
    );
    // Those of the bodies of a chain.
    let rows = json("scenes openfoam-7-1-1 --targets");
    close(&rows[0]["ours"], 0.1);
    close(&rows[1]["ours"], 0.3);
    assert_eq!(quiet("scenes norma-two-bars --targets").matches("-100000000").count(), 1);
    let all = json("scenes --targets");
    let all = all.as_array().unwrap();
    let is_expected = |row: &Value| row["agrees"] == Value::Bool(row["expected"] == "agrees");
    assert!(all.len() >= 90 && all.iter().all(is_expected));
    scenes.iter().for_each(|scene| std::fs::remove_file(scene).unwrap());
    refused(&format!("scenes {shown} --targets"), &["found no .toml in the folder"]);
    let missing = scene.replace("published = 2.5", "contact = 3\npublished = 2.5");
    refused_with("scenes - --targets", &missing, &["found contact number 3 asked for"]);
    assert_eq!(quiet("scenes figure-2 --targets").lines().count(), 3);
    refused("scenes ansys-vm85 --format json", &["found --format, expected it with --targets"]);
}
