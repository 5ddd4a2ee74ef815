//! `dalembert compare` with data of several bodies of a chain.

use serde_json::Value;

use crate::command::Folder;

/// A bar at −1 meets an equal one at rest at t = 1: both are in contact until t = 3, with the force 1/2, and exchange
/// their velocities.
const SCENE: &str = "title = \"Two bars\"\n[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nname = \"target\"\n\
    [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = -1\ngap = 1\n[run]\ntime = 4\n";
/// The upper bar stops at u = −2; the force is ten percent too large.
const DATA: &str = "t,v_top.1,u_end.2,force.1,gap.1,n\n0,0,0,0,1,1\n0.5,0,-0.5,0,0.5,2\n1.5,-0.5,-1.25,0.55,0,3\n\
    2.5,-0.5,-1.75,0.55,0,4\n3.5,-1,-2,0,0.5,5\n4,-1,-2,0,1,6\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("bars.toml", SCENE);
    folder.write("run.csv", DATA);
    folder
}

/// Returns the relative L² norms of a report by the names of the quantities.
fn norms(report: &Value) -> Vec<(&str, f64)> {
    let quantities = report["quantities"].as_array().unwrap().iter();
    quantities.map(|one| (one["name"].as_str().unwrap(), one["l2"]["relative"].as_f64().unwrap())).collect()
}

#[track_caller]
fn agree(found: &[(&str, f64)], expected: &[(&str, f64)]) {
    let close =
        |(found, expected): (&(&str, f64), &(&str, f64))| found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-12;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(close), "{found:?}");
}

