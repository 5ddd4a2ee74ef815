//! Panels of the pictures of scenes.

use std::collections::BTreeMap;

use dalembert::number::Scalar;
use dalembert::quantity::{Measure, Quantity};
use glam::DVec2;

use crate::draw::{
    AREAS, Anchor, Axis, FieldPiece, Key, LINES, Mark, Panel, Shape, Sheet, Stroke, diverging, thinned,
    without_subscripts,
};
use crate::field::{COLUMNS, FieldMap, FieldValues, MAX_RAYS, ROWS, Ray};
use crate::picture::Picture;
use crate::scene_data::{Curve, Request, SMALLEST_JUMP, SceneData, time_axis};

/// Colour of the times on the ground.
const CONTACT: &str = "#dcdcdc";
/// Share of the axis below which a contact is a mark: its band would be a hairline.
const SHORT: f64 = 1.0 / 200.0;
/// Share of a panel, at its lower edge, for bands and marks of contacts.
const FLOOR: f64 = 0.05;
/// Styles of rays by their least share of the greatest jump. Fainter rays are not drawn.
const RAYS: [(f64, Stroke); 4] = [
    (0.5, Stroke::new("#000000", 0.12)),
    (0.2, Stroke::new("#4a4a4a", 0.1)),
    (0.05, Stroke::new("#808080", 0.08)),
    (0.01, Stroke::new("#a8a8a8", 0.06)),
];
const ZERO: Stroke = Stroke::new("#808080", 0.15);
/// Style of a rigid body.
const RIGID: Stroke = Stroke::new("#000000", 1.2);
/// Style of rays across which only the slope of the field jumps.
const KINK: Stroke = Stroke::new("#707070", 0.1).dashed("0.8 0.6");
const JUMP: Stroke = Stroke::new("#000000", 0.15).dashed("0.5 0.5");
const CURVE_WIDTH: f64 = 0.4;
/// Dashes of curves that share a panel.
const DASHES: [&str; 3] = ["", "2 0.9", "0.5 0.7"];
/// Number of scenes above which bars have no values above them.
const MAX_NOTED: usize = 3;
const MAX_JUMPS: usize = 2000;

/// Refusal to draw scenes with different units in one panel.
#[derive(Debug, thiserror::Error)]
#[error("found scenes in different units, {first} and {other}, expected one unit")]
pub struct UnitsDiffer {
    first: String,
    other: String,
}

impl Request {
    /// Returns the pictures of all scenes.
    ///
    /// **Errors**: [`UnitsDiffer`].
    pub fn sheet(&self, scenes: &[SceneData], title: Vec<String>) -> Result<Sheet, UnitsDiffer> {
        let mut panels = Vec::new();
        for picture in &self.pictures {
            match picture {
                Picture::SpaceTime if !self.heights.is_empty() => panels.push(self.stack(scenes)),
                Picture::SpaceTime if self.deformed => add_for_each(&mut panels, scenes, world_lines),
                Picture::SpaceTime => add_for_each(&mut panels, scenes, |scene, scenes| self.field(scene, scenes)),
                Picture::Energy => add_for_each(&mut panels, scenes, energy),
                Picture::Restitution => panels.push(restitution(scenes)),
                Picture::Stress | Picture::Motion | Picture::Quantity(_) => {
                    let mut panel = curves(*picture, scenes, !self.heights.is_empty())?;
                    if !self.heights.is_empty() && *picture == Picture::Quantity(Quantity::Force) {
                        panel.title = "force at the lower end of each body".into();
                    }
                    panels.push(panel);
                }
            }
        }
        let mut sheet = Sheet { title, panels };
        let names: Vec<String> = scenes.iter().map(|scene| without_subscripts(&scene.name)).collect();
        sheet.remove_repeated_keys(|text| scenes.len() > 1 && names.iter().any(|name| text == name));
        Ok(sheet)
    }

