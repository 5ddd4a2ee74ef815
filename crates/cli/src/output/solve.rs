//! A history: events, contacts, flights, the stress at the ground, and the end.

use std::rc::Rc;

use serde_json::{Value, json};

use super::dataset::{Cell, Column, Dataset};
use super::derivatives::{self, add_columns};
use super::outline::sparkline;
use super::record::{Derived, Head, Record};
use super::table::table_digits;
use dalembert::Error;
use dalembert::engine::{Motion, straight};
use dalembert::number::{DOUBLE_DIGITS, Scalar};
use dalembert::quantity::Quantity::{self, *};
use dalembert::quantity::{Measure, Needs, Row, Table, Undefined, Units, rows};
use dalembert::{Ending, StressPiece};

/// The column of a quantity of an event, a contact, a flight or a piece of the stress.
fn column(quantity: Quantity) -> Column {
    let name = quantity.name();
    match quantity {
        EventTime => Column::new(name).headed("time"),
        Duration | ImpactVelocity | ReleaseVelocity | TranslationalShare | EnergyKept | Landing => Column::data(name),
        _ if quantity.needs() == Needs::Piece => Column::data(name),
        _ => Column::new(name).headed(quantity.symbol()),
    }
}

/// The columns of the quantities that these units have, and the rows of their numbers, each with one for every
/// quantity, as a history answers them.
pub(super) fn listed<S: Scalar>(
    history: &dyn Motion<S>,
    quantities: &[Quantity],
    column: &dyn Fn(Quantity) -> Column,
    head: &Head,
    rows: &[Vec<Option<&S>>],
) -> Dataset {
    let units = &head.units;
    let mut data =
        Dataset { rows: rows.iter().map(|_| Vec::new()).collect(), digits: head.digits, ..Dataset::default() };
    data.keys = (!head.wide).then_some(1);
    let present = |(_, quantity): &(usize, &Quantity)| quantity.is_listed(units.has_material());
    for (k, quantity) in quantities.iter().enumerate().filter(present) {
        let factor = quantity.factor(&history.scales(), units);
        for (cells, values) in data.rows.iter_mut().zip(rows) {
            cells.push(match (values[k], &factor) {
                (Some(value), Some(factor)) => Cell::number(&(value.clone() * factor)),
                (value, _) => Cell::optional(value),
            });
        }
        let unit = quantity.measure().map_or("", |measure| units.name(measure));
        data.columns.push(column(*quantity).with_unit(unit).bounded());
    }
    data
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Part {
    /// Impacts and releases.
    #[default]
    Events,
    /// Contacts.
    Contacts,
    /// The stress at the ground in straight pieces.
    Stress,
}

/// How far the straight pieces of a curved stress history may be off, as a part of its peak.
const STRAIGHT: f64 = 1e-6;

impl Record {
    pub(crate) fn add(&mut self, derived: Derived) {
        add_columns(&mut self.events, Table::Events.quantities(), (derived.by, &derived.events));
        add_columns(&mut self.contacts, Table::Contacts.quantities(), (derived.by, &derived.contacts));
        self.derivatives.push(derived);
    }
}

/// Why `e_P` and `e_E²` of a contact are not defined, where they are not.
fn undefined_ratios<S>(contact: &Row<S>) -> [Option<Undefined>; 2] {
    RATIOS.map(|ratio| contact.get(place(ratio))?.as_ref().err().copied())
}

/// The quantities of a contact whose reason is told where they are not defined.
const RATIOS: [Quantity; 2] = [MomentumRestitution, EnergyRestitution];

/// The place of a quantity among those of a contact.
fn place(quantity: Quantity) -> usize {
    Table::Contacts.quantities().iter().position(|known| *known == quantity).unwrap_or(0)
}

fn pieces<S: Scalar>(history: &dyn Motion<S>, pieces: &[StressPiece<S>], head: &Head) -> Dataset {
    let rows = pieces
        .iter()
        .map(|StressPiece { start: from, end: to, strain_start: left, strain_end: right, .. }| {
            vec![Some(from), Some(to), Some(left), Some(right), Some(left), Some(right)]
        })
        .collect::<Vec<_>>();
    listed(history, Table::Stress.quantities(), &column, head, &rows)
}

/// The stress at the ground, as it is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Straight,
    /// With the coefficients of its Chebyshev series.
    Series,
}

