//! Values at chosen times, and published ones beside ours.

use serde_json::Value;

use crate::command::{Run, json, keys, quiet, refused, refused_with, run_with};

#[test]
fn samples() {
    let out = quiet(&["sample", "paper-strong", "--quantity", "stress", "--times", "1,2", "--side", "left"]);
    let cells: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(cells[0], ["t", "side", "strain"]);
    // −(μ + g t)/c.
    assert_eq!(cells[2..], [["1", "left", "-4"], ["2", "left", "-5"]]);

    for (quantity, names) in [
        ("stress", &["strain"][..]),
        ("end", &["u_end", "v_end"]),
        ("top", &["u_top", "v_top"]),
        ("centre", &["h", "h_rate"]),
        ("energy", &["E_total", "E_h", "E_z"]),
        ("field", &["u", "v", "strain"]),
    ] {
        let args = ["sample", "paper-strong", "--quantity", quantity, "--times", "0..2:3"];
        let samples = json(&[&args[..], &["--format", "json"]].concat());
        assert_eq!((&samples["schema"], &samples["quantity"]), (&1.into(), &quantity.into()));
        let rows = samples["rows"].as_array().unwrap();
        // The field has two ends and the middle for each time.
        assert_eq!(rows.len(), if quantity == "field" { 9 } else { 3 });
        for row in rows {
            keys(row, &["t", "x", "side", "values", "uncertainty"]);
            keys(&row["uncertainty"], names);
            keys(&row["values"], names);
            assert_eq!(row["side"], "right");
            assert!(row["t"].is_number() && row["values"].as_object().unwrap().values().all(Value::is_number));
            assert_eq!(row["x"].is_number(), quantity == "field");
        }
        assert_eq!(rows[rows.len() - 1]["t"], 2.0);
        let csv = quiet(&[&args[..], &["--format", "csv"]].concat());
        let unit = if quantity == "energy" { " [per ρS]" } else { "" };
        let heads = ["", "_uncertainty"].map(|end| names.iter().map(move |name| format!("{name}{end}{unit}")));
        let heads: Vec<String> = heads.into_iter().flatten().collect();
        assert_eq!(csv.lines().next().unwrap(), format!("t,x,side,{}", heads.join(",")));
        assert_eq!(csv.lines().count(), rows.len() + 1);
    }
}

/// Several quantities stand beside each other under the names that each has alone.
#[test]
fn samples_of_several_quantities() {
    let args = ["sample", "paper-strong", "--quantity", "end,energy", "--times", "0,1", "--format", "json"];
    let several = json(&args);
    assert_eq!(several["quantity"], "end,energy");
    for (k, row) in several["rows"].as_array().unwrap().iter().enumerate() {
        keys(&row["values"], &["u_end", "v_end", "E_total", "E_h", "E_z"]);
        for (quantity, names) in [("end", ["u_end", "v_end"]), ("energy", ["E_total", "E_z"])] {
            let alone = json(&[&args[..3], &[quantity], &args[4..]].concat());
            for name in names {
                assert_eq!(row["values"][name], alone["rows"][k]["values"][name], "{quantity}");
            }
        }
    }
    for (quantity, said) in [("field,energy", "expected it alone"), ("end,top,end", "--quantity end twice")] {
        refused(&["sample", "paper-strong", "--quantity", quantity, "--times", "1"], &[said]);
    }
}

#[cfg(feature = "mp")]
#[test]
fn samples_in_fractions_have_two_sides() {
    let at = |side| {
        let args = ["sample", "paper-strong", "--quantity", "field", "--times", "2", "--points", "0,1/3", "--exact"];
        json(&[&args[..], &["--format", "json", "--side", side]].concat())
    };
    // At the release: −(μ + 2g)/c before it, nothing after it.
    assert_eq!(at("left")["rows"][0]["values"]["strain"], "-5");
    assert_eq!(at("right")["rows"][0]["values"]["strain"], "0");
    assert_eq!(at("right")["rows"][1]["x"], "1/3");
    // A zero in digits is a zero, not what rounding leaves of it.
    let args = ["sample", "doyen-ern-piperno", "--quantity", "centre", "--times", "0", "--digits", "38"];
    assert_eq!(json(&[&args[..], &["--format", "json"]].concat())["rows"][0]["values"]["h"], "0");
}

