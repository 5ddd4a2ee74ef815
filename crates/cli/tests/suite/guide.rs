//! The guide and the pages beside it: what their commands print, the pictures they draw, and the answers of exercises.
//!
//! `make docs` sets REBUILD_GUIDE, and what differs is written instead of reported.

use std::path::{Path, PathBuf};
use std::process::Command;

use dalembert::rug::Rational;
use dalembert::{Problem, Side, TypedHistory};

pub(crate) fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

fn folder() -> PathBuf {
    docs().join("guide")
}

fn chapter(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// What a command of a chapter prints, run in `work` by a shell.
fn output(line: &str, work: &Path) -> String {
    let here = Path::new(env!("CARGO_BIN_EXE_dalembert")).parent().unwrap();
    let path = std::env::join_paths(
        std::iter::once(here.to_path_buf()).chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    let run = Command::new("sh").args(["-c", line]).current_dir(work).env("PATH", path.unwrap()).output().unwrap();
    let [out, err] = [run.stdout, run.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(run.status.success() && err.is_empty(), "{line}: {err}");
    let lines: Vec<&str> = out.trim_end().lines().map(str::trim_end).collect();
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// The chapter with what its commands print now. Its scenes and scripts are written into `work` first, where its
/// pictures are then.
fn rebuilt(text: &str, work: &Path) -> String {
    let mut out = String::new();
    for (k, block) in text.split("```").enumerate() {
        let fence = if k > 0 { "```" } else { "" };
        if let Some(scene) = block.strip_prefix("toml\n# ").or_else(|| block.strip_prefix("awk\n# ")) {
            let (name, lines) = scene.split_once('\n').unwrap();
            std::fs::write(work.join(name), lines).unwrap();
        }
        match block.strip_prefix("console\n") {
            Some(session) => {
                let commands = session.lines().filter_map(|line| line.strip_prefix("$ "));
                let shown: String = commands.map(|line| format!("$ {line}\n{}", output(line, work))).collect();
                out += &format!("{fence}console\n{shown}");
            }
            None => out += &format!("{fence}{block}"),
        }
    }
    out
}

pub(crate) fn rebuilds() -> bool {
    std::env::var_os("REBUILD_GUIDE").is_some()
}

/// Holds what a page shows against what its commands print in `work`; its text.
#[track_caller]
fn prints(path: &Path, work: &Path) -> String {
    let name = path.display();
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let now = rebuilt(&text, work);
    if rebuilds() {
        std::fs::write(path, &now).unwrap();
    }
    assert!(text.contains("console\n$ dalembert "), "{name} has a command");
    for (ours, theirs) in now.lines().zip(text.lines()).filter(|_| !rebuilds()) {
        assert_eq!(ours, theirs, "{name}; `make docs` writes it anew");
    }
    assert!(rebuilds() || now == text, "{name}");
    text
}

/// Holds a chapter and its pictures against what its commands give.
#[track_caller]
fn holds(name: &str) {
    let work = tempfile::tempdir().unwrap();
    let text = prints(&folder().join(name), work.path());
    let rebuild = rebuilds();
    let pictures: Vec<&str> =
        text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|end| end.0).collect();
    let pictures: Vec<&&str> = pictures.iter().filter(|path| path.ends_with(".svg")).collect();
    assert_eq!(pictures.len(), 1, "{name} has one picture");
    for picture in pictures {
        let drawn = [work.path().join(picture), work.path().join("figures").join(picture)];
        let drawn = drawn.iter().find_map(|path| std::fs::read(path).ok()).expect("a command draws it");
        let kept = folder().join(picture);
        if rebuild {
            std::fs::write(&kept, &drawn).unwrap();
        }
        assert!(drawn.len() < 100_000, "{picture}: {} bytes", drawn.len());
        let same = std::fs::read(&kept).unwrap() == drawn;
        assert!(same, "{name}: {picture} is not what its command draws; `make docs` draws it anew");
    }
}

/// The answer of a chapter's exercise, on one line, has all of `parts`.
#[track_caller]
fn answers(name: &str, parts: &[String]) {
    let text = chapter(name);
    assert!(text.contains("**Exercise.**") && text.contains("**In class:**"), "{name}");
    let (_, rest) = text.split_once("<details><summary>Answer</summary>").unwrap();
    let answer = rest.split_once("</details>").unwrap().0.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in parts {
        assert!(answer.contains(part), "{name}: found no `{part}` in: {answer}");
    }
}

/// `c = L = g = 1` in fractions, with enough impacts for every question here.
fn unit(speed: &str, impacts: u32) -> TypedHistory<Rational> {
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(speed);
    rod.impacts(impacts).build().unwrap().exact().unwrap()
}

#[test]
fn two_bars() {
    holds("10-two-bars.md");
    let ratio = |n: u32| (0..n).fold(Rational::from((9, 13)), |force, _| force * Rational::from((5, 13))).to_string();
    answers("10-two-bars.md", &[ratio(0), ratio(1), ratio(2)]);
}

#[test]
fn the_hopkinson_bar() {
    holds("11-hopkinson.md");
    let speed = |modulus: f64| (modulus / 7800.0).sqrt();
    let [bar, specimen] = [speed(201e9), speed(160.8e9)];
    let impedances = [bar * 30.0 * 30.0, specimen * 25.0 * 25.0];
    let ratio = (impedances[0] - impedances[1]) / (impedances[0] + impedances[1]);
    let trips = (1..).find(|n| ratio.powi(2 * n) < 0.01).unwrap();
    let half_pulse = 0.6 / bar;
    let longest = half_pulse * specimen / (2.0 * f64::from(trips));
    let parts = [format!("n = {trips}"), format!("{:.3} ms", 1e3 * half_pulse), format!("below {longest:.3} m")];
    answers("11-hopkinson.md", &parts);
    assert!(chapter("11-hopkinson.md").contains(&format!("ρ = {ratio:.3}")));
}

#[test]
fn a_load_and_its_series() {
    holds("12-end-loads.md");
    let rest = 4.0 * 10e3 * 15.0 / (std::f64::consts::PI.powi(2) * 1e8 * 250.0);
    let share = 100.0 * rest / 3e-3;
    answers("12-end-loads.md", &[format!("{rest:.1e}"), format!("{share:.2} %")]);
}

/// The first force on a dashpot is `Zdμ/(Z + d)`.
#[test]
fn a_soft_ground_and_a_mass() {
    holds("13-soft-contact.md");
    let force = |d: f64| d / (1.0 + d);
    answers("13-soft-contact.md", &["d = Z".to_string(), format!("1/{:.0}", 1.0 / force(0.25))]);
}

/// The first branch of a free rod ends at `T = 3t₁`, where the lower end rises to `g t₁²/2`.
#[test]
fn motions_that_repeat_themselves() {
    holds("14-orbits.md");
    let trip = 2.0 / 5000.0_f64;
    let parts = [format!("{:.1} ms", 3e3 * trip), format!("{:.2} µm", 1e6 * 9.81 * trip * trip / 2.0)];
    answers("14-orbits.md", &parts);
}

#[test]
fn pages_show_what_their_commands_print() {
    for page in ["numbers.md", "output.md", "scenes.md", "sweeps.md"] {
        prints(&docs().join(page), tempfile::tempdir().unwrap().path());
    }
}

/// What the pages tell to type, with a code of one's own, `my_code` and `run.csv`, and with pictures as SVG: PNG and
/// PDF are drawn from it. The figures of the paper are drawn once, in `pictures`.
#[test]
fn commands_of_pages_run() {
    let work = tempfile::tempdir().unwrap();
    let scene = std::fs::read_to_string(docs().join("scenes.md")).unwrap();
    let scene = scene.split_once("```toml\n# rod.toml\n").unwrap().1.split_once("```").unwrap().0;
    std::fs::write(work.path().join("rod.toml"), scene).unwrap();
    output("dalembert reference doyen-ern-piperno --dt 0.01 --to 14 --side right -o run.csv", work.path());
    let mut count = 0;
    for page in ["output.md", "compare.md", "sweeps.md"] {
        let text = std::fs::read_to_string(docs().join(page)).unwrap();
        for block in text.split("```sh\n").skip(1).filter_map(|rest| rest.split_once("```")) {
            let block = block.0.replace("\\\n", "").replace("my_code --print-times", "seq 5");
            let block = block.replace(".png", ".svg").replace(".pdf", ".svg");
            for line in block.lines().filter(|line| !line.starts_with("cargo") && !line.contains("figures")) {
                output(&format!("{line} 2>notes || {{ cat notes >&2; false; }}"), work.path());
                count += 1;
            }
        }
    }
    assert!(count >= 12, "{count} commands");
}

/// The files of the repository that a page links to are there.
#[test]
fn links_lead_to_files() {
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let pages = |folder: &str| {
        let entries = std::fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path());
        entries.filter(|path| path.extension().is_some_and(|end| end == "md")).collect::<Vec<_>>()
    };
    let mut links = 0;
    for page in ["", "docs", "docs/guide", "python"].into_iter().flat_map(pages) {
        let text = std::fs::read_to_string(&page).unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link) {
            let Some(file) = link.split('#').next().filter(|file| !file.is_empty() && !file.contains([' ', ':']))
            else {
                continue;
            };
            assert!(page.parent().unwrap().join(file).exists(), "{}: {link}", page.display());
            links += 1;
        }
    }
    assert!(links > 50, "{links} links");
}

#[test]
fn chapter_1() {
    holds("01-fall.md");
    let rod = Problem::builder().length("0.5").material("210e9", 7850, "1e-4").gravity("9.81");
    let history = rod.drop_height(1).build().unwrap().doubles().unwrap();
    let (contact, wave_speed) = (&history.contacts()[0], (210e9f64 / 7850.0).sqrt());
    let strain = history.strain(0.0, Side::Right).unwrap();
    let force = -contact.peak_strain * 210e9 * 1e-4;
    answers(
        "01-fall.md",
        &[
            format!("c = √(E/ρ) = {wave_speed:.0} m/s"),
            format!("t₁ = 2L/c = {:.5} ms", 1e3 * contact.release.unwrap()),
            format!("= {:.4} m/s. The speed", -strain * wave_speed),
            format!("M = {:.0},", -strain * wave_speed / 9.81 / contact.release.unwrap()),
            format!("{:.3} kN", force / 1e3),
            format!("weighs {:.2} N", 7850.0 * 1e-4 * 0.5 * 9.81),
        ],
    );
}

#[test]
fn chapter_2() {
    holds("02-lattice.md");
    let [before, after] = [Side::Left, Side::Right].map(|side| unit("3", 1).top_end(1.into(), side).unwrap().1);
    answers("02-lattice.md", &[format!("= {before}, free fall").replace('-', "−"), format!("Just after: +{after},")]);
}

#[test]
fn chapter_3() {
    holds("03-switch.md");
    let strain = unit("1", 1).strain(Rational::from((5, 2)), Side::Right).unwrap();
    answers("03-switch.md", &[format!("$1 + 5/2 - 4 = {strain}$,")]);
}

#[test]
fn chapter_4() {
    holds("04-first-bounce.md");
    let history = unit("3/2", 1);
    assert_eq!(history.contacts()[0].release, Some(Rational::from((5, 2))));
    let found = history.restitution(0).unwrap();
    let [momentum, energy] = [found.e_p, found.e_e2].map(Result::unwrap);
    assert_eq!(Rational::from(&momentum * &momentum), energy);
    // The centre of mass is back where it was, and only there.
    assert_eq!(history.centre(Rational::from((5, 2))).unwrap().0, 0);
    assert_ne!(unit("1", 1).centre(3.into()).unwrap().0, 0);
    answers(
        "04-first-bounce.md",
        &[format!(r"e_P = \mu/\mu_0 = {momentum}$"), format!(" = {energy} = e_P^2$"), r"$\mu = 3/2$".into()],
    );
}

#[test]
fn chapter_5() {
    holds("05-energy-back.md");
    let history = unit("2", 4);
    let times: Vec<String> = history.events().iter().map(|event| event.t.to_string()).collect();
    let energy = history.energy(Rational::from(4)).unwrap();
    let [from, to, again, end, period] = [0, 1, 2, 3, 4].map(|k| times[k].as_str());
    answers(
        "05-energy-back.md",
        &[
            format!("contacts are from {from} to {to} and"),
            format!("from {again} to {end};"),
            format!(r"= {period}. The share is $\mu_0^2/(3\mu^2) = {}$,", energy.vibrational / energy.total),
        ],
    );
    assert_eq!(history.energy(Rational::from(9)).unwrap().vibrational, 0);
}

#[test]
fn chapter_6() {
    holds("06-damping.md");
    let rod = Problem::builder().length(1).wave_speed(1).damping("1/2").impact_speed(1).build().unwrap();
    let found = rod.doubles().unwrap().restitution(0).unwrap();
    let [momentum, energy] = [found.e_p, found.e_e2].map(Result::unwrap);
    let parts = [format!("= {momentum:.6}$, against"), format!("= {:.6}$:", (-1f64).exp()), format!("is {energy:.6},")];
    answers("06-damping.md", &parts);
}

#[test]
fn chapter_7() {
    holds("07-never.md");
    let bounce = |damping: &str| {
        let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build().unwrap();
        rod.doubles().unwrap().contacts()[0].release.unwrap()
    };
    let swing = |r: f64| (std::f64::consts::PI.powi(2) - r * r).sqrt();
    let half = |r: f64| std::f64::consts::PI / swing(r);
    let off = 100.0 * (half(3.1) / bounce("3.1") - 1.0);
    assert!((half(3.13) / bounce("3.13") - 1.0).abs() < 1.5e-3);
    let parts = [
        format!("= {:.5}, so t ≈ π/ω₀ = {:.3}.", swing(3.13), half(3.13)),
        format!("truth is {:.3}:", bounce("3.13")),
        format!("estimate {:.3} is off by {off:.0} %", half(3.1)),
    ];
    answers("07-never.md", &parts);
}

#[test]
fn chapter_8() {
    holds("08-accuracy.md");
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed("0.999999999999").time(32);
    let history = rod.build().unwrap().doubles().unwrap();
    answers("08-accuracy.md", &[format!("to {:.6}.", history.events().last().unwrap().t)]);
}

#[test]
fn chapter_9() {
    holds("09-which-number.md");
    let faster = 1.08f64.sqrt();
    let parts = [format!("{:.3} %", 100.0 * (faster - 1.0)), format!("{:.6} in place", 2.0 / 3.0 / faster)];
    answers("09-which-number.md", &[&parts[..], &[format!("{:.3} % less", 100.0 * (1.0 - 1.0 / faster))]].concat());
}
