//! A problem with other values: what a derivative is taken by, and what a fit turns.

use super::{Material, Parameters, Problem, Profile, Rod, Speed, Start};
use super::{ProblemError, given::Given};
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
    /// `L`; the points of a start that is not uniform stay at the same parts of it.
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
    /// A factor of the displacement at the start, 1 as it is; or the value at one of its points, counted from 0.
    StartDisplacement(Option<usize>),
    /// The same of the velocity at the start.
    StartVelocity(Option<usize>),
}

impl Parameter {
    /// All of them, with their names.
    pub const ALL: [(&'static str, Parameter); 10] = [
        ("length", Parameter::Length),
        ("wave_speed", Parameter::WaveSpeed),
        ("modulus", Parameter::Modulus),
        ("density", Parameter::Density),
        ("damping", Parameter::Damping),
        ("gravity", Parameter::Gravity),
        ("speed", Parameter::Speed),
        ("gap", Parameter::Gap),
        ("displacement", Parameter::StartDisplacement(None)),
        ("velocity", Parameter::StartVelocity(None)),
    ];

    /// Its name; that of the list for a point of the start.
    pub fn name(self) -> &'static str {
        let list = match self {
            Parameter::StartDisplacement(_) => Parameter::StartDisplacement(None),
            Parameter::StartVelocity(_) => Parameter::StartVelocity(None),
            other => other,
        };
        Self::ALL.iter().find(|(_, parameter)| *parameter == list).map_or("", |(name, _)| name)
    }

    /// The step by which [`Parameter::moved`] brings it to `value`; `None` where there is none.
    fn step_to(self, problem: &Problem, value: f64) -> Option<Rational> {
        let value = format!("{value:e}").parse::<Number>().ok()?.to_rational();
        let now = self.value_in::<Rational>(problem, &()).ok()?;
        let unit = if now == Rational::default() { self.scale_of_zero(problem).to_rational() } else { now.clone() };
        Some((value - now) / unit)
    }

    /// The place in its list, for a point of the start.
    pub(super) fn point(self) -> Option<usize> {
        match self {
            Parameter::StartDisplacement(point) | Parameter::StartVelocity(point) => point,
            _ => None,
        }
    }

    /// The list of the start that it is of.
    pub(super) fn list(self, problem: &Problem) -> Option<&[(Number, Number)]> {
        let Start::Profile(profile) = &problem.start else { return None };
        match self {
            Parameter::StartDisplacement(_) => Some(&profile.displacement),
            Parameter::StartVelocity(_) => Some(&profile.velocity),
            _ => None,
        }
    }

    /// Whether it is zero and has no smaller values.
    pub(crate) fn only_grows(self, problem: &Problem) -> bool {
        let zero = |number: Option<&Number>| number.is_none_or(Number::is_zero);
        match (self, &problem.start) {
            (Parameter::Damping, _) => zero(problem.rod.damping.as_ref()),
            (Parameter::Gravity, _) => zero(problem.gravity.as_ref()),
            (Parameter::Speed, Start::Above { speed, .. }) => speed.is_zero(),
            // The end is on the ground.
            (Parameter::StartDisplacement(Some(0)), _) => {
                zero(self.list(problem).and_then(|list| Some(&list.first()?.1)))
            }
            _ => false,
        }
    }

    /// Its value in the numbers of `S`, by which derivatives are taken.
    ///
    /// **Errors**: [`Error::Derivative`] where `problem` has no such value.
    pub(crate) fn value_in<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<S, Error> {
        let expected = match self {
            Parameter::StartDisplacement(_) | Parameter::StartVelocity(_) => {
                "a start that has it, and no more points than there are"
            }
            Parameter::Modulus | Parameter::Density => "a material: modulus and density",
            Parameter::Speed => "an impact, or a start above the ground",
            _ => "a start above the ground",
        };
        self.find(problem, precision)?.ok_or(Error::Derivative { parameter: self.name(), expected })
    }

    /// Its value in `problem`; `None` where that has none.
    pub fn value(self, problem: &Problem) -> Option<f64> {
        self.find(problem, &()).ok().flatten()
    }

