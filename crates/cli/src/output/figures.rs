//! The figures of the paper as pictures, as CSV, and the index beside them.

use glam::DVec2;

use super::column::Column;
use super::dataset::{Cell, Dataset};
use super::regimes::{regimes_data, regimes_panel};
use dalembert::number::Analytic;
use dalembert_plot::draw::{Anchor, Axis, Key, LINES, Mark, Panel, Sheet, Stroke};
use dalembert_verify::VerifyError;
use dalembert_verify::figures::{DAMPINGS, Figure, FigureData, FigureKind, HELD_DAMPINGS, Limits, threshold_speed};

const LINE: f64 = 0.4;
const THIN: f64 = 0.2;
const BLACK: &str = "#000000";
/// Colour of `r = 0` in the paper.
const UNDAMPED: &str = "#d55e00";
/// Colours of the regions A, B, C: the odd continuation of `g` is `−g` in A and C, and `g` in B.
const REGIONS: [&str; 3] = ["#d9c3dd", "#bfdcc4", "#d9c3dd"];

/// Returns the numbers of a figure, none with a digit beyond its bound.
pub(crate) fn figure_data(figure: &Figure, data: &FigureData) -> Dataset {
    if let Some(map) = &data.map {
        return regimes_data(map);
    }
    let row = |row: &Vec<_>| row.iter().map(|value: &Option<_>| Cell::number(value.clone())).collect();
    let columns = data.columns.iter().map(|name| Column::new(*name)).collect();
    let notes = [figure.shown, figure.corrected].map(String::from).to_vec();
    Dataset { columns, rows: data.rows.iter().map(row).collect(), notes, ..Dataset::default() }
}

/// Returns the index of the files, whose pictures have these `endings`.
pub(crate) fn figures_index(figures: &[&Figure], data: &[FigureData], endings: &[&str]) -> Result<String, VerifyError> {
    let names: Vec<String> = endings.iter().map(|ending| ending.to_uppercase()).collect();
    let mut text = format!(
        "# Figures\n\nOf F. Wang and S. W. Hansen, *Explicit solutions and coefficient of restitution for an elastic \
         rod with viscous damping*, IMA Preprint 2473, 2016, worked out by dalembert {}: `dalembert figures`.\nEach is \
         there as {} and as numbers (CSV), in which \
         what is not defined is empty and no number has a digit beyond the bound of its error.\n",
        env!("CARGO_PKG_VERSION"),
        names.join(", ")
    );
    for (figure, data) in figures.iter().zip(data) {
        let title =
            if figure.name.parse::<u32>().is_ok() { format!("Figure {}", figure.name) } else { figure.name.into() };
        let (file, count) = (figure.file(), data.map.as_ref().map_or(data.rows.len(), |map| map.regimes.len()));
        let links = names.iter().zip(endings).map(|(name, ending)| format!("[{name}]({file}.{ending}), "));
        text += &format!(
            "\n## {title}\n\n![{title}]({file}.{})\n\nReproduced: {}\n\nCorrected: {}\n\n{}[CSV]({file}.csv): {count} \
             rows\n",
            endings[0],
            figure.shown,
            figure.corrected,
            links.collect::<String>()
        );
    }
    if figures.iter().any(|figure| {
        matches!(
            figure.kind,
            FigureKind::Restitution
                | FigureKind::TranslationalShare
                | FigureKind::EnergyKept
                | FigureKind::EnergyOverDecay
        )
    }) {
        text += "\n## Limits\n\nFor μ → ∞ and t_b = t₁ (R = r t₁), where (4.75) has e^{−R}:\n\n\
                 | r | lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R} | e^{−R} | lim E_h/E | lim E/E(0) |\n\
                 |---|---|---|---|---|\n";
        for damping in DAMPINGS {
            let limits = Limits::new(damping)?;
            let numbers = [Some(limits.restitution), Some(limits.decay.sqrt()), limits.translational, limits.kept];
            let cells: Vec<String> = numbers.iter().flatten().map(|number| format!("{:.12}", number.value())).collect();
            text += &format!("| {damping} | {} |\n", cells.join(" | "));
        }
    }
    Ok(text)
}

type Row = Vec<Option<f64>>;

pub(crate) fn figure_sheet(figure: &Figure, data: &FigureData) -> Result<Sheet, VerifyError> {
    let rows = &data.values();
    let panel = match figure.kind {
        FigureKind::HeldStress => kernel(rows),
        FigureKind::VibrationalEnergy => energies(rows, "E_z(t_b)", &[(3, "E_z")]),
        FigureKind::EnergyShares => energies(rows, "share of E(0)", &[(4, "E_h(t_b)/E(0)"), (5, "E_z(t_b)/E(0)")]),
        FigureKind::Restitution => restitution(rows)?,
        FigureKind::TranslationalShare => shares(rows, "E_h(t₁)/E(t₁)"),
        FigureKind::EnergyKept => shares(rows, "E(t₁)/E(0)"),
        FigureKind::EnergyOverDecay => shares(rows, "E(t₁)/(E(0) exp(−2r t₁))"),
        FigureKind::IntegrationRegions => regions(rows),
        FigureKind::Regimes => data.map.as_ref().map(regimes_panel).ok_or(VerifyError::NoMap)?,
        FigureKind::TenthBounce => tenth(rows),
    };
    Ok(Sheet { title: Vec::new(), panels: vec![panel] })
}

