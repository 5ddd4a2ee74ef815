//! Scenes with several bodies: `solve`, `sample` and `explain`.

use serde_json::{Map, Value as Json, json};

use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format, write_all};
use crate::output::{Cell, Column, Dataset, Header, HistoryPart, Layout, RowWriter, SERIES, json_bytes, rows_bytes};
use crate::progress::Progress;
use crate::source::nearest;
use crate::terminal;
use dalembert::chain::{Chain, ChainColumn, ChainHistory, ChainListing, ForcePiece, ForeseenPieces};
use dalembert::number::{List, Value};
use dalembert::quantity::{Measure, Quantity, Units};
use dalembert::solve::Numbers;
use dalembert::{ChainScene, Error, Estimate, Number, Side};

/// Prints what an answer does not decide.
fn note(history: &ChainHistory) -> Result<(), Failure> {
    history.warning().into_iter().for_each(terminal::note);
    history.chain().strain_warning().into_iter().for_each(terminal::warn);
    let ending = history.ending()?;
    if ending.is_open() {
        terminal::note(ending);
    }
    Ok(())
}

/// Returns the units of forces, impulses and energies in a line, or nothing if none is known.
fn unit_line(scene: &ChainScene, measures: &[Measure]) -> String {
    let named = [(Measure::Force, "force"), (Measure::Impulse, "impulse"), (Measure::Energy, "energies")];
    let asked = named.iter().filter(|(measure, _)| measures.contains(measure) && !scene.unit(*measure).is_empty());
    let texts: Vec<String> = asked.map(|(measure, word)| format!("{word} in {}", scene.unit(*measure))).collect();
    if texts.is_empty() { String::new() } else { format!("\n{}\n", texts.join(", ")) }
}

/// Returns the name of the unit of each measure, null if it is not known.
fn units_json(scene: &ChainScene) -> Json {
    use Measure::{Energy, Force, Impulse, Length, Time, Velocity};
    let name = |measure: Measure| Some(scene.unit(measure)).filter(|name| !name.is_empty());
    let measures = [Time, Length, Velocity, Force, Impulse, Energy];
    measures.iter().map(|measure| (measure.name().to_string(), json!(name(*measure)))).collect::<Map<_, _>>().into()
}

/// Builds the failure for a name that is no quantity of a chain.
pub(crate) fn unknown_quantity(name: &str, known: &[String]) -> Failure {
    let near = nearest(name, known.iter().map(String::as_str));
    let near = near.map_or_else(String::new, |near| format!(" (did you mean {near}?)"));
    failure!("found the quantity {name} of a chain, expected one of {}{near}", known.join(", "))
}

fn digits(numbers: Numbers) -> u32 {
    match numbers {
        Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) | Numbers::Certified(digits) => digits,
        Numbers::Double(_) | Numbers::Exact => 0,
    }
}

fn column(name: &'static str) -> Column {
    Column::new(name).bounded()
}

/// Returns the cell with the name of a node: `bottom`, `joint 1`, `top`.
fn place(scene: &ChainScene, node: usize) -> Cell {
    scene.chain.node_name(node).into()
}

fn events(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let row = |event: &dalembert::chain::ChainEvent<Value>| {
        let numbers = [&event.t, &event.before, &event.after].map(|value| Cell::Number(value.clone()));
        [place(scene, event.node), event.kind.name().into()].into_iter().chain(numbers).collect()
    };
    // A file without events has its header.
    let columns = ["node", "event"].map(|name| Column::new(name).text());
    let columns = columns.into_iter().chain(["t", "gap_rate_before", "gap_rate_after"].map(column));
    Dataset { columns: columns.collect(), rows: listing.events.iter().map(row).collect(), ..Dataset::default() }
}

fn touches(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let row = |touch: &dalembert::chain::Touch<Value>| {
        vec![(Column::new("node").text(), place(scene, touch.node)), (column("t"), Cell::Number(touch.t.clone()))]
    };
    Dataset::from_rows(listing.touches.iter().map(row))
}

/// Relative bound of the time of a peak from which on the peak counts as a plateau.
const PLATEAU: f64 = 0.01;

fn contacts(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let row = |contact: &dalembert::chain::ChainContact<Value>| {
        let known = |value: &Value| Cell::number(Some(value).filter(|_| listing.is_settled(contact)).cloned());
        // The peak of a plateau has no time of its own.
        let is_told =
            |time: &&Value| listing.is_settled(contact) && time.bound().to_f64() <= PLATEAU * time.to_f64().abs();
        vec![
            (Column::new("node").text(), place(scene, contact.node)),
            (column("impact"), Cell::Number(contact.impact.clone())),
            (column("release"), Cell::number(contact.release.clone())),
            (column("impulse"), known(&contact.impulse)),
            (column("peak_force"), known(&contact.peak)),
            (column("peak_time"), Cell::number(Some(&contact.peak_time).filter(is_told).cloned())),
        ]
    };
    Dataset::from_rows(listing.contacts.iter().map(row))
}

