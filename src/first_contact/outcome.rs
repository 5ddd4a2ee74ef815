//! How the contact ends: with a bounce, without one for a reason, or in doubt.

use std::fmt::{Display, Formatter, Result};

use super::field::Trips;

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

impl<N> Bounce<N> {
    /// The same answer in other numbers.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Bounce<M> {
        match self {
            Bounce::At { time, trips, kind } => Bounce::At { time: f(time), trips: trips.map(f), kind: *kind },
            Bounce::Never(reason) => Bounce::Never(reason.clone()),
            Bounce::Undecided { until, why } => Bounce::Undecided { until: f(until), why: why.clone() },
        }
    }
}

/// Why the stress never becomes tensile.
#[derive(Clone, Debug, PartialEq)]
pub enum NoBounceReason {
    /// Neither speed nor gravity.
    NothingMoves,
    /// `R ≥ π`: the lowest mode is overdamped and outweighs all others from `t₁` on.
    Overdamped {
        /// `R = r t₁`.
        damping_ratio: f64,
        /// How many times as hard as all others could pull the lowest mode presses at `t₁`.
        margin: f64,
    },
    /// The transient can no longer lift what the static stress holds down.
    SettlesUnderWeight {
        /// From this many round trips on.
        trips: i64,
        /// A bound of the transient, as a part of the static stress `gL/c²`.
        part: f64,
    },
}

impl Display for NoBounceReason {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            NoBounceReason::NothingMoves => f.write_str("neither speed nor gravity: nothing moves"),
            NoBounceReason::Overdamped { damping_ratio, margin } => {
                let times = if *margin < 1000.0 { format!("{margin:.3}") } else { "more than 1000".into() };
                write!(
                    f,
                    "r t₁ = {damping_ratio:.6} ≥ π: the lowest mode is overdamped; at t₁ it presses {times} times as \
                     hard as all others together could pull, and it outgrows them from there"
                )
            }
            NoBounceReason::SettlesUnderWeight { trips, part } => write!(
                f,
                "from t = {trips} t₁ on the transient stays below {part:.4} of the static stress gL/c², and the rod \
                 settles under its weight"
            ),
        }
    }
}

/// Why neither a bounce nor its absence could be shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// An impact speed below zero, or a parameter that is not finite.
    Parameters,
    /// Whether gravity or damping vanish, or which speed is greater, is not settled.
    Sizes,
    /// `r t₁` may be on either side of π.
    NearPi,
    /// Just after this lattice time the stress may have either sign.
    AtLattice(i64),
    /// In the cell after this lattice time the stress is below every number that the precision holds.
    Faint(i64),
    /// In the cell after this lattice time rounding reaches so much of the stress.
    Rounding(i64, f64),
    /// Near this many round trips the stress may have either sign.
    NearZero(f64),
    /// `r t₁` is so close below π that the bounce comes after the cells that are searched.
    Late {
        /// `R = r t₁`.
        damping_ratio: f64,
        /// Cells that are searched.
        cells: i64,
        /// About when it would come without gravity, in round trips.
        expected: f64,
    },
    /// No bounce in so many cells, which is all that are searched.
    NoneFound(i64),
}

impl Doubt {
    /// Whether more bits could settle it.
    pub fn needs_bits(&self) -> bool {
        !matches!(self, Doubt::Parameters | Doubt::Late { .. } | Doubt::NoneFound(_))
    }
}

impl Display for Doubt {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Doubt::Parameters => f.write_str("an impact speed below zero, or a number that is not finite"),
            Doubt::Sizes => f.write_str("whether a parameter is zero or greater than another one cannot be told"),
            Doubt::NearPi => f.write_str("r t₁ cannot be told from π, from which on there is no bounce"),
            Doubt::AtLattice(k) => write!(f, "just after t = {k} t₁ the stress cannot be told from zero"),
            Doubt::Faint(k) => {
                write!(f, "between {k} t₁ and {} t₁ the stress is below every number that this precision holds", k + 1)
            }
            Doubt::Rounding(k, part) => {
                write!(f, "between {k} t₁ and {} t₁ rounding reaches {part:.1e} of the stress", k + 1)
            }
            Doubt::NearZero(trips) => write!(f, "near t = {trips:.9} t₁ the stress cannot be told from zero"),
            Doubt::Late { damping_ratio, cells, expected } => write!(
                f,
                "r t₁ = {damping_ratio} is just below π: no bounce within the limit of {cells} round trips; without \
                 gravity it comes at about {expected:.4e} t₁"
            ),
            Doubt::NoneFound(cells) => write!(f, "no bounce in {cells} round trips, which is the limit"),
        }
    }
}
