//! The map of regimes as numbers and as a picture.

use std::io::{self, Cursor};

use glam::DVec2;

use super::column::Column;
use super::dataset::Dataset;
use super::npz::Npz;
use dalembert::number::{Estimate, Number, Scalar, bound_of_log2, double_bound};
use dalembert_plot::draw::{Axis, Key, Panel, Sheet, Size, Stroke};
use dalembert_verify::regimes::{BANDS, CellAxis, Map, Regime, threshold, threshold_near};

/// Colour and name of each band: with a bounce, without one, not decided.
const COLORS: [(&str, &str); BANDS.len() + 2] = [
    ("#440154", "t_b = t₁"),
    ("#46327e", "to 1.25 t₁"),
    ("#365c8d", "to 1.5 t₁"),
    ("#277f8e", "to 1.75 t₁"),
    ("#1fa187", "to 2 t₁"),
    ("#4ac16d", "to 3 t₁"),
    ("#a0da39", "to 4 t₁"),
    ("#fde725", "later"),
    ("#d9d9d9", "no bounce"),
    ("#e31a1c", "not decided"),
];

/// Returns `t_b/t₁` at each point, empty without a bounce, and the regime in a word.
pub(crate) fn regimes_data(map: &Map) -> Dataset {
    let row = |(k, regime): (usize, &Regime)| {
        let (m, r) = (&map.speed[k / map.damping.len()], &map.damping[k % map.damping.len()]);
        let (time, word) = match regime {
            Regime::Bounce(time) => (Some(time.text()), "bounce"),
            Regime::Never => (None, "no bounce"),
            Regime::Undecided => (None, "not decided"),
        };
        vec![r.to_string().into(), m.to_string().into(), time.into(), word.into()]
    };
    let columns = ["damping_ratio", "speed_ratio", "bounce_ratio", "regime"].map(Column::new).to_vec();
    Dataset { columns, rows: map.regimes.iter().enumerate().map(row).collect(), ..Dataset::default() }
}

/// Returns `R` of each column and the `M` above which the bounce comes at `t₁`; empty if no `M` is high enough.
pub(crate) fn threshold_data(map: &Map) -> Dataset {
    let row = |r: &Number| {
        let m = threshold(&Estimate::from_number(r, &()));
        let [m, bound] = m.map(|m| [m.text(), bound_of_log2(double_bound(&m))]).unwrap_or_default();
        vec![r.to_string().into(), m.into(), bound.into()]
    };
    let columns = ["damping_ratio", "threshold", "uncertainty"].map(Column::new).to_vec();
    Dataset { columns, rows: map.damping.iter().map(row).collect(), ..Dataset::default() }
}

/// Returns the share of each regime in words.
pub(crate) fn regimes_text(map: &Map) -> String {
    let count = map.regimes.len() as f64;
    let share = |is: fn(&Regime) -> bool| 100.0 * map.regimes.iter().filter(|regime| is(regime)).count() as f64 / count;
    format!(
        "{} × {} points\nbounce at t₁:  {:5.1} %\n\
         later:         {:5.1} %\nno bounce:     {:5.1} %\nnot decided:   {:5.1} %\n",
        map.damping.len(),
        map.speed.len(),
        share(|regime| *regime == Regime::Bounce(1.0)),
        share(|regime| matches!(regime, Regime::Bounce(time) if *time != 1.0)),
        share(|regime| *regime == Regime::Never),
        share(|regime| *regime == Regime::Undecided),
    )
}

/// Returns the arrays `damping_ratio`, `speed_ratio`, `bounce_ratio` (a row for each `M`; infinite without a bounce,
/// NaN if it is not decided) and `threshold` at each `R`.
pub(crate) fn regimes_npz(map: &Map) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let mut npz = Npz::new(&mut bytes, true);
    let doubles = |list: &[Number]| list.iter().map(Number::to_f64).collect::<Vec<_>>();
    let (dampings, speeds) = (doubles(&map.damping), doubles(&map.speed));
    let value = |regime: &Regime| match regime {
        Regime::Bounce(time) => *time,
        Regime::Never => f64::INFINITY,
        Regime::Undecided => f64::NAN,
    };
    let shape = [speeds.len(), dampings.len()];
    let thresholds = dampings.iter().map(|r| threshold_near(*r)).collect::<Vec<_>>();
    npz.add("damping_ratio", &shape[1..], dampings)?;
    npz.add("speed_ratio", &shape[..1], speeds)?;
    npz.add("bounce_ratio", &shape, map.regimes.iter().map(value).collect())?;
    npz.add("threshold", &shape[1..], thresholds)?;
    npz.finish()?;
    Ok(bytes.into_inner())
}

/// Returns the axis of some values and the borders between them: a value is the middle of its cell.
fn axis(label: &str, values: &[Number]) -> (Axis, CellAxis) {
    let spread = CellAxis::new(values);
    let ends = [0.0, values.len() as f64].map(|steps| spread.border(steps));
    (if spread.log { Axis::log(label, ends) } else { Axis::new(label, "", ends) }, spread)
}

/// Returns the map: a region for each band, the threshold and `R = π` as lines.
pub(crate) fn regimes_panel(map: &Map) -> Panel {
    let ((x, across), (y, up)) = (axis("R = r t₁", &map.damping), axis("M = μ/(g t₁)", &map.speed));
    let known = if map.regimes.contains(&Regime::Undecided) { COLORS.len() } else { COLORS.len() - 1 };
    let whole = [[x.from, y.from], [x.to, y.from], [x.to, y.to], [x.from, y.to]].map(DVec2::from_array).to_vec();
    let [bottom, top] = [y.from, y.to];
    let mut panel = Panel::new("when the first contact ends", x, y);
    panel.region("bands", vec![whole], COLORS[known - 1].0);
    let place = |steps: DVec2| DVec2::new(across.border(steps.x), up.border(steps.y));
    // Each band lies over those after it.
    for (lines, (color, _)) in map.regions.iter().zip(COLORS).rev().filter(|(lines, _)| !lines.is_empty()) {
        let lines = lines.iter().map(|line| line.iter().map(|point| place(*point)).collect()).collect();
        panel.region("bands", lines, color);
    }
    // Closer and closer to I₀(R) = 2, where it is infinite.
    let (mut below, mut above) = (1.8, 1.81);
    for _ in 0..60 {
        let middle: f64 = (below + above) / 2.0;
        *(if threshold_near(middle).is_finite() { &mut below } else { &mut above }) = middle;
    }
    let curve = (0..=800).map(|k| below * (1.0 - (-f64::from(k) / 20.0).exp2()));
    let curve = curve.map(|r| DVec2::new(r, threshold_near(r))).filter(|point| point.y.is_finite()).collect();
    let pi = [bottom, top].map(|m| DVec2::new(std::f64::consts::PI, m)).to_vec();
    // Apart from every colour of the map, and from paper.
    let (solid, dashed) = (Stroke::new("#ff5a1f", 0.6), Stroke::new("#000000", 0.25).dashed("1.8 1.2"));
    panel.lines("threshold", vec![curve], solid);
    panel.lines("curve", vec![pi], dashed);
    panel.legend = COLORS[..known].iter().map(|(color, text)| Key::area(*text, color)).collect();
    panel.legend.push(Key::line("M = (I₀(R) + I₁(R))/(2 − I₀(R))", solid));
    panel.legend.push(Key::line("R = π", dashed));
    panel
}

pub(crate) fn regimes_svg(map: &Map) -> String {
    Sheet { title: Vec::new(), panels: vec![regimes_panel(map)] }.svg(Size::Page)
}