/// Returns the pieces of the forces of all nodes.
fn forces(scene: &ChainScene, pieces: &[Vec<ForcePiece<Value>>]) -> Dataset {
    let is_curved = pieces.iter().flatten().any(|piece| !piece.series.is_empty());
    let rows = pieces.iter().enumerate().flat_map(|(node, pieces)| pieces.iter().map(move |piece| (node, piece)));
    let mut data = Dataset::from_rows(rows.map(|(node, piece)| {
        let number = |value: &Value| Cell::Number(value.clone());
        vec![
            (Column::new("node").text(), place(scene, node)),
            (column("start"), number(&piece.start)),
            (column("end"), number(&piece.end)),
            (column("force_start"), number(&piece.first)),
            (column("force_end"), number(&piece.last)),
            (Column::data("chebyshev").bounded().optional(), Cell::Numbers(piece.series.clone())),
        ]
    }));
    if is_curved {
        data.notes.push(format!("a force is linear from force_start to force_end, or {SERIES}"));
    } else {
        data.columns.pop();
        data.rows.iter_mut().for_each(|row| row.truncate(data.columns.len()));
    }
    data
}

/// Builds a table of a listing.
type MakeTable = fn(&ChainScene, &ChainListing) -> Dataset;

/// Runs `solve`: events, touches, contacts and forces; `csv` is the part in a CSV.
pub(crate) fn solve(
    scene: &ChainScene,
    numbers: Numbers,
    csv: HistoryPart,
    destinations: &[Destination],
) -> Result<(), Failure> {
    let progress = Progress::of_chain();
    let history = scene.chain.solve_observed(numbers, progress.observer())?;
    let listing = history.listing()?;
    let is_asked = |format: Format| destinations.iter().any(|destination| destination.format == format);
    let all_forces = is_asked(Format::Json) || csv == HistoryPart::Forces;
    // A table has the forces that are lines.
    let pieces: Vec<_> = match all_forces {
        true => (0..=scene.chain.bodies().len()).map(|node| history.force_pieces(node)).collect::<Result<_, _>>()?,
        false => listing.forces.clone(),
    };
    drop(progress);
    note(&history)?;
    let digits = digits(numbers);
    let whole = |data: Dataset| Dataset { digits, ..data };
    let part = |make: MakeTable| whole(make(scene, &listing));
    let ending = listing.ending.at(&listing.end.to_string());
    write_all(destinations, |format| match format {
        Format::Json => Ok(json_bytes(&json!({
            "schema": 1,
            "title": scene.title,
            "bodies": bodies(scene),
            "number": numbers.to_string(),
            "units": units_json(scene),
            "events": part(events).json(),
            "touches": part(touches).json(),
            "contacts": part(contacts).json(),
            "forces": whole(forces(scene, &pieces)).json(),
            "end": listing.end,
            "ending": ending,
            "warnings": warnings(&history),
        }))),
        Format::Csv => {
            let data = match csv {
                HistoryPart::Events => part(events),
                HistoryPart::Contacts => part(contacts),
                HistoryPart::Stress | HistoryPart::Forces => whole(forces(scene, &pieces)),
            };
            rows_bytes(&data, Format::Csv)
        }
        _ => {
            let mut text = scene.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
            let parts = [("events", part(events)), ("touches", part(touches)), ("contacts", part(contacts))];
            let lines = ("forces", whole(forces(scene, &listing.forces)));
            for (name, data) in parts.into_iter().chain([lines]) {
                if !data.rows.is_empty() {
                    text += &format!("{name}\n{}\n\n", data.table().trim_end());
                }
            }
            let units = unit_line(scene, &[Measure::Force, Measure::Impulse]);
            Ok(format!("{text}{ending}\n{units}").into_bytes())
        }
    })
}

/// Returns the bodies, from the bottom up.
fn bodies(scene: &ChainScene) -> Json {
    let body = |(k, body): (usize, &dalembert::chain::Body)| {
        let (length, mass) = (body.length().to_string(), body.rigid_mass().map(ToString::to_string));
        json!({ "body": k + 1, "name": body.name(), "length": length, "mass": mass })
    };
    scene.chain.bodies().iter().enumerate().map(body).collect()
}

/// Rows that are kept at once.
const CHUNK: usize = 1 << 12;

/// Columns of a chain over time, to be written.
pub(crate) struct ChainRows<'a> {
    pub(crate) scene: &'a ChainScene,
    pub(crate) numbers: Numbers,
    /// Names of columns; none for all.
    pub(crate) names: &'a [String],
    /// Times; `None` stands for the start, the events and the end.
    pub(crate) times: Option<List>,
    /// Limit at a jump; `None` stands for both.
    pub(crate) side: Option<Side>,
    pub(crate) uncertainty: bool,
    /// Whether a CSV has no comments.
    pub(crate) bare: bool,
    pub(crate) wide: bool,
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

