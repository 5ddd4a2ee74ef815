//! Other people's signs, origins and factors, brought to ours.

use super::ours::Ours;
use crate::error::Error;
use crate::quantity::{Measure, Quantity, Sign};

/// The sign of forces, stresses and strains where the rod is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Compression {
    /// Forces, stresses and strains are positive in compression
    #[cfg_attr(feature = "cli", value(name = "+", alias = "positive"))]
    Positive,
    /// They are negative
    #[cfg_attr(feature = "cli", value(name = "-", alias = "negative"))]
    Negative,
}

/// Where displacements are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Origin {
    /// Where the undeformed rod stands on the ground
    #[default]
    Ground,
    /// Where the rod is at t = 0
    Start,
}

/// Which way displacements and velocities count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Axis {
    /// Away from the ground
    #[default]
    Up,
    /// Towards the ground
    Down,
}

/// The conventions of the data. By default those of ours: forces are positive in compression, strains and stresses in
/// tension.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Conventions {
    pub(crate) compression: Option<Compression>,
    pub(crate) origin: Origin,
    pub(crate) axis: Axis,
    pub(crate) energy_scale: f64,
}

impl Conventions {
    /// The factor that brings a quantity to our convention.
    fn factor(&self, quantity: Quantity) -> f64 {
        let flipped =
            |ours: Compression| if self.compression.is_some_and(|theirs| theirs != ours) { -1.0 } else { 1.0 };
        let way = if self.axis == Axis::Down { -1.0 } else { 1.0 };
        match quantity.sign() {
            Sign::Upwards => way,
            Sign::Tension => flipped(Compression::Negative),
            Sign::Compression => flipped(Compression::Positive),
            Sign::None if quantity.measure() == Some(Measure::Energy) => self.energy_scale,
            Sign::None => 1.0,
        }
    }

    /// Brings all quantities to our conventions.
    ///
    /// **Errors**: what the history cannot answer of the start.
    pub(super) fn apply(
        &self,
        ours: &Ours<'_>,
        quantities: &mut [(Quantity, Vec<f64>)],
        points: Option<&[f64]>,
    ) -> Result<(), Error> {
        for (what, values) in quantities {
            let factor = self.factor(*what);
            let starts = if self.origin == Origin::Start { ours.start(*what, points)? } else { None };
            for (k, value) in values.iter_mut().enumerate() {
                *value *= factor;
                if let Some(starts) = &starts {
                    *value += starts[k.min(starts.len() - 1)];
                }
            }
        }
        Ok(())
    }
}
