//! `dalembert compare`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::{Value, json};

use crate::args::{BodyArgs, OutputArgs, known_formats};
use crate::failure::Failure;
use crate::file::{self, Destination, Format, ROWS, ROWS_OR_PICTURE, write_all, write_with_rows};
use crate::output::{compare_data, compare_svg, json_bytes, rows_bytes};
use crate::progress::Progress;
use crate::source::{self, AnyScene};
use crate::terminal;
use dalembert::quantity::Units;
use dalembert::{ChainScene, Scene};
use dalembert_compare::data::Source;
use dalembert_compare::{
    Bar, BodiesReport, BodyReport, CompareError, Comparison, LEGEND, Limit, Options, Outcome, Prepared,
};
use dalembert_plot::draw::Size;

const EXAMPLES: &str = "Examples:\n  dalembert compare doyen-ern-piperno run.csv\n  \
    dalembert compare rod.toml run.dat --map t=0,u=1,v=2,force=3 -o run.svg\n  \
    dalembert compare rod.toml coarse.npz fine.npz --fail-above u.l2=0.01,force.l1=0.05\n\n\
    Quantities are called as in `dalembert reference`; u and v are short for u_end and v_end. With a column x, u, v, \
    strain and stress are those at the point x. Two rows at one time are the limits at a jump, as `reference` writes \
    them; a column side (left, right, both) says which. A unit in a name, as in `force [kN]`, is brought to that of \
    the scene. Among several bodies each column has the number of its body, or its joint, as those of `sample` do: \
    u_end.2, force.1. A CSV has every sample; beside a picture the table is printed as well. The exit code is 1 where a \
    bound fails; with any bound, data that end before the run of the scene do, or before --to, fail.";

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

/// A rod, or one of several bars of a chain, beside its data.
struct Compared<'a> {
    /// One of several bars.
    bar: Option<Bar<'a>>,
    /// The title of the scene of all bars.
    title: Option<String>,
    scene: Scene,
    comparison: Comparison,
    /// The bounds by the names of a rod; `None` where one is of another bar.
    limits: Vec<Option<Limit>>,
}

impl Compared<'_> {
    /// Returns the report of one of several bars.
    fn report(&self) -> Option<BodyReport<'_>> {
        self.bar.map(|Bar { chain, body }| self.comparison.of_body(body + 1, chain.bodies()[body].name()))
    }
}

