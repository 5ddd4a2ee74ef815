//! Scenes with several bodies: `solve` and `explain`.

use serde_json::{Map, Value as Json, json};

use crate::failure::Failure;
use crate::file::{Destination, Format, write_all};
use crate::output::{
    Cell, Column, Dataset, HistoryPart, SERIES, add_derivatives, derivative_table, json_bytes, rows_bytes, table_digits,
};
use crate::progress::Progress;
use crate::terminal;
use dalembert::chain::{ChainHistory, ChainListing, ChainNumbers, ForcePiece, ForeseenPieces};
use dalembert::number::Value;
use dalembert::problem::Parameter;
use dalembert::quantity::Measure;
use dalembert::solve::{Derivatives, Numbers};
use dalembert::{ChainScene, Error};

/// Prints what an answer does not decide.
pub(super) fn note(history: &ChainHistory) -> Result<(), Failure> {
    history.warnings().into_iter().for_each(terminal::warn);
    let ending = history.ending()?;
    if ending.is_open() {
        terminal::note(ending);
    }
    Ok(())
}

/// Returns the units of forces, impulses and energies in a line, or nothing if none is known.
pub(super) fn unit_line(scene: &ChainScene, measures: &[Measure]) -> String {
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

pub(super) fn digits(numbers: Numbers) -> u32 {
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
        let numbers = event.numbers().map(|value| Cell::Number(value.clone()));
        [place(scene, event.node), event.kind.name().into()].into_iter().chain(numbers).collect()
    };
    // A file without events has its header.
    let columns = ["node", "event"].map(|name| Column::new(name).text());
    let columns = columns.into_iter().chain(ChainNumbers::Events.names().iter().copied().map(column));
    Dataset { columns: columns.collect(), rows: listing.events.iter().map(row).collect(), ..Dataset::default() }
}

fn touches(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let row = |touch: &dalembert::chain::Touch<Value>| {
        vec![(Column::new("node").text(), place(scene, touch.node)), (column("t"), Cell::Number(touch.t.clone()))]
    };
    Dataset::from_rows(listing.touches.iter().map(row))
}

fn contacts(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let row = |contact: &dalembert::chain::ChainContact<Value>| {
        let numbers = contact.numbers(&listing.ending).into_iter().chain([listing.peak_time(contact)]);
        let numbers = numbers.map(|number| Cell::number(number.cloned()));
        [place(scene, contact.node)].into_iter().chain(numbers).collect()
    };
    // A file without contacts has its header.
    let columns = ChainNumbers::Contacts.names().iter().copied().chain(["peak_time"]).map(column);
    let columns = [Column::new("node").text()].into_iter().chain(columns).collect();
    Dataset { columns, rows: listing.contacts.iter().map(row).collect(), ..Dataset::default() }
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

/// The requested parts of a history.
pub(super) struct Parts<'a> {
    /// The part in a CSV.
    pub(super) csv: HistoryPart,
    /// The values by which derivatives of events and contacts are taken.
    pub(super) derivatives: &'a [Parameter],
    /// Whether a row of a table stays on one line.
    pub(super) wide: bool,
}

/// Derivatives of events and contacts by a value.
struct ListDerivatives {
    by: Parameter,
    events: Derivatives<Value>,
    contacts: Derivatives<Value>,
}

impl ListDerivatives {
    fn new(history: &ChainHistory, by: Parameter) -> Result<Self, Error> {
        let [events, contacts] = [ChainNumbers::Events, ChainNumbers::Contacts];
        Ok(ListDerivatives {
            by,
            events: history.derivatives(by, events)?,
            contacts: history.derivatives(by, contacts)?,
        })
    }

