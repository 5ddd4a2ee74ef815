//! `dalembert explain`.

use clap::Args;
use serde_json::json;

use super::{Failure, Format, NumberArgs, OutputArgs, source};
use crate::output::table;
use crate::scene::Plan;
#[cfg(feature = "mp")]
use crate::scene::{Engine, System};

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
        let mut plan = Plan::of(&scene, self.numbers.ask())?;
        #[cfg(feature = "mp")]
        if let (Engine::Lattice, System::Digits(digits)) = (plan.engine, plan.system) {
            let lost = crate::solve::bits_lost(&scene.problem);
            if lost > 0.0 {
                plan.reasons.push(format!(
                    "the impacts up to the end lose about {:.0} digits, so {} are carried",
                    lost * std::f64::consts::LOG10_2,
                    (f64::from(digits) + 1.1 * lost * std::f64::consts::LOG10_2).ceil() + 8.0
                ));
            }
        }
        match self.output.format() {
            Format::Json => self.output.write_json(&json!({
                "schema": 1,
                "title": scene.title,
                "effects": plan.effects,
                "engine": plan.engine,
                "number": plan.system.to_string(),
                "reasons": plan.reasons,
                "cost": plan.cost,
            })),
            Format::Csv => {
                Err(miette::miette!("found --format csv, expected table or json: a plan is no list of numbers"))
            }
            Format::Table => self.output.write(&Self::text(scene.title.as_deref(), &plan)),
        }
    }

    fn text(title: Option<&str>, plan: &Plan) -> String {
        let rows = plan.effects.iter().map(|used| {
            let line = used.line.map_or_else(|| "–".to_string(), |line| line.to_string());
            vec![used.effect.to_string(), if used.called { "yes" } else { "no" }.into(), line, used.because.clone()]
        });
        let mut out = title.map_or_else(String::new, |title| format!("{title}\n\n"));
        out += &table(&["effect", "called for", "line", "because"], rows.collect(), 4);
        out += &format!("\n\nengine:   {}\nnumbers:  {}\n", plan.engine, plan.system);
        for reason in &plan.reasons {
            out += &format!("          {reason}\n");
        }
        out + &format!("cost:     {}\n", plan.cost)
    }
}
