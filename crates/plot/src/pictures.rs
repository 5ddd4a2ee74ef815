//! Panels of what a history answers.

use std::collections::BTreeMap;

use glam::DVec2;

use super::cells::{Break, Cells, MOST_RAYS, Values};
use super::gather::{Asked, Gathered, Line, UNSEEN};
use super::picture::Picture;
use crate::draw::{
    AREAS, Anchor, Axis, Key, LINES, Mark, Panel, Piece, Shape, Sheet, Stroke, diverging, plain, thinned,
};
use dalembert::number::Scalar;
use dalembert::quantity::{Measure, Quantity};

/// The times on the ground, in every picture.
const CONTACT: &str = "#dcdcdc";
/// A contact shorter than this share of the axis is a mark: its band would be a hairline.
const SHORT: f64 = 1.0 / 200.0;
/// The lowest part of a picture, where bars and marks of contacts stand.
const FLOOR: f64 = 0.05;
/// Rays by the shares of the greatest jump that they carry: fainter ones are not drawn.
const RAYS: [(f64, Stroke); 4] = [
    (0.5, Stroke::new("#000000", 0.12)),
    (0.2, Stroke::new("#4a4a4a", 0.1)),
    (0.05, Stroke::new("#808080", 0.08)),
    (0.01, Stroke::new("#a8a8a8", 0.06)),
];
const ZERO: Stroke = Stroke::new("#808080", 0.15);
const KINK: Stroke = Stroke::new("#707070", 0.1).dashed("0.8 0.6");
const JUMP: &str = "0.5 0.5";
const WIDTH: f64 = 0.4;
/// Lines of scenes and of quantities in one picture.
const DASHES: [&str; 3] = ["", "2 0.9", "0.5 0.7"];
/// Bars of so many scenes have their values above them.
const MOST_TOLD: usize = 3;
const MOST_JUMPS: usize = 2000;

/// The pictures asked for, of all scenes.
///
/// **Errors**: the pictures of scenes whose units differ, as the symbol and both units.
pub fn sheet(asked: &Asked, scenes: &[Gathered], title: Vec<String>) -> Result<Sheet, String> {
    let mut panels = Vec::new();
    for picture in &asked.pictures {
        match picture {
            Picture::Along | Picture::Energy => {
                let first = panels.len();
                for scene in scenes {
                    let mut panel = match picture {
                        Picture::Energy => energy(scene, scenes),
                        _ => along(asked, scene, scenes),
                    };
                    if scenes.len() > 1 {
                        panel.title = format!("{}: {}", plain(&scene.name), panel.title);
                    }
                    panels.push(panel);
                }
                let of_scene = &mut panels[first..];
                let low = of_scene.iter().map(|panel| panel.y.from).fold(f64::INFINITY, f64::min);
                let high = of_scene.iter().map(|panel| panel.y.to).fold(f64::NEG_INFINITY, f64::max);
                of_scene.iter_mut().for_each(|panel| (panel.y.from, panel.y.to) = (low, high));
            }
            _ => panels.push(lines(*picture, scenes)?),
        }
    }
    let mut sheet = Sheet { title, panels };
    // One legend tells the scenes apart.
    sheet.say_once(|text| scenes.len() > 1 && scenes.iter().any(|scene| text == plain(&scene.name)));
    Ok(sheet)
}

pub(super) fn time_axis(scenes: &[Gathered]) -> Axis {
    let from = scenes.iter().map(|scene| scene.span[0]).fold(f64::INFINITY, f64::min);
    let to = scenes.iter().map(|scene| scene.span[1]).fold(0.0, f64::max);
    Axis::new("t", scenes.first().map_or("", |scene| scene.units.name(Measure::Time)), [from, to])
}

fn points(line: &[(f64, f64)]) -> Vec<DVec2> {
    line.iter().map(|point| (*point).into()).collect()
}

