//! `dalembert compare` as a command: what it reads, prints, writes and refuses.

use std::fs;

use serde_json::Value;

use crate::command::Folder;

/// c = L = 1, g = 0, μ = 1: contact on [0, 2], u = t − 2 after it; v_x(0,t) = −1 in contact.
const SCENE: &str = "[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 1\n[run]\ntime = 4\n";

/// A folder with the scene and `data` in `run.csv`.
fn folder(data: &str) -> Folder {
    let folder = Folder::new();
    folder.write("rod.toml", SCENE);
    folder.write("run.csv", data);
    folder
}

/// Holds a comparison to be refused.
#[track_caller]
fn refused(folder: &Folder, args: &str, said: &[&str]) {
    let words = folder.refused(args, said);
    // What a map or a step mends, a flag gives.
    assert_eq!(words.contains("a map such as"), words.contains("help: --map"), "{words}");
}

/// Holds all quantities of a report to the exact ones within `most`, relative where those are not zero, and no hint.
#[track_caller]
fn agrees(report: &Value, most: f64, what: &str) {
    for quantity in report["quantities"].as_array().unwrap() {
        let norm = &quantity["linf"];
        let off = norm["relative"].as_f64().or(norm["absolute"].as_f64()).unwrap();
        assert!(off <= most, "{what}: {quantity}");
    }
    assert_eq!(report["hints"], serde_json::json!([]), "{what}");
}

const EXACT: &str = "t,u,v,force\n0,0,0,1\n1,0,0,1\n2,0,0,1\n3,1,1,0\n4,2,1,0\n";

/// Samples on the jump at t = 2 count as the nearer limit, from either side.
#[test]
fn samples_on_a_jump() {
    for data in [EXACT, "t,u,v,force\n0,0,-1,0\n1,0,0,1\n2,0,1,0\n3,1,1,0\n4,2,1,0\n"] {
        let folder = folder(data);
        let report = folder.json("compare rod.toml run.csv");
        for quantity in report["quantities"].as_array().unwrap() {
            assert_eq!(quantity["linf"]["absolute"], 0.0, "{quantity}");
            let on_jumps = if quantity["name"] == "u_end" { 0 } else { 2 };
            assert_eq!((&quantity["samples"], &quantity["on_jumps"]), (&5.into(), &on_jumps.into()), "{quantity}");
        }
        assert_eq!(report["hints"], serde_json::json!([]));
    }
}

/// The keys that other projects read.
#[test]
fn the_json() {
    let folder = folder("t,u,force\n0,0,1\n1,0.5,1\n2,0,1\n3,1,0\n4,2,0\n");
    let report = folder.json("compare rod.toml run.csv");
    assert_eq!(report["schema"], 1);
    let u = &report["quantities"][0];
    // One sample of weight 1 is off by ½; ‖u‖₁ = 1 · 1 + ½ · 2, ‖u‖₂² = 1 + ½ · 4.
    assert_eq!((&u["l1"]["absolute"], &u["l1"]["relative"]), (&0.5.into(), &0.25.into()));
    assert_eq!((&u["l2"]["absolute"], u["l2"]["relative"].as_f64()), (&0.5.into(), Some(0.5 / 3f64.sqrt())));
    assert_eq!((&u["linf"]["absolute"], &u["linf"]["t"]), (&0.5.into(), &1.0.into()));
    assert!(u["linf_off_jumps"].is_object());
    let contact = &report["contacts"][0];
    assert_eq!(
        (&contact["ours"]["impact"], &contact["ours"]["release"], &contact["ours"]["impulse"]),
        (&0.0.into(), &2.0.into(), &2.0.into())
    );
    assert_eq!(
        (&contact["theirs"]["impact"], &contact["theirs"]["release"], &contact["theirs"]["peak_force"]),
        (&0.0.into(), &2.5.into(), &1.0.into())
    );
    let audit = report["audit"].as_object().unwrap();
    for key in ["penetration", "tension", "complementarity", "energy_change", "momentum", "missed", "invented"] {
        assert!(audit.contains_key(key), "{key}");
    }
    // |0.5 · 1| over two halves of a step.
    assert_eq!(audit["complementarity"], 0.5);
}

