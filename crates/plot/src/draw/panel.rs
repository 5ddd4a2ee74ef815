//! Panel: one picture with its axes, made of layers over each other, with a title and a legend above the frame.

use glam::DVec2;

use super::axis::Axis;
use super::clip;
use super::color::{diverging, diverging_stops};
use super::svg::{Anchor, Stroke, Svg, text_width};

/// One picture with its axes.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Title above the frame.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Legend between title and frame.
    pub legend: Vec<Key>,
    /// Layers, the lowest one first, each with the class of its group in the SVG.
    pub(crate) layers: Vec<(&'static str, Shape)>,
}

/// Contents of a layer, in the coordinates of the axes.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Lines(Vec<Vec<DVec2>>, Stroke),
    Areas(Vec<Vec<DVec2>>, &'static str),
    Field(Vec<FieldPiece>),
    /// Rectangles by colour, each given by two corners.
    Rectangles(Vec<(String, Vec<[DVec2; 2]>)>),
    /// Points that an odd number of closed lines surrounds. It is not clipped.
    Region(Vec<Vec<DVec2>>, &'static str),
    Marks {
        points: Vec<DVec2>,
        /// Whether points outside the frame are left out.
        clipped: bool,
        mark: Mark,
        color: &'static str,
    },
    Note {
        at: DVec2,
        anchor: Anchor,
        text: String,
    },
}

/// Convex polygon on which a value changes linearly.
#[derive(Clone, Debug)]
pub(crate) struct FieldPiece {
    pub(crate) corners: Vec<DVec2>,
    /// Point at which the value is `value`.
    pub(crate) at: DVec2,
    /// Value at `at`; drawn values are from −1 to 1.
    pub(crate) value: f64,
    /// Gradient of the value.
    pub(crate) slope: DVec2,
}

/// Mark of a data point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A filled circle.
    Dot,
    /// A small filled circle, for many points.
    Point,
    /// A circle around another mark.
    Ring,
    /// A filled square.
    Square,
    /// A filled square on its corner.
    Diamond,
    /// A filled triangle that points upwards.
    Triangle,
    /// A filled triangle that points downwards.
    TriangleDown,
    /// A filled pentagon.
    Pentagon,
    /// Two crossing strokes.
    Cross,
    /// A filled star of five points.
    Star,
}

/// Entry of a legend.
#[derive(Clone, Debug)]
pub struct Key {
    pub(crate) text: String,
    symbol: Symbol,
}