    /// Returns measure, symbol and name of the field.
    fn field_name(&self, scene: &SceneData) -> (Measure, &'static str, &'static str) {
        let measure = self.field.measure(&scene.units);
        let (symbol, name) = match measure {
            Measure::Stress => ("E v_x", "stress"),
            Measure::Strain => ("v_x", "strain"),
            _ => ("v_t", "velocity"),
        };
        (measure, symbol, name)
    }

    /// Returns the panel of a field with its rays.
    fn field(&self, scene: &SceneData, scenes: &[SceneData]) -> Panel {
        let (length, units) = (scene.rod.length, &scene.units);
        let (_, _, name) = self.field_name(scene);
        let coarse = if scene.coarse_columns().is_some() { ", too coarse for its waves" } else { "" };
        let y = Axis::new("x", units.name(Measure::Length), [-FLOOR * length, length]);
        let mut panel = Panel::new(format!("{name} along the rod{coarse}"), time_axis(scenes), y);
        self.add_field(&mut panel, (scene, scenes), 0.0);
        add_contacts(&mut panel, scene, 0.0);
        panel
    }

    /// Adds the field of a scene, in the scale of colours of all scenes, and its rays, both raised by `height`.
    fn add_field(&self, panel: &mut Panel, (scene, scenes): (&SceneData, &[SceneData]), height: f64) {
        let Some(field) = &scene.field else { return };
        let limits = scenes.iter().filter_map(|scene| scene.field.as_ref()).map(|field| field.color_limit);
        let limit = limits.fold(0.0, f64::max);
        panel.add("cells", field_shape(field, scene, limit, height));
        let (measure, symbol, _) = self.field_name(scene);
        let axis = Axis::new(symbol, scene.units.name(measure), [-limit, limit]);
        let text = axis.short(limit);
        let key = Key::colors(axis.label, [format!("−{text}"), "0".into(), text]);
        if panel.legend.is_empty() {
            panel.legend.push(key);
        }
        add_rays(panel, field, scene, height);
    }

    /// Returns the panel of the fields of all bodies of a chain, each at its height.
    fn stack(&self, scenes: &[SceneData]) -> Panel {
        let top = scenes.iter().zip(&self.heights).map(|(scene, height)| height + scene.rod.length).fold(0.0, f64::max);
        let name = scenes.first().map_or("field", |scene| self.field_name(scene).2);
        let unit = scenes.first().map_or("", |scene| scene.units.name(Measure::Length));
        let y = Axis::new("x", unit, [-FLOOR * top, (1.0 + FLOOR) * top]);
        let mut panel = Panel::new(format!("{name} along the bodies, gaps enlarged"), time_axis(scenes), y);
        let mut below = -FLOOR * top;
        for (scene, height) in scenes.iter().zip(&self.heights) {
            self.add_field(&mut panel, (scene, scenes), *height);
            let closed = scene.contacts.iter().map(|[from, to]| rectangle([*from, below], [*to, *height])).collect();
            panel.areas("contacts", closed, CONTACT);
            below = height + scene.rod.length;
            if scene.is_rigid() {
                panel.level("mass", *height, RIGID);
            } else {
                [*height, below].into_iter().for_each(|y| panel.level("end", y, ZERO));
            }
        }
        if scenes.iter().any(|scene| !scene.contacts.is_empty()) {
            panel.legend.push(Key::area("contact", CONTACT));
        }
        if scenes.iter().any(SceneData::is_rigid) {
            panel.legend.push(Key::line("rigid mass", RIGID));
        }
        panel
    }
}

/// Adds a panel for each scene, all with one vertical axis.
fn add_for_each(panels: &mut Vec<Panel>, scenes: &[SceneData], panel: impl Fn(&SceneData, &[SceneData]) -> Panel) {
    let mut added: Vec<Panel> = scenes.iter().map(|scene| panel(scene, scenes)).collect();
    let from = added.iter().map(|panel| panel.y.from).fold(f64::INFINITY, f64::min);
    let to = added.iter().map(|panel| panel.y.to).fold(f64::NEG_INFINITY, f64::max);
    for (panel, scene) in added.iter_mut().zip(scenes) {
        (panel.y.from, panel.y.to) = (from, to);
        if scenes.len() > 1 {
            panel.title = format!("{}: {}", without_subscripts(&scene.name), panel.title);
        }
    }
    panels.append(&mut added);
}

