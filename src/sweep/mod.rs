//! Sweeps: one scene with some of its values varied, and a few numbers of each point.
//!
//! | file | |
//! |---|---|
//! | `contour` | closed lines about what is up to a level |
//! | `grid` | which values are varied, and the problem of each point |
//! | `point` | what is asked of a point, and its answer |
//! | `journal` | finished points on disk, so that an interrupted sweep goes on |
//! | `run` | all points, on all threads |
//! | `regimes` | how the first contact ends, over all dampings and speeds |

mod contour;
mod grid;
mod journal;
mod point;
mod regimes;
mod run;

pub(crate) use grid::{Axis, Grid, SweepError};
pub(crate) use journal::{Journal, journal_of};
pub use point::Cell;
pub(crate) use point::{Asked, Point};
pub(crate) use regimes::{BANDS, Map, Regime, Spread, threshold, threshold_near};
pub(crate) use run::Sweep;
pub use run::sweep;