/// Gathers what is printed of `history`, with its numbers, with or without those that are ratios of others. The stress
/// at the ground only if asked for, as it can cost more than all the rest.
pub(crate) fn record<S: Scalar>(
    history: &dyn Motion<S>,
    stress: Option<Form>,
    ratios: bool,
    head: &Head,
) -> Result<(Record, Vec<S>), Error> {
    let mut numbers = vec![history.end()];
    let mut gather = |quantities: &[Quantity]| {
        let rows = rows(history, quantities)?;
        for row in &rows {
            for (value, quantity) in row.iter().zip(quantities) {
                if let Ok(value) = value
                    && (ratios || quantity.measure().is_some())
                {
                    numbers.push(value.clone());
                }
            }
        }
        let defined =
            rows.iter().map(|row| row.iter().map(|value| value.as_ref().ok()).collect::<Vec<_>>()).collect::<Vec<_>>();
        Ok::<_, Error>((listed(history, quantities, &column, head, &defined), rows))
    };
    let (mut events, _) = gather(Table::Events.quantities())?;
    let (mut contacts, ends) = gather(Table::Contacts.quantities())?;
    let (flights, _) = gather(Table::Flights.quantities())?;
    let known = |time: &S| time.ends(1).is_none() && time.log2_error().is_finite();
    let uncertain = history.events().iter().any(|event| known(&event.t));
    events.columns.insert(0, Column::new("kind").headed("event").text());
    events.columns.splice(2..2, uncertain.then(|| Column::table("±")));
    for (row, event) in events.rows.iter_mut().zip(history.events()) {
        row.insert(0, event.kind.to_string().into());
        let bound = row[1].bound(table_digits(head.digits));
        row.splice(2..2, uncertain.then_some(bound));
    }
    let undefined = ends.iter().map(undefined_ratios).collect::<Vec<_>>();
    let keys = RATIOS.map(|ratio| format!("undefined/{}", ratio.name()));
    contacts.columns.extend(keys.map(|key| Column::json(key).optional()));
    for (row, undefined) in contacts.rows.iter_mut().zip(&undefined) {
        row.extend(undefined.map(|reason| reason.map(|reason| reason.to_string()).into()));
    }
    let curve = if stress.is_some() { history.stress_pieces() } else { Vec::new() };
    for number in StressPiece::numbers(&curve) {
        numbers.push(number.clone());
    }
    let stress = if stress == Some(Form::Straight) {
        pieces(history, &straight(&curve, STRAIGHT), head)
    } else {
        let mut stress = pieces(history, &curve, head);
        stress.columns.push(Column::data("chebyshev").bounded().optional());
        for (row, piece) in stress.rows.iter_mut().zip(&curve) {
            row.push(Cell::numbers(&piece.chebyshev));
        }
        stress
    };
    let record = Record {
        events,
        contacts,
        undefined,
        flights,
        derivatives: Vec::new(),
        stress,
        curved: curve.iter().any(|piece| piece.chebyshev.len() > 2),
        outline: Vec::new(),
        end: (Rc::new(history.end()), history.ending().clone()),
        error: history.error_estimate().to_f64(),
        lost: history.digits_lost(),
    };
    Ok((record, numbers))
}

/// The whole history, schema 1.
pub(crate) fn history_json(record: &Record, head: &Head) -> Value {
    json!({
        "schema": 1,
        "title": head.title,
        "number": head.number,
        "effects": head.effects,
        "units": units_json(&head.units),
        "exact_until": head.exact_until_json(),
        "events": record.events.objects(),
        "contacts": record.contacts.objects(),
        "flights": record.flights.objects(),
        "stress": {"pieces": record.stress.objects()},
        "end": end_json(record, head),
        "error_estimate": record.error,
        "digits_lost": record.lost.map(|(_, digits)| digits),
        "warnings": head.warning_texts(),
    })
}

