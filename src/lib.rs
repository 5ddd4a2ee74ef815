//! Exact reference solutions for the bouncing elastic rod.

#[cfg(feature = "cli")]
pub mod cli;
pub mod error;
pub mod first_contact;
pub mod history;
pub mod lattice;
pub mod modal;
pub mod number;
#[cfg(feature = "cli")]
pub mod output;
pub mod quantity;
pub mod rod;
pub mod scene;
pub mod solve;
pub mod special;

pub use error::Error;
pub use history::{Ending, EventKind, History, Side};
pub use number::Number;
pub use rod::Problem;
pub use scene::{Ask, Plan, Scene};
pub use solve::{Solution, solve};
