//! `dalembert solve`.

use std::io::IsTerminal;

use clap::Args;

use crate::answer::{Visit, gathered, noted_end, print, solve};
use crate::args::{NumberArgs, OutputArgs};
use crate::failure::Failure;
use crate::file::{self, Format};
use crate::output::{
    Derived, Form, Head, LEGEND, Part, Record, history_json, history_part, history_table, outline, record, shared,
};
use crate::source;
use dalembert::Error;
use dalembert::engine::Motion;
use dalembert::number::{Number, Scalar};
use dalembert::problem::{Parameter, Run};
use dalembert::quantity::Table;
use dalembert::solve::{Question, Target, TypedHistory};

const EXAMPLES: &str = "Examples:\n  dalembert solve doyen-ern-piperno --exact\n  \
    dalembert solve rod.toml --digits 38 -o rod.json\n  \
    dalembert solve doyen-ern-piperno --derivatives speed,gravity\n  \
    dalembert scenes paper-weak | dalembert solve - --format csv --part stress";

#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\nSymbols:\n{LEGEND}"))]
pub(crate) struct Solve {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    /// The last time, in place of the scene's own run
    #[arg(long, value_name = "T", conflicts_with = "impacts", allow_hyphen_values = true)]
    to: Option<Number>,
    /// How many contacts, each with the flight after it, in place of the scene's own run
    #[arg(long, value_name = "N", value_parser = contacts)]
    impacts: Option<u32>,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
    /// Explain the symbols of the table in a line each
    #[arg(long)]
    legend: bool,
    /// What a CSV holds; by default the events
    #[arg(long, value_enum)]
    part: Option<Part>,
    /// Derivatives of events and contacts by values of the scene: length, wave_speed, modulus, density, damping,
    /// gravity, speed, gap, displacement or velocity of the start, velocity[0] of its first point; all others stay as
    /// they are
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    derivatives: Vec<Parameter>,
    /// With --part stress: the Chebyshev coefficients of curved pieces, not straight lines within 1e-6 of the peak
    #[arg(long)]
    coefficients: bool,
}

fn contacts(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| "expected a whole number of contacts, such as 10".into())
}

impl Solve {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if self.part.is_some() && self.output.format()? != Format::Csv {
            return Err(failure!(
                "found --part, expected it with --format csv only: JSON holds all parts, and a table all but the stress"
            ));
        }
        if self.coefficients && self.part != Some(Part::Stress) {
            return Err(failure!("found --coefficients, expected it with --part stress only"));
        }
        if self.part == Some(Part::Stress) && !self.derivatives.is_empty() {
            return Err(failure!("found --derivatives with --part stress, expected them of events or contacts"));
        }
        let mut scene = source::read(&self.scene)?;
        if let Some(run) = self.to.clone().map(Run::Time).or(self.impacts.map(Run::Impacts)) {
            scene.problem = scene.problem.with_run(run)?;
        }
        solve(&scene, &Question::run(self.numbers.numbers(&scene)), self)
    }

    /// Whether the stress is drawn above the table: for a person at a terminal that has more than plain letters. It has
    /// no colour, so that NO_COLOR changes nothing.
    fn draws(&self) -> bool {
        let table = self.output.output.is_none() && matches!(self.output.format(), Ok(Format::Table));
        table && std::io::stdout().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
    }

    fn gather<S: Scalar>(&self, history: &dyn Motion<S>, head: &Head) -> Result<(Record, Vec<S>), Error> {
        let stress = match (self.output.format(), self.part) {
            (Ok(Format::Json), _) => Some(Form::Series),
            (Ok(Format::Csv), Some(Part::Stress)) if self.coefficients => Some(Form::Series),
            (Ok(Format::Csv), Some(Part::Stress)) => Some(Form::Straight),
            _ => None,
        };
        let (mut found, numbers) = record(history, stress, !self.numbers.in_doubles(), head)?;
        if self.draws() {
            found.outline = outline(history);
        }
        Ok((found, numbers))
    }

    fn bytes(&self, record: Record, head: &Head, format: Format) -> Result<Vec<u8>, Failure> {
        // A table on the screen says it.
        if self.output.output.is_some() || format != Format::Table {
            noted_end(&record.end.1, &*record.end.0, head.digits);
        }
        match format {
            Format::Table if self.legend => Ok(format!("{}\n{LEGEND}", history_table(record, head)).into_bytes()),
            Format::Table => Ok(history_table(record, head).into_bytes()),
            Format::Json => Ok(file::json(&history_json(&record, head))),
            _ => file::rows(&history_part(record, self.part.unwrap_or_default(), self.coefficients, head), format),
        }
    }
}

impl Visit for Solve {
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure> {
        let head = Head { wide: self.output.wide, ..head };
        let mut record = gathered(history, &progress, |motion| self.gather(motion, &head))?;
        for by in self.derivatives.iter().copied() {
            // There are no more contacts than events: a row has an event, and a contact beside it where there is one.
            let [event, contact] = [Table::Events, Table::Contacts].map(Table::quantities);
            let mut events = shared(history.derivatives(by, &[event, contact].concat())?);
            let contacts = events.iter_mut().map(|row| row.split_off(event.len().min(row.len())));
            let contacts = contacts.filter(|row| !row.is_empty()).collect();
            record.add(Derived { by, events, contacts });
        }
        let head = Head { warnings: history.warnings(), ..head };
        print(&self.output, head, progress, |head, format| self.bytes(record, head, format))
    }
}
