//! A body of a chain as a problem: its neighbours act on it in place of the ground and the top.

use std::sync::Arc;

use super::given::Given;
use super::{
    Material, Parameter, Parameters, Problem, ProblemError, ProblemErrorKind as Kind, Profile, Run, Speed, Start, Top,
    Written,
};
use crate::chain::{Body, BodyMaterial, Chain, ChainParameter, End, Runs, Spring};
use crate::number::{Number, Rational};

/// A chain, and the body in it that a problem describes.
#[derive(Clone, Debug)]
pub(crate) struct InChain {
    /// The chain, in which the problem replaces the body.
    chain: Arc<Chain>,
    body: usize,
    /// Stiffness of the spring below the body, in place of that of the chain.
    pub(super) stiffness: Option<Number>,
    /// Runs that the problems of all bodies share.
    pub(crate) runs: Runs,
}

/// The same chain and body; runs do not count.
impl PartialEq for InChain {
    fn eq(&self, other: &Self) -> bool {
        self.body == other.body && self.chain == other.chain && self.stiffness == other.stiffness
    }
}

impl InChain {
    /// Returns Young's modulus as a value of the chain, for a body whose sides are held: the problem has the modulus of
    /// its waves.
    pub(super) fn young(&self) -> Option<Parameter> {
        self.chain.bodies()[self.body].constraint()?;
        format!("body.{}.modulus", self.body + 1).parse().ok()
    }

    /// Returns whether there is a dashpot below the body.
    pub(super) fn is_damped(&self) -> bool {
        self.chain.spring(self.body).is_some_and(|spring| !spring.damping.is_zero())
    }

    /// Returns the same place with another stiffness of the spring below it; `None` where there is no spring.
    pub(super) fn with_stiffness(&self, stiffness: &Number) -> Option<Self> {
        self.stiffness.as_ref().map(|_| InChain { stiffness: Some(stiffness.clone()), ..self.clone() })
    }
}

impl Chain {
    /// Returns a problem for each bar, in the order of the bodies, from the bottom up; `None` for a rigid body. Its
    /// history is the motion of the bar in the chain: events and contacts are those with the body or the stop below,
    /// and displacements are counted from the undeformed bar in its place at the start.
    ///
    /// The problems share their runs. A body that is given by its impedance gets the modulus `Zc` and the density `Z/c`
    /// of a cross-section of one, so that a stress is a force.
    ///
    /// **Errors**: [`ProblemError`] if `Zc` or `Z/c` has too many digits.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain};
    /// use dalembert::{Quantity, Side};
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 2.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// let upper = chain.problem(1)?.solve()?;
    /// // Equal bars exchange their velocities: the contact begins at t = 1 and lasts 2L/c with f = Zv/2.
    /// assert_eq!(upper.contacts()?[0].release.as_ref().map(|t| t.to_f64()), Some(3.0));
    /// assert_eq!(upper.at_time(Quantity::Force, 2, Side::Right)?, 1.0);
    /// assert_eq!(upper.at_time(Quantity::CentreVelocity, 4, Side::Right)?, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn problems(&self) -> Result<Vec<Option<Problem>>, ProblemError> {
        let materials = self.bodies().iter().enumerate().map(|(k, body)| material(k, body));
        let materials = materials.collect::<Result<Vec<_>, _>>()?;
        let (chain, runs) = (Arc::new(self.clone()), Runs::default());
        let problem = |(body, material): (usize, Option<Material>)| {
            let (profile, material) = (&self.bodies()[body], material?);
            Some(Problem {
                length: profile.length().clone(),
                material,
                damping: None,
                top: Top::Free,
                gravity: Some(self.gravity().clone()).filter(|g| !g.is_zero()),
                start: Start::Profile(Profile {
                    displacement: profile.displacement().to_vec(),
                    strain: profile.strain().to_vec(),
                    velocity: profile.velocity().to_vec(),
                }),
                run: Run::Time(self.until().clone()),
                in_chain: Some(InChain {
                    chain: chain.clone(),
                    body,
                    stiffness: chain.spring(body).map(|spring| spring.stiffness.clone()),
                    runs: runs.clone(),
                }),
            })
        };
        Ok(materials.into_iter().enumerate().map(problem).collect())
    }

    /// Returns the problem of the bar with this index, as [`Chain::problems`] does.
    ///
    /// **Errors**: [`ProblemError`] for a rigid body, an index that no body has, and as [`Chain::problems`].
    pub fn problem(&self, body: usize) -> Result<Problem, ProblemError> {
        let problem = self.problems()?.into_iter().nth(body).flatten();
        problem.ok_or_else(|| self.no_bar(body))
    }

    fn no_bar(&self, body: usize) -> ProblemError {
        let (found, expected) = match self.bodies().get(body) {
            Some(_) => ("a rigid mass".to_string(), format!("a bar: the whole chain has v_end.{} of a mass", body + 1)),
            None => (format!("body {} of {}", body + 1, self.bodies().len()), "a bar".to_string()),
        };
        ProblemError::new(Kind::OutOfRange, &format!("body[{body}]"), found, expected)
    }
}

