//! `dalembert solve`.

use std::io::IsTerminal;

use clap::Args;

use super::chain;
use crate::answer::{Answer, note_end, solve};
use crate::args::{SceneArgs, each_once, expecting, known_formats};
use crate::failure::Failure;
use crate::file::{Destination, Format, ROWS, write_all};
use crate::output::{HistoryPart, HistoryTables, LEGEND, RunInfo, STRAIGHT_ERROR, json_bytes, outline, rows_bytes};
use crate::source::AnyScene;
use dalembert::ChainScene;
use dalembert::number::Number;
use dalembert::problem::{Parameter, Run};
use dalembert::quantity::Table;
use dalembert::solve::{Question, StressForm};

const EXAMPLES: &str = "Examples:\n  dalembert solve doyen-ern-piperno --exact\n  \
    dalembert solve rod.toml --digits 38 -o rod.json\n  \
    dalembert solve doyen-ern-piperno --derivatives impact_speed,gravity\n  \
    dalembert scenes paper-weak | dalembert solve - --part stress";

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(ROWS)))]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\nSymbols:\n{LEGEND}"))]
pub(crate) struct Solve {
    #[command(flatten)]
    scene: SceneArgs,
    /// The last time, in place of the scene's own run
    #[arg(long, value_name = "T", conflicts_with = "impacts", allow_hyphen_values = true)]
    to: Option<Number>,
    /// Number of contacts, each with the flight after it, in place of the scene's own run
    #[arg(long, value_name = "N", value_parser = expecting::<u32>("a whole number of contacts, such as 10"))]
    impacts: Option<u32>,
    /// Keep each row of a table on one line, however wide
    #[arg(long)]
    wide: bool,
    /// Explain the symbols of the table in a line each
    #[arg(long)]
    legend: bool,
    /// The part of the history in a CSV, which this option implies; by default the events
    #[arg(long, value_enum)]
    part: Option<HistoryPart>,
    /// Derivatives of events and contacts by values of the scene: length, wave_speed, modulus, density, damping,
    /// gravity, impact_speed, gap, stiffness of a contact that yields, displacement, strain or velocity of the start,
    /// velocity[0] of its first point, body.2.length or joint.1.gap of a chain, or paths such as impact.speed; all
    /// others stay as they are
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Parameter::differentiable)]
    derivatives: Vec<Parameter>,
    /// The Chebyshev coefficients of curved pieces, with --part stress; otherwise straight lines within 1e-6 of the
    /// peak
    #[arg(long)]
    coefficients: bool,
}

