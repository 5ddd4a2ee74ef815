//! Problems a small step apart, for difference quotients.

use super::{Material, Parameter, Parameters, Problem, Profile, Rod, Speed, Start};
use crate::number::{Number, Rational};

impl Parameter {
    /// `problem` with this value greater by the part `step` of itself, or by `step` times a scale of its own where it
    /// is zero; its square by the part `step` where that is what the problem has. `None` where no problem has such a
    /// value.
    pub(crate) fn moved(self, problem: &Problem, step: &Rational) -> Option<Problem> {
        let one = Rational::from(1);
        let by = |number: &Number, factor: Rational| Number::of_rational(&(number.to_rational() * factor));
        let more = |number: &Number| by(number, one.clone() + step);
        // Zero has values on one side only.
        let from_zero = || {
            let there = *step > Rational::default() || !self.only_grows(problem);
            there.then(|| by(&self.scale_of_zero(problem), step.clone()))?
        };
        let all = |list: &mut [(Number, Number)], of: fn(&mut (Number, Number)) -> &mut Number| {
            list.iter_mut().map(of).try_for_each(|number| more(number).map(|moved| *number = moved))
        };
        let mut moved = problem.clone();
        if let (Parameter::Length, Start::Profile(profile)) = (self, &mut moved.start) {
            all(&mut profile.displacement, |point| &mut point.0)?;
            all(&mut profile.velocity, |point| &mut point.0)?;
        }
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
            (Parameter::StartDisplacement(point), _, Start::Profile(Profile { displacement: list, .. }))
            | (Parameter::StartVelocity(point), _, Start::Profile(Profile { velocity: list, .. })) => match point {
                None => all(list, |point| &mut point.1)?,
                Some(k) => {
                    let (_, value) = list.get_mut(k)?;
                    *value = if value.is_zero() { from_zero()? } else { more(value)? };
                }
            },
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
}
