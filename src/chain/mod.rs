//! Undamped chains of bars: bodies one above the other, joined by contact or bonded, between two ends.
//!
//! The invariants `p = v_t − c v_x` (upward) and `q = v_t + c v_x` (downward) travel through a body unchanged in the
//! frame that falls with `g`. All that happens, happens at the nodes: the ends of the chain and the joints. With
//! `Y = 1/Z` and the compressive force `f`, every node obeys one law,
//!
//! ```text
//! v₋ = A₋ − Y₋f    leaving downward  A₋ − 2Y₋f
//! v₊ = A₊ + Y₊f    leaving upward    A₊ + 2Y₊f    gap′ = (A₊ − A₋) + (Y₋ + Y₊) f
//! ```
//!
//! where `A₋`, `A₊` arrive from below and from above: a wave, or the velocity of a ground (`Y = 0`), or that of an
//! undisturbed half-infinite bar. The laws differ in `f` alone.
//!
//! The code is generic over [`crate::number::Bounded`]: estimates, fractions and enclosures.
//!
//! Reading order: `body` and `definition` (the chain in exact numbers), `wave` (travelling signals), `start` (numbers
//! and initial waves), `law` (the force of each node), `node` (state and events of a node), `march` (the event loop),
//! `run` (a finished run), `field` (queries along a body), `sums` (energies and centre of a body), `body_motion` (a body with the queries of a rod), `answers`
//! (a run in any numbers), `scales` (sizes that bounds are held against), `listing` (events, contacts and forces in one list), `history` (answers in numbers that are long
//! enough), `column` (names of the numbers of a chain), `numbers` (numbers that are asked for together), `parameter`
//! (names of its values), `foresee` (wave pieces before a run). Chains with springs, dashpots or masses have, in place
//! of `node`, `curve` (signals that are polynomials), `exact` (exact forms of times), `interface` (a node with its
//! signals), `linear` (states that act on each other, and those that decay fast), `response` (bounds of their
//! response), `step` (the solution over a step), `norm` (bounds of its error), `cluster` (nodes that act on each other
//! at once), `breaks` (changes of the signals that reach it), `onset` (the start of the motion of contacts that touch),
//! `peak` (greatest values).

mod answers;
mod body;
mod body_motion;
mod breaks;
mod cluster;
mod column;
mod confirm;
mod curve;
mod definition;
mod exact;
mod field;
mod foresee;
mod history;
mod interface;
mod law;
mod linear;
mod listing;
mod march;
mod node;
mod norm;
mod numbers;
mod onset;
mod parameter;
mod peak;
mod response;
mod run;
mod scales;
mod start;
mod step;
mod sums;
mod varied;
mod wave;

pub use answers::ChainTime;
pub(crate) use body::steepest;
pub use body::{Body, BodyMaterial, Points};
pub(crate) use body_motion::{BodyMotion, Runs};
pub use column::{ChainColumn, ChainContactQuantity, ChainQuantity, ChainQuery};
pub use definition::{Chain, ChainBuilder, End, Joint, MAX_PIECES, Spring};
pub use foresee::ForeseenPieces;
pub use history::{ChainHistory, ChainRow};
pub use listing::ChainListing;
pub use numbers::ChainNumbers;
pub(crate) use numbers::RowKey;
pub use parameter::{ChainParameter, ChainValue, UnknownChainParameter};
pub use run::{ChainContact, ChainEvent, ChainRun, ForcePiece, Touch};
pub use sums::BodySums;
pub(crate) use varied::Varied;

#[cfg(test)]
#[path = "tests"]
#[allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]
mod tests {
    #[cfg(feature = "mp")]
    mod confirm;
    mod conformance;
    mod peak;
    mod properties;
    #[path = "../../../tests/suite/random_chain.rs"]
    mod random_chain;
    mod reference;
    mod response;
}