/// One data set in every form that is read.
#[test]
fn every_form_of_data() {
    let forms = [
        ("a.csv", EXACT.to_string(), ""),
        ("b.csv", EXACT.replace(',', ";").replace("t;", "\"t\";"), ""),
        ("c.dat", format!("% made by hand\n# {}", EXACT.replace(',', "   ").replace('\n', "\r\n")), ""),
        (
            "d.dat",
            EXACT.split_once('\n').unwrap().1.replace(',', " ").replace("2 0 0 1", "\n2 0 0 1.0D0"),
            "--map t=0,u=1,v=2,force=3",
        ),
        ("e.txt", "9 0\n9 0\n9 0\n9 1\n9 2\n".into(), "--map u=1 --dt 1"),
        // Line ends of old, a mark of byte order, quotes everywhere, other programs' names and units.
        ("f.csv", EXACT.replace('\n', "\r"), ""),
        ("g.csv", format!("\u{feff}{EXACT}"), ""),
        ("h.csv", EXACT.lines().map(|line| format!("\"{}\"\n", line.replace(',', "\",\""))).collect(), ""),
        ("i.csv", EXACT.replace("t,u,v,force", "Time (s),U [m],V [m/s],Force [per ρS]"), ""),
        // Three digits of exponent leave no room for Fortran's letter.
        ("j.csv", EXACT.replace("3,1,1,0", "0.3D+001,1.0+000,1,0.0-105"), ""),
        (
            "k.csv",
            EXACT
                .replace("t,u,v,force", "t,side,u,v,force")
                .replace(",0,0,1", ",both,0,0,1")
                .replace(",1,1,0", ",both,1,1,0")
                .replace("4,2", "4,both,2"),
            "",
        ),
    ];
    for (name, data, options) in forms {
        let folder = folder("");
        folder.write(name, data);
        let report = folder.json(&format!("compare rod.toml {name} {options}"));
        assert_eq!(report["quantities"][0]["name"], "u_end", "{name}");
        assert_eq!(report["quantities"][0]["linf"]["absolute"], 0.0, "{name}");
    }
}

/// A first line with the numbers of rows and columns, as Siconos writes it, and no names; columns that are not used.
#[test]
fn files_of_other_programs() {
    let rows = EXACT.split_once('\n').unwrap().1.replace(',', " ");
    let folder = folder(&format!("5 4\n{rows}"));
    let table = folder.run("compare rod.toml run.csv").text(0);
    assert!(table.contains("the first line holds the numbers of rows and columns: skipped"), "{table}");
    assert!(table.contains("the columns have no names: taken as t=0,u=1,v=2,force=3"), "{table}");
    let names = "# time displacement velocity Reaction-Force iterations\n";
    let with_more: String = rows.lines().map(|row| format!("{row} 7\n")).collect();
    folder.write("run.csv", format!("{names}{with_more}"));
    let report = folder.json("compare rod.toml run.csv");
    let found: Vec<&Value> = report["quantities"].as_array().unwrap().iter().map(|one| &one["name"]).collect();
    assert_eq!(found, ["u_end", "v_end", "force"]);
    assert_eq!(report["notes"], serde_json::json!(["not used: iterations"]));
}

/// A held top stops at t = 0; a release without a jump of the stress ends contact; and a few samples at random, between
/// which whole contacts pass, are no reason for a hint, nor are data that begin within a contact.
#[test]
fn nothing_is_wrong_with_exact_data() {
    let held = SCENE.replace("wave_speed = 1", "wave_speed = 1\ntop = \"fixed\"").replace("time = 4", "time = 9");
    let soft = "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.1\n[impact]\nspeed = 1.2\n[gravity]\nacceleration = 1\n\
                [run]\ntime = 30\n";
    let folder = folder("");
    for scene in [held.as_str(), soft] {
        folder.write("rod.toml", scene);
        let few = "0.1,0.4,1.9,2.3,2.35,4,5.6,6.1,7.7,7.9,8.2";
        for times in ["", &format!("--times {few}"), "--times 0.5..8:300"] {
            folder.run(&format!("reference rod.toml -o golden.csv {times}")).text(0);
            let report = folder.json("compare rod.toml golden.csv");
            agrees(&report, 1e-12, &format!("{scene} {times}"));
        }
    }
}

