//! The map of regimes: whether and when the first contact ends, over all dampings and impact speeds; and grids of
//! parameter values.

mod contour;
mod grid;
mod map;

pub use grid::{Axis, Grid, GridError};
pub use map::{BANDS, CellAxis, Map, Regime, threshold, threshold_near};
