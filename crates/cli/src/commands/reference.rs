//! `dalembert reference`.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::answer::{Visit, noted_end, solve, warned};
use crate::args::NumberArgs;
use crate::args::words;
use crate::failure::{Failure, cannot};
use crate::file::{self, Format, formats};
use crate::output::{Head, Language, Preamble, Rows, code};
use crate::source;
use dalembert::Error;
use dalembert::Scene;
use dalembert::Side;
use dalembert::engine::Motion;
use dalembert::number::{List, Number, Scalar};
use dalembert::quantity::{Needs, Quantity, SLICE, Slice};
use dalembert::solve::{Question, Target, TypedHistory};

#[derive(Args, Debug)]
#[command(after_help = format!("\
    Without times, the rows are the start, every impact and release, and the end. Where a jump passes, a time has two \
    rows, the limits from earlier and from later times.\n\n\
    Columns: {}; the header of a file explains each.\n\n\
    Examples:\n  dalembert reference doyen-ern-piperno --dt 0.001 --to 5 -o golden.csv\n  \
    my_code --print-times | dalembert reference rod.toml --times-from - --columns t,u_end,force\n  \
    dalembert reference rod.toml --times 0..2:5 --points 0..1:101 -o field.npz",
    known()
))]
pub(crate) struct Reference {
    /// A scene file, `-`, or a built-in scene. With times it is followed to the last one, whatever its own run says
    scene: String,
    /// Times: numbers such as 0.3 or 1/3 separated by commas, or A..B:N for N times from A to B
    #[arg(long, value_name = "LIST", value_parser = List::equally_spaced, allow_hyphen_values = true, group = "when")]
    times: Option<List>,
    /// Times from a file, `-` for standard input: one a line, `#` begins a comment
    #[arg(long, value_name = "FILE", group = "when")]
    times_from: Option<PathBuf>,
    /// Times 0, DT, 2 DT … up to --to
    #[arg(long, value_name = "DT", requires = "to", group = "when", allow_hyphen_values = true)]
    dt: Option<Number>,
    /// The last time of --dt
    #[arg(long, value_name = "T", requires = "dt", allow_hyphen_values = true)]
    to: Option<Number>,
    /// The columns, in this order; by default all
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', value_parser = column)]
    columns: Option<Vec<Quantity>>,
    /// The field along the rod instead of the columns, on a grid: points in the same form as --times
    #[arg(long, value_name = "LIST", value_parser = List::equally_spaced, allow_hyphen_values = true)]
    #[arg(conflicts_with = "columns")]
    points: Option<List>,
    /// What the field is on the grid
    #[arg(long, value_parser = words::<Slice>(), default_value_t, requires = "points")]
    field: Slice,
    /// Only this limit where there are two, one row for each time; by default both
    #[arg(long, value_parser = words::<Side>())]
    side: Option<Side>,
    #[command(flatten)]
    numbers: NumberArgs,
    /// What to write; by default what the ending of FILE says, or CSV
    #[arg(long, value_parser = formats(FORMATS))]
    format: Option<Format>,
    /// A CSV without the comments above the names of its columns
    #[arg(long)]
    bare: bool,
    /// Instead of rows: the exact solution of an undamped rod as a function uExact(x, t, d)
    #[arg(long = "as", value_enum, value_name = "LANGUAGE")]
    #[arg(conflicts_with_all = ["when", "columns", "points", "side", "format", "bare"])]
    language: Option<Language>,
    /// Write to this file, whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

const FORMATS: &[Format] = &[Format::Csv, Format::Json, Format::Npz];

fn known() -> String {
    Needs::Time.quantities().map(Quantity::name).collect::<Vec<_>>().join(", ")
}

fn column(name: &str) -> Result<Quantity, String> {
    Needs::Time.named(name.trim()).ok_or_else(|| format!("found no column of this name, expected one of {}", known()))
}

impl Reference {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = source::read(&self.scene)?;
        let numbers = self.numbers.numbers(&scene);
        if let Some(language) = self.language {
            return solve(&scene, &Question::run(numbers), &Function { asked: self, scene: &scene, language });
        }
        let format = Format::of(self.output.as_deref(), self.format, FORMATS)?;
        if self.bare && format != Format::Csv {
            return Err(failure!("found --bare, expected it with CSV only: JSON and NPZ have no comments"));
        }
        let times = self.times()?;
        let columns = match &self.points {
            Some(_) => Vec::new(),
            None => self.columns.clone().unwrap_or_else(|| Needs::Time.quantities().collect()),
        };
        if let Some(twice) = (1..columns.len()).find(|k| columns[..*k].contains(&columns[*k])) {
            return Err(failure!("found the column {} twice, expected each once", columns[twice].name()));
        }
        let question = match times.as_ref().map(|list| (list.least(), list.greatest())) {
            None => Question::run(numbers),
            Some((Some(first), _)) if first.to_f64() < 0.0 => {
                return Err(failure!("found time {first}, expected times from 0 on"));
            }
            // What has happened before the first time is part of these.
            Some((Some(_), Some(last))) if columns.iter().any(|column| column.is_of_past()) => {
                Question::between(0.into(), last, numbers)
            }
            Some((Some(first), Some(last))) => Question::between(first, last, numbers),
            Some(_) => return Err(failure!("found no times, expected at least one")),
        };
        solve(&scene, &question, &Series { asked: self, scene: &scene, format, times, columns })
    }

