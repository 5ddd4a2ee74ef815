//! Answers to questions: the plan, the engines in the planned numbers, and the ladder of precisions.

mod asked;
pub(crate) mod chain;
mod converted;
mod derivative;
mod differences;
mod engines;
mod finer;
mod foresee;
mod history;
mod in_floats;
mod interpolated;
mod ladder;
mod long;
mod places;
mod plan;
mod planned;
mod question;
mod rates;
mod sensitivity;
mod solution;
mod typed;
mod typed_derivatives;

pub use derivative::{Derivative, Derivatives, NoDerivative};
pub use history::{History, Listing, Rows, StressForm};
pub use ladder::Target;
pub use places::Places;
pub(crate) use plan::LONG;
pub use plan::{CERTIFIED_DIGITS, CellLimits, Climb, DEFAULT_ACCURACY, Engine, Goal, MAX_DIGITS, Plan, Reach, Rung};
pub use question::unobserved;
pub use question::{Numbers, Observer, Question, Want};
pub use sensitivity::Sensitivity;
pub use solution::ExactnessEnd;
pub use typed::TypedHistory;
