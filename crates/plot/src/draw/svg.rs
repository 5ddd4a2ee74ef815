//! An SVG as it is written, in millimetres.

use std::fmt;

use glam::DVec2;

/// The font of all pictures; where it is not known another one without serifs takes its place.
const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// How a line is drawn: colour, width in mm, dashes in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    pub color: &'static str,
    pub width: f64,
    pub dash: &'static str,
}

impl Stroke {
    pub const fn new(color: &'static str, width: f64) -> Self {
        Stroke { color, width, dash: "" }
    }

    pub const fn dashed(self, dash: &'static str) -> Self {
        Stroke { dash, ..self }
    }
}

/// Where a text stands relative to its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Fill {
    Flat(String),
    /// From one point to another, with shares of the way and colours in order.
    Gradient([DVec2; 2], Vec<(f64, String)>),
}

#[derive(Debug)]
pub struct Svg {
    text: String,
    /// The height of letters, mm.
    pub em: f64,
}

/// A length: a hundredth of a millimetre, without zeros at the end.
pub(super) fn length(x: f64) -> String {
    let text = format!("{x:.2}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".into(),
        short => short.into(),
    }
}

/// The characters that XML keeps for itself.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A number of texts (FNV-1a). In a document that holds several pictures, as a notebook does, a name must not mean
/// something else in each.
fn fingerprint(texts: &[&str]) -> u64 {
    let bytes = texts.iter().flat_map(|text| text.bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// A text of a user, in which `_` is no subscript.
pub fn plain(text: &str) -> String {
    text.replace('_', "__")
}

/// A text in parts, each with whether it is a subscript: `v_x` or `μ_{12}`; `__` is `_` itself.
fn parts(text: &str) -> Vec<(String, bool)> {
    let mut parts = vec![(String::new(), false)];
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let low = match (letter, letters.peek()) {
            ('_', Some('_')) => letters.next().and(None),
            ('_', Some('{')) => {
                letters.next();
                Some(letters.by_ref().take_while(|letter| *letter != '}').collect::<String>())
            }
            ('_', Some(_)) => letters.next().map(String::from),
            _ => None,
        };
        match low {
            Some(low) => parts.extend([(low, true), (String::new(), false)]),
            None => parts.last_mut().map_or((), |last| last.0.push(letter)),
        }
    }
    parts.retain(|part| !part.0.is_empty());
    parts
}

/// The size of a subscript, and how far below the line it stands.
const LOW: (f64, f64) = (0.72, 0.18);

/// About how wide a text is, in heights of its letters. Rather more than less.
pub fn width(text: &str) -> f64 {
    let letter = |letter: char| match letter {
        'i' | 'j' | 'l' | '\'' | '.' | ',' | ':' | ';' | '|' | '·' => 0.32,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' | 'I' | '′' => 0.4,
        'm' | 'w' | 'M' | 'W' | '%' => 0.98,
        '=' | '+' | '−' | '≥' | '≤' | '≈' | '→' | '∞' => 0.84,
        '₀'..='₉' | '⁰'..='⁹' | '²' | '³' | '¹' | '⁻' => 0.42,
        letter if letter.is_uppercase() => 0.7,
        _ => 0.61,
    };
    parts(text).iter().map(|(part, low)| part.chars().map(letter).sum::<f64>() * if *low { LOW.0 } else { 1.0 }).sum()
}

impl Svg {
    /// An empty page of this size with letters of the height `em`, all in mm.
    pub fn new(width: f64, height: f64, em: f64) -> Self {
        let [w, h, size] = [width, height, em].map(length);
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"{FAMILY}\" font-size=\"{size}\" fill=\"#000000\" stroke-linejoin=\"round\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n"
        );
        Svg { text, em }
    }

    /// Begins a group that [`Svg::close`] ends: its class, and other attributes.
    pub fn open(&mut self, class: &str, attributes: &str) {
        self.text += &format!("<g class=\"{}\"{attributes}>\n", escaped(class));
    }

    pub fn close(&mut self) {
        self.text += "</g>\n";
    }

    pub fn line(&mut self, points: &[DVec2], stroke: Stroke) {
        self.text += &format!("<polyline points=\"{}\" fill=\"none\"{stroke}/>\n", places(points));
    }

    /// What is inside of a line through points.
    pub fn polygon(&mut self, points: &[DVec2], fill: &Fill) {
        let corners = places(points);
        let paint = match fill {
            Fill::Flat(color) => color.clone(),
            Fill::Gradient([from, to], stops) => {
                let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(length);
                let mut gradient =
                    format!("gradientUnits=\"userSpaceOnUse\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\">");
                for (share, color) in stops {
                    gradient += &format!("<stop offset=\"{share:.4}\" stop-color=\"{color}\"/>");
                }
                let id = fingerprint(&[&corners, &gradient]);
                self.text += &format!("<linearGradient id=\"fill{id:x}\" {gradient}</linearGradient>\n");
                format!("url(#fill{id:x})")
            }
        };
        self.text += &format!("<polygon points=\"{corners}\" fill=\"{paint}\"/>\n");
    }

    /// What an odd number of closed lines is about.
    pub fn region(&mut self, lines: &[Vec<DVec2>], fill: &str) {
        let path = lines.iter().map(|line| format!("M{}z", places(line))).collect::<Vec<_>>().concat();
        self.text += &format!("<path fill=\"{fill}\" fill-rule=\"evenodd\" d=\"{path}\"/>\n");
    }

    /// Rectangles of one colour, each from one corner to the opposite one.
    pub fn rectangles(&mut self, corners: &[[DVec2; 2]], fill: &str) {
        // Rounded as places, so that neighbours meet.
        let path = corners
            .iter()
            .map(|[a, b]| {
                let [left, top, right, bottom] = [a.x, a.y, b.x, b.y].map(length);
                format!("M{left} {top}H{right}V{bottom}H{left}z")
            })
            .collect::<Vec<_>>();
        self.text += &format!("<path fill=\"{fill}\" d=\"{}\"/>\n", path.concat());
    }

    pub fn frame(&mut self, [from, to]: [DVec2; 2], stroke: Stroke) {
        let [x, y, w, h] = [from.x, from.y, to.x - from.x, to.y - from.y].map(length);
        self.text += &format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"none\"{stroke}/>\n");
    }

    /// A closed mark about a point, or a ring where it has no fill.
    pub fn circle(&mut self, at: DVec2, radius: f64, fill: &str, stroke: Stroke) {
        let [x, y, r] = [at.x, at.y, radius].map(length);
        self.text += &format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\"{stroke}/>\n");
    }

    /// A text on its base line, with subscripts.
    pub fn text(&mut self, at: DVec2, anchor: Anchor, text: &str) {
        self.place_text(at, anchor, "", text);
    }

    /// A text about its middle that is read upwards. Letters are so many times as high as the others.
    pub fn text_upwards(&mut self, at: DVec2, text: &str, size: f64) {
        let [x, y] = [at.x, at.y].map(length);
        let smaller = if size < 1.0 { format!(" font-size=\"{}\"", length(size * self.em)) } else { String::new() };
        self.place_text(at, Anchor::Middle, &format!("{smaller} transform=\"rotate(-90 {x} {y})\""), text);
    }

    fn place_text(&mut self, at: DVec2, anchor: Anchor, turned: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let [x, y, down, up, small] = [at.x, at.y, LOW.1 * self.em, -LOW.1 * self.em, LOW.0 * self.em].map(length);
        self.text += &format!("<text x=\"{x}\" y=\"{y}\"{anchor}{turned}>");
        let mut low = false;
        for (part, lower) in parts(text) {
            let part = escaped(&part);
            self.text += &match (low, lower) {
                (false, true) => format!("<tspan dy=\"{down}\" font-size=\"{small}\">{part}</tspan>"),
                (true, false) => format!("<tspan dy=\"{up}\">{part}</tspan>"),
                _ => part,
            };
            low = lower;
        }
        self.text += "</text>\n";
    }

    pub fn finish(self) -> String {
        self.text + "</svg>\n"
    }
}

fn places(points: &[DVec2]) -> String {
    points.iter().map(|point| format!("{},{}", length(point.x), length(point.y))).collect::<Vec<_>>().join(" ")
}

/// As attributes.
impl fmt::Display for Stroke {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, " stroke=\"{}\" stroke-width=\"{}\"", self.color, length(self.width))?;
        if self.dash.is_empty() { Ok(()) } else { write!(f, " stroke-dasharray=\"{}\"", self.dash) }
    }
}

#[cfg(test)]
#[path = "tests/svg.rs"]
mod tests;