    fn find<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<Option<S>, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        Ok(match (self, &problem.start) {
            (Parameter::WaveSpeed, _) => Some(rod.wave_speed),
            (Parameter::Speed, Start::Uniform(_) | Start::Above { .. }) => Some(rod.speed),
            (Parameter::StartDisplacement(None) | Parameter::StartVelocity(None), _) => {
                self.list(problem).filter(|list| !list.is_empty()).map(|_| rod.length.one())
            }
            _ => self.number(&mut problem.clone()).map(|number| S::from_number(number, precision)),
        })
    }

    /// The number that it is, or whose root it is, zero where nothing is given; `None` where no problem of this kind
    /// has one.
    fn number(self, problem: &mut Problem) -> Option<&mut Number> {
        let Rod { length, material, damping, .. } = &mut problem.rod;
        match (self, material, &mut problem.start) {
            (Parameter::Length, ..) => Some(length),
            (Parameter::Damping, ..) => Some(damping.get_or_insert(0.into())),
            (Parameter::Gravity, ..) => Some(problem.gravity.get_or_insert(0.into())),
            (Parameter::WaveSpeed, Material::WaveSpeed(value), _)
            | (Parameter::WaveSpeed | Parameter::Modulus, Material::Elastic { modulus: value, .. }, _)
            | (Parameter::Density, Material::Elastic { density: value, .. }, _)
            | (Parameter::Gap, _, Start::Above { gap: value, .. })
            | (Parameter::Speed, _, Start::Uniform(Speed::Given(value) | Speed::DropHeight(value)))
            | (Parameter::Speed, _, Start::Above { speed: value, .. }) => Some(value),
            (Parameter::StartDisplacement(Some(k)), _, Start::Profile(Profile { displacement: list, .. }))
            | (Parameter::StartVelocity(Some(k)), _, Start::Profile(Profile { velocity: list, .. })) => {
                list.get_mut(k).map(|(_, value)| value)
            }
            _ => None,
        }
    }

    /// `problem` with this value greater by the part `step` of itself, or by `step` times a scale of its own where it
    /// is zero; its square by the part `step` where that is what the problem has. `None` where no problem has such a
    /// value.
    pub(crate) fn moved(self, problem: &Problem, step: &Rational) -> Option<Problem> {
        let factor = Rational::from(1) + step;
        let by = |number: &Number, factor: &Rational| Number::of_rational(&(number.to_rational() * factor));
        let grow = |number: &mut Number| by(number, &factor).map(|grown| *number = grown);
        let mut moved = problem.clone();
        match (self, &mut moved.start) {
            (Parameter::Length, Start::Profile(Profile { displacement, velocity })) => {
                displacement.iter_mut().chain(velocity).try_for_each(|(x, _)| grow(x))?;
            }
            (Parameter::StartDisplacement(None), Start::Profile(Profile { displacement: list, .. }))
            | (Parameter::StartVelocity(None), Start::Profile(Profile { velocity: list, .. })) => {
                return list.iter_mut().try_for_each(|(_, value)| grow(value)).map(|()| moved);
            }
            // The speed that a fall from a height gives stays as it is.
            (Parameter::Gravity, Start::Uniform(Speed::DropHeight(height))) => {
                *height = by(height, &(Rational::from(1) / &factor))?;
            }
            _ => {}
        }
        let number = self.number(&mut moved)?;
        if !number.is_zero() {
            grow(number)?;
        } else if *step > Rational::default() || !self.only_grows(problem) {
            *number = by(&self.scale_of_zero(problem), step)?;
        } else {
            // Zero has values on one side only.
            return None;
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
    /// that of a fall from the gap; for a point of the start the greatest value of its list, `L/1000` or `c/1000`.
    pub(crate) fn scale_of_zero(self, problem: &Problem) -> Number {
        let rod = Parameters::<f64>::of(problem, &());
        let scale = rod.map_or(1.0, |rod| match self {
            Parameter::Gravity if rod.speed > 0.0 => rod.speed / rod.round_trip(),
            Parameter::Gravity => rod.wave_speed / rod.round_trip() / 1000.0,
            Parameter::Speed => (2.0 * rod.gravity * problem.gap().map_or(0.0, Number::to_f64)).sqrt(),
            Parameter::StartDisplacement(_) | Parameter::StartVelocity(_) => {
                let list = self.list(problem).unwrap_or_default();
                let most = list.iter().map(|(_, value)| value.to_f64().abs()).fold(0.0, f64::max);
                let length = matches!(self, Parameter::StartDisplacement(_));
                let least = if length { rod.length } else { rod.wave_speed } / 1000.0;
                if most > 0.0 { most } else { least }
            }
            _ => rod.round_trip().recip(),
        });
        format!("{scale:e}").parse().unwrap_or_else(|_| 1.into())
    }

    /// `problem` with `value` in place of its own.
    ///
    /// **Errors**: a value that no problem has.
    pub fn set(self, problem: &Problem, value: f64) -> Result<Problem, ProblemError> {
        if matches!(problem.start, Start::Profile(_))
            && (self == Parameter::Length || self.list(problem).is_some())
            && let Some(problem) = self.step_to(problem, value).and_then(|step| self.moved(problem, &step))
        {
            return problem.to_builder().build();
        }
        let written = |value: f64| Given::new("", self.name(), &value.into()).map(|given| given.number.clone());
        let given = |parameter: Parameter| parameter.value(problem).unwrap_or_default();
        let mut set = problem.clone();
        if let (Parameter::Speed | Parameter::Gravity, Start::Uniform(speed)) = (self, &mut set.start) {
            // The speed that a fall from a height gives stays as it is.
            *speed = Speed::Given(written(given(Parameter::Speed))?);
        }
        let value = match (self, self.power(problem)) {
            (Parameter::WaveSpeed, 2) => value * value * given(Parameter::Density),
            _ => value,
        };
        if let Some(number) = self.number(&mut set) {
            *number = written(value)?;
        }
        set.to_builder().build()
    }
}

impl std::fmt::Display for Parameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.point() {
            Some(point) => f.pad(&format!("{}[{point}]", self.name())),
            None => f.pad(self.name()),
        }
    }
}

impl std::str::FromStr for Parameter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, point) = match text.trim().strip_suffix(']').and_then(|text| text.split_once('[')) {
            Some((name, point)) => (name, Some(point.parse::<usize>().ok())),
            None => (text.trim(), None),
        };
        let found = Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, parameter)| *parameter);
        let found = match (found, point) {
            (found, None) => found,
            (Some(Parameter::StartDisplacement(_)), Some(Some(k))) => Some(Parameter::StartDisplacement(Some(k))),
            (Some(Parameter::StartVelocity(_)), Some(Some(k))) => Some(Parameter::StartVelocity(Some(k))),
            _ => None,
        };
        let names = || Self::ALL.map(|(name, _)| name).join(", ");
        found.ok_or_else(|| format!("found `{text}`, expected some of {}, or a point: velocity[0]", names()))
    }
}
