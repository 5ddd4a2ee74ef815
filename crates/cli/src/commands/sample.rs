//! `dalembert sample`, and `dalembert reference`: the same with the defaults of a golden file, and functions.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;

use super::chain_rows::ChainRows;
use crate::answer::{Answer, solve};
use crate::args::{SceneArgs, each_once, known_formats, list, words};
use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format, write_all};
use crate::output::{
    Cell, Column, Header, Language, Layout, RowWriter, RunInfo, code, derivative_rows, derivative_table,
};
use crate::quantities::{NameParser, Scope, has_material, is_of_chain};
use crate::source::AnyScene;
use crate::terminal;
use dalembert::number::{List, Number};
use dalembert::problem::Parameter;
use dalembert::quantity::{Quantity, SLICE, Slice};
use dalembert::solve::{Derivatives, History, Places, Question};
use dalembert::{ChainScene, Ending, Error, Scene, Side, Value};

#[derive(Args, Debug)]
#[command(after_help = "Without times, the rows are the start, every impact and release, and the end.\n\n\
    Examples:\n  dalembert sample paper-strong --quantity strain --times 0.3,1.2,2 --side left\n  \
    dalembert sample doyen-ern-piperno --quantity end,energy --times 0..16/3:9 --exact\n  \
    dalembert sample paper-weak --quantity field --times 1/3 --points 0.25,0.9\n  \
    dalembert sample figure-4-r02 --quantity strain --times 0.1,0.3 --derivatives impact_speed,damping\n  \
    dalembert sample rod.toml --quantity u_end,force --dt 0.001 --to 5 -o values.npz")]
pub(crate) struct Sample {
    #[command(flatten)]
    args: SampleArgs,
}

#[derive(Args, Debug)]
#[command(after_help = "The same as `dalembert sample`, with the defaults of a golden file: CSV, all quantities, and \
    both limits where a jump passes.\n\n\
    Examples:\n  dalembert reference doyen-ern-piperno --dt 0.001 --to 5 -o golden.csv\n  \
    my_code --print-times | dalembert reference rod.toml --times-from - --quantity t,u_end,force\n  \
    dalembert reference rod.toml --times 0..2:5 --points 0..1:101 -o field.npz\n  \
    dalembert reference getfem-dynamic-contact --as python -o golden.py")]
pub(crate) struct Reference {
    #[command(flatten)]
    args: SampleArgs,
    /// Instead of rows: the exact solution of an undamped rod as a function uExact(x, t, d)
    #[arg(long = "as", value_enum, value_name = "LANGUAGE")]
    #[arg(conflicts_with_all = ["when", "quantity", "points", "side", "derivatives", "uncertainty", "format", "bare"])]
    language: Option<Language>,
}

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
pub(super) struct SampleArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Quantities and groups of them, separated by commas. Unless `t` is among them, `t` and `side` come first; a
    /// golden file has the columns as they are listed, by default all. Of a chain they are u_top.2 of the second body,
    /// force.bottom, force.1 of the joint above the first body, force.top, and so on; `gap` stands for all gaps,
    /// `end.2` for a group of one body, chain_energy and chain_momentum for sums over all bodies; by default all
    #[arg(long, visible_alias = "columns", value_name = "LIST", value_delimiter = ',')]
    #[arg(value_parser = NameParser::new(&[Scope::OverTime, Scope::AlongRod], []).open())]
    pub(super) quantity: Vec<String>,
    /// Times: numbers such as 0.3 or 1/3 separated by commas, or A..B:N for N times from A to B. The scene is followed
    /// to the last of them, whatever its own run says
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true, group = "when")]
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
    /// Points along the rod, in the same form as --times: the rows are the field there. With `field` the default is
    /// both ends and the middle. Of a chain they count from the lower end of each body: u.2, v.2, strain.2
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true)]
    pub(super) points: Option<List>,
    /// Meaning of the field on the grid of the points
    #[arg(long, value_parser = words::<Slice>(), default_value_t, requires = "points")]
    field: Slice,
    /// Limit where a jump passes: from earlier times, from later ones, or both in two rows; right by default, both in a
    /// golden file
    #[arg(long, value_enum)]
    side: Option<SideArg>,
    /// Derivatives of the values by values of the scene, as with solve; time and point stay where they are
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Parameter::differentiable)]
    pub(super) derivatives: Vec<Parameter>,
    /// Add the bound of the error of each value, in a column NAME_uncertainty beside each column
    #[arg(long)]
    pub(super) uncertainty: bool,
    /// Keep each row of a table on one line, however wide
    #[arg(long)]
    pub(super) wide: bool,
    /// Leave out the comments above a CSV, and digits beyond their bound where there is no column of bounds
    #[arg(long)]
    pub(super) bare: bool,
}

