//! What accuracy costs: what is the same on every machine. No test depends on how long anything takes.

use std::process::Command;

use dalembert::cost::march::march;
use dalembert::cost::{Quantity, Question, Route, Table, work_precision};
use dalembert::rod::{Parameters, Run};
use dalembert::scene::builtin;
use dalembert::{Ask, Plan, Problem, Scene};
use serde_json::Value;

fn cost(args: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_dalembert")).arg("cost").args(args).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// Under damping only the first contact is proved: the truth of a later event is not what ends the proof.
#[cfg(feature = "mp")]
#[test]
fn the_truth_of_a_later_event() {
    use dalembert::{Solution, cost::truth, solve};
    let scene = Scene::parse(builtin::get("figure-4-r02").unwrap().source).unwrap();
    let mut scene = scene;
    scene.problem.run = Run::Impacts(2);
    let plan = Plan::of(&scene, Ask::default()).unwrap();
    let question = Question::of(&scene, Some(Quantity::LastEvent), None).unwrap();
    let found = truth(&question, &plan, 20).unwrap();
    let Solution::Double(history) = solve(&scene.problem, &plan, |_, _| ()).unwrap() else { unreachable!() };
    let last = history.events().last().unwrap().time;
    assert!(!found.proved && (found.value.to_f64() - last).abs() < 1e-12 * last, "{found:?} {last}");
    // Without damping every event is proved.
    let scene = Scene::parse(builtin::get("mu-1-period-36").unwrap().source).unwrap();
    let question = Question::of(&scene, Some(Quantity::LastEvent), None).unwrap();
    let found = truth(&question, &Plan::of(&scene, Ask::default()).unwrap(), 20).unwrap();
    assert!(found.proved && found.log10_half_width < -19.0, "{found:?}");
}

fn json(args: &[&str]) -> Value {
    let (code, out, err) = cost(&[args, &["--format", "json"]].concat());
    assert_eq!((code, err.as_str()), (Some(0), ""), "{args:?}");
    serde_json::from_str(&out).unwrap()
}

fn table(scene: &str, quantity: Quantity, time: Option<&str>) -> Table {
    let scene = Scene::parse(builtin::get(scene).unwrap().source).unwrap();
    let time = time.map(|time| time.parse().unwrap());
    let question = Question::of(&scene, Some(quantity), time).unwrap();
    work_precision(&question, &Plan::of(&scene, Ask::default()).unwrap(), 1.0, |_, _| ()).unwrap()
}

#[test]
fn schema() {
    for args in [
        &["figure-4-r02", "--seconds", "0.5", "--quantity", "restitution"][..],
        &["doyen-ern-piperno", "--seconds", "0.5"],
        &["getfem-dynamic-contact", "--seconds", "0.5", "--quantity", "energy", "--time", "1.25"],
    ] {
        let found = json(args);
        assert_eq!(found["schema"], 1);
        assert!(found["quantity"].is_string() && found["truth"].is_number());
        let rows = found["rows"].as_array().unwrap();
        for row in rows {
            let keys: Vec<&str> = row.as_object().unwrap().keys().map(String::as_str).collect();
            let expected = ["route", "setting", "error", "log10_error", "seconds", "spread_seconds", "runs", "chosen"];
            assert_eq!(keys, expected);
            assert!(row["error"].as_f64().unwrap() >= 0.0 && row["seconds"].as_f64().unwrap() > 0.0);
            let route = row["route"].as_str().unwrap();
            assert!(Route::ALL.iter().any(|known| known.name() == route), "{route}");
        }
        let chosen: Vec<&Value> = rows.iter().filter(|row| row["chosen"] == true).collect();
        assert_eq!(chosen.len(), 1, "{args:?}");
        assert_eq!(chosen[0]["setting"], "double");
    }
    let (code, out, _) = cost(&["doyen-ern-piperno", "--seconds", "0.2", "--format", "csv"]);
    assert_eq!(code, Some(0));
    assert!(out.starts_with("route,setting,error,seconds,spread_seconds,runs,chosen\n"), "{out}");
}

#[test]
fn effects() {
    let found = json(&["doyen-ern-piperno", "--effects", "--seconds", "0.1"]);
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
        (&["figure-4-r02", "--seconds", "0"][..], "found 0 seconds"),
        (&["figure-4-r02", "--seconds", "nan"], "NaN seconds"),
        (&["figure-4-r02", "--seconds", "-1", "--effects"], "found -1 seconds"),
        (&["figure-4-r02", "--quantity", "stress", "--time", "-1"], "found time -1"),
        (&["figure-4-r02", "--quantity", "bounce_time", "--time", "1"], "not asked at a time"),
        (&["figure-4-r02", "--quantity", "beauty"], "beauty"),
        (&["no-such-scene"], "no-such-scene"),
        (&["figure-4-r02", "--effects", "-o", "effects.svg"], "found --effects with effects.svg"),
    ] {
        let (code, out, err) = cost(args);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{args:?}");
        let words = err.replace(['│', '×'], " ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(said), "{args:?}: {err}");
    }
}

#[test]
fn a_scene_without_a_bounce_says_so() {
    let scene = "rod = { length = \"1/2\", wave_speed = 1, damping = 3.3 }\nimpact = { speed = 1 }\n";
    let scene = Scene::parse(scene).unwrap();
    let question = Question::of(&scene, None, None).unwrap();
    let error = work_precision(&question, &Plan::of(&scene, Ask::default()).unwrap(), 1.0, |_, _| ()).unwrap_err();
    let said = error.to_string();
    assert!(
        said.starts_with("found bounce_time asked of a scene that has none") && said.contains("overdamped"),
        "{said}"
    );
}

/// The doubles of every route end near the roundoff, and no route is better than its numbers.
#[test]
fn errors_fall_along_the_settings() {
    let table = table("figure-4-r02", Quantity::Energy, Some("2"));
    let of = |route: Route| -> Vec<f64> {
        table.rows.iter().filter(|row| row.route == route).map(|row| row.log10_error).collect()
    };
    // Two settings that both end in rounding may stand either way: within a few dozen roundings of each other.
    let rounding = -14.0;
    for route in [Route::Cells, Route::Modes, Route::ClosedForm] {
        let errors = of(route);
        assert!(errors.len() > 1, "{route:?}");
        assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] || pair[1] < rounding), "{route:?} {errors:?}");
    }
    assert!(table.rows.iter().any(|row| row.chosen && row.log10_error < -13.0));
}

