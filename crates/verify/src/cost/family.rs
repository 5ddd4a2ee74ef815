//! Families of routes, and the reasons to leave one out.

use crate::error::VerifyError;

/// A family of routes, with one name in a table and one colour in a picture; in the order in which they are shown.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::Display, strum::IntoStaticStr, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase")]
pub enum Family {
    /// The closed form of the first contact.
    #[strum(serialize = "closed form")]
    ClosedForm,
    /// The lattice: undamped, from event to event.
    Lattice,
    /// The chain, from node to node.
    Chain,
    /// Characteristic cells with the settings of the plan.
    #[strum(serialize = "cells, planned")]
    PlannedCells,
    /// Characteristic cells in doubles, to a given number of digits.
    Cells,
    /// The sum over modes.
    #[strum(serialize = "modal sum")]
    Modes,
    /// The paper's integrals by adaptive quadrature.
    #[strum(serialize = "printed integrals")]
    Printed,
    /// Finite differences at CFL = 1.
    #[strum(serialize = "finite differences")]
    Differences,
    /// Intervals with ends rounded outwards.
    Enclosures,
}

/// A reason to leave a route out of the table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OmissionReason {
    /// The route has no answer.
    #[error(transparent)]
    NoAnswer(#[from] VerifyError),
    /// The start or the top has no closed form.
    #[error("the start or the top is not the paper's, so the first contact has no closed form")]
    NoClosedForm,
    /// The event comes after the first contact.
    #[error("it covers the first contact only")]
    LaterEvent,
    /// The time comes after the end of the first contact.
    #[error("it covers the first contact only, which ends at t = {0:.6}")]
    LaterTime(f64),
    /// The first contact is not shown to last up to the time.
    #[error("it is undecided whether the first contact lasts beyond t = {0:.6}")]
    Undecided(f64),
    /// The lattice has no damping.
    #[error("the scene has damping, which couples the characteristics")]
    Damping,
    /// The plan of an undamped scene takes another route.
    #[error("the scene has no damping: the plan takes the {0}")]
    NoDamping(Family),
    /// The route solves a single rod on the ground.
    #[error("it solves a single rod on the ground")]
    InChain,
    /// The plan takes enclosures.
    #[error("the plan takes enclosures")]
    PlanEncloses,
    /// The route gives the vibrational energy only as a difference.
    #[error("gives the whole energy; E_z would be the difference of two")]
    WholeEnergy,
    /// The paper has integrated the undamped rod in closed form.
    #[error("without damping the paper itself has done its integrals")]
    IntegralsDone,
    /// The setting takes longer than the time that is left of so many seconds.
    #[error("not expected to fit into {0} seconds")]
    TooSlow(f64),
    /// The truth cannot be computed to the digits of the setting.
    #[error("no truth to hold it against: {0}")]
    NoTruth(VerifyError),
}
