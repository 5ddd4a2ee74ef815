//! Drawing: axes, lines, areas and fields as SVG in millimetres. The same picture has the same bytes.

mod axis;
pub(crate) mod clip;
mod color;
mod panel;
#[cfg(feature = "raster")]
mod render;
mod sheet;
mod svg;

pub use axis::Axis;
pub use axis::power_of_ten;
pub use color::{AREAS, LINES, diverging};
pub use panel::{Key, Mark, Panel, Piece, Shape, thinned};
#[cfg(feature = "raster")]
pub use render::Rendered;
pub use sheet::Canvas;
pub use sheet::{Sheet, Size};
pub use svg::Anchor;
pub use svg::{Stroke, Svg, plain};
