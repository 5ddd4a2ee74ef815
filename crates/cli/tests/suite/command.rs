//! The command line: what stands on standard output and standard error, and the exit code.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use dalembert::Quantity;
use dalembert::quantity::Needs;
use serde_json::Value;
use tempfile::TempDir;

use crate::command_samples::{column, names};

/// What a run of the command left.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Run {
    /// Standard error with one space between two words.
    pub(crate) fn words(&self) -> String {
        self.err.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The standard output of a run that ends with this code.
    #[track_caller]
    pub(crate) fn text(&self, code: i32) -> String {
        assert_eq!(self.code, Some(code), "{}", self.err);
        self.out.clone()
    }

    /// The JSON on standard output.
    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|_| panic!("{}", self.err))
    }

    /// Holds a run to be refused, as [`refused`] does, and returns the words of standard error.
    #[track_caller]
    fn refused(&self, args: &str, said: &[&str]) -> String {
        let Run { code, out, err } = self;
        assert_eq!((*code, out.as_str()), (Some(2), ""), "{args}: {err}");
        assert!(!err.contains('\u{1b}'), "{args}: colour off a terminal");
        let words = self.words();
        for text in said {
            assert!(words.contains(text), "{args}: no `{text}` in\n{err}");
        }
        words
    }
}

/// A folder in which commands run.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(TempDir::new().unwrap())
    }

    /// The path of a file in it, or of itself where the name is empty.
    pub(crate) fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().trim_end_matches('/').to_string()
    }

    /// Writes a file, and returns its path.
    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        std::fs::write(self.path(name), text).unwrap();
        self.path(name)
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        Path::new(&self.path(name)).exists()
    }

    /// The number of files in it.
    pub(crate) fn count(&self) -> usize {
        self.0.path().read_dir().unwrap().count()
    }

    pub(crate) fn run(&self, args: &str) -> Run {
        run_in(Some(self.0.path()), args, "")
    }

    #[track_caller]
    pub(crate) fn json(&self, args: &str) -> Value {
        let run = self.run(&format!("{args} --format json"));
        run.text(0);
        run.json()
    }

    #[track_caller]
    pub(crate) fn refused(&self, args: &str, said: &[&str]) -> String {
        self.run(args).refused(args, said)
    }
}

/// Runs the command with these arguments, which white space separates.
pub(crate) fn run_with(args: &str, input: &str) -> Run {
    run_in(None, args, input)
}

fn run_in(folder: Option<&Path>, args: &str, input: &str) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_dalembert"))
        .args(args.split_whitespace())
        .current_dir(folder.unwrap_or(Path::new(".")))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that does not read its input may be gone by now.
    child.stdin.take().unwrap().write_all(input.as_bytes()).ok();
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Run { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

pub(crate) fn run(args: &str) -> Run {
    run_with(args, "")
}

/// The standard output of a run that succeeds without a word on standard error.
#[track_caller]
pub(crate) fn quiet(args: &str) -> String {
    let Run { code, out, err } = run(args);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{args}");
    assert!(!out.contains('\u{1b}'), "{args}: colour off a terminal");
    out
}

/// A run that is refused: code 2, nothing on standard output, all of `said` on standard error.
#[track_caller]
pub(crate) fn refused(args: &str, said: &[&str]) {
    refused_with(args, "", said);
}

#[track_caller]
pub(crate) fn refused_with(args: &str, input: &str, said: &[&str]) {
    run_with(args, input).refused(args, said);
}

/// The JSON of a run that is [`quiet`].
#[track_caller]
pub(crate) fn json(args: &str) -> Value {
    serde_json::from_str(&quiet(&format!("{args} --format json"))).unwrap()
}

/// The fields of a CSV without its comments, row by row.
pub(crate) fn csv(text: &str) -> Vec<Vec<String>> {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| row.split(',').map(String::from).collect()).collect()
}

/// Runs `check` with the snapshots of the repository.
pub(crate) fn with_snapshots(check: impl FnOnce()) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../../snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(check);
}

/// Holds the keys of an object to be these, which white space separates.
#[track_caller]
pub(crate) fn keys(value: &Value, expected: &str) {
    let found: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(found, expected.split_whitespace().collect::<Vec<_>>());
}

pub(crate) const SCENE: &str = "[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 3\n[gravity]\nacceleration = 1\n";