/// Returns the points of two columns, in stretches where both are defined.
fn stretches<'a>(rows: impl Iterator<Item = &'a Row>, x: usize, y: usize) -> Vec<Vec<DVec2>> {
    let mut lines = vec![Vec::new()];
    for row in rows {
        match (row[x], row[y], lines.last_mut()) {
            (Some(x), Some(y), Some(line)) => line.push(DVec2::new(x, y)),
            (.., Some(line)) if !line.is_empty() => lines.push(Vec::new()),
            _ => (),
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

/// Returns the rows of a damping.
fn of_damping<'a>(rows: &'a [Row], damping: &str) -> impl Iterator<Item = &'a Row> + use<'a> {
    let damping: Option<f64> = damping.parse().ok();
    rows.iter().filter(move |row| row[0] == damping)
}

/// Returns the colour of a damping of Figures 4–7.
fn color(k: usize) -> &'static str {
    [UNDAMPED, LINES[0], LINES[2], LINES[3]][k % 4]
}

fn dots(panel: &mut Panel, points: Vec<DVec2>, color: &'static str) {
    panel.marks_unclipped("marks", points, Mark::Dot, color);
}

fn kernel(rows: &[Row]) -> Panel {
    let y = Axis::new("Ψ_r(t) = e^(rt) v_x(0,t)", "", Axis::range(rows.iter().filter_map(|row| row[3]), true));
    let title = "strain at the ground times e^(rt) of a rod that is held: g = 0, t₁ = μ = c = 1";
    let mut panel = Panel::new(title, Axis::new("t", "", [0.0, 4.0]), y);
    panel.level("limit", 0.0, Stroke::new("#808080", THIN));
    for (k, damping) in HELD_DAMPINGS.into_iter().enumerate() {
        let (rows, stroke) = (of_damping(rows, damping).collect::<Vec<_>>(), Stroke::new(LINES[k], LINE));
        // A jump lies between two rows of one time.
        let points = |rows: &[&Row]| rows.iter().filter_map(|row| Some(DVec2::new(row[1]?, row[3]?))).collect();
        let stretches: Vec<Vec<DVec2>> = rows.chunk_by(|a, b| a[1] != b[1]).map(points).collect();
        let jumps = stretches.windows(2).filter_map(|pair| Some(vec![*pair[0].last()?, *pair[1].first()?])).collect();
        panel.lines("jumps", jumps, Stroke::new(LINES[k], 0.15).dashed("0.5 0.5"));
        panel.lines("curve", stretches, stroke);
        panel.legend.push(Key::line(format!("r = {damping}"), stroke));
        let bounce = rows.first().and_then(|row| row[4]);
        bounce.into_iter().for_each(|time| dots(&mut panel, vec![DVec2::new(time, 0.0)], LINES[k]));
    }
    panel.legend.push(Key::mark("first bounce, t_b", Mark::Dot, BLACK));
    panel
}

fn energies(rows: &[Row], label: &str, columns: &[(usize, &str)]) -> Panel {
    let values = columns.iter().flat_map(|(column, _)| rows.iter().filter_map(|row| row[*column]));
    let (x, y) = (Axis::new("μ", "", [0.0, 8.0]), Axis::new(label, "", Axis::range(values, true)));
    let mut panel = Panel::new("energy at the first bounce: r = 0, c = L = g = 1", x, y);
    for (k, (column, name)) in columns.iter().enumerate() {
        let stroke = Stroke::new(LINES[k], LINE);
        panel.lines("curve", stretches(rows.iter(), 0, *column), stroke);
        let dot = rows.iter().filter(|row| row[0] == Some(2.0)).filter_map(|row| row[*column]);
        dots(&mut panel, dot.map(|value| DVec2::new(2.0, value)).collect(), UNDAMPED);
        if columns.len() > 1 {
            panel.legend.push(Key::line(*name, stroke));
        }
    }
    panel.legend.push(Key::mark("μ = μ₀", Mark::Dot, UNDAMPED));
    panel
}

fn restitution(rows: &[Row]) -> Result<Panel, VerifyError> {
    let (x, y) = (Axis::new("μ", "", [0.0, 12.5]), Axis::new("e_E²", "", [0.0, 1.05]));
    let mut panel = Panel::new("restitution of the first bounce: c = L = g = 1", x, y);
    let mut begins = Vec::new();
    for (k, damping) in DAMPINGS.into_iter().enumerate() {
        let stroke = Stroke::new(color(k), LINE);
        let limit = Limits::new(damping)?.restitution.value().powi(2);
        panel.level("limit", limit, Stroke { width: THIN, ..stroke.dashed("1.6 0.9") });
        let curve = stretches(of_damping(rows, damping), 1, 3);
        // Where t_b = t₁ begins: between two points of the curve.
        let at = threshold_speed(damping);
        let pairs = curve.iter().flat_map(|line| line.windows(2));
        let about = pairs.filter(|pair| (pair[0].x..pair[1].x).contains(&at));
        begins.extend(about.map(|pair| pair[0].lerp(pair[1], (at - pair[0].x) / (pair[1].x - pair[0].x))));
        panel.lines("curve", curve, stroke);
        panel.legend.push(Key::line(format!("r = {damping}"), stroke));
    }
    dots(&mut panel, begins, BLACK);
    panel.legend.push(Key::mark("t_b = t₁ from here on", Mark::Dot, BLACK));
    panel.legend.push(Key::line("limit for μ → ∞", Stroke::new(BLACK, THIN).dashed("1.6 0.9")));
    Ok(panel)
}

fn shares(rows: &[Row], label: &str) -> Panel {
    let y = Axis::new(label, "", Axis::range(rows.iter().flat_map(|row| [row[2], row[3], row[4]]).flatten(), false));
    let title = "energy at the first bounce, t_b = t₁: c = L = g = 1";
    let mut panel = Panel::new(title, Axis::new("μ", "", [3.2, 12.5]), y);
    let supposed = Stroke::new("#808080", THIN).dashed("0.4 0.6");
    for (k, damping) in DAMPINGS.into_iter().enumerate() {
        let stroke = Stroke::new(color(k), LINE);
        if let Some(row) = of_damping(rows, damping).next() {
            let limit = Stroke { width: THIN, ..stroke.dashed("1.6 0.9") };
            for (value, stroke) in [(row[4], supposed), (row[3], limit)] {
                value.into_iter().for_each(|value| panel.level("limit", value, stroke));
            }
        }
        panel.lines("curve", stretches(of_damping(rows, damping), 1, 2), stroke);
        panel.legend.push(Key::line(format!("r = {damping}"), stroke));
    }
    panel.legend.push(Key::line("limit for μ → ∞", Stroke::new(BLACK, THIN).dashed("1.6 0.9")));
    panel.legend.push(Key::line("as the paper supposes", supposed));
    panel
}

fn regions(rows: &[Row]) -> Panel {
    let mut x = Axis::new("y", "", [-2.0, 3.0]);
    let ticks = [(-1.5, "x − c t₁"), (0.0, "0"), (0.5, "x"), (2.0, "2L"), (2.5, "x + c t₁")];
    x.ticks = Some(ticks.map(|(y, text)| (y, text.into())).into());
    let mut y = Axis::new("time", "", [0.0, 2.2]);
    y.ticks = Some(vec![(0.0, "0".into()), (2.0, "t₁".into())]);
    let mut panel = Panel::new("regions of integration for the point (x, t₁), x = L/2", x, y);
    for ((region, color), name) in [1.0, 2.0, 3.0].into_iter().zip(REGIONS).zip(["A", "B", "C"]) {
        let rows = rows.iter().filter(|row| row[0] == Some(region));
        let corners: Vec<DVec2> = rows.filter_map(|row| Some(DVec2::new(row[1]?, row[2]?))).collect();
        let middle = corners.iter().sum::<DVec2>() / corners.len().max(1) as f64;
        let edge = corners.iter().chain(corners.first()).copied().collect();
        panel.areas("area", vec![corners], color);
        panel.lines("curve", vec![edge], Stroke::new(BLACK, THIN));
        panel.note("note", middle, Anchor::Middle, name);
    }
    dots(&mut panel, vec![DVec2::new(0.5, 2.0)], BLACK);
    panel.legend = vec![Key::area("g continued as −g", REGIONS[0]), Key::area("as g", REGIONS[1])];
    panel
}

fn tenth(rows: &[Row]) -> Panel {
    let (x, y) = (Axis::new("μ", "", [0.0, 10.0]), Axis::new("e_E²", "", [0.0, 2.0]));
    let mut panel = Panel::new("restitution of the first and of the tenth bounce: r = 0, c = L = g = 1", x, y);
    panel.level("limit", 1.0, Stroke::new("#808080", THIN));
    let first = Stroke::new(UNDAMPED, LINE);
    // It jumps wherever an earlier landing comes or goes: points, without lines between them.
    let tenth = stretches(rows.iter(), 0, 2).concat();
    panel.marks("marks", tenth, Mark::Point, LINES[0]);
    panel.lines("curve", stretches(rows.iter(), 0, 1), first);
    panel.legend = vec![Key::line("first bounce", first), Key::mark("tenth bounce", Mark::Point, LINES[0])];
    panel
}