/// Adds the times on the ground: bands from the lower edge up to a height, and a mark above that edge for each that is
/// too short for a band.
fn contacts(panel: &mut Panel, scene: &Gathered, high: f64) {
    let Panel { x, y, .. } = &*panel;
    // One that the span cuts is drawn as far as it is in it.
    let cut = |[from, to]: &[f64; 2]| *from < x.from || *to > x.to;
    let short = |contact: &[f64; 2]| contact[1] - contact[0] < SHORT * (x.to - x.from) && !cut(contact);
    let (marks, bands): (Vec<[f64; 2]>, Vec<[f64; 2]>) = scene.contacts.iter().copied().partition(short);
    let band =
        |[from, to]: &[f64; 2]| [(*from, y.from), (*to, y.from), (*to, high), (*from, high)].map(DVec2::from).to_vec();
    let height = y.from + 0.5 * FLOOR * (y.to - y.from);
    let mark = |[from, to]: &[f64; 2]| DVec2::new((0.5 * (from + to)).clamp(x.from, x.to), height);
    let (bands, marks) = (bands.iter().map(band).collect::<Vec<_>>(), marks.iter().map(mark).collect::<Vec<_>>());
    if !bands.is_empty() {
        panel.add("contacts", Shape::Areas(bands, CONTACT));
        panel.legend.push(Key::Area("contact".into(), CONTACT));
    }
    if !marks.is_empty() {
        panel.add("contacts", Shape::Marks(marks, Mark::Triangle, CONTACT));
        panel.legend.push(Key::Mark("short contact".into(), Mark::Triangle, CONTACT));
    }
}

/// Lines over time, or over bounces, of all scenes.
fn lines(picture: Picture, scenes: &[Gathered]) -> Result<Panel, String> {
    if picture == Picture::Restitution {
        return Ok(restitution(scenes));
    }
    let columns = if picture == Picture::Stress { vec![Quantity::Stress] } else { picture.columns() };
    let stretches = |scene, column| if picture == Picture::Stress { stress(scene) } else { scene.lines(column) };
    let curves = scenes.iter().flat_map(|scene| columns.iter().map(move |column| (scene, *column)));
    let curves: Vec<(&Gathered, Vec<Line>)> =
        curves.into_iter().map(|(scene, column)| (scene, stretches(scene, column))).collect();
    let units: Vec<&str> = scenes
        .iter()
        .map(|scene| match picture {
            Picture::Stress if !scene.units.has_material() => "",
            _ => columns[0].unit(&scene.units),
        })
        .collect();
    if let Some(other) = units.iter().find(|unit| **unit != units[0]) {
        let name = |unit: &str| if unit.is_empty() { "none".into() } else { format!("`{unit}`") };
        return Err(format!("found scenes in different units, {} and {}", name(units[0]), name(other)));
    }
    let (title, label) = match picture {
        Picture::Stress if scenes.iter().all(|scene| scene.units.has_material()) => {
            ("stress at the ground", "E v_x(0,t)")
        }
        Picture::Stress => ("strain at the ground", "v_x(0,t)"),
        Picture::Quantity(column) => (short(column), symbol(column)),
        _ => ("both ends and the centre of mass", "displacement"),
    };
    let x = time_axis(scenes);
    let values = curves.iter().flat_map(|curve| curve.1.iter().flatten()).map(|(_, value)| *value);
    let y = Axis::new(label, units.first().copied().unwrap_or(""), Axis::range(values, true));
    let mut panel = Panel::new(title, x, y);
    if let [scene] = scenes {
        let high = panel.y.to;
        contacts(&mut panel, scene, high);
    }
    panel.level("zero", 0.0, ZERO);
    let each = columns.len();
    for (k, (scene, stretches)) in curves.iter().enumerate() {
        let (of_scene, of_quantity) = (k / each, k % each);
        // One scene has a colour for each quantity, several a colour for each scene. Dashes show a line below that
        // coincides with them.
        let color = if scenes.len() == 1 { of_quantity } else { of_scene };
        let look = Stroke::new(LINES[color % LINES.len()], WIDTH).dashed(DASHES[of_quantity % DASHES.len()]);
        let jumps = stretches.windows(2).filter_map(|pair| Some(points(&[*pair[0].last()?, *pair[1].first()?])));
        let jumps: Vec<Vec<DVec2>> = jumps.collect();
        if !jumps.is_empty() && jumps.len() <= MOST_JUMPS {
            panel.lines("jumps", jumps, Stroke { width: 0.15, dash: JUMP, ..look });
        }
        let stretches = stretches.iter().filter(|stretch| stretch.len() > 1);
        panel.lines("curve", stretches.map(|stretch| thinned(points(stretch))).collect(), look);
        if scenes.len() > 1 && of_quantity == 0 {
            panel.legend.push(Key::Line(plain(&scene.name), look));
        } else if scenes.len() == 1 && each > 1 {
            panel.legend.push(Key::Line(symbol(columns[of_quantity]).into(), look));
        }
    }
    if scenes.len() > 1 && each > 1 {
        for (column, dash) in columns.iter().zip(DASHES.iter().cycle()) {
            panel.legend.push(Key::Line(symbol(*column).into(), Stroke::new("#000000", WIDTH).dashed(dash)));
        }
    }
    Ok(panel)
}