fn end_json(Record { end: (time, ending), .. }: &Record, head: &Head) -> Value {
    let mut value = json!({
        "t": time.json(head.digits),
        "reason": if let Ending::ExactnessEnds { .. } = ending { "exactness ends".into() } else { ending.to_string() },
        "uncertainty": {"t": time.json_bound(head.digits)},
    });
    if let Ending::ExactnessEnds { kind, time, near } = ending {
        value["event"] = json!(kind);
        value["surd"] = json!(time);
        value["near"] = json!(near);
    }
    value
}

/// The name of each unit, null where it is not known; impulse and energy are per `ρS` without a material.
pub(super) fn units_json(units: &Units) -> Value {
    use Measure::{Energy, Force, Impulse, Length, Stress, Time, Velocity};
    let measures = [Time, Length, Velocity, Stress, Force, Impulse, Energy];
    let name = |measure: Measure| Some(units.name(measure)).filter(|name| !name.is_empty());
    let names = measures.map(|measure| (measure.name().to_string(), json!(name(measure))));
    Value::Object(names.into_iter().collect())
}

/// One part of the history; the stress with the `coefficients` of its Chebyshev series, or in straight pieces.
pub(crate) fn history_part(record: Record, part: Part, coefficients: bool, head: &Head) -> Dataset {
    let mut data = match part {
        Part::Events => record.events,
        Part::Contacts => record.contacts,
        Part::Stress => record.stress,
    };
    data.notes = head.notes();
    if !matches!(record.end.1, Ending::Time | Ending::NextImpact) {
        let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
        data.notes.push(record.end.1.at(&record.end.0.printed(digits)));
    }
    if part == Part::Stress && coefficients {
        let series = "the sum of chebyshev[k] T_k(x), x = 2(t - start)/(end - start) - 1";
        data.notes.push(format!("v_x(0,t) is linear from strain_start to strain_end, or {series}"));
    } else if part == Part::Stress && record.curved {
        data.notes.push(format!(
            "straight lines from strain_start to strain_end are within {STRAIGHT:e} of the greatest v_x(0,t); the \
             coefficients give the exact form"
        ));
    }
    data
}

pub(crate) const LEGEND: &str = "\
time           t, from the first touch or, where there is a gap, from before it
v_t(0,t)       velocity of the end, just before an impact, just after a release
h, h′          the centre of mass above that of the undeformed rod, and its rate
±              how far the time may be off as it is printed
impulse        −E S ∫ v_x(0,t) dt over the contact; per ρS −c² ∫ v_x(0,t) dt
peak v_x(0,t)  the most compressive strain at the ground
peak stress    E v_x(0,t) there, below zero
peak force     −E S v_x(0,t) there: the force of the ground, above zero
e_P            −P(release)/P(impact), P = ρSL h′; below zero if h falls then
e_E²           E_h(release)/E_h(impact): above 1 if the vibration gives energy back
E, E_h, E_z    energy at the end of the contact, of the centre, of the vibration
highest at     when the centre of mass is highest in a flight; h_max is its h
per ρS         divided by the linear density, known with a material only
c              wave speed
t₁ = 2L/c      round trip of a wave
R = r t₁       damping ratio: from π on an undriven rod never bounces
M = μ/(g t₁)   speed ratio: from 1 on an undamped rod bounces after t₁ exactly
";