    /// Returns the tables for a person.
    fn tables(&self, scene: &ChainScene, listing: &ChainListing, style: (u32, bool)) -> String {
        let label = |what: &str, node: usize, word: &str, time: &Value| {
            format!("{what} of {} {word} {}", scene.chain.node_name(node), time.to_digits(table_digits(style.0)))
        };
        let events = listing.events.iter().map(|event| label(event.kind.name(), event.node, "at", &event.t));
        let contacts = listing.contacts.iter().map(|contact| label("contact", contact.node, "from", &contact.impact));
        let symbols = |numbers: ChainNumbers<'_>| numbers.names().iter().enumerate().collect::<Vec<_>>();
        let shown = symbols(ChainNumbers::Events);
        let events = derivative_table(("derivatives", events.collect()), &shown, (self.by, &self.events), style);
        // The beginning and the end of a contact are events, in the table above.
        let shown = &symbols(ChainNumbers::Contacts)[2..];
        events + &derivative_table(("derivatives", contacts.collect()), shown, (self.by, &self.contacts), style)
    }
}

/// Runs `solve`: events, touches, contacts and forces.
pub(super) fn solve(
    scene: &ChainScene,
    numbers: Numbers,
    Parts { csv, derivatives, wide }: &Parts<'_>,
    destinations: &[Destination],
) -> Result<(), Failure> {
    let progress = Progress::of_chain();
    let history = scene.chain.solve_observed(numbers, progress.observer())?;
    let listing = history.listing()?;
    let is_asked = |format: Format| destinations.iter().any(|destination| destination.format == format);
    let all_forces = is_asked(Format::Json) || *csv == HistoryPart::Forces;
    // A table has the forces that are lines.
    let pieces: Vec<_> = match all_forces {
        true => (0..=scene.chain.bodies().len()).map(|node| history.force_pieces(node)).collect::<Result<_, _>>()?,
        false => listing.forces.clone(),
    };
    let by = |by: &Parameter| ListDerivatives::new(&history, *by);
    let derivatives = derivatives.iter().map(by).collect::<Result<Vec<_>, _>>()?;
    drop(progress);
    note(&history)?;
    let digits = digits(numbers);
    let whole = |data: Dataset| Dataset { digits, ..data };
    let part = |make: MakeTable| whole(make(scene, &listing));
    let events = || {
        let mut data = part(events);
        derivatives
            .iter()
            .for_each(|found| add_derivatives(&mut data, ChainNumbers::Events.names(), (found.by, &found.events)));
        data
    };
    let contacts = || {
        let mut data = part(contacts);
        derivatives
            .iter()
            .for_each(|found| add_derivatives(&mut data, ChainNumbers::Contacts.names(), (found.by, &found.contacts)));
        data
    };
    let ending = listing.ending.at(&listing.end.to_digits(table_digits(digits)));
    write_all(destinations, |format| match format {
        Format::Json => Ok(json_bytes(&json!({
            "schema": 1,
            "title": scene.title,
            "bodies": bodies(scene),
            "number": numbers.to_string(),
            "units": units_json(scene),
            "events": events().json(),
            "touches": part(touches).json(),
            "contacts": contacts().json(),
            "forces": whole(forces(scene, &pieces)).json(),
            "end": listing.end,
            "ending": ending,
            "warnings": warnings(&history),
        }))),
        Format::Csv => {
            let data = match *csv {
                HistoryPart::Events => events(),
                HistoryPart::Contacts => contacts(),
                HistoryPart::Stress | HistoryPart::Forces => whole(forces(scene, &pieces)),
            };
            rows_bytes(&data, Format::Csv)
        }
        _ => {
            let mut text = scene.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
            let parts = [("events", events()), ("touches", part(touches)), ("contacts", contacts())];
            let lines = ("forces", whole(forces(scene, &listing.forces)));
            for (name, data) in parts.into_iter().chain([lines]) {
                if !data.rows.is_empty() {
                    text += &format!("{name}\n{}\n\n", data.table().trim_end());
                }
            }
            if !derivatives.is_empty() {
                text.pop();
                text.extend(derivatives.iter().map(|found| found.tables(scene, &listing, (digits, *wide))));
                text.push('\n');
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

pub(super) fn warnings(history: &ChainHistory) -> Vec<String> {
    history.warnings().iter().map(ToString::to_string).collect()
}

/// Runs `explain`: the effects of the chain, and the wave pieces that its run takes.
pub(crate) fn explain(scene: &ChainScene, numbers: Numbers, destinations: &[Destination]) -> Result<(), Failure> {
    scene.chain.check_numbers(numbers)?;
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
        let row = |effect: &dalembert::EffectUse<&str>| {
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