/// Every key of schema 1, and that `is_number` holds of every number.
#[track_caller]
fn history_schema(history: &Value, is_number: fn(&Value) -> bool) {
    let top = "schema title number effects units exact_until events contacts flights stress end error_estimate \
               digits_lost warnings";
    keys(history, top);
    assert_eq!(history["schema"], 1);
    assert!(history["effects"].as_array().unwrap().iter().all(Value::is_string));
    for event in history["events"].as_array().unwrap() {
        keys(event, "kind t v_end h h_rate uncertainty");
        keys(&event["uncertainty"], "t v_end h h_rate");
        assert!(event["kind"] == "impact" || event["kind"] == "release");
        assert!(["t", "v_end", "h", "h_rate"].iter().all(|key| is_number(&event[*key])));
    }
    for contact in history["contacts"].as_array().unwrap() {
        for quantity in Needs::Contact.quantities().filter(|quantity| quantity.is_listed(false)) {
            assert!(is_number(&contact[quantity.name()]), "{quantity} of {contact}");
        }
    }
    for piece in history["stress"]["pieces"].as_array().unwrap() {
        assert!(["start", "end", "strain_start", "strain_end"].iter().all(|key| is_number(&piece[*key])));
    }
    assert!(is_number(&history["end"]["t"]));
    every_number_has_a_bound(history);
}

/// Each number of an event, a contact, a flight, a piece and the end has its bound, which an enclosure has in itself.
#[track_caller]
fn every_number_has_a_bound(history: &Value) {
    fn held(value: &Value, bound: &Value) -> usize {
        match value {
            Value::Null => 0,
            Value::Object(parts) if !parts.contains_key("lo") => {
                let apart = ["uncertainty", "undefined"];
                let numbers = parts.iter().filter(|(key, _)| !apart.contains(&key.as_str()));
                numbers.map(|(key, value)| held(value, &bound[key])).sum()
            }
            Value::Array(list) => list.iter().zip(bound.as_array().unwrap()).map(|(x, bound)| held(x, bound)).sum(),
            Value::String(word) if word.contains("impact") || word.contains("release") || bound.is_null() => 0,
            number => {
                assert!(bound.is_number() || bound.is_string() || number["lo"].is_string(), "{number} {bound}");
                1
            }
        }
    }
    let lists = [&history["events"], &history["contacts"], &history["flights"], &history["stress"]["pieces"]];
    for (list, least) in lists.into_iter().zip([4, 11, 1, 4]) {
        let rows = list.as_array().unwrap();
        let counts = rows.iter().map(|row| held(row, &row["uncertainty"]));
        assert!(counts.clone().all(|count| count >= least), "{:?}", counts.collect::<Vec<_>>());
    }
    let time = &history["end"]["t"];
    assert_eq!(held(time, &history["end"]["uncertainty"]["t"]), 1);
}

#[test]
fn json_of_a_history_in_double_precision() {
    let history = json("solve doyen-ern-piperno");
    history_schema(&history, Value::is_number);
    assert_eq!(history["number"], "double");
    assert_eq!(history["events"].as_array().unwrap().len(), 12);
    let names = Needs::Contact.quantities().map(Quantity::name).chain(["uncertainty"]);
    keys(&history["contacts"][0], &names.collect::<Vec<_>>().join(" "));
    assert!((history["contacts"][1]["impact"].as_f64().unwrap() - 8.0 / 3.0).abs() < 1e-14);
}

#[test]
fn json_of_a_history_in_fractions() {
    let history = json("solve doyen-ern-piperno --exact");
    history_schema(&history, Value::is_string);
    assert_eq!(history["number"], "exact");
    assert_eq!((&history["events"][0]["kind"], &history["events"][0]["t"]), (&"impact".into(), &"0".into()));
    assert_eq!(
        (&history["contacts"][1]["impact"], &history["contacts"][1]["release"]),
        (&"8/3".into(), &"10/3".into())
    );
    // −P/P and E_h/E_h of the second contact, its end compared with its own start.
    assert_eq!(history["contacts"][1]["e_P"], "1");
    assert_eq!(history["contacts"][1]["e_E2"], "27/23");
    assert_eq!(history["contacts"][0]["E_z_after"], "2000/27");
}
#[test]
fn digits_are_exactly_as_many_as_asked_for() {
    let significant = |text: &str| {
        let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
        mantissa.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count()
    };
    for digits in [5_usize, 38, 200] {
        let text = digits.to_string();
        let history = json(&format!("solve doyen-ern-piperno --digits {text}"));
        history_schema(&history, Value::is_string);
        assert_eq!(history["number"], format!("{digits} digits"));
        for event in history["events"].as_array().unwrap() {
            for key in ["t", "v_end", "h", "h_rate"] {
                let shown = event[key].as_str().unwrap();
                assert!(shown == "0" || significant(shown) == digits, "{digits} digits: {shown}");
            }
        }
        // 2/3, correctly rounded.
        let expected = format!("0.{}7", "6".repeat(digits - 1));
        assert_eq!(history["events"][1]["t"], expected);
    }
}
#[test]
fn proved_digits_come_with_their_bounds() {
    let history = json("solve mu-1-period-36 --certified --digits 40");
    let bounded = |value: &Value| value["value"].is_string() && value["lo"].is_string() && value["hi"].is_string();
    history_schema(&json("solve doyen-ern-piperno --certified"), bounded);
    assert_eq!(history["number"], "40 digits, proved");
    // 3 + √2.
    let landing = &history["events"][2]["t"];
    assert_eq!(landing["value"], "4.414213562373095048801688724209698078570");
    let digits = "414213562373095048801688724209698078569671875376948";
    for (end, up) in [("lo", false), ("hi", true)] {
        let text = landing[end].as_str().unwrap();
        let (whole, rest) = text.split_once('.').unwrap();
        // An end beside the printed value moves out to it.
        assert_eq!((whole, rest.len()), ("4", if text == landing["value"] { 39 } else { 49 }));
        assert!(if up { rest > &digits[..49] } else { rest <= &digits[..49] }, "{text}");
    }
    let rows = json("sample paper-weak --quantity strain --times 1/3,3 --certified");
    assert!(column(&rows, "strain").into_iter().all(bounded));
    refused("solve paper-weak --certified --exact", &["--certified", "--exact"]);
}

