//! The catalogue of hard cases and of the paper's claims: each asked of every route that can answer, held against the
//! truth.

mod case;
mod catalogue;
mod hard;
mod section_2;
mod section_3;
mod section_4;
mod verdict;

pub use case::{Case, Checked, CheckedQuestion, Group};
pub use catalogue::{CATALOGUE, select};
pub use verdict::Verdict;
