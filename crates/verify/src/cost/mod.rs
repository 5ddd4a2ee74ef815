//! The time that accuracy costs: one quantity of one scene by every route that can give it, measured on the spot, with
//! the true error of each; and the time that each effect of a scene costs.

mod effects;
mod family;
mod ladder;
mod timing;
mod work_precision;

pub use effects::{EffectCost, effects};
pub use family::{Family, OmissionReason};
pub use timing::Timing;
pub use work_precision::{CostRow, CostTable, Omission, chain_work_precision, work_precision};
