//! What data are judged by, and what is said of them.

use serde::Serialize;

use super::norms::{Compared, Grid};
use crate::problem::Problem;
use crate::solve::History;

/// What is known of the data besides their columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<'a> {
    pub(super) problem: &'a Problem,
    pub(super) history: &'a History<f64>,
    pub(super) grid: &'a Grid,
    pub(super) columns: &'a [Compared],
    /// The median step.
    pub(super) step: f64,
    /// Contacts of ours that are missing, and contacts that ours does not have.
    pub(super) contacts: [usize; 2],
}

/// At most so much of ‖e‖₂ is left by an explanation.
pub(super) const LEFT: f64 = 0.5;

/// Fewer samples say nothing.
pub(super) const FEWEST: usize = 8;

/// One number that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Verdict {
    /// Which: `wave_speed`.
    pub(crate) kind: &'static str,
    /// The column that it is about; `all` where it is all of them.
    pub(crate) quantity: String,
    /// By how much.
    pub(crate) value: f64,
    /// Its standard error; zero where it is counted.
    pub(crate) error: f64,
    /// In words.
    pub(crate) text: String,
}

/// From what value on a number that is wrong would be said.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct ToldFrom {
    /// Which: `wave_speed`.
    pub(crate) kind: &'static str,
    /// The column that it is about; `all` where it is all of them.
    pub(crate) quantity: &'static str,
    /// The value: a share, a time, or an offset.
    pub(crate) value: f64,
}

/// What is said of data.
#[derive(Debug, Default)]
pub(super) struct Judgement {
    /// What is wrong.
    pub(super) said: Vec<Verdict>,
    /// Where no number is: from what value on each would have been said.
    pub(super) told_from: Vec<ToldFrom>,
}

impl From<Vec<Verdict>> for Judgement {
    fn from(said: Vec<Verdict>) -> Self {
        Judgement { said, ..Judgement::default() }
    }
}
