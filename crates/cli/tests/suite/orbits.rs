//! `dalembert orbits`.

use crate::command::{Run, csv, json, quiet, refused, refused_with, run, run_with, with_snapshots};
use dalembert::rug::Rational;

#[test]
fn the_orbits_of_a_free_rod_are_listed() {
    let text = quiet("orbits periodic-free-rod --finest 3 --exact --stability 24");
    with_snapshots(|| insta::assert_snapshot!("orbits_periodic_free_rod", text));
    let json = json("orbits periodic-free-rod --period 5,6");
    let first = &json[0];
    assert_eq!((first["orbit"].as_u64(), first["period_ratio"].as_str()), (Some(1), Some("5/2")));
    assert_eq!((first["period"].as_f64(), first["first_branch"].as_i64()), (Some(5.0), Some(1)));
    assert!(first["uncertainty"]["energy"].as_f64().unwrap() < 1e-14);
    assert_eq!(json.as_array().unwrap().len(), 2);
}

/// The first nonsmooth mode has the impact speed `½/(T − 3)`.
#[test]
fn the_first_nonsmooth_mode_is_on_its_backbone() {
    let rows = csv(&quiet("orbits first-nonsmooth-mode --period 3.01..3.8:80 --exact --format csv")).split_off(1);
    assert_eq!(rows.len(), 80);
    for row in rows {
        let [period, contact, speed, energy] = [3, 4, 5, 7].map(|k| row[k].parse::<Rational>().unwrap());
        assert_eq!(contact, 4 - period.clone());
        assert_eq!(speed, Rational::from((1, 2)) / (period - 3u32));
        assert_eq!(energy, Rational::from(&speed * &speed) / 2);
    }
}

/// An orbit as a scene lands at each period, and the rod of Doyen, Ern and Piperno at the times of one.
#[test]
fn an_orbit_is_a_scene_that_returns() {
    let scene = quiet("orbits periodic-free-rod --period 20/3 --orbit 2 --format toml");
    let contacts = |name: &str, scene: &str| {
        let run = run_with(&format!("solve {name} --exact --part contacts --format csv"), scene);
        assert!(run.err.is_empty(), "{}", run.err);
        csv(&run.out).into_iter().skip(1).map(|row| row[..2].join(" ")).collect::<Vec<_>>()
    };
    assert_eq!(contacts("-", &scene), ["0 10/3", "20/3 10", "40/3 "]);
    let orbit = csv(&quiet("orbits doyen-ern-piperno --period 8/3 --exact --format csv")).split_off(1);
    assert_eq!((orbit.len(), &orbit[0][4]), (1, &"2/3".to_string()));
    let found = contacts("doyen-ern-piperno", "");
    for (k, contact) in (0..).zip(&found) {
        let impact = Rational::from((8 * k, 3));
        assert_eq!(*contact, format!("{impact} {}", Rational::from(&impact + Rational::from((2, 3)))));
    }
    assert_eq!(found.len(), 6);
    // A scene of one's own keeps its units, and a held rod without a gap takes its speed from the command.
    let held = quiet("orbits getfem-dynamic-contact --period 3 --speed 1/2 --format toml");
    assert!(held.contains("velocity = [[0, \"-1/2\"]"), "{held}");
    assert_eq!(contacts("-", &held), ["0 1", "3 4", "6 "]);
}

#[test]
fn the_backbone_is_drawn() {
    let svg = quiet("orbits first-nonsmooth-mode --finest 12 --format svg");
    assert!(svg.contains("first branch") && svg.contains("energy above rest"), "{svg}");
    // Nothing to draw is drawn as an empty picture.
    let none = run("orbits first-nonsmooth-mode --period 2 --format svg");
    assert!(none.code == Some(0) && none.out.contains("</svg>"));
    assert_eq!(none.err, "warning: no orbit with one contact in each period has the period 2\n");
    let Run { code, out, err } = run("orbits first-nonsmooth-mode --period 2,7/2");
    assert_eq!((code, err), (Some(0), none.err));
    assert_eq!(out.matches("7/4").count(), 2, "{out}");
}

#[test]
fn rods_and_periods_without_orbits_are_refused() {
    refused("orbits steel-bar", &["found the damping 12", "expected an undamped rod"]);
    refused("orbits schwarz-two-bars", &["found a chain in `schwarz-two-bars`"]);
    refused("orbits two-equal-bars", &["found a free rod without gravity"]);
    let free = |arguments: &str, parts: &[&str]| refused(&format!("orbits periodic-free-rod {arguments}"), parts);
    free("--format toml", &["expected one to be written as a scene", "--orbit K"]);
    free("--orbit 99", &["found --orbit 99, expected one from 1 to"]);
    free("--period 0", &["found a period of 0/1 round trips"]);
    free("--period -1", &["found the period -1"]);
    free("--period-ratio 0.1234567", &["found a period of 1234567/10000000 round trips"]);
    free("--period 5 --finest 3", &["--finest"]);
    free("--speed 0", &["found the impact speed 0, expected one above zero"]);
    free("--finest 30000", &["expected at most 400 parts"]);
    let steel = "rod = { length = 1, modulus = 2, density = 1 }\nimpact.speed = 1\ngravity.acceleration = 1\n";
    refused_with("orbits - --exact", steel, &["√(2)"]);
    refused_with("orbits - --period 5", steel, &["√(2)"]);
    assert!(run_with("orbits - --period-ratio 5/2 --digits 30", steel).out.contains("3.5355339059327"));
}
