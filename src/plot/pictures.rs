//! Panels of what a history answers.

use glam::DVec2;

use super::cells::{Break, Cells, MOST_RAYS, Values};
use super::gather::{Asked, Gathered, Line, UNSEEN};
use super::picture::{Along, Picture};
use crate::draw::{
    AREAS, Anchor, Axis, Key, LINES, Layer, Mark, Panel, Piece, Shape, Sheet, Stroke, diverging, plain, thinned,
};
use crate::mapped::{CollectVec, MapEach, mapped};
use crate::number::Scalar;
use crate::quantity::{Measure, Quantity};

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
const KINK: Stroke = Stroke::new("#707070", 0.1).dashed("0.8 0.6");
const JUMP: &str = "0.5 0.5";
const WIDTH: f64 = 0.4;
/// Lines of scenes and of quantities in one picture.
const DASHES: [&str; 3] = ["", "2 0.9", "0.5 0.7"];
/// Bars of so many scenes have their values above them.
const MOST_TOLD: usize = 3;
/// More jumps than this are not drawn.
const MOST_JUMPS: usize = 2000;

/// The pictures asked for, of all scenes.
///
/// **Errors**: the pictures of scenes whose units differ, as the symbol and both units.
pub(crate) fn sheet(asked: &Asked, scenes: &[Gathered], title: Vec<String>) -> Result<Sheet, String> {
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
                let [low, high] = of_scene.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], panel| {
                    [low.min(panel.y.from), high.max(panel.y.to)]
                });
                for panel in of_scene {
                    panel.y.widen([low, high]);
                }
            }
            _ => panels.push(lines(*picture, scenes)?),
        }
    }
    // One legend tells the scenes apart.
    if scenes.len() > 1 {
        let names: Vec<String> = mapped(scenes, |scene| plain(&scene.name));
        let mut told = false;
        for panel in &mut panels {
            let tells = panel.legend.iter().any(|key| names.iter().any(|name| key.text() == name));
            panel.legend.retain(|key| !told || !names.iter().any(|name| key.text() == name));
            told |= tells;
        }
    }
    Ok(Sheet { title, panels })
}

pub(super) fn time_axis(scenes: &[Gathered]) -> Axis {
    let from = scenes.iter().map(|scene| scene.span[0]).fold(f64::INFINITY, f64::min);
    let to = scenes.iter().map(|scene| scene.span[1]).fold(0.0, f64::max);
    Axis::new("t", scenes.first().map_or("", |scene| scene.units.name(Measure::Time)), [from, to])
}

fn points(line: &[(f64, f64)]) -> Vec<DVec2> {
    thinned(mapped(line, |(t, value)| DVec2::new(*t, *value)))
}

/// The times on the ground, with their keys: bands from the lower edge up to a height, and a mark above that edge for
/// each that is too short for a band.
fn contacts(scene: &Gathered, x: &Axis, y: &Axis, high: f64) -> Vec<(Layer, Key)> {
    // One that the span cuts is drawn as far as it is in it.
    let cut = |[from, to]: &[f64; 2]| *from < x.from || *to > x.to;
    let short = |contact: &[f64; 2]| contact[1] - contact[0] < SHORT * (x.to - x.from) && !cut(contact);
    let (marks, bands): (Vec<[f64; 2]>, Vec<[f64; 2]>) = scene.contacts.iter().copied().partition(short);
    let band = |[from, to]: &[f64; 2]| {
        [(*from, y.from), (*to, y.from), (*to, high), (*from, high)]
            .map_each(|(t, value)| DVec2::new(t, value))
            .to_vec()
    };
    let height = y.from + 0.5 * FLOOR * (y.to - y.from);
    let mark = |[from, to]: &[f64; 2]| DVec2::new((0.5 * (from + to)).clamp(x.from, x.to), height);
    let bands = (!bands.is_empty()).then(|| {
        let bands = Shape::Areas(mapped(&bands, band), CONTACT);
        (Layer::new("contacts", bands), Key::Area("contact".into(), CONTACT))
    });
    let marks = (!marks.is_empty()).then(|| {
        let marks = Shape::Marks(mapped(&marks, mark), Mark::Triangle, CONTACT);
        (Layer::new("contacts", marks), Key::Mark("short contact".into(), Mark::Triangle, CONTACT))
    });
    bands.into_iter().chain(marks).collect_vec()
}

fn zero(x: &Axis) -> Layer {
    let line = vec![DVec2::new(x.from, 0.0), DVec2::new(x.to, 0.0)];
    Layer::new("zero", Shape::Lines(vec![line], Stroke::new("#808080", 0.15)))
}