/// Adds the times on the ground: bands from the lower edge up to a height, and marks for contacts that are too short
/// for a band.
fn add_contacts(panel: &mut Panel, scene: &SceneData, height: f64) {
    let Panel { x, y, .. } = &*panel;
    // A contact that the span cuts has a band, however short it is.
    let cut = |[from, to]: &[f64; 2]| *from < x.from || *to > x.to;
    let short = |contact: &[f64; 2]| contact[1] - contact[0] < SHORT * (x.to - x.from) && !cut(contact);
    let (marks, bands): (Vec<[f64; 2]>, Vec<[f64; 2]>) = scene.contacts.iter().copied().partition(short);
    let band = |[from, to]: [f64; 2]| rectangle([from, y.from], [to, height]);
    let mark_height = y.from + 0.5 * FLOOR * (y.to - y.from);
    let mark = |[from, to]: [f64; 2]| DVec2::new((0.5 * (from + to)).clamp(x.from, x.to), mark_height);
    let bands: Vec<_> = bands.into_iter().map(band).collect();
    let marks: Vec<_> = marks.into_iter().map(mark).collect();
    if !bands.is_empty() {
        panel.areas("contacts", bands, CONTACT);
        panel.legend.push(Key::area("contact", CONTACT));
    }
    if !marks.is_empty() {
        panel.marks("contacts", marks, Mark::Triangle, CONTACT);
        panel.legend.push(Key::mark("short contact", Mark::Triangle, CONTACT));
    }
}

/// Returns the corners of a rectangle.
fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2]) -> Vec<DVec2> {
    [(left, low), (right, low), (right, high), (left, high)].map(DVec2::from).to_vec()
}

/// Returns the panel of curves over time of all scenes, which are `dashed` if those of several often coincide.
fn curves(picture: Picture, scenes: &[SceneData], dashed: bool) -> Result<Panel, UnitsDiffer> {
    let quantities = if picture == Picture::Stress { vec![Quantity::Stress] } else { picture.quantities() };
    let unit = |scene: &SceneData| match picture {
        Picture::Stress if !scene.units.has_material() => "",
        _ => quantities[0].unit(&scene.units),
    };
    let first = scenes.first().map_or("", unit);
    if let Some(other) = scenes.iter().map(unit).find(|unit| *unit != first) {
        let name = |unit: &str| if unit.is_empty() { "none".into() } else { format!("`{unit}`") };
        return Err(UnitsDiffer { first: name(first), other: name(other) });
    }
    let (title, label) = match picture {
        Picture::Stress if scenes.iter().all(|scene| scene.units.has_material()) => {
            ("stress at the ground", "E v_x(0,t)")
        }
        Picture::Stress => ("strain at the ground", "v_x(0,t)"),
        // A mass has no strain whose multiple its force is.
        Picture::Quantity(Quantity::Force) if scenes.iter().all(SceneData::is_rigid) => {
            (short_meaning(Quantity::Force), "f")
        }
        Picture::Quantity(quantity) => (short_meaning(quantity), symbol(quantity)),
        _ => ("both ends and the centre of mass", "displacement"),
    };
    let curves = |scene: &SceneData, quantity| match picture {
        Picture::Stress => stress(scene),
        _ => scene.curves(quantity),
    };
    // The curves of each scene and, in it, of each quantity.
    let groups: Vec<Vec<Curve>> =
        scenes.iter().flat_map(|scene| quantities.iter().map(move |quantity| curves(scene, *quantity))).collect();
    let values = groups.iter().flatten().flatten().map(|point| point.y);
    let mut panel = Panel::new(title, time_axis(scenes), Axis::new(label, first, Axis::range(values, true)));
    if let [scene] = scenes {
        let top = panel.y.to;
        add_contacts(&mut panel, scene, top);
    }
    panel.level("zero", 0.0, ZERO);
    let (single_scene, single_quantity) = (scenes.len() == 1, quantities.len() == 1);
    for (k, curves) in groups.into_iter().enumerate() {
        let (s, q) = (k / quantities.len(), k % quantities.len());
        // Quantities of one scene differ in colour, several scenes too. Dashes show a curve below one that coincides.
        let color = LINES[if single_scene { q } else { s } % LINES.len()];
        let dash = if dashed { s } else { q };
        let stroke = Stroke::new(color, CURVE_WIDTH).dashed(DASHES[dash % DASHES.len()]);
        let jumps = curves.windows(2).filter_map(|pair| Some(vec![*pair[0].last()?, *pair[1].first()?]));
        let jumps: Vec<Curve> = jumps.collect();
        if !jumps.is_empty() && jumps.len() <= MAX_JUMPS {
            panel.lines("jumps", jumps, Stroke { color, ..JUMP });
        }
        if curves.is_empty() {
            continue;
        }
        panel.lines("curve", curves.into_iter().filter(|curve| curve.len() > 1).map(thinned).collect(), stroke);
        if !single_scene && q == 0 {
            panel.legend.push(Key::line(without_subscripts(&scenes[s].name), stroke));
        } else if single_scene && !single_quantity {
            panel.legend.push(Key::line(symbol(quantities[q]), stroke));
        }
    }
    if !single_scene && !single_quantity {
        for (quantity, dash) in quantities.iter().zip(DASHES.iter().cycle()) {
            panel.legend.push(Key::line(symbol(*quantity), Stroke::new("#000000", CURVE_WIDTH).dashed(dash)));
        }
    }
    Ok(panel)
}

