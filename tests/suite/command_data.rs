//! What the command says of its numbers: warnings, uncertainties, and how a file is to be read.

use crate::command::{Run, run, run_with};
use serde_json::Value;

/// g/2r = 1 is slower than √(2 g drop_height) = 2.
const DRAGGED: &str = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 1\n[impact]\ndrop_height = 1\n\
    [gravity]\nacceleration = 2\n";

#[test]
fn every_format_carries_the_warnings() {
    let solve = ["solve", "-"];
    let sample = ["sample", "-", "--quantity", "end", "--times", "0.5"];
    for command in [&solve[..], &sample[..]] {
        let run = |format: &str| {
            let Run { code, out, err } = run_with(&[command, &["--format", format]].concat(), DRAGGED);
            assert_eq!(code, Some(0), "{err}");
            (out, err)
        };
        let (json, err) = run("json");
        let json: Value = serde_json::from_str(&json).unwrap();
        let warning = json["warnings"][0].as_str().unwrap();
        assert!(warning.contains("drop_height) = 2.0000e0") && warning.contains("g/2r = 1.0000e0"), "{warning}");
        assert_eq!(err, format!("warning: {warning}\n"));
        let (csv, err) = run("csv");
        assert_eq!(csv.lines().next().unwrap(), format!("# warning: {warning}"));
        assert_eq!(err, format!("warning: {warning}\n"));
        // On the screen the table alone says it.
        let (table, err) = run("table");
        assert!(table.ends_with(&format!("warning: {warning}\n")) && err.is_empty(), "{table}{err}");
    }
}

/// The end of a periodic contact is 2L/c = 2/3, which twelve digits do not spell.
#[test]
fn the_uncertainty_covers_the_rounding_of_the_printed_digits() {
    let out = run(&["solve", "doyen-ern-piperno", "--wide"]).out;
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
#[cfg(feature = "mp")]
#[test]
fn every_format_says_where_fractions_end() {
    let sample = ["sample", "siconos-impacting-bar", "--quantity", "end", "--times", "0", "--exact", "--digits", "12"];
    let said = "the wave speed √(350000000/13) is no fraction";
    let of = |format: &str| run(&[&sample[..], &["--format", format]].concat()).out;
    let json: Value = serde_json::from_str(&of("json")).unwrap();
    assert_eq!(json["exact_until"]["reason"], said);
    assert!(of("csv").starts_with(&format!("# {said}; the numbers are 12 digits\n")), "{}", of("csv"));
    assert!(of("table").ends_with(&format!("{said}; these are 12 digits\n")), "{}", of("table"));
}
