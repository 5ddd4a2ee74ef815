//! Which unit and which factor a quantity has: the one place where strains become pascals and newtons.

use serde::Serialize;

use crate::number::Scalar;
use crate::problem::{Material, Problem};

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A time.
    Time,
    /// A displacement, or the place of the centre of mass.
    Length,
    /// A velocity.
    Velocity,
    /// `v_x`: a strain.
    Strain,
    /// `E v_x`: a stress, negative in compression.
    Stress,
    /// `−E S v_x(0,t)`: the force of the ground on the rod, positive upwards.
    Force,
    /// `−E S ∫ v_x(0,t) dt`: momentum from the ground.
    Impulse,
    /// An energy.
    Energy,
}

impl Measure {
    /// The name in output: `impulse`.
    pub fn name(self) -> &'static str {
        match self {
            Measure::Time => "time",
            Measure::Length => "length",
            Measure::Velocity => "velocity",
            Measure::Strain => "strain",
            Measure::Stress => "stress",
            Measure::Force => "force",
            Measure::Impulse => "impulse",
            Measure::Energy => "energy",
        }
    }
}

/// The units that the numbers of a scene are in. They name what is printed; no number depends on them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum UnitSystem {
    /// Metre, kilogram, second.
    #[default]
    #[serde(rename = "SI")]
    Si,
    /// Inch, pound-force, second.
    #[serde(rename = "in-lbf-s")]
    Inch,
    /// Millimetre, newton, second: a density is in t/mm³.
    #[serde(rename = "mm-N-s")]
    Millimetre,
    /// Other consistent units, which are not named.
    #[serde(rename = "other")]
    Other,
}

impl UnitSystem {
    /// Every system, with the word that a scene has for it.
    pub const ALL: [(&'static str, UnitSystem); 4] = [
        ("SI", UnitSystem::Si),
        ("in-lbf-s", UnitSystem::Inch),
        ("mm-N-s", UnitSystem::Millimetre),
        ("other", UnitSystem::Other),
    ];

    /// The name of the unit of `measure`; empty where there is none or none is known.
    fn name(self, measure: Measure) -> &'static str {
        let [length, velocity, stress, force, impulse, energy] = match self {
            UnitSystem::Si => ["m", "m/s", "Pa", "N", "N s", "J"],
            UnitSystem::Inch => ["in", "in/s", "psi", "lbf", "lbf s", "lbf in"],
            UnitSystem::Millimetre => ["mm", "mm/s", "MPa", "N", "N s", "mJ"],
            UnitSystem::Other => return "",
        };
        match measure {
            Measure::Time => "s",
            Measure::Length => length,
            Measure::Velocity => velocity,
            Measure::Strain => "",
            Measure::Stress => stress,
            Measure::Force => force,
            Measure::Impulse => impulse,
            Measure::Energy => energy,
        }
    }
}

/// What turns the answers of a history, which are strains and values per `ρS`, into quantities with a unit.
///
/// **Units**: those of the problem. With a material `E`, `ρ`, `S` stress is `E v_x`, force `−E S v_x`, and impulse and
/// energy are `ρS` times what the history answers. Without one there is neither stress nor force, and impulse and
/// energy stay per linear density.
///
/// ```
/// use dalembert::{Measure, Problem, UnitSystem, Units};
/// let rod = Problem::builder().length(1).impact_speed(3);
/// let units = Units::of(&rod.clone().material(900, 2, 3).build()?, UnitSystem::Si);
/// assert_eq!((units.factor::<f64>(Measure::Stress, &()), units.name(Measure::Stress)), (Some(900.0), "Pa"));
/// assert_eq!((units.factor::<f64>(Measure::Force, &()), units.name(Measure::Force)), (Some(-2700.0), "N"));
/// assert_eq!((units.factor::<f64>(Measure::Energy, &()), units.name(Measure::Energy)), (Some(6.0), "J"));
/// let units = Units::of(&rod.wave_speed(1).build()?, UnitSystem::Si);
/// assert_eq!((units.factor::<f64>(Measure::Force, &()), units.name(Measure::Force)), (None, ""));
/// assert_eq!((units.factor::<f64>(Measure::Energy, &()), units.name(Measure::Energy)), (Some(1.0), "per ρS"));
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    material: Material,
    system: UnitSystem,
}

/// Those of a problem without a material.
impl Default for Units {
    fn default() -> Self {
        Units { material: Material::WaveSpeed(1.into()), system: UnitSystem::default() }
    }
}

impl Units {
    /// The units of `problem`, whose numbers are in `system`.
    pub fn of(problem: &Problem, system: UnitSystem) -> Self {
        Units { material: problem.rod.material.clone(), system }
    }

    /// Whether the scene gives modulus, density and area.
    pub fn has_material(&self) -> bool {
        matches!(self.material, Material::Elastic { .. })
    }

    /// The name of the unit of `measure`: `Pa`; `per ρS` for impulse and energy without a material; empty where none
    /// is known.
    pub fn name(&self, measure: Measure) -> &'static str {
        match measure {
            _ if self.has_material() => self.system.name(measure),
            Measure::Impulse | Measure::Energy => "per ρS",
            _ => "",
        }
    }

    /// What to multiply with to get `measure`: a strain `v_x` for stress and force, the value per `ρS` for impulse and
    /// energy, the value itself for all others. `None` for stress and force without a material.
    ///
    /// **Accuracy**: *exact* in fractions; one rounding for each number given and one for the product otherwise.
    pub fn factor<S: Scalar>(&self, measure: Measure, precision: &S::Precision) -> Option<S> {
        let lift = |number| S::from_number(number, precision);
        let one = || S::from_number(&1.into(), precision);
        match (measure, &self.material) {
            (Measure::Stress | Measure::Force, Material::WaveSpeed(_)) => None,
            (Measure::Stress, Material::Elastic { modulus, .. }) => Some(lift(modulus)),
            (Measure::Force, Material::Elastic { modulus, area, .. }) => Some(-(lift(modulus) * lift(area))),
            (Measure::Impulse | Measure::Energy, Material::Elastic { density, area, .. }) => {
                Some(lift(density) * lift(area))
            }
            _ => Some(one()),
        }
    }
}
