//! Answers to questions: the plan, the engines in the planned numbers, and the ladder of precisions.
//!
//! In the order of a question:
//!
//! 1. `question` and `places`: what is asked for, where, and in which numbers.
//! 2. `plan`: the engine, its numbers and limits; it asks `foresee` for the expected loss of digits. `rung`: the
//!    numbers of an attempt; `climb`: the attempts that may follow the first; `explained`: the plan in sentences.
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
mod climb;
mod converted;
mod derivative;
mod differences;
mod engines;
mod explained;
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
pub(crate) mod rung;
mod sensitivity;
mod solution;
mod typed;
mod typed_derivatives;

pub use derivative::{Derivative, Derivatives, NoDerivative};
pub use history::{History, Listing, Rows, StressForm};
pub use ladder::Target;
pub use places::Places;
pub use plan::{CERTIFIED_DIGITS, CellLimits, Climb, DEFAULT_ACCURACY, Engine, Goal, Plan, Reach};
pub use question::{ACCURACIES, MAX_DIGITS, Numbers, Observer, Question, Want, unobserved};
pub(crate) use rung::LONG;
pub use rung::Rung;
pub use sensitivity::Sensitivity;
pub use solution::ExactnessEnd;
pub use typed::TypedHistory;