impl Solve {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let destinations = self.scene.output.destinations_in(self.part.map(|_| Format::Csv), ROWS)?;
        each_once(&self.derivatives)?;
        if self.part.is_some() && destinations.iter().any(|destination| destination.format != Format::Csv) {
            return Err(failure!(
                "found --part, expected it with CSV only: JSON holds all parts, and a table all but the stress"
            ));
        }
        if self.coefficients && self.part != Some(HistoryPart::Stress) {
            return Err(failure!("found --coefficients, expected it with --part stress only"));
        }
        if let Some(part @ (HistoryPart::Stress | HistoryPart::Forces)) = self.part
            && !self.derivatives.is_empty()
        {
            let part: &str = if part == HistoryPart::Stress { "stress" } else { "forces" };
            return Err(failure!("found --derivatives with --part {part}, expected them of events or contacts"));
        }
        let mut scene = match self.scene.body.read_any(&self.scene.scene)? {
            AnyScene::Rod(scene) => *scene,
            // A chain of one body is a rod to what a whole chain does not have.
            AnyScene::Chain(scene) if scene.chain.bodies().len() == 1 && self.is_of_rod() => scene.body(0)?,
            AnyScene::Chain(scene) => return self.chain(*scene, &destinations),
        };
        if self.part == Some(HistoryPart::Forces) {
            return Err(failure!("found --part forces with a rod, expected events, contacts or stress"));
        }
        let numbers = self.scene.numbers.numbers_to(scene.accuracy);
        if let Some(run) = self.to.clone().map(Run::Time).or(self.impacts.map(Run::Impacts)) {
            scene.problem = scene.problem.with_run(run)?;
        }
        let Answer { history, info, progress } = solve(&scene, &Question::run(numbers))?;
        progress.set_stage("values of the answer");
        let has = |format: Format| destinations.iter().any(|destination| destination.format == format);
        let is_stress = self.part == Some(HistoryPart::Stress);
        let stress = match (has(Format::Json) || self.coefficients, is_stress) {
            (true, _) => Some(StressForm::Series),
            (false, true) => Some(StressForm::Straight(STRAIGHT_ERROR)),
            (false, false) => None,
        };
        let listing = history.listing(stress, !self.scene.numbers.is_double())?;
        let info = RunInfo { wide: self.wide, ..info };
        let mut tables = HistoryTables::new(&history, listing, stress, &info);
        if has_outline(&destinations) {
            tables.outline = outline(&history);
        }
        for by in self.derivatives.iter().copied() {
            // There are no more contacts than events: a row has an event, and a contact beside it where there is one.
            let [event, contact] = [Table::Events, Table::Contacts].map(Table::quantities);
            let mut events = history.derivatives(by, &[event, contact].concat())?;
            let contacts = events.iter_mut().map(|row| row.split_off(event.len().min(row.len())));
            let contacts = contacts.filter(|row| !row.is_empty()).collect();
            tables.add_derivatives(by, events, contacts);
        }
        let info = RunInfo { warnings: history.warnings(), ..info };
        drop(progress);
        // A table on the screen has the warnings and the end below it.
        if !destinations.iter().all(Destination::is_printed_table) {
            info.print_warnings();
            note_end(&history, &history.end());
        }
        write_all(&destinations, |format| match format {
            Format::Table if self.legend => Ok(format!("{}\n{LEGEND}", tables.table(&info)).into_bytes()),
            Format::Table => Ok(tables.table(&info).into_bytes()),
            Format::Json => Ok(json_bytes(&tables.json(&info))),
            _ => rows_bytes(&tables.part(self.part.unwrap_or_default(), self.coefficients, &info), format),
        })
    }
}

impl Solve {
    /// Returns the first option that whole chains do not have.
    fn of_a_rod(&self) -> Option<&'static str> {
        let refused = [
            (self.impacts.is_some(), "--impacts"),
            (self.part == Some(HistoryPart::Stress), "--part stress"),
            (self.coefficients, "--coefficients"),
            (self.legend, "--legend"),
        ];
        refused.iter().find(|(given, _)| *given).map(|(_, option)| *option)
    }

    /// Returns whether a chain of one body is answered as a rod.
    fn is_of_rod(&self) -> bool {
        self.of_a_rod().is_some() || !self.derivatives.is_empty()
    }

    /// Solves a scene with several bodies.
    fn chain(&self, mut scene: ChainScene, destinations: &[Destination]) -> Result<(), Failure> {
        if let Some(option) = self.of_a_rod() {
            return Err(failure!("found {option} with a chain, expected it with one of its bodies, --body N"));
        }
        if let Some(to) = &self.to {
            scene.chain = scene.chain.with_until(to.clone())?;
        }
        let numbers = self.scene.numbers.numbers_to(scene.accuracy);
        let parts =
            chain::Parts { csv: self.part.unwrap_or_default(), derivatives: &self.derivatives, wide: self.wide };
        chain::solve(&scene, numbers, &parts, destinations)
    }
}

/// Returns whether the stress is drawn above the table: at a terminal that has more than plain letters.
fn has_outline(destinations: &[Destination]) -> bool {
    destinations.iter().any(Destination::is_printed_table)
        && std::io::stdout().is_terminal()
        && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}