/// Returns the beginning of a quantity's meaning, up to the first punctuation.
fn short_meaning(quantity: Quantity) -> &'static str {
    let meaning = quantity.meaning();
    let cuts = [",", ":", " above"].iter().filter_map(|end| meaning.split_once(end));
    cuts.map(|cut| cut.0).min_by_key(|cut| cut.len()).unwrap_or(meaning)
}

/// Returns the symbol of a quantity, short enough for an axis.
fn symbol(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::KineticEnergy | Quantity::StrainEnergy | Quantity::GravityEnergy => "E",
        Quantity::Contact => "contact",
        quantity => quantity.symbol(),
    }
}

/// Returns the curves of the stress at the ground, or of the strain if there is no modulus.
fn stress(scene: &SceneData) -> Vec<Curve> {
    let factor = scene.units.factor::<f64>(Measure::Stress, &()).unwrap_or(1.0);
    let values = scene.stress.iter().flat_map(|piece| [piece.strain_start, piece.strain_end]);
    let smallest = SMALLEST_JUMP * factor * values.fold(0.0, |greatest, value| f64::max(greatest, value.abs()));
    let mut curves: Vec<Curve> = Vec::new();
    for piece in &scene.stress {
        let [from, to] = [piece.start.max(scene.span[0]), piece.end.min(scene.span[1])]
            .map(|time| DVec2::new(time, factor * piece.eval(&time)));
        match curves.last_mut() {
            Some(last) if last.last().is_some_and(|end| (end.y - from.y).abs() <= smallest) => last.push(to),
            _ => curves.push(vec![from, to]),
        }
    }
    curves
}

