//! `dalembert compare`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::args::{BodyArgs, OutputArgs, known_formats};
use crate::failure::Failure;
use crate::file::{self, Destination, Format, ROWS, ROWS_OR_PICTURE, write_all, write_with_rows};
use crate::output::{compare_data, compare_svg, json_bytes, rows_bytes};
use crate::progress::Progress;
use crate::terminal;
use dalembert::quantity::Units;
use dalembert_compare::data::Source;
use dalembert_compare::{CompareError, LEGEND, Limit, Options, Outcome, Prepared};
use dalembert_plot::draw::Size;

const EXAMPLES: &str = "Examples:\n  dalembert compare doyen-ern-piperno run.csv\n  \
    dalembert compare rod.toml run.dat --map t=0,u=1,v=2,force=3 -o run.svg\n  \
    dalembert compare rod.toml coarse.npz fine.npz --fail-above u.l2=0.01,force.l1=0.05\n\n\
    Quantities are called as in `dalembert reference`; u and v are short for u_end and v_end. With a column x, u, v, \
    strain and stress are those at the point x. Two rows at one time are the limits at a jump, as `reference` writes \
    them; a column side (left, right, both) says which. A unit in a name, as in `force [kN]`, is brought to that of \
    the scene. A CSV has every sample; beside a picture the table is printed as well. The exit code is 1 where a bound fails; with any bound, data \
    that end before the run of the scene do, or before --to, fail.";

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(ROWS)))]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\nWords of the report:\n{LEGEND}"))]
pub(crate) struct Compare {
    /// A scene file, `-`, or a built-in scene; it is followed as far as the data go
    scene: String,
    #[command(flatten)]
    body: BodyArgs,
    /// Data: text with columns, .npy, .npz, or a folder with a .npy for each quantity; `-` is standard input. Several
    /// show the order of convergence
    #[arg(required = true)]
    data: Vec<PathBuf>,
    #[command(flatten)]
    options: Options,
    /// Exit with code 1 where something is above a bound: u.l2=0.1 (of l1, l2, linf, linf_off_jumps, relative to ours),
    /// energy=0.02 and impulse=0.05 (relative), momentum, penetration, tension, missed=0, invented=0
    #[arg(long, value_name = "NAME=BOUND,…", value_delimiter = ',')]
    fail_above: Vec<Limit>,
    /// Exit with code 1 where something is below a bound: order.u=0.9 or order.force.l1=0.4 of several files,
    /// coverage=0.99
    #[arg(long, value_name = "NAME=BOUND,…", value_delimiter = ',')]
    fail_below: Vec<Limit>,
    /// Bounds in a file: tables [above] and [below] of names such as "u.l2" with their bounds
    #[arg(long, value_name = "FILE")]
    gates: Option<PathBuf>,
    /// Write the outcome of every bound as JUnit's XML, whole or not at all
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

const BOUNDS: &str = "--fail-above NAME=BOUND and --fail-below NAME=BOUND, or a file of --gates";

#[derive(Debug, Default, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Gates {
    above: BTreeMap<String, f64>,
    below: BTreeMap<String, f64>,
}

/// Returns JUnit's XML, with a test for every bound.
fn junit(outcomes: &[Outcome]) -> String {
    let escaped =
        |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    let failures = outcomes.iter().filter(|outcome| outcome.failure.is_some()).count();
    let count = outcomes.len();
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"dalembert compare\" tests=\"{count}\" \
         failures=\"{failures}\">\n"
    );
    for outcome in outcomes {
        let (file, name) = (escaped(&outcome.file), escaped(&outcome.expected));
        let failure = |found: &String| format!("<failure message=\"found {}\"/>", escaped(found));
        let body = outcome.failure.as_ref().map_or_else(String::new, failure);
        out += &format!("  <testcase classname=\"{file}\" name=\"{name}\">{body}</testcase>\n");
    }
    out + "</testsuite>\n"
}

