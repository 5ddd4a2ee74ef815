//! What accuracy costs: what is the same on every machine. No test depends on how long anything takes.

use dalembert::builtin;
use dalembert_verify::cost::Family;
use serde_json::Value;
use strum::VariantArray;

use crate::command::{Folder, keys, quiet, refused, run};

#[track_caller]
fn json(args: &str) -> Value {
    crate::command::json(&format!("cost {args}"))
}

/// The truth of a later event is proved, damped or not.
#[test]
fn the_truth_of_a_later_event() {
    use dalembert::{Run, Scene};
    let source = builtin::get("figure-4-r02").unwrap().source.replace("[impact]", "[run]\nimpacts = 2\n\n[impact]");
    let folder = Folder::new();
    let found = json(&format!("{} --quantity last_event --seconds 0.5", folder.write("scene.toml", source)));
    let mut scene = Scene::parse(builtin::get("figure-4-r02").unwrap().source).unwrap();
    scene.problem = scene.problem.with_run(Run::Impacts(2)).unwrap();
    let last = scene.problem.doubles().unwrap().events().last().unwrap().t;
    let truth = found["truth"].as_f64().unwrap();
    assert!(found["truth_proved"] == true && (truth - last).abs() < 1e-12 * last, "{found:#} {last}");
    // Proofs reach it: no setting of theirs is left out but for its time.
    let left_out = found["left_out"].as_array().unwrap();
    assert!(left_out.iter().all(|item| item["route"] != "enclosures" || item["setting"].is_string()), "{found:#}");
    let found = json("mu-1-period-36 --quantity last_event --seconds 0.5");
    assert!(found["truth_proved"] == true, "{found:#}");
    assert!(found["truth_log10_half_width"].as_f64().is_none_or(|width| width < -19.0), "{found:#}");
}

#[test]
fn schema() {
    for args in [
        "figure-4-r02 --seconds 0.5 --quantity restitution",
        "doyen-ern-piperno --seconds 0.5",
        "getfem-dynamic-contact --seconds 0.5 --quantity energy --time 1.25",
    ] {
        let found = json(args);
        assert_eq!(found["schema"], 1);
        assert!(found["quantity"].is_string() && found["truth"].is_number());
        let rows = found["rows"].as_array().unwrap();
        for row in rows {
            keys(row, "route setting error log10_error seconds spread_seconds runs chosen");
            assert!(row["error"].as_f64().unwrap() >= 0.0 && row["seconds"].as_f64().unwrap() > 0.0);
            let route = row["route"].as_str().unwrap();
            assert!(Family::VARIANTS.iter().any(|family| route == family.to_string()), "{route}");
        }
        let chosen: Vec<&Value> = rows.iter().filter(|row| row["chosen"] == true).collect();
        assert_eq!(chosen.len(), 1, "{args}");
        assert_eq!(chosen[0]["setting"], "double");
    }
    let out = run("cost doyen-ern-piperno --seconds 0.2 --format csv").text(0);
    assert!(out.starts_with("route,setting,error,seconds,spread_seconds,runs,chosen\n"), "{out}");
}

/// A whole chain: in fractions, in long numbers and proved; with a mass, without fractions.
#[test]
fn a_whole_chain_is_measured() {
    for (args, quantity, truth, fractions) in [
        ("openfoam-7-1-2", "release.1", 27.0 / 70.0, true),
        ("openfoam-7-1-2 --quantity force.1 --time 1/5", "force.1", 7.0 / 170.0, true),
        // Saint-Venant's mass m = 6 pushes with e^(−t/6) up to t = 2.
        ("saint-venant-mass --quantity force.1 --time 1/2", "force.1", (-1.0f64 / 12.0).exp(), false),
    ] {
        let found = json(&format!("{args} --seconds 0.5"));
        assert_eq!(found["quantity"], quantity, "{args}");
        assert!((found["truth"].as_f64().unwrap() - truth).abs() < 1e-15, "{found:#}");
        let rows = found["rows"].as_array().unwrap();
        let setting = |name: &str| rows.iter().find(|row| row["setting"] == name);
        assert_eq!(setting("double").unwrap()["chosen"], true);
        assert_eq!(setting("fractions").is_some(), fractions, "{args}");
        assert!(setting("50 digits").unwrap()["log10_error"].as_f64().is_none_or(|error| error < -50.0), "{found:#}");
    }
    // A mass that has left the rod feels no force.
    let table = run("cost saint-venant-mass-1 --quantity force.1 --seconds 0.3").text(0);
    assert!(table.contains("force.1 at t = 12 = 0.0\n") && table.contains("\nerror: absolute, against"), "{table}");
    for (args, said) in [
        ("openfoam-7-1-2 --quantity force.9", "did you mean force.1?"),
        ("openfoam-7-1-2 --quantity release.1 --time 1", "release.1 is not asked at a time"),
        ("openfoam-7-1-2 --effects", "expected it with one of them, --body N"),
    ] {
        refused(&format!("cost {args}"), &[said]);
    }
}

