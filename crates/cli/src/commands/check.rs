//! `dalembert check`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::failure::Failure;
use crate::file::{self, Format, formats};
use crate::output::{check_json, check_page, check_summary, check_table};
use crate::source;
use dalembert_verify::check::{CATALOGUE, Case, CheckedCase, Group, UnknownName, Verdict, select};
use dalembert_verify::published::PublishedScene;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  dalembert check\n  dalembert check --only late --only figure-4\n  \
    dalembert check --format markdown -o check.md\n\nThe exit code is 1 if any promise is not kept.")]
pub(crate) struct Check {
    /// A case or a group, or `targets` for the published values of the built-in scenes; can be given several times
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Print one line a case, and how many came to each verdict
    #[arg(long, conflicts_with = "format")]
    summary: bool,
    /// What to print
    #[arg(long, value_parser = formats(FORMATS), default_value = "table")]
    format: Format,
    /// Write to this file, whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The published values among the names of groups.
const TARGETS: &str = "targets";

const FORMATS: &[Format] = &[Format::Table, Format::Json, Format::Markdown];

impl Check {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let (targets, cases): (Vec<&String>, Vec<&String>) = self.only.iter().partition(|name| *name == TARGETS);
        let everything = self.only.is_empty();
        let cases: Vec<String> = cases.into_iter().cloned().collect();
        let groups = if everything || !cases.is_empty() { select(&cases) } else { Ok(Vec::new()) };
        let groups = groups.map_err(|UnknownName(name)| {
            let groups = CATALOGUE.map(|group| group.name).join(", ") + ", " + TARGETS;
            let cases: Vec<&str> = CATALOGUE.iter().flat_map(|group| group.cases).map(|case| case.name).collect();
            failure!("found --only {name}, expected a group ({groups}) or a case ({})", cases.join(", "))
        })?;
        let count = groups.iter().map(|selection| selection.cases.len() as u64).sum();
        let bar = source::bar(Some(count), "{bar:40} {pos}/{len}, {msg}");
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
        let published = if everything || !targets.is_empty() { PublishedScene::builtin()? } else { Vec::new() };
        let text = match self.format {
            Format::Table if self.summary => check_summary(&checked, &published),
            Format::Table => check_table(&checked, &published),
            Format::Json => format!("{:#}\n", check_json(&checked, &published)),
            _ => check_page(&checked, &published),
        };
        file::write(self.output.as_deref(), text.as_bytes())?;
        let failed = checked.iter().flat_map(|(_, cases)| cases).any(|case| case.verdict == Verdict::Failed);
        let (count, agreed) = PublishedScene::count(&published);
        let failed = failed || agreed < count;
        Ok(if failed { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }
}