/// The formats of values over time; those of a golden file begin with CSV.
const FORMATS: &[Format] = &[Format::Table, Format::Csv, Format::Json, Format::Npz];
const GOLDEN_FORMATS: &[Format] = &[Format::Csv, Format::Json, Format::Npz, Format::Table];

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum SideArg {
    /// The limit from earlier times
    Left,
    /// The limit from later times
    Right,
    /// Two rows where the limits differ, the limit from earlier times first
    Both,
}

impl Sample {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        self.args.run(false)
    }
}

impl Reference {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let Some(language) = self.language else { return self.args.run(true) };
        let (scene, numbers) = self.args.scene.read()?;
        let question = Question::run(numbers);
        let destinations = self.args.scene.output.destinations_in(Some(Format::Table), FORMATS)?;
        let Answer { history, info, progress } = solve(&scene, &question)?;
        let info = RunInfo { warnings: history.warnings(), ..info };
        progress.suspend(|| info.print_warnings());
        let header = Header::new(&history, info, scene.source(), "each coefficient", true);
        let text = code(&history, language, &header)?;
        drop(progress);
        write_all(&destinations, |_| Ok(text.clone().into_bytes()))
    }
}

impl SampleArgs {
    fn run(&self, is_golden: bool) -> Result<(), Failure> {
        let scene = match self.scene.body.read_any(&self.scene.scene)? {
            AnyScene::Rod(scene) => *scene,
            // One body is a rod, unless its two ends are told apart.
            AnyScene::Chain(scene) if scene.chain.bodies().len() == 1 && self.are_of_rod(is_golden) => scene.body(0)?,
            AnyScene::Chain(scene) => return self.chain(&scene, is_golden),
        };
        let numbers = self.scene.numbers.numbers_to(scene.accuracy);
        let destinations = self.destinations(is_golden)?;
        let times = self.times()?;
        let mut points = self.points.clone();
        if points.is_none() && self.quantity.iter().any(|name| name == "field") {
            points = Some(List::Range(0.into(), scene.problem.length().clone(), 3));
        }
        let quantities = self.quantities(&scene, points.is_some(), is_golden)?;
        let side = self.side(is_golden);
        self.check_derivatives(&times, side)?;
        let question = match times.as_ref().map(|list| (list.least(), list.greatest())) {
            None => Question::run(numbers),
            // The history before the first time is part of these.
            Some((Some(_), Some(last))) if quantities.iter().any(|quantity| quantity.is_of_past()) => {
                Question::between(0.into(), last, numbers)
            }
            Some((Some(first), Some(last))) => Question::between(first, last, numbers),
            Some(_) => return Err(failure!("found no times, expected at least one")),
        };
        let rows = Rows { args: self, scene: &scene, times, points, quantities, side };
        rows.write(solve(&scene, &question)?, &destinations)
    }

    /// Refuses derivatives without times or with both limits, and those by one value twice.
    fn check_derivatives(&self, times: &Option<List>, side: Option<Side>) -> Result<(), Failure> {
        if !self.derivatives.is_empty() && (times.is_none() || side.is_none() || self.field != Slice::Points) {
            return Err(failure!("found --derivatives, expected them with times, one side, and no --field"));
        }
        each_once(&self.derivatives)
    }

    /// Returns whether the quantities are those of a rod, and not of the joints and bodies of a chain.
    fn are_of_rod(&self, is_golden: bool) -> bool {
        let has_place = self.quantity.iter().any(|name| is_of_chain(name));
        !has_place && (is_golden || !self.quantity.is_empty())
    }

    fn destinations(&self, is_golden: bool) -> Result<Vec<Destination>, Failure> {
        let known = if is_golden { GOLDEN_FORMATS } else { FORMATS };
        let destinations = self.scene.output.destinations(known)?;
        if self.bare && destinations.iter().any(|destination| destination.format != Format::Csv) {
            return Err(failure!("found --bare, expected it with CSV only: JSON and NPZ have no comments"));
        }
        Ok(destinations)
    }

    /// Returns the limit at a jump; `None` for both.
    fn side(&self, is_golden: bool) -> Option<Side> {
        match (self.side, is_golden && self.derivatives.is_empty()) {
            (Some(SideArg::Left), _) => Some(Side::Left),
            (Some(SideArg::Both), _) | (None, true) => None,
            (Some(SideArg::Right), _) | (None, false) => Some(Side::Right),
        }
    }

    /// Writes values of a scene with several bodies.
    fn chain(&self, scene: &ChainScene, is_golden: bool) -> Result<(), Failure> {
        if self.field != Slice::default() {
            return Err(failure!("found --field with a chain of bodies, expected it with one of them, --body N"));
        }
        let (numbers, times) = (self.scene.numbers.numbers_to(scene.accuracy), self.times()?);
        let side = self.side(is_golden);
        self.check_derivatives(&times, side)?;
        let rows = ChainRows { args: self, scene, numbers, times, side };
        rows.write(&self.destinations(is_golden)?)
    }

