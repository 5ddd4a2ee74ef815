//! Rows of the columns of a chain over time, or at points of its bodies.

use super::chain::{digits, note, unit_line, warnings};
use super::sample_args::SampleArgs;
use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format};
use crate::output::{Cell, Column, Header, Layout, RowWriter, derivative_rows, derivative_table, table_digits};
use crate::progress::Progress;
use crate::quantities::unknown;
use dalembert::chain::{Body, Chain, ChainColumn, ChainHistory, ChainNumbers, ChainTime};
use dalembert::number::{List, Scalar, Value};
use dalembert::problem::Parameter;
use dalembert::quantity::{Measure, Needs, Quantity, SLICE, Units};
use dalembert::solve::{Derivatives, Numbers};
use dalembert::{ChainScene, Estimate, Number, Side};

/// Rows that are kept at once.
const CHUNK: usize = 1 << 12;

/// Columns of a chain, to be written.
pub(super) struct ChainRows<'a> {
    pub(super) args: &'a SampleArgs,
    pub(super) scene: &'a ChainScene,
    pub(super) numbers: Numbers,
    /// Times; `None` stands for the start, the events and the end.
    pub(super) times: Option<List>,
    /// Limit at a jump; `None` stands for both.
    pub(super) side: Option<Side>,
}

/// A column of the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RowColumn {
    /// Time, side, or point.
    Key(Quantity),
    /// A quantity over time.
    Whole(ChainColumn),
    /// A quantity at a point of a body.
    Point { quantity: Quantity, body: usize },
}

/// The columns of the rows, and the numbers that they are taken from.
struct RowColumns {
    all: Vec<RowColumn>,
    whole: Vec<ChainColumn>,
    /// The bodies whose fields are asked for.
    bodies: Vec<usize>,
}

impl RowColumns {
    fn new(all: Vec<RowColumn>) -> Self {
        let (mut whole, mut bodies) = (Vec::new(), Vec::new());
        for column in &all {
            match column {
                RowColumn::Whole(column) => whole.push(*column),
                RowColumn::Point { body, .. } if !bodies.contains(body) => bodies.push(*body),
                RowColumn::Point { .. } | RowColumn::Key(_) => (),
            }
        }
        RowColumns { all, whole, bodies }
    }

    /// Returns the columns with a place among the numbers of a row: all but keys.
    fn placed(&self) -> impl Iterator<Item = (RowColumn, usize)> {
        self.all.iter().filter_map(|column| Some((*column, self.place(*column)?)))
    }

    /// Returns the place of a column among the numbers of a row; `None` for a key.
    fn place(&self, column: RowColumn) -> Option<usize> {
        match column {
            RowColumn::Key(_) => None,
            RowColumn::Whole(column) => self.whole.iter().position(|known| *known == column),
            RowColumn::Point { quantity, body } => {
                let body = self.bodies.iter().position(|known| *known == body)?;
                Some(3 * body + SLICE[3..].iter().position(|known| *known == quantity)?)
            }
        }
    }
}

/// The time of a row.
struct RowTime {
    time: Value,
    origin: Origin,
}

/// The origin of a time.
enum Origin {
    /// A time that was asked for, the start, or the end.
    Spelled(Number),
    /// The event with this index.
    Event(usize),
}

impl RowColumn {
    /// Returns the columns that a name stands for; none for an unknown name.
    fn read(name: &str, chain: &Chain, is_field: bool) -> Vec<Self> {
        let keys = if is_field { &SLICE[..3] } else { &SLICE[..2] };
        if let Some(key) = keys.iter().find(|key| key.name() == name) {
            return vec![RowColumn::Key(*key)];
        }
        if !is_field {
            return ChainColumn::list(name, chain).into_iter().map(RowColumn::Whole).collect();
        }
        let (quantity, place) = name.split_once('.').map_or((name, None), |(quantity, place)| (quantity, Some(place)));
        let quantities = match (quantity, Needs::PointAndTime.named(quantity)) {
            ("field", _) => SLICE[3..].to_vec(),
            (_, known) => known.into_iter().filter(|quantity| SLICE[3..].contains(quantity)).collect(),
        };
        let is_asked = |body: usize| place.is_none_or(|place| place.parse() == Ok(body + 1));
        let bodies = bars(chain).filter(|body| is_asked(*body));
        bodies
            .flat_map(|body| quantities.iter().map(move |quantity| RowColumn::Point { quantity: *quantity, body }))
            .collect()
    }

