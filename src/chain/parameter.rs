//! Values of a chain by name: of its bodies, its joints and its ends.

use std::fmt;
use std::str::FromStr;

use super::body::{Body, BodyMaterial, Points};
use super::definition::{Chain, End, Joint};
use crate::error::{ProblemError, ProblemErrorKind as Kind};
use crate::number::{Number, Rational};
use crate::problem::Parameter;
use crate::quantity::Measure;

/// A kind of value that bodies, joints and ends of a chain have.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
)]
#[strum(serialize_all = "snake_case")]
pub enum ChainValue {
    /// Length of a bar; the points of its start are stretched with it.
    Length,
    /// Wave speed of a bar that is given by it.
    WaveSpeed,
    /// Impedance of a bar that is given by it.
    Impedance,
    /// Modulus of a bar that has a material: Young's, also where the sides are held.
    Modulus,
    /// Density of a bar that has a material.
    Density,
    /// Cross-section of a bar that has a material.
    Area,
    /// Mass of a rigid body.
    Mass,
    /// Velocity at the start of a body that has the same velocity everywhere.
    Velocity,
    /// Distance at the start of a contact.
    Gap,
    /// Stiffness of the spring of a joint or an end.
    Stiffness,
    /// Damping of the dashpot of a joint or an end.
    Damping,
}

impl ChainValue {
    fn is_of_node(self) -> bool {
        matches!(self, ChainValue::Gap | ChainValue::Stiffness | ChainValue::Damping)
    }
}

/// A value of a body, a joint or an end of a chain.
///
/// ```
/// use dalembert::chain::{Body, Chain, ChainParameter};
/// let bar = || Body::new(1.into(), 1.into(), 1.into());
/// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
/// let length: ChainParameter = "body.2.length".parse()?;
/// assert_eq!(chain.value(length), Some(1.into()));
/// let longer = chain.with_value(length, 3.into())?;
/// assert_eq!(longer.bodies()[1].length(), &3.into());
/// assert_eq!(chain.value("joint.1.gap".parse()?), Some(1.into()));
/// assert!("body.0.length".parse::<ChainParameter>().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ChainParameter {
    value: ChainValue,
    place: Place,
}

/// The owner of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Place {
    /// The body with this index.
    Body(usize),
    Bottom,
    /// The joint above the body with this number, from 1.
    Joint(usize),
    Top,
}

/// A text that names no value of a chain.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "found `{found}`, expected a value of a chain such as body.2.length, joint.1.gap, bottom.stiffness or top.gap; \
     bodies have {}, joints and ends have {}",
    names(false),
    names(true)
)]
pub struct UnknownChainParameter {
    /// The text.
    pub found: String,
}

/// Returns the values that nodes have, or those that bodies have.
fn names(of_node: bool) -> String {
    let all = <ChainValue as strum::VariantArray>::VARIANTS.iter();
    let names: Vec<&str> = all.filter(|value| value.is_of_node() == of_node).map(|value| (*value).into()).collect();
    names.join(", ")
}

impl FromStr for ChainParameter {
    type Err = UnknownChainParameter;

    /// Reads `body.2.length`, with bodies and joints counted from 1, the lowest; `ground.damping` is `bottom.damping`.
    fn from_str(text: &str) -> Result<Self, UnknownChainParameter> {
        let number = |text: &str| text.parse::<usize>().ok().filter(|n| *n > 0);
        let mut words = text.trim().split('.');
        let place = match words.next() {
            Some("body") => words.next().and_then(number).map(|n| Place::Body(n - 1)),
            Some("joint") => words.next().and_then(number).map(Place::Joint),
            // The spring below the lowest body may stand in the table of the ground.
            Some("bottom" | "ground") => Some(Place::Bottom),
            Some("top") => Some(Place::Top),
            _ => None,
        };
        let value = words.next().and_then(|word| word.parse::<ChainValue>().ok());
        let found = place.zip(value).filter(|(place, value)| value.is_of_node() != matches!(place, Place::Body(_)));
        match (found, words.next()) {
            (Some((place, value)), None) => Ok(ChainParameter { value, place }),
            _ => Err(UnknownChainParameter { found: text.to_string() }),
        }
    }
}

