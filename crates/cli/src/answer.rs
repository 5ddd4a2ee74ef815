//! Solving a scene for a question, with its progress and its notes.

use crate::failure::Failure;
use crate::output::{RunInfo, Shown};
use crate::progress::Progress;
use crate::terminal;
use dalembert::engine::Motion;
use dalembert::number::{DOUBLE_DIGITS, Scalar as _};
use dalembert::quantity::{Measure, Units};
use dalembert::solve::{History, Plan, Question, Target, Visitor};
use dalembert::{Effect, Ending, Error, Scene};

fn run_info(scene: &Scene, plan: &Plan) -> RunInfo {
    let units = Units::of(&scene.problem, scene.units);
    let time = |time: f64| format!("{} {}", time.decimal(6), units.name(Measure::Time)).trim_end().to_string();
    RunInfo {
        title: scene.title.clone(),
        number: plan.numbers.to_string(),
        effects: scene.called_effects().into_iter().map(Effect::name).collect(),
        // `c`, `t₁`, `R` and `M` to six digits.
        parameters: units.parameters(&scene.problem, time).join("    "),
        units,
        ..RunInfo::default()
    }
}

/// An output made of a history in any number system.
pub(crate) trait UseHistory {
    fn apply<S: Target>(&self, history: &History<S>, info: RunInfo, progress: Progress) -> Result<(), Failure>;
}

/// Returns the data that `gather` takes from the history, once every number in them is settled.
pub(crate) fn gathered<S: Target, T>(
    history: &History<S>,
    progress: &Progress,
    gather: impl Fn(&dyn Motion<S::Carried>) -> Result<(T, Vec<S::Carried>), Error>,
) -> Result<T, Error> {
    progress.set_stage("values of the answer");
    Ok(history.ask(gather, |(_, numbers)| numbers.iter().collect())?.0)
}

/// Returns the reason why the history ends, and prints it as a note if the end may be before what was requested.
pub(crate) fn note_end(ending: &Ending, end: &dyn Shown, digits: u32) -> String {
    if ending.is_open() {
        terminal::note(ending.at(&end.printed(DOUBLE_DIGITS)));
    }
    ending.at(&end.printed(if digits == 0 { DOUBLE_DIGITS } else { digits }))
}

/// Solves `scene` for `question`, and makes an output of the history.
pub(crate) fn solve(scene: &Scene, question: &Question, output: &impl UseHistory) -> Result<(), Failure> {
    let plan = Plan::of(&scene.problem, question)?;
    let info = run_info(scene, &plan);
    let progress = Progress::new(scene, &plan);
    let solution = plan.solve(&scene.problem, progress.observer())?;
    let digits = solution.digits();
    let info = match solution.exactness_end() {
        None => RunInfo { digits, ..info },
        Some(end) => {
            terminal::note(format!("{end}; what follows is in {digits} digits"));
            RunInfo { digits, number: format!("{digits} digits"), exact_until: Some(end.clone()), ..info }
        }
    };
    solution.visit(Apply { output, info, progress })
}

struct Apply<'a, V> {
    output: &'a V,
    info: RunInfo,
    progress: Progress,
}

impl<V: UseHistory> Visitor for Apply<'_, V> {
    type Output = Result<(), Failure>;

    fn visit<S: Target>(self, history: &History<S>) -> Result<(), Failure> {
        self.output.apply(history, self.info, self.progress)
    }
}
