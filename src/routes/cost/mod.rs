//! What accuracy costs in time: one quantity of one scene by every route that can give it, measured on the spot, with
//! the true error of each; and what each effect of a scene costs.

mod clock;
mod effects;
mod ladder;
mod work;

pub(crate) use effects::{Difference, effects};
pub(crate) use ladder::Family;
pub(crate) use work::{Row, Table, work_precision};
