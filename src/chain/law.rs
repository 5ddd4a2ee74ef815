//! The force of a node, and the waves that leave it.

use crate::lattice::Line;
use crate::number::{Bounded, is_exact_zero};

/// The law of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Law {
    /// A given force: an end that is free or loaded. The force arrives as the signal of the outer side.
    Force,
    /// `gap′ = 0`: bonded, fixed, moved, or bonded to a half-infinite bar.
    Held,
    /// Unilateral contact: `f = 0` while open; as [`Law::Held`] while closed, where `f ≥ 0`.
    Contact,
}

/// Coefficients of a node, combined so that the bound of a wave grows as little as possible.
#[derive(Clone, Debug)]
pub(super) struct Mix<N> {
    /// `r = (Z₋ − Z₊)/(Z₋ + Z₊)`; 1 above a rigid ground, −1 below one.
    pub(super) reflection: N,
    /// `1 − r` and `1 + r`.
    pub(super) passed: [N; 2],
    /// `1/Y = Z₋Z₊/(Z₋ + Z₊)`.
    pub(super) conductance: N,
    /// `2Y₋` and `2Y₊`.
    pub(super) twice: [N; 2],
    /// Whether the side below has no impedance.
    is_rigid_below: bool,
}

/// Signals that leave a node.
#[derive(Clone, Debug)]
pub(super) struct Leaving<N> {
    /// The compressive force.
    pub(super) force: Line<N>,
    /// The wave into the side below, and the wave into the side above.
    pub(super) waves: [Line<N>; 2],
}

impl<N: Bounded> Mix<N> {
    /// Combines the impedances below and above; a rigid side has none.
    pub(super) fn new(reflection: N, impedances: [Option<N>; 2], zero: &N) -> Self {
        let one = zero.one();
        let passed = [one.clone() - &reflection, one.clone() + &reflection];
        // With Z₊ given, Z₋/(Z₋ + Z₊) = (1 + r)/2.
        let conductance = match &impedances {
            [_, Some(above)] => (above.clone() * &passed[1]).halved(),
            [Some(below), None] => below.clone(),
            [None, None] => zero.zero(),
        };
        let is_rigid_below = impedances[0].is_none();
        let twice = impedances.map(|z| z.map_or_else(|| zero.zero(), |z| one.int(2) / z));
        Mix { reflection, passed, conductance, twice, is_rigid_below }
    }

    /// Returns the signals that leave a node on which `arriving` signals fall.
    ///
    /// **Source**: with `f = −y/Y` the leaving waves are `rA₋ + (1 − r)A₊` downward and `(1 + r)A₋ − rA₊` upward.
    pub(super) fn leaving(&self, law: Law, closed: bool, arriving: [&Line<N>; 2]) -> Leaving<N> {
        let [below, above] = arriving;
        match law {
            Law::Force => {
                // The side without compliance carries the pulling force; its own wave goes nowhere.
                let force = if self.is_rigid_below { -below.clone() } else { -above.clone() };
                let reaction = |k: usize| force.scaled(&self.twice[k]);
                let waves = [below.clone().minus(&reaction(0)), above.clone().plus(&reaction(1))];
                Leaving { force, waves }
            }
            Law::Contact if !closed => {
                let zero = below.intercept.zero();
                let force = Line { intercept: zero.clone(), slope: zero };
                Leaving { force, waves: [below.clone(), above.clone()] }
            }
            Law::Held | Law::Contact => {
                let force = below.clone().minus(above).scaled(&self.conductance);
                let equal = is_exact_zero(&self.reflection);
                let waves = match equal {
                    true => [above.clone(), below.clone()],
                    false => [
                        below.scaled(&self.reflection).plus(&above.scaled(&self.passed[0])),
                        below.scaled(&self.passed[1]).minus(&above.scaled(&self.reflection)),
                    ],
                };
                Leaving { force, waves }
            }
        }
    }
}
