//! First steps that newcomers were held up by.

use dalembert::{Number, Parameter, Rational};

use crate::command::{Folder, Run, json, quiet, refused, refused_with, run, run_with};
use crate::command_samples::column;

/// Two bars of steel and aluminium with a spring between them.
const SPRING: &str = "[[body]]\nlength = 0.3\nmodulus = 210e9\ndensity = 7850\narea = 1e-4\n[[body]]\nlength = 0.2\n\
    modulus = 70e9\ndensity = 2700\narea = 2e-4\nvelocity = -2\njoint = { stiffness = 5e7, bonded = true }\n\
    [run]\ntime = 1e-3\n";

fn written(name: &str, text: &str) -> (Folder, String) {
    let folder = Folder::new();
    let path = folder.write(name, text);
    (folder, path)
}

/// Each number of a chain has the accuracy of the answer, not of a natural scale that is a hundred times as great.
#[test]
fn numbers_of_soft_chains_have_their_digits() {
    let (_folder, scene) = written("spring.toml", SPRING);
    let names = "kinetic.1,strain_energy.1,E_total.1,E_total.2,force.1,u_end.1,v_top.1,gap.1";
    let values = |more: &str| -> Vec<[f64; 2]> {
        let args = format!("sample {scene} --quantity {names} --times 1e-3 --uncertainty");
        let found = json(&format!("{args} {more}"));
        let number = |name: &str| {
            let value = column(&found, name)[0];
            value.as_f64().or_else(|| value.as_str()?.parse().ok()).unwrap()
        };
        names.split(',').map(|name| [number(name), number(&format!("{name}_uncertainty"))]).collect()
    };
    let (doubles, digits) = (values(""), values("--digits 25"));
    for ((name, [found, bound]), [expected, _]) in names.split(',').zip(doubles).zip(digits) {
        let size = expected.abs();
        assert!(bound <= 1e-9 * size && (found - expected).abs() <= bound + 1e-15 * size, "{name}: {found} ± {bound}");
    }
}

/// A velocity that is one number is that of the whole body, however long it is.
#[test]
fn lengths_of_bodies_are_swept() {
    let at = "--time 0.05 --format csv";
    let out = quiet(&format!("sweep openfoam-7-1-2 --body 1 --vary rod.length=5,10,20 --quantity u_top {at}"));
    // The striker moves at 0.1 until it meets the target at t = 0.1.
    let places = out.lines().skip(1).map(|line| line.split(',').nth(2).unwrap().parse::<f64>().unwrap());
    let apart: Vec<f64> = places.map(|place| (place - 0.005).abs()).collect();
    assert!(apart.len() == 3 && apart.iter().all(|apart| *apart < 1e-15), "{out}");
}

#[test]
fn long_runs_are_refused_or_foreseen() {
    let refusal = "which is 5e12 round trips, expected at most 1e12 round trips of 2L/c";
    refused("sample doyen-ern-piperno --quantity force --times 1e13", &["found time = 1e13"]);
    let unit = "[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 1\n[gravity]\nacceleration = 1\n";
    refused_with("sample - --quantity force --times 1e13", unit, &[refusal]);
    // Two unlike bars between walls: pieces grow faster than the time.
    let bars = "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = 1\n[[body]]\nlength = \"1/3\"\n\
        wave_speed = \"7/5\"\nimpedance = 2\n[ends]\nbottom = \"ground\"\ntop = \"ground\"\n[run]\ntime = 1e4\n";
    let out = run_with("explain -", bars).text(0);
    let cost = out.lines().find(|line| line.starts_with("cost: about")).unwrap();
    assert!(cost.contains("wave pieces up to t = 1e4") && cost.contains("they grow like t^"), "{cost}");
}

#[test]
fn a_chain_is_sampled_beyond_its_own_run() {
    let at = |time: &str| quiet(&format!("sample openfoam-7-1-2 --quantity u_end.2 --format csv --times {time}"));
    assert!(at("0.6").lines().last().unwrap().starts_with("0.6,right,0.0"), "{}", at("0.6"));
}