impl Compare {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let destinations = self.destinations()?;
        let scene = self.body.read(&self.scene)?;
        let limits = self.limits()?;
        let sources = self.data.iter().map(|path| Source::open(path)).collect::<Result<Vec<_>, _>>()?;
        let units = Units::new(&scene.problem, scene.units);
        let prepared =
            Prepared::new(&scene.problem, &units, scene.accuracy, sources, &self.options).map_err(with_flag)?;
        let progress = Progress::new(&scene, &prepared.plan);
        let comparison = prepared.compare(progress.observer()).map_err(with_flag)?;
        drop(progress);
        comparison.warnings.iter().for_each(terminal::warn);
        let (title, first) = (scene.title.as_deref(), &comparison.files[0]);
        let bytes = |format| match format {
            Format::Json => Ok(json_bytes(&comparison.json(title, &units))),
            Format::Csv => rows_bytes(&compare_data(first), format),
            Format::Table => Ok(comparison.table(title, &units).into_bytes()),
            picture => file::picture(picture, compare_svg(first, title, &units), Size::Page),
        };
        // Before anything is written.
        let outcomes = comparison.outcomes(&limits).map_err(|error| failure!("{error}").help(BOUNDS))?;
        write_with_rows(destinations, self.output.format, bytes)?;
        if let Some(path) = &self.junit {
            let destination = Destination { path: Some(path.clone()), format: Format::Table };
            write_all(&[destination], |_| Ok(junit(&outcomes).into_bytes()))?;
        }
        let failures: Vec<&Outcome> = outcomes.iter().filter(|outcome| outcome.failure.is_some()).collect();
        for failure in &failures {
            eprintln!("failed: {failure}");
        }
        Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// Returns the bounds of the command line and of the file.
    fn limits(&self) -> Result<Vec<Limit>, Failure> {
        let mut limits = self.fail_above.clone();
        limits.extend(self.fail_below.iter().cloned().map(Limit::into_minimum));
        let Some(path) = &self.gates else { return Ok(limits) };
        let shown = path.display();
        let text = std::fs::read_to_string(path).map_err(|error| failure!("{shown}: cannot be read: {error}"))?;
        let gates: Gates = toml::from_str(&text).map_err(|error| failure!("{shown}: {}", error.to_string().trim()))?;
        for (bounds, below) in [(gates.above, false), (gates.below, true)] {
            for (name, bound) in bounds {
                let limit = Limit::new(&name, bound).map_err(|error| failure!("{shown}: {error}"))?;
                limits.push(if below { limit.into_minimum() } else { limit });
            }
        }
        Ok(limits)
    }

    /// Returns where the output goes. Several files of data are refused for a picture or CSV.
    fn destinations(&self) -> Result<Vec<Destination>, Failure> {
        let destinations = self.output.destinations(ROWS_OR_PICTURE)?;
        let is_of_one = |format: Format| !matches!(format, Format::Table | Format::Json);
        if self.data.len() > 1
            && let Some(destination) = destinations.iter().find(|destination| is_of_one(destination.format))
        {
            let path = destination.path.as_ref().map_or("--format csv".into(), |path| path.display().to_string());
            return Err(failure!("found {path} with several files of data, expected one for a picture or CSV"));
        }
        if self.data.iter().filter(|path| *path == Path::new("-")).count() + usize::from(self.scene == "-") > 1 {
            return Err(failure!("found `-` twice, expected standard input to be read once"));
        }
        Ok(destinations)
    }
}

/// Builds the failure with the option that mends it.
fn with_flag(error: CompareError) -> Failure {
    let key = error.key();
    let failure = Failure::from(error);
    match key {
        Some("map") => failure.help("--map NAME=COLUMN,… says which column is what"),
        Some(key) => failure.help(format!("see --{}", key.replace('_', "-"))),
        None => failure,
    }
}
