//! The effects that a chain calls for.

use super::chain::ChainScene;
use super::effects::EffectUse;
use crate::chain::{End, Joint};

impl ChainScene {
    /// Returns every effect of a chain, with the line that calls for it.
    pub fn effects(&self) -> Vec<EffectUse<&'static str>> {
        let chain = &self.chain;
        let bodies = chain.bodies().len();
        let first = |is: &dyn Fn(&Joint) -> bool| chain.joints().iter().position(is).map(|k| k + 1);
        let bonded = first(&|joint| *joint == Joint::Bonded);
        let contact = first(&|joint| *joint != Joint::Bonded);
        let end = |is: &dyn Fn(&End) -> bool| {
            chain.ends().iter().zip(["bottom", "top"]).find(|(end, _)| is(end)).map(|(_, name)| name)
        };
        let mut effects = Vec::new();
        let mut add = |effect, key: Option<String>, because: String, otherwise: &str| {
            let called = key.is_some();
            let line = key.and_then(|key| self.line_of(&key).or_else(|| self.line_of(key.split('.').next()?)));
            effects.push(EffectUse { effect, called, line, because: if called { because } else { otherwise.into() } });
        };
        add("bodies", Some("body[0]".into()), format!("{bodies} bodies, from the bottom up"), "");
        add(
            "contact_joints",
            contact.map(|k| format!("body[{k}].joint")),
            format!(
                "{} of {} joints push and never pull",
                chain.joints().iter().filter(|j| **j != Joint::Bonded).count(),
                bodies - 1
            ),
            "no joint opens or closes",
        );
        add(
            "bonded_joints",
            bonded.map(|k| format!("body[{k}].joint")),
            "waves are reflected and pass where impedances differ".into(),
            "no joint is bonded",
        );
        let named = |is: &dyn Fn(&End) -> bool| end(is).map(|name| format!("ends.{name}"));
        add(
            "ground",
            named(&|end| matches!(end, End::Ground { .. })),
            "a stop that pushes and never pulls".into(),
            "no rigid stop is checked for contact",
        );
        add(
            "moving_ground",
            end(&|end| matches!(end, End::Ground { velocity, .. } if !velocity.is_empty()))
                .map(|name| if name == "bottom" { "ground.velocity".into() } else { "ends.top".into() }),
            "the stop moves by a velocity over time".into(),
            "the ground rests",
        );
        add(
            "end_loads",
            named(&|end| matches!(end, End::Force(_))),
            "a force over time pulls or pushes an end".into(),
            "no end is loaded",
        );
        add(
            "moved_ends",
            named(&|end| matches!(end, End::Velocity(_))),
            "an end is held or moved by a velocity over time".into(),
            "no end is held",
        );
        add(
            "infinite_ends",
            named(&|end| matches!(end, End::Infinite { .. })),
            "a half-infinite bar takes up waves for ever".into(),
            "no wave leaves the chain",
        );
        let top = bodies;
        let path = |node: usize| match node {
            0 if self.line_of("ground.stiffness").or(self.line_of("ground.damping")).is_some() => {
                "ground.stiffness".into()
            }
            0 => "ends.bottom".to_string(),
            node if node == top => "ends.top".into(),
            node => format!("body[{node}].joint"),
        };
        let yielding = (0..=top).filter(|node| chain.spring(*node).is_some()).collect::<Vec<_>>();
        add(
            "springs",
            yielding.first().map(|node| path(*node)),
            format!("{} of {} nodes yield: signals are curves, not lines", yielding.len(), top + 1),
            "no joint yields",
        );
        let rigid = chain.bodies().iter().position(|body| body.rigid_mass().is_some());
        add(
            "rigid_masses",
            rigid.map(|k| format!("body[{k}].mass")),
            "a rigid mass moves as one, and reflects waves with a delay".into(),
            "no body is rigid",
        );
        add(
            "gravity",
            (!chain.gravity().is_zero()).then(|| "gravity.acceleration".into()),
            format!("acceleration = {}", chain.gravity()),
            "no acceleration: no weight",
        );
        effects
    }
}
