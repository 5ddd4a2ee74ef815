//! The subcommands, one file each.

pub(crate) mod chain;
mod chain_rows;
pub(crate) mod check;
pub(crate) mod cite;
pub(crate) mod compare;
pub(crate) mod cost;
pub(crate) mod explain;
pub(crate) mod figures;
pub(crate) mod orbits;
pub(crate) mod plot;
pub(crate) mod regimes;
pub(crate) mod sample;
mod sample_args;
pub(crate) mod scenes;
pub(crate) mod solve;
pub(crate) mod sweep;
