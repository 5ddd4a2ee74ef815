//! What the command says of its numbers: warnings, uncertainties, and how a file is to be read.

use crate::command::{Run, quiet, refused, run, run_with};
use crate::command_samples::column;
use crate::reference::scene;
use serde_json::Value;

/// g/2r = 1 is slower than √(2 g drop_height) = 2.
const DRAGGED: &str = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 1\n[impact]\ndrop_height = 1\n\
    [gravity]\nacceleration = 2\n";

#[test]
fn every_format_carries_the_warnings() {
    for command in ["solve -", "sample - --quantity end --times 0.5"] {
        let run = |format: &str| {
            let Run { code, out, err } = run_with(&format!("{command} --format {format}"), DRAGGED);
            assert_eq!(code, Some(0), "{err}");
            (out, err)
        };
        let (json, err) = run("json");
        let json: Value = serde_json::from_str(&json).unwrap();
        let warning = json["warnings"][0].as_str().unwrap();
        assert!(warning.contains("drop_height) = 2, takes") && warning.contains("g/2r = 1: a gap"), "{warning}");
        assert_eq!(err, format!("warning: {warning}\n"));
        let (csv, err) = run("csv");
        assert!(csv.lines().any(|line| line == format!("# warning: {warning}")), "{csv}");
        assert_eq!(err, format!("warning: {warning}\n"));
        // On the screen the table alone says it.
        let (table, err) = run("table");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words(&table).ends_with(&words(&format!("warning: {warning}"))) && err.is_empty(), "{table}{err}");
    }
}

/// The end of a periodic contact is 2L/c = 2/3, which twelve digits do not spell.
#[test]
fn the_uncertainty_covers_the_rounding_of_the_printed_digits() {
    let out = run("solve doyen-ern-piperno --wide").out;
    let row: Vec<&str> = out.lines().find(|line| line.contains("release")).unwrap().split_whitespace().collect();
    let [time, bound] = [row[1], row[2]].map(|text| text.parse::<f64>().unwrap());
    let off = (time - 2.0 / 3.0).abs();
    assert_eq!(row[1], "0.666666666667");
    assert!(off <= bound && bound < 1e-12, "{off:e} {bound:e}");
    // 6 stands for 6.00000000000.
    let six = out.lines().find(|line| line.contains(" release ") && line.contains(" 6 ")).unwrap();
    assert!(six.contains("5.1e-12"), "{six}");
}

/// A parameter that is no fraction is said in every format, as an event at no fraction is.
#[test]
fn every_format_says_where_fractions_end() {
    let sample = "sample siconos-impacting-bar --quantity end --times 0 --exact --digits 12";
    let said = "the wave speed √(350000000/13) is no fraction";
    let of = |format: &str| run(&format!("{sample} --format {format}")).out;
    assert_eq!(run(&format!("{sample} --format json")).json()["exact_until"]["reason"], said);
    assert!(of("csv").contains(&format!("# note: {said}; all is in digits\n")), "{}", of("csv"));
    assert!(of("table").ends_with(&format!("{said}; these are 12 digits\n")), "{}", of("table"));
}

/// The pieces of a CSV of the stress: its comments, and `start, end, left, right` with what stands behind them.
fn stress(scene: &str, more: &str) -> (String, Vec<([f64; 4], String)>) {
    let out = quiet(&format!("solve {scene} --format csv --part stress {more}"));
    let (comments, rows): (Vec<&str>, Vec<&str>) = out.lines().partition(|line| line.starts_with('#'));
    let row = |row: &&str| {
        let cells: Vec<&str> = row.split(',').collect();
        let numbers = [0, 1, 2, 3].map(|k| cells[k].parse().unwrap());
        // The coefficients, where the fifth column has them.
        let series = if rows[0].split(',').nth(4) == Some("chebyshev") { cells[4].to_string() } else { String::new() };
        (numbers, series)
    };
    assert!(rows[0].starts_with("start,end,strain_start,strain_end"));
    (comments.join("\n"), rows[1..].iter().map(row).collect())
}

