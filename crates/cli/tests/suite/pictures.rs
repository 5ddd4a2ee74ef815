//! `dalembert plot` and `dalembert figures`: the structure of what they draw, and the numbers of the figures.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dalembert::{History, Numbers, Plan, Problem, Quantity, Question};

use crate::command::{Folder, csv, quiet, refused, run, with_snapshots};
use crate::common::close;
use crate::derivatives::bessel;

/// How many shapes each class of a picture has, in the order in which they come, and the labels of its axes.
fn structure(svg: &str) -> String {
    let (mut lines, mut classes) = (Vec::new(), Vec::<(String, usize)>::new());
    for line in svg.lines() {
        if let Some(class) = line.strip_prefix("<g class=\"").and_then(|rest| rest.split('"').next()) {
            classes.push((class.to_string(), 0));
        } else if line.starts_with("<text") {
            let mut text = line.split('>').skip(1).filter_map(|part| part.split('<').next()).collect::<String>();
            // Numbers beside the axes are no structure.
            if text.trim_start_matches('−').parse::<f64>().is_ok() {
                text = String::new();
            }
            if !text.is_empty() {
                lines.push(format!("text {text}"));
            }
        } else if line == "</g>" {
            match classes.pop() {
                Some((class, count)) if count > 0 => lines.push(format!("{class}: {count}")),
                _ => (),
            }
        } else if ["<polyline", "<polygon", "<path", "<circle"].iter().any(|shape| line.starts_with(shape)) {
            classes.last_mut().into_iter().for_each(|class| class.1 += 1);
        }
    }
    lines.retain(|line| !line.starts_with("grid") && !line.starts_with("axis"));
    lines.join("\n")
}

fn count(svg: &str, class: &str) -> Option<usize> {
    let prefix = format!("{class}: ");
    structure(svg).lines().find_map(|line| line.strip_prefix(&prefix)?.parse().ok())
}

#[test]
fn a_scene_is_told_in_four_pictures() {
    let svg = quiet("plot doyen-ern-piperno --to 26/3 -o -");
    // Contacts [0, 2/3], [8/3, 10/3], [16/3, 6], [8, 26/3]. The ray of an impact is in the rod until the next contact
    // has undone it: it leaves the ground at 0, 2/3, 4/3, 2 and 8/3, and the same again 16/3 later.
    assert_eq!((count(&svg, "rays"), count(&svg, "contacts")), (Some(10), Some(4)));
    // The stress jumps where each contact begins and ends, but for the two ends of the picture.
    assert_eq!(count(&svg, "jumps"), Some(6));
    assert_eq!(svg, quiet("plot doyen-ern-piperno --to 26/3 -o -"), "the same bytes");
    with_snapshots(|| insta::assert_snapshot!("picture_doyen_ern_piperno", structure(&svg)));
    // Between the rays of an undamped rod each cell is one polygon; a damped one is cut finer.
    assert!(count(&svg, "cells").is_some_and(|cells| cells < 60), "{}", structure(&svg));
    let damped = quiet("plot figure-4-r02 --quantity xt -o -");
    assert!(count(&damped, "cells") > Some(200) && count(&damped, "contacts") == Some(1));
}

/// A rod on a penalty has the ray of its start, drawn leg by leg; the contact makes fronts without a jump, where rigid
/// contact makes a ray and two jumps.
#[test]
fn a_penalty_makes_fronts_without_a_jump() {
    let jumps = |scene| {
        let svg = quiet(&format!("plot {scene} --to 3 --quantity xt,stress -o -"));
        (count(&svg, "rays"), count(&svg, "jumps"), count(&svg, "contacts"))
    };
    assert_eq!(jumps("getfem-penalty"), (Some(3), None, Some(1)));
    assert_eq!(jumps("getfem-dynamic-contact"), (Some(2), Some(2), Some(1)));
}

