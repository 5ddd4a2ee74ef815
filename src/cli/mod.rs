//! The command: one file per subcommand.

mod check;
mod cost;
mod explain;
mod sample;
mod scenes;
mod solve;
mod source;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::history::History;
use crate::output::{Head, Show, write_whole};
use crate::rod::Material;
#[cfg(feature = "mp")]
use crate::scene::System;
use crate::scene::{Ask, Plan, Scene};
#[cfg(feature = "mp")]
use crate::solve::certify;
use crate::solve::{Solution, solve};

/// Everything that can go wrong, ready to be reported.
pub type Failure = miette::Report;

/// The exact reference for the bouncing elastic rod.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version, about, propagate_version = true, arg_required_else_help = true)]
#[command(
    after_help = "A scene is a file, `-` for standard input, or one of the built-in scenes that `dalembert scenes` lists.\n\n\
    Start with:  dalembert solve doyen-ern-piperno"
)]
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
    /// The plan: which effects a scene calls for, which engine and numbers solve it, and what is left out
    Explain(explain::Explain),
    /// What accuracy costs in time: one quantity by every route that can give it
    Cost(cost::Cost),
    /// Hard cases and the paper's claims, worked out by every route and held against the truth
    Check(check::Check),
    /// List the built-in scenes, or print one
    Scenes(scenes::Scenes),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// Runs the command. The exit code is 1 where `check` finds a promise that is not kept.
pub fn run(cli: Cli) -> Result<ExitCode, Failure> {
    let done = match cli.command {
        Command::Solve(command) => command.run(),
        Command::Sample(command) => command.run(),
        Command::Explain(command) => command.run(),
        Command::Cost(command) => command.run(),
        Command::Check(command) => return command.run(),
        Command::Scenes(command) => command.run(),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "dalembert", &mut script);
            Ok(write_whole(None, &script).map_err(source::cannot("write the script"))?)
        }
    };
    done.map(|()| ExitCode::SUCCESS)
}

/// How exact the numbers are to be.
#[derive(Args, Clone, Copy, Debug)]
struct NumberArgs {
    /// Decimal digits, rounded from values known to eight more of their scale; with --exact, from where exactness ends
    #[arg(long, value_name = "N")]
    digits: Option<u32>,
    /// Exact fractions, as far as they reach
    #[arg(long)]
    exact: bool,
    /// Proved digits: everything is enclosed, with as many bits as that takes
    #[arg(long, conflicts_with_all = ["exact", "accuracy"])]
    certified: bool,
    /// Accuracy relative to the natural scales, such as 1e-10; more bits are taken where doubles do not reach it
    #[arg(long, value_name = "E", conflicts_with_all = ["digits", "exact"])]
    accuracy: Option<f64>,
}

impl NumberArgs {
    fn ask(self) -> Ask {
        Ask { exact: self.exact, certified: self.certified, digits: self.digits, from: None, accuracy: self.accuracy }
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

impl OutputArgs {
    fn format(&self) -> Format {
        let ending = self.output.as_ref().and_then(|path| path.extension()).and_then(|ending| ending.to_str());
        self.format.unwrap_or(match ending {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            _ => Format::Table,
        })
    }

    fn write(&self, text: &str) -> Result<(), Failure> {
        let name = self.output.as_ref().map_or("standard output".into(), |path| path.display().to_string());
        Ok(write_whole(self.output.as_deref(), text.as_bytes()).map_err(source::cannot(&format!("write {name}")))?)
    }

    fn write_csv(&self, text: Result<String, csv::Error>) -> Result<(), Failure> {
        self.write(&text.map_err(|error| miette::miette!("cannot write CSV: {error}"))?)
    }

    fn write_json(&self, value: &serde_json::Value) -> Result<(), Failure> {
        self.write(&format!("{value:#}\n"))
    }
}

/// What stands above the numbers of a scene.
fn head(scene: &Scene, plan: &Plan) -> Head {
    let line_density = match &scene.problem.rod.material {
        Material::Elastic { density, area, .. } => Some((density.clone(), area.clone())),
        Material::WaveSpeed(_) => None,
    };
    Head {
        title: scene.title.clone(),
        number: plan.system.to_string(),
        effects: plan.called(),
        digits: 0,
        line_density,
        exact_until: None,
    }
}

/// What a subcommand prints of a history, in any number system.
trait Answer {
    /// What is asked of the history.
    type Data<S: Show>;
    fn gather<S: Show>(&self, history: &dyn History<S>, head: &Head) -> Result<Self::Data<S>, Failure>;
    /// Every number in the data.
    #[cfg_attr(not(feature = "mp"), allow(dead_code))]
    fn numbers<'a, S: Show>(&self, data: &'a Self::Data<S>) -> Vec<&'a S>;
    fn print<S: Show>(&self, data: &Self::Data<S>, head: &Head) -> Result<(), Failure>;
}

/// Plans and solves `scene` as asked, and lets `what` print of the solution.
fn answer(scene: &Scene, ask: Ask, what: &impl Answer) -> Result<(), Failure> {
    let plan = Plan::of(scene, ask)?;
    let head = head(scene, &plan);
    #[cfg(feature = "mp")]
    if let System::Certified(digits) = plan.system {
        let head = Head { digits, ..head };
        let data = {
            let progress = source::Progress::of(scene, &plan);
            let gather = |history: &dyn History<_>| what.gather(history, &head);
            certify(
                &scene.problem,
                digits,
                gather,
                |data| what.numbers(data),
                |trip, pieces| progress.observe(trip, pieces),
            )?
        };
        return what.print(&data, &head);
    }
    let solution = {
        let progress = source::Progress::of(scene, &plan);
        solve(&scene.problem, &plan, |trip, pieces| progress.observe(trip, pieces))?
    };
    match &solution {
        Solution::Double(history) => what.print(&what.gather(history.as_ref(), &head)?, &head),
        #[cfg(feature = "mp")]
        Solution::Digits(history, digits) => {
            source::tell_inexact(&scene.problem, &plan);
            let head = Head { number: format!("{digits} digits"), digits: *digits, ..head };
            what.print(&what.gather(history.as_ref(), &head)?, &head)
        }
        #[cfg(feature = "mp")]
        Solution::Exact(history, None) => what.print(&what.gather(history.as_ref(), &head)?, &head),
        #[cfg(feature = "mp")]
        Solution::Exact(exact, Some((history, digits))) => {
            eprintln!("note: {}; what follows is in {digits} digits", exact.ending());
            let (number, exact_until) = (format!("{digits} digits"), Some(exact.ending().clone()));
            let head = Head { digits: *digits, number, exact_until, ..head };
            what.print(&what.gather(history.as_ref(), &head)?, &head)
        }
    }
}