/// The end of the rod is on the ground after three quarters of a round trip; in the fall before, v(0,t) = gap − μt −
/// gt²/2.
#[test]
fn a_quantity_is_asked_at_a_time_at_which_it_is_not_zero() {
    let found = json("../../examples/bounce.toml --quantity u_end --seconds 0.2");
    let time = found["time"].as_f64().unwrap();
    let expected = 0.005 - 0.4 * time - 9.7 * time * time / 2.0;
    assert!((found["truth"].as_f64().unwrap() - expected).abs() < 1e-15 && expected > 1e-3, "{found:#}");
    // A time that is given is kept.
    let found = json("../../examples/bounce.toml --quantity u_end --time 0.075 --seconds 0.2");
    assert_eq!(found["truth"], 0.0);
}

#[test]
fn effects() {
    let found = json("doyen-ern-piperno --effects --seconds 0.1");
    let rows = found["rows"].as_array().unwrap();
    let names: Vec<&str> = rows.iter().map(|row| row["effect"].as_str().unwrap()).collect();
    assert_eq!(names, ["damping", "gravity", "repeated_impacts", "fixed_top", "field_energies", "plan"]);
    let called: Vec<bool> = rows.iter().map(|row| row["called"].as_bool().unwrap()).collect();
    assert_eq!(called, [false, true, true, false, false, true]);
    assert!(rows.iter().all(|row| row["spread_seconds"].as_f64().unwrap() >= 0.0));
}

#[test]
fn bad_input_is_refused_before_anything_is_measured() {
    for (args, said) in [
        ("figure-4-r02 --seconds 0", "found 0 seconds"),
        ("figure-4-r02 --seconds nan", "NaN seconds"),
        ("figure-4-r02 --seconds -1 --effects", "found -1 seconds"),
        ("figure-4-r02 --quantity stress --time -1", "found time -1"),
        ("figure-4-r02 --quantity bounce_time --time 1", "not asked at a time"),
        ("figure-4-r02 --quantity beauty", "beauty"),
        ("no-such-scene", "no-such-scene"),
        ("figure-4-r02 --effects -o effects.svg", "found --effects with a picture"),
    ] {
        refused(&format!("cost {args}"), &[said]);
    }
}

#[test]
fn a_scene_without_a_bounce_says_so() {
    let scene = "rod = { length = \"1/2\", wave_speed = 1, damping = 3.3 }\nimpact = { speed = 1 }\n";
    let folder = Folder::new();
    let said = ["found bounce_time asked of a scene that has none", "overdamped"];
    refused(&format!("cost {} --seconds 1", folder.write("scene.toml", scene)), &said);
}

/// The doubles of every route end near the roundoff, and no route is better than its numbers.
#[test]
fn errors_fall_along_the_settings() {
    let table = json("figure-4-r02 --quantity energy --time 2 --seconds 1");
    let rows = table["rows"].as_array().unwrap();
    let error = |row: &Value| row["log10_error"].as_f64().unwrap_or(f64::NEG_INFINITY);
    // Two settings that both end in rounding may stand either way: within a few dozen roundings of each other.
    let rounding = -14.0;
    for route in ["cells", "modal sum", "closed form"] {
        let errors: Vec<f64> = rows.iter().filter(|row| row["route"] == route).map(error).collect();
        assert!(errors.len() > 1, "{route}");
        assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] || pair[1] < rounding), "{route} {errors:?}");
    }
    assert!(rows.iter().any(|row| row["chosen"] == true && error(row) < -13.0));
}
#[test]
fn pictures() {
    let folder = Folder::new();
    let source = builtin::get("figure-4-r02").unwrap().source;
    let scene = folder.write("scene.toml", source.replacen("title = \"", "title = \"<&> ", 1));
    let args = format!("{scene} --quantity stress --seconds 1");
    let outputs =
        format!("-o {} -o {} -o {}", folder.path("cost.svg"), folder.path("cost.png"), folder.path("cost.json"));
    assert_eq!(quiet(&format!("cost {args} {outputs}")), "");
    let svg = folder.read("cost.svg");
    let table: Value = serde_json::from_str(&folder.read("cost.json")).unwrap();
    for row in table["rows"].as_array().unwrap() {
        assert!(svg.contains(row["route"].as_str().unwrap()), "{row}");
    }
    assert!(svg.contains("10⁻¹⁵") || svg.contains("10⁻¹⁸"));
    // Well-formed, or it could not be read.
    let png = std::fs::read(folder.path("cost.png")).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    let (width, height) = (side(16), side(20));
    // 170 mm at 300 pixels an inch.
    assert!((2000..2015).contains(&width) && (900..1600).contains(&height), "{width} × {height}");
}
