//! What `solve` prints at a terminal, and how wide.

use std::process::Command;

use crate::command::{quiet, run};

/// What a command prints at a terminal.
fn at_terminal(args: &str, settings: &[(&str, &str)]) -> String {
    let mut script = Command::new("script");
    script.args(["-qec", &format!("'{}' {args}", env!("CARGO_BIN_EXE_dalembert")), "/dev/null"]);
    let run = script.env("TERM", "xterm").envs(settings.iter().copied()).output().expect("`script` of util-linux");
    assert!(run.status.success(), "{args}");
    String::from_utf8(run.stdout).unwrap().replace('\r', "")
}

fn blocks(text: &str) -> Option<&str> {
    text.lines().find(|line| line.contains('█')).map(str::trim)
}

/// μ = 3 and c = L = g = 1: `v_x(0,t) = −(3 + t)` to t = 2, then a flight to t = 8.
#[test]
fn the_stress_is_drawn_at_a_terminal() {
    let shown = at_terminal("solve paper-strong", &[]);
    assert!(shown.contains("v_x(0,t) at the ground, t = 0 … 8, peak -5, · flight\n"), "{shown}");
    let line: Vec<char> = blocks(&shown).unwrap().chars().collect();
    assert_eq!(line.len(), 76);
    for (k, block) in line.iter().enumerate() {
        // The greatest value of each part is at its end.
        let pressed = 3.0 + 8.0 * (k + 1) as f64 / 76.0;
        let eighths = (8.0 * pressed / 5.0).ceil().min(8.0) as u32;
        let expected = if k < 19 { char::from_u32('▁' as u32 + eighths - 1).unwrap() } else { '·' };
        assert_eq!(*block, expected, "{k} in {shown}");
    }
    // All else is what a pipe gets, and nothing has a colour.
    let piped = quiet("solve paper-strong");
    let (head, rest) = piped.split_once("\n\n").unwrap();
    let (drawn_head, drawn) = shown.split_once("\n\n").unwrap();
    assert_eq!((drawn_head, drawn.split_once("\n\n").unwrap().1), (head, rest));
    assert!(!shown.contains('\u{1b}'), "{shown}");
    assert_eq!(at_terminal("solve paper-strong", &[("NO_COLOR", "1")]), shown);
    // With a material it is a stress, and has its unit.
    let bar = at_terminal("solve doyen-ern-piperno", &[]);
    assert!(bar.contains("E v_x(0,t) at the ground, t = 0 … 16, peak -500 Pa, · flight\n"), "{bar}");
}

#[test]
fn the_stress_is_not_drawn_elsewhere() {
    assert_eq!(blocks(&quiet("solve paper-strong")), None);
    assert_eq!(at_terminal("solve paper-strong", &[("TERM", "dumb")]), quiet("solve paper-strong"));
    for format in ["json", "csv"] {
        let shown = at_terminal(&format!("solve paper-strong --format {format}"), &[]);
        assert_eq!(shown, quiet(&format!("solve paper-strong --format {format}")));
    }
    // Without gravity and speed nothing is pressed: there is nothing to draw.
    let still = "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = 1 }\nrun.time = 0.5\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("still.toml");
    std::fs::write(&path, still).unwrap();
    let shown = at_terminal(&format!("solve '{}'", path.display()), &[]);
    assert!(blocks(&shown).is_none() && !shown.contains("peak -"), "{shown}");
}

/// All that `solve` prints fits a terminal of 80 columns, in doubles and in thirty digits.
#[test]
fn tables_fit_eighty_columns() {
    let narrow = |args: &str| {
        let out = run(args).out;
        assert!(!out.is_empty(), "{args}");
        for line in out.lines() {
            assert!(line.chars().count() <= 80, "{args}: {line}");
        }
        out
    };
    for scene in ["doyen-ern-piperno", "siconos-impacting-bar", "getfem-dynamic-contact", "figure-1-r26", "steel-bar"] {
        narrow(&format!("solve {scene}"));
        narrow(&format!("solve {scene} --digits 30"));
    }
    for scene in ["doyen-ern-piperno", "steel-bar", "ansys-vm265", "mu-3-2-chaotic"] {
        narrow(&format!("explain {scene}"));
    }
    let bar = at_terminal("solve doyen-ern-piperno", &[]);
    assert!(bar.lines().all(|line| line.chars().count() <= 80), "{bar}");
    // The symbols are the same in both places.
    let legend = narrow("solve paper-strong --legend");
    let symbols = legend.split("\n\ntime  ").nth(1).unwrap();
    assert!(quiet("solve --help").contains(symbols.trim_end()), "{symbols}");
    assert!(!quiet("solve -h").contains("e_P"));
    // With --wide nothing is wrapped.
    let explained = run("explain steel-bar --wide").out;
    let effects = explained.split("\n\n").nth(1).unwrap();
    assert_eq!(effects.lines().count(), 2 + 11, "a line for each effect: {effects}");
    assert!(run("solve siconos-impacting-bar --wide").out.lines().any(|line| line.chars().count() > 120));
}
