//! Routes to an answer, held against each other and against the truth: what `dalembert check` and `dalembert cost`
//! share.
//!
//! | module | |
//! |---|---|
//! | `value` | a number in any number system, with its bound |
//! | `quantity` | one number, asked of any account of a motion |
//! | `account` | the accounts of a motion beside a history |
//! | `differences` | finite differences along the characteristics |
//! | `route` | every route to an answer |
//! | `truth` | what answers are held against |
//! | `target` | what others have published of a scene |
//! | `long` | what needs numbers longer than doubles |
//! | [`check`] | the catalogue of hard cases and of the paper's claims |
//! | [`cost`] | what accuracy and effects cost in time |

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