impl ChainRows<'_> {
    fn columns(&self) -> Result<Vec<ChainColumn>, Failure> {
        let chain = &self.scene.chain;
        let read = |name: &String| {
            ChainColumn::read(name, chain).ok_or_else(|| {
                let known = ChainColumn::all(chain).into_iter().map(|column| column.name(chain));
                unknown_quantity(name, &known.collect::<Vec<_>>())
            })
        };
        if let Some((_, name)) = self.names.iter().enumerate().find(|(k, name)| self.names[..*k].contains(name)) {
            return Err(failure!("found --quantity {name} twice, expected each once"));
        }
        let is_key = |name: &&String| matches!(name.as_str(), "t" | "side");
        let columns = self.names.iter().filter(|name| !is_key(name)).map(read);
        match self.names.is_empty() {
            true => Ok(ChainColumn::all(chain)),
            false => columns.collect(),
        }
    }

    /// Returns the times of the rows; simultaneous events have one row.
    fn row_times(&self, history: &ChainHistory) -> Result<Vec<RowTime>, Failure> {
        let spelled = |time: &Number| -> Result<RowTime, Failure> {
            Ok(RowTime { time: history.time(time)?, origin: Origin::Spelled(time.clone()) })
        };
        if let Some(times) = &self.times {
            let times = times.numbers().ok_or_else(|| failure!("found times of too many digits, expected fewer"))?;
            return times.iter().map(spelled).collect();
        }
        let mut rows = vec![spelled(&0.into())?];
        let last = spelled(history.chain().until())?;
        for (k, event) in history.listing()?.events.iter().cloned().enumerate() {
            let is_new =
                rows.last().is_none_or(|row: &RowTime| !agree(&row.time, &event.t)) && !agree(&event.t, &last.time);
            if is_new {
                rows.push(RowTime { time: event.t, origin: Origin::Event(k) });
            }
        }
        rows.push(last);
        Ok(rows)
    }

    /// Adds a row to the cells of each column: time, side and values; for both sides two rows where these differ.
    fn add(
        &self,
        history: &ChainHistory,
        (columns, row): (&[ChainColumn], &RowTime),
        cells: &mut [Vec<Cell>],
    ) -> Result<(), Failure> {
        let values = |side: Side| -> Result<Vec<Value>, Error> {
            let value = |column: &ChainColumn| match &row.origin {
                Origin::Spelled(time) => history.value(*column, time, side),
                Origin::Event(event) => history.value_at_event(*column, *event, side),
            };
            columns.iter().map(value).collect()
        };
        let mut push = |side: f64, values: Vec<Value>| {
            let keys = [row.time.clone(), Estimate::exact(side).into()];
            cells
                .iter_mut()
                .zip(keys.into_iter().chain(values))
                .for_each(|(cells, value)| cells.push(Cell::Number(value)));
        };
        match self.side {
            Some(side @ Side::Left) => push(-1.0, values(side)?),
            Some(side @ Side::Right) => push(1.0, values(side)?),
            None => {
                let [left, right] = [values(Side::Left)?, values(Side::Right)?];
                if left.iter().zip(&right).all(|(left, right)| agree(left, right)) {
                    push(0.0, right);
                } else {
                    push(-1.0, left);
                    push(1.0, right);
                }
            }
        }
        Ok(())
    }

    /// Solves the chain, and writes the rows.
    pub(crate) fn write(&self, destinations: &[Destination]) -> Result<(), Failure> {
        let ChainRows { scene, numbers, .. } = self;
        let (chain, columns) = (&scene.chain, self.columns()?);
        let latest = self.times.as_ref().and_then(List::greatest);
        let run = latest.as_ref().map_or_else(|| Ok(chain.clone()), |latest| reaching(chain, latest))?;
        let progress = Progress::of_chain();
        let history = run.solve_observed(*numbers, progress.observer())?;
        let times = self.row_times(&history)?;
        progress.set_stage("values of the answer");
        let heads: Vec<Column> = [key(scene, Quantity::Time), key(scene, Quantity::Side)]
            .into_iter()
            .chain(columns.iter().map(|column| {
                let unit = scene.unit(column.quantity.measure());
                Column::new(column.name(chain)).with_meaning(column.meaning(chain)).with_unit(unit)
            }))
            .collect();
        let bounds = (self.uncertainty, self.bare);
        let writer = |destination: &Destination| RowWriter::new(destination.format, &heads, bounds, digits(*numbers));
        let mut writers = destinations.iter().map(writer).collect::<Result<Vec<_>, _>>()?;
        for part in times.chunks(CHUNK) {
            let mut cells = vec![Vec::new(); heads.len()];
            part.iter().try_for_each(|row| self.add(&history, (&columns, row), &mut cells))?;
            writers.iter_mut().try_for_each(|writer| writer.push(&cells)).map_err(cannot("keep the rows"))?;
        }
        drop(progress);
        note(&history)?;
        let measures: Vec<Measure> = columns.iter().map(|column| column.quantity.measure()).collect();
        let ends = match self.times {
            Some(_) => None,
            None => Some(history.ending()?.at(&history.listing()?.end.to_string())),
        };
        let header = Header::of_chain(
            (scene, latest.as_ref().unwrap_or(chain.until()).to_f64()),
            *numbers,
            warnings(&history),
            ends,
        );
        let below = format!("\n{}", unit_line(scene, &measures));
        let layout = Layout { below, keys: (!self.wide).then_some(2) };
        writers.into_iter().zip(destinations).try_for_each(|(writer, to)| writer.finish(&header, to, &layout))
    }
}