/// One line of a scene: its smooth stretches, with the symbol of the quantity.
struct Curve<'a> {
    symbol: &'static str,
    scene: &'a Gathered,
    stretches: Vec<Line>,
}

/// Lines over time, or over bounces, of all scenes.
fn lines(picture: Picture, scenes: &[Gathered]) -> Result<Panel, String> {
    if picture == Picture::Restitution {
        return Ok(restitution(scenes));
    }
    let mut curves: Vec<Curve<'_>> = Vec::new();
    for scene in scenes {
        match picture {
            Picture::Stress => curves.push(stress(scene)),
            picture => curves.extend(picture.columns().into_iter().map(|column| {
                let found = scene.columns.iter().find(|found| found.0 == column);
                let stretches = found.map_or_else(Vec::new, |found| found.1.clone());
                Curve { symbol: symbol(column), scene, stretches }
            })),
        }
    }
    let units: Vec<&str> = mapped(scenes, |scene| unit(picture, scene));
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
    let values = curves.iter().flat_map(|curve| curve.stretches.iter().flatten()).map(|(_, value)| *value);
    let y = Axis::new(label, units.first().copied().unwrap_or(""), Axis::range(values, true));
    let (mut layers, mut legend) = (Vec::new(), Vec::new());
    if let [scene] = scenes {
        (layers, legend) = contacts(scene, &x, &y, y.to).into_iter().unzip();
    }
    layers.push(zero(&x));
    let each = curves.len() / scenes.len().max(1);
    for (k, curve) in curves.iter().enumerate() {
        let (of_scene, of_quantity) = (k / each.max(1), k % each.max(1));
        // One scene has a colour for each quantity, several a colour for each scene. Dashes show a line below that
        // coincides with them.
        let color = if scenes.len() == 1 { of_quantity } else { of_scene };
        let look = Stroke::new(LINES[color % LINES.len()], WIDTH).dashed(DASHES[of_quantity % DASHES.len()]);
        let jumps = curve.stretches.windows(2).filter_map(|pair| {
            let ends = [pair[0].last()?, pair[1].first()?];
            Some(ends.map(|(t, value)| DVec2::new(*t, *value)).to_vec())
        });
        let jumps: Vec<Vec<DVec2>> = jumps.collect_vec();
        if !jumps.is_empty() && jumps.len() <= MOST_JUMPS {
            layers.push(Layer::new("jumps", Shape::Lines(jumps, Stroke { width: 0.15, dash: JUMP, ..look })));
        }
        let stretches = curve.stretches.iter().filter(|stretch| stretch.len() > 1);
        layers.push(Layer::new("curve", Shape::Lines(stretches.map(|stretch| points(stretch)).collect_vec(), look)));
        match (scenes.len(), each) {
            (1, 1) => (),
            (1, _) => legend.push(Key::Line(curve.symbol.into(), look)),
            _ if of_quantity == 0 => legend.push(Key::Line(plain(&curve.scene.name), look)),
            _ => (),
        }
    }
    if scenes.len() > 1 && each > 1 {
        let keys = curves.iter().take(each).zip(DASHES.iter().cycle());
        legend.extend(
            keys.map(|(curve, dash)| Key::Line(curve.symbol.into(), Stroke::new("#000000", WIDTH).dashed(dash))),
        );
    }
    Ok(Panel { title: title.into(), x, y, layers, legend })
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

fn unit(picture: Picture, scene: &Gathered) -> &'static str {
    match picture {
        Picture::Stress if scene.units.has_material() => scene.units.name(Measure::Stress),
        Picture::Motion => scene.units.name(Measure::Length),
        Picture::Quantity(column) => column.unit(&scene.units),
        Picture::Along | Picture::Stress | Picture::Energy | Picture::Restitution => "",
    }
}

fn stress(scene: &Gathered) -> Curve<'_> {
    let factor = scene.units.factor::<f64>(Measure::Stress, &()).unwrap_or(1.0);
    let peak =
        scene.stress.iter().flat_map(|piece| [piece.left, piece.right]).fold(0.0, |peak, v| f64::max(peak, v.abs()));
    let mut stretches: Vec<Line> = Vec::new();
    for piece in &scene.stress {
        let [from, to] = [piece.from.max(scene.span[0]), piece.to.min(scene.span[1])];
        let ends = [from, to].map_each(|t| (t, factor * piece.eval(&t)));
        match stretches.last_mut() {
            Some(last) if last.last().is_some_and(|end| (end.1 - ends[0].1).abs() <= UNSEEN * factor * peak) => {
                last.push(ends[1]);
            }
            _ => stretches.push(ends.to_vec()),
        }
    }
    Curve { symbol: "v_x(0,t)", scene, stretches }
}

