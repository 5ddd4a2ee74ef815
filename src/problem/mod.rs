//! The problem: rod, gravity, start and run in exact numbers, checked.
//!
//! ```
//! use dalembert::Problem;
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
//! // μ = 3 is 3/2 of the critical speed g t₁ = 2.
//! assert_eq!(rod.dimensionless().speed_ratio, Some(1.5));
//! let error = rod.to_builder().length(-1).build().unwrap_err();
//! assert_eq!(error.to_string(), "found length = -1, expected a length above zero");
//! # Ok::<(), dalembert::problem::ProblemError>(())
//! ```
//!
//! # Limits
//! So that no intermediate result overflows or underflows in double precision:
//!
//! | quantity | range |
//! |---|---|
//! | every quantity with a unit, `t₁ = 2L/c`, `μ` and `g t₁` among them | 0 where that makes sense, or 1e-40 … 1e40 |
//! | `R = r t₁` | 0, or 1e-305 … 1e6 |
//! | `M = μ/(g t₁)` | 1e-12 … 1e12, or no gravity |
//! | time of the run | at most 1e12 `t₁` |
//! | fall of a free rod that starts above the ground | at most 1e6 `t₁` |
//! | impacts | 1 … 10 000 000 |
//! | points of a profile | 2 … 100 000, at least 1e-12 L apart |

mod builder;
mod definition;
pub(crate) mod given;
mod parameters;
pub(crate) mod profile;
pub(crate) mod validate;
pub(crate) mod written;

pub use crate::error::{ProblemError, ProblemErrorKind};
pub use builder::Builder;
pub use definition::{Material, Problem, Profile, Rod, Run, Speed, Start, Top};
pub use parameters::{Dimensionless, Parameters};
pub use written::Written;
