//! One picture with its axes: layers over each other, a title, and a legend above the frame, where no data is.

use std::cmp::Ordering;

use glam::DVec2;

use super::axis::Axis;
use super::clip;
use super::color::{diverging, diverging_stops};
use super::svg::{Anchor, Fill, Stroke, Svg, width};

#[derive(Clone, Debug)]
pub struct Panel {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// The first one lies lowest.
    pub layers: Vec<Layer>,
    pub legend: Vec<Key>,
}

/// Something in the coordinates of the axes.
#[derive(Clone, Debug)]
pub struct Layer {
    /// What a reader of the SVG finds it by.
    pub class: &'static str,
    pub shape: Shape,
    /// Whether it may reach over the frame.
    over: bool,
}

#[derive(Clone, Debug)]
pub enum Shape {
    Lines(Vec<Vec<DVec2>>, Stroke),
    Areas(Vec<Vec<DVec2>>, &'static str),
    /// Pieces of a field whose values are linear on each.
    Pieces(Vec<Piece>),
    /// Rows of equal colour: rectangles from corner to corner.
    Runs(Vec<(String, Vec<[DVec2; 2]>)>),
    /// What an odd number of closed lines is about, inside of the frame.
    Region(Vec<Vec<DVec2>>, &'static str),
    Marks(Vec<DVec2>, Mark, &'static str),
    /// A text beside a point.
    Note(DVec2, Anchor, String),
}

/// A convex polygon, on which a value is `middle` at `at` and changes by `slope` with the place.
#[derive(Clone, Debug)]
pub struct Piece {
    pub corners: Vec<DVec2>,
    pub at: DVec2,
    /// From −1 to 1 where it is drawn.
    pub middle: f64,
    pub slope: DVec2,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    Dot,
    /// One of many.
    Point,
    Ring,
    Square,
    Diamond,
    Triangle,
    TriangleDown,
    Pentagon,
    Cross,
    Star,
}

#[derive(Clone, Debug)]
pub enum Key {
    Line(String, Stroke),
    Area(String, &'static str),
    Mark(String, Mark, &'static str),
    /// The colours of a field, with the texts of its ends.
    Colors(String, [String; 3]),
}

impl Key {
    pub fn text(&self) -> &str {
        let (Key::Line(text, _) | Key::Area(text, _) | Key::Mark(text, ..) | Key::Colors(text, _)) = self;
        text
    }

    /// In heights of a letter.
    fn width(&self) -> f64 {
        let sign = match self {
            Key::Line(..) => 2.4,
            Key::Area(..) => 1.7,
            Key::Mark(..) => 1.4,
            Key::Colors(_, [least, _, most]) => COLORS + 1.4 + width(least) + width(most),
        };
        sign + width(self.text()) + 1.2
    }
}

/// Widths and heights in those of a letter.
const COLORS: f64 = 7.0;
const LINE: f64 = 1.55;
/// Between a title and the legend beside it.
const BESIDE: f64 = 1.6;
const TICK: f64 = 0.4;
const GRID: Stroke = Stroke::new("#e4e4e4", 0.12);
const FRAME: Stroke = Stroke::new("#000000", 0.2);

/// Where a panel stands, and what of it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Two corners of the frame.
    pub(super) frame: [DVec2; 2],
    /// Where it begins, and how wide it is, with all that is around the frame.
    pub(super) left: f64,
    pub(super) wide: f64,
    /// Whether it is one of a stack over one axis of times: its legend beside its title.
    pub(super) stacked: bool,
    /// Whether the numbers below the frame are drawn.
    pub(super) foot: bool,
}

impl Panel {
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Panel { title: title.into(), x, y, layers: Vec::new(), legend: Vec::new() }
    }

    /// Puts a layer over all others.
    pub fn add(&mut self, class: &'static str, shape: Shape) {
        self.layers.push(Layer { class, shape, over: false });
    }

    /// Puts a layer over all others that may reach over the frame.
    pub fn add_over(&mut self, class: &'static str, shape: Shape) {
        self.layers.push(Layer { class, shape, over: true });
    }

    /// Adds lines of one look.
    pub fn lines(&mut self, class: &'static str, lines: Vec<Vec<DVec2>>, stroke: Stroke) {
        self.add(class, Shape::Lines(lines, stroke));
    }

    /// Adds a line at a height.
    pub fn level(&mut self, class: &'static str, y: f64, stroke: Stroke) {
        self.lines(class, vec![vec![DVec2::new(self.x.from, y), DVec2::new(self.x.to, y)]], stroke);
    }

    /// The rows of the legend in a width of so many letters; in a stack the first one follows the title.
    fn rows(&self, most: f64, stacked: bool) -> Vec<Vec<&Key>> {
        let mut rows: Vec<Vec<&Key>> = Vec::new();
        let mut used = f64::INFINITY;
        if stacked {
            rows.push(Vec::new());
            used = width(&self.title) + BESIDE;
        }
        for key in &self.legend {
            used += key.width();
            match rows.last_mut() {
                Some(row) if used <= most => row.push(key),
                _ => {
                    used = key.width();
                    rows.push(vec![key]);
                }
            }
        }
        rows
    }

    /// Moves the label of the vertical axis into the title where it is longer than the frame is high, in letters.
    pub(super) fn label_in_title(&mut self, high: f64) {
        if width(&self.y.label) <= high {
            return;
        }
        let label = std::mem::take(&mut self.y.label);
        let symbol = label.split(" [").next().unwrap_or_default();
        // A title that ends with the symbol needs only the unit.
        self.title = match self.title.strip_suffix(symbol) {
            Some(before) => format!("{before}{label}"),
            None => format!("{}, {label}", self.title),
        };
    }

    /// The ticks of the vertical axis.
    fn up(&self, height: f64, em: f64) -> Vec<(f64, String)> {
        let ticks = self.y.ticks((height / em / 2.4).max(2.5));
        if ticks.len() > 1 {
            return ticks;
        }
        // One number is no scale: more of them, where there is room.
        let closer = self.y.ticks(5.0);
        let apart = |pair: &[(f64, String)]| (self.y.share(pair[1].0) - self.y.share(pair[0].0)) * height >= em;
        if closer.len() > 1 && closer.windows(2).all(apart) { closer } else { ticks }
    }

    /// How many numbers fit beside an axis of a height, and how wide the widest of them is, in letters.
    pub(super) fn margin(&self, height: f64, em: f64) -> f64 {
        self.up(height, em).iter().map(|tick| width(&tick.1)).fold(0.0, f64::max) + TICK + 0.5
    }

    /// Above the frame: the title and the legend.
    pub(super) fn head(&self, wide: f64, em: f64, stacked: bool) -> f64 {
        let rows = self.rows(wide / em, stacked).len();
        em * (LINE * if stacked { rows } else { 1 + rows } as f64 + 0.4)
    }

    /// Draws it; all but what is in its layers is outside of the frame.
    pub(super) fn draw(&self, svg: &mut Svg, at: Place) {
        let Place { frame: [from, to], left, wide, stacked, foot } = at;
        let (em, size) = (svg.em, to - from);
        let place = |point: DVec2| {
            let share = DVec2::new(self.x.share(point.x), 1.0 - self.y.share(point.y));
            // What lies far away is cut without a trace.
            from + share.clamp(DVec2::splat(-20.0), DVec2::splat(20.0)) * size
        };
        svg.open("panel", "");
        self.draw_head(svg, DVec2::new(left, from.y), wide, stacked);
        let right = |(value, text): (f64, String)| (from.x + self.x.share(value) * size.x, text);
        let above = |(value, text): (f64, String)| (to.y - self.y.share(value) * size.y, text);
        let (across, up) = (
            self.x.ticks(size.x / em / 4.5).into_iter().map(right).collect::<Vec<_>>(),
            self.up(size.y, em).into_iter().map(above).collect::<Vec<_>>(),
        );
        svg.open("grid", "");
        across.iter().for_each(|(x, _)| svg.line(&[DVec2::new(*x, from.y), DVec2::new(*x, to.y)], GRID));
        up.iter().for_each(|(y, _)| svg.line(&[DVec2::new(from.x, *y), DVec2::new(to.x, *y)], GRID));
        svg.close();
        for layer in &self.layers {
            // Neighbours of a field meet without a seam.
            let edges = if layer.class == "cells" { " shape-rendering=\"crispEdges\"" } else { "" };
            svg.open(layer.class, edges);
            draw_shape(svg, &layer.shape, &place, if layer.over { EVERYWHERE } else { [from, to] });
            svg.close();
        }
        svg.frame([from, to], FRAME);
        if foot {
            svg.open("axis-x", "");
            for (x, text) in across {
                svg.line(&[DVec2::new(x, to.y), DVec2::new(x, to.y + TICK * em)], FRAME);
                svg.text(DVec2::new(x, to.y + (TICK + 1.0) * em), Anchor::Middle, &text);
            }
            svg.text(DVec2::new(from.x + size.x / 2.0, to.y + (TICK + 2.35) * em), Anchor::Middle, &self.x.label);
            svg.close();
        }
        svg.open("axis-y", "");
        for (y, text) in up {
            svg.line(&[DVec2::new(from.x - TICK * em, y), DVec2::new(from.x, y)], FRAME);
            svg.text(DVec2::new(from.x - (TICK + 0.3) * em, y + 0.36 * em), Anchor::End, &text);
        }
        if !self.y.label.is_empty() {
            // A label that is longer than the frame is written smaller.
            let label = DVec2::new(left + 0.85 * em, from.y + size.y / 2.0);
            svg.text_upwards(label, &self.y.label, (size.y / em / width(&self.y.label)).min(1.0));
        }
        svg.close();
        svg.close();
    }

    fn draw_head(&self, svg: &mut Svg, at: DVec2, wide: f64, stacked: bool) {
        let em = svg.em;
        let rows = self.rows(wide / em, stacked);
        let below = if stacked { rows.len() - 1 } else { rows.len() };
        let top = at.y - em * (0.75 + LINE * below as f64);
        svg.text(DVec2::new(at.x, top), Anchor::Start, &self.title);
        if self.legend.is_empty() {
            return;
        }
        svg.open("legend", "");
        for (k, row) in rows.iter().enumerate() {
            let line = if stacked { k } else { k + 1 };
            let mut x = at.x + if line == 0 { em * (width(&self.title) + BESIDE) } else { 0.0 };
            let base = top + em * LINE * line as f64;
            for key in row {
                draw_key(svg, key, DVec2::new(x, base));
                x += em * key.width();
            }
        }
        svg.close();
    }
}

fn draw_key(svg: &mut Svg, key: &Key, at: DVec2) {
    let em = svg.em;
    let to = |x: f64, y: f64| at + DVec2::new(x, y) * em;
    let beside = match key {
        Key::Line(_, stroke) => {
            svg.line(&[to(0.0, -0.35), to(1.9, -0.35)], *stroke);
            2.3
        }
        Key::Area(_, fill) => {
            svg.rectangles(&[[to(0.0, -0.8), to(1.2, 0.05)]], fill);
            1.6
        }
        Key::Mark(_, mark, color) => {
            draw_mark(svg, to(0.5, -0.35), *mark, color);
            1.3
        }
        Key::Colors(text, [least, middle, most]) => {
            svg.text(at, Anchor::Start, text);
            let mut x = width(text) + 0.9;
            svg.text(to(x, 0.0), Anchor::Start, least);
            x += width(least) + 0.3;
            let corners = [to(x, -0.8), to(x + COLORS, -0.8), to(x + COLORS, 0.05), to(x, 0.05)];
            svg.polygon(&corners, &Fill::Gradient([corners[0], corners[1]], diverging_stops(-1.0, 1.0)));
            svg.text(to(x + COLORS / 2.0, 0.0), Anchor::Middle, middle);
            return svg.text(to(x + COLORS + 0.3, 0.0), Anchor::Start, most);
        }
    };
    svg.text(to(beside, 0.0), Anchor::Start, key.text());
}

const EVERYWHERE: [DVec2; 2] = [DVec2::NEG_INFINITY, DVec2::INFINITY];
/// How far, in mm, neighbours of a field overlap, so that no viewer shows the paper between them: less than a ray.
const OVERLAP: f64 = 0.04;

/// What of a shape lies in a frame.
fn draw_shape(svg: &mut Svg, shape: &Shape, place: &impl Fn(DVec2) -> DVec2, frame: [DVec2; 2]) {
    let placed = |points: &[DVec2]| points.iter().map(|point| place(*point)).collect::<Vec<_>>();
    match shape {
        Shape::Lines(lines, stroke) => {
            let stretches = lines.iter().flat_map(|line| clip::line(&placed(line), frame));
            stretches.for_each(|line| svg.line(&line, *stroke));
        }
        Shape::Areas(areas, color) => {
            let fill = Fill::Flat((*color).into());
            areas.iter().for_each(|area| svg.polygon(&clip::polygon(placed(area), frame), &fill));
        }
        Shape::Pieces(pieces) => pieces.iter().for_each(|piece| draw_piece(svg, piece, place)),
        Shape::Runs(runs) => {
            let grown = |[a, b]: [DVec2; 2]| [a.min(b) - OVERLAP, a.max(b) + OVERLAP];
            for (color, corners) in runs {
                let corners: Vec<_> = corners.iter().map(|ends| grown(ends.map(place))).collect();
                svg.rectangles(&corners, color);
            }
        }
        Shape::Region(lines, color) => svg.region(&lines.iter().map(|line| placed(line)).collect::<Vec<_>>(), color),
        Shape::Marks(points, mark, color) => {
            let inside = |point: &DVec2| frame[0].cmple(*point).all() && point.cmple(frame[1]).all();
            placed(points).into_iter().filter(inside).for_each(|point| draw_mark(svg, point, *mark, color));
        }
        Shape::Note(at, anchor, text) => svg.text(place(*at), *anchor, text),
    }
}

/// Colours closer than this share of the greatest value are one.
const ONE_COLOR: f64 = 1.0 / 200.0;

/// A polygon in the colours of its values: exact where they are linear, as the steps of the palette are.
fn draw_piece(svg: &mut Svg, piece: &Piece, place: &impl Fn(DVec2) -> DVec2) {
    let corners: Vec<DVec2> = piece.corners.iter().map(|corner| place(*corner)).collect();
    let value = |corner: &DVec2| piece.middle + piece.slope.dot(*corner - piece.at);
    let values: Vec<f64> = piece.corners.iter().map(value).collect();
    let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
    let drawn = clip::grown(&corners, OVERLAP);
    if most - least < ONE_COLOR {
        return svg.polygon(&drawn, &Fill::Flat(diverging(piece.middle)));
    }
    // The slope on paper: unit steps of the axes are stretched there.
    let origin = place(piece.at);
    let [right, up] = [DVec2::X, DVec2::Y].map(|step| place(piece.at + step) - origin);
    let slope = DVec2::new(piece.slope.x / right.x, piece.slope.y / up.y);
    let along = slope / slope.length_squared();
    let end = |value: f64| origin + along * (value - piece.middle);
    svg.polygon(&drawn, &Fill::Gradient([end(least), end(most)], diverging_stops(least, most)));
}

fn draw_mark(svg: &mut Svg, at: DVec2, mark: Mark, color: &'static str) {
    let r = 0.28 * svg.em;
    let ring = |count: i32, turn: f64, radius: &dyn Fn(i32) -> f64| -> Vec<DVec2> {
        let corner = |k: i32| DVec2::from_angle((f64::from(k) / f64::from(count) + turn) * std::f64::consts::TAU);
        (0..count).map(|k| at + corner(k) * radius(k)).collect::<Vec<_>>()
    };
    let fill = Fill::Flat(color.into());
    let thin = Stroke::new(color, 0.07 * svg.em);
    match mark {
        Mark::Dot => svg.circle(at, r, color, Stroke::new(color, 0.0)),
        Mark::Point => svg.circle(at, 0.4 * r, color, Stroke::new(color, 0.0)),
        Mark::Ring => svg.circle(at, 2.0 * r, "none", thin),
        Mark::Square => svg.polygon(&ring(4, 0.125, &|_| 1.2 * r), &fill),
        Mark::Diamond => svg.polygon(&ring(4, 0.0, &|_| 1.25 * r), &fill),
        Mark::Triangle => svg.polygon(&ring(3, -0.25, &|_| 1.25 * r), &fill),
        Mark::TriangleDown => svg.polygon(&ring(3, 0.25, &|_| 1.25 * r), &fill),
        Mark::Pentagon => svg.polygon(&ring(5, -0.25, &|_| 1.15 * r), &fill),
        Mark::Star => svg.polygon(&ring(10, -0.25, &|k| if k % 2 == 0 { 1.3 * r } else { 0.55 * r }), &fill),
        Mark::Cross => {
            for way in [DVec2::ONE, DVec2::new(1.0, -1.0)] {
                svg.line(&[at - way * 0.85 * r, at + way * 0.85 * r], Stroke { width: 0.12 * svg.em, ..thin });
            }
        }
    }
}

/// Places of a line across a picture: more points are drawn as the least and the greatest of each.
const PLACES: usize = 2000;

/// A line through at most two points a place: the least and the greatest.
pub fn thinned(points: Vec<DVec2>) -> Vec<DVec2> {
    let step = points.len().div_ceil(PLACES);
    if step <= 2 {
        return points;
    }
    let higher = |a: &&DVec2, b: &&DVec2| a.y.partial_cmp(&b.y).unwrap_or(Ordering::Equal);
    let ends = |chunk: &[DVec2]| {
        let [least, most] =
            [chunk.iter().min_by(higher), chunk.iter().max_by(higher)].map(|end| *end.unwrap_or(&chunk[0]));
        if least.x <= most.x { [least, most] } else { [most, least] }
    };
    points.chunks(step).flat_map(ends).collect::<Vec<_>>()
}

#[cfg(test)]
#[path = "tests/panel.rs"]
mod tests;
