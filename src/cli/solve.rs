//! `dalembert solve`.

use clap::{Args, ValueEnum};

use super::{Failure, Format, NumberArgs, OutputArgs, head, source};
use crate::history::History;
use crate::output::{Head, Part, Show, history_csv, history_json, history_table, record};
use crate::scene::Plan;
use crate::solve::{Solution, solve};

/// Solve a scene: events, contacts, restitution, energies, stress history
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  dalembert solve doyen-ern-piperno --exact\n  dalembert solve rod.toml --digits 38 -o rod.json\n  \
    dalembert scenes paper-weak | dalembert solve - --format csv --part stress"
)]
pub(super) struct Solve {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
    /// What a CSV holds; by default the events
    #[arg(long, value_enum)]
    part: Option<PartArg>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PartArg {
    /// Impacts and releases
    Events,
    /// Contacts
    Contacts,
    /// Pieces of the stress at the ground
    Stress,
}

impl Solve {
    pub(super) fn run(&self) -> Result<(), Failure> {
        if self.part.is_some() && self.output.format() != Format::Csv {
            return Err(miette::miette!("found --part, expected it with --format csv only"));
        }
        let scene = source::read(&self.scene)?;
        let plan = Plan::of(&scene, self.numbers.ask())?;
        let head = head(&scene, &plan);
        let solution = {
            let progress = source::Progress::of(&scene, &plan);
            solve(&scene.problem, &plan, |trip, pieces| progress.observe(trip, pieces))?
        };
        match &solution {
            Solution::Double(history) => self.print(history.as_ref(), &head),
            #[cfg(feature = "mp")]
            Solution::Digits(history, digits) => {
                source::tell_inexact(&scene.problem, &plan);
                self.print(history.as_ref(), &Head { number: format!("{digits} digits"), digits: *digits, ..head })
            }
            #[cfg(feature = "mp")]
            Solution::Exact(history, None) => self.print(history.as_ref(), &head),
            #[cfg(feature = "mp")]
            Solution::Exact(exact, Some((history, digits))) => {
                eprintln!("note: {}; the history that follows is in {digits} digits", exact.ending());
                let (number, exact_until) = (format!("{digits} digits"), Some(exact.ending().clone()));
                self.print(history.as_ref(), &Head { digits: *digits, number, exact_until, ..head })
            }
        }
    }

    fn print<S: Show>(&self, history: &dyn History<S>, head: &Head) -> Result<(), Failure> {
        let stress = match self.output.format() {
            Format::Table => false,
            Format::Json => true,
            Format::Csv => matches!(self.part, Some(PartArg::Stress)),
        };
        let record = record(history, head, stress)?;
        for warning in &record.warnings {
            eprintln!("warning: {warning}");
        }
        match self.output.format() {
            Format::Table => self.output.write(&history_table(&record, head)),
            Format::Json => self.output.write_json(&history_json(&record, head)),
            Format::Csv => {
                let part = match self.part.unwrap_or(PartArg::Events) {
                    PartArg::Events => Part::Events,
                    PartArg::Contacts => Part::Contacts,
                    PartArg::Stress => Part::Stress,
                };
                let text =
                    history_csv(&record, part, head).map_err(|error| miette::miette!("cannot write CSV: {error}"))?;
                self.output.write(&text)
            }
        }
    }
}
