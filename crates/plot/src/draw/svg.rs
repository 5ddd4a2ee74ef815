//! Writer of an SVG; all lengths are in millimetres.

use std::fmt;

use glam::DVec2;

/// Font of all pictures, with substitutes for viewers that do not have it.
const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// Style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Colour, as SVG writes it.
    pub color: &'static str,
    /// Width in mm.
    pub width: f64,
    /// Lengths of dashes and gaps in mm; empty for a solid line.
    pub dash: &'static str,
}

impl Stroke {
    /// Creates the style of a solid line.
    pub const fn new(color: &'static str, width: f64) -> Self {
        Stroke { color, width, dash: "" }
    }

    /// Returns the same style with these dashes and gaps.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Stroke { dash, ..self }
    }
}

/// Point of a text that is placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// Document that is being written.
#[derive(Debug)]
pub(crate) struct Svg {
    text: String,
    /// Height of letters in mm.
    pub(super) em: f64,
}

/// Formats a length to a hundredth of a millimetre, without trailing zeros.
fn length(x: f64) -> String {
    let text = format!("{x:.2}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".into(),
        short => short.into(),
    }
}

/// Escapes the characters that XML reserves.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Computes a hash (FNV-1a) that is part of an element's id: ids must not collide in a document with several pictures,
/// such as a notebook.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Escapes each `_` of a text, so that it does not begin a subscript.
pub fn without_subscripts(text: &str) -> String {
    text.replace('_', "__")
}

/// Splits a text at its subscripts, as in `v_x` or `μ_{12}`; `__` is a plain `_`. The flag of a part says whether it is
/// a subscript.
fn parts(text: &str) -> Vec<(String, bool)> {
    let mut parts = vec![(String::new(), false)];
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let subscript = match (letter, letters.peek()) {
            ('_', Some('_')) => letters.next().and(None),
            ('_', Some('{')) => {
                letters.next();
                Some(letters.by_ref().take_while(|letter| *letter != '}').collect::<String>())
            }
            ('_', Some(_)) => letters.next().map(String::from),
            _ => None,
        };
        match subscript {
            Some(subscript) => parts.extend([(subscript, true), (String::new(), false)]),
            None => parts.last_mut().map_or((), |last| last.0.push(letter)),
        }
    }
    parts.retain(|part| !part.0.is_empty());
    parts
}

/// Size of a subscript, as a share of the other letters.
const SUBSCRIPT_SIZE: f64 = 0.72;
/// Depth of a subscript below the base line, in heights of a letter.
const SUBSCRIPT_DEPTH: f64 = 0.18;

/// Estimates the width of a text in heights of its letters, rather too wide than too narrow.
pub(super) fn text_width(text: &str) -> f64 {
    let letter = |letter: char| match letter {
        'i' | 'j' | 'l' | '\'' | '.' | ',' | ':' | ';' | '|' | '·' => 0.32,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' | 'I' | '′' => 0.4,
        'm' | 'w' | 'M' | 'W' | '%' => 0.98,
        '=' | '+' | '−' | '≥' | '≤' | '≈' | '→' | '∞' => 0.84,
        '₀'..='₉' | '⁰'..='⁹' | '²' | '³' | '¹' | '⁻' => 0.42,
        letter if letter.is_uppercase() => 0.7,
        _ => 0.61,
    };
    parts(text)
        .iter()
        .map(|(part, subscript)| part.chars().map(letter).sum::<f64>() * if *subscript { SUBSCRIPT_SIZE } else { 1.0 })
        .sum()
}

