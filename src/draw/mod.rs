//! Drawing: axes, lines, areas and fields as SVG in millimetres. The same picture has the same bytes.

#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports, reason = "the command draws more"))]

mod axis;
pub(crate) mod clip;
mod color;
mod panel;
#[cfg(feature = "plot")]
mod render;
mod sheet;
mod svg;

pub(crate) use axis::Axis;
pub(crate) use axis::power_of_ten;
pub(crate) use color::{AREAS, LINES, diverging};
pub(crate) use panel::{Key, Mark, Panel, Piece, Shape, thinned};
#[cfg(feature = "plot")]
pub(crate) use render::Rendered;
pub use sheet::Canvas;
pub(crate) use sheet::{Sheet, Size};
pub(crate) use svg::Anchor;
pub(crate) use svg::{Stroke, Svg, plain};
