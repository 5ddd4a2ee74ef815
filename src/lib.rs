//! Exact reference solutions for the bouncing elastic rod.

pub mod damped;
pub mod error;
pub mod history;
pub mod number;
pub mod rod;

pub use error::Error;
pub use number::Number;
pub use rod::Problem;
