//! The map of regimes: when and whether the first contact ends, over all dampings and impact speeds.

mod contour;
mod grid;
mod map;

pub use grid::{Axis, Grid, SweepError};
pub use map::{BANDS, Map, Regime, Spread, threshold, threshold_near};
