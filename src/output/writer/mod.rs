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

pub(crate) use json::SCHEMA;
pub(super) use npz::Npz;
pub(super) use table::table_digits;
pub(crate) use table::{WIDTH, wrapped};
