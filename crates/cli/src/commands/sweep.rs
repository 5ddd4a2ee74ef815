//! `dalembert sweep`.

use std::io::ErrorKind;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;

use clap::Args;
use serde_json::json;

use crate::args::{SceneArgs, in_threads, known_formats};
use crate::failure::{self, Failure};
use crate::file::{Format, write_all};
use crate::output::{rows_bytes, sweep_data};
use crate::quantities::{NameParser, Scope, has_material, is_of_chain, unknown};
use crate::source::AnyScene;
use crate::sweep::{self, Axis, Grid, Journal, Point, Request, Subject, journal_path};
use crate::terminal;
use dalembert::chain::ChainQuery;
use dalembert::number::Number;
use dalembert::problem::Parameter;
use dalembert::{ChainScene, Scene};
use dalembert_verify::regimes::GridError;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(after_help = "Examples:\n  dalembert sweep figure-4-r02 --vary impact.speed=0.05..12.5:500:log \
    --vary rod.damping=0,0.1,0.2,0.3 --quantity bounce_time,e_E2 -o figure-4.csv\n  dalembert sweep rod.toml \
    --vary rod.damping=0..1:1001 --quantity energy --shard 3/8 -o part-3.npz\n\nThe last --vary changes fastest. \
    With -o FILE, finished points are kept in FILE.unfinished until all are;\nafter an interruption, the same command \
    with --resume goes on from there and writes the same bytes.\n\nThe exit code is 1 where no point has a number.")]
pub(crate) struct Sweep {
    #[command(flatten)]
    scene: SceneArgs,
    /// A value to vary: PATH=V1,V2,… or PATH=A..B:N, with :log in geometric progression; several times for a grid.
    /// Of a chain also values of bodies and joints, such as body.2.mass and joint.1.gap.
    /// Values between A and B are the shortest decimals of doubles, as the rows spell them
    #[arg(long, value_name = "PATH=VALUES", required = true, allow_hyphen_values = true)]
    vary: Vec<String>,
    /// Quantities of each point and groups of them, separated by commas. Of a whole chain they have a place: u_top.2 of
    /// the second body, force.bottom, and of the first contact of the joint above the first body impact.1, release.1,
    /// impulse.1, peak_force.1
    #[arg(long, visible_alias = "columns", value_name = "LIST", value_delimiter = ',', required = true)]
    #[arg(value_parser = NameParser::new(&[Scope::SingleNumber], []).open())]
    quantity: Vec<String>,
    /// The time of quantities over time; by default the first bounce of a rod, the end of the run of a whole chain
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: Option<Number>,
    /// Only the i-th of n consecutive parts of the points, for job arrays
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<[usize; 2]>,
    /// Go on with the sweep that FILE.unfinished holds
    #[arg(long, requires = "output")]
    resume: bool,
    /// Number of threads; by default one for each core
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

const FORMATS: &[Format] = &[Format::Table, Format::Json, Format::Csv, Format::Npz];

/// Parses the number of a part, counted from 1, and the number of parts.
fn shard(text: &str) -> Result<[usize; 2], String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some([i.parse().ok()?, n.parse().ok()?]));
    let known = numbers.filter(|[part, parts]| (1..=*parts).contains(part));
    known.ok_or_else(|| format!("found `{text}`, expected I/N such as 3/8, the third of eight parts"))
}

/// Parses an axis. An error shows the grammar, or the nearest path.
fn axis(text: &str) -> Result<Axis, Failure> {
    let grammar = "--vary is PATH=V1,V2,…, PATH=A..B:N for N values from A to B, or PATH=A..B:N:log";
    text.parse().map_err(|error| match &error {
        // The message names the nearest path.
        GridError::UnknownPath(_) => Failure::from(error),
        _ => Failure::from(error).help(grammar),
    })
}

