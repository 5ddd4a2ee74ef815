//! What follows from a history: the table of quantities, and how each is asked; slices along the rod, units. Nothing
//! here looks back at the scene.

mod column;
#[cfg(feature = "compare")]
mod convert;
mod listing;
#[cfg(feature = "cli")]
mod one;
mod restitution;
mod slice;
mod table;
mod unit;

pub use column::columns;
pub(crate) use column::{along, finite, of_one_size};
#[cfg(feature = "compare")]
pub(crate) use convert::Conversion;
#[cfg(feature = "cli")]
pub(crate) use listing::of_contact;
pub(crate) use listing::values;
pub use listing::{Columns, Table, table};
#[cfg(feature = "cli")]
pub(crate) use listing::{Row, rows};
#[cfg(feature = "cli")]
pub(crate) use one::{Missing, One};
#[cfg(feature = "cli")]
pub(crate) use restitution::energy_shares;
pub use restitution::{Flight, Restitution, Undefined, flights, restitution};
pub(crate) use slice::SLICE;
pub use slice::{Slice, slices};
pub use table::{Needs, Quantity};
pub use unit::{Measure, UnitSystem, Units};