/// Returns the panel of the coefficients of restitution: over the number of the bounce, or as bars if no scene bounces
/// twice.
fn restitution(scenes: &[SceneData]) -> Panel {
    let series = [("e_P", Mark::Diamond), ("e_E²", Mark::Dot)];
    let values = scenes.iter().flat_map(|scene| scene.restitution.iter().flatten().flatten().copied());
    let y = Axis::new("restitution", "", Axis::range(values.chain([1.0]), true));
    let drawn = scenes.iter().map(|scene| scene.restitution.len()).max().unwrap_or(0);
    if drawn <= 1 {
        return single_bounce(scenes, series.map(|(name, _)| name), y);
    }
    let all = scenes.iter().map(|scene| scene.all_contacts).max().unwrap_or(0);
    let mut x = Axis::new("bounce", "", [0.5, drawn as f64 + 0.5]);
    if drawn <= 12 {
        x.ticks = Some((1..=drawn).map(|k| (k as f64, k.to_string())).collect());
    }
    let bounces = if drawn < all { format!("the first {drawn} of {all} bounces") } else { "each bounce".into() };
    let mut panel = Panel::new(format!("restitution of {bounces}"), x, y);
    panel.level("zero", 1.0, ZERO);
    for (s, scene) in scenes.iter().enumerate() {
        let name_of_scene =
            if scenes.len() == 1 { String::new() } else { format!(", {}", without_subscripts(&scene.name)) };
        for (q, (name, mark)) in series.into_iter().enumerate() {
            let color = LINES[if scenes.len() == 1 { q } else { s } % LINES.len()];
            let numbered: Vec<_> = scene.restitution.iter().map(|pair| pair[q]).zip(1..).collect();
            // The line is interrupted at a bounce for which the coefficient is not defined.
            let point = |(value, bounce): &(Option<f64>, i32)| Some(DVec2::new(f64::from(*bounce), (*value)?));
            let parts = numbered.split(|(value, _)| value.is_none()).filter(|part| !part.is_empty());
            let lines: Vec<Curve> = parts.map(|part| part.iter().filter_map(point).collect()).collect();
            panel.lines("curve", lines.clone(), Stroke::new(color, 0.15).dashed(DASHES[q]));
            panel.marks("marks", lines.concat(), mark, color);
            panel.legend.push(Key::mark(format!("{name}{name_of_scene}"), mark, color));
        }
    }
    panel
}

/// Returns the panel of the coefficients of a first bounce: a group of bars for each coefficient, with a bar for each
/// scene. The values of a single scene are below its bars, those of a few scenes above their bars.
fn single_bounce(scenes: &[SceneData], names: [&str; 2], mut y: Axis) -> Panel {
    let value = |scene: &SceneData, q: usize| scene.restitution.first().and_then(|pair| pair[q]);
    let text = |value: Option<f64>, digits: u32| value.map_or_else(|| "none".into(), |value| value.decimal(digits));
    let mut x = Axis::new("first bounce", "", [0.4, 2.6]);
    let tick = |(q, meaning): (usize, &str)| match scenes {
        [scene] => (q as f64 + 1.0, format!("{} = {} ({meaning})", names[q], text(value(scene, q), 4))),
        _ => (q as f64 + 1.0, format!("{} ({meaning})", names[q])),
    };
    x.ticks = Some(["momentum", "energy"].into_iter().enumerate().map(tick).collect());
    let text_height = 0.1 * (y.to - y.from);
    y.to += if scenes.len() > 1 { text_height } else { 0.0 };
    let width = 0.8 / scenes.len().max(1) as f64;
    let mut panel = Panel::new("restitution of the bounce", x, y);
    let mut notes = Vec::new();
    for (s, scene) in scenes.iter().enumerate() {
        let color = LINES[s % LINES.len()];
        let mut bars = Vec::new();
        for q in 0..names.len() {
            let left = q as f64 + 0.6 + s as f64 * width;
            let value = value(scene, q);
            bars.extend(value.map(|top| rectangle([left + 0.1 * width, 0.0], [left + 0.9 * width, top])));
            // A text is above the line at 1 or well below it.
            let top = value.unwrap_or(0.0).max(0.0);
            let base = if top + text_height > 1.0 { top.max(1.0) } else { top } + 0.15 * text_height;
            notes.push((DVec2::new(left + 0.5 * width, base), text(value, 3)));
        }
        panel.areas("bars", bars, color);
        if scenes.len() > 1 {
            panel.legend.push(Key::area(without_subscripts(&scene.name), color));
        }
    }
    [0.0, 1.0].into_iter().for_each(|y| panel.level("zero", y, ZERO));
    if (2..=MAX_NOTED).contains(&scenes.len()) {
        notes.into_iter().for_each(|(at, text)| panel.note("note", at, Anchor::Middle, text));
    }
    panel
}

