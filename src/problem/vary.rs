//! A problem with other values: what a derivative is taken by, and what a fit turns.

use std::sync::LazyLock;

use super::given::Given;
use super::{Material, Parameter, Parameters, Problem, ProblemError, Profile, Speed, Start};
use crate::error::Error;
use crate::number::{Number, Rational, Scalar};

/// The names of the parameters that derivatives are taken by.
static ALL_DIFFERENTIABLE: LazyLock<String> =
    LazyLock::new(|| Parameter::all_differentiable().map(Parameter::name).collect::<Vec<_>>().join(", "));

/// Returns the product; `None` where it has too many digits.
fn times(number: &Number, factor: &Rational) -> Option<Number> {
    Number::of_rational(&(number.to_rational() * factor))
}

/// Returns a number that is greater by the part `step` of its size, or by `step` times a scale where it is zero; `None`
/// where zero has no smaller values, or the number has too many digits.
pub(crate) fn stepped(
    number: &Number,
    step: &Rational,
    only_grows: bool,
    scale_of_zero: impl FnOnce() -> Number,
) -> Option<Number> {
    match number.is_zero() {
        false if number.to_f64() < 0.0 => times(number, &(Rational::from(1) - step)),
        false => times(number, &(Rational::from(1) + step)),
        true if *step > Rational::default() || !only_grows => times(&scale_of_zero(), step),
        true => None,
    }
}

impl Parameter {
    /// Returns the step by which [`Parameter::moved`] brings it to `value`; `None` where there is none.
    fn step_to(self, problem: &Problem, value: f64) -> Option<Rational> {
        let value = format!("{value:e}").parse::<Number>().ok()?.to_rational();
        let now = self.value_in::<Rational>(problem, &()).ok()?;
        let unit = if now == Rational::default() { self.scale_of_zero(problem).to_rational() } else { now.magnitude() };
        Some((value - now) / unit)
    }

    /// Returns whether it is zero and has no smaller values.
    pub(crate) fn only_grows(self, problem: &Problem) -> bool {
        let zero = |number: Option<&Number>| number.is_none_or(Number::is_zero);
        match (self, &problem.start) {
            (Parameter::Damping, _) => zero(problem.damping.as_ref()),
            (Parameter::Gravity, _) => zero(problem.gravity.as_ref()),
            (Parameter::Stiffness, _) => zero(self.given(problem).as_ref()),
            (Parameter::ImpactSpeed, Start::Above { speed, .. }) => speed.is_zero(),
            (Parameter::OfChain(parameter), _) => {
                parameter.is_non_negative() && zero(problem.chain_value(parameter).as_ref())
            }
            // The end is on the ground.
            (Parameter::Displacement(Some(0)), _) => zero(self.list(problem).and_then(|list| Some(&list.first()?.1))),
            _ => false,
        }
    }

    /// Returns its value in the numbers of `S`, by which derivatives are taken.
    ///
    /// **Errors**: [`Error::Derivative`] where `problem` has no such value.
    pub(crate) fn value_in<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<S, Error> {
        let expected = match self {
            Parameter::Displacement(_) | Parameter::Strain(_) | Parameter::Velocity(_) => {
                "a start that has it, and no more points than there are"
            }
            Parameter::Modulus | Parameter::Density => "a material: modulus and density",
            Parameter::ImpactSpeed => "an impact, or a start above the ground",
            Parameter::Gap => "a start above the ground",
            Parameter::Stiffness => "a spring below the rod: [ground] stiffness or penalty in its scene",
            Parameter::OfChain(_) => "a body of a chain that has this value",
            _ => &ALL_DIFFERENTIABLE,
        };
        self.find(problem, precision)?.ok_or(Error::Derivative { parameter: self, expected })
    }

    /// Returns its value in `problem`; `None` where that has none.
    pub fn value(self, problem: &Problem) -> Option<f64> {
        self.find(problem, &()).ok().flatten()
    }

    /// Returns the parameter that the scene gives: Young's modulus in place of the modulus of waves that the problem
    /// has, see `InChain::young`.
    fn in_scene(self, problem: &Problem) -> Self {
        let young = || problem.in_chain.as_ref()?.young();
        if self == Parameter::Modulus { young().unwrap_or(self) } else { self }
    }