#[derive(Clone, Debug)]
enum Symbol {
    Line(Stroke),
    Area(&'static str),
    Mark(Mark, &'static str),
    /// Colour bar of a field with the texts at its ends and in its middle.
    Colors([String; 3]),
}

impl Key {
    /// Creates the entry of a line.
    pub fn line(text: impl Into<String>, stroke: Stroke) -> Self {
        Key { text: text.into(), symbol: Symbol::Line(stroke) }
    }

    /// Creates the entry of an area.
    pub fn area(text: impl Into<String>, color: &'static str) -> Self {
        Key { text: text.into(), symbol: Symbol::Area(color) }
    }

    /// Creates the entry of a mark.
    pub fn mark(text: impl Into<String>, mark: Mark, color: &'static str) -> Self {
        Key { text: text.into(), symbol: Symbol::Mark(mark, color) }
    }

    /// Creates the colour bar of a field.
    pub(crate) fn colors(text: impl Into<String>, ends: [String; 3]) -> Self {
        Key { text: text.into(), symbol: Symbol::Colors(ends) }
    }

    /// Returns the width in heights of a letter.
    fn width(&self) -> f64 {
        let symbol = match &self.symbol {
            Symbol::Line(_) => 2.4,
            Symbol::Area(_) => 1.7,
            Symbol::Mark(..) => 1.4,
            Symbol::Colors([least, _, greatest]) => COLOR_BAR + 1.4 + text_width(least) + text_width(greatest),
        };
        symbol + text_width(&self.text) + 1.2
    }

    fn draw(&self, svg: &mut Svg, at: DVec2) {
        let em = svg.em;
        let to = |x: f64, y: f64| at + DVec2::new(x, y) * em;
        let text_at = match &self.symbol {
            Symbol::Line(stroke) => {
                svg.line(&[to(0.0, -0.35), to(1.9, -0.35)], *stroke);
                2.3
            }
            Symbol::Area(fill) => {
                svg.rectangles(&[[to(0.0, -0.8), to(1.2, 0.05)]], fill);
                1.6
            }
            Symbol::Mark(mark, color) => {
                draw_mark(svg, to(0.5, -0.35), *mark, color);
                1.3
            }
            Symbol::Colors([least, middle, greatest]) => {
                svg.text(at, Anchor::Start, &self.text);
                let mut x = text_width(&self.text) + 0.9;
                svg.text(to(x, 0.0), Anchor::Start, least);
                x += text_width(least) + 0.3;
                let corners = [to(x, -0.8), to(x + COLOR_BAR, -0.8), to(x + COLOR_BAR, 0.05), to(x, 0.05)];
                svg.gradient_polygon(&corners, [corners[0], corners[1]], &diverging_stops(-1.0, 1.0));
                svg.text(to(x + COLOR_BAR / 2.0, 0.0), Anchor::Middle, middle);
                return svg.text(to(x + COLOR_BAR + 0.3, 0.0), Anchor::Start, greatest);
            }
        };
        svg.text(to(text_at, 0.0), Anchor::Start, &self.text);
    }
}

/// Width of a colour bar, in heights of a letter, as are the lengths that follow.
const COLOR_BAR: f64 = 7.0;
/// Height of a line of text.
const LINE: f64 = 1.55;
/// Gap between a title and the legend beside it.
const TITLE_GAP: f64 = 1.6;
/// Length of a tick.
const TICK: f64 = 0.4;
const GRID: Stroke = Stroke::new("#e4e4e4", 0.12);
const FRAME: Stroke = Stroke::new("#000000", 0.2);

/// Place of a panel on a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Two corners of the frame.
    pub(super) frame: [DVec2; 2],
    /// Left edge of the panel, including all that is around the frame.
    pub(super) left: f64,
    /// Width from that edge.
    pub(super) width: f64,
    /// Whether the legend stands beside the title, as in a stack of panels.
    pub(super) stacked: bool,
    /// Whether the horizontal axis has numbers and a label.
    pub(super) numbers_below: bool,
}

impl Panel {
    /// Creates a panel without layers.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Panel { title: title.into(), x, y, legend: Vec::new(), layers: Vec::new() }
    }

    pub(crate) fn add(&mut self, class: &'static str, shape: Shape) {
        self.layers.push((class, shape));
    }

    /// Adds lines, a layer over the others. Here as below `class` names its group in the SVG.
    pub fn lines(&mut self, class: &'static str, lines: Vec<Vec<DVec2>>, stroke: Stroke) {
        self.add(class, Shape::Lines(lines, stroke));
    }

    /// Adds a horizontal line.
    pub fn level(&mut self, class: &'static str, y: f64, stroke: Stroke) {
        self.lines(class, vec![vec![DVec2::new(self.x.from, y), DVec2::new(self.x.to, y)]], stroke);
    }

    /// Adds polygons.
    pub fn areas(&mut self, class: &'static str, areas: Vec<Vec<DVec2>>, color: &'static str) {
        self.add(class, Shape::Areas(areas, color));
    }

    /// Adds the region of the points that an odd number of closed lines inside the frame surrounds.
    pub fn region(&mut self, class: &'static str, lines: Vec<Vec<DVec2>>, color: &'static str) {
        self.add(class, Shape::Region(lines, color));
    }

    /// Adds marks at points inside the frame.
    pub fn marks(&mut self, class: &'static str, points: Vec<DVec2>, mark: Mark, color: &'static str) {
        self.add(class, Shape::Marks { points, clipped: true, mark, color });
    }

    /// Adds marks at points that may lie outside the frame.
    pub fn marks_unclipped(&mut self, class: &'static str, points: Vec<DVec2>, mark: Mark, color: &'static str) {
        self.add(class, Shape::Marks { points, clipped: false, mark, color });
    }

    /// Adds a text beside a point.
    pub fn note(&mut self, class: &'static str, at: DVec2, anchor: Anchor, text: impl Into<String>) {
        self.add(class, Shape::Note { at, anchor, text: text.into() });
    }

