//! Why a run in fractions ends, in everything that the command writes.

use crate::command::{Run, quiet, refused, run, run_with};
use serde_json::Value;

#[test]
fn exactness_ends_at_a_surd_and_says_so() {
    // μ = 1: v(0,t) = 1 − (t − 3)²/2 before the second impact.
    let out = quiet("solve mu-1-period-36 --exact");
    assert!(out.contains("exactness ends before the impact at t = 3 + √2 ≈ 4.41421356237"), "{out}");
    let Run { out, err, .. } = run("solve mu-1-period-36 --exact --format json");
    let history: Value = serde_json::from_str(&out).unwrap();
    assert!(err.starts_with("note: exactness ends before the impact at t = 3 + √2"), "{err}");
    assert_eq!((&history["end"]["event"], &history["end"]["surd"]), (&"impact".into(), &"3 + √2".into()));
    assert_eq!(history["events"].as_array().unwrap().len(), 2);

    // With digits it goes on, and says from where.
    let Run { code, out, err } = run("solve mu-1-period-36 --exact --digits 20 --format json");
    assert_eq!(code, Some(0));
    assert!(err.starts_with("note: exactness ends before the impact at t = 3 + √2"), "{err}");
    let history: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&history["number"], &history["exact_until"]["surd"]), (&"20 digits".into(), &"3 + √2".into()));
    assert_eq!(history["events"][2]["t"], "4.4142135623730950488");
    // The tangential landing at 31, and contact until 34.
    let times: Vec<&str> = history["events"].as_array().unwrap().iter().filter_map(|e| e["t"].as_str()).collect();
    for time in ["31.000000000000000000", "34.000000000000000000", "36.000000000000000000"] {
        assert!(times.contains(&time), "{time} in {times:?}");
    }

    // A sample beyond the surd is refused by its name, not answered in doubles.
    let beyond = "sample mu-1-period-36 --quantity end --times 4,5 --exact";
    refused(beyond, &["found time 5", "exactness ends before the impact at t = 3 + √2", "--digits N"]);
    let Run { code, err, .. } = run(&format!("{beyond} --digits 12"));
    assert_eq!(code, Some(0));
    assert!(err.contains("what follows is in 12 digits"), "{err}");
}

/// L = 2, c = 50, g = 9.81, μ = 2 lands at a root of no square. Whatever is written of a run in fractions says so.
#[test]
fn no_file_ends_in_silence() {
    let scene = "rod = { length = 2, wave_speed = 50 }\nimpact.speed = 2\ngravity.acceleration = 9.81\nrun.time = 1\n";
    let said = "exactness ends before the impact at t = 18544/24525 − 22√90901/24525 ≈ ";
    let json = "reference - --exact --format json";
    for (args, mark) in [
        ("solve - --exact --format csv", "# "),
        ("solve - --exact --format csv --part stress", "# "),
        ("reference - --exact", "# "),
        (json, "  \"ends\": \""),
        ("reference - --exact --as python", "# "),
        ("reference - --exact --as c", "// "),
        ("reference - --exact --as matlab", "% "),
    ] {
        let Run { code, out, err } = run_with(args, scene);
        assert_eq!(code, Some(0), "{args}");
        let line = out.lines().find_map(|line| line.strip_prefix(mark)?.strip_prefix(said)).unwrap_or_default();
        // The double next to that root, and that of the run in doubles.
        let near = (18544.0 - 22.0 * 90901f64.sqrt()) / 24525.0;
        assert_eq!(line.split(',').next().and_then(|near| near.parse::<f64>().ok()), Some(near), "{args}: {out}");
        assert!(err.starts_with(&format!("note: {said}")) && err.lines().count() == 1, "{args}: {err}");
    }
    // Times that are chosen have no end to explain, and a run that gets as far as it was asked to has nothing to note.
    let Run { out, err, .. } = run_with(&format!("{json} --times 0,1/10"), scene);
    assert!(out.contains("\n  \"ends\": null,\n") && err.is_empty(), "{out}{err}");
    let whole = quiet("reference doyen-ern-piperno --exact");
    assert!(whole.contains("\n# ends at t = 16: the impact after the last contact asked for\n"), "{whole}");
}

/// Values beyond where a rod comes to rest are those of rest, and a note says from when; beyond the run of the scene a
/// sample is followed without one, as its help says.
#[test]
fn samples_of_a_rod_at_rest() {
    let sample = |scene: &str, times: &str| {
        let Run { code, err, .. } = run_with(&format!("sample - --quantity end --times {times}"), scene);
        assert_eq!(code, Some(0), "{err}");
        err
    };
    let scene = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 3\nrun.time = 5\n";
    assert_eq!(sample(scene, "1,6"), "");
    let damped = scene.replace("wave_speed = 1", "wave_speed = 1, damping = 0.3333");
    let damped = format!("{damped}gravity.acceleration = 1\n");
    assert_eq!(sample(&damped, "1,5"), "");
    let rest = sample(&damped, "1,400");
    assert!(rest.starts_with("note: at rest: from t = ") && rest.lines().count() == 1, "{rest}");
}