    /// Returns its value in the numbers of `S`; `None` where `problem` has none.
    fn find<S: Scalar>(self, problem: &Problem, precision: &S::Precision) -> Result<Option<S>, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        Ok(match (self.in_scene(problem), &problem.start) {
            (Parameter::WaveSpeed, _) => Some(rod.wave_speed),
            (Parameter::ImpactSpeed, Start::Uniform(_) | Start::Above { .. }) => Some(rod.speed),
            (Parameter::Displacement(None) | Parameter::Strain(None) | Parameter::Velocity(None), _) => {
                self.list(problem).filter(|list| !list.is_empty()).map(|_| rod.length.one())
            }
            (Parameter::OfChain(parameter), _) => {
                problem.chain_value(parameter).map(|number| S::from_number(&number, precision))
            }
            _ => self.number(&mut problem.clone()).map(|number| S::from_number(number, precision)),
        })
    }

    /// Returns the number that it is, or whose root it is, zero where nothing is given; `None` where no problem of this
    /// kind has one.
    fn number(self, problem: &mut Problem) -> Option<&mut Number> {
        let held = match (self, &problem.material, &problem.start) {
            _ if !self.is_differentiable() => return None,
            (Parameter::WaveSpeed, Material::Elastic { .. }, _) => Parameter::Modulus,
            (Parameter::ImpactSpeed, _, Start::Uniform(Speed::DropHeight(_))) => Parameter::DropHeight,
            _ => self,
        };
        match self {
            Parameter::Damping => Some(problem.damping.get_or_insert(0.into())),
            Parameter::Gravity => Some(problem.gravity.get_or_insert(0.into())),
            Parameter::Displacement(Some(k)) | Parameter::Strain(Some(k)) | Parameter::Velocity(Some(k)) => {
                self.list_mut(&mut problem.start)?.get_mut(k).map(|(_, value)| value)
            }
            _ => held.given_mut(problem),
        }
    }

    /// Returns the points of the list that it is, or is a point of, to be replaced.
    fn list_mut(self, start: &mut Start) -> Option<&mut Vec<(Number, Number)>> {
        let Start::Profile(Profile { displacement, strain, velocity }) = start else { return None };
        match self {
            Parameter::Displacement(_) => Some(displacement),
            Parameter::Strain(_) => Some(strain),
            Parameter::Velocity(_) => Some(velocity),
            _ => None,
        }
    }

    /// Returns `problem` with this value greater by the part `step` of its size, or by `step` times a scale of its own
    /// where it is zero; its square by the part `step` where that is what the problem has. `None` where no problem has
    /// such a value.
    pub(crate) fn moved(self, problem: &Problem, step: &Rational) -> Option<Problem> {
        let factor = Rational::from(1) + step;
        let grow = |number: &mut Number| times(number, &factor).map(|grown| *number = grown);
        let next = |number: &Number| stepped(number, step, self.only_grows(problem), || self.scale_of_zero(problem));
        let mut moved = problem.clone();
        match (self, &mut moved.start) {
            (Parameter::OfChain(parameter), _) => {
                let number = next(&problem.chain_value(parameter)?)?;
                return problem.with_chain_value(self, &number.into()).ok();
            }
            (Parameter::Length, Start::Profile(Profile { displacement, strain, velocity })) => {
                displacement.iter_mut().chain(strain).chain(velocity).try_for_each(|(x, _)| grow(x))?;
            }
            (Parameter::Displacement(None) | Parameter::Strain(None) | Parameter::Velocity(None), start) => {
                return self.list_mut(start)?.iter_mut().try_for_each(|(_, value)| grow(value)).map(|()| moved);
            }
            // The speed that a fall from a height gives stays as it is.
            (Parameter::Gravity, Start::Uniform(Speed::DropHeight(height))) => {
                *height = times(height, &(Rational::from(1) / &factor))?;
            }
            _ => {}
        }
        let number = self.number(&mut moved)?;
        *number = next(number)?;
        Some(moved)
    }

    /// Returns the power of it that the problem has, and that [`Parameter::moved`] moves.
    pub(crate) fn power(self, problem: &Problem) -> i64 {
        let square = match self {
            Parameter::WaveSpeed => matches!(problem.material, Material::Elastic { .. }),
            Parameter::ImpactSpeed => matches!(problem.start, Start::Uniform(Speed::DropHeight(_))),
            _ => false,
        };
        if square { 2 } else { 1 }
    }

    /// Returns the scale of a step from zero: `1/t₁`, `μ/t₁` or, without a speed, `c/1000 t₁`; for a speed
    /// that of a fall from the gap; for a point of the start the greatest value of its list,
    /// `L/1000`, 1/1000 or `c/1000`.
    pub(crate) fn scale_of_zero(self, problem: &Problem) -> Number {
        let rod = Parameters::<f64>::of(problem, &());
        let scale = rod.map_or(1.0, |rod| match self {
            Parameter::OfChain(parameter) => problem.chain().map_or(1.0, |(chain, _)| parameter.scale_of_zero(&chain)),
            Parameter::Gravity if rod.speed > 0.0 => rod.speed / rod.round_trip(),
            Parameter::Gravity => rod.wave_speed / rod.round_trip() / 1000.0,
            Parameter::ImpactSpeed => (2.0 * rod.gravity * problem.gap().map_or(0.0, Number::to_f64)).sqrt(),
            Parameter::Displacement(_) | Parameter::Strain(_) | Parameter::Velocity(_) => {
                let list = self.list(problem).unwrap_or_default();
                let most = list.iter().map(|(_, value)| value.to_f64().abs()).fold(0.0, f64::max);
                let natural = match self {
                    Parameter::Displacement(_) => rod.length,
                    Parameter::Strain(_) => 1.0,
                    _ => rod.wave_speed,
                };
                let least = natural / 1000.0;
                if most > 0.0 { most } else { least }
            }
            _ => rod.round_trip().recip(),
        });
        format!("{scale:e}").parse().unwrap_or_else(|_| 1.into())
    }

    /// Returns `problem` with `value` in place of its own.
    ///
    /// **Errors**: a value that no problem has.
    pub fn set(self, problem: &Problem, value: f64) -> Result<Problem, ProblemError> {
        if matches!(problem.start, Start::Profile(_))
            && (self == Parameter::Length || self.list(problem).is_some())
            && let Some(problem) = self.step_to(problem, value).and_then(|step| self.moved(problem, &step))
        {
            return problem.to_builder().build();
        }
        if let of_chain @ Parameter::OfChain(_) = self.in_scene(problem) {
            return problem.with_chain_value(of_chain, &value.into());
        }
        let written = |value: f64| Given::new("", self.name(), &value.into()).map(|given| given.number.clone());
        let given = |parameter: Parameter| parameter.value(problem).unwrap_or_default();
        let mut set = problem.clone();
        if let (Parameter::ImpactSpeed | Parameter::Gravity, Start::Uniform(speed)) = (self, &mut set.start) {
            // The speed that a fall from a height gives stays as it is.
            *speed = Speed::Given(written(given(Parameter::ImpactSpeed))?);
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