impl Svg {
    /// Creates an empty page with letters of the height `em`.
    pub(crate) fn new(width: f64, height: f64, em: f64) -> Self {
        let [w, h, size] = [width, height, em].map(length);
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"{FAMILY}\" font-size=\"{size}\" fill=\"#000000\" stroke-linejoin=\"round\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n"
        );
        Svg { text, em }
    }

    /// Begins a group with this class and other attributes; [`Svg::close`] ends it.
    pub(super) fn open(&mut self, class: &str, attributes: &str) {
        self.text += &format!("<g class=\"{}\"{attributes}>\n", escaped(class));
    }

    /// Ends the innermost group.
    pub(super) fn close(&mut self) {
        self.text += "</g>\n";
    }

    /// Draws a line through points.
    pub(crate) fn line(&mut self, points: &[DVec2], stroke: Stroke) {
        self.text += &format!("<polyline points=\"{}\" fill=\"none\"{stroke}/>\n", places(points));
    }

    /// Draws a polygon.
    pub(super) fn polygon(&mut self, points: &[DVec2], fill: &str) {
        self.text += &format!("<polygon points=\"{}\" fill=\"{fill}\"/>\n", places(points));
    }

    /// Draws a polygon with a gradient between two points. Each stop is a share of the way, in order, and a colour.
    pub(super) fn gradient_polygon(&mut self, points: &[DVec2], [from, to]: [DVec2; 2], stops: &[(f64, String)]) {
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(length);
        let mut gradient = format!("gradientUnits=\"userSpaceOnUse\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\">");
        for (share, color) in stops {
            gradient += &format!("<stop offset=\"{share:.4}\" stop-color=\"{color}\"/>");
        }
        let id = fingerprint(&format!("{}{gradient}", places(points)));
        self.text += &format!("<linearGradient id=\"fill{id:x}\" {gradient}</linearGradient>\n");
        self.polygon(points, &format!("url(#fill{id:x})"));
    }

    /// Draws the points that an odd number of closed lines surrounds.
    pub(super) fn region(&mut self, lines: &[Vec<DVec2>], fill: &str) {
        let path: String = lines.iter().map(|line| format!("M{}z", places(line))).collect();
        self.text += &format!("<path fill=\"{fill}\" fill-rule=\"evenodd\" d=\"{path}\"/>\n");
    }

    /// Draws rectangles of one colour, each given by two opposite corners.
    pub(crate) fn rectangles(&mut self, corners: &[[DVec2; 2]], fill: &str) {
        // Coordinates are rounded, not widths, so that neighbours meet.
        let path = |[a, b]: &[DVec2; 2]| {
            let [left, top, right, bottom] = [a.x, a.y, b.x, b.y].map(length);
            format!("M{left} {top}H{right}V{bottom}H{left}z")
        };
        let path: String = corners.iter().map(path).collect();
        self.text += &format!("<path fill=\"{fill}\" d=\"{path}\"/>\n");
    }

    /// Draws the outline of a rectangle.
    pub(crate) fn outline(&mut self, [from, to]: [DVec2; 2], stroke: Stroke) {
        let [x, y, w, h] = [from.x, from.y, to.x - from.x, to.y - from.y].map(length);
        self.text += &format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"none\"{stroke}/>\n");
    }

    /// Draws a circle.
    pub(super) fn circle(&mut self, at: DVec2, radius: f64, fill: &str, stroke: Stroke) {
        let [x, y, r] = [at.x, at.y, radius].map(length);
        self.text += &format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\"{stroke}/>\n");
    }

    /// Writes a text, with subscripts, whose base line is at the height of a point.
    pub(crate) fn text(&mut self, at: DVec2, anchor: Anchor, text: &str) {
        self.text_with(at, anchor, "", text);
    }

    /// Writes a text upwards, with its middle at a point, in letters `size` times as high as the others.
    pub(super) fn text_upwards(&mut self, at: DVec2, text: &str, size: f64) {
        let [x, y] = [at.x, at.y].map(length);
        let smaller = if size < 1.0 { format!(" font-size=\"{}\"", length(size * self.em)) } else { String::new() };
        self.text_with(at, Anchor::Middle, &format!("{smaller} transform=\"rotate(-90 {x} {y})\""), text);
    }

    /// Writes a text with further attributes.
    fn text_with(&mut self, at: DVec2, anchor: Anchor, attributes: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let (depth, small) = (SUBSCRIPT_DEPTH * self.em, length(SUBSCRIPT_SIZE * self.em));
        let [x, y, down, up] = [at.x, at.y, depth, -depth].map(length);
        self.text += &format!("<text x=\"{x}\" y=\"{y}\"{anchor}{attributes}>");
        let mut after_subscript = false;
        for (part, subscript) in parts(text) {
            let part = escaped(&part);
            self.text += &match (after_subscript, subscript) {
                (false, true) => format!("<tspan dy=\"{down}\" font-size=\"{small}\">{part}</tspan>"),
                (true, false) => format!("<tspan dy=\"{up}\">{part}</tspan>"),
                _ => part,
            };
            after_subscript = subscript;
        }
        self.text += "</text>\n";
    }

    /// Returns the complete document.
    pub(crate) fn finish(self) -> String {
        self.text + "</svg>\n"
    }
}

/// Formats the coordinates of points.
fn places(points: &[DVec2]) -> String {
    points.iter().map(|point| format!("{},{}", length(point.x), length(point.y))).collect::<Vec<_>>().join(" ")
}

/// Formats the attributes of a line.
impl fmt::Display for Stroke {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, " stroke=\"{}\" stroke-width=\"{}\"", self.color, length(self.width))?;
        if self.dash.is_empty() { Ok(()) } else { write!(f, " stroke-dasharray=\"{}\"", self.dash) }
    }
}

#[cfg(test)]
#[path = "tests/svg.rs"]
mod tests;
