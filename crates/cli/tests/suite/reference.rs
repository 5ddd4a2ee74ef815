//! Golden files: the exact solution against GetFEM's own, as rows and as functions that are run, and bad input.

use std::fs::File;
use std::process::Command;
use std::slice::from_ref;

use dalembert::quantity::Slice;
use dalembert::{Number, Problem, Rational, Run, Scene, Side};
use ndarray::Array1;
use ndarray_npy::NpzReader;
use serde_json::Value;

use crate::command::{Folder, csv, json, quiet, refused, refused_with, run_with};
use crate::command_samples::column;
use crate::cuts::cuts;

pub(crate) fn scene(name: &str) -> Problem {
    Scene::parse(dalembert::builtin::get(name).unwrap().source).unwrap().problem
}

fn fraction(p: i64, q: i64) -> Rational {
    Rational::from((p, q))
}

/// What GetFEM's one-dimensional contact demonstration holds for exact: a table of the period of 3, in phases of 1 that
/// the rays from both ends cut into four zones; `[u, u_x, u_t]` as (constant, factor of x, factor of t in the phase).
fn getfem(x: &Rational, t: &Rational) -> [Rational; 3] {
    let whole = t.clone().floor();
    let tau = t.clone() - &whole;
    let phase = whole.to_f64() as u32 % 3;
    let zone = match (tau < *x, tau <= Rational::from(1) - x) {
        (true, true) => 1,
        (false, true) => 2,
        (true, false) => 3,
        (false, false) => 4,
    };
    let (constant, of_x, of_t) = match (phase, zone) {
        (0, 1 | 3) | (2, 3 | 4) => (1, -1, 0),
        (0, _) => (1, 0, -1),
        (1, 1) => (0, 0, -1),
        (1, 2) => (0, -1, 0),
        (1, 3) => (-1, 1, 0),
        (1, _) => (-1, 0, 1),
        _ => (0, 0, 1),
    };
    let half = |n: i64| fraction(n, 2);
    [half(constant) + half(of_x) * x + half(of_t) * tau, half(of_x), half(of_t)]
}

#[test]
fn getfem_has_the_same_solution() {
    let history = scene("getfem-dynamic-contact").exact().unwrap();
    let waves = history.waves().unwrap();
    // 50 points by 100 times over three periods; x ± t is no integer, so that none is on a ray.
    let points: Vec<Rational> = (0..50).map(|i| fraction(2 * i + 1, 100)).collect();
    let times: Vec<Rational> = (0..100).map(|j| fraction(9 * (3 * j + 1), 301)).collect();
    let field = history.field(&points, &times, Side::Right).unwrap();
    assert_eq!(field.len(), 5000);
    let mut pairs = times.iter().flat_map(|t| points.iter().map(move |x| (x, t)));
    for value in field {
        let (x, t) = pairs.next().unwrap();
        assert_eq!([&value.displacement, &value.strain, &value.velocity], getfem(x, t).each_ref(), "{x} {t}");
        assert_eq!(waves.at(x, t), value);
    }
}

#[test]
fn two_waves_are_the_field() {
    let profile = "[rod]\nlength = 2\nwave_speed = 3\ntop = \"fixed\"\n[gravity]\nacceleration = 1\n[run]\ntime = 7\n\
                   [start]\ndisplacement = [[0, 0.5], [1, 0], [2, 0.25]]\n\
                   velocity = [[0, 1], [1, 1], [1, -1], [2, 0]]\n";
    let profile = Scene::parse(profile).unwrap().problem;
    let rods = ["doyen-ern-piperno", "paper-strong", "mu-4-3", "figure-2"].map(scene).into_iter().chain([profile]);
    for rod in rods {
        let history = rod.exact().unwrap();
        let waves = history.waves().unwrap();
        let length = rod.length().to_rational();
        for k in 0..60 {
            let t = history.end().clone() * fraction(k, 60);
            for j in 0..=7 {
                let x = length.clone() * fraction(j, 7);
                let field = history.field(from_ref(&x), from_ref(&t), Side::Right).unwrap().remove(0);
                // v is continuous; the others are the limit from later times, at the ends too.
                assert_eq!(waves.at(&x, &t), field, "{x} {t}");
            }
        }
    }
}

