//! Drawing: axes, lines, areas and fields as SVG in millimetres. Equal pictures have equal bytes.

mod axis;
pub(crate) mod clip;
mod color;
mod panel;
#[cfg(feature = "raster")]
mod raster;
mod sheet;
mod svg;

pub use axis::{Axis, power_of_ten};
pub use color::LINES;
pub(crate) use color::{AREAS, diverging};
pub(crate) use panel::{FieldPiece, Shape};
pub use panel::{Key, Mark, Panel, thinned};
#[cfg(feature = "raster")]
pub use raster::{ParsedSvg, RasterError};
pub use sheet::{Canvas, Sheet, Size};
pub(crate) use svg::Svg;
pub use svg::{Anchor, Stroke, without_subscripts};
