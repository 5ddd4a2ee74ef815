//! Independent opinions on the numbers of `dalembert`: the printed formulas, modal sums, finite differences, and the
//! routes to an answer that `dalembert check` and `dalembert cost` hold against each other and against the truth.

mod account;
pub mod check;
pub mod cost;
mod differences;
pub mod figures;
#[cfg_attr(not(feature = "mp"), path = "long_absent.rs")]
mod long;
pub mod modal;
pub mod paper;
mod quantity;
pub mod regimes;
mod route;
mod target;
mod truth;
mod value;

pub use quantity::Question;
pub use route::plan;
pub use target::Published;