fn restitution(scenes: &[Gathered]) -> Panel {
    let series = [("e_P", Mark::Diamond), ("e_E²", Mark::Dot)];
    let values = scenes.iter().flat_map(|scene| scene.restitution.iter().flatten().flatten().copied());
    let most = scenes.iter().map(|scene| scene.restitution.len()).max().unwrap_or(0);
    if most <= 1 {
        return single_bounce(scenes, series.map(|(name, _)| name));
    }
    let mut x = Axis::new("bounce", "", [0.5, most.max(1) as f64 + 0.5]);
    if most <= 12 {
        x.ticks = Some(mapped(1..=most, |k| (k as f64, k.to_string())));
    }
    let y = Axis::new("restitution", "", Axis::range(values.chain([1.0]), true));
    let one = vec![DVec2::new(x.from, 1.0), DVec2::new(x.to, 1.0)];
    let mut layers = vec![Layer::new("zero", Shape::Lines(vec![one], Stroke::new("#808080", 0.15)))];
    let mut legend = Vec::new();
    for (s, scene) in scenes.iter().enumerate() {
        for (q, (name, mark)) in series.into_iter().enumerate() {
            let color = LINES[if scenes.len() == 1 { q } else { s } % LINES.len()];
            let numbered = scene.restitution.iter().enumerate().collect_vec();
            // No line over a bounce for which it is not defined.
            let stretches = numbered.split(|(_, pair)| pair[q].is_none()).map(|known| {
                known.iter().filter_map(|(k, pair)| Some(DVec2::new((k + 1) as f64, pair[q]?))).collect_vec()
            });
            let lines: Vec<Vec<DVec2>> = stretches.filter(|line| !line.is_empty()).collect_vec();
            let dots = lines.concat();
            let line = Stroke { dash: DASHES[q], ..Stroke::new(color, 0.15) };
            layers.push(Layer::new("curve", Shape::Lines(lines, line)));
            layers.push(Layer::new("marks", Shape::Marks(dots, mark, color)));
            let of = if scenes.len() == 1 { String::new() } else { format!(", {}", plain(&scene.name)) };
            legend.push(Key::Mark(format!("{name}{of}"), mark, color));
        }
    }
    Panel { title: "restitution of each bounce".into(), x, y, layers, legend }
}

/// Bars, where no scene has a second bounce: a group for each coefficient, in it one for each scene. The value of a
/// single scene stands below its bar, those of a few above theirs.
fn single_bounce(scenes: &[Gathered], names: [&str; 2]) -> Panel {
    let value = |scene: &Gathered, q: usize| scene.restitution.first().and_then(|pair| pair[q]);
    let text = |value: Option<f64>, digits: u32| value.map_or_else(|| "none".into(), |value| value.decimal(digits));
    let mut x = Axis::new("first bounce", "", [0.4, 2.6]);
    let tick = |(q, of): (usize, &str)| match scenes {
        [scene] => format!("{} = {} ({of})", names[q], text(value(scene, q), 4)),
        _ => format!("{} ({of})", names[q]),
    };
    let of = ["momentum", "energy"].into_iter().enumerate();
    x.ticks = Some(mapped(of, |(q, of)| (q as f64 + 1.0, tick((q, of)))));
    let values = scenes.iter().flat_map(|scene| scene.restitution.iter().flatten().flatten().copied());
    let mut y = Axis::new("restitution", "", Axis::range(values.chain([1.0]), true));
    let letters = 0.1 * (y.to - y.from);
    y.to += if scenes.len() > 1 { letters } else { 0.0 };
    let one = vec![DVec2::new(x.from, 1.0), DVec2::new(x.to, 1.0)];
    let wide = 0.8 / scenes.len().max(1) as f64;
    let (mut layers, mut notes, mut legend) = (Vec::new(), Vec::new(), Vec::new());
    for (s, scene) in scenes.iter().enumerate() {
        let color = LINES[s % LINES.len()];
        let mut bars = Vec::new();
        for q in 0..names.len() {
            let left = q as f64 + 0.6 + s as f64 * wide;
            let corner = |side: f64, height: f64| DVec2::new(left + side * wide, height);
            let value = value(scene, q);
            bars.extend(
                value.map(|top| [(0.1, 0.0), (0.9, 0.0), (0.9, top), (0.1, top)].map_each(|(a, b)| corner(a, b))),
            );
            // No line goes through a text.
            let top = value.unwrap_or(0.0).max(0.0);
            let above = if top + letters > 1.0 { top.max(1.0) } else { top } + 0.15 * letters;
            notes.push(Layer::new("note", Shape::Note(corner(0.5, above), Anchor::Middle, text(value, 3))));
        }
        layers.push(Layer::new("bars", Shape::Areas(mapped(bars, |bar| bar.to_vec()), color)));
        if scenes.len() > 1 {
            legend.push(Key::Area(plain(&scene.name), color));
        }
    }
    layers.push(zero(&x));
    layers.push(Layer::new("zero", Shape::Lines(vec![one], Stroke::new("#808080", 0.15))));
    layers.extend(notes.into_iter().filter(|_| (2..=MOST_TOLD).contains(&scenes.len())));
    Panel { title: "restitution of the bounce".into(), x, y, layers, legend }
}