    /// Returns the name of the column.
    fn name(self, chain: &Chain) -> String {
        match self {
            RowColumn::Key(quantity) => quantity.name().into(),
            RowColumn::Whole(column) => column.name(chain),
            RowColumn::Point { quantity, body } => format!("{}.{}", quantity.name(), body + 1),
        }
    }

    fn measure(self) -> Option<Measure> {
        match self {
            RowColumn::Whole(column) => Some(column.quantity.measure()),
            RowColumn::Key(quantity) | RowColumn::Point { quantity, .. } => quantity.measure(),
        }
    }

    /// Returns the head of the column.
    fn head(self, scene: &ChainScene) -> Column {
        let unit = self.measure().map_or("", |measure| scene.unit(measure));
        let chain = &scene.chain;
        let meaning = match self {
            RowColumn::Key(quantity) => return Column::from_quantity(quantity, &Units::default()).with_unit(unit),
            RowColumn::Whole(column) => column.meaning(chain),
            RowColumn::Point { quantity, body } => {
                let name = chain.bodies()[body].name().map_or_else(String::new, |name| format!(" ({name})"));
                format!("{}, of body {}{name}", quantity.meaning(), body + 1)
            }
        };
        Column::new(self.name(chain)).with_meaning(meaning).with_unit(unit)
    }
}

/// Returns the indices of the bodies that are no rigid masses.
fn bars(chain: &Chain) -> impl Iterator<Item = usize> {
    let is_bar = |(_, body): &(usize, &Body)| body.rigid_mass().is_none();
    chain.bodies().iter().enumerate().filter(is_bar).map(|(k, _)| k)
}

