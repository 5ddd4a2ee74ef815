//! Scenes with several bodies: `solve`, `sample` and `explain`.

use std::ops::ControlFlow;
use std::sync::Arc;

use serde_json::{Map, Value as Json, json};

use crate::failure::Failure;
use crate::file::{Destination, Format, write_all};
use crate::output::{Cell, Column, Dataset, json_bytes, rows_bytes};
use crate::terminal;
use dalembert::chain::{Chain, ChainColumn, ChainHistory, ChainListing};
use dalembert::number::{List, Value};
use dalembert::quantity::Measure;
use dalembert::solve::Numbers;
use dalembert::{ChainScene, Error, Side};

/// Prints what an answer does not decide.
fn note(history: &ChainHistory) -> Result<(), Failure> {
    if let Some(warning) = history.warning() {
        terminal::note(warning);
    }
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
        let number = |value: &Value| Cell::Number(value.clone());
        vec![
            (Column::new("node").text(), place(scene, event.node)),
            (Column::new("event").text(), event.kind.name().into()),
            (column("t"), number(&event.t)),
            (column("gap_rate_before"), number(&event.before)),
            (column("gap_rate_after"), number(&event.after)),
        ]
    };
    Dataset::from_rows(listing.events.iter().map(row))
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
        let number = |value: &Value| Cell::Number(value.clone());
        // The peak of a plateau has no time of its own.
        let is_told = |time: &&Value| time.bound().to_f64() <= PLATEAU * time.to_f64().abs();
        vec![
            (Column::new("node").text(), place(scene, contact.node)),
            (column("impact"), number(&contact.impact)),
            (column("release"), Cell::number(contact.release.clone())),
            (column("impulse"), number(&contact.impulse)),
            (column("peak_force"), number(&contact.peak)),
            (column("peak_time"), Cell::number(Some(&contact.peak_time).filter(is_told).cloned())),
        ]
    };
    Dataset::from_rows(listing.contacts.iter().map(row))
}

fn forces(scene: &ChainScene, listing: &ChainListing) -> Dataset {
    let rows =
        listing.forces.iter().enumerate().flat_map(|(node, pieces)| pieces.iter().map(move |piece| (node, piece)));
    Dataset::from_rows(rows.map(|(node, piece)| {
        let number = |value: &Value| Cell::Number(value.clone());
        vec![
            (Column::new("node").text(), place(scene, node)),
            (column("start"), number(&piece.start)),
            (column("end"), number(&piece.end)),
            (column("force_start"), number(&piece.first)),
            (column("force_end"), number(&piece.last)),
        ]
    }))
}