/// Energies on top of each other: gravity from its least, the motion of the centre of mass, the vibration. The upper
/// edge is `E`.
fn energy(scene: &Gathered, scenes: &[Gathered]) -> Panel {
    let column = |column: Quantity| {
        let found = scene.columns.iter().find(|found| found.0 == column);
        found.map_or_else(Vec::new, |found| found.1.concat())
    };
    let edges = [Quantity::GravityEnergy, Quantity::TranslationalEnergy, Quantity::Energy].map_each(column);
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
    let mut below: Vec<DVec2> = mapped(&edges[0], |(t, _)| DVec2::new(*t, base));
    let (mut layers, mut legend) = (Vec::new(), Vec::new());
    // Without gravity its layer is empty.
    let weightless = scene.rod.gravity == 0.0;
    for ((edge, name), color) in edges.iter().zip(names).zip(AREAS).skip(usize::from(weightless)) {
        let edge: Vec<DVec2> = mapped(edge, |(t, value)| DVec2::new(*t, *value));
        let area = [thinned(edge.clone()), thinned(below).into_iter().rev().collect_vec()].concat();
        layers.push(Layer::new("area", Shape::Areas(vec![area], color)));
        legend.push(Key::Area(name, color));
        below = edge;
    }
    layers.push(Layer::new("curve", Shape::Lines(vec![thinned(below)], Stroke::new("#000000", 0.25))));
    layers.push(zero(&x));
    let (bars, keys): (Vec<Layer>, Vec<Key>) = contacts(scene, &x, &y, base).into_iter().unzip();
    layers.extend(bars);
    legend.extend(keys);
    Panel { title: "energy: the upper edge is E".into(), x, y, layers, legend }
}

/// The rod over time.
fn along(asked: &Asked, scene: &Gathered, scenes: &[Gathered]) -> Panel {
    let x = time_axis(scenes);
    let unit = scene.units.name(Measure::Length);
    if asked.deformed {
        return world(scene, x);
    }
    let length = scene.rod.length;
    let y = Axis::new("x", unit, [-FLOOR * length, length]);
    let (mut layers, mut legend) = (Vec::new(), Vec::new());
    if let Some(cells) = &scene.cells {
        // Scenes side by side have one scale of colours.
        let greatest = scenes.iter().filter_map(|scene| scene.cells.as_ref()).map(|cells| cells.greatest);
        let greatest = greatest.fold(0.0, f64::max);
        layers.push(Layer::new("cells", field(cells, scene, greatest)));
        layers.extend(rays(cells, scene));
        legend.push(colors(asked.along, greatest, scene));
    }
    let (bars, keys): (Vec<Layer>, Vec<Key>) = contacts(scene, &x, &y, 0.0).into_iter().unzip();
    layers.extend(bars);
    legend.extend(keys);
    let coarse = if scene.coarse().is_some() { ", too coarse for its waves" } else { "" };
    let title = format!("{} along the rod{coarse}", asked.along.name(&scene.units));
    Panel { title, x, y, layers, legend }
}

/// The key to the colours.
fn colors(along: Along, greatest: f64, scene: &Gathered) -> Key {
    let unit = scene.units.name(along.measure(&scene.units));
    let axis = Axis::new(along.symbol(&scene.units), unit, [-greatest, greatest]);
    let most = axis.shown(greatest);
    Key::Colors(axis.label, [format!("−{most}"), "0".into(), most])
}

