//! Result of the search for the end of the contact.

use super::field::Trips;
use crate::reason::{Doubt, NoBounceReason};

/// The end of the contact.
#[derive(Clone, Debug)]
pub enum Bounce<N> {
    /// A release.
    At {
        /// `t_b`.
        time: N,
        /// `t_b` in round trips.
        trips: Trips<N>,
        /// Behaviour of the stress at the bounce.
        kind: BounceKind,
    },
    /// The stress never becomes tensile.
    Never(NoBounceReason),
    /// An undecided search.
    Undecided {
        /// Time up to which there is no bounce.
        until: N,
        /// Obstacle to a decision.
        why: Doubt,
    },
}

/// Behaviour of the stress at the bounce.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BounceKind {
    /// The stress jumps to a tensile value at a lattice time `k t₁`.
    Jump,
    /// The stress rises through zero.
    Root,
}