#[test]
fn each_bar_is_compared_with_its_columns() {
    let folder = folder();
    let output = folder.run("compare bars.toml run.csv --format json");
    assert_eq!(output.err, "warning: not compared: gap.1; `sample` has the exact values\n");
    let report = output.json();
    assert_eq!((&report["title"], &report["bodies"][0]["name"]), (&"Two bars".into(), &"target".into()));
    let bodies = report["bodies"].as_array().unwrap();
    assert_eq!(bodies.iter().map(|body| body["body"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2]);
    agree(&norms(&bodies[0]["files"][0]), &[("v_top", 0.0)]);
    agree(&norms(&bodies[1]["files"][0]), &[("u_end", 0.0), ("force", 0.1)]);
    assert_eq!(bodies[1]["files"][0]["notes"], serde_json::json!(["not used: n"]));

    // One body alone, by either kind of names.
    let one = folder.json("compare bars.toml run.csv --body 2");
    assert_eq!(one["title"], "Two bars: body 2");
    agree(&norms(&one), &[("u_end", 0.0), ("force", 0.1)]);
    let map = "--map t=t,u=u_end.2";
    let one = folder.json(&format!("compare bars.toml run.csv --body 2 {map}"));
    agree(&norms(&one), &[("u_end", 0.0)]);
    let map = "--map t=t,u.2=u_end.2";
    let all = folder.json(&format!("compare bars.toml run.csv {map}"));
    assert_eq!(all["bodies"].as_array().unwrap().len(), 1);
    agree(&norms(&all["bodies"][0]["files"][0]), &[("u_end", 0.0)]);
}

#[test]
fn tables_and_rows_have_every_bar() {
    let folder = folder();
    let table = folder.run("compare bars.toml run.csv").text(0);
    let titles: Vec<&str> = table.lines().filter(|line| line.starts_with("Two bars")).collect();
    assert_eq!(titles, ["Two bars: target", "Two bars: body 2"]);
    let rows = folder.run("compare bars.toml run.csv --format csv").text(0);
    let header: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
    let of = |name: &str| ["ours", "theirs", "difference"].map(|whose| format!("{name}_{whose}")).to_vec();
    assert_eq!(header[..], [vec!["t".to_string()], of("v_top.1"), of("u_end.2"), of("force.1")].concat());
    assert_eq!(rows.lines().count(), 7);
}

#[test]
fn bounds_hold_for_the_bars_that_have_what_they_bound() {
    let folder = folder();
    let outcome = |bounds: &str, code: i32| {
        let output = folder.run(&format!("compare bars.toml run.csv --quiet --fail-above {bounds}"));
        output.text(code);
        output.err
    };
    assert_eq!(outcome("force.1.l2=0.11,u_end.2.l2=1e-9,v_top.linf=1e-9", 0), "");
    let failed = "failed: run.csv, body 2: expected force.l2 ≤ 5e-2, found 1.000e-1\n";
    assert_eq!(outcome("force.1.l2=0.05", 1), failed);
    assert_eq!(outcome("force.l2=0.05", 1), failed);
    assert!(outcome("u_end.1.l2=0.1", 2).contains("found a bound of u_end, expected one of v_top"));
    assert!(outcome("force.top.l2=0.1", 2).contains("found a bound of force_top, expected one of u_end, force"));
}

#[test]
fn what_needs_one_body_is_refused() {
    let folder = folder();
    folder.write("plain.csv", "t,u\n0,0\n1,1\n");
    let refused = |args: &str| {
        let output = folder.run(&format!("compare bars.toml {args}"));
        assert_eq!(output.text(2), "");
        output.err.lines().next().unwrap().to_string()
    };
    let expected = "columns with the number of a bar or the name of a joint, such as u_end.2 and force.1";
    assert_eq!(refused("plain.csv"), format!("error: found 2 bodies in `bars.toml`, expected {expected}"));
    assert_eq!(refused("run.csv -o run.svg"), "error: found a picture of all bodies, expected one body");
    assert_eq!(refused("run.csv --fit length"), "error: found --fit of all bodies, expected one body");
    folder.write("mixed.csv", "t,u_end,u_end.2\n0,0,0\n1,1,1\n");
    let expected = "the number of its body or the name of its joint, as the others have";
    assert_eq!(refused("mixed.csv"), format!("error: found the column u_end of a chain, expected {expected}"));
    assert!(refused("run.csv --body 3").contains("expected a body from 1, the lowest, to 2"));
    assert!(!folder.has("run.svg"));
}

/// A wrong value of a neighbour, of a joint or of a start is named by its place.
#[test]
fn values_of_a_chain_are_causes() {
    let folder = Folder::new();
    let source = folder.run("scenes openfoam-7-1-2").text(0);
    let hints = |wrong: &str, right: &str| {
        assert!(source.contains(right), "{source}");
        folder.write("wrong.toml", source.replace(right, wrong));
        let sampled = "sample wrong.toml --body 1 --format csv -o run.csv";
        folder.run(&format!("{sampled} --quantity u_top,v_top,force_top --times 0..0.5:1001 --side right")).text(0);
        let report = folder.json("compare openfoam-7-1-2 run.csv --body 1");
        let hint = |hint: &Value| (hint["text"].as_str().unwrap().to_string(), hint["value"].as_f64().unwrap());
        report["hints"].as_array().unwrap().iter().map(hint).collect::<Vec<_>>()
    };
    for (wrong, right, place, share) in [
        ("modulus = 110", "modulus = 100", "body.2.modulus", 0.1),
        ("gap = 0.012", "gap = 0.01", "joint.1.gap", 0.2),
        ("velocity = 0.11", "velocity = 0.1", "body.1.velocity", 0.1),
    ] {
        let found = hints(wrong, right);
        let [(hint, value)] = &found[..] else { panic!("{found:?}") };
        assert!(hint.starts_with(place) && (value - share).abs() < 0.01, "{found:?}");
    }
    assert!(hints("gap = 0.01", "gap = 0.01").is_empty());
}

/// Two bars of different stiffness fall on the ground, the upper one from higher up.
const FALL: &str = "[[body]]\nlength = 1\nmodulus = 100\ndensity = 1\nvelocity = -1\n\
    [[body]]\nlength = 1.5\nmodulus = 144\ndensity = 1\narea = 1.5\nvelocity = -1\ngap = 0.25\nJOINT\
    [ends]\nbottom = { gap = 0.2 GROUND }\n[gravity]\nacceleration = 5\n[run]\ntime = 0.55\n";
const COLUMNS: &str = "u_end.1,v_end.1,u_top.1,v_top.1,u_end.2,v_end.2,u_top.2,v_top.2,force.bottom,force.1";

/// Returns the hints of both bars for the exact data of the scene with these springs, each with its value; `renamed`
/// changes the table.
fn hints_of_fall(joint: &str, ground: &str, changed: impl Fn(String) -> String) -> [Vec<(String, f64)>; 2] {
    let folder = Folder::new();
    let scene = |joint: &str, ground: &str| FALL.replace("JOINT", joint).replace("GROUND", ground);
    folder.write("rigid.toml", scene("", ""));
    folder.write("soft.toml", scene(joint, ground));
    let times = "--times 0..0.55:551 --side right --bare --format csv";
    let data = folder.run(&format!("sample soft.toml --quantity {COLUMNS} {times}")).text(0);
    folder.write("run.csv", changed(data));
    let report = folder.json("compare rigid.toml run.csv");
    [0, 1].map(|body| {
        let hints = report["bodies"][body]["files"][0]["hints"].as_array().unwrap();
        let hint = |hint: &Value| (hint["text"].as_str().unwrap().to_string(), hint["value"].as_f64().unwrap());
        hints.iter().map(hint).collect()
    })
}

/// A contact that yields is named by its place, with `EA/kL` of either bar: 100/1000 and 144 · 1.5/1000/1.5.
#[test]
fn soft_contacts_of_a_chain_are_named() {
    let (joint, ground) = ("joint = { stiffness = 1000 }\n", ", stiffness = 500");
    for (joint, ground, place, shares) in [(joint, "", "joint 1", [0.1, 0.144]), ("", ground, "bottom", [0.2, 0.288])] {
        for (found, share) in hints_of_fall(joint, ground, |data| data).iter().zip(shares) {
            let (text, value) = &found[0];
            assert!(text.starts_with(&format!("contact too soft (penalty, {place})")), "{found:?}");
            assert!((value - share).abs() < 0.1 * share, "{share}: {found:?}");
        }
    }
}

#[test]
fn bars_in_another_order_are_named() {
    let swapped = |data: String| {
        let (head, rows) = data.split_once('\n').unwrap();
        let head = head.replace(".1", ".x").replace(".2", ".1").replace(".x", ".2").replace("force.2", "force.1");
        format!("{head}\n{rows}")
    };
    let texts = hints_of_fall("", "", swapped).map(|found| found[0].0.clone());
    let text = |body: u32| format!("the columns are those of body {body}: are the bodies counted from the ground up?");
    assert_eq!(texts, [text(2), text(1)]);
    assert_eq!(hints_of_fall("", "", |data| data), [vec![], vec![]]);
}

#[test]
fn displacements_in_another_unit_are_named() {
    let in_millimetres = |data: String| {
        let (head, rows) = data.split_once('\n').unwrap();
        let is_displacement: Vec<bool> = head.split(',').map(|name| name.starts_with("u_")).collect();
        let row = |row: &str| {
            let cell = |(cell, of_u): (&str, &bool)| match of_u {
                true => (cell.parse::<f64>().unwrap() * 1000.0).to_string(),
                false => cell.to_string(),
            };
            row.split(',').zip(&is_displacement).map(cell).collect::<Vec<_>>().join(",")
        };
        format!("{head}\n{}\n", rows.lines().map(row).collect::<Vec<_>>().join("\n"))
    };
    for found in hints_of_fall("", "", in_millimetres) {
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].0.starts_with("u_end, u_top × 1000: is it in thousandths of the unit"), "{found:?}");
    }
}

#[test]
fn columns_of_the_only_body_may_have_its_number() {
    let folder = Folder::new();
    let rows = "--bare --times 0..0.6:11 --quantity t,u_top.1,force.bottom -o pile.csv";
    folder.run(&format!("reference mpm-py-pile {rows}")).text(0);
    agree(&norms(&folder.json("compare mpm-py-pile pile.csv")), &[("u_top", 0.0), ("force", 0.0)]);
}
