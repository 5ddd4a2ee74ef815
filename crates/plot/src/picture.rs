//! Kinds of pictures.

use std::str::FromStr;

use strum::{Display, EnumIter, EnumMessage, EnumString, IntoEnumIterator, IntoStaticStr, VariantArray};

use dalembert::quantity::{Measure, Needs, Quantity, Units};

/// Picture of one or several scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumIter, EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum Picture {
    /// Field, rays and contacts in the x–t plane.
    #[strum(serialize = "xt")]
    SpaceTime,
    /// Stress at the ground.
    Stress,
    /// Displacements of both ends and of the centre of mass.
    #[strum(serialize = "motion", serialize = "ends")]
    Motion,
    /// Parts of the energy, stacked.
    Energy,
    /// Coefficients of restitution of each bounce.
    Restitution,
    /// Quantity over time.
    #[strum(disabled)]
    Quantity(Quantity),
}

/// Refusal of a word that names no picture.
#[derive(Debug, thiserror::Error)]
#[error("found no picture of this name, expected one of {}", Picture::names().collect::<Vec<_>>().join(", "))]
pub struct UnknownPicture;

impl Picture {
    /// Pictures of one scene, unless others are asked for.
    pub const SHEET: [Picture; 4] = [Picture::SpaceTime, Picture::Stress, Picture::Motion, Picture::Energy];
    /// Pictures of several scenes, unless others are asked for.
    pub const COMPARED: [Picture; 4] = [
        Picture::Stress,
        Picture::Quantity(Quantity::EndDisplacement),
        Picture::Quantity(Quantity::Centre),
        Picture::Quantity(Quantity::VibrationalEnergy),
    ];

    /// Pictures of a chain, unless others are asked for.
    pub const CHAIN: [Picture; 4] = [
        Picture::SpaceTime,
        Picture::Quantity(Quantity::Force),
        Picture::Quantity(Quantity::Centre),
        Picture::Quantity(Quantity::Energy),
    ];

    /// Returns the words from which a picture is parsed.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let quantities = Needs::Time.quantities().map(Quantity::name);
        let quantities = quantities.filter(|name| matches!(name.parse(), Ok(Picture::Quantity(_))));
        Picture::iter().flat_map(|picture| picture.get_serializations()).copied().chain(quantities)
    }

    /// Returns the quantities whose values over time the picture shows.
    pub(crate) fn quantities(&self) -> Vec<Quantity> {
        match self {
            Picture::Motion => vec![Quantity::EndDisplacement, Quantity::Centre, Quantity::TopDisplacement],
            Picture::Energy => vec![Quantity::GravityEnergy, Quantity::TranslationalEnergy, Quantity::Energy],
            Picture::Quantity(quantity) => vec![*quantity],
            Picture::SpaceTime | Picture::Stress | Picture::Restitution => Vec::new(),
        }
    }
}

/// Parses a word such as `xt` or `stress`, or the name of a quantity over time.
impl FromStr for Picture {
    type Err = UnknownPicture;

    fn from_str(name: &str) -> Result<Self, UnknownPicture> {
        let quantity = || Needs::Time.named(name).filter(|found| !matches!(found, Quantity::Time | Quantity::Side));
        let picture = Picture::iter().find(|picture| picture.get_serializations().contains(&name));
        picture.or_else(|| quantity().map(Picture::Quantity)).ok_or(UnknownPicture)
    }
}

/// Quantity that the colours along the rod show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Display, EnumMessage, EnumString, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum FieldQuantity {
    /// `E v_x`; without a material the strain
    #[default]
    Stress,
    /// `v_t`
    Velocity,
    /// `v_x`
    Strain,
}

impl FieldQuantity {
    /// Returns the unit of the field. Without a modulus the stress is the strain.
    pub(crate) fn measure(self, units: &Units) -> Measure {
        match self {
            FieldQuantity::Stress if units.has_material() => Measure::Stress,
            FieldQuantity::Stress | FieldQuantity::Strain => Measure::Strain,
            FieldQuantity::Velocity => Measure::Velocity,
        }
    }
}