impl fmt::Display for ChainParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value;
        f.pad(&match self.place {
            Place::Body(k) => format!("body.{}.{value}", k + 1),
            Place::Joint(k) => format!("joint.{k}.{value}"),
            Place::Bottom => format!("bottom.{value}"),
            Place::Top => format!("top.{value}"),
        })
    }
}

impl ChainParameter {
    /// Returns the value of a chain that a parameter is.
    fn of(parameter: Parameter) -> Option<Self> {
        match parameter {
            Parameter::OfChain(value) => Some(value),
            Parameter::Stiffness => Some(ChainParameter { value: ChainValue::Stiffness, place: Place::Bottom }),
            _ => None,
        }
    }

    /// Returns the kind of value.
    pub const fn value(self) -> ChainValue {
        self.value
    }

    /// Returns the index of the body that the value is of; `None` for a joint or an end.
    pub fn body(self) -> Option<usize> {
        match self.place {
            Place::Body(k) => Some(k),
            _ => None,
        }
    }

    /// Returns the node of `chain` that the value is of, 0 at the bottom; `None` for a body.
    pub fn node(self, chain: &Chain) -> Option<usize> {
        let top = chain.bodies.len();
        match self.place {
            Place::Body(_) => None,
            Place::Bottom => Some(0),
            Place::Joint(k) => Some(k).filter(|k| *k < top),
            Place::Top => Some(top),
        }
    }

    /// Returns whether the value is zero or more, so that zero has greater values only.
    pub(crate) fn is_non_negative(self) -> bool {
        self.value != ChainValue::Velocity
    }

    /// Returns the scale of a step from zero in `chain`.
    pub(crate) fn scale_of_zero(self, chain: &Chain) -> f64 {
        let scale = |measure| chain.scale(measure);
        natural(match self.value {
            ChainValue::Velocity => scale(Measure::Velocity),
            ChainValue::Gap => scale(Measure::Length),
            ChainValue::Stiffness => scale(Measure::Force) / scale(Measure::Length),
            ChainValue::Damping => scale(Measure::Force) / scale(Measure::Velocity),
            _ => 1.0,
        })
    }
}

/// Returns a scale that is positive and finite, or one.
fn natural(scale: f64) -> f64 {
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}

impl Chain {
    /// Returns a value of the chain; `None` where it has none: a body, joint or end that there is not, or is given
    /// without this value, and the velocity of a body that has several.
    pub fn value(&self, parameter: ChainParameter) -> Option<Number> {
        let mut chain = self.clone();
        match parameter.value {
            ChainValue::Velocity => {
                let body = self.bodies.get(parameter.body()?)?;
                match &body.velocity[..] {
                    [] => Some(0.into()),
                    [(_, first), others @ ..] => {
                        others.iter().all(|(_, v)| v.compare(first).is_eq()).then(|| first.clone())
                    }
                }
            }
            _ => {
                let number = chain.number_mut(parameter)?.clone();
                match self.constraint(parameter) {
                    Some(constraint) => Number::of_rational(&(number.to_rational() / constraint)),
                    None => Some(number),
                }
            }
        }
    }

    /// Returns the modulus of waves over the one that the parameter is, if it is the modulus of a body whose sides are
    /// held.
    fn constraint(&self, parameter: ChainParameter) -> Option<&Rational> {
        let body = parameter.body().filter(|_| parameter.value == ChainValue::Modulus)?;
        self.bodies.get(body)?.constraint()
    }

    /// Returns the chain with `number` in place of one of its values.
    ///
    /// **Errors**: [`ProblemError`] where the chain has no such value, and those of
    /// [`ChainBuilder::build`](super::ChainBuilder::build).
    pub fn with_value(&self, parameter: ChainParameter, number: Number) -> Result<Chain, ProblemError> {
        self.with_values([(Parameter::OfChain(parameter), number)])
    }

