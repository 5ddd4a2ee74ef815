//! A history: events, contacts, flights, the stress at the ground, and the end.

use serde_json::{Value, json};

use super::dataset::{Cell, Column, Dataset};
use super::outline::sparkline;
use super::record::{Finished, Head, Record};
use super::straight::straight;
use super::writer::{objects, table, table_digits};
use crate::motion::{Ending, Event, StressPiece};
use crate::number::{DOUBLE_DIGITS, Scalar, bound_json, number_json, show, shown_bound_text};
use crate::quantity::{Measure, Units};

/// A quantity of a list.
#[derive(Clone, Copy)]
pub(super) struct Listed {
    /// The head in a table; empty where tables leave it out.
    head: &'static str,
    /// The name in CSV; empty where it is left out.
    name: &'static str,
    /// The key in JSON; empty where it is left out.
    key: &'static str,
    /// What it measures; `None` for a ratio.
    pub(super) measure: Option<Measure>,
}

impl Listed {
    const fn new(head: &'static str, name: &'static str, key: &'static str, measure: Measure) -> Self {
        Listed { head, name, key, measure: Some(measure) }
    }

    /// A quantity whose head is its name.
    pub(super) const fn value(name: &'static str, key: &'static str, measure: Measure) -> Self {
        Listed::new(name, name, key, measure)
    }

    const fn ratio(head: &'static str, name: &'static str, key: &'static str) -> Self {
        Listed { head, name, key, measure: None }
    }

    /// Whether it is there: stress and force are with a material only.
    fn is_present(&self, units: &Units) -> bool {
        units.has_material() || !matches!(self.measure, Some(Measure::Stress | Measure::Force))
    }

    fn column(&self, units: &Units) -> Column {
        let unit = self.measure.map_or("", |measure| units.name(measure));
        Column::placed([self.head, self.name, self.key]).with_unit(unit).bounded()
    }

    /// What turns the numbers of a history into its own, where they are not the same.
    fn factor<S: Scalar>(&self, units: &Units, number: &S) -> Option<S> {
        let kept = |measure| matches!(measure, Measure::Time | Measure::Length | Measure::Velocity | Measure::Strain);
        let measure = self.measure.filter(|measure| units.has_material() && !kept(*measure))?;
        units.factor(measure, &number.precision())
    }
}

/// The columns of the quantities that these units have, and the rows of their values, each of which has a value for
/// every quantity.
pub(super) fn listed<'a, S: Scalar>(
    entries: &[Listed],
    units: &Units,
    rows: impl Iterator<Item = Vec<Option<&'a S>>>,
) -> (Vec<Column>, Vec<Vec<Cell>>) {
    let mut factors: Vec<Option<S>> = Vec::new();
    let rows = rows.map(|values| {
        if let (true, Some(number)) = (factors.is_empty(), values.iter().flatten().next()) {
            factors = entries.iter().map(|entry| entry.factor(units, *number)).collect();
        }
        let present = entries.iter().zip(values).enumerate().filter(|(_, (entry, _))| entry.is_present(units));
        let cell = |(k, (_, value)): (usize, (&Listed, Option<&S>))| match (value, factors.get(k)) {
            (Some(value), Some(Some(factor))) => Cell::number(&(value.clone() * factor)),
            (value, _) => Cell::optional(value),
        };
        present.map(cell).collect()
    });
    let rows = rows.collect();
    (entries.iter().filter(|entry| entry.is_present(units)).map(|entry| entry.column(units)).collect(), rows)
}

const EVENT: [Listed; 4] = [
    Listed::value("time", "time", Measure::Time),
    Listed::new("v_t(0,t)", "end_velocity", "end_velocity", Measure::Velocity),
    Listed::new("h", "centre", "centre", Measure::Length),
    Listed::new("h′", "centre_velocity", "centre_velocity", Measure::Velocity),
];

