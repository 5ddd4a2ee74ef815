//! From a scene and a question to what is printed of the history.

use std::io::IsTerminal as _;

use super::args::OutputArgs;
use super::failure::Failure;
use super::file::Format;
use super::source;
use crate::output::{Head, Shown};
use dalembert::Ending;
use dalembert::Error;
use dalembert::engine::Motion;
use dalembert::number::{DOUBLE_DIGITS, Scalar as _};
use dalembert::quantity::{Measure, Units};
use dalembert::solve::{Plan, Question, Target, TypedHistory, Visitor};
use dalembert::{Effect, Scene};

fn head(scene: &Scene, plan: &Plan) -> Head {
    let units = Units::of(&scene.problem, scene.units);
    let time = |time: f64| format!("{} {}", time.decimal(6), units.name(Measure::Time)).trim_end().to_string();
    Head {
        title: scene.title.clone(),
        number: plan.numbers.to_string(),
        effects: scene.called_effects().into_iter().map(Effect::name).collect(),
        // `c`, `t₁`, `R` and `M` to six digits.
        parameters: units.parameters(&scene.problem, time).join("    "),
        units,
        ..Head::default()
    }
}

/// What is done with a history, in any number system.
pub(crate) trait Visit {
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure>;
}

/// Prints what `bytes` makes of an answer, below the warnings of `head`.
pub(crate) fn print(
    output: &OutputArgs,
    head: Head,
    progress: source::Progress,
    bytes: impl FnOnce(&Head, Format) -> Result<Vec<u8>, Failure>,
) -> Result<(), Failure> {
    let format = output.format()?;
    let head = progress.aside(|| warned(head, output.output.is_none() && format == Format::Table));
    progress.stage("text of the answer");
    let bytes = bytes(&head, format)?;
    // Nothing else stands on a terminal while the answer is printed.
    let progress = (output.output.is_some() || !std::io::stdout().is_terminal()).then_some(progress);
    output.write(&bytes)?;
    drop(progress);
    Ok(())
}

/// What `gather` asks of the history: data, whatever the numbers, and every number in them.
pub(crate) fn gathered<S: Target, T>(
    history: &TypedHistory<S>,
    progress: &source::Progress,
    gather: impl Fn(&dyn Motion<S::Carried>) -> Result<(T, Vec<S::Carried>), Error>,
) -> Result<T, Error> {
    progress.stage("values of the answer");
    Ok(history.ask(gather, |(_, numbers)| numbers.iter().collect())?.0)
}

/// The head, whose warnings are printed.
pub(crate) fn warned(head: Head, shown: bool) -> Head {
    // A table on the screen has them below it.
    if !shown {
        head.warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    head
}

/// Why the history ends where it does, which is printed where that may be before what was asked for.
pub(crate) fn noted_end(ending: &Ending, end: &dyn Shown, digits: u32) -> String {
    if ending.is_open() {
        eprintln!("note: {}", ending.at(&end.printed(DOUBLE_DIGITS)));
    }
    ending.at(&end.printed(if digits == 0 { DOUBLE_DIGITS } else { digits }))
}

/// Solves `scene` for `question`, and hands the history over.
pub(crate) fn solve(scene: &Scene, question: &Question, visit: &impl Visit) -> Result<(), Failure> {
    let plan = Plan::of(&scene.problem, question)?;
    let head = head(scene, &plan);
    let progress = source::Progress::of(scene, &plan);
    let solution = plan.solve(&scene.problem, progress.observer())?;
    let n = solution.digits();
    let head = match solution.exactness_end() {
        None => Head { digits: n, ..head },
        Some(end) => {
            eprintln!("note: {end}; what follows is in {n} digits");
            Head { digits: n, number: format!("{n} digits"), exact_until: Some(end.clone()), ..head }
        }
    };
    solution.visit(Visited { visit, head, progress })
}

struct Visited<'a, V> {
    visit: &'a V,
    head: Head,
    progress: source::Progress,
}

impl<V: Visit> Visitor for Visited<'_, V> {
    type Output = Result<(), Failure>;

    fn visit<S: Target>(self, history: &TypedHistory<S>) -> Result<(), Failure> {
        self.visit.visit(history, self.head, self.progress)
    }
}
