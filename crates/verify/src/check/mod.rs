//! The catalogue of hard cases and of the paper's claims: each question is answered by every route that can answer it,
//! and each answer is compared with the truth.

mod case;
mod catalogue;
mod hard;
mod section_2;
mod section_3;
mod section_4;
mod verdict;

pub use case::{Case, CheckedCase, CheckedQuestion, Group};
pub use catalogue::{CATALOGUE, Selection, UnknownName, select};
pub use verdict::{CheckedRoute, Outcome, Promise, Verdict};
