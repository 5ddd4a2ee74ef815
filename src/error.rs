//! Everything that can be refused, and how it is said.

use thiserror::Error;

/// What was found, where, and what was expected.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A fraction cannot hold a square root.
    #[error("exact fractions cannot hold the {quantity} √({square}); expected a square, or use --digits N")]
    Irrational {
        /// The quantity that needs the root.
        quantity: &'static str,
        /// What stands under the root.
        square: String,
    },
}
