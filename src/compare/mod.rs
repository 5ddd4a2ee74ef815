//! Other people's data held against a history: the same quantities at the same times, and what follows from them.

mod agree;
mod audit;
mod comparison;
pub mod data;
mod fit;
mod limit;
mod map;
mod model;
mod norms;
mod options;
mod ours;
mod report;
mod samples;
mod touch;
mod unfitted;
mod verdict;
mod wording;

pub use crate::problem::Parameter;
pub use comparison::{CompareError, ComparedFile, Comparison, Prepared};
pub use fit::FitError;
pub use limit::{Limit, Outcome};
pub use map::MapError;
#[cfg(feature = "cli")]
pub(crate) use norms::Compared;
pub use norms::{Grid, norms, order};
pub use options::{Axis, Compression, Options, Origin};
pub use report::LEGEND;
