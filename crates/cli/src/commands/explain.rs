//! `dalembert explain`.

use clap::Args;
use serde_json::json;

use super::chain;
use crate::args::{SceneArgs, known_formats};
use crate::failure::Failure;
use crate::file::{Format, write_all};
use crate::output::{json_bytes, wrapped};
use crate::source::AnyScene;
use crate::terminal;
use dalembert::solve::{Numbers, Plan, Question, Sensitivity};
use dalembert::{Effect, EffectUse, Scene};
use dalembert_compare::aligned::table;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
pub(crate) struct Explain {
    #[command(flatten)]
    scene: SceneArgs,
    /// Keep each row of a table on one line, however wide
    #[arg(long)]
    wide: bool,
}

const FORMATS: &[Format] = &[Format::Table, Format::Json];

impl Explain {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = match self.scene.body.read_any(&self.scene.scene)? {
            AnyScene::Rod(scene) => *scene,
            AnyScene::Chain(scene) => {
                let numbers = self.scene.numbers.numbers_to(scene.accuracy);
                return chain::explain(&scene, numbers, &self.scene.output.destinations(FORMATS)?);
            }
        };
        let plan = Plan::of(&scene.problem, &Question::run(self.scene.numbers.numbers_to(scene.accuracy)))?;
        let effects = effects(&scene, &plan);
        write_all(&self.scene.output.destinations(FORMATS)?, |format| {
            if format == Format::Table {
                return Ok(self.text(&scene, &effects, &plan).into_bytes());
            }
            Ok(json_bytes(&json!({
                "schema": 1,
                "title": scene.title,
                "effects": effects,
                "engine": plan.engine,
                "number": plan.numbers.to_string(),
                "first_attempt": plan.rung.to_string(),
                "reach": plan.reach.to_string(),
                "reasons": plan.reasons(),
                "limits": plan.limits(),
                "sensitivity": Sensitivity::of(&scene.problem),
                "plan": plan,
                "warnings": scene.problem.warnings().into_iter().map(|note| note.to_string()).collect::<Vec<_>>(),
            })))
        })
    }

    fn text(&self, scene: &Scene, effects: &[EffectUse], plan: &Plan) -> String {
        let fold = |text: &str, left: usize| match self.wide {
            true => text.to_string(),
            false => wrapped(text, terminal::width() - left, ""),
        };
        let rows = effects.iter().map(|used| {
            let line = used.line.map_or_else(|| "–".to_string(), |line| line.to_string());
            let because = fold(&used.because, REASON_COLUMN);
            vec![used.effect.to_string(), if used.called { "yes" } else { "no" }.into(), line, because]
        });
        let mut out = scene.title.as_ref().map_or_else(String::new, |title| fold(title, 0) + "\n\n");
        out += &(table(&["effect", "called", "line", "because"], rows.collect(), 4) + "\n\n");
        let number = format!("{}, at first in {}", plan.numbers, plan.rung);
        let lines = [("engine:", plan.engine.to_string()), ("reach:", plan.reach.to_string()), ("numbers:", number)];
        let reasons = plan.reasons().into_iter().map(|reason| ("", reason));
        let limits = plan.limits().into_iter().enumerate();
        let limits = limits.map(|(k, limit)| (if k == 0 { "limits:" } else { "" }, limit));
        let measured = Sensitivity::of(&scene.problem).map(|measured| ("measured:", measured.to_string()));
        let warnings = scene.problem.warnings().into_iter().map(|warning| ("warning:", warning.to_string()));
        for (name, text) in lines.into_iter().chain(reasons).chain(limits).chain(measured).chain(warnings) {
            out += &(format!("{name:10}") + &fold(&text, 10).replace('\n', "\n          ") + "\n");
        }
        out
    }
}

/// Number of characters to the left of the reasons in the table.
const REASON_COLUMN: usize = 40;

/// Returns the effects of the scene, and those that the question calls for.
fn effects(scene: &Scene, plan: &Plan) -> Vec<EffectUse> {
    let mut precision = scene.effect(Effect::ArbitraryPrecision);
    if let Numbers::Double(_) = plan.numbers {
        precision.because += "; --digits and --exact do";
    } else {
        (precision.called, precision.because) = (true, format!("{} asked for", plan.numbers));
    }
    [scene.effects(), vec![scene.effect(Effect::FieldEnergies), precision]].concat()
}
