//! Sweeps: their numbers against closed forms, and the same bytes from any number of threads, parts and interruptions.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::command::{Folder, json, run as run_any};

/// Standard output, or what standard error says in one line of a run that is refused with code 2.
fn run(args: &str) -> Result<String, String> {
    dalembert(&format!("sweep {args}"))
}

fn dalembert(args: &str) -> Result<String, String> {
    let found = run_any(args);
    if found.code == Some(0) {
        return Ok(found.out);
    }
    assert_eq!((found.code, found.out.as_str()), (Some(2), ""));
    Err(found.words())
}

fn swept(args: &str) -> Value {
    json(&format!("sweep {args}"))
}

/// c = L = g = 1: t₁ = μ₀ = 2.
const SCENE: &str = "paper-strong";

#[test]
fn undamped_points_are_those_of_corollary_1() {
    let vary = "--vary rod.wave_speed=1,2 --vary impact.speed=0.25..4:16";
    let text = run(&format!("{SCENE} {vary} --vary gravity.acceleration=1 --vary rod.length=1"));
    assert!(text.unwrap_err().contains("--quantity"));
    let json = swept(&format!("{SCENE} --quantity bounce_time,restitution,e_P {vary}"));
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 32);
    for (k, point) in points.iter().enumerate() {
        let (c, mu) = (if k < 16 { 1.0 } else { 2.0 }, 0.25 * (k % 16 + 1) as f64);
        assert_eq!(point["at"]["impact.speed"], mu.to_string());
        // t_b = 2t₁ − μ/g below the critical speed g t₁, and t₁ above it.
        let trip = 2.0 / c;
        let bounce = if mu < trip { 2.0 * trip - mu } else { trip };
        let within = |name: &str, truth: f64| {
            let (value, bound) = (&point["values"][name], &point["uncertainty"][name]);
            assert!((value.as_f64().unwrap() - truth).abs() <= bound.as_f64().unwrap(), "{point}: {name} = {truth}");
        };
        within("bounce_time", bounce);
        within("e_P", (mu / trip).min(1.0));
        if mu >= trip {
            // E_z/E = μ₀²/3μ².
            within("e_E2", 1.0 - trip * trip / (3.0 * mu * mu));
        }
    }
}
#[test]
fn what_follows_the_first_bounce_of_a_damped_rod_is_proved() {
    let json = swept("figure-4-r02 --quantity last_event,bounce_time --certified --vary run.impacts=1,2");
    // M is above the threshold of (2.32): the bounce comes at t₁ = 2, the last event of the first contact alone.
    let points = json["points"].as_array().unwrap();
    let value = |point: usize, name: &str| points[point]["values"][name]["value"].as_str().unwrap().to_string();
    for point in [0, 1] {
        assert_eq!(value(point, "bounce_time"), "2.00000000000000");
    }
    assert_eq!(value(0, "last_event"), "2.00000000000000");
    assert!(value(1, "last_event").parse::<f64>().unwrap() > 4.0);
}

const VARY: &str = "paper-strong --vary impact.speed=0.05..12.5:23:log --vary rod.damping=0,0.1,-1,4 \
    --quantity bounce_time,energy";

#[test]
fn parts_and_threads_give_the_bytes_of_one() {
    let whole = run(&format!("{VARY} --format csv --threads 1")).unwrap();
    assert_eq!(whole, run(&format!("{VARY} --format csv --threads 3")).unwrap());
    let mut parts = String::new();
    for part in ["1/5", "2/5", "3/5", "4/5", "5/5"] {
        let text = run(&format!("{VARY} --format csv --shard {part}")).unwrap();
        parts += text.split_once('\n').filter(|_| !parts.is_empty()).map_or(text.as_str(), |(_, rows)| rows);
    }
    assert_eq!(whole, parts);
    // A point that fails is a row that says why.
    let row = |k: usize| whole.lines().nth(k + 1).unwrap();
    assert_eq!(row(2), "2,0.05,-1,,,,,,,,,\"found damping = -1, expected a damping of zero or more\"");
    assert!(row(3).starts_with("3,0.05,4,,,,,,,,,\"no bounce: r t₁ = 8.000000 ≥ π"), "{}", row(3));
    assert_eq!(whole.lines().count(), 1 + 23 * 4);
}