fn body_of(material: &Material, body: &Body) -> Body {
    let length = body.length().clone();
    let (velocity, displacement) = (body.velocity().to_vec(), body.displacement().to_vec());
    let new = match material {
        Material::Elastic { modulus, density, area } => {
            let area = area.clone().unwrap_or_else(|| 1.into());
            Body::elastic(length, modulus.clone(), density.clone(), area)
        }
        Material::WaveSpeed(speed) => Body::new(length, speed.clone(), speed.clone()),
    };
    let new = new.with_start(velocity, displacement).with_strain(body.strain().to_vec());
    let new = new.with_constraint(body.constraint().cloned());
    match body.name() {
        Some(name) => new.named(name),
        None => new,
    }
}

/// Returns the material of the body with this index; `None` for a rigid body.
fn material(k: usize, body: &Body) -> Result<Option<Material>, ProblemError> {
    Ok(match body.material() {
        BodyMaterial::Elastic { modulus, density, area } => {
            let area = Some(area.clone());
            Some(Material::Elastic { modulus: modulus.clone(), density: density.clone(), area })
        }
        BodyMaterial::Impedance { .. } => {
            let [modulus, density, _] = body.elastic_numbers();
            let number = |value: Rational| {
                Number::of_rational(&value).ok_or_else(|| {
                    let found = "an impedance whose product with the wave speed, or ratio to it, has too many digits";
                    ProblemError::new(Kind::OutOfRange, &format!("body[{k}].impedance"), found, "fewer digits")
                })
            };
            Some(Material::Elastic { modulus: number(modulus)?, density: number(density)?, area: Some(1.into()) })
        }
        BodyMaterial::Rigid { .. } => None,
    })
}

impl Problem {
    /// Returns the chain that the problem is a body of, with the values of the problem, and the index of the body;
    /// `None` for a rod by itself.
    pub fn chain(&self) -> Option<(Chain, usize)> {
        // Every value of the problem is named here, so that none is left out of the chain.
        let Problem { length, material, damping: _, top: _, gravity, start, run, in_chain } = self;
        let InChain { chain, body, stiffness, runs: _ } = in_chain.as_ref()?;
        let original = &chain.bodies()[*body];
        let Profile { displacement, strain, velocity } = match start {
            Start::Profile(profile) => profile.clone(),
            _ => Profile::default(),
        };
        let own = original.clone().with_length(length.clone());
        let own = own.with_start(velocity, displacement).with_strain(strain);
        // A body that is given by its impedance stays so.
        let is_original = self::material(*body, original).is_ok_and(|given| given.as_ref() == Some(material));
        let own = if is_original { own } else { body_of(material, &own) };
        let gravity = gravity.clone().unwrap_or_else(|| 0.into());
        let chain = chain.with_body(*body, own).with_gravity(gravity);
        let chain = match stiffness {
            Some(stiffness) => chain.with_stiffness(*body, stiffness.clone()),
            None => chain,
        };
        let chain = match run {
            Run::Time(time) => chain.with_end(time.clone()),
            Run::Impacts(_) => chain,
        };
        Some((chain, *body))
    }

