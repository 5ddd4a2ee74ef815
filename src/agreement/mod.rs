//! Other people's data held against a history: the same quantities at the same times, and what follows from them.

mod agree;
mod between;
mod comparison;
mod conventions;
mod limit;
mod map;
mod ours;
mod report;
mod samples;

#[cfg(feature = "cli")]
pub(crate) use agree::Compared;
pub use comparison::{CompareError, ComparedFile, Comparison, Options, Prepared};
pub use conventions::{Axis, Compression, Origin};
pub use limit::Limit;
pub use map::MapError;
pub use report::LEGEND;