/// What `reference` writes is what `compare` holds it against: every column, as CSV and NPZ.
#[test]
fn reference_files_agree() {
    let folder = folder("");
    for name in ["golden.csv", "golden.npz"] {
        let columns = "t,u_end,v_end,strain,stress,force,u_top,v_top,h,h_rate,E_total,E_h,E_z,kinetic,impulse";
        let reference = format!("reference doyen-ern-piperno --columns {columns} --dt 1/128 --to 8 -o {name}");
        folder.run(&format!("{reference} --side right")).text(0);
        let report = folder.json(&format!("compare doyen-ern-piperno {name}"));
        assert_eq!(report["quantities"].as_array().unwrap().len(), 14);
        assert!(!report.to_string().contains("not used"), "{name}: {report}");
        agrees(&report, 1e-12, name);
    }
}

/// A file of `reference` as it is written, with both limits at a jump: no difference beyond a rounding, whether the
/// limits are told by the column of sides or by the order of the rows, in doubles or in fractions, for a field too.
#[test]
fn both_limits_of_a_reference_file() {
    let folder = folder("");
    // Impacts and releases at 0, 2/3, 8/3, 10/3, … , 8: both rows of those that are asked for; 13 of them in the whole
    // run. GetFEM's strain jumps on t = x, then on both diagonals but where they cross, then on t = 1 − x: at 15 of the
    // points.
    // All but the times and the sides.
    let all = dalembert::quantity::Needs::Time.quantities().count() - 2;
    let cases = [
        ("doyen-ern-piperno", "--dt 1/128 --to 8", all, 6),
        ("doyen-ern-piperno", "", all, 26),
        ("doyen-ern-piperno", "--columns t,v_end,force --times 0..4:13", 2, 8),
        ("getfem-dynamic-contact", "--points 0..1:5 --times 0..3:13", 3, 30),
        ("paper-strong", "--times 0,1/3,1,2,3", all, 4),
    ];
    for (scene, asked, count, on_jumps) in cases {
        for (name, numbers) in [("a.csv", ""), ("a.npz", ""), ("a.csv", "--exact")] {
            folder.run(&format!("reference {scene} -o {name} {asked} {numbers}")).text(0);
            let report = folder.json(&format!("compare {scene} {name}"));
            assert_eq!(report["quantities"].as_array().unwrap().len(), count, "{scene} {asked}");
            for quantity in report["quantities"].as_array().unwrap() {
                // Times such as 1/3 are rounded in the file, where ours are asked at them; fractions show what ours has
                // lost, which is far within the 1e-9 that it promises.
                let most = if numbers.is_empty() { 8.0 * f64::EPSILON } else { 1e-12 };
                let off = quantity["linf"]["relative"].as_f64().unwrap_or(0.0);
                assert!(off <= most, "{scene} {name} {numbers} {asked}: {quantity}");
                if matches!(quantity["name"].as_str(), Some("force" | "strain")) {
                    assert_eq!(quantity["on_jumps"], on_jumps, "{scene} {asked}: {quantity}");
                }
            }
            assert_eq!(report["hints"], serde_json::json!([]), "{scene} {asked}");
        }
    }
    folder.run("reference figure-4-r02 --times 0..6:61 -o a.csv").text(0);
    agrees(&folder.json("compare figure-4-r02 a.csv"), 1e-12, "figure-4-r02");
}

/// A limit that is said to be the other one is wrong, although the nearer one would do.
#[test]
fn the_side_that_is_said_counts() {
    let folder = folder("t,side,force\n0,right,1\n1,both,1\n2,right,1\n3,both,0\n4,both,0\n");
    let report = folder.json("compare rod.toml run.csv");
    assert_eq!(report["quantities"][0]["linf"], serde_json::json!({"absolute": 1.0, "relative": 1.0, "t": 2.0}));
    // Two rows, each with half of the weight: ∫F over them is exact.
    folder.write("run.csv", "t,force\n0,0\n0,1\n2,1\n2,0\n4,0\n");
    let report = folder.json("compare rod.toml run.csv");
    let contact = &report["contacts"][0];
    assert_eq!(contact["ours"], contact["theirs"]);
    assert_eq!(report["audit"]["not_covered"], serde_json::json!([]));
}

/// A top that is held, and samples just beside a jump at an irrational time: nothing to find either.
#[test]
fn nothing_to_find() {
    let folder = folder("");
    for (scene, columns) in [("getfem-dynamic-contact", "t,u_end,u_top"), ("mu-3-2-chaotic", "t,v_end,force")] {
        let reference = format!("reference {scene} --columns {columns} --dt 0.01 --to 6 --side right");
        folder.run(&format!("{reference} -o golden.csv")).text(0);
        let report = folder.json(&format!("compare {scene} golden.csv"));
        agrees(&report, 1e-12, scene);
    }
}

