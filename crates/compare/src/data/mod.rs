//! Columns of numbers from text, `.npy` and `.npz`.

mod error;
mod numpy;
mod source;
mod text;

pub use error::{Column, DataError, DataErrorKind};
pub(crate) use source::Columns;
pub use source::Source;