#[test]
fn a_killed_sweep_resumes_to_the_same_bytes() {
    let folder = Folder::new();
    let (whole, killed, journal) =
        (folder.path("whole.npz"), folder.path("killed.npz"), folder.path("killed.npz.unfinished"));
    let vary = "figure-4-r02 --vary impact.speed=0.5..9:120 --quantity bounce_time --digits 60";
    run(&format!("{vary} -o {whole}")).unwrap();
    // One thread solves so many points slowly enough to be killed among them.
    let killing = format!("{vary} -o {killed} --threads 1");
    let mut child = Command::new(env!("CARGO_BIN_EXE_dalembert"));
    let mut child = child.arg("sweep").args(killing.split_whitespace()).stdout(Stdio::null()).spawn().unwrap();
    // Until some points are kept, and not yet all.
    let start = Instant::now();
    while std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count()) < 5 {
        assert!(start.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(Path::new(&journal).exists() && !Path::new(&killed).exists(), "the sweep was over before it was killed");
    assert!(run(&killing).unwrap_err().contains("expected --resume to go on with it, or the file removed"));
    let other = format!("figure-4-r02 --vary impact.speed=1,2 --quantity bounce_time -o {killed} --resume");
    assert!(run(&other).unwrap_err().contains("killed.npz.unfinished of another sweep, expected the same command"));
    run(&format!("{killing} --resume")).unwrap();
    assert_eq!(std::fs::read(&whole).unwrap(), std::fs::read(&killed).unwrap());
    assert!(!Path::new(&journal).exists());
}

#[test]
fn what_is_no_sweep_is_said() {
    let said = |args: &str| run(&format!("{SCENE} --quantity bounce_time {args}")).unwrap_err();
    assert!(said("--vary rod.dampin=1").contains("(did you mean rod.damping?)"));
    assert!(said("--vary rod.damping=1 --vary rod.damping=2").contains("expected each value once"));
    assert!(said("--vary rod.damping=1m").contains("found `1m`, expected a number such as"));
    assert!(
        said("--vary rod.damping=0..1:5000 --vary rod.length=1..2:5000")
            .contains("5000 points, expected at most 10000000")
    );
    assert!(said("--vary rod.damping=0 --shard 3/2").contains("expected I/N such as 3/8"));
    assert!(said("--vary rod.damping=0 --time -1").contains("time"));
    assert!(
        said("--vary rod.damping=0 -o x.xlsx")
            .contains("found x.xlsx, expected a file that ends in .txt, .json, .csv or .npz")
    );
}

#[test]
fn the_map_of_regimes_is_the_same_from_any_number_of_threads() {
    let folder = Folder::new();
    let map = |threads: &str, ending: &str| {
        let path = folder.path(&format!("map-{threads}.{ending}"));
        let range = format!("regimes --damping-ratio 0..4:21 --speed-ratio 0.1..10:17:log --threads {threads}");
        dalembert(&format!("{range} -o {path}")).unwrap();
        std::fs::read(path).unwrap()
    };
    let csv = String::from_utf8(map("1", "csv")).unwrap();
    // R = π and more: none; the last M at R = 0: (2.32) with I₀ = 1, I₁ = 0 says M > 1.
    assert_eq!(csv.lines().filter(|line| line.starts_with("3.2,") && line.ends_with(",,no bounce")).count(), 17);
    assert!(
        csv.contains("\n0,10,1.0,bounce\n")
            && csv.starts_with("damping_ratio,speed_ratio,bounce_ratio,regime\n0,0.1,1.9")
    );
    for ending in ["csv", "npz", "svg"] {
        assert_eq!(map("1", ending), map("3", ending), "{ending}");
    }
    assert!(map("2", "png").starts_with(b"\x89PNG"));
    let curve = dalembert("regimes --curve --damping-ratio 0..2:3").unwrap();
    // (I₀(1) + I₁(1))/(2 − I₀(1)) = (1.2660658777520084 + 0.5651591039924851)/0.7339341222479916.
    assert!(curve.starts_with("damping_ratio,threshold,uncertainty\n0,1.0,"), "{curve}");
    assert!(curve.contains("\n1,2.495080") && curve.ends_with("\n2,,\n"), "{curve}");
    let said = |args: &str| dalembert(&format!("regimes {args}")).unwrap_err();
    assert!(said("--damping-ratio 1").contains("expected two values or more that increase"));
    assert!(said("--speed-ratio 0..1:5").contains("M from above zero"));
    assert!(said("-o map.doc").contains("expected a file that ends in .txt, .csv, .npz, .svg, .png or .pdf"));
}

/// A note stands below the table, in full, once for all points that have it.
#[test]
fn notes_stand_below_the_table() {
    let text = run("figure-1-r30 --vary rod.damping=2.6,3.2,3.2 --quantity bounce_time").unwrap();
    let (table, notes) = text.split_once("\n\n").unwrap();
    let last: Vec<&str> = table.lines().map(|line| line.split_whitespace().last().unwrap()).collect();
    assert_eq!((last[0], &last[3..]), ("note", &["[1]", "[1]"][..]));
    // r t₁ = 3.2 is above π.
    assert!(notes.starts_with("[1] no bounce: r t₁ = 3.2") && notes.trim_end().ends_with("from there"), "{notes}");
    assert!(!text.contains('…') && text.lines().all(|line| line.chars().count() <= 80), "{text}");
    assert!(!run("paper-strong --vary impact.speed=3,4 --quantity bounce_time").unwrap().contains("note"));
}

/// R = r t₁ ≥ π: no bounce at any of the points.
#[test]
fn a_sweep_without_any_number_fails() {
    let sweep = |dampings: &str| run_any(&format!("sweep {SCENE} --vary {dampings} --quantity bounce_time"));
    let (none, some) = (sweep("rod.damping=2,3"), sweep("rod.damping=0,2"));
    assert_eq!((none.code, some.code), (Some(1), Some(0)));
    assert!(none.out.contains("no bounce: r t₁ = 4.000000 ≥ π"));
}

/// c = L = μ = ρS = 1: T = 2 + x/k with eˣ = 2 + 2x, x = 1.678346990016661, and in the limit e_P = 1 and the force
/// ρSμc.
#[test]
fn stiffer_springs_come_to_rigid_ground() {
    let folder = Folder::new();
    let scene = "rod = { length = 1, wave_speed = 1, impedance = 1 }\nimpact.speed = 1\nground.penalty = 20\n\
                 run.time = 4\n";
    let path = folder.write("rod.toml", scene);
    let asked = format!("{path} --quantity bounce_time,e_P,peak_force,release_velocity");
    let json = swept(&format!("{asked} --vary ground.stiffness=1e1..1e12:12:log"));
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 12);
    for (k, point) in points.iter().enumerate().skip(1) {
        let (stiffness, value) = (10f64.powi(k as i32 + 1), |name: &str| point["values"][name].as_f64().unwrap());
        let late = value("bounce_time") - 2.0;
        assert!((late * stiffness - 1.678346990016661).abs() < 1e-15 * stiffness + 1e-9, "{point}");
        assert!((1.0 - value("e_P")) * stiffness < 0.06 && (value("peak_force") - 1.0).abs() < 1e-12, "{point}");
    }
    // Without a stiffness there is no ground, and a dashpot there is a value too.
    let none = swept(&format!("{asked} --vary ground.stiffness=0,20"));
    assert!(none["points"][0]["values"]["peak_force"].is_null() && none["points"][1]["values"]["peak_force"].is_f64());
    assert!(none.to_string().contains("found stiffness = 0 and no damping below the rod"), "{none}");
    folder.write("rod.toml", scene.replace("ground.penalty = 20", "ground = { penalty = 20, damping = 1 }"));
    let damped = run(&format!("{path} --format json --quantity peak_force --vary ground.damping=1,3"));
    assert!(damped.unwrap().contains("bottom.damping"));
    folder.write("rod.toml", scene);
    let said = run(&format!("{asked} --vary ground.penalty=1,2")).unwrap_err();
    assert!(
        said.contains("found the parameter `ground.penalty`") && said.contains("did you mean stiffness?"),
        "{said}"
    );
}

