//! The command: one file per subcommand.

mod check;
mod compare;
mod cost;
mod explain;
mod figures;
mod file;
mod plot;
mod reference;
mod regimes;
mod sample;
mod scenes;
mod solve;
mod source;
mod sweep;
mod times;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::error::Error;
use crate::history::History;
use crate::motion::{Ending, Motion};
use crate::number::{DOUBLE_DIGITS, Number, Scalar, show};
use crate::output::{Head, SCHEMA};
use crate::problem::Parameters;
use crate::quantity::{Measure, Units};
use crate::scene::{Effect, Scene};
use crate::solution::Solution;
use crate::solve::{CERTIFIED_DIGITS, Numbers, Plan, Question, Target};

/// Everything that can go wrong, ready to be reported.
pub type Failure = miette::Report;

/// The version and the features of this build.
const VERSION: &str = match (cfg!(feature = "mp"), cfg!(feature = "plot")) {
    (true, true) => concat!(env!("CARGO_PKG_VERSION"), " (features: cli, mp, plot)"),
    (true, false) => concat!(env!("CARGO_PKG_VERSION"), " (features: cli, mp)"),
    (false, true) => concat!(env!("CARGO_PKG_VERSION"), " (features: cli, plot)"),
    (false, false) => concat!(env!("CARGO_PKG_VERSION"), " (features: cli)"),
};

/// The exact reference for the bouncing elastic rod.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version = VERSION, about, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "A scene is a file, `-` for standard input, or one of the built-in scenes that \
    `dalembert scenes` lists.\n\n\
    Start with:  dalembert solve doyen-ern-piperno")]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve a scene: events, contacts, restitution, energies, stress history
    Solve(solve::Solve),
    /// Values of a quantity at chosen times
    Sample(sample::Sample),
    /// Pictures of a scene, or of several to compare: the rod over time, stress, motion, energy, restitution
    Plot(plot::Plot),
    /// Golden files: all quantities at chosen times as CSV, JSON or NPZ, or the exact solution as a function
    Reference(reference::Reference),
    /// The plan: which effects a scene calls for, which engine and numbers solve it, and what is left out
    Explain(explain::Explain),
    /// What accuracy costs in time: one quantity by every route that can give it
    Cost(cost::Cost),
    /// Your data against the exact history: norms, contacts, an audit, and hints at what may be wrong
    Compare(compare::Compare),
    /// Numbers of a scene over a grid of its values, on all cores
    Sweep(sweep::Sweep),
    /// When and whether the first contact ends, over all dampings and impact speeds
    Regimes(regimes::Regimes),
    /// The figures of the paper from its parameters, and two more: SVG, PNG, PDF and CSV, with an index
    Figures(figures::Figures),
    /// Hard cases and the paper's claims, worked out by every route and held against the truth
    Check(check::Check),
    /// List the built-in scenes, print one, or hold it against what others have published
    Scenes(scenes::Scenes),
    /// Print the manual page, for `man -l -`
    Man,
    /// Print the JSON Schema of what `solve`, `sample`, `reference`, `compare` and `sweep` write with --format json
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// Runs the command. The exit code is 1 where `check` finds a promise that is not kept, `compare` a norm above its
/// bound, and no point of a `sweep` has a number.
pub fn run(cli: Cli) -> Result<ExitCode, Failure> {
    let done = match cli.command {
        Command::Solve(command) => command.run(),
        Command::Sample(command) => command.run(),
        Command::Plot(command) => command.run(),
        Command::Reference(command) => command.run(),
        Command::Explain(command) => command.run(),
        Command::Cost(command) => command.run(),
        Command::Compare(command) => return command.run(),
        Command::Sweep(command) => return command.run(),
        Command::Regimes(command) => command.run(),
        Command::Figures(command) => command.run(),
        Command::Check(command) => return command.run(),
        Command::Scenes(command) => command.run(),
        Command::Man => {
            let mut page = Vec::new();
            let done = clap_mangen::Man::new(Cli::command()).render(&mut page);
            done.map_err(source::cannot("write the page"))?;
            file::write(None, &page)
        }
        Command::Schema => file::write(None, SCHEMA.as_bytes()),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "dalembert", &mut script);
            file::write(None, &script)
        }
    };
    done.map(|()| ExitCode::SUCCESS)
}