#[test]
fn units_stand_on_the_axes() {
    let folder = Folder::new();
    let rod = "rod = { length = 0.5, modulus = 210e9, density = 7850, area = 1e-4 }\nimpact = { speed = 4 }\n";
    let path = &folder.write("rod.toml", rod);
    let svg = quiet(&format!("plot {path} --quantity stress,force,u_end,E_total --to 1e-3 -o -"));
    let found = structure(&svg);
    for label in ["text t [ms]", "text E vx(0,t) [MPa]", "text −E S vx(0,t) [kN]", "text v(0,t) [mm]", "text E [J]"] {
        assert!(found.contains(label), "{label}: {found}");
    }
    // ρ c v = 7850 · 5172 · 4 = 162 MPa: the number beside the last tick below it.
    assert!(svg.contains(">−150<"));
    refused(&format!("plot {path} paper-strong --quantity u_end -o -"), &["different units, `m` and none"]);
}

/// The page's list of energies has the colours of `plot`, in both themes; all that is drawn comes from the library.
#[test]
fn the_page_has_the_colours_of_plot() {
    let style = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/page/style.css")).unwrap();
    let svg = quiet("plot paper-strong --quantity energy -o -");
    for name in ["--translation: ", "--vibration: "] {
        let colors: Vec<&str> = style.split(name).skip(1).filter_map(|rest| rest.split(';').next()).collect();
        let [light, dark] = colors[..] else { panic!("{name} for both themes: {colors:?}") };
        assert_eq!(light, dark);
        assert!(svg.contains(&format!("fill=\"{light}\"")), "{name}{light}");
    }
}

#[test]
fn several_scenes_are_lines_with_a_legend() {
    let svg = quiet("plot figure-4-r01 figure-4-r03 --quantity h -o -");
    let found = structure(&svg);
    assert!(found.contains("text r = 0.1\ntext r = 0.3"), "{found}");
    assert_eq!(found.matches("curve: 1").count(), 2);
}

/// Width and height of each frame, mm.
fn frames(svg: &str) -> Vec<[f64; 2]> {
    let frames = svg.lines().filter(|line| line.starts_with("<rect") && line.contains("fill=\"none\""));
    let number = |line: &str, name: &str| -> f64 {
        let value = line.split(&format!(" {name}=\"")).nth(1).unwrap();
        value.split('"').next().unwrap().parse().unwrap()
    };
    frames.map(|line| ["width", "height"].map(|name| number(line, name))).collect()
}