/// What a column is, in a few words.
fn short(column: Quantity) -> &'static str {
    let meaning = column.meaning();
    [",", ":", " above"]
        .iter()
        .filter_map(|end| meaning.split_once(end))
        .map(|cut| cut.0)
        .min_by_key(|cut| cut.len())
        .unwrap_or(meaning)
}

/// The symbol of a column, as long as it fits beside an axis.
fn symbol(column: Quantity) -> &'static str {
    match column {
        Quantity::KineticEnergy | Quantity::StrainEnergy | Quantity::GravityEnergy => "E",
        Quantity::Contact => "contact",
        column => column.symbol(),
    }
}

/// The stress at the ground, or without a material the strain.
fn stress(scene: &Gathered) -> Vec<Line> {
    let factor = scene.units.factor::<f64>(Measure::Stress, &()).unwrap_or(1.0);
    let peak = scene
        .stress
        .iter()
        .flat_map(|piece| [piece.strain_start, piece.strain_end])
        .fold(0.0, |peak, v| f64::max(peak, v.abs()));
    let mut stretches: Vec<Line> = Vec::new();
    for piece in &scene.stress {
        let [from, to] = [piece.start.max(scene.span[0]), piece.end.min(scene.span[1])];
        let ends = [from, to].map(|t| (t, factor * piece.eval(&t)));
        match stretches.last_mut() {
            Some(last) if last.last().is_some_and(|end| (end.1 - ends[0].1).abs() <= UNSEEN * factor * peak) => {
                last.push(ends[1]);
            }
            _ => stretches.push(ends.to_vec()),
        }
    }
    stretches
}