    /// Returns the columns of the rows.
    fn quantities(&self, scene: &Scene, is_field: bool, is_golden: bool) -> Result<Vec<Quantity>, Failure> {
        let has_material = has_material(scene);
        let scope = if is_field { Scope::AlongRod } else { Scope::OverTime };
        if !is_field && self.quantity.iter().any(|name| name == "x") {
            return Err(failure!("found the quantity x without points, expected --points with it"));
        }
        let listed = scope.resolve(&self.quantity, has_material)?;
        Ok(match (listed.is_empty(), is_field) {
            (true, true) if is_golden => SLICE.to_vec(),
            (true, true) => self.with_keys(scope.resolve(&["field".into()], has_material)?, true),
            (true, false) if is_golden => scope.quantities(),
            (true, false) => return Err(failure!("found no quantity, expected some after --quantity, such as end")),
            (false, _) if is_golden || listed.contains(&Quantity::Time) => listed,
            (false, _) => self.with_keys(listed, is_field),
        })
    }

    /// Returns `quantities` after the time, the side and, of a field, the point.
    fn with_keys(&self, quantities: Vec<Quantity>, is_field: bool) -> Vec<Quantity> {
        let keys = if is_field { &SLICE[..3] } else { &SLICE[..2] };
        let others = quantities.into_iter().filter(|quantity| !keys.contains(quantity));
        keys.iter().copied().chain(others).collect()
    }

    /// Returns the requested times; `None` for the start, every impact and release, and the end.
    fn times(&self) -> Result<Option<List>, Failure> {
        let times = match (&self.times, &self.times_from, &self.dt, &self.to) {
            (Some(list), ..) => list.clone(),
            (_, Some(path), ..) => read_times(path)?,
            (_, _, Some(dt), Some(to)) => List::steps(dt, to)?,
            _ => return Ok(None),
        };
        match times.least().filter(|first| first.to_f64() < 0.0) {
            Some(first) => Err(failure!("found time {first}, expected times from 0 on")),
            None => Ok(Some(times)),
        }
    }
}