#[test]
fn misspelt_springs_and_forgotten_states_are_named() {
    let rod = "[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 1\n[run]\ntime = 3\n";
    let known = "expected one of velocity, stiffness, damping, penalty (did you mean stiffness?)";
    refused_with("solve -", &format!("{rod}[ground]\nstiffnes = 5\n"), &["`stiffnes`", known]);
    refused_with("solve -", &format!("{rod}[ground]\npenalty = -5\n"), &["penalty = -5, expected zero or more"]);
    let empty = "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n[ends]\ntop = {}\n[run]\ntime = 1\n";
    refused_with("solve -", empty, &["top of [ends] with no key"]);
    let bar = "[[body]]\nlength = 1\nmodulus = 1\ndensity = 1\npoisson = 0.3\n[run]\ntime = 1\n";
    let state = "found poisson without a state, expected state = \"uniaxial strain\", or \"uniaxial stress\"";
    refused_with("solve -", bar, &[state]);
    run_with("solve -", &bar.replace("0.3", "0.3\nstate = \"uniaxial stress\"")).text(0);
}

/// Data with an axis that points to the ground.
#[test]
fn a_turned_axis_is_named() {
    let scene = "sample doyen-ern-piperno --quantity t,u_end,v_end,force --dt 0.01 --to 3";
    let given = quiet(&format!("{scene} --format csv --bare --side right"));
    let turned = |line: &str| -> String {
        let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
        for cell in &mut cells[1..3] {
            *cell = format!("{:e}", -cell.parse::<f64>().unwrap());
        }
        cells.join(",")
    };
    let mut lines = given.lines().map(|line| line.replace(",right", ""));
    let head = lines.next().unwrap().replace(",side", "");
    let rows: Vec<String> = lines.map(|line| turned(&line)).collect();
    let (_folder, data) = written("run.csv", &format!("{head}\n{}\n", rows.join("\n")));
    let hints = json(&format!("compare doyen-ern-piperno {data} --to 3"))["hints"].clone();
    assert_eq!((&hints[0]["kind"], hints.as_array().unwrap().len()), (&"axis".into(), 1), "{hints}");
    let down = json(&format!("compare doyen-ern-piperno {data} --to 3 --axis down"));
    assert_eq!(down["hints"], serde_json::json!([]));
}

/// A fall from a height with a speed that is no fraction is compared with a soft contact too.
#[test]
fn a_drop_height_meets_a_penalty() {
    let rod = "[rod]\nlength = 1\nwave_speed = 100\n[impact]\ndrop_height = 1\n[gravity]\nacceleration = 1\n\
        [run]\ntime = 0.03\n";
    let (folder, scene) = written("rod.toml", rod);
    let data = folder.write("run.csv", "t,u\n0,0\n0.01,-0.012\n0.02,-0.013\n0.03,0.001\n");
    let report = json(&format!("compare {scene} {data} --contact-stiffness 50"));
    assert_eq!(report["softness"].as_array().unwrap().len(), 1);
}

/// Springs and masses have no fractions, whatever their numbers are.
#[test]
fn exact_numbers_of_soft_chains_are_digits() {
    let refusal = "found a chain with springs, dashpots or masses in fractions, expected digits";
    for stiffness in ["20", "25"] {
        let scene = format!(
            "[rod]\nlength = 1\nwave_speed = 1\nimpedance = 1\n[impact]\nspeed = 1\n[ground]\n\
            stiffness = {stiffness}\n[run]\ntime = 3\n"
        );
        refused_with("solve - --exact", &scene, &[refusal]);
        refused_with("solve - --exact --body 1", &scene, &[refusal]);
        let out = run_with("solve - --exact --digits 12 --body 1", &scene).text(0);
        assert!(out.contains("the signals of springs, dashpots and masses are no fractions"), "{out}");
    }
}

#[test]
fn derivatives_without_rows_have_no_table() {
    let out = run("solve saint-venant-mass --body 1 --derivatives length").text(0);
    assert!(!out.contains("by length:"), "{out}");
}