impl ChainRows<'_> {
    fn is_field(&self) -> bool {
        self.args.points.is_some()
    }

    /// Returns the columns, with their keys before them unless the time is among them.
    fn columns(&self) -> Result<RowColumns, Failure> {
        let chain = &self.scene.chain;
        let mut columns: Vec<RowColumn> = Vec::new();
        for name in &self.args.quantity {
            let found = RowColumn::read(name, chain, self.is_field());
            if found.is_empty() {
                if !self.is_field() && !RowColumn::read(name, chain, true).is_empty() {
                    return Err(failure!("found the quantity {name} without points, expected --points with it"));
                }
                return Err(unknown(name, " of a chain", &self.known()));
            }
            if let Some(twice) = found.iter().find(|column| columns.contains(column)) {
                return Err(failure!("found --quantity {} twice, expected each once", twice.name(chain)));
            }
            columns.extend(found);
        }
        if columns.is_empty() {
            columns.extend(match self.is_field() {
                true => RowColumn::read("field", chain, true),
                false => ChainColumn::all(chain).into_iter().map(RowColumn::Whole).collect(),
            });
        }
        if !columns.contains(&RowColumn::Key(Quantity::Time)) {
            let keys = if self.is_field() { &SLICE[..3] } else { &SLICE[..2] };
            columns.retain(|column| !matches!(column, RowColumn::Key(_)));
            columns.splice(..0, keys.iter().copied().map(RowColumn::Key));
        }
        Ok(RowColumns::new(columns))
    }

    /// Returns all names of columns.
    fn known(&self) -> Vec<String> {
        let chain = &self.scene.chain;
        match self.is_field() {
            true => RowColumn::read("field", chain, true).into_iter().map(|column| column.name(chain)).collect(),
            false => ChainColumn::names(chain),
        }
    }

    /// Returns a point as a number of the answers.
    fn place_of(&self, point: &Number) -> Value {
        match self.numbers {
            Numbers::Exact => point.to_rational().into(),
            _ => Estimate::<f64>::spelling(point, &()).into(),
        }
    }

    /// Returns the points; an error for one beyond a body that is asked about.
    fn listed_points(&self, columns: &RowColumns) -> Result<Vec<Number>, Failure> {
        let Some(points) = &self.args.points else { return Ok(Vec::new()) };
        let points = points.numbers().ok_or_else(|| too_long("points"))?;
        for column in &columns.all {
            let RowColumn::Point { body, .. } = column else { continue };
            let length = self.scene.chain.bodies()[*body].length();
            let is_outside = |point: &&Number| point.to_f64() < 0.0 || point.compare(length).is_gt();
            if let Some(point) = points.iter().find(is_outside) {
                let name = column.name(&self.scene.chain);
                return Err(failure!("found the point {point} for {name}, expected points from 0 to {length}"));
            }
        }
        Ok(points)
    }

    /// Returns the times of the rows; simultaneous events have one row.
    fn row_times(&self, history: &ChainHistory) -> Result<Vec<RowTime>, Failure> {
        let spelled = |time: &Number| -> Result<RowTime, Failure> {
            Ok(RowTime { time: history.time(time)?, origin: Origin::Spelled(time.clone()) })
        };
        if let Some(times) = &self.times {
            return times.numbers().ok_or_else(|| too_long("times"))?.iter().map(spelled).collect();
        }
        let mut rows = vec![spelled(&0.into())?];
        let last = spelled(history.chain().until())?;
        for (k, event) in history.listing()?.events.iter().cloned().enumerate() {
            let is_new =
                rows.last().is_none_or(|row: &RowTime| !row.time.agrees(&event.t)) && !event.t.agrees(&last.time);
            if is_new {
                rows.push(RowTime { time: event.t, origin: Origin::Event(k) });
            }
        }
        rows.push(last);
        Ok(rows)
    }

    /// Adds a row to the cells of each column, at a point of a field; for both sides two rows where these differ.
    fn add(
        &self,
        history: &ChainHistory,
        columns: &RowColumns,
        (row, point): (&RowTime, Option<&Number>),
        cells: &mut [Vec<Cell>],
    ) -> Result<(), Failure> {
        let time = match &row.origin {
            Origin::Spelled(time) => ChainTime::Spelled(time),
            Origin::Event(event) => ChainTime::Event(*event),
        };
        let rows = match (time, point) {
            (ChainTime::Spelled(time), Some(point)) => {
                history.field_rows_at(&columns.bodies, (point, time), self.side)?
            }
            _ => history.rows_at(&columns.whole, time, self.side)?,
        };
        for found in rows {
            let side = found.side.map_or(0.0, |side| if side == Side::Left { -1.0 } else { 1.0 });
            for (cells, column) in cells.iter_mut().zip(&columns.all) {
                cells.push(match (column, point) {
                    (RowColumn::Key(Quantity::Time), _) => Cell::Number(row.time.clone()),
                    (RowColumn::Key(Quantity::Point), Some(point)) => Cell::Number(self.place_of(point)),
                    (RowColumn::Key(_), _) => Cell::Number(Estimate::exact(side).into()),
                    (column, _) => Cell::number(columns.place(*column).map(|place| found.values[place].clone())),
                });
            }
        }
        Ok(())
    }

    /// Returns the derivatives of the columns by each parameter.
    fn derivatives(
        &self,
        history: &ChainHistory,
        columns: &RowColumns,
        points: &[Number],
    ) -> Result<Vec<Derivatives<Value>>, Failure> {
        let (Some(times), Some(side), false) = (&self.times, self.side, self.args.derivatives.is_empty()) else {
            return Ok(Vec::new());
        };
        let times = &times.numbers().ok_or_else(|| too_long("times"))?[..];
        let numbers = match self.is_field() {
            true => ChainNumbers::Fields { bodies: &columns.bodies, points, times, side },
            false => ChainNumbers::Columns { columns: &columns.whole, times, side },
        };
        let derivatives = |by: &Parameter| -> Result<Derivatives<Value>, Failure> {
            let rows = history.derivatives(*by, numbers)?.into_iter();
            Ok(rows.map(|row| columns.placed().map(|(_, place)| row[place].clone()).collect()).collect())
        };
        self.args.derivatives.iter().map(derivatives).collect()
    }

    /// Solves the chain, and writes the rows.
    pub(super) fn write(&self, destinations: &[Destination]) -> Result<(), Failure> {
        let ChainRows { scene, numbers, .. } = self;
        let (chain, columns) = (&scene.chain, self.columns()?);
        if self.is_field() && self.times.is_none() {
            return Err(failure!("found --points without times, expected --times, --dt or --times-from with it"));
        }
        let points = self.listed_points(&columns)?;
        let latest = self.times.as_ref().and_then(List::greatest);
        let run = latest.as_ref().map_or_else(|| Ok(chain.clone()), |latest| chain.reaching(latest))?;
        let progress = Progress::of_chain();
        let history = run.solve_observed(*numbers, progress.observer())?;
        let times = self.row_times(&history)?;
        progress.set_stage("values of the answer");
        let names = || columns.placed().map(|(column, _)| column.name(chain));
        let derivatives = self.derivatives(&history, &columns, &points)?;
        let by = || self.args.derivatives.iter().copied().zip(&derivatives);
        let (derived_heads, derived_cells): (Vec<Column>, Vec<Vec<Cell>>) =
            by().flat_map(|(by, rows)| derivative_rows(by, names().zip(names()), rows)).unzip();
        let heads: Vec<Column> = columns.all.iter().map(|column| column.head(scene)).chain(derived_heads).collect();
        let bounds = (self.args.uncertainty, self.args.bare);
        let writer = |destination: &Destination| {
            // A table has derivatives below it.
            let count = if destination.format == Format::Table { columns.all.len() } else { heads.len() };
            RowWriter::new(destination.format, &heads[..count], bounds, digits(*numbers))
        };
        let mut writers = destinations.iter().map(writer).collect::<Result<Vec<_>, _>>()?;
        let places: Vec<Option<&Number>> = if self.is_field() { points.iter().map(Some).collect() } else { vec![None] };
        let all: Vec<(&RowTime, Option<&Number>)> =
            times.iter().flat_map(|time| places.iter().map(move |place| (time, *place))).collect();
        for (k, part) in all.chunks(CHUNK).enumerate() {
            let mut cells = vec![Vec::new(); columns.all.len()];
            part.iter().try_for_each(|row| self.add(&history, &columns, *row, &mut cells))?;
            let rows = k * CHUNK..k * CHUNK + part.len();
            cells.extend(derived_cells.iter().map(|column| column[rows.clone()].to_vec()));
            writers.iter_mut().try_for_each(|writer| writer.push(&cells)).map_err(cannot("keep the rows"))?;
        }
        drop(progress);
        note(&history)?;
        let measures: Vec<Measure> = columns.all.iter().filter_map(|column| column.measure()).collect();
        let ends = match self.times {
            Some(_) => None,
            None => Some(history.ending()?.at(&history.listing()?.end.to_digits(table_digits(digits(*numbers))))),
        };
        let last = latest.as_ref().unwrap_or(chain.until()).to_f64();
        let header = Header::of_chain((scene, last), *numbers, warnings(&history), ends);
        let label = |(row, point): &(&RowTime, Option<&Number>)| {
            let time = format!("t = {}", row.time);
            point.map_or_else(|| time.clone(), |point| format!("{time}   x = {point}"))
        };
        let labels: Vec<String> = if derivatives.is_empty() { Vec::new() } else { all.iter().map(label).collect() };
        let symbols: Vec<(usize, String)> = names().enumerate().collect();
        let style = (digits(*numbers), self.args.wide);
        let tables = by().map(|by| derivative_table(("at", labels.clone()), &symbols, by, style));
        let below = format!("\n{}{}", tables.collect::<String>(), unit_line(scene, &measures));
        let keys = columns.all.iter().take_while(|column| matches!(column, RowColumn::Key(_))).count();
        let layout = Layout { below, keys: (!self.args.wide).then_some(keys) };
        writers.into_iter().zip(destinations).try_for_each(|(writer, to)| writer.finish(&header, to, &layout))
    }
}

fn too_long(what: &str) -> Failure {
    failure!("found {what} of too many digits, expected fewer")
}