#[test]
fn an_undefined_restitution_is_null_with_its_reason() {
    // The rod starts compressed and at rest: no momentum to compare with.
    let scene =
        "rod = { length = 1, wave_speed = 1 }\nstart = { displacement = [[0, 0], [1, -0.25]] }\nrun = { time = 3 }";
    let history = run_with("solve - --format json", scene).json();
    let contact = &history["contacts"][0];
    assert!(contact["e_P"].is_null() && contact["e_E2"].is_null());
    assert!(contact["undefined"]["e_P"].as_str().unwrap().contains("no momentum"), "{contact}");
    assert!(contact["undefined"]["e_E2"].as_str().unwrap().contains("E_h"), "{contact}");
    // The table says the same in a line of its own.
    let table = run_with("solve -", scene).out;
    assert!(table.contains("contact from 0: the centre of mass has no momentum"), "{table}");
    // A contact without an end has none either.
    let history = run_with("solve - --format json", &format!("{SCENE}[run]\ntime = 1\n")).json();
    assert!(history["contacts"][0]["release"].is_null() && history["contacts"][0]["E_total_after"].is_null());
    assert!(history["contacts"][0]["undefined"]["e_P"].is_string());
}
#[test]
fn parameters_that_are_no_fractions() {
    refused(
        "solve siconos-impacting-bar --exact",
        &["the wave speed √(350000000/13)", "or digits in place of fractions"],
    );
    let Run { code, out, err } = run("solve siconos-impacting-bar --exact --digits 12");
    assert_eq!(code, Some(0));
    assert!(err.contains("the wave speed √(350000000/13) is no fraction; what follows is in 12 digits"), "{err}");
    // ρ c S v, and gap/v + 2L/c.
    assert!(out.contains("1270.82747846") && out.contains("0.000885449644664") && out.contains("12 digits"), "{out}");
}

#[test]
fn tables_of_fractions() {
    let out = quiet("solve doyen-ern-piperno --exact");
    with_snapshots(|| {
        insta::assert_snapshot!("table_doyen_ern_piperno", out);
        insta::assert_snapshot!("explain_doyen_ern_piperno", quiet("explain doyen-ern-piperno"));
    });
}

/// `--to` and `--impacts` take the place of the scene's own run, which for this one is one contact.
#[test]
fn a_run_of_another_length() {
    let contacts = |args: &str| json(&format!("solve paper-strong {args}"))["contacts"].clone();
    assert_eq!(contacts("").as_array().unwrap().len(), 1);
    // t_b = 2, and every flight is as long as 2 μ/g = 6: impacts at 0, 8, 16.
    assert_eq!(contacts("--impacts 3").as_array().unwrap().len(), 3);
    assert_eq!(contacts("--to 15").as_array().unwrap().len(), 2);
    assert_eq!(contacts("--to 16.5").as_array().unwrap().len(), 3);
    refused("solve paper-strong --impacts 0", &["found impacts = 0, expected a whole number"]);
}

