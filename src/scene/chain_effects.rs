//! The effects that a chain calls for.

use super::chain::ChainScene;
use super::chain_ends::SPRING_KEYS;
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
        let mut add = |effect, key: Option<String>, because: &str, otherwise: &str| {
            let (called, because) = (key.is_some(), if key.is_some() { because } else { otherwise });
            let line = key.and_then(|key| self.line_of(&key).or_else(|| self.line_of(key.split('.').next()?)));
            effects.push(EffectUse { effect, called, line, because: because.into() });
        };
        add("bodies", Some("body[0]".into()), &format!("{bodies} bodies, from the bottom up"), "");
        let contacts = chain.joints().iter().filter(|joint| **joint != Joint::Bonded).count();
        let push = format!("{contacts} of {} joints push and never pull", bodies - 1);
        add("contact_joints", contact.map(|k| format!("body[{k}].joint")), &push, "no joint opens or closes");
        let pass = "waves are reflected and pass where impedances differ";
        add("bonded_joints", bonded.map(|k| format!("body[{k}].joint")), pass, "no joint is bonded");
        let named = |is: &dyn Fn(&End) -> bool| end(is).map(|name| format!("ends.{name}"));
        let ground = named(&|end| matches!(end, End::Ground { .. }));
        add("ground", ground, "a stop that pushes and never pulls", "no rigid stop is checked for contact");
        let moving = end(&|end| matches!(end, End::Ground { velocity, .. } if !velocity.is_empty()))
            .map(|name| if name == "bottom" { "ground.velocity".into() } else { "ends.top".into() });
        add("moving_ground", moving, "the stop moves by a velocity over time", "the ground rests");
        let loaded = named(&|end| matches!(end, End::Force(_)));
        add("end_loads", loaded, "a force over time pulls or pushes an end", "no end is loaded");
        let moved = named(&|end| matches!(end, End::Velocity(_)));
        add("moved_ends", moved, "an end is held or moved by a velocity over time", "no end is held");
        let infinite = named(&|end| matches!(end, End::Infinite { .. }));
        add("infinite_ends", infinite, "a half-infinite bar takes up waves for ever", "no wave leaves the chain");
        let top = bodies;
        let path = |node: usize| match node {
            0 => SPRING_KEYS
                .map(|key| format!("ground.{key}"))
                .into_iter()
                .find(|key| self.line_of(key).is_some())
                .unwrap_or_else(|| "ends.bottom".to_string()),
            node if node == top => "ends.top".into(),
            node => format!("body[{node}].joint"),
        };
        let yielding = (0..=top).filter(|node| chain.spring(*node).is_some()).collect::<Vec<_>>();
        let curves = format!("{} of {} nodes yield: signals are curves, not lines", yielding.len(), top + 1);
        add("springs", yielding.first().map(|node| path(*node)), &curves, "no joint yields");
        let rigid = chain.bodies().iter().position(|body| body.rigid_mass().is_some());
        let delay = "a rigid mass moves as one, and reflects waves with a delay";
        add("rigid_masses", rigid.map(|k| format!("body[{k}].mass")), delay, "no body is rigid");
        let gravity = (!chain.gravity().is_zero()).then(|| "gravity.acceleration".into());
        add("gravity", gravity, &format!("acceleration = {}", chain.gravity()), "no acceleration: no weight");
        effects
    }
}
