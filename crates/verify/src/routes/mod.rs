//! Routes to one number of a problem: each computes it in its own way, in its own numbers.

mod chain;
mod differences;
mod method;
mod question;
mod route;
mod truth;
mod value;

pub use chain::ChainQuestion;
pub use question::RouteQuestion;
pub(crate) use question::Transform;
pub(crate) use route::{Question, Route, run_engine, run_planned};
pub use truth::Truth;
pub(crate) use value::shown;
