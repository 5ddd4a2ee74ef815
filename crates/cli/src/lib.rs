//! The command: one file per subcommand; `args`, `answer`, `source`, `file` and `failure` are what they share.

#[macro_use]
mod failure;

mod answer;
mod args;
mod commands;
mod file;
mod output;
mod source;
pub mod sweep;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::output::SCHEMA;
use commands::{
    check, compare, cost, explain, figures, plot, reference, regimes, sample, scenes, solve, sweep as sweeping,
};
use failure::Failure;

const VERSION: &str = match (cfg!(feature = "mp"), cfg!(feature = "raster")) {
    (true, true) => concat!(env!("CARGO_PKG_VERSION"), " (features: mp, raster)"),
    (true, false) => concat!(env!("CARGO_PKG_VERSION"), " (features: mp)"),
    (false, true) => concat!(env!("CARGO_PKG_VERSION"), " (features: raster)"),
    (false, false) => concat!(env!("CARGO_PKG_VERSION"), ""),
};

/// The exact reference for the bouncing elastic rod.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version = VERSION, about, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "A scene is a file, `-` for standard input, or one of the built-in scenes that \
    `dalembert scenes` lists.\n\n\
    Start with:  dalembert solve doyen-ern-piperno")]
struct Cli {
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
    Sweep(sweeping::Sweep),
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

/// Parses, runs and reports; the first of `arguments` is the name of the program. The exit code is 2 for what cannot be
/// parsed or run.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        // Help and the version are on standard output, with the code 0.
        Err(said) => {
            let failed = said.use_stderr();
            let written = said.print();
            return if failed || written.is_err() { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    run(cli).unwrap_or_else(|failure| {
        eprintln!("{failure}");
        ExitCode::from(2)
    })
}

/// Runs the command. The exit code is 1 where `check` finds a promise that is not kept, `compare` a norm above its
/// bound, and no point of a `sweep` has a number.
fn run(cli: Cli) -> Result<ExitCode, Failure> {
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
        Command::Scenes(command) => return command.run(),
        Command::Man => {
            let mut page = Vec::new();
            let done = clap_mangen::Man::new(Cli::command()).render(&mut page);
            done.map_err(failure::cannot("write the page"))?;
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