/// Without damping or events off the grid the march is exact but for rounding; with damping its first order shows: four times the
/// cells leave at most half of the bound `r t dt` of what a ray that damping sees a quarter of a step late can add.
#[test]
fn the_march_along_characteristics() {
    let number = |text: &str| text.parse().unwrap();
    let mut problem = Problem::uniform(number("1"), number("1"), number("1"), number("3"));
    problem.run = Run::Time(number("1.5"));
    let found = march(&problem, 16).unwrap();
    assert!((found.stress + 4.5).abs() < 1e-13, "{found:?}");
    // h = −μt − gt²/2 + (c/L)(μt²/2 + gt³/6) at t = 3/2.
    let h = -4.5 - 1.125 + (3.375 + 0.5625);
    assert!((found.centre - h).abs() < 1.0 / (16.0 * 16.0), "{found:?} {h}");
    problem.rod.damping = Some(number("0.2"));
    let rod = Parameters::<f64>::of(&problem, &()).unwrap();
    let contact = dalembert::first_contact::FirstContact::new(&rod.carry());
    let truth = contact.energy(&dalembert::number::Estimate::exact(1.5)).total.into_value();
    for cells in [16, 64, 256] {
        let wrong = (march(&problem, cells).unwrap().energy[0] - truth).abs();
        assert!(wrong < 0.2 * 1.5 / cells as f64 * truth, "{cells}: {wrong:e}");
    }
}

#[cfg(feature = "plot")]
#[test]
fn pictures() {
    use dalembert::output::{cost_svg, png};
    let table = table("figure-4-r02", Quantity::Stress, None);
    let svg = cost_svg(&table, Some("Figure 4 <&>"));
    for row in &table.rows {
        assert!(svg.contains(row.route.name()), "{}", row.route.name());
    }
    assert!(svg.contains("10⁻¹⁵") || svg.contains("10⁻¹⁸"));
    // Well-formed, or it could not be read.
    let png = png(&svg, 2.0).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    let (width, height) = (side(16), side(20));
    assert!((1200..1400).contains(&width) && (860..1000).contains(&height), "{width} × {height}");
}
