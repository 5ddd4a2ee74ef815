//! What follows from a history: restitution, and the top of a flight. Nothing here looks back at the scene.

mod flight;
mod restitution;

pub use flight::{Flight, flights};
pub use restitution::{EnergyShares, Restitution, Undefined, energy_shares, restitution};