/// Returns the panel of stacked energies: gravity from its least value, the motion of the centre of mass, and the
/// vibration. The upper edge is `E`.
fn energy(scene: &SceneData, scenes: &[SceneData]) -> Panel {
    let edges = [Quantity::GravityEnergy, Quantity::TranslationalEnergy, Quantity::Energy];
    let mut edges = edges.map(|quantity| scene.curves(quantity).concat());
    let least = edges[0].iter().map(|point| point.y).fold(f64::INFINITY, f64::min);
    let base = if least.is_finite() { least.min(0.0) } else { 0.0 };
    let greatest = edges[2].iter().map(|point| point.y).fold(base, f64::max);
    let space = if greatest > base { 0.06 * (greatest - base) } else { 1.0 };
    let floor = base - FLOOR * (greatest + space - base);
    let y = Axis::new("E", scene.units.name(Measure::Energy), [floor, greatest + space]);
    let gravity = if base < 0.0 { format!("gravity, from {} up", y.short(base)) } else { "gravity".into() };
    let mut names = [gravity, "centre of mass".into(), "vibration E_z".into()];
    let level = |curve: &Curve| curve.iter().map(|point| DVec2::new(point.x, base)).collect::<Curve>();
    if scene.is_rigid() {
        // A rigid mass has no vibration, and its curve holds its energy of height too.
        names[1] = "energy of the mass".into();
        edges = [level(&edges[2]), edges[2].clone(), Vec::new()];
    }
    let mut panel = Panel::new("energy: the upper edge is E", time_axis(scenes), y);
    let mut below = level(&edges[0]);
    // The layer of gravity is empty without gravity.
    let weightless = scene.rod.gravity == 0.0;
    let layers = edges.into_iter().zip(names).zip(AREAS).skip(usize::from(weightless));
    for ((edge, name), color) in layers.filter(|((edge, _), _)| !edge.is_empty()) {
        let area = [thinned(edge.clone()), thinned(below).into_iter().rev().collect()].concat();
        panel.areas("area", vec![area], color);
        panel.legend.push(Key::area(name, color));
        below = edge;
    }
    panel.lines("curve", vec![thinned(below)], Stroke::new("#000000", 0.25));
    panel.level("zero", 0.0, ZERO);
    add_contacts(&mut panel, scene, base);
    panel
}

/// Returns a field as a shape raised by `height`, in colours that end at `limit`.
fn field_shape(field: &FieldMap, scene: &SceneData, limit: f64, height: f64) -> Shape {
    let up = DVec2::new(0.0, height);
    let unit = if limit > 0.0 { limit } else { 1.0 };
    match &field.values {
        FieldValues::Linear(pieces) => {
            let scaled = |piece: &FieldPiece| FieldPiece {
                value: piece.value / unit,
                slope: piece.slope / unit,
                corners: piece.corners.iter().map(|corner| corner + up).collect(),
                at: piece.at + up,
            };
            Shape::Field(pieces.iter().map(scaled).collect())
        }
        FieldValues::Grid(values) => {
            let [from, to] = scene.span;
            let time = |column: usize| from + (to - from) * column as f64 / COLUMNS as f64;
            let corner =
                |column, row: usize| up + DVec2::new(time(column), scene.rod.length * row as f64 / ROWS as f64);
            // Colours are few, so that neighbours often are one rectangle.
            let color = |value: &f64| (value / unit * 24.0).round() as i32;
            let mut rectangles: BTreeMap<i32, Vec<[DVec2; 2]>> = BTreeMap::new();
            for (row, values) in values.chunks(COLUMNS).enumerate() {
                let mut column = 0;
                for run in values.chunk_by(|a, b| color(a) == color(b)) {
                    let corners = [corner(column, row + 1), corner(column + run.len(), row)];
                    rectangles.entry(color(&run[0])).or_default().push(corners);
                    column += run.len();
                }
            }
            let diverging = |color: i32| diverging(f64::from(color) / 24.0);
            Shape::Rectangles(rectangles.into_iter().map(|(color, all)| (diverging(color), all)).collect())
        }
    }
}