/// Returns the report of a rod, or of several bars.
fn json(compared: &[Compared<'_>]) -> Value {
    let title = compared[0].title.as_deref();
    match compared {
        [Compared { bar: None, comparison, .. }] => comparison.json(title),
        several => json!(BodiesReport::new(title, several.iter().filter_map(Compared::report).collect())),
    }
}

/// Checks the `limits` of each bar that has what they bound.
///
/// **Errors**: a bound of something that no bar has.
fn outcomes(compared: &[Compared<'_>], limits: &[Limit]) -> Result<Vec<Outcome>, Failure> {
    let mut held = vec![Vec::new(); compared.len()];
    for (k, limit) in limits.iter().enumerate() {
        let (mut is_known, mut refused) = (false, None);
        for (one, held) in compared.iter().zip(&mut held) {
            let Some(own) = &one.limits[k] else { continue };
            match one.comparison.outcomes(std::slice::from_ref(own)) {
                Ok(_) => {
                    is_known = true;
                    held.push(own.clone());
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        if !is_known {
            let other = || format!("found the bound {limit}, expected one of a body or joint that has data");
            let text = refused.map_or_else(other, |error| error.to_string());
            return Err(failure!("{text}").help(BOUNDS));
        }
    }
    let mut all = Vec::new();
    for (one, held) in compared.iter().zip(held) {
        let found = one.comparison.outcomes(&held).map_err(|error| failure!("{error}").help(BOUNDS))?;
        all.extend(found.into_iter().map(|outcome| match one.bar {
            Some(Bar { body, .. }) => Outcome { file: format!("{}, body {}", outcome.file, body + 1), ..outcome },
            None => outcome,
        }));
    }
    Ok(all)
}

impl Compare {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let destinations = self.destinations()?;
        let limits = self.limits()?;
        let scene = source::read(&self.scene)?;
        let chain = match &scene {
            AnyScene::Chain(scene) if scene.chain.bodies().len() > 1 => Some(scene.clone()),
            _ => None,
        };
        let compared = match &chain {
            Some(chain) => {
                if let Some(body) = self.body.number() {
                    // Refuses a body that is not there.
                    scene.into_rod(&self.scene, Some(body))?;
                }
                self.compare_bars(chain, &limits, &destinations)?
            }
            None => {
                // The columns of a chain of one body may have its number.
                let chain = if let AnyScene::Chain(scene) = &scene { Some(scene.chain.clone()) } else { None };
                let scene = scene.into_rod(&self.scene, self.body.number())?;
                let named = |source: Source| match &chain {
                    Some(chain) => Bar { chain, body: 0 }.source(source, &self.options),
                    None => source,
                };
                let sources = self.data.iter().map(|path| Ok::<_, Failure>(named(Source::open(path)?)));
                let sources = sources.collect::<Result<Vec<_>, _>>()?;
                vec![self.compare_rod((None, scene.title.clone()), scene, sources, &limits)?]
            }
        };
        let bytes = |format| match format {
            Format::Json => Ok(json_bytes(&json(&compared))),
            Format::Csv => {
                let files = compared.iter().map(|one| (one.bar, &one.comparison.files[0]));
                rows_bytes(&compare_data(&files.collect::<Vec<_>>()), format)
            }
            Format::Table => {
                let table = |one: &Compared<'_>| one.comparison.table(one.scene.title.as_deref());
                Ok(compared.iter().map(table).collect::<Vec<_>>().join("\n").into_bytes())
            }
            picture => {
                let Compared { comparison: Comparison { files, units, .. }, scene, .. } = &compared[0];
                file::picture(picture, compare_svg(&files[0], scene.title.as_deref(), units), Size::Page)
            }
        };
        // Before anything is written.
        let outcomes = outcomes(&compared, &limits)?;
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

    /// Compares the chosen bar of a chain, or each bar that the data have columns of.
    fn compare_bars<'a>(
        &self,
        scene: &'a ChainScene,
        limits: &[Limit],
        destinations: &[Destination],
    ) -> Result<Vec<Compared<'a>>, Failure> {
        let chain = &scene.chain;
        let open = || self.data.iter().map(|path| Source::open(path)).collect::<Result<Vec<_>, _>>();
        let mut opened = Some(open()?);
        let first = opened.iter().flatten().next();
        let bars = match self.body.number() {
            Some(body) => vec![Bar { chain, body: body - 1 }],
            None => first.map_or_else(Vec::new, |first| Bar::of(chain, first, &self.options)),
        };
        let (count, chosen) = (chain.bodies().len(), self.body.number().is_some());
        let choose = format!("--body N, from 1, the lowest, to {count}, takes the columns for those of one body");
        if bars.is_empty() {
            let expected = "columns with the number of a bar or the name of a joint, such as u_end.2 and force.1";
            let failure = failure!("found {count} bodies in `{}`, expected {expected}", self.scene);
            return Err(failure.help(choose));
        }
        if !chosen {
            let picture =
                destinations.iter().find(|to| !matches!(to.format, Format::Table | Format::Json | Format::Csv));
            let refused = picture.map(|_| "a picture").or((!self.options.fit.is_empty()).then_some("--fit"));
            if let Some(refused) = refused {
                return Err(failure!("found {refused} of all bodies, expected one body").help(choose));
            }
            if bars.len() > 1 && self.data.iter().any(|path| path == Path::new("-")) {
                let expected = "a file, which is read once for each";
                return Err(failure!("found `-` with data of {} bodies, expected {expected}", bars.len()).help(choose));
            }
            let unnumbered = first.filter(|_| self.options.map.is_none()).map_or_else(Vec::new, Bar::of_any);
            if let Some(name) = unnumbered.first() {
                let expected = "the number of its body or the name of its joint, as the others have";
                return Err(failure!("found the column {name} of a chain, expected {expected}").help(choose));
            }
            let others = first.map_or_else(Vec::new, |first| Bar::of_none(chain, first)).join(", ");
            if !others.is_empty() {
                terminal::warn(format!("not compared: {others}; `sample` has the exact values"));
            }
        }
        let compare = |bar: Bar<'a>| {
            let sources = opened.take().map_or_else(open, Ok)?;
            let sources = sources.into_iter().map(|source| bar.source(source, &self.options)).collect();
            let one = scene.body(bar.body)?;
            let title = if chosen { one.title.clone() } else { scene.title.clone() };
            let compared = self.compare_rod((Some(bar), title), one, sources, limits)?;
            Ok(Compared { bar: (!chosen).then_some(bar), ..compared })
        };
        bars.into_iter().map(compare).collect()
    }

    /// Compares one rod, or one bar of a chain.
    fn compare_rod<'a>(
        &self,
        (bar, title): (Option<Bar<'_>>, Option<String>),
        scene: Scene,
        sources: Vec<Source>,
        limits: &[Limit],
    ) -> Result<Compared<'a>, Failure> {
        let units = Units::new(&scene.problem, scene.units);
        let options = bar.map_or_else(|| self.options.clone(), |bar| bar.options(&self.options));
        let prepared = Prepared::new(&scene.problem, &units, scene.accuracy, sources, &options).map_err(with_flag)?;
        let progress = Progress::new(&scene, &prepared.plan);
        let comparison = prepared.compare(progress.observer()).map_err(with_flag)?;
        drop(progress);
        comparison.warnings.iter().for_each(terminal::warn);
        let own = |limit: &Limit| bar.map_or_else(|| Some(limit.clone()), |bar| bar.limit(limit));
        let limits = limits.iter().map(own).collect();
        Ok(Compared { bar: None, title, scene, comparison, limits })
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
