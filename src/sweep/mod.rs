//! Sweeps: one scene with some of its values varied, and a few numbers of each point.
//!
//! | file | |
//! |---|---|
//! | `contour` | closed lines about what is up to a level |
//! | `grid` | which values are varied, and the problem of each point |
//! | `journal` | finished points on disk, so that an interrupted sweep goes on |
//! | `run` | what is asked of the points, and their answers, on all threads |
//! | `regimes` | how the first contact ends, over all dampings and speeds |

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