/// Share of the latest time by which a run goes beyond it, so that an event at this time is not at the end of the run.
const BEYOND: f64 = 1.0 / 16.0;

/// Returns the chain with a last time that the run needs to answer up to `latest`.
fn reaching(chain: &Chain, latest: &Number) -> Result<Chain, Failure> {
    let until = chain.until();
    if latest.compare(until).is_gt() {
        return Ok(chain.with_until(latest.clone())?);
    }
    if latest.to_f64() < 0.0 {
        return Ok(chain.clone());
    }
    // A run has a last time above zero.
    let enough = (latest.to_f64() * (1.0 + BEYOND)).max(until.to_f64() * f64::EPSILON);
    match enough.to_string().parse::<Number>() {
        Ok(enough) if enough.compare(until).is_lt() => Ok(chain.with_until(enough)?),
        _ => Ok(chain.clone()),
    }
}

/// Returns the column of the time or the side.
fn key(scene: &ChainScene, quantity: Quantity) -> Column {
    let unit = quantity.measure().map_or("", |measure| scene.unit(measure));
    Column::from_quantity(quantity, &Units::default()).with_unit(unit)
}

/// Returns whether two doubles agree within their bounds, or two longer numbers are the same.
fn agree(a: &Value, b: &Value) -> bool {
    if a.is_double() && b.is_double() {
        (a.to_f64() - b.to_f64()).abs() <= a.bound().to_f64() + b.bound().to_f64()
    } else {
        a.to_string() == b.to_string()
    }
}

fn warnings(history: &ChainHistory) -> Vec<String> {
    history.warning().into_iter().chain(history.chain().strain_warning()).map(|warning| warning.to_string()).collect()
}

/// Runs `explain`: the effects of the chain, and the wave pieces that its run takes.
pub(crate) fn explain(scene: &ChainScene, numbers: Numbers, destinations: &[Destination]) -> Result<(), Failure> {
    let effects = scene.effects();
    let foreseen = scene.chain.foresee_pieces();
    let cost = match &foreseen {
        Ok(ForeseenPieces::Counted(pieces)) => format!("{pieces} wave pieces up to t = {}", scene.chain.until()),
        Ok(ForeseenPieces::Estimated { pieces, power, time }) => format!(
            "about {pieces:.1e} wave pieces up to t = {}, of which a run may have {}: they grow like t^{power:.1} \
             up to t = {time:.4}",
            scene.chain.until(),
            scene.chain.max_pieces()
        ),
        Err(error) => error.to_string(),
    };
    let counted = match foreseen {
        Ok(ForeseenPieces::Counted(pieces)) => json!(pieces),
        Ok(ForeseenPieces::Estimated { pieces, .. }) => json!(pieces.round()),
        Err(_) => Json::Null,
    };
    write_all(destinations, |format| {
        if format == Format::Json {
            return Ok(json_bytes(&json!({
                "schema": 1,
                "title": scene.title,
                "effects": effects,
                "engine": "chain",
                "number": numbers.to_string(),
                "pieces": counted,
                "cost": cost,
            })));
        }
        let row = |effect: &dalembert::ChainEffect| {
            let line = effect.line.map_or(Json::Null, Json::from);
            vec![
                (Column::new("effect").text(), effect.effect.into()),
                (Column::new("called").text(), (if effect.called { "yes" } else { "no" }).into()),
                (Column::new("line").text(), Cell::Plain(line)),
                (Column::new("because").text(), effect.because.as_str().into()),
            ]
        };
        let table = Dataset::from_rows(effects.iter().map(row)).table();
        Ok(format!("{table}\nengine: a chain, from node to node, in {numbers}\ncost: {cost}\n").into_bytes())
    })
}
