//! Exact reference solutions for the bouncing elastic rod.

pub mod error;
pub mod first_contact;
pub mod history;
pub mod lattice;
pub mod number;
pub mod rod;
pub mod scene;

pub use error::Error;
pub use history::{Ending, EventKind, History, Side};
pub use number::Number;
pub use rod::Problem;
pub use scene::Scene;
