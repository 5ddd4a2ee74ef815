//! Routes to an answer, held against each other and against the truth: what `dalembert check` and `dalembert cost`
//! share.

mod account;
pub(crate) mod check;
pub(crate) mod cost;
mod differences;
#[cfg(feature = "mp")]
mod long;
#[cfg(not(feature = "mp"))]
#[path = "long_absent.rs"]
mod long;
mod quantity;
mod route;
mod target;
mod truth;
mod value;

pub(crate) use quantity::Question;
pub(crate) use route::plan;
pub(crate) use target::Published;
