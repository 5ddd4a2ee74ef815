//! What follows from a history: restitution, the top of a flight, and units. Nothing here looks back at the scene.

mod flight;
mod restitution;
mod unit;

pub use flight::{Flight, flights};
pub use restitution::{EnergyShares, Restitution, Undefined, energy_shares, restitution};
pub use unit::{Measure, UnitSystem, Units};