impl Sweep {
    /// Solves all points and writes them. The exit code is 1 if no point has a number.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let destinations = self.scene.output.destinations(FORMATS)?;
        let axes = self.vary.iter().map(|text| axis(text)).collect::<Result<Vec<_>, _>>()?;
        let whole = self.quantity.iter().any(|name| is_of_chain(name));
        let scene = match self.scene.body.read_any(&self.scene.scene)? {
            AnyScene::Chain(scene) if whole => AnyScene::Chain(scene),
            scene => AnyScene::Rod(Box::new(scene.into_rod(&self.scene.scene, None)?)),
        };
        let (title, source, accuracy) = match &scene {
            AnyScene::Rod(scene) => (scene.title.clone(), scene.source().to_string(), scene.accuracy),
            AnyScene::Chain(scene) => (scene.title.clone(), scene.source().to_string(), scene.accuracy),
        };
        let subject = match scene {
            AnyScene::Rod(scene) => self.of_rod(&scene, &axes)?,
            AnyScene::Chain(scene) => self.of_chain(scene, &axes)?,
        };
        let numbers = self.scene.numbers.numbers_to(accuracy);
        let request = Request { time: self.time.clone(), numbers };
        let sweep = sweep::Sweep { grid: Grid::new(axes)?, subject, request };
        let [part, parts] = self.shard.unwrap_or([1, 1]);
        let start = |part: usize| (sweep.grid.len() as u128 * part as u128 / parts as u128) as usize;
        let points = start(part - 1)..start(part);
        let vary = |axis: &Axis| json!({"path": axis.parameter.full_path(), "values": axis.values});
        // Everything that the points depend on.
        let identity = json!({
            "dalembert": env!("CARGO_PKG_VERSION"),
            "scene": source,
            "vary": sweep.grid.axes.iter().map(vary).collect::<Vec<_>>(),
            "quantity": sweep.units().into_iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "time": self.time,
            "number": numbers.to_string(),
            "points": [points.start, points.end],
        });
        let path = destinations.iter().find_map(|destination| destination.path.as_deref());
        let open = |path| Journal::open(path, &identity, self.resume).map_err(|error| unopened(path, error));
        let (journal, known) = path.map(open).transpose()?.unzip();
        let found = self.solve(&sweep, points, known.unwrap_or_default(), journal.as_ref())?;
        let data = sweep_data(&sweep, &found, title.as_deref());
        write_all(&destinations, |format| rows_bytes(&data, format))?;
        if let Some((journal, path)) = journal.zip(path) {
            journal.remove().map_err(failure::cannot(&format!("remove {}", journal_path(path).display())))?;
        }
        let mut numbers = found.iter().flat_map(|point| &point.numbers);
        let fails = !found.is_empty() && numbers.all(|number| number.value.is_null());
        Ok(ExitCode::from(u8::from(fails)))
    }

    /// Returns the numbers that are asked for at each point of a rod or a body of a chain.
    fn of_rod(&self, scene: &Scene, axes: &[Axis]) -> Result<Subject, Failure> {
        // A value that the chain does not have would make every point a row without a number.
        let absent = |axis: &&Axis| {
            matches!(axis.parameter, Parameter::OfChain(_)) && axis.parameter.value(&scene.problem).is_none()
        };
        if let Some((axis, value)) = axes.iter().find(absent).and_then(|axis| Some((axis, axis.values.first()?))) {
            scene.problem.to_builder().set(axis.parameter, value).build()?;
        }
        let quantities = Scope::SingleNumber.resolve(&self.quantity, has_material(scene))?;
        sweep::check_time(&quantities, self.time.as_ref())?;
        Ok(Subject::Rod { start: Box::new(scene.problem.clone()), units: scene.units, quantities })
    }

    /// Returns the numbers that are asked for at each point of a whole chain.
    fn of_chain(&self, scene: Box<ChainScene>, axes: &[Axis]) -> Result<Subject, Failure> {
        // A value that the chain does not have would make every point a row without a number.
        let chain = &scene.chain;
        axes.iter().try_for_each(|axis| chain.number(axis.parameter).map(|_| ()))?;
        let read = |name: &String| {
            let query = ChainQuery::read(name, chain).map(|query| (name.clone(), query));
            query.ok_or_else(|| unknown(name, " of a chain", &ChainQuery::names(chain)))
        };
        let quantities = self.quantity.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        sweep::check_time(&[], self.time.as_ref())?;
        Ok(Subject::Chain { scene, quantities })
    }

    fn solve(
        &self,
        sweep: &sweep::Sweep,
        points: Range<usize>,
        known: Vec<Point>,
        journal: Option<&Journal>,
    ) -> Result<Vec<Point>, Failure> {
        let bar = terminal::bar(Some(points.len() as u64), "{bar:40} {pos}/{len} points{left}");
        bar.inc(known.len() as u64);
        bar.reset_eta();
        let done = |point: &Point| {
            bar.inc(1);
            journal.map_or(Ok(()), |journal| journal.add(point))
        };
        let found = in_threads(self.threads, || sweep.run(points, known, &done))?;
        bar.finish_and_clear();
        found.map_err(failure::cannot("keep finished points"))
    }
}

/// Builds the failure for a journal that cannot be opened.
fn unopened(output: &Path, error: std::io::Error) -> Failure {
    let journal = journal_path(output).display().to_string();
    match error.kind() {
        ErrorKind::AlreadyExists => failure!(
            "found {journal}, which an interrupted sweep left, expected --resume to go on with it, or the file removed"
        ),
        ErrorKind::InvalidData => {
            failure!("found {journal} of another sweep, expected the same command, or the file removed")
        }
        _ => failure::cannot(&format!("write {journal}"))(error),
    }
}