/// The help, the guide to the output and the refusal of a name list the same parameters.
#[test]
fn parameters_of_derivatives_are_listed_alike() {
    let help = quiet("solve --help");
    let help = help.split_once("--derivatives").unwrap().1.split_once("\n      --").unwrap().0.to_string();
    let output = include_str!("../../../../docs/output.md");
    let output = output.split_once("\n## Derivatives\n").unwrap().1.split_once("\n## ").unwrap().0;
    let names: Vec<&str> = Parameter::all_differentiable().map(Parameter::name).collect();
    for name in &names {
        assert!(help.contains(name) && output.contains(&format!("`{name}`")), "{name}:\n{help}");
    }
    let listed = format!("expected one of {}", names.join(", "));
    for (command, name) in [("solve", "foo"), ("solve", "area"), ("sample", "time"), ("solve", "run.impacts")] {
        let unknown = format!("found the parameter `{name}`, {listed}");
        refused(&format!("{command} paper-strong --derivatives {name}"), &[&unknown]);
    }
    assert!(quiet("solve paper-strong --derivatives rod.length").contains("length"));
}

/// A rod by itself needs no impedance: its forces are those per ρA.
#[test]
fn a_rod_on_a_spring_needs_no_impedance() {
    let scene = |more: &str| {
        format!(
            "[rod]\nlength = 1\nwave_speed = 2\n{more}[impact]\nspeed = 1\n[ground]\npenalty = 20\n[run]\ntime = 3\n"
        )
    };
    let [without, with] = ["", "impedance = 2\n"].map(|more| run_with("solve -", &scene(more)).out);
    assert!(without == with && without.contains("peak_force"), "{without}");
    let two = "[[body]]\nlength = 1\nwave_speed = 1\n[run]\ntime = 1\n";
    refused_with("solve -", two, &["no impedance in [[body]] 1"]);
}

/// A modulus in GPa beside a density in kg/m³ is noticed, in a table, in JSON, and for a single body.
#[test]
fn a_modulus_of_the_wrong_unit_is_noticed_in_chains() {
    let gigapascals = SPRING.replace("210e9", "210").replace("70e9", "70");
    for args in ["solve -", "sample - --times 1e-3", "solve - --format json"] {
        let [right, wrong] = [SPRING, &gigapascals].map(|scene| run_with(args, scene));
        assert!(!right.err.contains("GPa") && wrong.err.contains("such as GPa in place of Pa"), "{}", wrong.err);
        assert_eq!((right.code, wrong.code), (Some(0), Some(0)));
    }
    let found = run_with("solve - --format json", &gigapascals).out;
    assert!(found.contains("such as GPa in place of Pa"), "{found}");
}

/// A rod above ground that yields starts as one above rigid ground: its displacement is its height, whether a gap or a
/// displacement gives it, and it lands at the same time.
#[test]
fn a_rod_above_a_spring_starts_as_above_rigid_ground() {
    let by_gap = "[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 0\ngap = 0.5\n[gravity]\nacceleration = 1\n\
                  [run]\ntime = 2\n";
    let start = "[start]\ndisplacement = [[0, 0.5], [1, 0.5]]";
    let by_displacement = by_gap.replace("[impact]\nspeed = 0\ngap = 0.5", start);
    let sampled = |scene: &str| {
        let args = "sample - --times 0,0.5,1 --quantity u_end,h,v_end,E_total --format csv --bare";
        let rows = run_with(args, scene).out.lines().skip(1).map(String::from).collect::<Vec<_>>();
        let numbers = |row: &String| row.split(',').skip(2).map(|x| x.parse::<f64>().unwrap()).collect::<Vec<f64>>();
        rows.iter().map(numbers).collect::<Vec<_>>()
    };
    let rigid = sampled(by_gap);
    for scene in [by_gap, &by_displacement] {
        let soft = format!("{scene}[ground]\nstiffness = 1e5\n");
        for (row, (found, expected)) in sampled(&soft).iter().zip(&rigid).enumerate() {
            // The velocity at the landing has the limit after it: contact on rigid ground stops the end.
            let near = |k: usize| (found[k] - expected[k]).abs() < 1e-12;
            assert!((0..4).all(|k| near(k) || (row == 2 && k == 2)), "{found:?} {expected:?}\n{scene}");
        }
        let events = run_with("solve - --part events --format csv", &soft).out;
        assert!(events.contains("\nbottom,impact,1,-1,-1,"), "{events}");
    }
    let below = by_displacement.replace("0.5]", "-0.5]") + "[ground]\nstiffness = 1e5\n";
    refused_with("solve -", &below, &["found the displacement -0.5 at x = 0", "the ground is at zero"]);
}

