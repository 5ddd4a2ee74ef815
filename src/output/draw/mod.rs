//! Drawing: axes, lines, areas and fields as SVG in millimetres. The same picture has the same bytes.
//!
//! | file | |
//! |---|---|
//! | `svg` | shapes and texts |
//! | `axis` | ranges, units, round numbers |
//! | `color` | palettes |
//! | `panel` | one picture with axes and legend |
//! | `png` | SVG to PNG |
//! | `sheet` | several of them, and what they are made for |

mod axis;
mod color;
mod panel;
#[cfg(feature = "plot")]
mod png;
mod sheet;
mod svg;

pub(crate) use axis::{Axis, power_of_ten};
pub(crate) use color::{AREAS, LINES, diverging};
pub(crate) use panel::{Key, Layer, Mark, Panel, Piece, Shape, thinned};
#[cfg(feature = "plot")]
pub(crate) use png::png;
pub(crate) use sheet::{Sheet, Size};
pub(crate) use svg::{Anchor, Stroke, plain};
