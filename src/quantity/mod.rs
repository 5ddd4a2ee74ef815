//! Quantities of a history: the table of them, their values, slices along the rod, units. Nothing here looks back at
//! the scene.

mod column;
mod convert;
mod listing;
mod name;
mod restitution;
mod slice;
mod table;
mod unit;
mod value_query;

pub use column::columns;
pub(crate) use column::{check_finite, columns_along, scaled};
pub use convert::Conversion;
pub(crate) use listing::values;
pub use listing::{Row, Table, contact_value, rows};
pub use restitution::{Flight, Restitution, Undefined, energy_shares, flights, restitution};
pub use slice::{SLICE, Slice, slices};
pub use table::{Needs, Quantity};
pub use unit::{Measure, UnitSystem, Units};
pub use value_query::{Missing, ValueQuery};
