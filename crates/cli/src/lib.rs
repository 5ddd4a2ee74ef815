//! The command `dalembert`, one file for each subcommand.

#[macro_use]
mod failure;

mod answer;
mod args;
mod commands;
mod file;
mod output;
mod progress;
mod quantities;
mod source;
pub mod sweep;
mod terminal;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};

use commands::{
    check, cite, compare, cost, explain, figures, orbits, plot, regimes, sample, scenes, solve, sweep as sweep_command,
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
    /// Print no notes, warnings or progress
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Colours of messages and help
    #[arg(
        long,
        global = true,
        value_enum,
        default_value_t,
        hide_possible_values = true,
        value_name = "auto|always|never"
    )]
    color: ColorChoice,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve a scene: events, contacts, restitution, energies, stress history
    Solve(solve::Solve),
    /// Values of quantities at chosen times, over time or along the rod
    Sample(sample::Sample),
    /// Pictures of a scene, or of several to compare: the rod over time, stress, motion, energy, restitution
    Plot(plot::Plot),
    /// Golden files: `sample` with all quantities as CSV, both limits at jumps; or the exact solution as a function
    Reference(sample::Reference),
    /// The plan: which effects a scene calls for, which engine and numbers solve it, and what is left out
    Explain(explain::Explain),
    /// The time that accuracy takes: one quantity by every route that can give it
    Cost(cost::Cost),
    /// Your data against the exact history: norms, contacts, an audit, and hints at what may be wrong
    Compare(compare::Compare),
    /// Numbers of a scene over a grid of its values, on all cores
    Sweep(sweep_command::Sweep),
    /// The end of the first contact, over all dampings and impact speeds
    Regimes(regimes::Regimes),
    /// Periodic orbits of an undamped rod with one contact in each period: their period against their energy
    Orbits(orbits::Orbits),
    /// The figures of the paper from its parameters, and two more: SVG, PNG, PDF and CSV, with an index
    Figures(figures::Figures),
    /// Hard cases and the paper's claims, worked out by every route and held against the truth
    Check(check::Check),
    /// List the built-in scenes, print one, or hold it against what others have published
    Scenes(scenes::Scenes),
    /// The references of a run, in words and as BibTeX: the program, the paper, and the sources of the scene
    Cite(cite::Cite),
    /// Print the manual page, for `man -l -`
    Man,
    /// Print the JSON Schema of the output that `solve`, `sample`, `reference`, `compare` and `sweep` write with
    /// --format json
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// The reason why the command did nothing: arguments that cannot be parsed, or a failure on the way.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// Arguments that cannot be parsed; or help or the version, which were asked for.
    #[error(transparent)]
    Arguments(#[from] clap::Error),
    /// A failure, as it is reported.
    #[error("{0}")]
    Failed(String),
}

/// Runs the command on `arguments`, as [`try_main`], and reports a failure with the exit code 2.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    match try_main(arguments) {
        Ok(code) => code,
        // Help and the version are on standard output, with the code 0.
        Err(CommandError::Arguments(error)) => {
            let is_failure = error.use_stderr();
            let printed = error.print();
            if is_failure || printed.is_err() { ExitCode::from(2) } else { ExitCode::SUCCESS }
        }
        Err(CommandError::Failed(text)) => {
            eprintln!("{text}");
            ExitCode::from(2)
        }
    }
}

/// Runs the command on `arguments`, the first of which is the name of the program, and returns its exit code.
pub fn try_main(arguments: impl IntoIterator<Item = OsString>) -> Result<ExitCode, CommandError> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let matches = command().color(color(&arguments)).try_get_matches_from(arguments)?;
    let cli = Cli::from_arg_matches(&matches)?;
    terminal::configure(cli.quiet, cli.color);
    run(cli).map_err(|failure| CommandError::Failed(failure.to_string()))
}

/// Returns the grammar of the command, in which every option takes negative numbers.
fn command() -> clap::Command {
    Cli::command().mut_subcommands(|subcommand| {
        subcommand.mut_args(|argument| {
            let takes_value = !argument.is_positional() && argument.get_action().takes_values();
            if takes_value && !argument.is_allow_hyphen_values_set() {
                argument.allow_negative_numbers(true)
            } else {
                argument
            }
        })
    })
}

/// Returns the value of `--color`, which holds for errors of the other arguments too.
fn color(arguments: &[OsString]) -> ColorChoice {
    let texts = || arguments.iter().filter_map(|argument| argument.to_str());
    let joined = texts().find_map(|argument| argument.strip_prefix("--color="));
    let apart = texts().zip(texts().skip(1)).find_map(|(option, value)| (option == "--color").then_some(value));
    joined.or(apart).and_then(|value| value.parse().ok()).unwrap_or_default()
}

/// Runs the command. The exit code is 1 if `check` finds a promise that is not kept, `compare` a norm above its bound,
/// and no point of a `sweep` has a number.
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
        Command::Orbits(command) => command.run(),
        Command::Figures(command) => command.run(),
        Command::Check(command) => return command.run(),
        Command::Scenes(command) => return command.run(),
        Command::Cite(command) => command.run(),
        Command::Man => {
            let mut page = Vec::new();
            let done = clap_mangen::Man::new(command()).render(&mut page);
            done.map_err(failure::cannot("write the page"))?;
            file::print(&page)
        }
        Command::Schema => file::print(&output::json_bytes(output::schema().as_value())),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), "dalembert", &mut script);
            file::print(&script)
        }
    };
    done.map(|()| ExitCode::SUCCESS)
}
