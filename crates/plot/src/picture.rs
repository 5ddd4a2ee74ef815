//! Which pictures there are of a scene, and what each asks of a history.

use dalembert::quantity::{Measure, Needs, Quantity, Units};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// The rod over time: rays, field, contacts.
    Along,
    /// The stress at the ground.
    Stress,
    /// Both ends and the centre of mass.
    Motion,
    /// The parts of the energy, on top of each other.
    Energy,
    /// The coefficients of restitution of each bounce.
    Restitution,
    /// A column as `reference` names it.
    Quantity(Quantity),
}

/// What is drawn as colour along the rod.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    strum::Display,
    strum::EnumMessage,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Along {
    /// `E v_x`; without a material the strain
    #[default]
    Stress,
    /// `v_t`
    Velocity,
    /// `v_x`
    Strain,
}

impl Picture {
    /// Those that tell a scene.
    pub const SHEET: [Picture; 4] = [Picture::Along, Picture::Stress, Picture::Motion, Picture::Energy];
    /// Those that tell several scenes apart.
    pub const COMPARED: [Picture; 4] = [
        Picture::Stress,
        Picture::Quantity(Quantity::EndDisplacement),
        Picture::Quantity(Quantity::Centre),
        Picture::Quantity(Quantity::VibrationalEnergy),
    ];
    /// Names other than those of columns.
    pub const NAMES: [(&str, Picture); 6] = [
        ("xt", Picture::Along),
        ("stress", Picture::Stress),
        ("motion", Picture::Motion),
        ("ends", Picture::Motion),
        ("energy", Picture::Energy),
        ("restitution", Picture::Restitution),
    ];

    pub fn named(name: &str) -> Option<Picture> {
        let own = Picture::NAMES.iter().find(|known| known.0 == name).map(|known| known.1);
        let column = || Needs::Time.named(name).filter(|column| !matches!(column, Quantity::Time | Quantity::Side));
        own.or_else(|| column().map(Picture::Quantity))
    }

    /// What is asked of a history for it.
    pub(super) fn columns(&self) -> Vec<Quantity> {
        match self {
            Picture::Motion => vec![Quantity::EndDisplacement, Quantity::Centre, Quantity::TopDisplacement],
            Picture::Energy => vec![Quantity::GravityEnergy, Quantity::TranslationalEnergy, Quantity::Energy],
            Picture::Quantity(column) => vec![*column],
            Picture::Along | Picture::Stress | Picture::Restitution => Vec::new(),
        }
    }
}

impl Along {
    /// What it is with these units, a stress where there is a modulus, with its symbol and its name.
    pub(super) fn told(self, units: &Units) -> (Measure, &'static str, &'static str) {
        match self {
            Along::Stress if units.has_material() => (Measure::Stress, "E v_x", "stress"),
            Along::Stress | Along::Strain => (Measure::Strain, "v_x", "strain"),
            Along::Velocity => (Measure::Velocity, "v_t", "velocity"),
        }
    }
}
