//! `dalembert sample`, and `dalembert reference`: the same with the defaults of a golden file, and functions.

use std::ops::Range;

use clap::Args;

use super::chain_rows::ChainRows;
use super::sample_args::{FORMATS, SampleArgs};
use crate::answer::{Answer, solve};
use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format, write_all};
use crate::output::{
    Cell, Column, Header, Language, Layout, RowWriter, RunInfo, code, derivative_rows, derivative_table,
};
use crate::source::AnyScene;
use crate::terminal;
use dalembert::number::List;
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
