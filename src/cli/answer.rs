//! From a scene and a question to what is printed of the history.

use std::io::IsTerminal as _;

use super::args::OutputArgs;
use super::failure::Failure;
use super::file::Format;
use super::source;
use crate::error::Error;
use crate::mapped::{CollectVec, mapped};
use crate::motion::{Ending, Motion};
use crate::number::{DOUBLE_DIGITS, Scalar};
use crate::output::{Head, Shown};
use crate::quantity::{Measure, Units};
use crate::scene::{Effect, Scene};
use crate::solve::{History, Plan, Question, Target, Visitor};

/// What stands above the numbers of a scene.
pub(super) fn head(scene: &Scene, plan: &Plan) -> Head {
    let called = mapped(scene.called_effects(), Effect::name);
    Head {
        title: scene.title.clone(),
        number: plan.numbers.to_string(),
        effects: called,
        parameters: known(scene).join("    "),
        wide: false,
        digits: 0,
        units: Units::of(&scene.problem, scene.units),
        warnings: Vec::new(),
        exact_until: None,
    }
}

/// `c`, `t₁`, `R` and `M` to six digits.
fn known(scene: &Scene) -> Vec<String> {
    let units = Units::of(&scene.problem, scene.units);
    let time = |time: f64| format!("{} {}", time.decimal(6), units.name(Measure::Time)).trim_end().to_string();
    units.parameters(&scene.problem, time)
}

/// What a subcommand prints of a history, in any number system.
pub(super) trait Report {
    /// What is printed, whatever the numbers.
    type Data;
    /// What is asked of the history, and every number in it.
    fn gather<N: Scalar>(&self, history: &dyn Motion<N>, head: &Head) -> Result<(Self::Data, Vec<N>), Error>;
    fn bytes(&self, data: Self::Data, head: &Head, format: Format) -> Result<Vec<u8>, Failure>;
    /// Adds what several runs are needed for.
    fn add<S: Target>(&self, _: &History<S>, _: &mut Self::Data) -> Result<(), Error> {
        Ok(())
    }
    /// What is said beside the data, on standard error.
    fn note(&self, _: &Self::Data) -> Option<String> {
        None
    }
}

/// What is done with a history, in any number system.
pub(super) trait Visit {
    fn visit<S: Target>(&self, history: &History<S>, head: Head, progress: source::Progress) -> Result<(), Failure>;
}

/// A report, and what it looks like.
pub(super) struct Printed<'a, R>(&'a R, &'a OutputArgs);

impl<R: Report> Visit for Printed<'_, R> {
    fn visit<S: Target>(&self, history: &History<S>, head: Head, progress: source::Progress) -> Result<(), Failure> {
        let Printed(report, output) = *self;
        let head = Head { wide: output.wide, ..head };
        progress.stage("values of the answer");
        let gathered = history.ask(|motion| report.gather(motion, &head), |(_, numbers)| numbers.iter().collect_vec());
        let (mut data, _) = gathered?;
        report.add(history, &mut data)?;
        print(report, output, data, (Head { warnings: history.warnings(), ..head }, progress))
    }
}

fn print<R: Report>(
    report: &R,
    output: &OutputArgs,
    data: R::Data,
    (head, progress): (Head, source::Progress),
) -> Result<(), Failure> {
    let format = output.format()?;
    let head = progress.aside(|| warned(head, output.output.is_none() && format == Format::Table));
    let note = report.note(&data);
    progress.stage("text of the answer");
    let bytes = report.bytes(data, &head, format)?;
    // Nothing else stands on a terminal while the answer is printed.
    let progress = (output.output.is_some() || !std::io::stdout().is_terminal()).then_some(progress);
    output.write(&bytes)?;
    drop(progress);
    note.iter().for_each(|note| eprintln!("note: {note}"));
    Ok(())
}

/// The head, whose warnings are printed.
pub(super) fn warned(head: Head, shown: bool) -> Head {
    // A table on the screen has them below it.
    if !shown {
        head.warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    head
}

/// Why the history ends where it does, which is printed where that may be before what was asked for.
pub(super) fn noted_end(ending: &Ending, end: &dyn Shown, digits: u32) -> String {
    if ending.is_open() {
        eprintln!("note: {}", ending.at(&end.printed(DOUBLE_DIGITS)));
    }
    ending.at(&end.printed(if digits == 0 { DOUBLE_DIGITS } else { digits }))
}

/// Answers `question` of `scene`, and prints what `report` makes of the answer.
pub(super) fn answer(
    scene: &Scene,
    question: &Question,
    output: &OutputArgs,
    report: &impl Report,
) -> Result<(), Failure> {
    solve(scene, question, &Printed(report, output))
}

/// Solves `scene` for `question`, and hands the history over.
pub(super) fn solve(scene: &Scene, question: &Question, visit: &impl Visit) -> Result<(), Failure> {
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

/// A visit with what it is given.
struct Visited<'a, V> {
    visit: &'a V,
    head: Head,
    progress: source::Progress,
}

impl<V: Visit> Visitor for Visited<'_, V> {
    type Output = Result<(), Failure>;

    fn visit<S: Target>(self, history: &History<S>) -> Result<(), Failure> {
        self.visit.visit(history, self.head, self.progress)
    }
}