/// Runs `solve`: events, touches, contacts and forces.
pub(crate) fn solve(scene: &ChainScene, numbers: Numbers, destinations: &[Destination]) -> Result<(), Failure> {
    let history = scene.chain.solve(numbers)?;
    let listing = history.listing()?;
    note(&history)?;
    let digits = digits(numbers);
    let in_digits = |data: Dataset| Dataset { digits, ..data };
    let parts = [events(scene, &listing), touches(scene, &listing), contacts(scene, &listing), forces(scene, &listing)];
    let [events, touches, contacts, forces] = parts.map(in_digits);
    let ending = history.ending()?.at(&listing.end.to_string());
    write_all(destinations, |format| match format {
        Format::Json => Ok(json_bytes(&json!({
            "schema": 1,
            "title": scene.title,
            "bodies": bodies(scene),
            "number": numbers.to_string(),
            "units": units_json(scene),
            "events": events.json(),
            "touches": touches.json(),
            "contacts": contacts.json(),
            "forces": forces.json(),
            "end": listing.end,
            "ending": ending,
            "warnings": history.warning().into_iter().map(|warning| warning.to_string()).collect::<Vec<_>>(),
        }))),
        Format::Csv => rows_bytes(&events, Format::Csv),
        _ => {
            let mut text = scene.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
            for (name, data) in
                [("events", &events), ("touches", &touches), ("contacts", &contacts), ("forces", &forces)]
            {
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

/// Runs `sample`: the columns `names` at `times`, as the limits from `sides`.
pub(crate) fn sample(
    scene: &ChainScene,
    numbers: Numbers,
    (names, times): (&[String], &List),
    sides: &[Side],
    destinations: &[Destination],
    uncertainty: bool,
) -> Result<(), Failure> {
    let chain = &scene.chain;
    let read = |name: &String| {
        ChainColumn::read(name, chain).ok_or_else(|| {
            let known: Vec<String> = ChainColumn::all(chain).into_iter().map(|column| column.name(chain)).collect();
            failure!("found the quantity {name} of a chain, expected one of {}", known.join(", "))
        })
    };
    let columns = match names.is_empty() {
        true => ChainColumn::all(chain),
        false => names.iter().map(read).collect::<Result<_, _>>()?,
    };
    let times = times.numbers().ok_or_else(|| failure!("found times of too many digits, expected fewer"))?;
    let latest = times.iter().max_by(|a, b| a.compare(b)).filter(|time| time.compare(chain.until()).is_gt());
    let history = match latest {
        Some(latest) => chain.with_until(latest.clone())?.solve(numbers)?,
        None => chain.solve(numbers)?,
    };
    let mut rows = Vec::new();
    for time in &times {
        for side in sides {
            let mut row = vec![
                (Column::new("t"), Cell::Plain(time_json(time, numbers))),
                (Column::new("side").text(), side.name().into()),
            ];
            for column in &columns {
                let value = history.value(*column, time, *side)?;
                let head = Column::new(column.name(chain));
                row.push((if uncertainty { head.bounded() } else { head }, Cell::Number(value)));
            }
            rows.push(row);
        }
    }
    note(&history)?;
    let mut data = Dataset::from_rows(rows.into_iter());
    (data.digits, data.keys, data.list) = (digits(numbers), Some(2), "rows");
    let header = json!({"schema": 1, "title": scene.title, "number": numbers.to_string(), "units": units_json(scene)});
    data.header = header;
    let measures: Vec<Measure> = columns.iter().map(|column| column.quantity.measure()).collect();
    write_all(destinations, |format| match format {
        Format::Table => Ok(format!("{}\n{}", data.table().trim_end(), unit_line(scene, &measures)).into_bytes()),
        Format::Json => Ok(json_bytes(&data.json())),
        format => rows_bytes(&data, format),
    })
}

/// Returns a time as it was asked for; as a number if the answers are doubles.
fn time_json(time: &dalembert::Number, numbers: Numbers) -> Json {
    match numbers {
        Numbers::Double(_) => json!(time.to_f64()),
        _ => json!(time.to_string()),
    }
}

/// The wave pieces of a run.
enum Pieces {
    Counted(usize),
    /// Estimated from their growth with a power of the time, up to this time.
    Estimated {
        pieces: f64,
        power: f64,
        time: f64,
    },
}

/// Wave pieces from which on a run is not counted to its end.
const MOST_COUNTED: usize = 100_000;
/// Number of times that the time of a run is halved at most, to see how its pieces grow.
const HALVINGS: i32 = 40;

/// Foresees the wave pieces of a run in doubles: a long run is made in part, and the rest is extrapolated.
fn foreseen(chain: &Chain) -> Result<Pieces, Error> {
    let count = |chain: &Chain| {
        let observe = Arc::new(|_, pieces| match pieces > MOST_COUNTED {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        match chain.solve_observed(Numbers::default(), observe) {
            Ok(history) => Ok(Some(history.pieces())),
            Err(Error::Interrupted | Error::TooManyPieces { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    };
    if let Some(pieces) = count(chain)? {
        return Ok(Pieces::Counted(pieces));
    }
    // The latest time of a run that is counted, and half of it.
    let whole = chain.until().to_f64();
    let mut found: Option<(f64, f64)> = None;
    for halvings in 1..=HALVINGS {
        let time = whole / 2f64.powi(halvings);
        let until = format!("{time:e}").parse().map_err(|_| Error::NotDecided { what: "a time", bits: 53 })?;
        let Some(pieces) = count(&chain.with_until(until)?)?.map(|pieces| pieces.max(1) as f64) else { continue };
        if let Some((time, later)) = found {
            let power = (later / pieces).log2().max(1.0);
            return Ok(Pieces::Estimated { pieces: later * (whole / time).powf(power), power, time });
        }
        found = Some((time, pieces));
    }
    Err(Error::TooManyPieces { limit: MOST_COUNTED, time: 0.0 })
}

/// Runs `explain`: the effects of the chain, and the wave pieces that its run takes.
pub(crate) fn explain(scene: &ChainScene, numbers: Numbers, destinations: &[Destination]) -> Result<(), Failure> {
    let effects = scene.effects();
    let foreseen = foreseen(&scene.chain);
    let cost = match &foreseen {
        Ok(Pieces::Counted(pieces)) => format!("{pieces} wave pieces up to t = {}", scene.chain.until()),
        Ok(Pieces::Estimated { pieces, power, time }) => format!(
            "about {pieces:.1e} wave pieces up to t = {}, of which a run may have {}: they grow like t^{power:.1} \
             up to t = {time:.4}",
            scene.chain.until(),
            scene.chain.max_pieces()
        ),
        Err(error) => error.to_string(),
    };
    let counted = match foreseen {
        Ok(Pieces::Counted(pieces)) => json!(pieces),
        Ok(Pieces::Estimated { pieces, .. }) => json!(pieces.round()),
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
