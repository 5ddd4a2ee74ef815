//! What accuracy costs in time: one quantity of one scene by every route that can give it, measured on the spot, with
//! the true error of each; and what each effect of a scene costs.

mod clock;
mod effects;
mod ladder;
mod work;

pub use effects::{Difference, effects};
pub use ladder::Family;
pub use work::{Row, Table, work_precision};
