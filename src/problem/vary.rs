//! A problem with other values: what a derivative is taken by, and what a fit turns.

#[cfg(feature = "compare")]
use super::ProblemError;
use super::{Material, Parameters, Problem, Start};
use crate::error::Error;
use crate::number::{Number, Scalar};

/// A value of the problem by which derivatives are taken, and which can be fitted.
///
/// ```
/// use dalembert::Parameter;
/// assert_eq!("wave_speed".parse(), Ok(Parameter::WaveSpeed));
/// assert_eq!(Parameter::Gap.name(), "gap");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `L`.
    Length,
    /// `c`; with a material by its modulus, the density as it is.
    WaveSpeed,
    /// `E`.
    Modulus,
    /// `ρ`, the modulus as it is.
    Density,
    /// `r`.
    Damping,
    /// `g`, the impact speed as it is.
    Gravity,
    /// `μ`: of an impact, or downwards at the start.
    Speed,
    /// How far the rod starts above the ground.
    Gap,
}

impl Parameter {
    /// All of them, with their names.
    pub const ALL: [(&'static str, Parameter); 8] = [
        ("length", Parameter::Length),
        ("wave_speed", Parameter::WaveSpeed),
        ("modulus", Parameter::Modulus),
        ("density", Parameter::Density),
        ("damping", Parameter::Damping),
        ("gravity", Parameter::Gravity),
        ("speed", Parameter::Speed),
        ("gap", Parameter::Gap),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, parameter)| *parameter == self).map_or("", |(name, _)| name)
    }

    /// Its value in the numbers of `S`, by which derivatives are taken.
    ///
    /// **Errors**: [`Error::Derivative`] where `problem` has no such value, or a start that would have to be stretched.
    pub(crate) fn value_in<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<S, Error> {
        let stretched = self == Parameter::Length && matches!(problem.start, Start::Profile(_));
        let expected = match self {
            _ if stretched => "a start without a profile, which would have to be stretched",
            Parameter::Modulus | Parameter::Density => "a material: modulus and density",
            Parameter::Speed => "an impact, or a start above the ground",
            _ => "a start above the ground",
        };
        let value = if stretched { None } else { self.find(problem, precision)? };
        value.ok_or(Error::Derivative { parameter: self.name(), expected })
    }

    /// Its value in `problem`; `None` where that has none.
    #[cfg(feature = "compare")]
    pub(crate) fn value(self, problem: &Problem) -> Option<f64> {
        self.find(problem, &()).ok().flatten()
    }

    fn find<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<Option<S>, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        let lift = |number: &Number| Some(S::from_number(number, precision));
        Ok(match (self, &problem.rod.material, &problem.start) {
            (Parameter::Length, ..) => Some(rod.length),
            (Parameter::WaveSpeed, ..) => Some(rod.wave_speed),
            (Parameter::Modulus, Material::Elastic { modulus, .. }, _) => lift(modulus),
            (Parameter::Density, Material::Elastic { density, .. }, _) => lift(density),
            (Parameter::Damping, ..) => Some(rod.damping),
            (Parameter::Gravity, ..) => Some(rod.gravity),
            (Parameter::Speed, _, Start::Uniform(_) | Start::Above { .. }) => Some(rod.speed),
            (Parameter::Gap, _, Start::Above { gap, .. }) => lift(gap),
            _ => None,
        })
    }

    /// `problem` with `value` in place of its own.
    ///
    /// **Errors**: a value that no problem has.
    #[cfg(feature = "compare")]
    pub(crate) fn set(self, problem: &Problem, value: f64) -> Result<Problem, ProblemError> {
        let given = |parameter: Parameter| parameter.value(problem).unwrap_or_default();
        let builder = problem.to_builder();
        // A material is given as a whole.
        let material = |modulus: f64, density: f64| match &problem.rod.material {
            Material::Elastic { area: Some(area), .. } => builder.clone().material(modulus, density, area.clone()),
            Material::Elastic { area: None, .. } => builder.clone().modulus(modulus).density(density),
            Material::WaveSpeed(_) => builder.clone().wave_speed((modulus / density).sqrt()),
        };
        let builder = match (self, &problem.rod.material, &problem.start) {
            (Parameter::Length, ..) => builder.length(value),
            (Parameter::WaveSpeed, Material::WaveSpeed(_), _) => builder.wave_speed(value),
            (Parameter::WaveSpeed, ..) => {
                let density = given(Parameter::Density);
                material(value * value * density, density)
            }
            (Parameter::Modulus, ..) => material(value, given(Parameter::Density)),
            (Parameter::Density, ..) => material(given(Parameter::Modulus), value),
            (Parameter::Damping, ..) => builder.damping(value),
            // The speed that a fall from a height gives stays as it is.
            (Parameter::Gravity, _, Start::Uniform(_)) => builder.gravity(value).impact_speed(given(Parameter::Speed)),
            (Parameter::Gravity, ..) => builder.gravity(value),
            (Parameter::Speed, ..) => builder.impact_speed(value),
            (Parameter::Gap, ..) => builder.gap(value),
        };
        builder.build()
    }
}

impl std::fmt::Display for Parameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

impl std::str::FromStr for Parameter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|(name, _)| *name == text.trim()).map(|(_, parameter)| *parameter);
        let names = || Self::ALL.map(|(name, _)| name).join(", ");
        found.ok_or_else(|| format!("found `{text}`, expected some of {}", names()))
    }
}