/// Many samples are interpolated between asked ones: the same as those asked one by one.
#[test]
fn many_samples() {
    let folder = folder("");
    for scene in ["doyen-ern-piperno", "figure-4-r02"] {
        let reference = format!("reference {scene} --columns t,u_end,v_end,force,E_z --dt 1/16384 --to 2.5");
        folder.run(&format!("{reference} --side right -o many.npz")).text(0);
        let report = folder.json(&format!("compare {scene} many.npz"));
        for quantity in report["quantities"].as_array().unwrap() {
            assert_eq!(quantity["samples"], 40961);
            assert!(quantity["linf"]["relative"].as_f64().unwrap() <= 1e-10, "{scene}: {quantity}");
        }
    }
}

/// A field with its points: behind the wave of the impact v = −x and v_x = −1, before it v = −t.
#[test]
fn a_field() {
    let folder =
        folder("t,x,u,strain\n0.5,0,0,-1\n0.5,0.25,-0.25,-1\n0.5,1,-0.5,0\n1,0,0,-1\n1,0.5,-0.5,-1\n1,1,-1,0\n");
    let report = folder.json("compare rod.toml run.csv");
    for quantity in report["quantities"].as_array().unwrap() {
        assert_eq!(quantity["linf"]["absolute"], 0.0, "{quantity}");
    }
    // At t = 1 the wave is at the top, whose v_x is 0 for ever.
    assert_eq!(report["quantities"][1]["name"], "strain");
    assert_eq!(report["contacts"], serde_json::json!([]));
}

/// Exit code 1 above a bound, 2 for what cannot be compared.
#[test]
fn bounds_for_tests() {
    let folder = folder("t,u\n0,0\n1,0\n2,0\n3,1.1\n4,2\n");
    let above = |bound: &str| folder.run(&format!("compare rod.toml run.csv --fail-above {bound}"));
    assert!(above("u.l2=0.1,u_end.linf=0.5").text(0).contains("u_end"));
    let failed = above("u.linf=0.04");
    failed.text(1);
    assert!(failed.err.contains("expected u.linf ≤ 4e-2, found 5.000e-2"));
    folder.run("compare rod.toml run.csv --fail-above missed=0,invented=0,penetration=0").text(0);
    folder.run("compare rod.toml run.csv --fail-below coverage=1.1").text(1);
    above("energy=0.1").text(2);
    above("order.u=0.1").text(2);
    above("v.l2=0.1").text(2);
    above("u.l3=0.1").text(2);
}

/// A run that breaks off fails whatever is bounded, unless it is said how far it is to go; a file of bounds, and a
/// report for test runners.
#[test]
fn a_run_that_breaks_off() {
    let folder = folder("t,u\n0,0\n1,0\n2,0\n");
    folder.write("gates.toml", "[above]\n\"u.l2\" = 0.1\n[below]\ncoverage = 0.9\n");
    let asked = |more: &str| folder.run(&format!("compare rod.toml run.csv --gates gates.toml --junit out.xml {more}"));
    assert!(asked("").text(1).contains("covers 50 % of the run to t = 4, 1 of 1 contacts: THE RUN BREAKS OFF"));
    let xml = folder.read("out.xml");
    assert!(xml.contains("tests=\"3\" failures=\"2\"") && xml.contains("name=\"data up to t = 4\""), "{xml}");
    assert!(asked("--to 2").text(0).contains("covers 100 % of the run to t = 2, 1 of 1 contacts\n"));
    folder.write("gates.toml", "[above]\n\"u.l7\" = 0.1\n");
    assert!(asked("").err.contains("gates.toml: found `u.l7=0.1`, expected"));
}

