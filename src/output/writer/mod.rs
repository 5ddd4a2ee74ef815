//! One writer for each format.

#[cfg(feature = "npz")]
mod npz;
#[cfg(not(feature = "npz"))]
mod npz_absent;
#[cfg(not(feature = "npz"))]
use npz_absent as npz;

pub(super) use npz::Npz;