    /// Breaks the legend into rows of at most `width` heights of a letter. If `stacked` is true, the first row follows
    /// the title.
    fn legend_rows(&self, width: f64, stacked: bool) -> Vec<Vec<&Key>> {
        let mut rows: Vec<Vec<&Key>> = Vec::new();
        let mut used = f64::INFINITY;
        if stacked {
            rows.push(Vec::new());
            used = text_width(&self.title) + TITLE_GAP;
        }
        for key in &self.legend {
            used += key.width();
            match rows.last_mut() {
                Some(row) if used <= width => row.push(key),
                _ => {
                    used = key.width();
                    rows.push(vec![key]);
                }
            }
        }
        rows
    }

    /// Moves the label of the vertical axis into the title if it is longer than `height`, in heights of a letter.
    pub(super) fn move_long_label(&mut self, height: f64) {
        if text_width(&self.y.label) <= height {
            return;
        }
        let label = std::mem::take(&mut self.y.label);
        let symbol = label.split(" [").next().unwrap_or_default();
        // The symbol is not repeated in a title that ends with it.
        self.title = match self.title.strip_suffix(symbol) {
            Some(before) => format!("{before}{label}"),
            None => format!("{}, {label}", self.title),
        };
    }

    /// Returns the ticks of the vertical axis.
    fn y_ticks(&self, height: f64, em: f64) -> Vec<(f64, String)> {
        let ticks = self.y.ticks((height / em / 2.4).max(2.5));
        if ticks.len() > 1 {
            return ticks;
        }
        // A single number shows no scale: closer ticks are taken if their numbers do not touch.
        let closer = self.y.ticks(5.0);
        let apart = |pair: &[(f64, String)]| (self.y.share(pair[1].0) - self.y.share(pair[0].0)) * height >= em;
        if closer.len() > 1 && closer.windows(2).all(apart) { closer } else { ticks }
    }

    /// Returns whether values of curves or marks lie above or below the frame.
    fn is_cut(&self) -> bool {
        let is_outside = |point: &DVec2| {
            let [across, up] = [self.x.share(point.x), self.y.share(point.y)];
            (0.0..=1.0).contains(&across) && !(-CUT..=1.0 + CUT).contains(&up)
        };
        self.layers.iter().any(|(class, shape)| match shape {
            Shape::Lines(lines, _) => *class == "curve" && lines.iter().flatten().any(is_outside),
            Shape::Marks { points, clipped: true, .. } => points.iter().any(is_outside),
            _ => false,
        })
    }

    /// Returns the width of ticks and numbers left of a frame of this height, in heights of a letter.
    pub(super) fn left_margin(&self, height: f64, em: f64) -> f64 {
        self.y_ticks(height, em).iter().map(|tick| text_width(&tick.1)).fold(0.0, f64::max) + TICK + 0.5
    }

    /// Returns the height of title and legend.
    pub(super) fn head_height(&self, width: f64, em: f64, stacked: bool) -> f64 {
        let rows = self.legend_rows(width / em, stacked).len();
        em * (LINE * if stacked { rows } else { 1 + rows } as f64 + 0.4)
    }