/// Scenes side by side have one axis of time, one scale of colours and one legend that tells them apart.
#[test]
fn scenes_side_by_side_are_drawn_alike() {
    let svg = quiet("plot figure-4-r01 figure-4-r03 --quantity xt,stress,h -o -");
    let panels: Vec<&str> = svg.split("class=\"panel\"").skip(1).collect();
    let of = |panel: &str, class: &str| {
        let part = panel.split(&format!("class=\"{class}\"")).nth(1).unwrap().split("</g>").next().unwrap();
        part.split("<text").skip(1).map(|text| text.split('>').nth(1).unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(panels.len(), 4);
    assert_eq!(of(panels[0], "axis-x"), of(panels[1], "axis-x"));
    assert_eq!(of(panels[0], "legend"), of(panels[1], "legend"));
    assert_eq!((svg.matches(">r = 0.1<").count(), svg.matches(">r = 0.3<").count()), (1, 1));
}

/// On a slide each of four pictures is a fifth of its height or more, and nothing of the command line is in it.
#[test]
fn a_slide_has_room_for_four_pictures() {
    let svg = run("plot doyen-ern-piperno --size slide -o -").out;
    let heights: Vec<f64> = frames(&svg).into_iter().map(|[_, height]| height).collect();
    assert_eq!(heights.len(), 4);
    assert!(heights.iter().all(|height| *height > 254.0 * 9.0 / 16.0 / 5.0), "{heights:?}");
    assert!(!svg.contains("--"), "no option in a picture");
}

#[test]
fn long_histories_are_cut_and_said() {
    // The flight after the first contact is 350 round trips long.
    let said = run("plot steel-bar -o -");
    assert!(said.err.contains("note: steel-bar: drawn from t = 0 to 0.0008 of 0.138"), "{}", said.err);
    assert!(said.code == Some(0) && said.out.len() < 300_000);
    let title = "from t = 0 to 0.0008 of 0.138";
    assert!(said.out.contains(title) && said.out.contains("1 of 1 contacts<"), "{}", structure(&said.out));
    // Restitution is that of all contacts: no span is cut, and none is said.
    let restitution = quiet("plot steel-bar --quantity restitution -o -");
    assert!(!restitution.contains("from t ="));
    // A notebook holds several pictures in one document: a colour of one has no name of another.
    let names = |svg: &str| -> BTreeSet<String> {
        svg.split("id=\"").skip(1).filter_map(|part| Some(part.split('"').next()?.to_string())).collect()
    };
    let other = names(&quiet("plot doyen-ern-piperno --to 5 -o -"));
    assert!(other.len() > 1 && names(&said.out).is_disjoint(&other));
    // The contact of 4e-4 in 0.13 is a mark in each of four pictures, and no band.
    let whole = quiet("plot steel-bar --to 0.13 -o -");
    assert_eq!(structure(&whole).matches("text short contact").count(), 4);
    assert_eq!(structure(&whole).matches("contacts: 1").count(), 4);
    // Over 2000 round trips the field is a grid of 480 columns, which does not show them.
    let folder = Folder::new();
    let rod = "rod = { length = 1, wave_speed = 1, damping = 1e-4 }\nimpact.speed = 3000\ngravity.acceleration = 1\n";
    let said = run(&format!("plot {} --quantity xt --to 4000 -o -", folder.write("long.toml", rod)));
    assert!(said.err.contains("note: long: xt has 0.24 columns for a round trip"), "{}", said.err);
    let said = run("plot figure-1-r30 --quantity motion -o -");
    assert!(said.err.contains("the history ends at t = 4: no further impact"), "{}", said.err);
}

#[test]
fn mistakes_are_answered_with_what_was_expected() {
    let folder = Folder::new();
    refused("plot paper-weak --quantity stres -o -", &["invalid value 'stres'", "stress"]);
    refused(
        &format!("plot paper-weak -o {}", folder.path("a.gif")),
        &["a.gif, expected a file that ends in .svg, .png or .pdf"],
    );
    refused("plot paper-weak --from 2 --to 1 -o -", &["found --to 1, expected a time after 2"]);
    refused(&format!("plot paper-weak --from 99 -o {}", folder.path("a.svg")), &["found time 99"]);
    refused("plot paper-weak --quantity h --deformed -o -", &["--deformed without xt"]);
    refused(&format!("figures --only 9 -o {}", folder.path("f")), &["found no figure of this name", "tenth-bounce"]);
    refused(&format!("figures --only 8 -o {}", folder.path("none/f")), &["no folder"]);
    assert_eq!(folder.count(), 0, "nothing is left behind");
}

/// Enclosures leave the energy open where a ray is at an end; nothing is drawn there, and all else is.
#[test]
fn what_is_open_is_not_drawn() {
    let said = run("plot steel-bar --certified --quantity energy,E_total -o -");
    assert!(said.code == Some(0) && !said.out.contains("NaN") && !said.out.contains("inf"), "{}", said.err);
    assert_eq!(structure(&said.out).matches("curve: 1").count(), 2, "{}", structure(&said.out));
}

/// The number after a name in a PDF's text.
fn numbers_after(pdf: &str, name: &str) -> Vec<f64> {
    let rest = pdf.split(name).nth(1).unwrap();
    let numbers = rest.split([' ', '[', ']', '/', '\n']).filter(|word| !word.is_empty());
    numbers.map_while(|word| word.parse().ok()).collect()
}

/// The parts of a PDF are where its table says, it is one page of the size of the SVG, and its texts are texts in the
/// embedded font. The same picture has the same bytes.
#[test]
fn a_pdf_is_one_page_with_texts() {
    let folder = Folder::new();
    for (size, millimetres) in [("column", 85.0), ("page", 170.0), ("slide", 254.0)] {
        let (one, other) = (folder.path("one.pdf"), folder.path("other.pdf"));
        quiet(&format!("plot paper-strong --size {size} -o {one} -o {other}"));
        let bytes = fs::read(&one).unwrap();
        assert_eq!(bytes, fs::read(&other).unwrap());
        let pdf: String = bytes.iter().map(|byte| char::from(*byte)).collect();
        assert!(pdf.starts_with("%PDF-1.") && pdf.ends_with("%%EOF"));
        let table = numbers_after(&pdf, "startxref")[0] as usize;
        let chars: Vec<char> = pdf.chars().collect();
        let at = |place: usize| chars[place..chars.len().min(place + 40)].iter().collect::<String>();
        let entries: String = chars[table..].iter().collect();
        assert!(entries.starts_with("xref\n0 "));
        let places = entries.lines().filter(|line| line.ends_with(" n") || line.ends_with(" n "));
        let parts = places.map(|line| at(line[..10].parse().unwrap())).collect::<Vec<_>>();
        assert!(parts.len() > 8 && parts.iter().all(|part| part.contains(" 0 obj")), "{parts:?}");
        assert_eq!(numbers_after(&pdf, "/Type/Pages/Count"), [1.0]);
        let [left, low, width, height] = numbers_after(&pdf, "/MediaBox")[..] else { panic!("no MediaBox") };
        let svg = quiet(&format!("plot paper-strong --size {size} -o -"));
        let high: f64 = svg.split("height=\"").nth(1).unwrap().split("mm").next().unwrap().parse().unwrap();
        assert_eq!((left, low), (0.0, 0.0));
        // 72 points are 25.4 mm.
        close("width", width / 72.0 * 25.4, millimetres, 1.0, 1e-3);
        close("height", height / 72.0 * 25.4, high, 1.0, 1e-3);
        for part in ["/Subtype/Type0", "+DejaVuSans", "/ToUnicode", "/FontFile2"] {
            assert!(pdf.contains(part), "{part}");
        }
        // No clock, and no path of this machine.
        assert!(!pdf.contains("Date") && !pdf.contains("/tmp"));
    }
}

/// Letters that the embedded font does not have are named.
#[test]
fn letters_without_a_sign_are_said() {
    let folder = Folder::new();
    let rod = "title = \"μ of 竹\"\nrod = { length = 1, wave_speed = 1 }\nimpact = { speed = 3 }\n";
    let path = folder.write("rod.toml", rod);
    for (file, note) in [("a.png", true), ("a.pdf", true), ("a.svg", false)] {
        let said = run(&format!("plot {path} --quantity h -o {}", folder.path(file)));
        assert_eq!(said.err.contains("the font of PNG and PDF has no 竹, which stay empty"), note, "{}", said.err);
    }
}

/// The rows of a figure's CSV.
fn texts(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    csv(&folder.read(name)).split_off(1)
}

fn rows(folder: &Folder, name: &str) -> Vec<Vec<Option<f64>>> {
    let numbers = |row: &Vec<String>| row.iter().map(|cell| cell.parse().ok()).collect();
    texts(folder, name).iter().map(numbers).collect()
}

/// How far a printed number may be off: a unit of its last digit, where zeros at the end are not printed.
fn unit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once('e').unwrap_or((number, "0"));
    let places = mantissa.split_once('.').map_or(0, |parts| parts.1.len() as i32);
    10f64.powi(exponent.parse::<i32>().unwrap() - places).min(1e-8)
}

fn figures(only: &str) -> Folder {
    let folder = Folder::new();
    quiet(&format!("figures --only {only} -o {}", folder.path("")));
    folder
}

/// Figures 5–7 against characteristic cells from data, which share nothing with the closed form that the figures are
/// drawn from: no formula of the contact, no bounce, no energy.
#[test]
fn figures_5_to_7_agree_with_cells_from_data() {
    let folder = figures("1,5,6,7");
    sentences_hold_the_numbers_of_the_figures(&folder);
    let [part, kept, over] = ["figure-5.csv", "figure-6.csv", "figure-7.csv"].map(|name| rows(&folder, name));
    assert_eq!(part.len(), 4 * 373);
    for (k, row) in part.iter().enumerate() {
        let (r, mu) = (row[0].unwrap(), row[1].unwrap());
        let what = format!("r = {r}, μ = {mu}");
        let (translational, left) = (row[2].unwrap(), kept[k][2].unwrap());
        // Figure 7 is Figure 6 over e^{−2rt₁}; each is right to 1e-12.
        let decay = (4.0 * r).exp();
        close(&what, over[k][2].unwrap(), left * decay, 1.0, 1e-12 * (1.0 + decay));
        // The limits: e_E² of the true limit is the product of those of Figures 5 and 6.
        let ratio = 2.0 * r;
        let limit = 2.0 * (-ratio).exp() * (bessel(0, ratio) - bessel(1, ratio)) - (-2.0 * ratio).exp();
        close(&what, row[3].unwrap() * kept[k][3].unwrap(), limit * limit, 1.0, 2e-12);
        if r == 0.0 {
            // (4.72): 1 − μ₀²/3μ², and nothing is lost.
            close(&what, translational, 1.0 - 4.0 / (3.0 * mu * mu), 1.0, 1e-12);
            close(&what, left, 1.0, 1.0, 1e-12);
        } else if k % 93 == 0 {
            let speed = format!("{}", -mu);
            let data = [("0", speed.as_str()), ("1", speed.as_str())];
            let rod = Problem::builder().length(1).wave_speed(1).gravity(1).damping(r).velocity(data);
            let shares = [Quantity::TranslationalShare, Quantity::EnergyKept];
            let first = cells(&rod.time(3).build().unwrap()).list(&shares).unwrap().remove(0);
            close(&what, translational, first[0].as_ref().unwrap().to_f64(), 1.0, 1e-12);
            close(&what, left, first[1].as_ref().unwrap().to_f64(), 1.0, 1e-12);
        }
    }
}
fn cells(rod: &Problem) -> History {
    let plan = Plan::of(rod, &Question::run(Numbers::Double(Some(1e-13)))).unwrap();
    assert_eq!(plan.engine, dalembert::Engine::Cells);
    plan.solve(rod, std::sync::Arc::new(dalembert::engine::unobserved)).unwrap()
}

#[test]
fn figures_1_to_4_hold_what_the_theory_says() {
    let folder = figures("1,2,3,4,8");
    // Figure 1: the root of Ψ is where t_b says, and nothing was positive before.
    for row in rows(&folder, "figure-1.csv") {
        let [r, t, psi, bounce] = [0, 1, 3, 4].map(|k| row[k].unwrap());
        assert!(psi <= 0.0 || t > bounce, "r = {r}, t = {t}: {psi}");
        let truth = [(2.6, 1.788_481_033_298_875), (2.9, 2.553_022_499_313_244), (3.0, 3.299_026_051_445_773)];
        close("t_b", bounce, truth.iter().find(|known| known.0 == r).unwrap().1, 1.0, 1e-13);
    }
    // Figures 2 and 3: Theorem 2 with μ₀ = 2.
    for (row, text) in rows(&folder, "figure-3.csv").iter().zip(texts(&folder, "figure-3.csv")) {
        let (mu, z) = (row[0].unwrap(), row[3].unwrap());
        let truth = if mu < 2.0 { mu.powi(3) * (8.0 - 3.0 * mu) / 24.0 } else { 2.0 / 3.0 };
        close(&format!("E_z at μ = {mu}"), z, truth, 1.0, 1e-12);
        close("shares", row[4].unwrap() + row[5].unwrap(), 1.0, 1.0, unit(&text[4]) + unit(&text[5]));
    }
    // Figure 4: left of the dots the bounce comes later, and the red curve is (4.72).
    let four = rows(&folder, "figure-4.csv");
    assert_eq!(four.len(), 4000);
    for (row, text) in four.iter().zip(texts(&folder, "figure-4.csv")) {
        let (r, mu) = (row[0].unwrap(), row[1].unwrap());
        let (i0, i1) = (bessel(0, 2.0 * r), bessel(1, 2.0 * r));
        let dot = 2.0 * (i0 + i1) / (2.0 - i0);
        if (mu - dot).abs() > 1e-9 {
            assert_eq!(row[2] == Some(2.0), mu > dot, "r = {r}, μ = {mu}");
        }
        if r == 0.0 {
            let truth = if mu < 2.0 { (3.0 * mu * mu - 8.0 * mu + 12.0) / 12.0 } else { 1.0 - 4.0 / (3.0 * mu * mu) };
            close(&format!("e_E² at μ = {mu}"), row[3].unwrap(), truth, 1.0, unit(&text[3]) + 1e-14);
        }
    }
    assert!(four.iter().any(|row| row[0] == Some(0.3) && row[2] > Some(2.0) && row[3].is_some()));
    no_digit_is_beyond_its_bound(&folder);
    // All files, and an index that names them.
    let index = folder.read("README.md");
    for name in ["figure-1", "figure-2", "figure-3", "figure-4", "figure-8"] {
        for ending in [".svg", ".csv"].into_iter().chain([".png"]) {
            let file = format!("{name}{ending}");
            assert!(index.contains(&file) && Path::new(&folder.path(&file)).is_file(), "{file}");
        }
    }
    assert!(index.contains("| 0.3 | 0.55313"), "{index}");
    let svg = folder.read("figure-4.svg");
    assert_eq!(count(&svg, "marks"), Some(4), "a dot for each damping");
}

/// The numbers of Figure 4 that doubles know worst are printed with fewer digits, and all of these are those of twenty.
fn no_digit_is_beyond_its_bound(folder: &Folder) {
    let rows = texts(folder, "figure-4.csv").into_iter();
    let few = rows.filter(|row| !row[3].is_empty() && row[0] != "0" && unit(&row[3]) > 1e-12).collect::<Vec<_>>();
    assert!((100..1000).contains(&few.len()), "{}", few.len());
    for row in few.iter().step_by(40) {
        let rod = Problem::builder().length(1).wave_speed(1).gravity(1);
        let rod = rod.damping(row[0].as_str()).impact_speed(row[1].as_str());
        let history = rod.build().unwrap().digits(20).unwrap();
        let time = history.contacts()[0].release.clone().unwrap();
        let restitution = history.restitution(0).unwrap().e_e2.unwrap();
        for (number, truth) in [(&row[2], time), (&row[3], restitution)] {
            // Rounded within its bound, at most half a unit of the last digit.
            let printed = dalembert::rug::Float::parse(number).unwrap();
            let apart = (dalembert::rug::Float::with_val(100, printed) - truth).abs();
            assert!(apart <= unit(number), "{row:?}: {apart}");
        }
    }
}

/// The numbers in the sentences are those of Figures 1 and 5–7, which are in `folder`.
fn sentences_hold_the_numbers_of_the_figures(folder: &Folder) {
    let index = folder.read("README.md");
    // What the index names is there: of each figure the picture that it shows, and four links.
    let files: Vec<&str> = index.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert_eq!(files.len(), 4 * 5);
    assert!(files.iter().all(|file| Path::new(&folder.path(file)).is_file()), "{files:?}");
    assert!(fs::read(folder.path("figure-5.pdf")).unwrap().starts_with(b"%PDF-1."));
    for row in rows(folder, "figure-1.csv") {
        assert!(index.contains(&format!("{:.14}", row[4].unwrap())), "{row:?}");
    }
    for name in ["figure-5.csv", "figure-7.csv"] {
        for row in rows(folder, name).iter().filter(|row| row[0] != Some(0.0)) {
            assert!(index.contains(&format!("{:.8}", row[3].unwrap())), "{name} {row:?}");
        }
    }
}

/// The tenth bounce of the periodic bar of Doyen, Ern and Piperno, μ = kg L/c: every second one gives back.
#[test]
fn the_tenth_bounce_of_a_periodic_rod() {
    let folder = figures("tenth-bounce");
    let rows = rows(&folder, "tenth-bounce.csv");
    for mu in [3.0, 4.0, 5.0] {
        let row = rows.iter().find(|row| row[0] == Some(mu)).unwrap();
        // E_z/E = μ₀²/3μ² after the odd ones, 0 after the even ones.
        let first = 1.0 - 4.0 / (3.0 * mu * mu);
        close("first", row[1].unwrap(), first, 1.0, 1e-13);
        close("tenth", row[2].unwrap(), 1.0 / first, 1.0, 1e-9);
    }
}