/// Reads the times of a file, or of standard input for `-`: one a line; empty lines and the text after a `#` do not
/// count.
fn read_times(path: &Path) -> Result<List, Failure> {
    let is_stdin = path == Path::new("-");
    let name = if is_stdin { "standard input".to_string() } else { path.display().to_string() };
    let cannot_read = || cannot(&format!("read {name}"));
    let opened: Box<dyn Read> =
        if is_stdin { Box::new(std::io::stdin()) } else { Box::new(File::open(path).map_err(cannot_read())?) };
    let mut times = Vec::new();
    for (line, row) in BufReader::new(opened).lines().zip(1..) {
        let line = line.map_err(cannot_read())?;
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

/// Rows that are computed at once.
const CHUNK: usize = 1 << 14;

/// Rows to write, each of a time or of a time and a point.
struct Rows<'a> {
    args: &'a SampleArgs,
    scene: &'a Scene,
    /// Times; `None` stands for the start, the events and the end.
    times: Option<List>,
    points: Option<List>,
    quantities: Vec<Quantity>,
    /// Limit at a jump; `None` stands for both.
    side: Option<Side>,
}

impl Rows<'_> {
    /// Returns the values of a part of the times, column by column.
    fn values(&self, history: &History, part: Range<usize>) -> Result<Vec<Vec<Value>>, Error> {
        let times = self.times.as_ref().map_or(Places::Events, |list| Places::Part(list, part));
        match &self.points {
            None => history.sample(&self.quantities, &times, self.side),
            Some(points) => history.sample_along(&self.quantities, self.args.field, &points.into(), &times, self.side),
        }
    }

    /// Returns the derivatives of `quantities` by each parameter.
    fn derivatives(&self, history: &History, quantities: &[Quantity]) -> Result<Vec<Derivatives<Value>>, Error> {
        let parameters = &self.args.derivatives;
        let (Some(times), Some(side), Some(first)) = (&self.times, self.side, parameters.first()) else {
            return Ok(Vec::new());
        };
        let points = self.points.as_ref().map_or_else(|| Some(Vec::new()), List::numbers);
        let too_long = Error::Derivative { parameter: *first, expected: "times and points of fewer digits" };
        let (times, points) = times.numbers().zip(points).ok_or(too_long)?;
        parameters.iter().map(|by| history.derivatives_at(*by, quantities, &times, &points, side)).collect()
    }

    /// Writes rows while the next ones are computed.
    fn write(&self, answer: Answer, destinations: &[Destination]) -> Result<(), Failure> {
        let Answer { history, info, progress } = answer;
        let info = RunInfo { wide: self.args.wide, ..info };
        let is_key = |quantity: &&Quantity| SLICE[..3].contains(*quantity);
        let derived: Vec<Quantity> = self.quantities.iter().filter(|quantity| !is_key(quantity)).copied().collect();
        let derivatives = self.derivatives(&history, &derived)?;
        let by = || self.args.derivatives.iter().copied().zip(&derivatives);
        let named = || derived.iter().map(|quantity| (quantity, quantity.symbol()));
        let (derived_columns, derived_cells): (Vec<Column>, Vec<Vec<Cell>>) =
            by().flat_map(|(by, rows)| derivative_rows(by, named(), rows)).unzip();
        let columns = self.quantities.iter().map(|quantity| Column::from_quantity(*quantity, &info.units));
        let columns: Vec<Column> = columns.chain(derived_columns).collect();
        let bounds = (self.args.uncertainty, self.args.bare);
        let writer = |destination: &Destination| {
            // A table has derivatives below it.
            let count = if destination.format == Format::Table { self.quantities.len() } else { columns.len() };
            RowWriter::new(destination.format, &columns[..count], bounds, info.digits)
        };
        let mut writers = destinations.iter().map(writer).collect::<Result<Vec<_>, _>>()?;
        let mut write = |cells: &[Vec<Cell>]| writers.iter_mut().try_for_each(|writer| writer.push(cells));
        // Derivatives are computed all at once.
        let at_once = match derivatives.is_empty() {
            true => CHUNK / self.points.as_ref().map_or(1, List::len).min(CHUNK),
            false => usize::MAX,
        };
        progress.set_stage("values of the answer");
        let mut cells = self.push_rows(&history, at_once, &mut write)?;
        cells.extend(derived_cells);
        write(&cells).map_err(cannot("keep the rows"))?;
        let mut tables = String::new();
        if destinations.iter().any(|destination| destination.format == Format::Table) {
            let symbols: Vec<_> = derived.iter().map(|quantity| quantity.symbol()).enumerate().collect();
            let labels = self.labels(&cells, &info);
            tables.extend(
                by().map(|by| derivative_table(("at", labels.clone()), &symbols, by, (info.digits, info.wide))),
            );
        }
        let info = RunInfo { warnings: history.warnings(), ..info };
        if !destinations.iter().any(Destination::is_printed_table) {
            progress.suspend(|| info.print_warnings());
        }
        drop(progress);
        let below = format!("\n{tables}{}", info.below_values(&self.quantities));
        let key_count = self.quantities.iter().take_while(is_key).count().max(1);
        let layout = Layout { below, keys: (!self.args.wide).then_some(key_count) };
        let header = Header::new(&history, info, self.scene.source(), "each column", self.times.is_none());
        for (writer, destination) in writers.into_iter().zip(destinations) {
            writer.finish(&header, destination, &layout)?;
        }
        // Values beyond the end of a history that rests are those of rest.
        if self.times.is_some() && !matches!(history.ending(), Ending::Time | Ending::NextImpact) {
            terminal::note(history.ending());
        }
        Ok(())
    }

    /// Passes rows to `write`, in parts of as many times, while the next part is computed, and returns the last part.
    fn push_rows(
        &self,
        history: &History,
        at_once: usize,
        write: &mut (impl FnMut(&[Vec<Cell>]) -> std::io::Result<()> + Send),
    ) -> Result<Vec<Vec<Cell>>, Failure> {
        let count = self.times.as_ref().map_or(1, List::len);
        let (mut cells, mut written) = (Vec::new(), Ok(()));
        for begin in (0..count).step_by(at_once) {
            let (part, mut values) = (begin..begin.saturating_add(at_once).min(count), Ok(Vec::new()));
            std::thread::scope(|scope| {
                scope.spawn(|| written = write(&cells));
                values = self.values(history, part);
            });
            std::mem::replace(&mut written, Ok(())).map_err(cannot("keep the rows"))?;
            cells = values?.into_iter().map(|column| column.into_iter().map(Cell::Number).collect()).collect();
        }
        Ok(cells)
    }

    /// Returns a label for each row of derivatives: `t = 1/2   x = 0`.
    fn labels(&self, columns: &[Vec<Cell>], info: &RunInfo) -> Vec<String> {
        let place = |key: Quantity| self.quantities.iter().position(|quantity| *quantity == key);
        let text = |name: &str, key: Quantity, row: usize| match &columns[place(key)?][row] {
            Cell::Number(value) => Some(format!("{name} = {}", info.text(value))),
            Cell::Plain(_) | Cell::Numbers(_) => None,
        };
        let label = |row: usize| {
            let texts = [text("t", Quantity::Time, row), text("x", Quantity::Point, row)];
            texts.into_iter().flatten().collect::<Vec<_>>().join("   ")
        };
        (0..columns.first().map_or(0, Vec::len)).map(label).collect()
    }
}
