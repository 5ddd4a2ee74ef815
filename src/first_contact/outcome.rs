//! What the search for the end of the contact answers.

use super::field::Trips;
use crate::reason::{Doubt, NoBounceReason};

/// How the contact ends.
#[derive(Clone, Debug)]
pub enum Bounce<N> {
    /// The ground lets go.
    At {
        /// `t_b`.
        time: N,
        /// The same in round trips.
        trips: Trips<N>,
        /// At a jump of the stress or at a root.
        kind: BounceKind,
    },
    /// The stress never becomes tensile.
    Never(NoBounceReason),
    /// Neither could be shown.
    Undecided {
        /// Up to here there is no bounce.
        until: N,
        /// What stands in the way.
        why: Doubt,
    },
}

/// What the stress does at the bounce.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BounceKind {
    /// It jumps to a tensile value at a lattice time `k t₁`.
    Jump,
    /// It rises through zero.
    Root,
}