#[test]
fn csv_parts() {
    let first = |part: &str| {
        let out = quiet(&format!("solve paper-strong --format csv {part}"));
        (out.lines().next().unwrap().to_string(), out.lines().count())
    };
    let events = "kind,t,v_end,h,h_rate,t_uncertainty,v_end_uncertainty,h_uncertainty,h_rate_uncertainty";
    assert_eq!(first(""), (events.into(), 3));
    let stress = "start,end,strain_start,strain_end,start_uncertainty,end_uncertainty,strain_start_uncertainty,\
        strain_end_uncertainty";
    assert_eq!(first("--part stress"), (stress.into(), 3));
    let (header, lines) = first("--part contacts");
    assert_eq!(header.split(',').count(), 28);
    assert!(header.ends_with(",E_z_after_uncertainty [per ρS]"), "{header}");
    assert!(
        header
            .starts_with("impact,release,duration,impact_velocity,release_velocity,impulse [per ρS],peak_strain,e_P,")
    );
    assert_eq!(lines, 2);
    // A part is a CSV without a word on it.
    assert_eq!(quiet("solve paper-strong --part stress").lines().count(), 3);
    refused(
        "solve paper-strong --part stress --format json",
        &["found --part, expected it with CSV only", "JSON holds all parts"],
    );
}

#[test]
fn the_same_bytes_twice() {
    for format in ["table", "json", "csv"] {
        let args = format!("solve mu-3-2-chaotic --format {format}");
        assert_eq!(quiet(&args), quiet(&args));
    }
}

#[test]
fn explain_names_the_line_of_every_effect() {
    let plan = json("explain doyen-ern-piperno");
    assert_eq!(plan["number"], "double");
    let effects = plan["effects"].as_array().unwrap();
    let effect = |name: &str| effects.iter().find(|effect| effect["effect"] == name).unwrap();
    let source = quiet("scenes doyen-ern-piperno");
    let line = effect("gravity")["line"].as_u64().unwrap();
    assert!(source.lines().nth(line as usize - 1).unwrap().starts_with("acceleration"));
    assert_eq!((&effect("damping")["called"], &effect("damping")["line"]), (&false.into(), &Value::Null));
    // Twelve events, of which the first is at t = 0 and one does not depend on the speed.
    assert_eq!(plan["sensitivity"]["events"], 10);
    // The one release of this scene comes at t₁ for every speed near its own: nothing to measure.
    assert!(!quiet("explain paper-strong --wide").contains("measured:"));
    refused("explain doyen-ern-piperno --format csv", &["[possible values: table, json]"]);
}

#[test]
fn scenes_are_printed_and_solve_as_printed() {
    let names: Vec<String> =
        quiet("scenes").lines().skip(2).map(|line| line.split_whitespace().next().unwrap().into()).collect();
    assert!(names.len() >= 12 && names.contains(&"doyen-ern-piperno".to_string()));
    for name in &names {
        let source = quiet(&format!("scenes {name}"));
        assert_eq!(run_with("solve -", &source).out, quiet(&format!("solve {name}")), "{name}");
    }
    refused("scenes nope", &["no built-in scene called `nope`", "dalembert scenes"]);
}

/// The damped scenes go through the same commands and formats.
#[test]
fn a_damped_history() {
    let history = json("solve figure-4-r02");
    assert_eq!(history["effects"], serde_json::json!(["unilateral_contact", "gravity", "damping"]));
    let contact = &history["contacts"][0];
    assert_eq!(contact["release"], 2.0);
    // e_E² of an independent program, `paper_r02_mu5` in tests/reference/first_contact.json, and its factors (4.73).
    let value = |key: &str| contact[key].as_f64().unwrap();
    let truth = 0.400_991_089_077_476_9;
    assert!((value("e_E2") - truth).abs() < 1e-12, "{}", value("e_E2"));
    assert!((value("translational_part") * value("energy_kept") - truth).abs() < 1e-12);
    // The stress between the ends of a piece is its Chebyshev sum.
    let piece = &history["stress"]["pieces"][0];
    let terms: Vec<f64> = piece["chebyshev"].as_array().unwrap().iter().map(|term| term.as_f64().unwrap()).collect();
    let middle = terms.iter().step_by(2).zip([1.0, -1.0].iter().cycle()).map(|(term, sign)| term * sign).sum::<f64>();
    let sample = json("sample figure-4-r02 --quantity strain --times 1");
    let strain = column(&sample, "strain")[0].as_f64().unwrap();
    assert!((middle - strain).abs() < 1e-12 * strain.abs(), "{middle} {strain}");
    // The end of a range is met exactly, or it would lie beyond the end of the history.
    let rows = quiet("sample figure-4-r02 --quantity strain --times 1.1..1.7:20 --format csv --bare");
    assert!(rows.lines().count() == 21 && rows.lines().last().unwrap().starts_with("1.7,"));
    let explained = json("explain figure-4-r02");
    assert_eq!(explained["engine"], "cells");
    // All that is decided, as data: what cells compute, what follows doubles.
    let plan = &explained["plan"];
    assert_eq!((&plan["rung"], &plan["goal"]["digits"]), (&"double".into(), &9.0.into()));
    assert_eq!(plan["cells"]["double_digits"], 13.0);
    assert_eq!(plan["climb"]["bits"], 128);
}