/// The published values of the built-in scenes: ours round to them, or are within what the scene says.
#[test]
fn published_values_beside_ours() {
    let rows = json(&["scenes", "ansys-vm265", "--targets", "--format", "json"]);
    let rows = rows.as_array().unwrap();
    for row in rows {
        keys(row, &["quantity", "t", "published", "ours", "difference", "within", "agrees", "source"]);
    }
    // gap/μ, and 2L/c after it.
    let close = |value: &Value, truth: f64| assert!((value.as_f64().unwrap() - truth).abs() < 1e-12 * truth, "{value}");
    close(&rows[0]["ours"], 0.01 / 202.2);
    close(&rows[2]["ours"], 0.01 / 202.2 + 20.0 / (3e7f64 / 0.73e-3).sqrt());
    assert_eq!((&rows[0]["quantity"], &rows[0]["t"]), (&"impact".into(), &Value::Null));

    let table = quiet(&["scenes", "code-aster-sdnv100", "--targets"]);
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
    assert!(table.contains("E_total, J                   2e-6      3200.0     3200            0   yes (2)"), "{table}");
    let csv = quiet(&["scenes", "ansys-vm85", "--targets", "--format", "csv"]);
    assert!(
        csv.starts_with("quantity,unit,t,published,ours,difference,within,agrees,source\nimpact,s,,0.0064,0.0064,0,"),
        "{csv}"
    );

    // One half off is seen as that.
    let scene = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n[[target]]\nquantity = 'release'\n\
                 published = 2.5\nsource = 'nowhere'\n";
    let Run { out, code, .. } = run_with(&["scenes", "-", "--targets", "--format", "json"], scene);
    let rows: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&rows[0]["ours"], &rows[0]["difference"]), (&2.0.into(), &(-0.5).into()));
    assert_eq!((code, &rows[0]["within"], &rows[0]["agrees"]), (Some(1), &0.05.into(), &false.into()));
    // Unless the scene says so.
    let wide = scene.replace("published", "within = 0.5\npublished");
    assert_eq!(run_with(&["scenes", "-", "--targets"], &wide).code, Some(0));

    // All scenes of a folder, and all that are built in.
    let folder = tempfile::TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("a.toml"), scene).unwrap();
    std::fs::write(path("b.toml"), &wide).unwrap();
    std::fs::write(path("notes.txt"), "no scene").unwrap();
    let shown = folder.path().display().to_string();
    let Run { out, code, .. } = run_with(&["scenes", &shown, "--targets", "--format", "json"], "");
    let rows: Value = serde_json::from_str(&out).unwrap();
    let said = |k: usize| (rows[k]["scene"].as_str().unwrap().ends_with("b.toml"), &rows[k]["agrees"]);
    assert_eq!((code, said(0), said(1)), (Some(1), (false, &false.into()), (true, &true.into())));
    let Run { out, code, .. } = run_with(&["scenes", &shown, "--targets"], "");
    assert!(
        code == Some(1) && out.contains("NO (1)") && out.ends_with("2 published values: 1 agree, 1 differ\n"),
        "{out}"
    );
    let all = json(&["scenes", "--targets", "--format", "json"]);
    let all = all.as_array().unwrap();
    assert!(all.len() >= 30 && all.iter().all(|row| row["agrees"] == Value::Bool(true)));
    std::fs::remove_file(path("a.toml")).unwrap();
    std::fs::remove_file(path("b.toml")).unwrap();
    refused(&["scenes", &shown, "--targets"], &["found no .toml in the folder"]);
    let missing = scene.replace("published = 2.5", "contact = 3\npublished = 2.5");
    refused_with(&["scenes", "-", "--targets"], &missing, &["found contact 2 asked for"]);
    assert_eq!(quiet(&["scenes", "figure-2", "--targets"]).lines().count(), 3);
    refused(&["scenes", "ansys-vm85", "--format", "json"], &["found --format, expected it with --targets"]);
}
