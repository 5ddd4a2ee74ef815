//! Drawing: axes, lines, areas and fields as SVG in millimetres. The same picture has the same bytes.
//!
//! | file | |
//! |---|---|
//! | `svg` | shapes and texts |
//! | `axis` | ranges, units, round numbers |
//! | `color` | palettes |
//! | `panel` | one picture with axes and legend |
//! | `sheet` | several of them, and what they are made for |

mod axis;
mod color;
mod panel;
mod sheet;
mod svg;

pub(crate) use axis::Axis;
pub(crate) use color::{AREAS, LINES, diverging};
pub(crate) use panel::{Key, Layer, Mark, Panel, Piece, Shape};
pub(crate) use sheet::{Sheet, Size};
pub(crate) use svg::{Anchor, FAMILY, Stroke, plain};
