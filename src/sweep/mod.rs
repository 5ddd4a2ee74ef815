//! Sweeps: one scene with some of its values varied, and a few numbers of each point.

mod contour;
mod grid;
mod journal;
mod regimes;
mod run;

pub(crate) use grid::{Axis, Grid, SweepError};
pub(crate) use journal::{Journal, journal_of};
pub(crate) use regimes::{BANDS, Map, Regime, Spread, threshold, threshold_near};
pub(crate) use run::{Asked, Point, Sweep};
pub use run::{Cell, sweep};
