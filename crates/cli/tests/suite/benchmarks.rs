//! The page of published tests, and the references of a run.

use crate::command::{json, quiet, refused, refused_with, run_with};
use crate::guide::{docs, rebuilds};
use serde_json::Value;

/// Holds docs/benchmarks.md against the scenes.
#[test]
fn the_page_is_that_of_the_scenes() {
    let page = quiet("scenes --targets --format markdown");
    let path = docs().join("benchmarks.md");
    if rebuilds() {
        std::fs::write(&path, &page).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    for (ours, theirs) in page.lines().zip(kept.lines()) {
        assert_eq!(ours, theirs, "`make docs` writes the page anew");
    }
    assert!(page == kept, "docs/benchmarks.md");
    // Every test has a source or a verdict, and the command beside it prints its values.
    let sections: Vec<&str> = page.split("\n<a id=\"").skip(1).collect();
    assert!(sections.len() >= 25, "{}", sections.len());
    for section in &sections {
        let (name, _) = section.split_once('"').unwrap();
        let command = format!("dalembert scenes {name} --targets\n");
        assert!(section.contains(&command), "{name}");
        assert_eq!(run_with(&format!("scenes {name} --targets"), "").code, Some(0), "{name}");
        let row = page.lines().find(|line| line.contains(&format!("](#{name})"))).unwrap();
        assert!(!row.ends_with("|  |"), "{name} has a verdict");
    }
}

/// Values of other programs, by independent means: fractions and thirty digits.
#[test]
fn exact_values_are_those_of_other_routes() {
    for (scene, quantity, time, truth) in [
        ("code-aster-sdnl111-a", "u_end of body 2", "4e-4", -1.949684e-4),
        ("code-aster-sdnl111-a", "u_end of body 2", "6e-4", -9.496835e-5),
        ("code-aster-sdnl111-a", "u_end of body 2", "8e-4", 1.00633e-5),
        ("code-aster-sdnl111-a", "u_end of body 2", "1e-3", 2.1006329e-4),
        ("code-aster-sdnl111-a-spring", "u_end.2", "2e-4", -1.00790e-4),
        ("hopkinson-striker", "force.bottom", "1", 9.0 / 13.0),
        ("hopkinson-striker", "force.bottom", "3", 45.0 / 169.0),
        ("saint-venant-mass", "release.1", "", 7.407591891269276),
        ("saint-venant-mass-1", "release.1", "", 3.067667641618306),
        ("saint-venant-mass-2", "release.1", "", 4.708567243667727),
        ("saint-venant-mass-4", "release.1", "", 5.899590439603268),
        ("stem-absorbing-column", "v_top.1", "0.2", -2.2026692946e-5),
        ("kratos-absorbing-column", "v_top.1", "0.1", -0.06965451903188581),
    ] {
        let rows = json(&format!("scenes {scene} --targets"));
        let time = time.parse::<f64>().ok();
        let of = |row: &&Value| row["quantity"] == quantity && row["t"].as_f64() == time;
        let found = rows.as_array().unwrap().iter().find(of).unwrap()["ours"].as_f64().unwrap();
        let digits = if scene.starts_with("code-aster") { 6e-6 } else { 1e-10 };
        assert!((found - truth).abs() <= digits * truth.abs(), "{scene} {quantity}: {found} and {truth}");
    }
}

/// A value that is known to be off is no failure; one that is said to be off and is not is one.
#[test]
fn known_differences_are_expected() {
    let scene = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n[[target]]\nquantity = 'release'\n\
                 published = 2.5\nexpected = 'differs'\nnote = 'a slip'\nsource = 'nowhere'\n";
    let run = run_with("scenes - --targets", scene);
    assert!(run.code == Some(0) && run.out.contains("no to 5e-2 (1)"), "{}", run.out);
    assert!(
        run.out.ends_with("1 published values: 0 agree, 1 differ, 1 of them as the scene expects\n"),
        "{}",
        run.out
    );
    let run = run_with("scenes - --targets", &scene.replace("2.5", "2.0"));
    assert!(run.code == Some(1) && run.out.contains("YES to 5e-2 (1)"), "{}", run.out);
    let page = run_with("scenes - --targets --format markdown", scene).out;
    assert!(page.contains("| release | – | 2.5 | 2 | -0.5 | no | nowhere. a slip |"), "{page}");
}

const BARS: &str = "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n[[body]]\nlength = 1\nwave_speed = 1\n\
                    impedance = 1\nvelocity = -1\n[run]\ntime = 4\n[[target]]\nsource = 'by hand'\n";

/// Published values of a whole chain are called as `sample` and `solve` call them.
#[test]
fn chains_have_values_of_their_nodes() {
    let target = |lines: &str| format!("{BARS}{lines}");
    for (lines, ours) in [
        ("quantity = 'release.1'\npublished = 2\n", "2"),
        ("quantity = 'peak_force.1'\npublished = '1/2'\n", "0.5"),
        ("quantity = 'impulse.1'\npublished = 1\n", "1"),
        ("quantity = 'force.1'\ntime = 2\nside = 'left'\npublished = 0.5\n", "0.5"),
        ("quantity = 'force.1'\ntime = 2\npublished = 0\n", "0"),
        ("quantity = 'v_top.1'\ntime = 3\npublished = -1\n", "-1"),
    ] {
        let run = run_with("scenes - --targets --format csv", &target(lines));
        assert!(run.code == Some(0) && run.out.contains(&format!(",{ours},")), "{lines}{}{}", run.out, run.err);
    }
    for (lines, found) in [
        ("quantity = 'forces.1'\ntime = 2\npublished = 0\n", "did you mean force.1?"),
        ("quantity = 'force.2'\ntime = 2\npublished = 0\n", "quantity = \"force.2\""),
        ("quantity = 'release.1'\ntime = 2\npublished = 0\n", "no time: it belongs to a contact"),
        ("quantity = 'force.1'\npublished = 0\n", "the time of force.1"),
        ("quantity = 'force.1'\ntime = 2\ncontact = 1\npublished = 0\n", "it has a value at every time"),
        ("quantity = 'force.1'\ntime = 2\nbody = 1\npublished = 0\n", "the unknown key `body`"),
        ("quantity = 'release.1'\ncontact = 0\npublished = 0\n", "the number of a contact, from 1 on"),
        ("quantity = 'release.1'\nexpected = 'off'\npublished = 0\n", "one of agrees, differs"),
    ] {
        refused_with("scenes - --targets", &target(lines), &[found]);
    }
    let second = target("quantity = 'release.1'\ncontact = 2\npublished = 0\n");
    refused_with("scenes - --targets", &second, &["found contact number 2 asked for"]);
}

/// The references of a run: program, paper, numbers, scene and values.
#[test]
fn a_run_is_cited() {
    let text = quiet("cite saint-venant-mass --digits 30");
    let entries =
        ["@misc{dalembert,", "@article{mpfr,", "@misc{saint-venant-mass,", "@misc{saint-venant-mass-value-1,"];
    for entry in entries {
        assert!(text.contains(entry), "{entry} in {text}");
    }
    assert!(text.starts_with("The dalembert developers, dalembert: exact reference solutions"), "{text}");
    assert!(!text.contains("wang-hansen") && text.contains("30 digits"), "{text}");
    // Braces and entries of BibTeX are closed.
    let count = |c: char| text.matches(c).count();
    assert_eq!(count('{'), count('}'));

    let text = quiet("cite doyen-ern-piperno");
    assert!(text.contains("@techreport{wang-hansen-2016,") && !text.contains("@article{mpfr"), "{text}");
    assert!(text.contains("D. Doyen, A. Ern and S. Piperno, Time-integration schemes"), "{text}");
    assert!(text.contains("  journal = {SIAM Journal on Scientific Computing},\n  volume = {33},\n"), "{text}");
    let bib = quiet("cite code-aster-sdnv100 --format bibtex");
    assert!(bib.starts_with("@misc{dalembert,\n  author = {{The dalembert developers}},\n"), "{bib}");
    assert!(bib.contains("  title = {{deck sdnv100a, TEST\\_RESU analytique, DEPL N5}},\n"), "{bib}");
    let own = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n[publication]\ntitle = 'A & B'\nyear = '2026'\n";
    assert!(run_with("cite -", own).out.contains("A & B, 2026 (source of the scene)."));
    refused_with("cite -", &own.replace("year", "yaer"), &["did you mean year?"]);
    refused("cite doyen-ern-piperno --format json", &["json"]);
}