/// Bodies under another name are told theirs.
#[test]
fn bodies_by_another_name_are_told_theirs() {
    let scene = SPRING.replace("[[body]]", "[[bodies]]");
    refused_with("solve -", &scene, &["unknown key `bodies`", "did you mean [[body]]?"]);
}

/// A value that a chain does not have is refused before a sweep.
#[test]
fn a_sweep_over_a_value_that_is_not_there_is_refused() {
    for value in ["body.9.density", "top.stiffness", "joint.3.gap"] {
        let args = "sweep openfoam-7-1-2 --body 1 --quantity u_top --time 0.1";
        refused(&format!("{args} --vary {value}=1"), &[value, "one that the chain has"]);
    }
}

/// More digits do not tell what a rod does that nothing moves.
#[test]
fn a_damped_rod_at_rest_stays_where_it_is() {
    let scene = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.1\n[start]\nvelocity = [[0, 0], [1, 0]]\n\
                 [run]\nimpacts = 2\n";
    for numbers in ["", "--digits 30"] {
        let Run { out, .. } = run_with(&format!("solve - {numbers}"), scene);
        assert!(out.contains("no bounce: neither speed nor gravity: nothing moves"), "{out}");
    }
}

/// Two equal bars that meet again and again between two stops.
const BARS: &str = "body = [{ length = 1, wave_speed = 1, impedance = 1, velocity = 1 },\n\
                    { length = 1, wave_speed = 1, impedance = 1, gap = 1 }]\n\
                    ends = { bottom = { gap = 1 }, top = { gap = 1 } }\nrun = { time = 1000, pieces = 60 }\n";

/// A run goes as far as the times that are asked for, and no piece beyond its limit.
#[test]
fn early_times_need_no_long_run() {
    let sampled = run_with("sample - --times 1.5 --quantity force.1 --format csv --bare", BARS);
    assert_eq!(sampled.out, "t,side,force.1\n1.5,right,0.5\n");
    let early = "sample - --times -1 --quantity force.1";
    refused_with(early, &BARS.replace("= 1000", "= 4"), &["found time -1, expected times from 0 on"]);
    refused_with("solve -", BARS, &["passed 60 pieces"]);
    let soft = BARS.replace("gap = 1 }]", "gap = 1, joint = { stiffness = 9 } }]").replace("= 1000", "= 20");
    refused_with("solve -", &soft, &["passed 60 pieces"]);
    run_with("solve -", &soft.replace("pieces = 60", "pieces = 6000"));
}

#[test]
fn columns_of_a_chain_are_named_once() {
    refused_with("sample - --quantity force.1,force.1", BARS, &["found --quantity force.1 twice"]);
    let scene = BARS.replace("gap = 1 }]", "gap = 1 }, { mass = 1, gap = 1, velocity = 1e41 }]");
    refused_with("solve -", &scene, &["velocity = 1e41"]);
}

/// The bound beside a number of a table is that of the printed digits: 7/170 has more of them.
#[test]
fn bounds_in_tables_hold_for_what_is_printed() {
    for more in ["", "--certified"] {
        let table = run(&format!("sample openfoam-7-1-2 --times 0.2 --quantity force.1 --uncertainty {more}")).out;
        let cells: Vec<&str> = table.split_whitespace().skip_while(|cell| !cell.starts_with("0.041")).collect();
        let [printed, bound] =
            [cells[0], cells[cells.len() - 1]].map(|cell| cell.parse::<Number>().unwrap().to_rational());
        let off = printed - Rational::from(7) / Rational::from(170);
        assert!(off.clone() * &off <= bound.clone() * &bound && off != 0, "{table}");
    }
}
