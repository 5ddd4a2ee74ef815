//! A problem with other values: what a derivative is taken by, and what a fit turns.

#[cfg(feature = "compare")]
use super::ProblemError;
use super::{Material, Parameters, Problem, Rod, Speed, Start};
use crate::error::Error;
use crate::number::{Number, Rational, Scalar};

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

    /// Its value in the numbers of `S`.
    ///
    /// **Errors**: [`Error::Derivative`] where `problem` has no such value.
    pub(crate) fn value_in<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<S, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        let lift = |number: &Number| S::from_number(number, precision);
        let expected = match (self, &problem.rod.material, &problem.start) {
            (Parameter::Length, _, Start::Profile(_)) => "a start without a profile, which would have to be stretched",
            (Parameter::Length, ..) => return Ok(rod.length),
            (Parameter::WaveSpeed, ..) => return Ok(rod.wave_speed),
            (Parameter::Modulus, Material::Elastic { modulus, .. }, _) => return Ok(lift(modulus)),
            (Parameter::Density, Material::Elastic { density, .. }, _) => return Ok(lift(density)),
            (Parameter::Modulus | Parameter::Density, ..) => "a material: modulus and density",
            (Parameter::Damping, ..) => return Ok(rod.damping),
            (Parameter::Gravity, ..) => return Ok(rod.gravity),
            (Parameter::Speed, _, Start::Profile(_)) => "an impact, or a start above the ground",
            (Parameter::Speed, ..) => return Ok(rod.speed),
            (Parameter::Gap, _, Start::Above { gap, .. }) => return Ok(lift(gap)),
            (Parameter::Gap, ..) => "a start above the ground",
        };
        Err(Error::Derivative { parameter: self.name(), expected })
    }

    /// `problem` with this value greater by the part `step` of itself, or by `step` times a scale of its own where it is
    /// zero; its square by the part `step` where that is what the problem has. `None` where no problem has such a value.
    pub(crate) fn moved(self, problem: &Problem, step: &Rational) -> Option<Problem> {
        let one = Rational::from(1);
        let by = |number: &Number, factor: Rational| Number::of_rational(&(number.to_rational() * factor));
        let more = |number: &Number| by(number, one.clone() + step);
        // Zero has values on one side only.
        let from_zero = || (*step > Rational::default()).then(|| by(&self.scale_of_zero(problem), step.clone()))?;
        let mut moved = problem.clone();
        let Rod { length, material, damping, .. } = &mut moved.rod;
        match (self, material, &mut moved.start) {
            (Parameter::Length, ..) => *length = more(length)?,
            (Parameter::WaveSpeed, Material::WaveSpeed(value), _)
            | (Parameter::WaveSpeed | Parameter::Modulus, Material::Elastic { modulus: value, .. }, _)
            | (Parameter::Density, Material::Elastic { density: value, .. }, _)
            | (Parameter::Gap, _, Start::Above { gap: value, .. })
            | (Parameter::Speed, _, Start::Uniform(Speed::Given(value) | Speed::DropHeight(value))) => {
                *value = more(value)?;
            }
            (Parameter::Speed, _, Start::Above { speed, .. }) => {
                *speed = if speed.is_zero() { from_zero()? } else { more(speed)? };
            }
            (Parameter::Damping, ..) => *damping = Some(damping.as_ref().map_or_else(from_zero, more)?),
            (Parameter::Gravity, _, start) => {
                moved.gravity = Some(problem.gravity.as_ref().map_or_else(from_zero, more)?);
                // The speed that a fall from a height gives stays as it is.
                if let Start::Uniform(Speed::DropHeight(height)) = start {
                    *height = by(height, one.clone() / (one.clone() + step))?;
                }
            }
            _ => return None,
        }
        Some(moved)
    }

    /// The power of it that the problem has, and that [`Parameter::moved`] moves.
    pub(crate) fn power(self, problem: &Problem) -> i64 {
        let square = match self {
            Parameter::WaveSpeed => matches!(problem.rod.material, Material::Elastic { .. }),
            Parameter::Speed => matches!(problem.start, Start::Uniform(Speed::DropHeight(_))),
            _ => false,
        };
        if square { 2 } else { 1 }
    }

    /// What a value that is zero is moved by a part of: `1/t₁`, `μ/t₁` or, without a speed, `c/1000 t₁`; for a speed
    /// that of a fall from the gap.
    pub(crate) fn scale_of_zero(self, problem: &Problem) -> Number {
        let rod = Parameters::<f64>::of(problem, &());
        let scale = rod.map_or(1.0, |rod| match self {
            Parameter::Gravity if rod.speed > 0.0 => rod.speed / rod.round_trip(),
            Parameter::Gravity => rod.wave_speed / rod.round_trip() / 1000.0,
            Parameter::Speed => (2.0 * rod.gravity * Parameter::Gap.value(problem).unwrap_or_default()).sqrt(),
            _ => rod.round_trip().recip(),
        });
        format!("{scale:e}").parse().unwrap_or_else(|_| 1.into())
    }

    /// Its value in `problem`; `None` where that has none.
    pub(crate) fn value(self, problem: &Problem) -> Option<f64> {
        let rod = Parameters::<f64>::of(problem, &()).ok()?;
        match (self, &problem.rod.material, &problem.start) {
            (Parameter::Length, ..) => Some(rod.length),
            (Parameter::WaveSpeed, ..) => Some(rod.wave_speed),
            (Parameter::Modulus, Material::Elastic { modulus, .. }, _) => Some(modulus.to_f64()),
            (Parameter::Density, Material::Elastic { density, .. }, _) => Some(density.to_f64()),
            (Parameter::Damping, ..) => Some(rod.damping),
            (Parameter::Gravity, ..) => Some(rod.gravity),
            (Parameter::Speed, _, Start::Uniform(_)) => Some(rod.speed),
            (Parameter::Speed, _, Start::Above { speed, .. }) => Some(speed.to_f64()),
            (Parameter::Gap, _, Start::Above { gap, .. }) => Some(gap.to_f64()),
            _ => None,
        }
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

impl std::str::FromStr for Parameter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|(name, _)| *name == text.trim()).map(|(_, parameter)| *parameter);
        let names = || Self::ALL.map(|(name, _)| name).join(", ");
        found.ok_or_else(|| format!("found `{text}`, expected some of {}", names()))
    }
}