#[test]
fn no_bounce_is_an_answer() {
    let scene = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 1\n[impact]\nspeed = 1\n[gravity]\nacceleration = 1\n";
    let solved = run_with("solve - --format json", scene);
    assert_eq!((solved.code, solved.err.as_str()), (Some(0), ""));
    let history = solved.json();
    assert_eq!(history["events"].as_array().unwrap().len(), 1);
    assert_eq!(
        (&history["contacts"][0]["release"], &history["contacts"][0]["E_total_after"]),
        (&Value::Null, &Value::Null)
    );
    assert!(history["end"]["reason"].as_str().unwrap().starts_with("no bounce: "), "{}", history["end"]);
}

#[test]
fn a_damped_history_in_digits() {
    let digits = json("solve figure-1-r26 --digits 30");
    // `figure1_r26` in tests/reference/first_contact.json.
    assert_eq!(digits["events"][1]["t"], "1.78848103329887545175038380599");
    assert_eq!(digits["events"][1]["h_rate"], "0.00844410807842711928782346527941");
    let solved = run("solve figure-1-r26 --digits 310 --format json");
    let (many, err) = (solved.json(), solved.err);
    assert!(err.starts_with("note: ends at t = 1.7884810332988755: undecided: beyond 300 digits"), "{err}");
    assert!(many["events"][1]["t"].as_str().unwrap().len() == 311);
    assert!(many["end"]["reason"].as_str().unwrap().contains("300 digits"), "{}", many["end"]);
    let rounded = json("solve figure-1-r26 --accuracy 1e-15");
    assert_eq!(rounded["events"][1]["t"], 1.788_481_033_298_875_5);
}

#[test]
fn help_completions_and_version() {
    for args in ["--help", "solve --help", "sample --help", "explain --help", "scenes --help"] {
        assert!(quiet(args).contains("Usage: dalembert"), "{args}");
    }
    assert!(quiet("--version").starts_with("dalembert "));
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(quiet(&format!("completions {shell}")).contains("dalembert"), "{shell}");
    }
}

/// What the README shows is what the command prints; `…` stands for lines left out.
#[test]
fn the_readme_shows_real_output() {
    let readme = include_str!("../../../../README.md");
    let mut shown = 0;
    for block in readme.split("```console\n").skip(1).filter_map(|rest| rest.split("```").next()) {
        let (command, lines) = block.split_once('\n').unwrap();
        let out = quiet(command.strip_prefix("$ dalembert ").unwrap());
        for line in lines.lines().filter(|line| line.trim() != "…") {
            assert!(out.lines().any(|real| real.trim_end() == line.trim_end()), "{command}: {line}");
            shown += 1;
        }
    }
    assert!(shown > 10);
}

#[test]
fn a_material_gives_its_units() {
    let history = json("solve code-aster-sdnv100");
    assert_eq!((&history["units"]["stress"], &history["units"]["energy"]), (&"Pa".into(), &"J".into()));
    let contact = &history["contacts"][0];
    // ρ c μ, ρ c S μ, 2 ρ S L μ, ρ S L μ²/2.
    let expected = [
        (&contact["peak_strain"], -0.02),
        (&contact["peak_stress"], -4e9),
        (&contact["peak_force"], 1.6e6),
        (&contact["impulse"], 128.0),
        (&contact["E_total_after"], 3200.0),
    ];
    for (value, truth) in expected {
        assert!((value.as_f64().unwrap() / truth - 1.0).abs() < 1e-12, "{value} against {truth}");
    }
    let sampled = json("sample ansys-vm85 --quantity strain,stress,force --times 0.01");
    assert_eq!(names(&sampled), ["t", "side", "strain", "stress", "force"]);
    assert_eq!(sampled["columns"][3]["unit"], "psi");
    let energy = quiet("sample ansys-vm85 --quantity energy --times 0");
    assert!(energy.contains("energies in lbf in"), "{energy}");
    assert!(quiet("solve paper-strong").contains("impulse per ρS, energies per ρS\n"));
    let unknown = json("solve paper-strong");
    assert_eq!((&unknown["units"]["time"], &unknown["units"]["impulse"]), (&Value::Null, &"per ρS".into()));
}