/// How exact the numbers are to be.
#[derive(Args, Clone, Copy, Debug)]
struct NumberArgs {
    /// Decimal digits, rounded from values known to eight more of their scale; with --exact, from where exactness ends
    #[arg(long, value_name = "N", value_parser = digits)]
    digits: Option<u32>,
    /// Exact fractions, as far as they reach
    #[arg(long)]
    exact: bool,
    /// Proved digits: everything is enclosed, with as many bits as that takes
    #[arg(long, conflicts_with_all = ["exact", "accuracy"])]
    certified: bool,
    /// Accuracy relative to the greatest number of an answer, such as 1e-10; more bits are taken where doubles do not
    /// reach it
    #[arg(long, value_name = "E", value_parser = accuracy, conflicts_with_all = ["digits", "exact"])]
    accuracy: Option<f64>,
}

fn digits(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| "expected a whole number of digits, such as 50".into())
}

fn accuracy(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "expected a number such as 1e-10".into())
}

impl NumberArgs {
    /// Whether the answers are doubles.
    fn in_doubles(self) -> bool {
        self.digits.is_none() && !self.certified && !self.exact
    }

    /// The numbers that are asked for; without an option, doubles to the accuracy of the scene.
    fn numbers(self, scene: &Scene) -> Numbers {
        match self {
            NumberArgs { certified: true, digits, .. } => Numbers::Certified(digits.unwrap_or(CERTIFIED_DIGITS)),
            NumberArgs { exact: true, digits: None, .. } => Numbers::Exact,
            NumberArgs { exact: true, digits: Some(digits), .. } => Numbers::ExactThenDigits(digits),
            NumberArgs { digits: Some(digits), .. } => Numbers::Digits(digits),
            NumberArgs { accuracy, .. } => Numbers::Double(accuracy.or(scene.accuracy.as_ref().map(Number::to_f64))),
        }
    }
}

/// Where the output goes and what it looks like.
#[derive(Args, Clone, Debug)]
struct OutputArgs {
    /// What to print; by default a table, or what the ending of FILE says
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to this file, whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// One row for each contact or effect, however wide the table
    #[arg(long)]
    wide: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For a person
    Table,
    /// For a program
    Json,
    /// For a spreadsheet
    Csv,
}

/// So many threads; by default one for each core.
fn pool(threads: Option<usize>) -> Result<rayon::ThreadPool, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    pool.map_err(|error| miette::miette!("cannot start threads: {error}"))
}

impl OutputArgs {
    /// What is printed: what is asked for, or what the ending of the file says.
    fn format(&self) -> Result<Format, Failure> {
        let endings = [("json", Format::Json), ("csv", Format::Csv), ("txt", Format::Table), ("", Format::Table)];
        file::format(self.format, self.output.as_deref(), &endings)
    }

    fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        file::write(self.output.as_deref(), bytes)
    }
}

/// What stands above the numbers of a scene.
fn head(scene: &Scene, plan: &Plan) -> Head {
    let called = scene.called_effects().into_iter().map(Effect::name).collect();
    Head {
        title: scene.title.clone(),
        number: plan.numbers.to_string(),
        effects: called,
        parameters: parameters(scene),
        wide: false,
        digits: 0,
        units: Units::of(&scene.problem, scene.units),
        warnings: Vec::new(),
        exact_until: None,
    }
}

