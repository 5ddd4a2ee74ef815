//! The figures of the paper, from its parameters: their numbers, and what is to be said of them.

mod figure;
mod first;

pub(crate) use figure::{ALL, Data, Figure, Of, STRONG};
pub(crate) use first::{DAMPINGS, dot, limits};

pub(crate) type Failed = Box<dyn std::error::Error + Send + Sync>;
