//! Sweeps: one scene with some of its values varied, and a few numbers of each point.

mod journal;
mod run;

pub(crate) use dalembert_verify::regimes::{Axis, Grid};
pub(crate) use journal::{Journal, journal_of};
pub(crate) use run::{Asked, Point, Sweep};
pub use run::{Cell, sweep};
