//! Exact reference solutions for the bouncing elastic rod.

pub mod error;
pub mod first_contact;
pub mod history;
pub mod number;
pub mod rod;
pub mod special;

pub use error::Error;
pub use number::Number;
pub use rod::Problem;