/// E = 4, ρ = 1, S = 2, L = 2: c = 2, ρS = 2, t_b = 2. What turns round is 2ρSLμ = 8 N s at the force ESμ/c = 4 N, and
/// the energy is ρSLμ²/2 = 2 J, as `solve` has them.
#[test]
fn numbers_are_in_the_units_of_the_material() {
    let folder = Folder::new();
    let scene = "rod = { length = 2, modulus = 4, density = 1, area = 2 }\nimpact = { speed = 1 }\n";
    let path = folder.write("rod.toml", scene);
    let asked = "--quantity energy,impulse,peak_force,peak_stress,bounce_time --vary impact.speed=1,2";
    let json = swept(&format!("{path} {asked}"));
    let names = ["E_total", "impulse", "peak_force", "peak_stress", "bounce_time"];
    let values = |k: usize| names.map(|name| json["points"][k]["values"][name].as_f64().unwrap());
    assert_eq!(values(0), [2.0, 8.0, 4.0, -2.0, 2.0]);
    assert_eq!(values(1), [8.0, 16.0, 8.0, -4.0, 2.0]);
    assert_eq!(names.map(|name| json["units"][name].as_str().unwrap()), ["J", "N s", "N", "Pa", "s"]);
    let csv = run(&format!("{path} {asked} --format csv")).unwrap();
    assert!(csv.starts_with("point,impact.speed,E_total [J],E_total_uncertainty [J],E_h [J],"), "{csv}");
}

/// c = L = g = 1: μ = 1 lands first at 3 + √2, which is no fraction.
#[test]
fn notes_say_where_exactness_ends_and_a_time_must_be_of_use() {
    let vary = "paper-weak --vary impact.speed=1,4 --vary run.impacts=2";
    let json = swept(&format!("{vary} --quantity last_event --exact --digits 20"));
    let note = json["points"][0]["notes"]["last_event"].as_str().unwrap();
    assert!(note.contains("t = 3 + √2") && note.ends_with("the number is in 20 digits"), "{note}");
    let said = run(&format!("{vary} --quantity bounce_time --time 1")).unwrap_err();
    assert!(said.contains("found time 1, expected none: bounce_time is not asked at a time"), "{said}");
}