fn field(cells: &Cells, scene: &Gathered, greatest: f64) -> Shape {
    let unit = if greatest > 0.0 { greatest } else { 1.0 };
    match &cells.values {
        Values::Linear(pieces) => {
            let share =
                |piece: &Piece| Piece { middle: piece.middle / unit, slope: piece.slope / unit, ..piece.clone() };
            Shape::Pieces(mapped(pieces, share))
        }
        Values::Grid(across, values) => {
            let rows = values.len() / across;
            let [from, to] = scene.span;
            let place = |column: usize, row: usize| {
                DVec2::new(
                    from + (to - from) * column as f64 / *across as f64,
                    scene.rod.length * row as f64 / rows as f64,
                )
            };
            // Few colours, so that neighbours are often one rectangle.
            let color = |value: &f64| (value / unit * 24.0).round() as i32;
            let mut runs: std::collections::BTreeMap<i32, Vec<[DVec2; 2]>> = std::collections::BTreeMap::new();
            for (row, values) in values.chunks(*across).enumerate() {
                let mut column = 0;
                for run in values.chunk_by(|a, b| color(a) == color(b)) {
                    let ends = [place(column, row + 1), place(column + run.len(), row)];
                    runs.entry(color(&run[0])).or_default().push(ends);
                    column += run.len();
                }
            }
            Shape::Runs(mapped(runs, |(color, ends)| (diverging(f64::from(color) / 24.0), ends)))
        }
    }
}

/// Lines up from the ground and back: jumps, and what only bends the field.
fn rays(cells: &Cells, scene: &Gathered) -> Vec<Layer> {
    let (length, trip) = (scene.rod.length, scene.rod.round_trip());
    let end = scene.span[1];
    let path = |from: f64| {
        let height = |time: f64| length * (1.0 - ((time - from) / (0.5 * trip) - 1.0).abs());
        let times = [from, from + 0.5 * trip, from + trip].map_each(|time| time.min(end));
        times.map(|time| DVec2::new(time, height(time))).to_vec()
    };
    let few = |lines: &Vec<Vec<DVec2>>| !lines.is_empty() && cells.breaks.len() <= MOST_RAYS;
    let of = |wanted: &dyn Fn(&Break) -> bool, class: &'static str, look: Stroke| {
        let lines: Vec<Vec<DVec2>> =
            cells.breaks.iter().filter(|ray| wanted(ray)).map(|ray| path(ray.time)).collect_vec();
        Some(lines).filter(few).map(|lines| Layer::new(class, Shape::Lines(lines, look)))
    };
    let mut layers: Vec<Layer> = of(&|ray| !ray.jump, "kinks", KINK).into_iter().collect_vec();
    let mut above = f64::INFINITY;
    for (least, look) in RAYS {
        layers.extend(of(&|ray| ray.jump && ray.share >= least && ray.share < above, "rays", look));
        above = least;
    }
    layers
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
    let line = |(point, line): &(f64, Line)| thinned(mapped(line, |(t, v)| DVec2::new(*t, point + times * v)));
    let lines: Vec<Vec<DVec2>> = mapped(&scene.world, line);
    let heights = || lines.iter().flatten().map(|point| point.y);
    let [_, high] = Axis::range(heights(), true);
    let floor = heights().fold(0.0, f64::min) - FLOOR * (high - heights().fold(0.0, f64::min));
    let label = if times == 1.0 { "x + v".into() } else { format!("x + {times} v") };
    let y = Axis::new(&label, scene.units.name(Measure::Length), [floor, high]);
    let body = match (lines.first(), lines.last()) {
        (Some(low), Some(top)) => [low.clone(), top.iter().rev().copied().collect_vec()].concat(),
        _ => Vec::new(),
    };
    let ends = [lines.first(), lines.last()].into_iter().flatten().cloned().collect_vec();
    let inner = lines.iter().skip(1).take(lines.len().saturating_sub(2)).cloned().collect_vec();
    let (bars, keys): (Vec<Layer>, Vec<Key>) = contacts(scene, &x, &y, 0.0).into_iter().unzip();
    let mut layers = vec![
        Layer::new("area", Shape::Areas(vec![body], AREAS[1])),
        zero(&x),
        Layer::new("curve", Shape::Lines(inner, Stroke::new("#000000", 0.12))),
        Layer::new("curve", Shape::Lines(ends, Stroke::new(LINES[0], WIDTH))),
    ];
    layers.extend(bars);
    let legend = [Key::Area("rod".into(), AREAS[1])].into_iter().chain(keys).collect_vec();
    Panel { title: "the rod where it is".into(), x, y, layers, legend }
}

#[cfg(test)]
#[path = "tests/pictures.rs"]
mod tests;