    /// Draws the panel. Only its layers are clipped to the frame.
    pub(super) fn draw(&self, svg: &mut Svg, layout: Layout) {
        let Layout { frame: [from, to], left, width, stacked, numbers_below } = layout;
        let (em, size) = (svg.em, to - from);
        let place = |point: DVec2| {
            let share = DVec2::new(self.x.share(point.x), 1.0 - self.y.share(point.y));
            // Points far outside the frame are moved closer, which is not visible.
            from + share.clamp(DVec2::splat(-20.0), DVec2::splat(20.0)) * size
        };
        svg.open("panel", "");
        self.draw_head(svg, DVec2::new(left, from.y), width, stacked);
        let x_tick = |(value, text): (f64, String)| (from.x + self.x.share(value) * size.x, text);
        let y_tick = |(value, text): (f64, String)| (to.y - self.y.share(value) * size.y, text);
        let x_ticks: Vec<_> = self.x.ticks(size.x / em / 4.5).into_iter().map(x_tick).collect();
        let y_ticks: Vec<_> = self.y_ticks(size.y, em).into_iter().map(y_tick).collect();
        svg.open("grid", "");
        x_ticks.iter().for_each(|(x, _)| svg.line(&[DVec2::new(*x, from.y), DVec2::new(*x, to.y)], GRID));
        y_ticks.iter().for_each(|(y, _)| svg.line(&[DVec2::new(from.x, *y), DVec2::new(to.x, *y)], GRID));
        svg.close();
        for (class, shape) in &self.layers {
            // Neighbouring cells of a field show no seam.
            let edges = if *class == "cells" { " shape-rendering=\"crispEdges\"" } else { "" };
            svg.open(class, edges);
            draw_shape(svg, shape, &place, [from, to]);
            svg.close();
        }
        svg.outline([from, to], FRAME);
        if self.is_cut() {
            svg.text(DVec2::new(to.x - 0.5 * em, from.y + em), Anchor::End, "cut off at the frame");
        }
        if numbers_below {
            svg.open("axis-x", "");
            for (x, text) in x_ticks {
                svg.line(&[DVec2::new(x, to.y), DVec2::new(x, to.y + TICK * em)], FRAME);
                svg.text(DVec2::new(x, to.y + (TICK + 1.0) * em), Anchor::Middle, &text);
            }
            svg.text(DVec2::new(from.x + size.x / 2.0, to.y + (TICK + 2.35) * em), Anchor::Middle, &self.x.label);
            svg.close();
        }
        svg.open("axis-y", "");
        for (y, text) in y_ticks {
            svg.line(&[DVec2::new(from.x - TICK * em, y), DVec2::new(from.x, y)], FRAME);
            svg.text(DVec2::new(from.x - (TICK + 0.3) * em, y + 0.36 * em), Anchor::End, &text);
        }
        if !self.y.label.is_empty() {
            // The letters of a label that is longer than the frame are smaller.
            let label = DVec2::new(left + 0.85 * em, from.y + size.y / 2.0);
            svg.text_upwards(label, &self.y.label, (size.y / em / text_width(&self.y.label)).min(1.0));
        }
        svg.close();
        svg.close();
    }

    fn draw_head(&self, svg: &mut Svg, at: DVec2, width: f64, stacked: bool) {
        let em = svg.em;
        let rows = self.legend_rows(width / em, stacked);
        let below = if stacked { rows.len() - 1 } else { rows.len() };
        let top = at.y - em * (0.75 + LINE * below as f64);
        svg.text(DVec2::new(at.x, top), Anchor::Start, &self.title);
        if self.legend.is_empty() {
            return;
        }
        svg.open("legend", "");
        for (k, row) in rows.iter().enumerate() {
            let line = if stacked { k } else { k + 1 };
            let mut x = at.x + if line == 0 { em * (text_width(&self.title) + TITLE_GAP) } else { 0.0 };
            let base = top + em * LINE * line as f64;
            for key in row {
                key.draw(svg, DVec2::new(x, base));
                x += em * key.width();
            }
        }
        svg.close();
    }
}

/// Share of a frame by which a curve may leave it unseen: the width of a line.
const CUT: f64 = 0.002;

/// Overlap of neighbouring cells of a field in mm, so that no viewer shows a seam: less than the width of a ray.
const OVERLAP: f64 = 0.04;

/// Draws the part of a shape inside a frame.
fn draw_shape(svg: &mut Svg, shape: &Shape, place: &impl Fn(DVec2) -> DVec2, frame: [DVec2; 2]) {
    let placed = |points: &[DVec2]| points.iter().map(|point| place(*point)).collect::<Vec<_>>();
    match shape {
        Shape::Lines(lines, stroke) => {
            let stretches = lines.iter().flat_map(|line| clip::line(&placed(line), frame));
            stretches.for_each(|line| svg.line(&line, *stroke));
        }
        Shape::Areas(areas, color) => {
            areas.iter().for_each(|area| svg.polygon(&clip::polygon(placed(area), frame), color));
        }
        Shape::Field(pieces) => pieces.iter().for_each(|piece| draw_piece(svg, piece, place)),
        Shape::Rectangles(colors) => {
            let grown = |[a, b]: [DVec2; 2]| [a.min(b) - OVERLAP, a.max(b) + OVERLAP];
            for (color, corners) in colors {
                let corners: Vec<_> = corners.iter().map(|ends| grown(ends.map(place))).collect();
                svg.rectangles(&corners, color);
            }
        }
        Shape::Region(lines, color) => svg.region(&lines.iter().map(|line| placed(line)).collect::<Vec<_>>(), color),
        Shape::Marks { points, clipped, mark, color } => {
            let inside = |point: &DVec2| !clipped || frame[0].cmple(*point).all() && point.cmple(frame[1]).all();
            placed(points).into_iter().filter(inside).for_each(|point| draw_mark(svg, point, *mark, color));
        }
        Shape::Note { at, anchor, text } => svg.text(place(*at), *anchor, text),
    }
}

