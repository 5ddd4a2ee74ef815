//! One writer for each format.

mod arrays;
mod csv;
mod json;
#[cfg(feature = "npz")]
mod npz;
#[cfg(not(feature = "npz"))]
mod npz_absent;
mod table;
#[cfg(not(feature = "npz"))]
use npz_absent as npz;

pub(super) use arrays::npz;
pub(super) use csv::csv;
pub use json::SCHEMA;
pub(super) use json::objects;
pub(super) use npz::Npz;
pub(crate) use table::{WIDTH, wrapped};
pub(super) use table::{table, table_digits};