fn restitution(scenes: &[Gathered]) -> Panel {
    let series = [("e_P", Mark::Diamond), ("e_E²", Mark::Dot)];
    let values = scenes.iter().flat_map(|scene| scene.restitution.iter().flatten().flatten().copied());
    let y = Axis::new("restitution", "", Axis::range(values.chain([1.0]), true));
    let most = scenes.iter().map(|scene| scene.restitution.len()).max().unwrap_or(0);
    if most <= 1 {
        return single_bounce(scenes, series.map(|(name, _)| name), y);
    }
    let mut x = Axis::new("bounce", "", [0.5, most as f64 + 0.5]);
    if most <= 12 {
        x.ticks = Some((1..=most).map(|k| (k as f64, k.to_string())).collect());
    }
    let mut panel = Panel::new("restitution of each bounce", x, y);
    panel.level("zero", 1.0, ZERO);
    for (s, scene) in scenes.iter().enumerate() {
        let of = if scenes.len() == 1 { String::new() } else { format!(", {}", plain(&scene.name)) };
        for (q, (name, mark)) in series.into_iter().enumerate() {
            let color = LINES[if scenes.len() == 1 { q } else { s } % LINES.len()];
            let numbered = scene.restitution.iter().enumerate().collect::<Vec<_>>();
            // No line over a bounce for which it is not defined.
            let stretches = numbered.split(|(_, pair)| pair[q].is_none()).filter(|known| !known.is_empty());
            let place = |(k, pair): &(usize, &[Option<f64>; 2])| Some(DVec2::new((k + 1) as f64, pair[q]?));
            let lines = stretches.map(|known| known.iter().filter_map(place).collect::<Vec<_>>()).collect::<Vec<_>>();
            panel.lines("curve", lines.clone(), Stroke::new(color, 0.15).dashed(DASHES[q]));
            panel.add("marks", Shape::Marks(lines.concat(), mark, color));
            panel.legend.push(Key::Mark(format!("{name}{of}"), mark, color));
        }
    }
    panel
}

/// Bars, where no scene has a second bounce: a group for each coefficient, in it one for each scene. The value of a
/// single scene stands below its bar, those of a few above theirs.
fn single_bounce(scenes: &[Gathered], names: [&str; 2], mut y: Axis) -> Panel {
    let value = |scene: &Gathered, q: usize| scene.restitution.first().and_then(|pair| pair[q]);
    let text = |value: Option<f64>, digits: u32| value.map_or_else(|| "none".into(), |value| value.decimal(digits));
    let mut x = Axis::new("first bounce", "", [0.4, 2.6]);
    let tick = |(q, of): (usize, &str)| match scenes {
        [scene] => (q as f64 + 1.0, format!("{} = {} ({of})", names[q], text(value(scene, q), 4))),
        _ => (q as f64 + 1.0, format!("{} ({of})", names[q])),
    };
    x.ticks = Some(["momentum", "energy"].into_iter().enumerate().map(tick).collect());
    let letters = 0.1 * (y.to - y.from);
    y.to += if scenes.len() > 1 { letters } else { 0.0 };
    let wide = 0.8 / scenes.len().max(1) as f64;
    let mut panel = Panel::new("restitution of the bounce", x, y);
    let mut notes = Vec::new();
    for (s, scene) in scenes.iter().enumerate() {
        let color = LINES[s % LINES.len()];
        let mut bars = Vec::new();
        for q in 0..names.len() {
            let left = q as f64 + 0.6 + s as f64 * wide;
            let corner = |side: f64, height: f64| DVec2::new(left + side * wide, height);
            let value = value(scene, q);
            bars.extend(
                value.map(|top| [(0.1, 0.0), (0.9, 0.0), (0.9, top), (0.1, top)].map(|(a, b)| corner(a, b)).to_vec()),
            );
            // No line goes through a text.
            let top = value.unwrap_or(0.0).max(0.0);
            let above = if top + letters > 1.0 { top.max(1.0) } else { top } + 0.15 * letters;
            notes.push(Shape::Note(corner(0.5, above), Anchor::Middle, text(value, 3)));
        }
        panel.add("bars", Shape::Areas(bars, color));
        if scenes.len() > 1 {
            panel.legend.push(Key::Area(plain(&scene.name), color));
        }
    }
    [0.0, 1.0].into_iter().for_each(|y| panel.level("zero", y, ZERO));
    if (2..=MOST_TOLD).contains(&scenes.len()) {
        notes.into_iter().for_each(|note| panel.add("note", note));
    }
    panel
}

