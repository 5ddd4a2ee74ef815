//! The first contact in closed form: stress, bounce, motion, energy and field by the formulas of the paper, in numbers
//! that carry an error bound, estimates or enclosures.
//!
//! Each quantity is a sum over the rays that have arrived, with time in units of the round trip `t₁`. The remaining
//! parameters are `R = r t₁` and the weights `μ` and `μ₀ = g t₁` of two fixed solutions. `r = 0` is not a special case.

mod bounce;
mod field;
mod first_root;
mod history;
mod integrals;
mod outcome;
mod peak;
mod pieces;
mod rebound;
mod round_trip;
mod static_state;

pub use field::{FirstContact, Trips};
pub use history::ContactHistory;
pub use outcome::{Bounce, BounceKind};
pub use rebound::Rebound;
pub use round_trip::Kernels;
