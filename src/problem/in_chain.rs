//! A body of a chain as a problem: its neighbours act on it in place of the ground and the top.

use std::sync::Arc;

use super::{Material, Parameter, Problem, ProblemError, ProblemErrorKind as Kind, Profile, Run, Start, Top};
use crate::chain::{Body, BodyMaterial, Chain, Runs};
use crate::number::{Number, Rational};

/// A chain, and the body in it that a problem describes.
#[derive(Clone, Debug)]
pub(crate) struct InChain {
    /// The chain, in which the problem replaces the body.
    chain: Arc<Chain>,
    body: usize,
    /// Runs that the problems of all bodies share.
    pub(crate) runs: Runs,
}

/// The same chain and body; runs do not count.
impl PartialEq for InChain {
    fn eq(&self, other: &Self) -> bool {
        self.body == other.body && self.chain == other.chain
    }
}

impl Chain {
    /// Returns a problem for each body, from the bottom up. Its history is the motion of the body in the chain: events
    /// and contacts are those with the body or the stop below, and displacements are counted from the undeformed body
    /// in its place at the start.
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
    /// let upper = chain.problems()?[1].solve()?;
    /// // Equal bars exchange their velocities: the contact begins at t = 1 and lasts 2L/c with f = Zv/2.
    /// assert_eq!(upper.contacts()?[0].release.as_ref().map(|t| t.to_f64()), Some(3.0));
    /// assert_eq!(upper.at_time(Quantity::Force, 2, Side::Right)?, 1.0);
    /// assert_eq!(upper.at_time(Quantity::CentreVelocity, 4, Side::Right)?, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn problems(&self) -> Result<Vec<Problem>, ProblemError> {
        if let Some(k) = self.bodies().iter().position(|body| body.rigid_mass().is_some()) {
            let found = "a body of a chain with a rigid mass by itself";
            let expected = "the whole chain: ChainHistory, or solve, sample and explain of the command";
            return Err(ProblemError::new(Kind::Contradiction, &format!("body[{k}].mass"), found, expected));
        }
        let materials = self.bodies().iter().enumerate().map(|(k, body)| material(k, body));
        let materials = materials.collect::<Result<Vec<_>, _>>()?;
        let mut chain = self.clone();
        for (k, material) in materials.iter().enumerate() {
            chain = chain.with_body(k, body_of(material, &self.bodies()[k]));
        }
        let (chain, runs) = (Arc::new(chain), Runs::default());
        let problem = |(body, material): (usize, Material)| {
            let profile = &self.bodies()[body];
            Problem {
                length: profile.length().clone(),
                material,
                damping: None,
                top: Top::Free,
                gravity: Some(self.gravity().clone()).filter(|g| !g.is_zero()),
                start: Start::Profile(Profile {
                    displacement: profile.displacement().to_vec(),
                    velocity: profile.velocity().to_vec(),
                }),
                run: Run::Time(self.until().clone()),
                in_chain: Some(InChain { chain: chain.clone(), body, runs: runs.clone() }),
            }
        };
        Ok(materials.into_iter().enumerate().map(problem).collect())
    }
}

/// Returns `body` with this material.
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
    let new = new.with_start(velocity, displacement);
    match body.name() {
        Some(name) => new.named(name),
        None => new,
    }
}

/// Returns the material of the body with this index.
fn material(k: usize, body: &Body) -> Result<Material, ProblemError> {
    match body.material() {
        BodyMaterial::Elastic { modulus, density, area } => {
            let area = Some(area.clone());
            Ok(Material::Elastic { modulus: modulus.clone(), density: density.clone(), area })
        }
        BodyMaterial::Impedance { wave_speed, impedance } => {
            let [speed, impedance]: [Rational; 2] = [wave_speed, impedance].map(Number::to_rational);
            let number = |value: Rational| {
                Number::of_rational(&value).ok_or_else(|| {
                    let found = "an impedance whose product with the wave speed, or ratio to it, has too many digits";
                    ProblemError::new(Kind::OutOfRange, &format!("body[{k}].impedance"), found, "fewer digits")
                })
            };
            let modulus = number(impedance.clone() * &speed)?;
            Ok(Material::Elastic { modulus, density: number(impedance / speed)?, area: Some(1.into()) })
        }
        BodyMaterial::Rigid { mass } => {
            let found = format!("mass = {mass}");
            Err(ProblemError::new(Kind::Contradiction, &format!("body[{k}].mass"), found, "a bar"))
        }
    }
}

impl Problem {
    /// Returns the chain that the problem is a body of, with the values of the problem, and the index of the body;
    /// `None` for a rod by itself.
    pub fn chain(&self) -> Option<(Chain, usize)> {
        let InChain { chain, body, .. } = self.in_chain.as_ref()?;
        let original = &chain.bodies()[*body];
        let (velocity, displacement) = match &self.start {
            Start::Profile(Profile { displacement, velocity }) => (velocity.clone(), displacement.clone()),
            _ => Default::default(),
        };
        let original = original.clone().with_length(self.length.clone()).with_start(velocity, displacement);
        let gravity = self.gravity.clone().unwrap_or_else(|| 0.into());
        let chain = chain.with_body(*body, body_of(&self.material, &original)).with_gravity(gravity);
        let chain = match &self.run {
            Run::Time(time) => chain.with_end(time.clone()),
            Run::Impacts(_) => chain,
        };
        Some((chain, *body))
    }

    /// Returns the problem itself if it describes a rod by itself, or a valid body of its chain.
    pub(super) fn checked_in_chain(self) -> Result<Self, ProblemError> {
        if self.in_chain.is_none() {
            return Ok(self);
        }
        if self.damping.is_some() {
            let (path, found) = (Parameter::Damping.path(), "damping of a body of a chain");
            return Err(ProblemError::new(Kind::Contradiction, path, found, "undamped bodies, or a single rod"));
        }
        if !matches!(self.run, Run::Time(_)) {
            let found = "a number of impacts of a body of a chain";
            let expected = "the last time of the run";
            return Err(ProblemError::new(Kind::Contradiction, Parameter::Impacts.path(), found, expected));
        }
        if let Some((chain, _)) = self.chain() {
            chain.checked()?;
        }
        Ok(self)
    }
}