/// Means of `v_x` are differences of `v`; and the projection leaves what is orthogonal to every hat function: its
/// values times the mass matrix are the integrals of the field, for which the rule with the weights 2/3, −1/3, 2/3 at
/// the quarters of each interval between rays and points is exact.
#[test]
fn means_and_projections_are_integrals() {
    for (name, t) in
        [("doyen-ern-piperno", (1, 7)), ("doyen-ern-piperno", (29, 9)), ("getfem-dynamic-contact", (11, 8))]
    {
        let rod = scene(name);
        let history = rod.exact().unwrap();
        let t = fraction(t.0, t.1);
        let length = rod.length().to_rational();
        // Not the whole rod, and not equally spaced.
        let grid: Vec<Rational> = [1, 2, 4, 7, 9].map(|k| length.clone() * fraction(k, 10)).into();
        let field = history.field(&grid, from_ref(&t), Side::Right).unwrap();
        let at = |slice| history.ask_slices(slice, None, |_| Ok((grid.clone(), vec![t.clone()]))).unwrap();
        let means = at(Slice::Averages);
        for (k, mean) in means[5].iter().enumerate() {
            let rise = field[k + 1].displacement.clone() - &field[k].displacement;
            assert_eq!(*mean, rise / (grid[k + 1].clone() - &grid[k]), "{name}");
        }
        let nodal = at(Slice::P1);
        let mut cuts = cuts(&rod, &history, &t);
        cuts.extend(grid.iter().cloned());
        cuts.sort();
        let mut loads = vec![[(); 3].map(|()| Rational::new()); grid.len()];
        let mut areas = vec![[(); 3].map(|()| Rational::new()); grid.len() - 1];
        for pair in cuts.windows(2) {
            let width = pair[1].clone() - &pair[0];
            let Some(cell) = (0..grid.len() - 1).find(|k| grid[*k] <= pair[0] && pair[1] <= grid[k + 1]) else {
                continue;
            };
            for (quarter, weight) in [(1, fraction(2, 3)), (2, fraction(-1, 3)), (3, fraction(2, 3))] {
                let x = width.clone() * fraction(quarter, 4) + &pair[0];
                let upper: Rational = (x.clone() - &grid[cell]) / (grid[cell + 1].clone() - &grid[cell]);
                let value = history.field(&[x], from_ref(&t), Side::Right).unwrap().remove(0);
                for (j, f) in [value.displacement, value.velocity, value.strain].into_iter().enumerate() {
                    let part = f * &weight * &width;
                    areas[cell][j] += &part;
                    loads[cell + 1][j] += part.clone() * &upper;
                    loads[cell][j] += part.clone() - part * &upper;
                }
            }
        }
        for j in 0..3 {
            for (k, area) in areas.iter().enumerate() {
                let width = grid[k + 1].clone() - &grid[k];
                assert_eq!(means[3 + j][k].clone() * width, area[j], "{name} {j}");
            }
            for (k, load) in loads.iter().enumerate() {
                let mut sum = Rational::new();
                for (a, b) in [(k.wrapping_sub(1), k), (k, k + 1)] {
                    if let (Some(low), Some(high)) = (grid.get(a), grid.get(b)) {
                        let other = if a == k { b } else { a };
                        let third: Rational = (high.clone() - low) / 3;
                        sum += nodal[3 + j][k].clone() * &third + nodal[3 + j][other].clone() * third / 2;
                    }
                }
                assert_eq!(sum, load[j], "{name} {j} {k}");
            }
        }
    }
}

/// Points and times of the rod at which a function is asked, away from rays by much more than rounding.
const ASKED: usize = 400;

fn asked(rod: &Problem, end: f64) -> Vec<(f64, f64)> {
    let length = rod.length().to_f64();
    // Multiples of the golden section are as far from each other as can be.
    (0..ASKED)
        .map(|k| (length * (k as f64 * 0.618_033_988_749_895).fract(), end * (k as f64 + 0.37) / ASKED as f64))
        .collect()
}