/// Adds the rays, from the ground to the top and back, raised by `lift`.
fn add_rays(panel: &mut Panel, field: &FieldMap, scene: &SceneData, lift: f64) {
    if field.rays.len() > MAX_RAYS {
        return;
    }
    let (length, trip, end) = (scene.rod.length, scene.rod.round_trip(), scene.span[1]);
    let path = |ray: &Ray| {
        let from = ray.departure;
        let height = |time: f64| length * (1.0 - ((time - from) / (0.5 * trip) - 1.0).abs());
        let times = [from, from + 0.5 * trip, from + trip].map(|time| time.min(end));
        let legs = usize::from(!ray.legs[0])..2 + usize::from(ray.legs[1]);
        times[legs].iter().map(|time| DVec2::new(*time, lift + height(*time))).collect()
    };
    let paths = |wanted: &dyn Fn(&Ray) -> bool| -> Vec<Curve> {
        field.rays.iter().filter(|ray| wanted(ray)).map(path).collect()
    };
    let kinks = paths(&|ray| !ray.jump);
    if !kinks.is_empty() {
        panel.lines("kinks", kinks, KINK);
        let key = Key::line("kink", KINK);
        if panel.legend.iter().all(|known| known.text != key.text) {
            panel.legend.push(key);
        }
    }
    let mut above = f64::INFINITY;
    for (least, stroke) in RAYS {
        let rays = paths(&|ray| ray.jump && ray.share >= least && ray.share < above);
        if !rays.is_empty() {
            panel.lines("rays", rays, stroke);
        }
        above = least;
    }
}

/// Returns the panel of world lines, with displacements enlarged so that they can be seen.
fn world_lines(scene: &SceneData, scenes: &[SceneData]) -> Panel {
    let displacements = scene.world_lines.iter().flat_map(|(_, curve)| curve.iter().map(|point| point.y.abs()));
    // Displacements below a twentieth of the rod are enlarged by a power of ten.
    let factor = match displacements.fold(0.0, f64::max) / scene.rod.length {
        share if share > 0.0 && share < 0.05 => 10f64.powf((0.3 / share).log10().floor()),
        _ => 1.0,
    };
    let line = |(x, curve): &(f64, Curve)| {
        thinned(curve.iter().map(|point| DVec2::new(point.x, x + factor * point.y)).collect())
    };
    let lines: Vec<Curve> = scene.world_lines.iter().map(line).collect();
    let heights = || lines.iter().flatten().map(|point| point.y);
    let [_, high] = Axis::range(heights(), true);
    let low = heights().fold(0.0, f64::min);
    let label = if factor == 1.0 { "x + v".into() } else { format!("x + {factor} v") };
    let y = Axis::new(&label, scene.units.name(Measure::Length), [low - FLOOR * (high - low), high]);
    let mut panel = Panel::new("the rod where it is", time_axis(scenes), y);
    if let [bottom, inner @ .., top] = lines.as_slice() {
        let body = [bottom.clone(), top.iter().rev().copied().collect()].concat();
        panel.areas("area", vec![body], AREAS[1]);
        panel.level("zero", 0.0, ZERO);
        panel.lines("curve", inner.to_vec(), Stroke::new("#000000", 0.12));
        panel.lines("curve", vec![bottom.clone(), top.clone()], Stroke::new(LINES[0], CURVE_WIDTH));
    }
    panel.legend.push(Key::area("rod", AREAS[1]));
    add_contacts(&mut panel, scene, 0.0);
    panel
}

#[cfg(test)]
#[path = "tests/panels.rs"]
mod tests;
