//! What accuracy costs in time: one quantity of one scene by every route that can give it, measured on the spot, with the true
//! error of each.
//!
//! | module | |
//! |---|---|
//! | `question` | the quantity, and how a history and the closed forms answer it |
//! | `value` | an answer in any number system, and how far two of them are apart |
//! | `truth` | the reference that errors are measured against |
//! | `routes` | every route at every setting, as something that can be run |
//! | `ladder` | which runs fit into the time, the cheapest first |
//! | `clock` | medians and spreads |
//! | `effects` | the same scene with each effect switched off |
//! | [`printed`] | the paper's integrals as printed, by adaptive quadrature |
//! | [`march`] | finite differences along the characteristics |

mod clock;
mod effects;
mod ladder;
pub mod march;
pub mod printed;
mod question;
mod routes;
mod truth;
mod value;

pub use clock::Timing;
pub use effects::{Difference, effects};
pub use ladder::{LeftOut, Row, Table, work_precision};
pub use question::{Quantity, Question};
pub use routes::Route;
pub use truth::{Truth, truth};
pub use value::Value;

/// Why a route has no answer, or nothing can be asked at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "cli", derive(miette::Diagnostic))]
#[non_exhaustive]
pub enum CostError {
    /// The solver refuses.
    #[error(transparent)]
    Solve(#[from] crate::error::Error),
    /// The scene has no such quantity.
    #[error("found {quantity} asked of a scene that has none: {why}; expected another --quantity")]
    NoSuchQuantity {
        /// What was asked.
        quantity: &'static str,
        /// Why there is none.
        why: String,
    },
    /// A time makes no sense here.
    #[error("found time {found}, expected {expected}")]
    Time {
        /// What was asked.
        found: String,
        /// What could have been.
        expected: String,
    },
    /// A budget that is no time.
    #[error("found {found} seconds, expected more than 0 and at most 86400")]
    Seconds {
        /// What was asked.
        found: f64,
    },
    /// A route gave up.
    #[error("{0}")]
    GaveUp(String),
}
