//! The problem: rod, gravity, start and run in exact numbers, checked.

mod builder;
mod definition;
pub(crate) mod given;
mod in_chain;
mod parameter;
mod parameters;
pub(crate) mod profile;
pub(crate) mod validate;
mod vary;
mod warnings;
pub(crate) mod written;

pub use crate::error::{ProblemError, ProblemErrorKind};
pub use builder::Builder;
pub use definition::{Material, Problem, Profile, Run, Speed, Start, Top};
pub use parameter::Parameter;
pub use parameters::{Dimensionless, Parameters};

pub(crate) use vary::stepped;
pub use written::Written;
