//! Which effects a scene calls for, which it does not, and what is therefore not computed.

use serde::Serialize;

use super::Scene;
use crate::mapped::{CollectVec, mapped};
use crate::problem::written::short;
use crate::problem::{Material, Profile, Run, Start, Top};

named! {
    /// An effect that the solver knows. One that a scene does not call for costs it nothing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
    #[serde(rename_all = "snake_case")]
    #[non_exhaustive]
    pub enum Effect {
        /// `g > 0`.
        Gravity = "gravity",
        /// `r > 0`.
        Damping = "damping",
        /// The ground pushes and never pulls: in every scene.
        UnilateralContact = "unilateral_contact",
        /// More than one contact.
        RepeatedImpacts = "repeated_impacts",
        /// The top does not move.
        FixedTop = "fixed_top",
        /// The undeformed rod starts above the ground.
        InitialGap = "initial_gap",
        /// The rod starts deformed or above the ground, by a profile.
        InitialStrain = "initial_strain",
        /// The rod starts with a velocity of its own at every point.
        InitialVelocity = "initial_velocity",
        /// Modulus and density, with an area or for a unit of it, give forces and energies their units.
        SiForces = "si_forces",
        /// Energies and the field at other times than the ends of contacts: what `sample` asks for.
        FieldEnergies = "field_energies",
        /// Fractions or more bits than doubles have: what digits and fractions take.
        ArbitraryPrecision = "arbitrary_precision",
    }
}

impl Effect {
    /// Every effect that a scene can call for, in the order in which they are explained.
    pub const ALL: [Effect; 9] = [
        Effect::UnilateralContact,
        Effect::Gravity,
        Effect::Damping,
        Effect::RepeatedImpacts,
        Effect::FixedTop,
        Effect::InitialGap,
        Effect::InitialStrain,
        Effect::InitialVelocity,
        Effect::SiForces,
    ];
}

/// What a scene has to do with one effect.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct EffectUse {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it.
    pub called: bool,
    /// The line of the scene that decides so, from 1; `None` where it is so because nothing is said.
    pub line: Option<usize>,
    /// Why; where it is not called for, what is therefore not computed.
    pub because: String,
}

impl Scene {
    /// Every effect, in the order of [`Effect::ALL`], with the line of the scene that calls for it or rules it out.
    ///
    /// ```
    /// use dalembert::{Effect, Scene};
    /// let scene = Scene::parse("rod = { length = 1, wave_speed = 1, damping = 0.0 }\n[impact]\nspeed = 3\n")?;
    /// let effects = scene.effects();
    /// let damping = effects.iter().find(|e| e.effect == Effect::Damping).unwrap();
    /// assert_eq!((damping.called, damping.line), (false, Some(1)));
    /// # Ok::<(), dalembert::SceneError>(())
    /// ```
    pub fn effects(&self) -> Vec<EffectUse> {
        mapped(Effect::ALL, |effect| self.effect(effect))
    }

    /// The effects that the scene calls for.
    pub fn called_effects(&self) -> Vec<Effect> {
        self.effects().into_iter().filter(|e| e.called).map(|e| e.effect).collect_vec()
    }

    pub(crate) fn effect(&self, effect: Effect) -> EffectUse {
        let (called, key, because) = match effect {
            Effect::Gravity => self.gravity(),
            Effect::Damping => self.damping(),
            Effect::UnilateralContact => (true, None, "the ground is in every scene".into()),
            Effect::RepeatedImpacts => self.repeated_impacts(),
            Effect::FixedTop => self.fixed_top(),
            Effect::InitialGap => self.initial_gap(),
            Effect::InitialStrain => self.initial_strain(),
            Effect::InitialVelocity => self.initial_velocity(),
            Effect::SiForces => self.si_forces(),
            Effect::FieldEnergies => (
                false,
                None,
                "energies at the ends of contacts only; `sample` asks for the field and for other times".into(),
            ),
            Effect::ArbitraryPrecision => (false, None, "a scene does not ask for it".into()),
        };
        EffectUse { effect, called, line: key.and_then(|key| self.line_of(key)), because }
    }