/// u + h² at steps h: second order in every norm.
#[test]
fn several_files_show_the_order() {
    let folder = folder("");
    for (name, count) in [("a.csv", 40), ("b.csv", 80), ("c.csv", 160)] {
        let h = 4.0 / f64::from(count);
        let row = |k: i32| format!("{},{}\n", f64::from(k) * h, (f64::from(k) * h - 2.0).max(0.0) + h * h);
        folder.write(name, format!("t,u\n{}", (0..=count).map(row).collect::<String>()));
    }
    let report = folder.json("compare rod.toml a.csv b.csv c.csv");
    assert_eq!(report["files"].as_array().unwrap().len(), 3);
    let orders = report["orders"].as_array().unwrap();
    assert_eq!(orders.len(), 2);
    for order in orders {
        for norm in ["l1", "l2", "linf"] {
            assert!((order[norm].as_f64().unwrap() - 2.0).abs() < 1e-9, "{order}");
        }
    }
    let below = |bound: &str| folder.run(&format!("compare rod.toml a.csv b.csv c.csv --fail-below {bound}"));
    below("order.u=1.9").text(0);
    below("order.u.linf=2.1").text(1);
    // Of files that end at other times there is none.
    folder.write("d.csv", "t,u\n0,0\n0.5,0\n1,0\n1.5,0\n2,0\n");
    let table = folder.run("compare rod.toml a.csv d.csv").text(0);
    assert!(table.contains("no order of u_end from 0.1 to 0.5: the files do not cover the same times"), "{table}");
    // Widths of twice the ratio halve the order.
    let report = folder.json("compare rod.toml a.csv b.csv --widths 0.4,0.1");
    assert!((report["orders"][0]["l2"].as_f64().unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn residuals_and_pictures() {
    let folder = folder(EXACT);
    let csv = folder.run("compare rod.toml run.csv --format csv").text(0);
    assert!(csv.starts_with("t,u_end_ours,u_end_theirs,u_end_difference,v_end_ours,"));
    assert_eq!(csv.lines().count(), 6);
    let table = folder.run("compare rod.toml run.csv -o a.svg -o a.png").text(0);
    assert!(table.contains("no hint"));
    let svg = folder.read("a.svg");
    assert!(svg.contains("theirs − ours") && svg.contains("run.csv"));
    // Of two curves the later one lies above: ours, thinner than theirs.
    let strokes = svg.split("<g class=\"curve\"").skip(1).filter_map(|curve| curve.split("stroke-width=\"").nth(1));
    let widths: Vec<f64> = strokes.map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect();
    assert!(widths[1] < 0.5 * widths[0], "{widths:?}");
    assert!(fs::read(folder.path("a.png")).unwrap().starts_with(b"\x89PNG"));
}

/// A force at every second step of the contact, of the height `peak`, whose impulse is that height; `u` times `size`.
fn chattering(peak: f64, size: f64) -> String {
    let row = |k: u32| {
        let t = f64::from(k) / 8.0;
        let force = if k % 2 == 1 && t < 2.0 { peak } else { 0.0 };
        format!("{t},{},{force}\n", size * (t - 2.0).max(0.0))
    };
    format!("t,u,force\n{}", (0..=32).map(row).collect::<String>())
}

/// What is said of chatter, of a factor behind it and of an empty column.
#[test]
fn words_of_hints() {
    let said = |data: &str| {
        let folder = folder(data);
        let table = folder.run("compare rod.toml run.csv").text(0);
        table.lines().filter(|line| line.contains("hint")).map(String::from).collect::<Vec<_>>()
    };
    let none = "no hint: no single wrong number that was tried explains what differs";
    assert_eq!(said(EXACT), [none]);
    assert_eq!(said(&chattering(2.0, 1.0)), [format!("{none}; the contact chatters: 7 gaps closed in 1 contact")]);
    let [factor] = said(&chattering(4.0, 1.0)).try_into().unwrap();
    assert!(factor.starts_with("hint: force × 2 ±") && factor.ends_with("which unit?"), "{factor}");
    assert_eq!(said(&chattering(2.0, 0.0)), ["hint: u_end is zero throughout: an empty column?"]);
}

/// Where the force of a contact falls as much as ours rises, from 2 to 1 and from 1 to 2, the impulses are the same; a
/// fit would find 13/14 of the factor: ∫(1 + t/2)(2 − t/2) = 13/3 against ∫(1 + t/2)² = 14/3.
#[test]
fn a_factor_that_chatter_falsifies() {
    let row = |k: u32| {
        let t = f64::from(k) / 64.0;
        let force = if k % 2 == 1 && t < 2.0 { 2e-3 * (2.0 - t / 2.0) } else { 0.0 };
        format!("{t},{force}\n")
    };
    let folder = folder(&format!("t,force\n{}", (0..=192).map(row).collect::<String>()));
    folder.write("rod.toml", SCENE.replace("[run]", "[gravity]\nacceleration = 0.5\n[run]"));
    let report = folder.json("compare rod.toml run.csv");
    let hints = report["hints"].as_array().unwrap();
    let factor = hints.iter().find(|hint| hint["kind"] == "force_factor").unwrap();
    let [value, error] = ["value", "error"].map(|key| factor[key].as_f64().unwrap());
    assert!((value / 1e-3 - 1.0).abs() < 1.0 / 14.0 && (value - 1e-3).abs() < error && error < 2e-4, "{hints:?}");
}

/// Of several files all are written, or none.
#[test]
fn all_files_or_none() {
    let folder = folder(EXACT);
    fs::create_dir(folder.path("folder.csv")).unwrap();
    for bad in ["nowhere/b.csv", "folder.csv"] {
        folder.run(&format!("compare rod.toml run.csv -o a.json -o {bad}")).text(2);
        assert!(!folder.has("a.json"));
    }
    assert_eq!(folder.count(), 3);
    folder.run("compare rod.toml run.csv -o a.json -o b.csv").text(0);
    assert!(folder.has("a.json") && folder.has("b.csv"));
}

/// Squares of data beyond the range of doubles are none of the report's concern.
#[test]
fn norms_of_huge_data() {
    let report = folder("t,u\n0,0\n2,0\n3,1e300\n4,2\n").json("compare rod.toml run.csv");
    let quantity = &report["quantities"][0];
    // Weights 1, 3/2, 1, 1/2; ours 0, 0, 1, 2.
    assert_eq!((&quantity["l1"]["absolute"], &quantity["l2"]["absolute"]), (&1e300.into(), &1e300.into()));
    assert!((quantity["l2"]["relative"].as_f64().unwrap() / (1e300 / 3f64.sqrt()) - 1.0).abs() < 1e-14);
}

/// Times of another unit are told from those of a long run before it is solved.
#[test]
fn times_in_another_unit() {
    for (scale, unit) in [("e3", "milliseconds"), ("e6", "microseconds")] {
        let folder =
            folder(&EXACT.replace("3,1,1,0", &format!("3{scale},1,1,0")).replace("4,2,", &format!("4{scale},2,")));
        let doubt = format!("own run, which ends at t = 4: are they in {unit}?");
        refused(&folder, "compare rod.toml run.csv", &["run.csv: found times up to 4000", &doubt]);
        // A run of impacts ends at one of them.
        folder.write("rod.toml", SCENE.replace("time = 4", "impacts = 1"));
        folder.run("compare rod.toml run.csv").text(2);
        folder.write("rod.toml", SCENE.replace("time = 4", &format!("time = 4{scale}")));
        folder.run("compare rod.toml run.csv").text(0);
    }
}

/// One line each: the file, the place, what was found and what was expected.
#[test]
fn what_is_refused() {
    let cases = [
        ("", "run.csv: found no row of numbers"),
        ("t,u\n", "run.csv: found no row of numbers"),
        ("t,u\n0,0\n1\n", "run.csv, line 3: found 1 columns, expected 2 as in the first row"),
        ("t,u\n0,0\n\n1,x\n", "run.csv, line 4, column 2: found `x`, expected a number"),
        ("t,u\n0,0\n1,\n", "run.csv, line 3: found 1 columns"),
        ("0,,0\n1,0,0\n", "run.csv: found no names of columns"),
        ("t,u,v\n0,,0\n1,0,0\n", "run.csv, line 2, column 2: found ``, expected a number"),
        ("t;u\n0;0\n1,5;0\n", "run.csv, line 3, column 1: found `1,5`, expected a number with a point"),
        ("t\tu\n0,0\t0,0\n1,0\t0,5\n", "run.csv, line 2, column 1: found `0,0`, expected a number with a point"),
        ("t u\n0 0\n1 0\0\n", "run.csv, line 3: found text that is not UTF-8"),
        ("t,u\n0,0\n1,1e400\n", "run.csv, line 3, column 2: found inf"),
        ("t,u\n1,0\n", "run.csv: found one time from 0 on, 1, expected at least two"),
        ("t,u\n-1,0\n1,0\n1,0\n", "run.csv: found one time from 0 on"),
        ("t s  u m\n0 0\n1 0\n", "run.csv: found 4 names above rows of 2 columns"),
        ("t,force [N]\n0,1\n1,1\n", "run.csv: found the column `force [N]`, expected it per ρS"),
        ("t,strain [mm]\n0,1\n1,1\n", "run.csv: found the column `strain [mm]`, expected it without a unit"),
        ("t,T,u\n0,0,0\n1,1,0\n", "run.csv: found `T` twice, expected each quantity once"),
        ("zeit,u\n0,0\n1,0\n", "run.csv: found no column of times in zeit, u, expected one called t"),
        ("t,x,force\n0,0,0\n1,0,0\n", "found no quantity in the columns t, x, force, expected some of u, v, strain"),
        ("t,u\n0,0\n1,NaN\n", "run.csv, line 3, column 2: found NaN, expected a finite number"),
        ("# by hand\nt,u\n0,0\n1,0\n1,0\n1,0\n", "run.csv, line 6, column 1: found time 1 after 1"),
        ("t,side,u\n0,both,0\n1,right,0\n1,left,0\n", "run.csv, line 4, column 1: found time 1 after 1"),
        ("t,side,u\n0,both,0\n1,up,0\n", "run.csv, line 3, column 2: found `up`, expected left, right or both"),
        ("t,u\n-2,0\n-1,0\n", "run.csv: found times up to -1, expected some after 0"),
        (
            "0,0\n1,0\n",
            "run.csv: found no names of columns, expected a map such as t=0,u=1,v=2,force=3 with their \
             numbers, counted from 0",
        ),
        ("t,w\n0,0\n1,0\n", "run.csv: found no quantity in the columns t, w"),
        ("t,x,u\n0,0,0\n0,2,0\n", "run.csv, line 3, column 2: found point 2, expected one between 0 and 1"),
        ("t,x,u\n0,0.5,0\n0,0.5,0\n", "run.csv, line 3, column 2: found point 0.5 after 0.5"),
    ];
    for (data, said) in cases {
        let folder = folder(data);
        refused(&folder, "compare rod.toml run.csv -o out.json", &[said]);
        assert!(!folder.has("out.json"));
    }
}

/// Arrays of NumPy: each kind of number is read, and what is no table of numbers is said at once, never a panic.
#[test]
fn every_kind_of_array() {
    use ndarray::{Array0, Array2, Array3, ShapeBuilder};
    use ndarray_npy::{WritableElement, WriteNpyExt};

    let folder = folder("");
    let table = EXACT.lines().skip(1).flat_map(|line| line.split(',').map(|x| x.parse::<f64>().unwrap()));
    let table = Array2::from_shape_vec((5, 4), table.collect()).unwrap();
    let path = folder.path("a.npy");
    let args = "compare rod.toml a.npy --map t=0,u=1,v=2,force=3";
    let exact = || {
        let report = folder.json(args);
        assert!(report["quantities"].as_array().unwrap().iter().all(|found| found["linf"]["absolute"] == 0.0));
    };
    fn write<T: WritableElement>(path: &str, array: &Array2<T>) {
        array.write_npy(fs::File::create(path).unwrap()).unwrap();
    }
    macro_rules! of {
        ($($kind:ty),*) => {$( write(&path, &table.mapv(|x| x as $kind)); exact(); )*};
    }
    of!(f64, f32, i64, i32, i16, i8, u64, u32, u16, u8);
    let mut columns_first = Array2::zeros((5, 4).f());
    columns_first.assign(&table);
    write(&path, &columns_first);
    exact();
    let refused = |said: &str| refused(&folder, args, &[said]);
    Array0::from_elem((), 1.0).write_npy(fs::File::create(&path).unwrap()).unwrap();
    refused("a.npy: found an array of shape [], expected one column");
    Array3::<f64>::zeros((1, 5, 4)).write_npy(fs::File::create(&path).unwrap()).unwrap();
    refused("a.npy: found an array of shape [1, 5, 4]");
    write(&path, &Array2::<f64>::zeros((5, 0)));
    refused("a.npy: found an array of shape [5, 0]");
    write(&path, &Array2::<f64>::zeros((0, 4)));
    refused("a.npy: found no row of numbers");
    write(&path, &table);
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() - 8]).unwrap();
    refused("a.npy: cannot be read");
}
