//! `dalembert explain`.

use clap::Args;
use serde_json::json;

use super::{Failure, Format, NumberArgs, OutputArgs, source};
use crate::aligned::table;
use crate::scene::{Effect, EffectUse, Scene};
use crate::solve::{Numbers, Plan, Question};

/// The plan: which effects a scene calls for, which engine and numbers solve it, and what is left out
#[derive(Args, Debug)]
pub(super) struct Explain {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

impl Explain {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let scene = source::read(&self.scene)?;
        let plan = Plan::of(&scene.problem, &Question::run(self.numbers.numbers(&scene)))?;
        let effects = effects(&scene, &plan);
        match self.output.format()? {
            Format::Json => self.output.write_json(&json!({
                "schema": 1,
                "title": scene.title,
                "effects": effects,
                "engine": plan.engine,
                "number": plan.numbers.to_string(),
                "first_attempt": plan.rung.to_string(),
                "reach": plan.reach.to_string(),
                "reasons": plan.reasons(),
                "warnings": scene.problem.neglected().iter().map(ToString::to_string).collect::<Vec<_>>(),
            })),
            Format::Csv => {
                Err(miette::miette!("found --format csv, expected table or json: a plan is no list of numbers"))
            }
            Format::Table => self.output.write(&Self::text(&scene, &effects, &plan)),
        }
    }

    fn text(scene: &Scene, effects: &[EffectUse], plan: &Plan) -> String {
        let rows = effects.iter().map(|used| {
            let line = used.line.map_or_else(|| "–".to_string(), |line| line.to_string());
            vec![used.effect.to_string(), if used.called { "yes" } else { "no" }.into(), line, used.because.clone()]
        });
        let mut out = scene.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
        out += &table(&["effect", "called for", "line", "because"], rows.collect(), 4);
        out += &format!("\n\nengine:   {}\nreach:    {}\n", plan.engine, plan.reach);
        out += &format!("numbers:  {}, at first in {}\n", plan.numbers, plan.rung);
        out = plan.reasons().iter().fold(out, |out, reason| out + "          " + reason + "\n");
        scene.problem.neglected().into_iter().fold(out, |out, neglected| out + &format!("warning:  {neglected}\n"))
    }
}

/// The effects of the scene, and those that the question calls for.
fn effects(scene: &Scene, plan: &Plan) -> Vec<EffectUse> {
    let mut effects = scene.effects();
    effects.push(scene.effect(Effect::FieldEnergies));
    effects.push(match plan.numbers {
        Numbers::Double(_) => scene.effect(Effect::ArbitraryPrecision),
        numbers => EffectUse {
            effect: Effect::ArbitraryPrecision,
            called: true,
            line: None,
            because: format!("{numbers} asked for"),
        },
    });
    effects
}