/// Straight lines between the rows, and the Chebyshev sums, against the closed form asked at times of its own.
#[test]
fn the_stress_of_a_damped_rod_can_be_drawn_from_its_csv() {
    let history = scene("figure-4-r02").doubles().unwrap();
    let (said, lines) = stress("figure-4-r02", "");
    assert!(said.contains("within 1e-6 of the greatest v_x(0,t); the coefficients"), "{said}");
    let (said, curves) = stress("figure-4-r02", "--coefficients");
    assert!(said.contains("T_k(x)"), "{said}");
    let peak = lines.iter().flat_map(|(row, _)| [row[2].abs(), row[3].abs()]).fold(0.0, f64::max);
    let end = history.end();
    let (mut curved, mut off) = (0, 0.0f64);
    for k in 1..2000 {
        let time = end * f64::from(k) / 2000.0;
        let truth = history.strain(time, dalembert::Side::Right).unwrap();
        let find = |rows: &[([f64; 4], String)]| {
            let row = rows.iter().find(|([from, to, ..], _)| *from <= time && time < *to).unwrap().clone();
            let share = (time - row.0[0]) / (row.0[1] - row.0[0]);
            (row, share)
        };
        let (([_, _, left, right], _), share) = find(&lines);
        off = off.max((left + (right - left) * share - truth).abs());
        let (([_, _, left, right], series), share) = find(&curves);
        let (angle, mut sum) = ((2.0 * share - 1.0).clamp(-1.0, 1.0).acos(), left + (right - left) * share);
        if !series.is_empty() {
            curved += 1;
            let terms = series.split(' ').enumerate();
            sum = terms.map(|(k, c)| c.parse::<f64>().unwrap() * (k as f64 * angle).cos()).sum();
        }
        assert!((sum - truth).abs() <= 1e-9 * peak, "{time}: {sum} {truth}");
    }
    assert!(curved > 100 && off <= 1e-6 * peak && off > 1e-8 * peak, "{curved} {off:e} {peak}");
    assert!(lines.len() < 3000, "{}", lines.len());
    refused("solve figure-4-r02 --coefficients", &["expected it with --part stress only"]);
}

/// At t = 0 nothing is lost to rounding, and no bits are spent on it: the end stands on the ground.
#[test]
fn the_start_in_digits() {
    let args = "sample doyen-ern-piperno --quantity end --times 0 --digits 12 --format csv";
    let out = run(&format!("{args} --bare --uncertainty")).out;
    assert_eq!(out.lines().nth(1).unwrap(), "0,0,right,0,0,0,0");
}

/// L = c = μ = 1, r = 0.01, g = 0: the rod leaves at t₁ = 2, and the ray of that release comes back at 4. Asked alone
/// or with a later time, each side is the same.
#[test]
fn the_last_time_of_a_damped_rod_has_its_sides() {
    let scene = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.01\n[impact]\nspeed = 1\n";
    let at = |times: &str, side: &str| {
        let args = format!("sample - --quantity end --times {times} --side {side} --format csv");
        let out = run_with(&format!("{args} --bare --uncertainty"), scene).out;
        let cells: Vec<&str> = out.lines().nth(1).unwrap().split(',').collect();
        // v_t(0,t) and its uncertainty.
        [5, 6].map(|k| cells[k].parse::<f64>().unwrap())
    };
    for side in ["left", "right"] {
        let ([alone, a], [among, b]) = (at("4", side), at("4,5", side));
        assert!((alone - among).abs() <= a + b && a + b < 1e-10, "{side}: {alone} ± {a}, {among} ± {b}");
    }
    assert!((at("4", "left")[0] - at("4", "right")[0]).abs() > 1e-4);
}

/// L = 1, c = 1/3, r = 1/300, μ = 1: t_b = t₁ = 6, where 2L/c is no finite binary number. After it the rod flies.
#[test]
fn a_proved_release_has_nothing_to_pull_after_it() {
    let scene = "[rod]\nlength = 1\nwave_speed = \"1/3\"\ndamping = \"1/300\"\n[impact]\nspeed = 1\n";
    let json = run_with("sample - --quantity strain --times 6 --certified --format json", scene).json();
    assert_eq!(column(&json, "strain")[0]["value"], "0");
}
