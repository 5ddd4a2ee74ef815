//! Sheet of panels, laid out for its medium.

use glam::DVec2;
use strum::{Display, EnumMessage, EnumString, IntoStaticStr, VariantArray};

use super::panel::{Key, Layout, Panel};
use super::svg::{Anchor, Svg, text_width};

/// Medium of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Display, EnumMessage, EnumString, IntoStaticStr, VariantArray)]
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

/// Medium of the picture of a history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Canvas {
    /// A page, 170 mm wide: field, stress, motion and energy, side by side.
    #[default]
    Page,
    /// A part of a screen: field, stress and energy over one axis of times, without a title. Lengths are in mm.
    Screen {
        /// Width of the picture.
        width: f64,
        /// Height of the picture.
        height: f64,
        /// Height of letters.
        letters: f64,
    },
}

/// Panels with a title.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Lines above the panels.
    pub title: Vec<String>,
    /// Panels in the order of reading.
    pub panels: Vec<Panel>,
}

/// Height of a line of the title, in heights of a letter, as are the lengths that follow.
const TITLE: f64 = 1.6;
/// Height of numbers and label below a frame.
const BELOW: f64 = 3.1;
/// Width of the label left of the numbers.
const LABEL: f64 = 1.5;
/// Gap between rows of panels.
const GAP: f64 = 0.9;

/// Measures of a medium in mm.
struct Measures {
    width: f64,
    /// Height of letters for at most two panels, and for more: 8 points; 18 and 13 points on a slide that fills a
    /// screen.
    letters: [f64; 2],
    /// Height of a frame that is alone in its row, and of others.
    frames: [f64; 2],
}

impl Size {
    fn measures(self) -> Measures {
        match self {
            Size::Column => Measures { width: 85.0, letters: [2.82; 2], frames: [38.0; 2] },
            Size::Page => Measures { width: 170.0, letters: [2.82; 2], frames: [80.0, 46.0] },
            Size::Slide => Measures { width: 254.0, letters: [4.4, 3.2], frames: [80.0, 46.0] },
        }
    }

    /// Returns the pixels of a PNG for each pixel of the SVG, of which 96 are an inch: 300 an inch, or the width of a
    /// screen for a slide.
    #[cfg(feature = "raster")]
    pub fn scale(self) -> f32 {
        if self == Size::Slide { 2.0 } else { 3.125 }
    }
}

impl Sheet {
    /// Removes a key from each legend if an earlier legend has its text and `once` is true for it.
    pub(crate) fn remove_repeated_keys(&mut self, once: impl Fn(&str) -> bool) {
        let mut seen: Vec<String> = Vec::new();
        for panel in &mut self.panels {
            panel.legend.retain(|key: &Key| !seen.contains(&key.text));
            seen.extend(panel.legend.iter().map(|key| key.text.clone()).filter(|text| once(text)));
        }
    }

    /// Returns the sheet as an SVG.
    pub fn svg(&self, size: Size) -> String {
        let Measures { width, letters, frames } = size.measures();
        let columns = if size == Size::Column || self.panels.len() < 2 { 1 } else { 2 };
        let em = letters[usize::from(self.panels.len() > 2)];
        let rows: Vec<&[Panel]> = self.panels.chunks(columns).collect();
        let title: Vec<&str> = self.title.iter().flat_map(|line| wrapped(line, (width - 2.0 * em) / em)).collect();
        let above = em * (0.9 + TITLE * title.len() as f64);
        let cell = width / columns as f64;
        let head =
            |row: &[Panel]| row.iter().map(|panel| panel.head_height(cell - 1.5 * em, em, false)).fold(0.0, f64::max);
        let around: f64 = rows.iter().map(|row| head(row) + em * (BELOW + GAP)).sum();
        let frame_height = match size {
            Size::Slide => (width * 9.0 / 16.0 - above - around) / rows.len().max(1) as f64,
            _ => frames[columns - 1],
        };
        let mut svg = Svg::new(width, above + around + frame_height * rows.len() as f64, em);
        for (k, line) in title.iter().enumerate() {
            svg.text(DVec2::new(em, em * (0.1 + TITLE * (k + 1) as f64)), Anchor::Start, line);
        }
        // The frames of a column have one left edge.
        let margin = |column: usize| {
            let panels = rows.iter().filter_map(|row| row.get(column));
            em * (LABEL + panels.map(|panel| panel.left_margin(frame_height, em)).fold(0.0, f64::max))
        };
        let mut y = above;
        for row in &rows {
            y += head(row);
            for (column, panel) in row.iter().enumerate() {
                let left = column as f64 * cell + em;
                let corners = [(left + margin(column), y), (left + cell - 2.2 * em, y + frame_height)];
                let frame = corners.map(DVec2::from);
                let width = cell - 1.5 * em;
                panel.draw(&mut svg, Layout { frame, left, width, stacked: false, numbers_below: true });
            }
            y += frame_height + em * (BELOW + GAP);
        }
        svg.finish()
    }

    /// Returns the panels, which show one span of times, as an SVG of this size with letters of the height `em`, one
    /// below the other. The first one is twice as high as the others. Each key is in one legend only.
    pub(crate) fn stacked_svg(mut self, width: f64, height: f64, em: f64) -> String {
        self.remove_repeated_keys(|_| true);
        let mut svg = Svg::new(width, height, em);
        let panel_width = width - 0.8 * em;
        let around: f64 = self.panels.iter().map(|panel| panel.head_height(panel_width, em, true)).sum();
        let unit = ((height - around - em * BELOW) / (self.panels.len() + 1) as f64).max(em);
        let frame_height = |k: usize| if k == 0 { 2.0 * unit } else { unit };
        for (k, panel) in self.panels.iter_mut().enumerate() {
            panel.move_long_label(frame_height(k) / em);
        }
        let margins = self.panels.iter().enumerate().map(|(k, panel)| panel.left_margin(frame_height(k), em));
        let margin = em * (LABEL + margins.fold(0.0, f64::max));
        let mut y = 0.0;
        for (k, panel) in self.panels.iter().enumerate() {
            y += panel.head_height(panel_width, em, true);
            // Half of the last number may extend beyond the frame.
            let frame = [DVec2::new(margin, y), DVec2::new(width - 1.8 * em, y + frame_height(k))];
            let numbers_below = k + 1 == self.panels.len();
            panel.draw(&mut svg, Layout { frame, left: 0.3 * em, width: panel_width, stacked: true, numbers_below });
            y += frame_height(k);
        }
        svg.finish()
    }
}

/// Breaks a text into lines of at most `width` heights of a letter.
fn wrapped(text: &str, width: f64) -> Vec<&str> {
    let (mut lines, mut start, mut end) = (Vec::new(), 0, 0);
    for (space, _) in text.match_indices(' ').chain([(text.len(), "")]) {
        if text_width(&text[start..space]) > width && end > start {
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