const CONTACT: [Listed; 13] = [
    Listed::new("contact from", "from", "from", Measure::Time),
    Listed::value("to", "to", Measure::Time),
    Listed::value("impulse", "impulse", Measure::Impulse),
    Listed::new("peak v_x(0,t)", "peak_strain", "peak_strain", Measure::Strain),
    Listed::new("peak stress", "peak_stress", "peak_stress", Measure::Stress),
    Listed::new("peak force", "peak_force", "peak_force", Measure::Force),
    Listed::ratio("e_P", "restitution_momentum", "restitution/momentum"),
    Listed::ratio("e_E²", "restitution_energy_squared", "restitution/energy_squared"),
    Listed::ratio("", "", "restitution/translational_part"),
    Listed::ratio("", "", "restitution/energy_kept"),
    Listed::new("E", "total", "energy/total", Measure::Energy),
    Listed::new("E_h", "translational", "energy/translational", Measure::Energy),
    Listed::new("E_z", "vibrational", "energy/vibrational", Measure::Energy),
];

const FLIGHT: [Listed; 4] = [
    Listed::new("flight from", "", "from", Measure::Time),
    Listed::new("", "", "to", Measure::Time),
    Listed::new("highest at", "", "highest/time", Measure::Time),
    Listed::new("h_max", "", "highest/centre", Measure::Length),
];

const PIECE: [Listed; 6] = [
    Listed::new("", "from", "from", Measure::Time),
    Listed::new("", "to", "to", Measure::Time),
    Listed::new("", "strain_from", "strain_from", Measure::Strain),
    Listed::new("", "strain_to", "strain_to", Measure::Strain),
    Listed::new("", "stress_from", "", Measure::Stress),
    Listed::new("", "stress_to", "", Measure::Stress),
];

/// The part of a history that a CSV file holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
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

fn dataset((columns, rows): (Vec<Column>, Vec<Vec<Cell>>), head: &Head) -> Dataset {
    Dataset { columns, rows, digits: head.digits, keys: (!head.wide).then_some(1), ..Dataset::default() }
}

fn events<S: Scalar>(record: &Record<S>, head: &Head) -> Dataset {
    let rows = record.events.iter().map(|event| event.numbers().map(Some).to_vec());
    let mut data = dataset(listed(&EVENT, &head.units, rows), head);
    let is_uncertain = |event: &Event<S>| event.time.ends(1).is_none() && event.time.log2_error().is_finite();
    let uncertain = record.events.iter().any(is_uncertain);
    data.columns.insert(0, Column::new("kind").headed("event").text());
    if uncertain {
        data.columns.insert(2, Column::table("±"));
    }
    for (row, event) in data.rows.iter_mut().zip(&record.events) {
        row.insert(0, event.kind.to_string().into());
        if uncertain {
            row.insert(2, shown_bound_text(&event.time, table_digits(head.digits)).into());
        }
    }
    data
}

fn contacts<S: Scalar>(record: &Record<S>, head: &Head) -> Dataset {
    let rows = record.contacts.iter().map(|finished| {
        let Finished { contact, restitution, shares, energy } = finished;
        let (energy, peak) = (energy.as_ref(), Some(&contact.peak_strain));
        vec![
            Some(&contact.from),
            contact.to.as_ref(),
            Some(&contact.impulse),
            peak,
            peak,
            peak,
            restitution.momentum.as_ref().ok(),
            restitution.energy_squared.as_ref().ok(),
            shares.translational.as_ref(),
            shares.kept.as_ref(),
            energy.map(|e| &e.total),
            energy.map(|e| &e.translational),
            energy.map(|e| &e.vibrational),
        ]
    });
    let mut data = dataset(listed(&CONTACT, &head.units, rows), head);
    let undefined = ["momentum", "energy_squared"].map(|name| format!("restitution/undefined/{name}"));
    data.columns.extend(undefined.map(|key| Column::json(key).optional()));
    for (row, finished) in data.rows.iter_mut().zip(&record.contacts) {
        row.extend(finished.undefined().map(|reason| reason.map(ToString::to_string).into()));
    }
    data
}

