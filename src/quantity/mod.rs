//! What follows from a history: restitution, the top of a flight, columns over time, slices along the rod, units, and
//! how other people's data compare. Nothing here looks back at the scene.

mod audit;
mod column;
mod flight;
mod hints;
mod norms;
mod restitution;
mod slice;
mod table;
mod touch;
mod unit;

pub use audit::{Audit, Books, EnergyChange, Extreme};
#[cfg(feature = "compare")]
pub(crate) use column::Place;
pub use column::{Column, Rays, columns};
pub(crate) use column::{natural_scales, of_one_size};
pub use flight::{Flight, flights};
pub use hints::{Finding, Hint, Measures, Pair, gathered, of_contacts, of_impulses};
pub use norms::{Greatest, Grid, Norm, Norms, norms, order};
pub use restitution::{EnergyShares, Restitution, Undefined, energy_shares, restitution};
pub use slice::{Slice, slices};
pub use table::{Columns, Table, table};
pub use touch::{Moments, Touch, matched, touches};
pub use unit::{Measure, UnitSystem, Units};