/// Largest difference of values, from −1 to 1, that is not drawn as a gradient.
const ONE_COLOR: f64 = 1.0 / 200.0;

/// Draws a polygon in the colours of its values. The gradient is exact: values and palette are piecewise linear.
fn draw_piece(svg: &mut Svg, piece: &FieldPiece, place: &impl Fn(DVec2) -> DVec2) {
    let corners: Vec<DVec2> = piece.corners.iter().map(|corner| place(*corner)).collect();
    let value = |corner: &DVec2| piece.value + piece.slope.dot(*corner - piece.at);
    let values: Vec<f64> = piece.corners.iter().map(value).collect();
    let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
    let drawn = clip::grown(&corners, OVERLAP);
    if most - least < ONE_COLOR {
        return svg.polygon(&drawn, &diverging(piece.value));
    }
    // Slope in millimetres of the sheet.
    let origin = place(piece.at);
    let [right, up] = [DVec2::X, DVec2::Y].map(|step| place(piece.at + step) - origin);
    let slope = DVec2::new(piece.slope.x / right.x, piece.slope.y / up.y);
    let along = slope / slope.length_squared();
    let end = |value: f64| origin + along * (value - piece.value);
    svg.gradient_polygon(&drawn, [end(least), end(most)], &diverging_stops(least, most));
}

fn draw_mark(svg: &mut Svg, at: DVec2, mark: Mark, color: &'static str) {
    let r = 0.28 * svg.em;
    let ring = |count: i32, turn: f64, radius: &dyn Fn(i32) -> f64| -> Vec<DVec2> {
        let corner = |k: i32| DVec2::from_angle((f64::from(k) / f64::from(count) + turn) * std::f64::consts::TAU);
        (0..count).map(|k| at + corner(k) * radius(k)).collect()
    };
    let thin = Stroke::new(color, 0.07 * svg.em);
    match mark {
        Mark::Dot => svg.circle(at, r, color, Stroke::new(color, 0.0)),
        Mark::Point => svg.circle(at, 0.4 * r, color, Stroke::new(color, 0.0)),
        Mark::Ring => svg.circle(at, 2.0 * r, "none", thin),
        Mark::Square => svg.polygon(&ring(4, 0.125, &|_| 1.2 * r), color),
        Mark::Diamond => svg.polygon(&ring(4, 0.0, &|_| 1.25 * r), color),
        Mark::Triangle => svg.polygon(&ring(3, -0.25, &|_| 1.25 * r), color),
        Mark::TriangleDown => svg.polygon(&ring(3, 0.25, &|_| 1.25 * r), color),
        Mark::Pentagon => svg.polygon(&ring(5, -0.25, &|_| 1.15 * r), color),
        Mark::Star => svg.polygon(&ring(10, -0.25, &|k| if k % 2 == 0 { 1.3 * r } else { 0.55 * r }), color),
        Mark::Cross => {
            for way in [DVec2::ONE, DVec2::new(1.0, -1.0)] {
                svg.line(&[at - way * 0.85 * r, at + way * 0.85 * r], Stroke { width: 0.12 * svg.em, ..thin });
            }
        }
    }
}

/// Number of places along a line of a picture: what is between two of them cannot be seen.
const PLACES: usize = 2000;

/// Reduces a line to the lowest and the highest point of each place.
pub fn thinned(points: Vec<DVec2>) -> Vec<DVec2> {
    let step = points.len().div_ceil(PLACES);
    if step <= 2 {
        return points;
    }
    let ends = |chunk: &[DVec2]| {
        let (mut low, mut high) = (chunk[0], chunk[0]);
        for point in chunk {
            low = if point.y < low.y { *point } else { low };
            high = if point.y >= high.y { *point } else { high };
        }
        if low.x <= high.x { [low, high] } else { [high, low] }
    };
    points.chunks(step).flat_map(ends).collect()
}

#[cfg(test)]
#[path = "tests/panel.rs"]
mod tests;
