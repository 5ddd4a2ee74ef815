//! Units and factors of quantities: the one place where strains become pascals and newtons.

use serde::Serialize;

use crate::number::{Number, Scalar};
use crate::problem::{Material, Parameters, Problem};

/// The measure of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::Display, strum::IntoStaticStr)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
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
    /// Returns the name in output.
    pub fn name(self) -> &'static str {
        self.into()
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

    /// Returns the name of the unit of `measure`, `per_area` where no cross-section is given; empty where there is none
    /// or none is known.
    pub(crate) fn name(self, measure: Measure, per_area: bool) -> &'static str {
        let [length, velocity, stress] = match self {
            UnitSystem::Si => ["m", "m/s", "Pa"],
            UnitSystem::Inch => ["in", "in/s", "psi"],
            UnitSystem::Millimetre => ["mm", "mm/s", "MPa"],
            UnitSystem::Other => ["", "", ""],
        };
        let [force, impulse, energy] = match (self, per_area) {
            (UnitSystem::Si, false) => ["N", "N s", "J"],
            (UnitSystem::Si, true) => ["N/m²", "N s/m²", "J/m²"],
            (UnitSystem::Inch, false) => ["lbf", "lbf s", "lbf in"],
            (UnitSystem::Inch, true) => ["lbf/in²", "lbf s/in²", "lbf/in"],
            (UnitSystem::Millimetre, false) => ["N", "N s", "mJ"],
            (UnitSystem::Millimetre, true) => ["N/mm²", "N s/mm²", "mJ/mm²"],
            (UnitSystem::Other, false) => ["", "", ""],
            (UnitSystem::Other, true) => ["per S"; 3],
        };
        match measure {
            Measure::Time if self == UnitSystem::Other => "",
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

/// Factors and names of units that turn the answers of a history, which are strains and values per `ρS`, into
/// quantities with a unit.
///
/// **Units**: those of the problem. With a material `E`, `ρ`, `S` stress is `E v_x`, force `−E S v_x`, and impulse and
/// energy are `ρS` times what the history answers; where no `S` is given all three are those of a unit of it, and their
/// units say so. Without a material there is neither stress nor force, and impulse and energy stay per linear density.
///
/// ```
/// use dalembert::{Problem, Units};
/// use dalembert::quantity::{Measure, UnitSystem};
/// let rod = Problem::builder().length(1).impact_speed(3);
/// let units = Units::new(&rod.clone().material(900, 2, 3).build()?, UnitSystem::Si);
/// assert_eq!((units.factor::<f64>(Measure::Stress, &()), units.name(Measure::Stress)), (Some(900.0), "Pa"));
/// assert_eq!((units.factor::<f64>(Measure::Force, &()), units.name(Measure::Force)), (Some(-2700.0), "N"));
/// assert_eq!((units.factor::<f64>(Measure::Energy, &()), units.name(Measure::Energy)), (Some(6.0), "J"));
/// let units = Units::new(&rod.clone().modulus(900).density(2).build()?, UnitSystem::Si);
/// assert_eq!((units.factor::<f64>(Measure::Force, &()), units.name(Measure::Force)), (Some(-900.0), "N/m²"));
/// let units = Units::new(&rod.wave_speed(1).build()?, UnitSystem::Si);
/// assert_eq!((units.factor::<f64>(Measure::Force, &()), units.name(Measure::Force)), (None, ""));
/// assert_eq!((units.factor::<f64>(Measure::Energy, &()), units.name(Measure::Energy)), (Some(1.0), "per ρS"));
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    material: Material,
    system: UnitSystem,
}

/// The units of a problem without a material.
impl Default for Units {
    fn default() -> Self {
        Units { material: Material::WaveSpeed(1.into()), system: UnitSystem::default() }
    }
}

impl Units {
    /// Returns the units of `problem`, whose numbers are in `system`.
    pub fn new(problem: &Problem, system: UnitSystem) -> Self {
        Units { material: problem.material().clone(), system }
    }

    /// Returns units without names, for forces, impulses and energies that are numbers by themselves, as those of rigid
    /// masses are.
    pub fn unnamed() -> Self {
        let [modulus, density] = [1.into(), 1.into()];
        Units { material: Material::Elastic { modulus, density, area: Some(1.into()) }, system: UnitSystem::Other }
    }

    /// Returns whether the scene gives modulus and density.
    pub fn has_material(&self) -> bool {
        matches!(self.material, Material::Elastic { .. })
    }

    /// Returns the name of the unit of `measure`: `Pa`; `per ρS` for impulse and energy without a material; empty where
    /// none is known.
    pub fn name(&self, measure: Measure) -> &'static str {
        match measure {
            _ if self.has_material() => {
                self.system.name(measure, matches!(self.material, Material::Elastic { area: None, .. }))
            }
            Measure::Impulse | Measure::Energy => "per ρS",
            _ => "",
        }
    }

    /// Returns `c`, `t₁`, `R` and `M` of a problem to six digits, each with its symbol; those that it has.
    pub fn parameters(&self, problem: &Problem, time: impl Fn(f64) -> String) -> Vec<String> {
        let Ok(rod) = Parameters::<f64>::of(problem, &()) else { return Vec::new() };
        let speed = format!("{} {}", rod.wave_speed.decimal(6), self.name(Measure::Velocity));
        let mut known = vec![format!("c = {}", speed.trim_end()), format!("t₁ = {}", time(rod.round_trip()))];
        let groups = problem.dimensionless();
        if groups.damping_ratio > 0.0 {
            known.push(format!("R = r t₁ = {}", groups.damping_ratio.decimal(6)));
        }
        if let Some(ratio) = groups.speed_ratio.filter(|ratio| ratio.is_finite()) {
            known.push(format!("M = μ/(g t₁) = {}", ratio.decimal(6)));
        }
        known
    }

    /// Returns the factor of `measure`: a strain `v_x` for stress and force, the value per `ρS` for impulse and
    /// energy, the value itself for all others. `None` for stress and force without a material.
    ///
    /// **Accuracy**: *exact* in fractions; one rounding for each number given and one for the product otherwise.
    pub fn factor<S: Scalar>(&self, measure: Measure, precision: &S::Precision) -> Option<S> {
        let lift = |number: &Number| S::from_number(number, precision);
        let times = |number: &Number, area: &Option<Number>| match area {
            Some(area) => lift(number) * lift(area),
            None => lift(number),
        };
        let one = || S::from_number(&1.into(), precision);
        match (measure, &self.material) {
            (Measure::Stress | Measure::Force, Material::WaveSpeed(_)) => None,
            (Measure::Stress, Material::Elastic { modulus, .. }) => Some(lift(modulus)),
            (Measure::Force, Material::Elastic { modulus, area, .. }) => Some(-times(modulus, area)),
            (Measure::Impulse | Measure::Energy, Material::Elastic { density, area, .. }) => Some(times(density, area)),
            _ => Some(one()),
        }
    }
}
