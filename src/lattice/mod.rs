//! The undamped rod: rays, jumps and contact on the characteristic lattice.
//!
//! Without damping the Riemann invariants `p = v_t − c v_x` (upward) and `q = v_t + c v_x` (downward) travel unchanged
//! except for gravity. The whole solution is therefore the trace of `p` at the ground and a delay recursion:
//!
//! ```text
//! q(0,t) =  p(0,t−t₁) − g t₁   free top          contact:  v_t = 0,  p = −q,  v_x = q/c ≤ 0
//! q(0,t) = −p(0,t−t₁)          fixed top         flight:   v_x = 0,  p =  q,  v_t = q
//! ```
//!
//! `p` is piecewise linear. A break at age `f` of one round trip returns at the same age of every later one, so it is
//! stored as that fraction and never drifts. There is no time step: the march goes from break to break and from event
//! to event.
//!
//! The code is generic over [`crate::number::Bounded`]: estimates, fractions and enclosures.
//!
//! Reading order: `start` (units and initial data), `trace` (stored pieces), `march` (trip after trip), `ground`
//! (contact law and events), `history` (times on the lattice), `answers` (queries), `parts` (kinetic and strain
//! energy).

mod answers;
mod ground;
mod history;
mod march;
mod parts;
mod start;
mod trace;

pub use history::Undamped;
pub use march::{GroundMotion, Halt, Limits, Until, march};
pub use start::{Scaled, Units};
pub(crate) use trace::place_to;
pub use trace::{GroundEvent, Line, Piece, Trace};
