//! What follows from a history: restitution, the top of a flight, columns over time, and units. Nothing here looks back at the scene.

mod column;
mod flight;
mod restitution;
mod unit;

pub(crate) use column::of_one_size;
pub use column::{Column, columns};
pub use flight::{Flight, flights};
pub use restitution::{EnergyShares, Restitution, Undefined, energy_shares, restitution};
pub use unit::{Measure, UnitSystem, Units};
