//! Solving a scene for a question, with its progress and its notes.

use crate::failure::Failure;
use crate::output::RunInfo;
use crate::progress::Progress;
use crate::terminal;
use dalembert::number::{DOUBLE_DIGITS, Scalar as _};
use dalembert::quantity::Measure;
use dalembert::solve::{History, Plan, Question};
use dalembert::{Effect, Scene, Value};

/// A history, with facts about its run.
pub(crate) struct Answer {
    pub(crate) history: History,
    pub(crate) info: RunInfo,
    pub(crate) progress: Progress,
}

/// Solves `scene` for `question`.
pub(crate) fn solve(scene: &Scene, question: &Question) -> Result<Answer, Failure> {
    let plan = Plan::of(&scene.problem, question)?;
    let progress = Progress::new(scene, &plan);
    let history = plan.solve(&scene.problem, progress.observer())?.in_units(scene.units);
    let units = history.units().clone();
    let time = |time: f64| format!("{} {}", time.decimal(6), units.name(Measure::Time)).trim_end().to_string();
    let digits = history.digits();
    let exact_until = history.exactness_end().cloned();
    if let Some(end) = &exact_until {
        terminal::note(format!("{end}; what follows is in {digits} digits"));
    }
    let info = RunInfo {
        title: scene.title.clone(),
        number: if exact_until.is_some() { format!("{digits} digits") } else { plan.numbers.to_string() },
        effects: scene.called_effects().into_iter().map(Effect::name).collect(),
        digits,
        // `c`, `t₁`, `R` and `M` to six digits.
        parameters: units.parameters(&scene.problem, time).join("    "),
        wide: false,
        units,
        warnings: Vec::new(),
        exact_until,
    };
    Ok(Answer { history, info, progress })
}

/// Returns the reason why the history ends, at the time `end`, and prints it as a note if the end may be before what
/// was requested.
pub(crate) fn note_end(history: &History, end: &Value) -> String {
    let ending = history.ending();
    if ending.is_open() {
        terminal::note(ending.at(&end.to_digits(DOUBLE_DIGITS)));
    }
    ending.at(&end.to_string())
}
