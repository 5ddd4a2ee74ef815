//! `dalembert check`.

use std::process::ExitCode;

use clap::Args;

use crate::args::{OutputArgs, known_formats};
use crate::failure::Failure;
use crate::file::{Format, write_all};
use crate::output::{check_json, check_page, check_summary, check_table, json_bytes};
use crate::{source, terminal};
use dalembert::solve::Numbers;
use dalembert_verify::check::{CATALOGUE, Case, CheckedCase, Group, UnknownName, Verdict, select};
use dalembert_verify::published::PublishedScene;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(after_help = "Examples:\n  dalembert check\n  dalembert check --only late --only figure-4\n  \
    dalembert check --format markdown -o check.md\n\nThe exit code is 1 if any promise is not kept.")]
pub(crate) struct Check {
    /// A case or a group, or `targets` for the published values of the built-in scenes; can be given several times
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Print one line a case, and how many came to each verdict
    #[arg(long, conflicts_with = "format")]
    summary: bool,
    #[command(flatten)]
    output: OutputArgs,
}

/// The name of the published values among the names of groups.
const TARGETS: &str = "targets";

const FORMATS: &[Format] = &[Format::Table, Format::Json, Format::Markdown];

impl Check {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let destinations = self.output.destinations(FORMATS)?;
        let (targets, cases): (Vec<&String>, Vec<&String>) = self.only.iter().partition(|name| *name == TARGETS);
        let is_everything = self.only.is_empty();
        let cases: Vec<String> = cases.into_iter().cloned().collect();
        let groups = if is_everything || !cases.is_empty() { select(&cases) } else { Ok(Vec::new()) };
        let groups = groups.map_err(unknown)?;
        let count = groups.iter().map(|selection| selection.cases.len() as u64).sum();
        let bar = terminal::bar(Some(count), "{bar:40} {pos}/{len}, {msg}");
        let run = |case: &'static Case| {
            bar.set_message(case.name);
            let checked = case.run();
            bar.inc(1);
            checked
        };
        let groups =
            groups.into_iter().map(|selection| (selection.group, selection.cases.into_iter().map(run).collect()));
        let checked: Vec<(Group, Vec<CheckedCase>)> = groups.collect();
        bar.finish_and_clear();
        let published = if is_everything || !targets.is_empty() {
            PublishedScene::builtin(Numbers::default())?
        } else {
            Vec::new()
        };
        write_all(&destinations, |format| {
            Ok(match format {
                Format::Table if self.summary => check_summary(&checked, &published).into_bytes(),
                Format::Table => check_table(&checked, &published).into_bytes(),
                Format::Json => json_bytes(&check_json(&checked, &published)),
                _ => check_page(&checked, &published).into_bytes(),
            })
        })?;
        let has_failed = checked.iter().flat_map(|(_, cases)| cases).any(|case| case.verdict == Verdict::Failed);
        let (count, agreed) = PublishedScene::count(&published);
        Ok(ExitCode::from(u8::from(has_failed || agreed < count)))
    }
}

/// Builds the failure for a name that is neither a group nor a case.
fn unknown(UnknownName(name): UnknownName) -> Failure {
    let groups: Vec<&str> = CATALOGUE.iter().map(|group| group.name).chain([TARGETS]).collect();
    let cases: Vec<&str> = CATALOGUE.iter().flat_map(|group| group.cases).map(|case| case.name).collect();
    let suggestion = source::nearest(&name, groups.iter().chain(&cases).copied());
    let failure =
        failure!("found --only {name}, expected a group ({}) or a case ({})", groups.join(", "), cases.join(", "));
    match suggestion {
        Some(near) => failure.help(format!("did you mean `{near}`?")),
        None => failure,
    }
}
