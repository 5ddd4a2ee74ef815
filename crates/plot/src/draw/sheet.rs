//! A sheet of pictures, as large as what it is made for.

use glam::DVec2;

use super::panel::{Key, Panel, Place};
use super::svg::{Anchor, Svg, width};

/// What a picture is made for.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    strum::Display,
    strum::EnumMessage,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Size {
    /// One column of a journal, 85 mm
    Column,
    /// The width of a page, 170 mm
    #[default]
    Page,
    /// A slide, 16:9
    Slide,
}

/// What a picture of a history is drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Canvas {
    /// The width of a page, 170 mm, and as high as it takes: field, stress, motion and energy.
    #[default]
    Page,
    /// A part of a screen, in mm: field, stress and energy over one axis of times, without a title.
    Screen {
        /// From left to right.
        width: f64,
        /// From top to bottom.
        height: f64,
        /// The height of letters.
        letters: f64,
    },
}

#[derive(Clone, Debug)]
pub struct Sheet {
    pub title: Vec<String>,
    pub panels: Vec<Panel>,
}

/// Heights in those of a letter.
const TITLE: f64 = 1.6;
/// Below a frame: numbers and label.
const FOOT: f64 = 3.1;
/// Left of the numbers: the label.
const LABEL: f64 = 1.5;
const GAP: f64 = 0.9;

impl Size {
    /// In mm: the width; the height of letters where at most two pictures share it, and more; the height of a frame
    /// alone in its row, and not. Letters are of 8 points; on a slide they are as large on a screen as 18 points on a
    /// page, or 13.
    fn measures(self) -> (f64, [f64; 2], [f64; 2]) {
        match self {
            Size::Column => (85.0, [2.82; 2], [38.0; 2]),
            Size::Page => (170.0, [2.82; 2], [80.0, 46.0]),
            Size::Slide => (254.0, [4.4, 3.2], [80.0, 46.0]),
        }
    }

    /// Pixels of a PNG for one of an SVG, of which 96 are an inch: 300 for an inch; a slide is as wide as a screen.
    #[cfg(feature = "raster")]
    pub fn scale(self) -> f32 {
        if self == Size::Slide { 2.0 } else { 3.125 }
    }
}

impl Sheet {
    /// Leaves out of the legends what stands in one before, of these texts.
    pub fn say_once(&mut self, of: impl Fn(&str) -> bool) {
        let mut said: Vec<String> = Vec::new();
        for panel in &mut self.panels {
            panel.legend.retain(|key| !said.iter().any(|text| text == key.text()));
            said.extend(panel.legend.iter().map(Key::text).filter(|text| of(text)).map(String::from));
        }
    }

    pub fn svg(&self, size: Size) -> String {
        let (wide, letters, frames) = size.measures();
        let across = if size == Size::Column || self.panels.len() < 2 { 1 } else { 2 };
        let em = letters[usize::from(self.panels.len() > 2)];
        let rows: Vec<&[Panel]> = self.panels.chunks(across).collect();
        let title: Vec<&str> = self.title.iter().flat_map(|line| wrapped(line, (wide - 2.0 * em) / em)).collect();
        let above = em * (0.9 + TITLE * title.len() as f64);
        let cell = wide / across as f64;
        // A frame of this height, and the legends that its width leaves room for.
        let head = |row: &[Panel]| row.iter().map(|panel| panel.head(cell - 1.5 * em, em, false)).fold(0.0, f64::max);
        let around: f64 = rows.iter().map(|row| head(row) + em * (FOOT + GAP)).sum();
        let frame = match size {
            Size::Slide => (wide * 9.0 / 16.0 - above - around) / rows.len().max(1) as f64,
            _ => frames[across - 1],
        };
        let mut svg = Svg::new(wide, above + around + frame * rows.len() as f64, em);
        for (k, line) in title.iter().enumerate() {
            svg.text(DVec2::new(em, em * (0.1 + TITLE * (k + 1) as f64)), Anchor::Start, line);
        }
        // Frames in a column begin at one place.
        let margin = |column: usize| {
            let panels = rows.iter().filter_map(|row| row.get(column));
            em * (LABEL + panels.map(|panel| panel.margin(frame, em)).fold(0.0, f64::max))
        };
        let mut y = above;
        for row in &rows {
            y += head(row);
            for (column, panel) in row.iter().enumerate() {
                let left = column as f64 * cell + em;
                let frame = [DVec2::new(left + margin(column), y), DVec2::new(left + cell - 2.2 * em, y + frame)];
                panel.draw(&mut svg, Place { frame, left, wide: cell - 1.5 * em, stacked: false, foot: true });
            }
            y += frame + em * (FOOT + GAP);
        }
        svg.finish()
    }

    /// The pictures of one span of times in a rectangle, one below the other; the first is twice as high as the others.
    /// What stands in one legend is not said again.
    pub fn stacked(mut self, width: f64, height: f64, em: f64) -> String {
        self.say_once(|_| true);
        let mut svg = Svg::new(width, height, em);
        let wide = width - 0.8 * em;
        let around: f64 = self.panels.iter().map(|panel| panel.head(wide, em, true)).sum();
        let part = ((height - around - em * FOOT) / (self.panels.len() + 1) as f64).max(em);
        let share = |k: usize| if k == 0 { 2.0 * part } else { part };
        for (k, panel) in self.panels.iter_mut().enumerate() {
            panel.label_in_title(share(k) / em);
        }
        let margins = self.panels.iter().enumerate().map(|(k, panel)| panel.margin(share(k), em));
        let margin = em * (LABEL + margins.fold(0.0, f64::max));
        let mut y = 0.0;
        for (k, panel) in self.panels.iter().enumerate() {
            y += panel.head(wide, em, true);
            // Half of the last number may stand beyond the frame.
            let frame = [DVec2::new(margin, y), DVec2::new(width - 1.8 * em, y + share(k))];
            let foot = k + 1 == self.panels.len();
            panel.draw(&mut svg, Place { frame, left: 0.3 * em, wide, stacked: true, foot });
            y += share(k);
        }
        svg.finish()
    }
}

/// A text in lines of at most so many letters.
fn wrapped(text: &str, most: f64) -> Vec<&str> {
    let (mut lines, mut start, mut end) = (Vec::new(), 0, 0);
    for (space, _) in text.match_indices(' ').chain([(text.len(), "")]) {
        if width(&text[start..space]) > most && end > start {
            lines.push(&text[start..end]);
            start = end + 1;
        }
        end = space;
    }
    lines.push(&text[start..]);
    lines
}

#[cfg(test)]
#[path = "tests/sheet.rs"]
mod tests;
