//! The catalogue of hard cases and of the paper's claims: each asked of every route that can answer, held against the
//! truth.
//!
//! | module | |
//! |---|---|
//! | `hard` | where double precision breaks |
//! | `section_2`, `section_3`, `section_4` | the paper, section by section |
//! | `case` | what a case of the catalogue is, and how it is run |
//! | `catalogue` | all of them, by group |
//! | `verdict` | promises, and whether they are kept |

mod case;
mod catalogue;
mod hard;
mod section_2;
mod section_3;
mod section_4;
mod verdict;

pub(crate) use case::{Case, Checked, CheckedQuestion, Group};
pub(crate) use catalogue::{CATALOGUE, select};
pub(crate) use verdict::Verdict;