/// `c`, `t₁`, `R` and `M` to six digits.
fn parameters(scene: &Scene) -> String {
    let Ok(rod) = Parameters::<f64>::of(&scene.problem, &()) else { return String::new() };
    let units = Units::of(&scene.problem, scene.units);
    let shown = |value: f64, measure| format!("{} {}", value.decimal(6), units.name(measure)).trim_end().to_string();
    let (c, t1) = (shown(rod.wave_speed, Measure::Velocity), shown(rod.round_trip(), Measure::Time));
    let mut text = format!("c = {c}    t₁ = {t1}");
    let groups = scene.problem.dimensionless();
    if groups.damping_ratio > 0.0 {
        text += &format!("    R = r t₁ = {}", groups.damping_ratio.decimal(6));
    }
    if let Some(ratio) = groups.speed_ratio.filter(|ratio| ratio.is_finite()) {
        text += &format!("    M = μ/(g t₁) = {}", ratio.decimal(6));
    }
    text
}

/// What a subcommand prints of a history, in any number system.
trait Report {
    /// What is asked of the history.
    type Data<N: Scalar>;
    fn gather<N: Scalar>(&self, history: &dyn Motion<N>, head: &Head) -> Result<Self::Data<N>, Error>;
    /// Every number in the data.
    fn numbers<'a, N: Scalar>(&self, data: &'a Self::Data<N>) -> Vec<&'a N>;
    fn bytes<N: Scalar>(&self, data: &Self::Data<N>, head: &Head, format: Format) -> Result<Vec<u8>, Failure>;
}

/// What is done with a history, in any number system.
trait Visit {
    fn visit<S: Target>(&self, history: &History<S>, head: Head, progress: source::Progress) -> Result<(), Failure>;
}

/// A report, and what it looks like.
struct Printed<'a, R>(&'a R, &'a OutputArgs);

impl<R: Report> Visit for Printed<'_, R> {
    fn visit<S: Target>(&self, history: &History<S>, head: Head, progress: source::Progress) -> Result<(), Failure> {
        let Printed(report, output) = *self;
        let head = Head { wide: output.wide, ..head };
        let gathered = history.ask(|motion| report.gather(motion, &head), |data| report.numbers(data));
        drop(progress);
        let data = gathered?;
        let format = output.format()?;
        let head = warned(history, head, output.output.is_none() && format == Format::Table);
        output.write(&report.bytes(&data, &head, format)?)
    }
}

/// The head with the warnings of the history, which are printed.
fn warned<S: Target>(history: &History<S>, head: Head, shown: bool) -> Head {
    let head = Head { warnings: history.warnings(), ..head };
    // A table on the screen has them below it.
    if !shown {
        head.warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    head
}

/// Why the history ends where it does, which is printed where that may be before what was asked for.
fn noted_end<S: Scalar>(ending: &Ending, end: &S, digits: u32) -> String {
    if ending.is_open() {
        eprintln!("note: {}", ending.at(&show(end, DOUBLE_DIGITS)));
    }
    ending.at(&show(end, if digits == 0 { DOUBLE_DIGITS } else { digits }))
}

/// Answers `question` of `scene`, and prints what `report` makes of the answer.
fn answer(scene: &Scene, question: &Question, output: &OutputArgs, report: &impl Report) -> Result<(), Failure> {
    solve(scene, question, &Printed(report, output))
}

/// Solves `scene` for `question`, and hands the history over.
fn solve(scene: &Scene, question: &Question, visit: &impl Visit) -> Result<(), Failure> {
    let plan = Plan::of(&scene.problem, question)?;
    let head = head(scene, &plan);
    let progress = source::Progress::of(scene, &plan);
    let solution = plan.solve(&scene.problem, progress.observer())?;
    let digits = |digits: u32, head: Head| Head { digits, ..head };
    match &solution {
        Solution::Double(motion) => visit.visit(motion, head, progress),
        Solution::Exact(motion) => visit.visit(motion, head, progress),
        Solution::Certified(motion, n) => visit.visit(motion, digits(*n, head), progress),
        Solution::Digits(motion, n) => visit.visit(motion, digits(*n, head), progress),
        Solution::DigitsAfter(motion, n, end) => {
            eprintln!("note: {end}; what follows is in {n} digits");
            let (number, exact_until) = (format!("{n} digits"), Some(end.clone()));
            visit.visit(motion, Head { digits: *n, number, exact_until, ..head }, progress)
        }
    }
}
