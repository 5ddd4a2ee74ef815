//! The undamped rod: rays, jumps and contact on the characteristic lattice, exactly.
//!
//! Without damping the Riemann invariants `p = v_t − c v_x` (upward) and `q = v_t + c v_x` (downward) travel unchanged but
//! for gravity, so the whole solution is the trace of `p` at the ground and a delay recursion:
//!
//! ```text
//! q(0,t) =  p(0,t−t₁) − g t₁   free top          contact:  v_t = 0,  p = −q,  v_x = q/c ≤ 0
//! q(0,t) = −p(0,t−t₁)          fixed top         flight:   v_x = 0,  p =  q,  v_t = q
//! ```
//!
//! `p` is piecewise linear. A break at age `f` of one round trip returns at the same age of every later one, so it is kept
//! as that fraction and never drifts. There is no time step: the march goes from break to break and from event to event.
//!
//! Reading order: `scaled` (units and start), `trace` (what is stored), `march` (how far, and what it leaves), `contact`
//! (contact law and events), `solution` (what can be asked, with the answers in a file of their own), `rays` (the jumps of Proposition 2).

mod contact;
mod march;
mod rays;
mod scaled;
mod solution;
mod trace;

pub use march::{Halt, Limits, Marched, Until, march};
pub use rays::{Ray, Rays, reflection};
pub use scaled::{Scaled, Units};
pub use solution::Undamped;
pub use trace::{Occurrence, Piece, Trace};
