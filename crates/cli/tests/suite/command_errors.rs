//! What the command refuses, and what it leaves then.

use crate::command::{Folder, Run, SCENE, quiet, refused, refused_with, run, run_with};

#[test]
fn bad_scenes_are_refused_where_they_are_wrong() {
    refused_with("solve -", "[rod]\nlength = -1\n", &["length = -1", "expected a length above zero", "2:10"]);
    refused_with("sample - --quantity end --times 1", "", &["no [rod]"]);
    refused_with("explain -", "[rod]\nlength = 1\nwavespeed = 1\n", &["did you mean wave_speed?"]);
    let damped = SCENE.replace("wave_speed = 1", "wave_speed = 1\ndamping = 0.1");
    refused_with("solve - --exact", &damped, &["found damping = 0.1 in fractions", "ask for digits"]);
    refused_with("solve - --accuracy 2", &damped, &["found accuracy 2", "between 1e-15 and 0.1"]);
    refused("solve no-such-file.toml", &["found no file and no built-in scene called `no-such-file.toml`"]);
    refused("solve doyen", &["did you mean `doyen-ern-piperno`?"]);
    refused(
        &format!("solve {}", env!("CARGO_MANIFEST_DIR")),
        &["found the folder", "as a scene", "a scene file in it"],
    );
}

#[test]
fn wrong_usage_is_refused() {
    for args in ["solve", "frobnicate", "solve paper-weak --format yaml", ""] {
        let Run { code, out, err } = run(args);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{args}");
        assert!(err.contains("Usage") || err.contains("possible values"), "{args}: {err}");
    }
    refused("solve paper-weak --digits 0", &["1 to 100000"]);
    let sample = |more: &str| format!("sample paper-weak --quantity field {more}");
    refused(&sample("--times 1..2"), &["found `1..2`, expected A..B:N"]);
    refused(&sample("--times 1..2:1"), &["found `1..2:1`, expected a count of 2"]);
    refused(&sample("--times one"), &["found `one`"]);
    refused(&sample("--times -1,2"), &["found time -1"]);
    refused(&sample("--times 1 --points 3/2"), &["found point 1.5, expected one between 0 and 1"]);
    refused(
        "sample paper-weak --quantity end --times 1 --points 0",
        &["found the quantity end along the rod, expected one of field"],
    );
    refused(&sample("--times 1..2"), &["A..B:N for N numbers from A to B"]);
    refused("sweep paper-weak --vary impact.speed=1..2 --quantity e_P", &["PATH=A..B:N for N values"]);
    // Negative numbers are values, not options.
    refused("solve paper-weak --digits -5", &["expected a whole number of digits"]);
    refused("cost paper-weak --time -1 --quantity h", &["found time -1"]);
}

/// Misspelt names of every kind are answered with the nearest one.
#[test]
fn misspelt_names_get_suggestions() {
    refused("slove paper-weak", &["'solve'"]);
    refused("solve getfem-dynamic-contct", &["did you mean `getfem-dynamic-contact`?"]);
    refused("scenes getfem-dynamic-contct", &["did you mean `getfem-dynamic-contact`?"]);
    refused("sample paper-weak --quantity u_ende", &["(did you mean u_end?)"]);
    refused("sweep paper-weak --vary impact.sped=1 --quantity e_P", &["did you mean impact_speed?"]);
    refused("check --only figur-4", &["did you mean `figure-4`?"]);
    refused("figures --only tenth-bonce -o figures", &["did you mean tenth-bounce?"]);
    refused_with("solve -", &SCENE.replace("speed = 3", "sped = 3"), &["did you mean speed?"]);
    let folder = Folder::new();
    folder.write("my_rod.toml", SCENE);
    refused(&format!("solve {}", folder.path("my_rd.toml")), &["did you mean `", "my_rod.toml`?"]);
    refused(&format!("solve {}", folder.path("my_rod")), &["my_rod.toml`?"]);
}

#[test]
fn quiet_and_colour() {
    let dragged = "rod = { length = 1, wave_speed = 10, damping = 2 }\nimpact.drop_height = 0.5\n\
        gravity.acceleration = 9.81\n";
    assert!(run_with("solve - --format json", dragged).err.starts_with("warning: "));
    assert_eq!(run_with("-q solve - --format json", dragged).err, "");
    assert_eq!(run_with("solve - --format json --quiet", dragged).err, "");
    assert!(run("--color always solve nope").err.contains('\u{1b}'));
    assert!(run("solve --color=always").err.contains('\u{1b}'));
    assert!(!run("--color never solve nope").err.contains('\u{1b}'));
}

#[test]
fn what_was_expected_is_said() {
    refused("solve paper-strong --digits abc", &["expected a whole number of digits, such as 50"]);
    refused("solve paper-strong --accuracy abc", &["expected a number such as 1e-10"]);
    #[cfg(target_os = "linux")]
    refused("solve paper-strong -o /proc/x.csv", &["cannot write", "no file can be made in /proc"]);
    // μ = √(2 · 9.81 · 0.5), and g/2r.
    let scene =
        "rod = { length = 1, wave_speed = 10, damping = 2 }\nimpact.drop_height = 0.5\ngravity.acceleration = 9.81\n";
    let Run { out, .. } = run_with("solve - --wide", scene);
    assert!(out.contains("= 3.13, takes no account") && out.contains("g/2r = 2.45: a gap of this height"), "{out}");
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let folder = Folder::new();

    // The ending of the file chooses the format; nothing stands on standard output.
    for (file, format) in [("a.json", "json"), ("a.csv", "csv"), ("a.txt", "table")] {
        assert_eq!(quiet(&format!("solve paper-strong -o {}", folder.path(file))), "");
        assert_eq!(folder.read(file), quiet(&format!("solve paper-strong --format {format} -o -")));
    }
    assert_eq!(folder.count(), 3);

    // A run that fails leaves an old file as it was.
    refused(&format!("sample paper-strong --quantity end --times -1 -o {}", folder.path("a.txt")), &["found time -1"]);
    assert_eq!(folder.read("a.txt"), quiet("solve paper-strong"));
    refused(&format!("solve paper-strong -o {}", folder.path("missing/a.json")), &["cannot write", "no folder"]);
    refused(&format!("solve paper-strong -o {}", folder.path("")), &["cannot write"]);
    assert_eq!(folder.count(), 3, "nothing is left behind");
}