fn flights<S: Scalar>(record: &Record<S>, head: &Head) -> Dataset {
    let rows = record.flights.iter().map(|flight| {
        let highest = flight.highest.as_ref();
        vec![Some(&flight.from), flight.to.as_ref(), highest.map(|top| &top.0), highest.map(|top| &top.1)]
    });
    dataset(listed(&FLIGHT, &head.units, rows), head)
}

fn pieces<S: Scalar>(pieces: &[StressPiece<S>], coefficients: bool, head: &Head) -> Dataset {
    let rows = pieces
        .iter()
        .map(|piece| [&piece.from, &piece.to, &piece.left, &piece.right, &piece.left, &piece.right].map(Some).to_vec());
    let mut data = dataset(listed(&PIECE, &head.units, rows), head);
    if coefficients {
        data.columns.push(Column::data("chebyshev").bounded().optional());
        for (row, piece) in data.rows.iter_mut().zip(pieces) {
            row.push(Cell::numbers(&piece.chebyshev));
        }
    }
    data
}

/// The whole history, schema 1.
pub(crate) fn history_json<S: Scalar>(record: &Record<S>, head: &Head) -> Value {
    let mut contacts = objects(&contacts(record, head));
    let mut flights = objects(&flights(record, head));
    // An object of values that there are not is none.
    for (list, key, value) in [(&mut contacts, "energy", "total"), (&mut flights, "highest", "time")] {
        list.iter_mut().filter(|row| row[key][value].is_null()).for_each(|row| row[key] = Value::Null);
    }
    json!({
        "schema": 1,
        "title": head.title,
        "number": head.number,
        "effects": head.effects,
        "units": units_json(&head.units),
        "exact_until": head.exact_until_json(),
        "events": objects(&events(record, head)),
        "contacts": contacts,
        "flights": flights,
        "stress": {"pieces": objects(&pieces(&record.stress, true, head))},
        "end": end_json(record, head),
        "error_estimate": record.error,
        "digits_lost": record.lost.map(|(_, digits)| digits),
        "warnings": head.warning_texts(),
    })
}

