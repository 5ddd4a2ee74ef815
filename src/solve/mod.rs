//! Answers to questions: the plan, the engines in the planned numbers, and the ladder of precisions.
//!
//! In the order of a question:
//!
//! 1. `question` and `places`: what is asked for, where, and in which numbers.
//! 2. `plan`: the engine, its numbers and limits, and the attempts that may follow; it asks `foresee` for the expected
//!    loss of digits.
//! 3. `engines`, `long`, `chain`: an attempt in doubles and fractions, in longer numbers and enclosures, and at a body
//!    of a chain; `planned` runs an engine in numbers with a bound.
//! 4. `converted`, `in_floats`: the attempt in the numbers of the question; `forwarded`: the questions that they hand
//!    on.
//! 5. `asked`: times beside events and rays; `finer`: times with more digits than the numbers hold.
//! 6. `ladder`: the attempt that settles the answer.
//! 7. `typed`, `history`, `solution`: the answer in one number system, in values, and its end.
//! 8. `derivative` chooses among `rates` (exact), `interpolated` (four runs in doubles) and `differences` (long
//!    numbers); `typed_derivatives`, `chain_derivatives` and `sensitivity` answer.

mod asked;
pub(crate) mod chain;
mod chain_derivatives;
mod converted;
mod derivative;
mod differences;
mod engines;
mod finer;
mod foresee;
mod forwarded;
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
pub use plan::{CERTIFIED_DIGITS, CellLimits, Climb, DEFAULT_ACCURACY, Engine, Goal, Plan, Reach, Rung};
pub use question::{ACCURACIES, MAX_DIGITS, Numbers, Observer, Question, Want, unobserved};
pub use sensitivity::Sensitivity;
pub use solution::ExactnessEnd;
pub use typed::TypedHistory;