    /// Returns the same rod, by itself, on a ground that yields as `spring` does, followed up to the time `until`.
    ///
    /// **Errors**: [`ProblemError`] for a damped rod, a drop height whose speed is no fraction, a body of a chain, and
    /// for values out of range.
    ///
    /// ```
    /// use dalembert::{Problem, chain::Spring};
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).build()?;
    /// let soft = rod.on_spring(Spring { stiffness: 20.into(), damping: 0.into() }, 3.into())?;
    /// // The contact lasts longer than 2L/c, by x/20 with eˣ = 2 − e⁻⁴⁰ + 2x.
    /// let release = soft.doubles()?.contacts()[0].release.ok_or("no release")?;
    /// assert!((release - 2.0 - 1.678346990016661 / 20.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn on_spring(&self, spring: Spring, until: Number) -> Result<Problem, ProblemError> {
        let refuse = |path: &str, found: &str, expected: &str| {
            Err(ProblemError::new(Kind::Contradiction, path, format!("{found} on a spring"), expected.to_string()))
        };
        // Every value of the problem is named here, so that none is left out.
        let Problem { length, material, damping, top, gravity, start, run: _, in_chain } = self;
        if in_chain.is_some() {
            return refuse("body", "a body of a chain", "a joint with a stiffness in its scene, or a rod by itself");
        }
        if damping.is_some() {
            return refuse(Parameter::Damping.path(), "a damped rod", "a rod without damping");
        }
        let ends = [Number::from(0), length.clone()];
        let uniform = |value: &Number| ends.iter().map(|x| (x.clone(), value.clone())).collect::<Vec<_>>();
        let down = |speed: &Number| {
            let negative = Number::of_rational(&-speed.to_rational());
            let found = || format!("speed = {speed}");
            let refused = || Parameter::ImpactSpeed.error(Kind::OutOfRange, found(), "fewer digits");
            Ok::<_, ProblemError>(uniform(&negative.ok_or_else(refused)?))
        };
        let mut strain = Vec::new();
        let (gap, displacement, velocity) = match start {
            Start::Uniform(Speed::Given(speed)) => (0.into(), Vec::new(), down(speed)?),
            Start::Uniform(Speed::DropHeight(_)) => {
                let speed = Parameters::<Rational>::of(self, &()).ok().and_then(|rod| Number::of_rational(&rod.speed));
                let Some(speed) = speed else {
                    let found = "a drop height whose speed √(2gh) is no fraction";
                    return refuse(Parameter::DropHeight.path(), found, "the speed of the impact");
                };
                (0.into(), Vec::new(), down(&speed)?)
            }
            Start::Above { gap, speed } => (gap.clone(), uniform(gap), down(speed)?),
            Start::Profile(Profile { displacement, strain: points, velocity }) => {
                strain.clone_from(points);
                let gap = displacement.first().map_or_else(|| 0.into(), |(_, gap)| gap.clone());
                (gap, displacement.clone(), velocity.clone())
            }
        };
        let top = if *top == Top::Fixed { End::Velocity(vec![(0.into(), 0.into())]) } else { End::Free };
        let body = Body::new(length.clone(), 1.into(), 1.into()).with_start(velocity, displacement);
        let body = body.with_strain(strain);
        let chain = Chain::builder(body_of(material, &body))
            .bottom(End::Ground { gap, velocity: Vec::new() })
            .top(top)
            .spring(0, spring)
            .gravity(gravity.clone().unwrap_or_else(|| 0.into()))
            .until(until)
            .build()?;
        chain.problem(0)
    }

    /// Returns the same body of its chain with rigid joints and ends in place of springs and dashpots; `None` for a rod
    /// by itself, and in a chain without them.
    ///
    /// **Errors**: [`ProblemError`] if rigid masses would touch.
    pub fn rigid_contact(&self) -> Result<Option<Problem>, ProblemError> {
        let Some((chain, body)) = self.chain().filter(|(chain, _)| chain.has_springs()) else { return Ok(None) };
        Ok(Some(chain.without_springs()?.problem(body)?))
    }

    /// Returns the same body of its chain with a spring of this stiffness in addition at each of `nodes`; `None` for a
    /// rod by itself.
    ///
    /// **Errors**: [`ProblemError`] for a stiffness out of range, and for a node that has a spring or that the chain does
    /// not have.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain};
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// let soft = chain.problem(1)?.with_springs(&[1], &20.into())?.ok_or("no chain")?;
    /// // The bars part later than rigid ones, which do at 3.
    /// assert!(soft.doubles()?.contacts()[0].release.is_some_and(|t| t > 3.04));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_springs(&self, nodes: &[usize], stiffness: &Number) -> Result<Option<Problem>, ProblemError> {
        let Some((chain, body)) = self.chain() else { return Ok(None) };
        Ok(Some(chain.with_springs(nodes, stiffness)?.problem(body)?))
    }

    /// Returns the number of a value of the chain that the problem is a body of; `None` where there is none.
    pub(super) fn chain_value(&self, parameter: ChainParameter) -> Option<Number> {
        self.chain()?.0.value(parameter)
    }

    /// Returns the same body of a chain with `value` in place of one of the chain's values.
    pub(super) fn with_chain_value(&self, parameter: Parameter, value: &Written) -> Result<Problem, ProblemError> {
        let path = parameter.full_path();
        let number = Given::new(&path, &path, value)?.number.clone();
        match (self.chain(), parameter) {
            (Some((chain, body)), Parameter::OfChain(parameter)) => chain.with_value(parameter, number)?.problem(body),
            _ => {
                let found = format!("{path} of a rod by itself");
                Err(ProblemError::new(Kind::Contradiction, &path, found, "a body of a chain"))
            }
        }
    }

    /// Returns the problem itself if it describes a rod by itself, or a valid body of its chain.
    pub(super) fn checked_in_chain(self) -> Result<Self, ProblemError> {
        if self.in_chain.is_none() {
            return Ok(self);
        }
        if self.damping.is_some() {
            let expected = "undamped bodies, or a single rod";
            return Err(Parameter::Damping.error(Kind::Contradiction, "damping of a body of a chain", expected));
        }
        if !matches!(self.run, Run::Time(_)) {
            let found = "a number of impacts of a body of a chain";
            return Err(Parameter::Impacts.error(Kind::Contradiction, found, "the last time of the run"));
        }
        if let Some((chain, _)) = self.chain() {
            chain.checked()?;
        }
        Ok(self)
    }
}