/// Energies on top of each other: gravity from its least, the motion of the centre of mass, the vibration. The upper
/// edge is `E`.
fn energy(scene: &Gathered, scenes: &[Gathered]) -> Panel {
    let edges = [Quantity::GravityEnergy, Quantity::TranslationalEnergy, Quantity::Energy];
    let edges = edges.map(|column| scene.lines(column).concat());
    let least = edges[0].iter().map(|(_, value)| *value).fold(f64::INFINITY, f64::min);
    let base = if least.is_finite() { least.min(0.0) } else { 0.0 };
    let x = time_axis(scenes);
    let most = edges[2].iter().map(|(_, value)| *value).fold(base, f64::max);
    let space = if most > base { 0.06 * (most - base) } else { 1.0 };
    let unit = scene.units.name(Measure::Energy);
    // Below them the times on the ground.
    let floor = base - FLOOR * (most + space - base);
    let y = Axis::new("E", unit, [floor, most + space]);
    let gravity = if base < 0.0 { format!("gravity, from {} up", y.shown(base)) } else { "gravity".into() };
    let names = [gravity, "centre of mass".into(), "vibration E_z".into()];
    let mut panel = Panel::new("energy: the upper edge is E", x, y);
    let mut below: Vec<DVec2> = edges[0].iter().map(|(t, _)| DVec2::new(*t, base)).collect();
    // Without gravity its layer is empty.
    let weightless = scene.rod.gravity == 0.0;
    for ((edge, name), color) in edges.iter().zip(names).zip(AREAS).skip(usize::from(weightless)) {
        let edge = points(edge);
        let area = [thinned(edge.clone()), thinned(below).into_iter().rev().collect()].concat();
        panel.add("area", Shape::Areas(vec![area], color));
        panel.legend.push(Key::Area(name, color));
        below = edge;
    }
    panel.lines("curve", vec![thinned(below)], Stroke::new("#000000", 0.25));
    panel.level("zero", 0.0, ZERO);
    contacts(&mut panel, scene, base);
    panel
}

fn along(asked: &Asked, scene: &Gathered, scenes: &[Gathered]) -> Panel {
    let x = time_axis(scenes);
    if asked.deformed {
        return world(scene, x);
    }
    let (length, units) = (scene.rod.length, &scene.units);
    let (measure, symbol, name) = asked.along.told(units);
    let coarse = if scene.coarse().is_some() { ", too coarse for its waves" } else { "" };
    let title = format!("{name} along the rod{coarse}");
    let mut panel = Panel::new(title, x, Axis::new("x", units.name(Measure::Length), [-FLOOR * length, length]));
    if let Some(cells) = &scene.cells {
        // Scenes side by side have one scale of colours.
        let greatest = scenes.iter().filter_map(|scene| scene.cells.as_ref()).map(|cells| cells.greatest);
        let greatest = greatest.fold(0.0, f64::max);
        panel.add("cells", field(cells, scene, greatest));
        rays(&mut panel, cells, scene);
        let axis = Axis::new(symbol, units.name(measure), [-greatest, greatest]);
        let most = axis.shown(greatest);
        panel.legend.push(Key::Colors(axis.label, [format!("−{most}"), "0".into(), most]));
    }
    contacts(&mut panel, scene, 0.0);
    panel
}

fn field(cells: &Cells, scene: &Gathered, greatest: f64) -> Shape {
    let unit = if greatest > 0.0 { greatest } else { 1.0 };
    match &cells.values {
        Values::Linear(pieces) => Shape::Pieces(
            pieces
                .iter()
                .map(|piece| Piece { middle: piece.middle / unit, slope: piece.slope / unit, ..piece.clone() })
                .collect(),
        ),
        Values::Grid(across, values) => {
            let (rows, [from, to]) = (values.len() / across, scene.span);
            let time = |column: usize| from + (to - from) * column as f64 / *across as f64;
            let place = |column, row: usize| DVec2::new(time(column), scene.rod.length * row as f64 / rows as f64);
            // Few colours, so that neighbours are often one rectangle.
            let color = |value: &f64| (value / unit * 24.0).round() as i32;
            let mut runs: BTreeMap<i32, Vec<[DVec2; 2]>> = BTreeMap::new();
            for (row, values) in values.chunks(*across).enumerate() {
                let mut column = 0;
                for run in values.chunk_by(|a, b| color(a) == color(b)) {
                    let ends = [place(column, row + 1), place(column + run.len(), row)];
                    runs.entry(color(&run[0])).or_default().push(ends);
                    column += run.len();
                }
            }
            Shape::Runs(runs.into_iter().map(|(color, ends)| (diverging(f64::from(color) / 24.0), ends)).collect())
        }
    }
}

