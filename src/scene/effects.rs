//! The effects that a scene calls for, and those that are therefore not computed.

use serde::Serialize;

use super::Scene;
use crate::number::Number;
use crate::problem::written::short;
use crate::problem::{Material, Run, Start, Top};

/// An effect that the solver knows. One that a scene does not call for costs it nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, strum::Display, strum::IntoStaticStr)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
pub enum Effect {
    /// `g > 0`.
    Gravity,
    /// `r > 0`.
    Damping,
    /// The ground pushes and never pulls: in every scene.
    UnilateralContact,
    /// Several contacts.
    RepeatedImpacts,
    /// The top does not move.
    FixedTop,
    /// The undeformed rod starts above the ground.
    InitialGap,
    /// The rod starts deformed or above the ground, by a profile.
    InitialStrain,
    /// The rod starts with a velocity of its own at every point.
    InitialVelocity,
    /// Modulus and density, with an area or for a unit of it, give forces and energies their units.
    SiForces,
    /// Energies and the field at other times than the ends of contacts: what `sample` asks for.
    FieldEnergies,
    /// Fractions or more bits than doubles have: what digits and fractions take.
    ArbitraryPrecision,
}

impl Effect {
    /// The name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }

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

/// The use that a scene makes of one effect; those of a chain have names alone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct EffectUse<E = Effect> {
    /// The effect.
    pub effect: E,
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
        Effect::ALL.into_iter().map(|effect| self.effect(effect)).collect()
    }

    /// The effects that the scene calls for.
    pub fn called_effects(&self) -> Vec<Effect> {
        self.effects().into_iter().filter(|e| e.called).map(|e| e.effect).collect()
    }

    /// Returns whether the scene calls for `effect`, and the line that does.
    pub fn effect(&self, effect: Effect) -> EffectUse {
        let problem = &self.problem;
        let shown = |key: &str, number: &Number| format!("{key} = {}", short(&number.to_string()));
        let profile = match problem.start() {
            Start::Profile(profile) => Some(profile),
            Start::Uniform(_) | Start::Above { .. } => None,
        };
        let is_strained = profile.is_some_and(|profile| !profile.strain.is_empty());
        let points = |name: &str, points: Option<&Vec<(Number, Number)>>| {
            let points = points.filter(|points| points.iter().any(|(_, v)| !v.is_zero()))?;
            let (_, first) = points.first()?;
            let is_constant = points.iter().all(|(_, v)| v == first);
            Some(if is_constant { shown(name, first) } else { format!("the {name} has {} points", points.len()) })
        };
        let place = problem.chain();
        // The key that decides so; why the effect is called for, if it is; what is not computed where it is not.
        let (key, called, otherwise) = match effect {
            Effect::UnilateralContact => match &place {
                None => ("", Some("the ground is in every scene".into()), ""),
                Some((chain, body)) => {
                    let pushes = [*body, body + 1].map(|node| chain.is_contact(node));
                    let because = match pushes {
                        [true, true] => Some("both ends of the body push and never pull"),
                        [true, false] => Some("the lower end of the body pushes and never pulls"),
                        [false, true] => Some("the upper end of the body pushes and never pulls"),
                        [false, false] => None,
                    };
                    ("", because.map(Into::into), "no end of the body opens or closes")
                }
            },
            Effect::Gravity => (
                "gravity.acceleration",
                problem.gravity().map(|g| shown("acceleration", g)),
                "no acceleration: flight is straight, and no weight enters the stress",
            ),
            Effect::Damping => (
                "rod.damping",
                problem.damping().map(|r| shown("damping", r)),
                "no damping: no Bessel function is evaluated, and energy is constant",
            ),
            Effect::RepeatedImpacts => match problem.run() {
                Run::Impacts(1) => {
                    ("run.impacts", None, "one contact and the flight after it: later impacts are not computed")
                }
                Run::Impacts(impacts) => ("run.impacts", Some(format!("impacts = {impacts}")), ""),
                Run::Time(time) => ("run.time", Some(format!("every impact up to {}", shown("time", time))), ""),
            },
            Effect::FixedTop => (
                "rod.top",
                (problem.top() == Top::Fixed).then(|| "top = \"fixed\"".into()),
                match place {
                    None => "the top is free: waves come back with the same strain reversed",
                    Some(_) => "the upper end of the body is that of the chain, or meets the next one",
                },
            ),
            Effect::InitialGap => {
                let above = |gap| format!("{}: t = 0 is the start, before the first touch", shown("gap", gap));
                let touch = "t = 0 is the first touch: no flight before it is computed";
                let otherwise = match (&profile, place) {
                    (Some(_), None) => "the start is a profile",
                    (Some(_), Some(_)) => "a body of a chain starts where its scene places it",
                    (None, _) => touch,
                };
                ("impact.gap", self.problem.gap().map(above), otherwise)
            }
            Effect::InitialStrain => (
                if is_strained { "start.strain" } else { "start.displacement" },
                match is_strained {
                    true => points("strain", profile.map(|profile| &profile.strain)),
                    false => points("displacement", profile.map(|profile| &profile.displacement)),
                },
                "the rod starts undeformed: no initial strain is carried",
            ),
            Effect::InitialVelocity => (
                "start.velocity",
                points("velocity", profile.map(|profile| &profile.velocity)),
                match profile {
                    Some(_) => "the rod starts at rest: no velocity profile is carried",
                    None => "the rod starts with one velocity: no velocity profile is carried",
                },
            ),
            Effect::SiForces => match problem.material() {
                _ if place.is_some_and(|(chain, body)| chain.bodies()[body].is_by_impedance()) => {
                    ("", Some("the impedance is given: a stress is a force".into()), "")
                }
                Material::Elastic { area: Some(_), .. } => {
                    ("rod.modulus", Some("modulus, density and area are given".into()), "")
                }
                Material::Elastic { area: None, .. } => {
                    let because = "modulus and density are given: forces and energies are per area";
                    ("rod.modulus", Some(because.into()), "")
                }
                Material::WaveSpeed(_) => {
                    ("rod.wave_speed", None, "only the wave speed is given: strains v_x, and no forces in newtons")
                }
            },
            Effect::FieldEnergies => {
                ("", None, "energies at the ends of contacts only; `sample` asks for the field and for other times")
            }
            Effect::ArbitraryPrecision => ("", None, "a scene does not ask for it"),
        };
        let (line, is_called) = (self.line_of(key), called.is_some());
        EffectUse { effect, called: is_called, line, because: called.unwrap_or_else(|| otherwise.into()) }
    }
}