    /// What the file says of itself, and standard error of what may not be as asked.
    fn preamble<'a, S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        (scene, each, ends): (&'a Scene, &'a str, bool),
    ) -> Preamble<'a> {
        let head = warned(Head { warnings: history.warnings(), ..head }, false);
        let ends = ends.then(|| noted_end(history.ending(), &S::carry(history.end()), head.digits));
        let (numbers, until) = (history.plan().numbers, history.end().to_f64());
        Preamble { head, scene: scene.source(), numbers, each, until, bare: self.bare, ends }
    }

    /// The times that are asked for; `None` for the start, every impact and release, and the end.
    fn times(&self) -> Result<Option<List>, Failure> {
        match (&self.times, &self.times_from, &self.dt, &self.to) {
            (Some(list), ..) => Ok(Some(list.clone())),
            (_, Some(path), ..) => times_of(path).map(Some),
            (_, _, Some(dt), Some(to)) => List::steps(dt, to).map(Some).map_err(|error| failure!("{error}")),
            _ => Ok(None),
        }
    }
}

/// The times of a file, or of standard input for `-`: one a line; empty lines and what follows a `#` do not count.
fn times_of(path: &Path) -> Result<List, Failure> {
    let stdin = path == Path::new("-");
    let name = if stdin { "standard input".to_string() } else { path.display().to_string() };
    let read = || cannot(&format!("read {name}"));
    let opened: Box<dyn Read> =
        if stdin { Box::new(std::io::stdin()) } else { Box::new(File::open(path).map_err(read())?) };
    let mut times = Vec::new();
    for (line, row) in BufReader::new(opened).lines().zip(1..) {
        let line = line.map_err(read())?;
        let text = line.split('#').next().unwrap_or_default().trim_start_matches('\u{feff}').trim();
        let values = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|part| !part.is_empty());
        match values.count() {
            0 if text.is_empty() => continue,
            1 => (),
            count => return Err(failure!("{name}, row {row}: found {count} values, expected one time a line")),
        }
        let time: Number = text.parse().map_err(|error| failure!("{name}, row {row}: {error}"))?;
        if time.to_f64() < 0.0 {
            return Err(failure!("{name}, row {row}: found time {time}, expected times from 0 on"));
        }
        times.push(time);
    }
    if times.is_empty() {
        Err(failure!("{name}: found no times, expected one a line"))
    } else {
        Ok(List::Numbers(times))
    }
}

/// Rows that are asked about at once.
const CHUNK: usize = 1 << 14;

/// Columns over time.
struct Series<'a> {
    asked: &'a Reference,
    scene: &'a Scene,
    format: Format,
    times: Option<List>,
    columns: Vec<Quantity>,
}

/// The start, the events and the end, each once.
fn event_times<S: Scalar>(motion: &dyn Motion<S>) -> Result<Vec<S>, Error> {
    let end = motion.end();
    let mut times = vec![end.zero()];
    for time in motion.events().iter().map(|event| &event.t).chain([&end]) {
        if times.last().map_or(Ok(true), |last| last.below(time))? {
            times.push(time.clone());
        }
    }
    Ok(times)
}

impl Series<'_> {
    /// The rows of a part of the times.
    fn ask<S: Target>(&self, history: &TypedHistory<S>, part: &Range<usize>) -> Result<Vec<Vec<S::Carried>>, Error> {
        let times = |motion: &dyn Motion<S::Carried>| match &self.times {
            Some(list) => Ok(list.lift_part(part.clone(), &motion.end().precision())),
            None => event_times(motion),
        };
        match &self.asked.points {
            None => history.ask_columns(&self.columns, self.asked.side, times),
            Some(points) => history.ask_slices(self.asked.field, self.asked.side, |motion| {
                Ok((points.lift(&motion.end().precision()), times(motion)?))
            }),
        }
    }
}

impl Visit for Series<'_> {
    /// Rows are written while the next ones are asked for.
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure> {
        let described = match &self.asked.points {
            Some(_) => &SLICE[..],
            None => &self.columns,
        };
        let described = described.iter().map(|column| (*column, column.unit(&head.units))).collect();
        let keep = || cannot("keep the rows");
        let mut rows = Rows::new(self.format, described, head.digits).map_err(keep())?;
        let at_once = CHUNK / self.asked.points.as_ref().map_or(1, List::len).min(CHUNK);
        let (mut table, mut written) = (Vec::new(), Ok(()));
        let count = self.times.as_ref().map_or(1, List::len);
        for from in (0..count).step_by(at_once) {
            let (part, mut next) = (from..(from + at_once).min(count), Ok(Vec::new()));
            std::thread::scope(|scope| {
                scope.spawn(|| written = rows.push(&table));
                next = self.ask(history, &part);
            });
            table = next?;
            std::mem::replace(&mut written, Ok(())).map_err(keep())?;
        }
        rows.push(&table).map_err(keep())?;
        drop(progress);
        let preamble = self.asked.preamble(history, head, (self.scene, "each column", self.times.is_none()));
        let path = self.asked.output.as_deref();
        rows.finish(&preamble, path).map_err(file::unwritten(path))
    }
}

struct Function<'a> {
    asked: &'a Reference,
    scene: &'a Scene,
    language: Language,
}

impl Visit for Function<'_> {
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure> {
        let waves = history.ask(|motion| motion.waves(), |waves| waves.numbers())?;
        drop(progress);
        let preamble = self.asked.preamble(history, head, (self.scene, "each coefficient", true));
        let text = code(&waves, &S::carry(history.end()), self.language, &preamble);
        file::write(self.asked.output.as_deref(), text.as_bytes())
    }
}
