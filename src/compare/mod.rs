//! Other people's data held against a history: the same quantities at the same times, and what follows from them.

mod agree;
mod audit;
mod comparison;
mod conventions;
pub mod data;
mod fit;
mod judgement;
mod least;
mod limit;
mod map;
mod model;
mod norms;
mod ours;
mod report;
mod samples;
mod touch;
mod unfitted;
mod verdict;
mod wording;

pub use crate::problem::Parameter;
pub use comparison::{CompareError, ComparedFile, Comparison, Options, Prepared};
pub use conventions::{Axis, Compression, Origin};
pub use fit::FitError;
pub use limit::{Limit, Outcome};
pub use map::MapError;
#[cfg(feature = "cli")]
pub(crate) use norms::Compared;
pub use norms::{Grid, norms, order};
pub use report::LEGEND;
