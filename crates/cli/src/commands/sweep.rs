//! `dalembert sweep`.

use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::json;

use crate::args::in_threads;
use crate::args::{NumberArgs, quantity};
use crate::failure::{self, Failure};
use crate::file::{self, Format, formats};
use crate::output::sweep_data;
use crate::source;
use crate::sweep::{self, Asked, Axis, Grid, Journal, Point, journal_of};
use dalembert::number::Number;
use dalembert::quantity::{Needs, Quantity};

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  dalembert sweep figure-4-r02 --vary impact.speed=0.05..12.5:500:log \
    --vary rod.damping=0,0.1,0.2,0.3 --quantity bounce_time,e_E2 -o figure-4.csv\n  dalembert sweep rod.toml \
    --vary rod.damping=0..1:1001 --quantity energy --shard 3/8 -o part-3.npz\n\nThe last --vary changes fastest. \
    With -o FILE, finished points are kept in FILE.unfinished until all are;\nafter an interruption, the same command \
    with --resume goes on from there and writes the same bytes.\n\nThe exit code is 1 where no point has a number.")]
pub(crate) struct Sweep {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    /// What is varied: PATH=V1,V2,… or PATH=A..B:N, with :log in geometric progression; several times for a grid.
    /// Values between A and B are the shortest decimals of doubles, as the rows spell them
    #[arg(long, value_name = "PATH=VALUES", required = true, allow_hyphen_values = true)]
    vary: Vec<String>,
    /// What is asked of each point, separated by commas
    #[arg(long, value_parser = quantity(), value_delimiter = ',', required = true)]
    quantity: Vec<Quantity>,
    /// When, for what has a value at every time; by default at the first bounce
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: Option<Number>,
    #[command(flatten)]
    numbers: NumberArgs,
    /// Only the i-th of n consecutive parts of the points, for job arrays
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<[usize; 2]>,
    /// Go on with the sweep that FILE.unfinished holds
    #[arg(long, requires = "output")]
    resume: bool,
    /// How many points are solved at the same time; by default one for each core
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// What to print; by default a table, or what the ending of FILE says
    #[arg(long, value_parser = formats(FORMATS))]
    format: Option<Format>,
    /// Write to this file, whole or not at all: .csv, .json, .npz, or a table
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

const FORMATS: &[Format] = &[Format::Table, Format::Json, Format::Csv, Format::Npz];

/// A part, counted from 1, and how many there are.
fn shard(text: &str) -> Result<[usize; 2], String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some([i.parse().ok()?, n.parse().ok()?]));
    let known = numbers.filter(|[part, parts]| (1..=*parts).contains(part));
    known.ok_or_else(|| format!("found `{text}`, expected I/N such as 3/8, the third of eight parts"))
}

impl Sweep {
    /// The exit code is 1 where no point has a number.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let format = Format::of(self.output.as_deref(), self.format, FORMATS)?;
        let scene = source::read(&self.scene)?;
        let axes = self.vary.iter().map(|text| text.parse::<Axis>()).collect::<Result<Vec<_>, _>>()?;
        if let Some(time) = self.time.as_ref().filter(|time| time.to_f64() < 0.0) {
            return Err(failure!("found time {time}, expected one from 0 on"));
        }
        for (k, quantity) in self.quantity.iter().enumerate() {
            if let Some(time) = self.time.as_ref().filter(|_| quantity.needs() != Needs::Time) {
                let name = quantity.name();
                return Err(failure!("found time {time}, expected none: {name} is not asked at a time"));
            }
            if self.quantity[..k].contains(quantity) {
                return Err(failure!("found {} asked twice, expected each quantity once", quantity.name()));
            }
        }
        let (quantities, time, numbers) = (self.quantity.clone(), self.time.clone(), self.numbers.numbers(&scene));
        let asked = Asked { quantities, time, numbers, units: scene.units };
        let sweep = sweep::Sweep { grid: Grid::new(scene.problem.clone(), axes)?, asked };
        let [part, parts] = self.shard.unwrap_or([1, 1]);
        let start = |part: usize| (sweep.grid.len() as u128 * part as u128 / parts as u128) as usize;
        let points = start(part - 1)..start(part);
        let vary = |axis: &Axis| json!({"path": axis.path, "values": axis.values});
        // All that the points depend on.
        let identity = json!({
            "dalembert": env!("CARGO_PKG_VERSION"),
            "scene": scene.source(),
            "vary": sweep.grid.axes.iter().map(vary).collect::<Vec<_>>(),
            "quantity": sweep.asked.quantities.iter().map(|quantity| quantity.name()).collect::<Vec<_>>(),
            "time": sweep.asked.time,
            "number": sweep.asked.numbers.to_string(),
            "points": [points.start, points.end],
        });
        let path = self.output.as_deref().filter(|path| *path != Path::new("-"));
        let open = |path| Journal::open(path, &identity, self.resume).map_err(|error| unopened(path, error));
        let (journal, known) = path.map(open).transpose()?.unzip();
        let found = self.solve(&sweep, points, known.unwrap_or_default(), journal.as_ref())?;
        let bytes = file::rows(&sweep_data(&sweep, &found, scene.title.as_deref()), format)?;
        file::write(path, &bytes)?;
        if let Some((journal, path)) = journal.zip(path) {
            journal.remove().map_err(failure::cannot(&format!("remove {}", journal_of(path).display())))?;
        }
        let mut cells = found.iter().flat_map(|point| &point.cells);
        let fails = !found.is_empty() && cells.all(|cell| cell.value.is_null());
        Ok(if fails { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    }

    fn solve(
        &self,
        sweep: &sweep::Sweep,
        points: Range<usize>,
        known: Vec<Point>,
        journal: Option<&Journal>,
    ) -> Result<Vec<Point>, Failure> {
        let bar = source::bar(Some(points.len() as u64), "{bar:40} {pos}/{len} points, {eta} left");
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

fn unopened(output: &Path, error: std::io::Error) -> Failure {
    let journal = journal_of(output).display().to_string();
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
