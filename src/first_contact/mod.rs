//! The first contact in closed form: stress, bounce, motion, energy and field as the paper has them.
//!
//! Everything is a sum over the rays that have arrived, with time in units of the round trip `t₁`: what remains of the
//! parameters are `R = r t₁` and the weights `μ` and `μ₀ = g t₁` of two fixed solutions. `r = 0` is a value like any
//! other.

mod bounce;
mod cells;
#[cfg(feature = "mp")]
mod enclosed;
mod energy;
mod field;
#[cfg(feature = "mp")]
mod peak;
mod rebound;
mod search;
mod within;

pub use bounce::{Bounce, BounceKind};
#[cfg(feature = "mp")]
pub(crate) use bounce::{Bracket, Found};
pub use field::{Estimate, FirstContact};
#[cfg(feature = "mp")]
pub(crate) use peak::Summit;
pub use rebound::Rebound;