/// The whole history but for the stress: head, events, contacts, flights, end.
pub(crate) fn history_table(mut record: Record, head: &Head) -> String {
    let digits = table_digits(head.digits);
    let mut out = String::new();
    if let Some(title) = &head.title {
        out += &head.line(title);
    }
    out += &head.line(&format!("numbers: {}    effects: {}", head.number, head.effects.join(", ")));
    out += &head.line(&head.parameters);
    if let Some(ending) = &head.exact_until {
        out += &head.line(&ending.to_string());
    }
    out += "\n";
    if !record.outline.is_empty() {
        let peaks = record.contacts.rows.iter().map(|contact| contact[place(PeakStrain)].double());
        out += &sparkline(&record.outline, record.end.0.double(), peaks.fold(0.0, f64::min), head);
    }
    out += &format!("{}\n\n{}\n\n", record.events.table(), record.contacts.table());
    if !record.undefined.is_empty() {
        let measures = [Measure::Impulse, Measure::Stress, Measure::Force, Measure::Energy];
        out += &named_units(&measures, &head.units);
    }
    for (contact, reasons) in record.contacts.rows.iter().zip(&record.undefined) {
        let from = contact[0].text(digits, "");
        let mut reasons = reasons.to_vec();
        reasons.dedup();
        for reason in reasons.into_iter().flatten() {
            out += &head.line(&format!("contact from {from}: {reason}"));
        }
    }
    record.flights.rows.retain(|row| !row[2].is_empty());
    if !record.flights.rows.is_empty() {
        out += &format!("\n{}\n", record.flights.table());
    }
    out += &derivative_tables(&record, head);
    out += &format!("\n{}", head.line(&record.end.1.at(&record.end.0.printed(digits))));
    if let Some((impacts, lost)) = record.lost
        && lost >= MANY_LOST
    {
        out += &format!("{impacts} impacts may have lost {lost:.1} of the digits carried, none of those printed\n");
    }
    out + &head.warning_lines()
}

/// The derivatives of events and contacts, a table of each for each value.
fn derivative_tables(record: &Record, head: &Head) -> String {
    let text = |cell: &Cell| cell.text(table_digits(head.digits), "");
    let event = |row: &Vec<Cell>| format!("{} at {}", text(&row[0]), text(&row[1]));
    let contact = |row: &Vec<Cell>| format!("contact from {}", text(&row[0]));
    let symbols = |quantities: &[Quantity]| -> Vec<(usize, &'static str)> {
        let shown = |(k, quantity): (usize, &Quantity)| {
            let listed = column(*quantity).head.is_some() && quantity.is_listed(head.units.has_material());
            listed.then(|| (k, quantity.symbol()))
        };
        quantities.iter().enumerate().filter_map(shown).collect()
    };
    let mut out = String::new();
    for Derived { by, events, contacts } in &record.derivatives {
        let keys = record.events.rows.iter().map(event).collect();
        out += &derivatives::table(("derivatives", keys), &symbols(Table::Events.quantities()), (*by, events), head);
        // When a contact begins and ends is in the table above.
        let keys = record.contacts.rows.iter().map(contact).collect();
        let symbols: Vec<_> = symbols(Table::Contacts.quantities()).into_iter().skip(2).collect();
        out += &derivatives::table(("derivatives", keys), &symbols, (*by, contacts), head);
    }
    out
}

/// Below so many digits lost the table does not mention them.
const MANY_LOST: f64 = 3.0;

/// The units of what the scene's own do not tell, in a line: `impulse in N s, energies in J`.
pub(super) fn named_units(measures: &[Measure], units: &Units) -> String {
    let text = |measure: &Measure| {
        let word = match measure {
            Measure::Impulse => "impulse",
            Measure::Energy => "energies",
            Measure::Stress | Measure::Force if units.has_material() => measure.name(),
            _ => return None,
        };
        Some(match units.name(*measure) {
            "" => format!("{word} in the units of the scene"),
            unit if unit.starts_with("per") => format!("{word} {unit}"),
            unit => format!("{word} in {unit}"),
        })
    };
    let mut texts: Vec<String> = measures.iter().filter_map(text).collect();
    texts.dedup();
    if texts.is_empty() { String::new() } else { texts.join(", ") + "\n" }
}
