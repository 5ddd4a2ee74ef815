//! The figures of the paper, from its parameters: their numbers, and what is to be said of them.
//!
//! | file | |
//! |---|---|
//! | `first` | numbers of first contacts over impact speed and damping |
//! | `figure` | the list, and the numbers of each |

mod figure;
mod first;

pub(crate) use figure::{ALL, Data, Figure, Of, STRONG};
pub(crate) use first::{DAMPINGS, dot, limits};

/// Why a figure has no numbers.
pub(crate) type Failed = Box<dyn std::error::Error + Send + Sync>;