fn end_json<S: Scalar>(Record { end: (time, ending), .. }: &Record<S>, head: &Head) -> Value {
    let mut value = json!({
        "time": number_json(time, head.digits),
        "reason": if let Ending::ExactnessEnds { .. } = ending { "exactness ends".into() } else { ending.to_string() },
        "uncertainty": {"time": bound_json(time, head.digits)},
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

/// One part of the history; the stress in straight pieces, or with the `coefficients` of its Chebyshev series.
pub(crate) fn history_part<S: Scalar>(record: &Record<S>, part: Part, coefficients: bool, head: &Head) -> Dataset {
    let mut data = match part {
        Part::Events => events(record, head),
        Part::Contacts => contacts(record, head),
        Part::Stress if coefficients => pieces(&record.stress, true, head),
        Part::Stress => pieces(&straight(&record.stress, STRAIGHT), false, head),
    };
    data.notes = head.notes();
    if !matches!(record.end.1, Ending::Time | Ending::NextImpact) {
        let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
        data.notes.push(record.end.1.at(&show(&record.end.0, digits)));
    }
    if part == Part::Stress && coefficients {
        let series = "the sum of chebyshev[k] T_k(x), x = 2(t - from)/(to - from) - 1";
        data.notes.push(format!("v_x(0,t) is linear from strain_from to strain_to, or {series}"));
    } else if part == Part::Stress && record.stress.iter().any(|piece| piece.chebyshev.len() > 2) {
        data.notes.push(format!(
            "straight lines from strain_from to strain_to are within {STRAIGHT:e} of the greatest v_x(0,t); the \
             coefficients give the exact form"
        ));
    }
    data
}

/// What the symbols of the tables mean.
pub const LEGEND: &str = "\
time           t, from the first touch or, where there is a gap, from before it
v_t(0,t)       velocity of the end, just before an impact, just after a release
h, h′          the centre of mass above that of the undeformed rod, and its rate
±              how far the time may be off as it is printed
impulse        −E S ∫ v_x(0,t) dt over the contact; per ρS −c² ∫ v_x(0,t) dt
peak v_x(0,t)  the most compressive strain at the ground
peak stress    E v_x(0,t) there, below zero
peak force     −E S v_x(0,t) there: the force of the ground, above zero
e_P            −P(to)/P(from), P = ρSL h′; below zero if h falls at the end
e_E²           E_h(to)/E_h(from): above 1 where the vibration gives energy back
E, E_h, E_z    energy at the end of the contact, of the centre, of the vibration
highest at     when the centre of mass is highest in a flight; h_max is its h
per ρS         divided by the linear density, known with a material only
c              wave speed
t₁ = 2L/c      round trip of a wave
R = r t₁       damping ratio: from π on an undriven rod never bounces
M = μ/(g t₁)   speed ratio: from 1 on an undamped rod bounces after t₁ exactly
";

/// The whole history but for the stress: head, events, contacts, flights, end.
pub(crate) fn history_table<S: Scalar>(record: &Record<S>, head: &Head) -> String {
    let show = |x: &S| show(x, table_digits(head.digits));
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
        let peaks = record.contacts.iter().map(|finished| finished.contact.peak_strain.to_f64());
        out += &sparkline(&record.outline, record.end.0.to_f64(), peaks.fold(0.0, f64::min), head);
    }
    out += &format!("{}\n\n{}\n\n", table(&events(record, head)), table(&contacts(record, head)));
    if !record.contacts.is_empty() {
        let measures = [Measure::Impulse, Measure::Stress, Measure::Force, Measure::Energy];
        out += &named_units(&measures, &head.units);
    }
    for finished in &record.contacts {
        let from = show(&finished.contact.from);
        let mut reasons = finished.undefined().to_vec();
        reasons.dedup();
        for reason in reasons.into_iter().flatten() {
            out += &head.line(&format!("contact from {from}: {reason}"));
        }
    }
    let mut flights = flights(record, head);
    flights.rows.retain(|row| !row[2].is_empty());
    if !flights.rows.is_empty() {
        out += &format!("\n{}\n", table(&flights));
    }
    out += &format!("\n{}", head.line(&record.end.1.at(&show(&record.end.0))));
    if let Some((impacts, lost)) = record.lost
        && lost >= MANY_LOST
    {
        out += &format!("{impacts} impacts may have lost {lost:.1} of the digits carried, none of those printed\n");
    }
    out + &head.warning_lines()
}

/// Below so many digits lost the table does not mention them.
const MANY_LOST: f64 = 3.0;

/// The units of what the scene's own do not tell, in a line: `impulse in N s, energies in J`.
pub(super) fn named_units(measures: &[Measure], units: &Units) -> String {
    let word = |measure: &Measure| match measure {
        Measure::Impulse => Some("impulse"),
        Measure::Stress => Some("stress").filter(|_| units.has_material()),
        Measure::Force => Some("force").filter(|_| units.has_material()),
        Measure::Energy => Some("energies"),
        Measure::Time | Measure::Length | Measure::Velocity | Measure::Strain => None,
    };
    let known = measures.iter().filter_map(|measure| Some((word(measure)?, units.name(*measure))));
    let mut texts: Vec<String> = known
        .map(|(word, unit)| match unit {
            "" => format!("{word} in the units of the scene"),
            unit if unit.starts_with("per") => format!("{word} {unit}"),
            unit => format!("{word} in {unit}"),
        })
        .collect();
    texts.dedup();
    if texts.is_empty() { String::new() } else { texts.join(", ") + "\n" }
}
