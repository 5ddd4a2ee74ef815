//! The time that accuracy costs: one quantity of one scene by every route that can give it, measured on the spot, with
//! the true error of each; and the time that each effect of a scene costs.

mod effects;
mod ladder;
mod timing;
mod work_precision;

pub use effects::{EffectCost, effects};
pub use ladder::Family;
pub use timing::Timing;
pub use work_precision::{CostRow, CostTable, Omission, OmissionReason, work_precision};
