//! What follows from a history: restitution, the top of a flight, columns over time, slices along the rod, units.
//! Nothing here looks back at the scene.

mod column;
mod flight;
mod restitution;
mod slice;
mod table;
mod unit;

#[cfg(feature = "compare")]
pub(crate) use column::Place;
pub use column::{Column, Rays, columns};
pub(crate) use column::{natural_scales, of_one_size};
pub use flight::{Flight, flights};
pub use restitution::{EnergyShares, Restitution, Undefined, energy_shares, restitution};
pub use slice::{Slice, slices};
pub use table::{Columns, Table, table};
pub use unit::{Measure, UnitSystem, Units};