/// Runs a program that prints `uExact` for d = 0, 1, 2 at every pair of its input, and holds it against the history.
fn held_against_the_history(name: &str, mut program: Command) {
    let rod = scene(name);
    let history = rod.exact().unwrap();
    let pairs = asked(&rod, history.end().to_f64());
    let output = program.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().map(|line| line.split_whitespace().map(|value| value.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), pairs.len());
    let scales = rod.doubles().unwrap().scales();
    for (row, (x, t)) in rows.iter().zip(pairs) {
        let exact = |x: f64| Rational::from_f64(x).unwrap();
        let field = history.field(&[exact(x)], &[exact(t)], Side::Right).unwrap().remove(0);
        let sizes = [scales.velocity * scales.time, scales.velocity / scales.wave_speed, scales.velocity];
        for ((found, value), size) in row.iter().zip([field.displacement, field.strain, field.velocity]).zip(sizes) {
            // A handful of roundings of numbers of this size, and of times of up to 20 trips.
            assert!((found - value.to_f64()).abs() < 1e-13 * size, "{name} {x} {t}: {found} {value}");
        }
    }
}

fn there_is(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}

#[test]
fn the_python_function_is_the_history() {
    if !there_is("python3") {
        return;
    }
    for name in ["doyen-ern-piperno", "getfem-dynamic-contact", "paper-strong"] {
        let folder = Folder::new();
        quiet(&format!("reference {name} --as python -o {}", folder.path("golden.py")));
        let rod = scene(name);
        let end = rod.exact().unwrap().end().to_f64();
        let main = format!(
            "from golden import uExact\nfor x, t in {:?}:\n    print(*(repr(uExact(x, t, d)) for d in range(3)))\n",
            asked(&rod, end)
        );
        let mut program = Command::new("python3");
        program.arg("-c").arg(main).current_dir(folder.path(""));
        held_against_the_history(name, program);
        // The same values at arrays of points by times, with a last one that a few steps make.
        let main = format!(
            "from math import nextafter\nfrom golden import uExact\nend = {end:?}\nlate = nextafter(end, 2 * end)\n\
             assert abs(uExact(0, late) - uExact(0, end)) < 1e-12 * (1 + abs(uExact(0, end)))\n\
             try:\n    uExact(0, end * (1 + 1e-13))\n    raise SystemExit('not refused')\n\
             except ValueError:\n    pass\n\
             try:\n    import numpy\nexcept ImportError:\n    raise SystemExit\n\
             x, t = numpy.linspace(0, 1, 5), numpy.linspace(0, late, 7)\n\
             for d in range(3):\n    u = uExact(x[:, None], t, d)\n    \
             assert u.shape == (5, 7) and u.dtype == float\n    \
             assert all(u[i, j] == uExact(x[i], t[j], d) for i in range(5) for j in range(7))\n"
        );
        let output = Command::new("python3").arg("-c").arg(main).current_dir(folder.path("")).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// With --exact the function is one in fractions: here GetFEM's own values, without any difference.
#[test]
fn the_python_function_is_exact() {
    if !there_is("python3") {
        return;
    }
    let module = quiet("reference getfem-dynamic-contact --as python --exact");
    let main = "\nfor k in range(200):\n    x, t = F(2 * k + 1, 400), F(9 * (3 * k + 1), 601)\n    \
                print(*(uExact(x, t, d) for d in range(3)))\n\
                try:\n    uExact(2, 0)\nexcept ValueError as error:\n    print(error)\n";
    let output = Command::new("python3").arg("-c").arg(module + main).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines = text.lines();
    for k in 0..200 {
        let expected =
            getfem(&fraction(2 * k + 1, 400), &fraction(9 * (3 * k + 1), 601)).map(|value| value.to_string());
        assert_eq!(lines.next(), Some(expected.join(" ").as_str()));
    }
    assert_eq!(lines.next(), Some("found x = 2, t = 0, expected 0 <= x <= 1 and 0 <= t <= 9"));
}

#[test]
fn the_c_function_is_the_history() {
    if !there_is("cc") {
        return;
    }
    for name in ["doyen-ern-piperno", "getfem-dynamic-contact"] {
        let folder = Folder::new();
        quiet(&format!("reference {name} --as c -o {}", folder.path("golden.h")));
        let rod = scene(name);
        let end = rod.exact().unwrap().end().to_f64();
        let pairs = asked(&rod, end);
        let list: String = pairs.iter().map(|(x, t)| format!("{{{x:?}, {t:?}}},")).collect();
        let main = format!(
            "#include <stdio.h>\n#include \"golden.h\"\nstatic const double at[][2] = {{{list}}};\nint main(void) {{\n\
             for (int k = 0; k < {}; k++) printf(\"%.17g %.17g %.17g\\n\", uExact(at[k][0], at[k][1], 0), \
             uExact(at[k][0], at[k][1], 1), uExact(at[k][0], at[k][1], 2));\n\
             const double end = {end:?}, late = nextafter(end, 2 * end);\n\
             return !isnan(uExact(0, -1, 0)) || isnan(uExact(0, late, 0))\n\
             || !isnan(uExact(0, end * (1 + 1e-13), 0)); }}\n",
            pairs.len()
        );
        folder.write("main.c", main);
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-o"]);
        let built = compiler.args([folder.path("main"), folder.path("main.c"), "-lm".into()]).output().unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        held_against_the_history(name, Command::new(folder.path("main")));
    }
}

#[test]
fn rows_are_the_same_in_every_format() {
    let folder = Folder::new();
    let asked = "reference doyen-ern-piperno --times 0..16/3:33";
    let mut written = Vec::new();
    for file in ["a.csv", "b.csv", "a.json", "a.npz", "b.npz"] {
        quiet(&format!("{asked} -o {}", folder.path(file)));
        written.push(std::fs::read(folder.path(file)).unwrap());
    }
    assert!(written[0] == written[1] && written[3] == written[4], "the bytes differ from run to run");
    let json: Value = serde_json::from_slice(&written[2]).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let mut lines = csv(str::from_utf8(&written[0]).unwrap());
    let names = lines.remove(0);
    // 33 times, and a second limit at the four events among them and at each return of a ray.
    assert!(lines.len() >= 37 && lines.len() == rows.len());
    let exact = csv(&quiet(&format!("{asked} --exact"))).split_off(1);
    assert_eq!(exact.len(), lines.len());
    let mut npz = NpzReader::new(File::open(folder.path("a.npz")).unwrap()).unwrap();
    let header: Array1<u8> = npz.by_name("header").unwrap();
    let header: Value = serde_json::from_slice(header.as_slice().unwrap()).unwrap();
    assert_eq!(header["columns"], json["columns"]);
    assert_eq!((json["kind"].as_str(), json["proved"].as_bool()), (Some("reference"), Some(false)));
    for (j, name) in names.iter().enumerate() {
        assert_eq!(json["columns"][j]["name"], *name);
        if name == "side" {
            let sides: Array1<i8> = npz.by_name(name).unwrap();
            for (k, line) in lines.iter().enumerate() {
                assert_eq!(line[j], ["left", "both", "right"][(sides[k] + 1) as usize]);
                assert_eq!(rows[k][j], line[j]);
            }
            continue;
        }
        let values: Vec<f64> = match name.as_str() {
            "contact" => npz.by_name::<_, ndarray::Ix1>(name).map(|a: Array1<i8>| a.mapv(f64::from).to_vec()).unwrap(),
            _ => npz.by_name::<_, ndarray::Ix1>(name).map(|a: Array1<f64>| a.to_vec()).unwrap(),
        };
        for (k, line) in lines.iter().enumerate() {
            assert_eq!(line[j].parse::<f64>().unwrap(), values[k], "{name}");
            assert_eq!(rows[k][j].as_f64().unwrap(), values[k], "{name}");
        }
        // The bound of the column holds against fractions.
        if let Some(bound) = json["columns"][j]["bound"].as_f64() {
            for (exact, value) in exact.iter().zip(&values) {
                let exact: Number = exact[j].parse().unwrap();
                // And a rounding for the double nearest to the fraction.
                assert!(
                    (exact.to_f64() - value).abs() <= bound + 2e-16 * value.abs(),
                    "{name}: {exact} {value} {bound}"
                );
            }
        }
    }
}

/// By hand: drop from 5 at g = 10, c = 30: forces in newtons, contacts of 2/3, energy 500 J.
#[test]
fn without_times_the_rows_are_the_events() {
    let asked = "reference doyen-ern-piperno --exact --columns t,side,v_end,force,E_total,contact,impulse";
    let text = quiet(asked);
    let rows: Vec<&str> = text.lines().skip_while(|line| line.starts_with('#')).collect();
    assert_eq!(
        rows[..7],
        [
            "t,side,v_end,force,E_total,contact,impulse",
            "0,left,-10,0,500,0,0",
            "0,right,0,300,500,1,0",
            "2/3,left,0,500,500,1,800/3",
            "2/3,right,10/3,0,500,0,800/3",
            "8/3,left,-10/3,0,500,0,800/3",
            "8/3,right,0,500,500,1,800/3",
        ]
    );
    // The impact that ends the run begins a contact.
    assert_eq!(*rows.last().unwrap(), "16,right,0,300,500,1,1600");
    assert!(
        text.contains("# numbers: exact: fractions without any error\n") && text.contains("# scene: length = 10\n")
    );
    assert_eq!(csv(&quiet(&format!("{asked} --side right"))).len(), 14);
}

/// Steps of a decimal are the doubles that a program writes for them.
#[test]
fn steps_are_decimals() {
    let text = quiet("reference doyen-ern-piperno --columns t --dt 0.1 --to 0.7 --side right");
    let times = csv(&text).split_off(1).concat();
    assert_eq!(times, ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"]);
}

#[test]
fn times_come_from_files() {
    // 120,001 times, as a code that writes every step has them.
    let times: String = (0..=120_000).map(|k| format!("{}\n", f64::from(k) * 4e-5)).collect();
    let found = run_with("reference doyen-ern-piperno --times-from - --columns t,u_end --side right", &times);
    let rows = csv(&found.out).split_off(1);
    assert_eq!((found.code, rows.len()), (Some(0), 120_001), "{}", found.err);
    // In the first flight v(0,t) = (10/3)(t − 2/3) + … until the wave is back at 4/3.
    let value: Vec<f64> = rows[25_000].iter().map(|value| value.parse().unwrap()).collect();
    let tau: f64 = 1.0 - 2.0 / 3.0;
    assert!(
        (value[0] - 1.0).abs() < 1e-12 && (value[1] - (10.0 / 3.0 * tau + 5.0 * tau * tau)).abs() < 1e-11,
        "{value:?}"
    );

    // Comments, empty lines, any order, fractions.
    let found = run_with(
        "reference getfem-dynamic-contact --times-from - --columns t,u_end --exact",
        "\u{feff}# times\n1/2 # half\n\n0.25\r\n",
    );
    assert_eq!(csv(&found.out), [["t", "u_end"], ["1/2", "1/4"], ["1/4", "3/8"]]);

    let bad = |input: &str, said: &[&str]| {
        refused_with("reference doyen-ern-piperno --times-from -", input, said);
    };
    bad("0\n1 2\n", &["standard input, row 2: found 2 values, expected one time a line"]);
    bad("0\n1,\n3,4", &["row 2: found `1,`"]);
    bad("0\n\nNaN\n", &["standard input, row 3: found `NaN`, expected a number"]);
    bad("0\n-1\n", &["row 2: found time -1, expected times from 0 on"]);
    bad("# nothing\n", &["standard input: found no times, expected one a line"]);
    bad(&"9".repeat(4000), &["row 1: found `9999999999999999999999999999999999999999…`"]);
    refused("reference doyen-ern-piperno --times-from no/such/file", &["cannot read no/such/file"]);
}

/// A CSV without comments and without bounds has no digit beyond its bound: each number is within one unit of its last
/// digit.
#[test]
fn digits_of_a_bare_csv_are_right() {
    let asked = "reference figure-4-r02 --times 0..9:37 --columns u_end,strain,h,E_total";
    let bare = quiet(&format!("{asked} --bare --side right"));
    let truth = quiet(&format!("{asked} --bare --side right --digits 30"));
    let (mut compared, mut shorter) = (0, 0);
    for (found, truth) in
        bare.lines().skip(1).flat_map(|row| row.split(',')).zip(truth.lines().skip(1).flat_map(|row| row.split(',')))
    {
        let (Ok(value), Ok(truth)) = (found.parse::<f64>(), truth.parse::<f64>()) else { continue };
        let (mantissa, exponent) = found.split_once('e').unwrap_or((found, "0"));
        let places = mantissa.split_once('.').map_or(0, |(_, places)| places.len() as i32);
        let unit = 10f64.powi(exponent.parse::<i32>().unwrap() - places);
        assert!((value - truth).abs() <= unit.max(4e-16 * truth.abs()), "{found} {truth}");
        compared += 1;
        shorter += usize::from(places < 15);
    }
    assert!(compared > 100 && shorter > 50, "{compared} {shorter}\n{bare}");
    // Times and places tell rows apart: they are the same doubles as with a header.
    let beside = "reference figure-4-r02 --times 0.1,1.9999999999999998,2 --points 0.3,0.30000000000000004";
    let keys = |args: &str| -> Vec<String> {
        let rows = csv(&quiet(&format!("{beside} {args}")));
        rows[1..].iter().map(|row| row[..3].join(",")).collect()
    };
    let found = keys("--bare");
    assert_eq!(found, keys(""));
    assert!(found.iter().any(|row| row.starts_with("1.9999999999999998,")), "{found:?}");
    assert!(found.iter().any(|row| row.ends_with(",0.30000000000000004")), "{found:?}");
    // With their bounds beside them, all digits of the doubles are there.
    let bounded = quiet(&format!("{asked} --bare --side right --uncertainty"));
    assert!(bounded.len() > bare.len() + 1000, "{bounded}");
}

/// Without its comments a CSV has the same rows, but for digits beyond their bounds; the header says how far it goes,
/// whatever the scene says.
#[test]
fn the_comments_of_a_csv() {
    let asked = "reference doyen-ern-piperno --times 0,100 --columns t,side,u_end";
    let (whole, bare) = (quiet(asked), quiet(&format!("{asked} --bare")));
    assert!(bare.starts_with("t,side,u_end\n0.0,left,"), "{bare}");
    assert!(whole.starts_with('#') && csv(&whole).len() == csv(&bare).len() && !bare.contains('#'));
    assert!(whole.contains("# until: the history is followed to t = 100\n"), "{whole}");
    refused(&format!("{asked} --bare --format json"), &["found --bare, expected it with CSV only"]);
    let numpy = Command::new("python3").args(["-c", "import numpy"]).output();
    if numpy.is_ok_and(|output| output.status.success()) {
        let folder = Folder::new();
        folder.write("golden.csv", &whole);
        // As the file itself says.
        let read = whole.lines().find_map(|line| line.strip_prefix("# read: ")).unwrap();
        let read = read.split_once("or ").unwrap().1.replace("FILE", "'golden.csv'");
        let main = format!("import numpy\ndata = {read}\nprint(*data.dtype.names, *data['t'], *data['side'])\n");
        let output = Command::new("python3").arg("-c").arg(main).current_dir(folder.path("")).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(String::from_utf8(output.stdout).unwrap(), "t side u_end 0.0 0.0 100.0 left right both\n");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let asked = |more: &str, said: &[&str]| refused(&format!("reference doyen-ern-piperno {more}"), said);
    asked("--columns t,x", &["found the quantity x without points"]);
    asked("--columns t,w", &["found the quantity w, expected one of end, top, centre, energy, t, side, u_end"]);
    asked("--columns t,u_end,t --times 1", &["found --quantity t twice, expected each once"]);
    asked("--dt 0.1", &["--to <T>"]);
    asked("--dt 0 --to 1", &["expected a step above 0"]);
    asked("--dt 1e-9 --to 5", &["found 5000000000 steps"]);
    asked("--dt 0.1 --to 1 --times 1", &["cannot be used with"]);
    asked("-o golden.xls", &["golden.xls, expected a file that ends in .csv, .json, .npz or .txt"]);
    asked("--field p1", &["--points <LIST>"]);
    asked("--times 1 --points 1,0 --field p1", &["found the point 0", "that increase"]);
    asked("--times 1 --points 1 --field averages", &["found fewer than two points"]);
    asked("--times 1 --points 0,11 --field averages", &["found point 11", "between 0 and 10"]);
    asked("--times 1 --points 0,11", &["found point 11"]);
    asked("--as python --times 1", &["cannot be used with"]);
    refused(
        "reference paper-weak --exact --times 5",
        &["found time 5, expected an earlier one", "exactness ends before"],
    );
    refused("reference figure-4-r02 --as c", &["found a damped rod or a body of a chain, expected an undamped rod"]);
}

/// A cell that is five roundings of a double wide: above the ray of the impact nothing is strained.
#[test]
fn narrow_cells_are_those_of_the_doubles() {
    let text = quiet("reference figure-4-r02 --times 0.25 --points 0,0.3,0.3000000000000003,1 --field averages --bare");
    let rows: Vec<&str> = text.lines().collect();
    assert!(
        rows.len() == 4 && rows[2].starts_with("0.25,both,0.3000000000000001") && rows[2].ends_with(",0"),
        "{text}"
    );
}

#[test]
fn steps_end_where_they_are_told() {
    let last = |dt: &str, to: &str| {
        let found = json(&format!("reference figure-4-r02 --dt {dt} --to {to} --columns t"));
        let rows = found["rows"].as_array().unwrap();
        (rows.len(), rows.last().unwrap()[0].as_f64().unwrap())
    };
    // 3 · 0.1 is no double, and 0.3 is where the run ends.
    assert_eq!(last("0.1", "0.3"), (4, 0.3));
    assert_eq!(last("0.25", "0.6"), (3, 0.5));
    assert_eq!(last("2", "1"), (1, 0.0));
}

/// Where a rod is damped, rows are what the history answers one by one; and zeros alone, in flight, are settled.
#[test]
fn a_damped_rod_has_rows() {
    let rod = scene("figure-4-r02").with_run(Run::Time(4.into())).unwrap();
    let history = rod.doubles().unwrap();
    let found = json("reference figure-4-r02 --times 1,3 --side left");
    for (row, t) in [1.0, 3.0].into_iter().enumerate() {
        let value = |name: &str| column(&found, name)[row].as_f64().unwrap();
        assert!((value("u_top") - history.top_end(t, Side::Left).unwrap().0).abs() < 1e-9);
        assert!((value("h") - history.centre(t).unwrap().0).abs() < 1e-9);
        assert!((value("E_z") - history.energy(t).unwrap().vibrational).abs() < 1e-9);
    }
    // A mean of v_x is a difference of v, in doubles and proved.
    for asked in ["--digits 12 --times 1,3", "--certified --times 1,1.7"] {
        let asked = format!("reference figure-4-r02 {asked} --points 0,1/4,1 --side left");
        let rows = |field: &str| json(&format!("{asked} --field {field}"));
        let (points, means, nodal) = (rows("points"), rows("averages"), rows("p1"));
        let value = |table: &Value, row: usize, column: usize| {
            let value = &table["rows"][row][column];
            let text = value["value"].as_str().or(value.as_str()).unwrap();
            text.parse::<f64>().unwrap()
        };
        for time in 0..2 {
            let u: Vec<f64> = (0..3).map(|k| value(&points, 3 * time + k, 3)).collect();
            let found: Vec<f64> = (0..2).map(|k| value(&means, 2 * time + k, 5)).collect();
            assert!((found[0] - (u[1] - u[0]) / 0.25).abs() < 1e-10, "{found:?} {u:?}");
            assert!((found[1] - (u[2] - u[1]) / 0.75).abs() < 1e-10, "{found:?} {u:?}");
            // Both have one integral over the grid.
            let p: Vec<f64> = (0..3).map(|k| value(&nodal, 3 * time + k, 5)).collect();
            let integral = 0.25 * (p[0] + p[1]) / 2.0 + 0.75 * (p[1] + p[2]) / 2.0;
            assert!((integral - (u[2] - u[0])).abs() < 1e-10, "{p:?} {u:?}");
        }
    }
    let flight = quiet("reference figure-4-r02 --times 3 --columns force");
    assert!(flight.ends_with("force\n0.0\n"), "{flight}");
}

/// Each column of numbers in digits says how far it may be off, the rounding of the last digit included: doubles read
/// from both files are as near to each other as that and the doubles allow.
#[test]
fn columns_in_digits_have_their_bounds() {
    let of = |digits: &str| json(&format!("reference figure-4-r02 --digits {digits}"));
    let (few, many) = (of("8"), of("30"));
    let mut held = 0;
    for (k, column) in few["columns"].as_array().unwrap().iter().enumerate() {
        let Some(bound) = column["bound"].as_f64() else {
            assert!(["side", "contact"].contains(&column["name"].as_str().unwrap()), "{column}");
            continue;
        };
        for (few, many) in few["rows"].as_array().unwrap().iter().zip(many["rows"].as_array().unwrap()) {
            let [few, many]: [f64; 2] = [few, many].map(|row| row[k].as_str().unwrap().parse().unwrap());
            assert!((few - many).abs() <= bound + 1e-15 * many.abs(), "{column}: {few} {many}");
            held += 1;
        }
        // And no wider than the eighth digit of numbers about 1 is.
        let most = many["rows"].as_array().unwrap().iter().map(|row| row[k].as_str().unwrap().parse::<f64>().unwrap());
        assert!(bound <= 1e-7 * most.map(f64::abs).fold(1.0, f64::max), "{column}");
    }
    assert!(held >= 17 * 3, "{held}");
}