/// Adds lines up from the ground and back: jumps, and what only bends the field.
fn rays(panel: &mut Panel, cells: &Cells, scene: &Gathered) {
    if cells.breaks.len() > MOST_RAYS {
        return;
    }
    let (length, trip) = (scene.rod.length, scene.rod.round_trip());
    let end = scene.span[1];
    let path = |from: f64| {
        let height = |time: f64| length * (1.0 - ((time - from) / (0.5 * trip) - 1.0).abs());
        let times = [from, from + 0.5 * trip, from + trip].map(|time| time.min(end));
        times.map(|time| DVec2::new(time, height(time))).to_vec()
    };
    let mut add = |wanted: &dyn Fn(&Break) -> bool, class: &'static str, look: Stroke| {
        let rays = cells.breaks.iter().filter(|ray| wanted(ray));
        let lines: Vec<Vec<DVec2>> = rays.map(|ray| path(ray.time)).collect();
        if !lines.is_empty() {
            panel.lines(class, lines, look);
        }
    };
    add(&|ray| !ray.jump, "kinks", KINK);
    let mut above = f64::INFINITY;
    for (least, look) in RAYS {
        add(&|ray| ray.jump && ray.share >= least && ray.share < above, "rays", look);
        above = least;
    }
}

/// World lines of points along the rod, with displacements as large as they can be seen.
fn world(scene: &Gathered, x: Axis) -> Panel {
    let length = scene.rod.length;
    let all = || scene.world.iter().flat_map(|(_, line)| line.iter().map(|(_, v)| v.abs()));
    let most = all().fold(0.0, f64::max);
    // Displacements below a twentieth of the rod are drawn larger, by a power of ten.
    let times = match most / length {
        share if share > 0.0 && share < 0.05 => 10f64.powf((0.3 / share).log10().floor()),
        _ => 1.0,
    };
    let line =
        |(point, line): &(f64, Line)| thinned(line.iter().map(|(t, v)| DVec2::new(*t, point + times * v)).collect());
    let lines: Vec<Vec<DVec2>> = scene.world.iter().map(line).collect();
    let heights = || lines.iter().flatten().map(|point| point.y);
    let [_, high] = Axis::range(heights(), true);
    let floor = heights().fold(0.0, f64::min) - FLOOR * (high - heights().fold(0.0, f64::min));
    let label = if times == 1.0 { "x + v".into() } else { format!("x + {times} v") };
    let y = Axis::new(&label, scene.units.name(Measure::Length), [floor, high]);
    let mut panel = Panel::new("the rod where it is", x, y);
    if let [low, inner @ .., top] = lines.as_slice() {
        let body = [low.clone(), top.iter().rev().copied().collect()].concat();
        panel.add("area", Shape::Areas(vec![body], AREAS[1]));
        panel.level("zero", 0.0, ZERO);
        panel.lines("curve", inner.to_vec(), Stroke::new("#000000", 0.12));
        panel.lines("curve", vec![low.clone(), top.clone()], Stroke::new(LINES[0], WIDTH));
    }
    panel.legend.push(Key::Area("rod".into(), AREAS[1]));
    contacts(&mut panel, scene, 0.0);
    panel
}

#[cfg(test)]
#[path = "tests/pictures.rs"]
mod tests;
