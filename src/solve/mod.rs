//! From a question to an answer: the plan, the engines in the planned numbers, and the ladder of precisions.
//!
//! | file | |
//! |---|---|
//! | `question` | what is asked, in which numbers, and who is told how far a run is |
//! | `plan` | everything that is decided before running |
//! | `foresee` | the digits that a chaotic run is going to lose |
//! | `engines`, `long` | the planned engine in the numbers of one attempt |
//! | `asked` | times that are not told from that of an event or a ray |
//! | `converted` | a history in one number system, read in another |
//! | `ladder` | more bits until the answer is settled |
//! | `derivative` | derivatives by a value of the problem |
//! | `exact`, `differences` | how fractions have them, and how long numbers |
//! | `sensitivity` | what a change of one value makes of the times of events |
//! | `history` | the answer in one number system, of which everything else is asked |
//! | `solution` | the answer in the numbers of its plan |

mod asked;
mod converted;
mod derivative;
#[cfg_attr(not(feature = "mp"), path = "differences_absent.rs")]
mod differences;
mod engines;
mod foresee;
mod history;
mod history_derivatives;
mod interpolated;
mod ladder;
#[cfg_attr(not(feature = "mp"), path = "long_absent.rs")]
mod long;
mod plan;
mod question;
mod rates;
#[cfg(feature = "cli")]
mod sensitivity;
mod solution;

pub use derivative::{Derivative, Derivatives, NoDerivative};
pub use history::History;
pub use ladder::Target;
pub use plan::{CERTIFIED_DIGITS, CellLimits, Climb, DEFAULT_ACCURACY, Engine, Goal, MAX_DIGITS, Plan, Reach, Rung};
#[cfg(feature = "cli")]
pub(crate) use question::unobserved;
pub use question::{Numbers, Observer, Question, Want};
#[cfg(feature = "cli")]
pub(crate) use sensitivity::Sensitivity;
pub use solution::{ExactnessEnd, Solution, Visitor};