    /// Returns the chain with these numbers in place of its own values: values of its bodies, joints and ends,
    /// [`Gravity`](Parameter::Gravity), the [`Stiffness`](Parameter::Stiffness) of the ground and the last
    /// [`Time`](Parameter::Time).
    ///
    /// **Errors**: [`ProblemError`] where the chain has no such value, and those of
    /// [`ChainBuilder::build`](super::ChainBuilder::build).
    ///
    /// ```
    /// use dalembert::Parameter;
    /// use dalembert::chain::{Body, Chain};
    /// let bar = || Body::new(1.into(), 1.into(), 1.into());
    /// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
    /// let longer = chain.with_values([("body.2.length".parse()?, 3.into()), (Parameter::Gravity, 10.into())])?;
    /// assert_eq!((longer.bodies()[1].length(), longer.gravity()), (&3.into(), &10.into()));
    /// assert!(chain.with_values([(Parameter::Damping, 1.into())]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_values(&self, values: impl IntoIterator<Item = (Parameter, Number)>) -> Result<Chain, ProblemError> {
        let mut chain = self.clone();
        for (parameter, number) in values {
            match parameter {
                Parameter::Gravity => chain.gravity = number,
                Parameter::Time => chain.until = number,
                _ => {
                    let replaced = ChainParameter::of(parameter).and_then(|value| chain.replaced(value, number));
                    chain = replaced.ok_or_else(|| self.has_no(parameter))?;
                }
            }
        }
        chain.checked()
    }

    /// Returns the chain with a number close to its own in place of a value, not checked: steps are smaller than the
    /// numbers of a scene; `None` where it has no such value.
    pub(crate) fn moved_to(&self, parameter: Parameter, number: Number) -> Option<Chain> {
        match parameter {
            Parameter::Gravity => Some(self.clone().with_gravity(number)),
            _ => self.replaced(ChainParameter::of(parameter)?, number),
        }
    }

    /// Returns the number that [`Chain::with_values`] replaces.
    ///
    /// **Errors**: [`ProblemError`] where the chain has no such value.
    pub fn number(&self, parameter: Parameter) -> Result<Number, ProblemError> {
        match parameter {
            Parameter::Gravity => Ok(self.gravity.clone()),
            Parameter::Time => Ok(self.until.clone()),
            _ => {
                ChainParameter::of(parameter).and_then(|value| self.value(value)).ok_or_else(|| self.has_no(parameter))
            }
        }
    }

    /// Returns whether a value is zero or more, so that zero has greater values only.
    pub(crate) fn is_non_negative(&self, by: Parameter) -> bool {
        ChainParameter::of(by).is_none_or(ChainParameter::is_non_negative)
    }

    /// Returns the scale of a step from zero of a value.
    pub(crate) fn scale_from_zero(&self, by: Parameter) -> f64 {
        let gravity = || natural(self.scale(Measure::Velocity) / self.scale(Measure::Time));
        ChainParameter::of(by).map_or_else(gravity, |parameter| parameter.scale_of_zero(self))
    }

    /// Returns the refusal of a value that the chain does not have.
    fn has_no(&self, parameter: Parameter) -> ProblemError {
        let known: Vec<String> = self.parameters().map(|parameter| parameter.to_string()).collect();
        ProblemError::new(
            Kind::OutOfRange,
            "",
            format!("the value {}", parameter.full_path()),
            format!("one that the chain has: {}, gravity.acceleration, run.time", known.join(", ")),
        )
    }

    /// Returns the values that the chain has.
    pub fn parameters(&self) -> impl Iterator<Item = ChainParameter> {
        let top = self.bodies.len();
        let bodies = (0..top).map(Place::Body);
        let nodes = [Place::Bottom].into_iter().chain((1..top).map(Place::Joint)).chain([Place::Top]);
        let values = <ChainValue as strum::VariantArray>::VARIANTS.iter().copied();
        let all = bodies.chain(nodes).flat_map(move |place| {
            let of_node = !matches!(place, Place::Body(_));
            values.clone().filter(move |value| value.is_of_node() == of_node).map(move |value| (place, value))
        });
        all.map(|(place, value)| ChainParameter { value, place }).filter(|parameter| self.value(*parameter).is_some())
    }

    /// Returns the chain with `number` in place of one of its values, not checked; `None` where it has no such value.
    pub(crate) fn replaced(&self, parameter: ChainParameter, number: Number) -> Option<Chain> {
        let mut chain = self.clone();
        match parameter.value {
            ChainValue::Velocity => {
                self.value(parameter)?;
                let body = chain.bodies.get_mut(parameter.body()?)?;
                *body = body.clone().with_velocity(number);
            }
            ChainValue::Length => {
                let body = chain.bodies.get_mut(parameter.body()?).filter(|body| body.rigid_mass().is_none())?;
                *body = body.stretched(number)?;
            }
            _ => {
                let number = match self.constraint(parameter) {
                    Some(constraint) => Number::of_rational(&(number.to_rational() * constraint))?,
                    None => number,
                };
                *chain.number_mut(parameter)? = number;
            }
        }
        Some(chain)
    }

    fn number_mut(&mut self, parameter: ChainParameter) -> Option<&mut Number> {
        use ChainValue::{Area, Damping, Density, Gap, Impedance, Length, Mass, Modulus, Stiffness, WaveSpeed};
        let node = parameter.node(self);
        if let Some(k) = parameter.body() {
            let body = self.bodies.get_mut(k)?;
            return match (parameter.value, &mut body.material) {
                (Mass, BodyMaterial::Rigid { mass }) => Some(mass),
                (_, BodyMaterial::Rigid { .. }) => None,
                (Length, _) => Some(&mut body.length),
                (WaveSpeed, BodyMaterial::Impedance { wave_speed, .. }) => Some(wave_speed),
                (Impedance, BodyMaterial::Impedance { impedance, .. }) => Some(impedance),
                (Modulus, BodyMaterial::Elastic { modulus, .. }) => Some(modulus),
                (Density, BodyMaterial::Elastic { density, .. }) => Some(density),
                (Area, BodyMaterial::Elastic { area, .. }) => Some(area),
                _ => None,
            };
        }
        let (node, top) = (node?, self.bodies.len());
        if parameter.value == Gap {
            return match (node.checked_sub(1).filter(|_| node < top), &mut self.joints, &mut self.ends) {
                (Some(joint), joints, _) => match &mut joints[joint] {
                    Joint::Contact { gap } => Some(gap),
                    Joint::Bonded => None,
                },
                (None, _, ends) => match &mut ends[usize::from(node == top)] {
                    End::Ground { gap, .. } | End::Infinite { gap: Some(gap), .. } => Some(gap),
                    _ => None,
                },
            };
        }
        let (_, spring) = self.springs.iter_mut().find(|(at, _)| *at == node)?;
        match parameter.value {
            Stiffness => Some(&mut spring.stiffness),
            Damping => Some(&mut spring.damping),
            _ => None,
        }
    }
}

impl Body {
    /// Returns the bar with another length and the points of its start stretched to it; `None` if their places have too
    /// many digits.
    fn stretched(&self, length: Number) -> Option<Body> {
        let factor = length.to_rational() / self.length.to_rational();
        let stretched = |points: &Points| -> Option<Points> {
            let point =
                |(x, v): &(Number, Number)| Some((Number::of_rational(&(x.to_rational() * &factor))?, v.clone()));
            points.iter().map(point).collect()
        };
        let [velocity, displacement, strain] = [&self.velocity, &self.displacement, &self.strain].map(stretched);
        let longer = Body { length, ..self.clone() };
        Some(longer.with_start(velocity?, displacement?).with_strain(strain?))
    }
}
