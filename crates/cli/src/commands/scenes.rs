//! `dalembert scenes`.

use std::path::Path;
use std::process::ExitCode;

use clap::Args;

use crate::args::{OutputArgs, known_formats};
use crate::failure::{Failure, cannot};
use crate::file::{Format, write_all};
use crate::output::{PAGE_DIGITS, benchmarks_page, rows_bytes, targets_data};
use crate::source::{self, AnyScene};
use crate::terminal;
use dalembert::builtin;
use dalembert::solve::Numbers;
use dalembert_compare::aligned::table;
use dalembert_verify::published::PublishedScene;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(
    after_help = "Examples:\n  dalembert scenes ansys-vm265\n  dalembert scenes ansys-vm265 --targets --format json\n  \
    dalembert scenes my_scenes/ --targets\n  dalembert scenes --targets --format markdown\n\nWith --targets the exit code is 1 where a value differs by more than \
    its `within`, or by more than half a unit of its last digit, and its scene does not expect it to."
)]
pub(crate) struct Scenes {
    /// The scene to print; with --targets also a scene file, `-`, or a folder with scene files
    name: Option<String>,
    /// Print the published values of the scene, its [[target]]s, beside ours; without a scene those of all built-in
    /// ones
    #[arg(long)]
    targets: bool,
    #[command(flatten)]
    output: OutputArgs,
    /// Keep each row of a table on one line, however wide
    #[arg(long)]
    wide: bool,
}

impl Scenes {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        if self.targets {
            return self.published();
        }
        if self.output.format.is_some_and(|format| format != Format::Table) {
            return Err(failure!("found --format, expected it with --targets: a list of scenes is a text"));
        }
        let text = match &self.name {
            None => {
                let scenes = builtin::ALL.iter().chain(builtin::CHAINS);
                let rows = scenes.map(|scene| vec![scene.name.to_string(), scene.summary.to_string()]);
                table(&["scene", "what it shows"], rows.collect(), 2) + "\n"
            }
            Some(name) => match builtin::get(name) {
                Some(scene) => scene.source.to_string(),
                None => {
                    let failure = failure!("found no built-in scene called `{name}`");
                    let names = builtin::names().chain(builtin::CHAINS.iter().map(|scene| scene.name));
                    let suggestion = source::nearest(name, names);
                    let suggestion = suggestion.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                    let expected = "expected one of the names that `dalembert scenes` lists";
                    return Err(failure.help(format!("{expected}{suggestion}")));
                }
            },
        };
        write_all(&self.output.destinations(FORMATS)?, |_| Ok(text.clone().into_bytes()))?;
        Ok(ExitCode::SUCCESS)
    }

    /// Writes the published values of a scene, of the scenes in a folder, or of all built-in scenes. The exit code is 1
    /// if one differs that its scene does not expect to.
    fn published(&self) -> Result<ExitCode, Failure> {
        let destinations = self.output.destinations(FORMATS)?;
        // A page shows fractions and proved digits.
        let is_page = destinations.iter().any(|destination| destination.format == Format::Markdown);
        let numbers = if is_page { Numbers::ExactThenDigits(PAGE_DIGITS) } else { Numbers::default() };
        let all = match &self.name {
            None => PublishedScene::builtin(numbers)?,
            Some(name) => {
                let mut all = Vec::new();
                for name in scene_files(name)? {
                    let found = match source::read(&name)? {
                        AnyScene::Rod(scene) => PublishedScene::new(&name, &scene, numbers),
                        AnyScene::Chain(scene) => PublishedScene::of_chain(&name, &scene, numbers),
                    };
                    all.push(found.map_err(|error| failure!("{name}: {error}"))?);
                }
                all
            }
        };
        for published in &all {
            for warning in &published.warnings {
                terminal::warn(format!("{}: {warning}", published.name));
            }
        }
        let data = targets_data(&all, self.wide);
        write_all(&destinations, |format| match format {
            Format::Markdown => Ok(benchmarks_page(&all).into_bytes()),
            format => rows_bytes(&data, format),
        })?;
        let (count, expected) = PublishedScene::count(&all);
        Ok(ExitCode::from(u8::from(expected < count)))
    }
}

const FORMATS: &[Format] = &[Format::Table, Format::Json, Format::Csv, Format::Markdown];

/// Returns the scene itself, or the scene files of a folder in the order of their names.
fn scene_files(name: &str) -> Result<Vec<String>, Failure> {
    if !Path::new(name).is_dir() {
        return Ok(vec![name.to_string()]);
    }
    let entries = std::fs::read_dir(name).map_err(cannot(&format!("read {name}")))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let mut names: Vec<String> = scenes.map(|path| path.display().to_string()).collect();
    names.sort();
    if names.is_empty() {
        return Err(failure!("found no .toml in the folder {name}, expected scene files"));
    }
    Ok(names)
}
