//! Sweeps: a scene over a grid of its values, and some numbers of each point.

mod journal;
mod run;

pub(crate) use dalembert_verify::regimes::{Axis, Grid};
pub(crate) use journal::{Journal, journal_path};
pub(crate) use run::{Point, Request, Subject, Sweep};
pub use run::{PointNumber, TimeRefused, check_time, sweep};