    fn gravity(&self) -> Decision {
        let because = match &self.problem.gravity {
            Some(g) => format!("acceleration = {}", short(&g.to_string())),
            None => "no acceleration: flight is straight, and no weight enters the stress".into(),
        };
        (self.problem.gravity.is_some(), Some("gravity.acceleration"), because)
    }

    fn damping(&self) -> Decision {
        let because = match &self.problem.rod.damping {
            Some(r) => format!("damping = {}", short(&r.to_string())),
            None => "no damping: no Bessel function is evaluated, and energy is constant".into(),
        };
        (self.problem.rod.damping.is_some(), Some("rod.damping"), because)
    }

    fn repeated_impacts(&self) -> Decision {
        match &self.problem.run {
            Run::Impacts(1) => {
                let because = "one contact and the flight after it: later impacts are not computed";
                (false, Some("run.impacts"), because.into())
            }
            Run::Impacts(impacts) => (true, Some("run.impacts"), format!("impacts = {impacts}")),
            Run::Time(time) => {
                (true, Some("run.time"), format!("every impact up to time = {}", short(&time.to_string())))
            }
        }
    }

    fn fixed_top(&self) -> Decision {
        match self.problem.rod.top {
            Top::Fixed => (true, Some("rod.top"), "top = \"fixed\"".into()),
            Top::Free => {
                (false, Some("rod.top"), "the top is free: waves come back with the same strain reversed".into())
            }
        }
    }

    fn profile(&self) -> Option<&Profile> {
        match &self.problem.start {
            Start::Profile(profile) => Some(profile),
            Start::Uniform(_) | Start::Above { .. } => None,
        }
    }

    fn initial_gap(&self) -> Decision {
        let key = Some("impact.gap");
        match (self.problem.gap(), &self.problem.start) {
            (Some(gap), _) => {
                (true, key, format!("gap = {}: t = 0 is the start, before the first touch", short(&gap.to_string())))
            }
            (None, Start::Profile(_)) => (false, key, "the start is a profile".into()),
            (None, _) => (false, key, "t = 0 is the first touch: no flight before it is computed".into()),
        }
    }

    fn initial_strain(&self) -> Decision {
        let points = self.profile().map(|profile| profile.displacement.as_slice()).unwrap_or_default();
        let key = Some("start.displacement");
        if points.iter().any(|(_, v)| !v.is_zero()) {
            return (true, key, format!("the displacement has {} points", points.len()));
        }
        (false, key, "the rod starts undeformed: no initial strain is carried".into())
    }

    fn initial_velocity(&self) -> Decision {
        let points = self.profile().map(|profile| profile.velocity.as_slice()).unwrap_or_default();
        let key = Some("start.velocity");
        if points.iter().any(|(_, v)| !v.is_zero()) {
            return (true, key, format!("the velocity has {} points", points.len()));
        }
        let because =
            if self.profile().is_some() { "the rod starts at rest" } else { "the rod starts with one velocity" };
        (false, key, format!("{because}: no velocity profile is carried"))
    }

    fn si_forces(&self) -> Decision {
        match self.problem.rod.material {
            Material::Elastic { area: Some(_), .. } => {
                (true, Some("rod.modulus"), "modulus, density and area are given".into())
            }
            Material::Elastic { area: None, .. } => {
                (true, Some("rod.modulus"), "modulus and density are given: forces and energies are per area".into())
            }
            Material::WaveSpeed(_) => {
                let because = "only the wave speed is given: strains v_x, and no forces in newtons";
                (false, Some("rod.wave_speed"), because.into())
            }
        }
    }
}

/// Whether an effect is called for, the key that decides so, and why.
type Decision = (bool, Option<&'static str>, String);
