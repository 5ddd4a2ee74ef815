//! The output of a history: events, contacts, flights, the stress at the ground, and the end.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value as Json, json};

use super::column::Column;
use super::dataset::{Cell, Dataset};
use super::derivatives::{add_derivatives, derivative_table};
use super::outline::sparkline;
use super::run_info::{ExactUntil, RunInfo};
use super::schema_types::{BoundSchema, ContactRow, EventRow, FlightRow, NumberSchema, StressRow};
use super::table::table_digits;
use dalembert::Ending;
use dalembert::Value;
use dalembert::problem::Parameter;
use dalembert::quantity::Quantity::{self, *};
use dalembert::quantity::{Measure, Needs, Table, Undefined};
use dalembert::solve::{Derivatives, History, Listing, Rows, StressForm};
use dalembert_compare::SchemaVersion;

/// The coefficients of a contact that may be undefined.
const RATIOS: [Quantity; 2] = [MomentumRestitution, EnergyRestitution];

/// Returns the column of a quantity of an event, a contact, a flight or a piece of the stress.
fn column(quantity: Quantity) -> Column {
    let name = quantity.name();
    match quantity {
        EventTime => Column::new(name).headed("time"),
        Duration | ImpactVelocity | ReleaseVelocity | TranslationalShare | EnergyKept | Landing => Column::data(name),
        _ if quantity.needs() == Needs::Piece => Column::data(name),
        _ => Column::new(name).headed(quantity.symbol()),
    }
}

/// Returns the columns of the quantities that exist in the units of a run, with their rows.
fn listed(quantities: &[Quantity], rows: Rows, info: &RunInfo) -> Dataset {
    let is_listed = |quantity: &Quantity| quantity.is_listed(info.units.has_material());
    let unit = |quantity: Quantity| quantity.measure().map_or("", |measure| info.units.name(measure));
    let column = |quantity: &Quantity| column(*quantity).with_unit(unit(*quantity)).bounded();
    let cells = |row: Vec<Result<Value, Undefined>>| {
        let values = row.into_iter().zip(quantities).filter(|(_, quantity)| is_listed(quantity));
        values.map(|(value, _)| Cell::number(value.ok())).collect()
    };
    Dataset {
        columns: quantities.iter().filter(|quantity| is_listed(quantity)).map(column).collect(),
        rows: rows.into_iter().map(cells).collect(),
        digits: info.digits,
        keys: (!info.wide).then_some(1),
        ..Dataset::default()
    }
}

/// A part of a history, written as CSV.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum HistoryPart {
    /// Impacts and releases
    #[default]
    Events,
    /// Contacts
    Contacts,
    /// The stress at the ground in straight pieces
    Stress,
    /// The forces at the nodes of a chain, in pieces
    Forces,
}

/// The number that the coefficients of a piece stand for.
pub(crate) const SERIES: &str = "the sum of chebyshev[k] T_k(x), x = 2(t - start)/(end - start) - 1";

/// Largest error of the straight pieces of a curved stress history, as a share of its peak.
pub(crate) const STRAIGHT_ERROR: f64 = 1e-6;

/// The derivatives of events and contacts by one value of the scene.
struct HistoryDerivatives {
    by: Parameter,
    events: Derivatives<Value>,
    contacts: Derivatives<Value>,
}

/// A history as tables.
pub(crate) struct HistoryTables {
    events: Dataset,
    /// Contacts with their coefficients and the energies at their ends.
    contacts: Dataset,
    /// The reasons why `e_P` and `e_E²` of each contact are not defined.
    undefined: Vec<[Option<Undefined>; 2]>,
    flights: Dataset,
    derivatives: Vec<HistoryDerivatives>,
    /// The stress at the ground, if it is requested.
    stress: Dataset,
    is_curved: bool,
    /// The stress at the ground in equal parts of the history, if a line of blocks shows it.
    pub(crate) outline: Vec<f64>,
    /// The last time that is known.
    end: Value,
    ending: Ending,
    /// Bound of the error relative to the natural scales; zero where all is exact.
    error: f64,
    /// Number of impacts, and digits that rounding may have taken over them; `None` where that is not followed.
    lost: Option<(u32, f64)>,
}

/// Returns the reasons why `e_P` and `e_E²` of a contact are not defined.
fn undefined_ratios(contact: &[Result<Value, Undefined>]) -> [Option<Undefined>; 2] {
    RATIOS.map(|ratio| {
        let place = Table::Contacts.quantities().iter().position(|quantity| *quantity == ratio)?;
        contact.get(place)?.as_ref().err().copied()
    })
}

impl HistoryTables {
    /// Returns the tables of a history and its lists, whose stress has this form.
    pub(crate) fn new(history: &History, listing: Listing, stress: Option<StressForm>, info: &RunInfo) -> Self {
        let has_series = stress == Some(StressForm::Series);
        let undefined: Vec<_> = listing.contacts.iter().map(|contact| undefined_ratios(contact)).collect();
        let mut events = listed(Table::Events.quantities(), listing.events, info);
        let has_bound = |row: &Vec<Cell>| match &row[0] {
            Cell::Number(time) => time.ends().is_none() && time.log2_error().is_finite(),
            _ => false,
        };
        let is_uncertain = events.rows.iter().any(has_bound);
        events.columns.insert(0, Column::new("kind").headed("event").text());
        events.columns.splice(2..2, is_uncertain.then(|| Column::table("±")));
        for (row, kind) in events.rows.iter_mut().zip(&listing.kinds) {
            let bound = row[0].bound_text(table_digits(info.digits));
            row.insert(0, kind.to_string().into());
            row.splice(2..2, is_uncertain.then_some(bound.into()));
        }
        let mut contacts = listed(Table::Contacts.quantities(), listing.contacts, info);
        let keys = RATIOS.map(|ratio| format!("undefined/{ratio}"));
        contacts.columns.extend(keys.map(|key| Column::json(key).optional()));
        for (row, undefined) in contacts.rows.iter_mut().zip(&undefined) {
            row.extend(undefined.map(|reason| reason.map(|reason| reason.to_string()).into()));
        }
        let mut stress = listed(Table::Stress.quantities(), listing.pieces, info);
        stress.columns.extend(has_series.then(|| Column::data("chebyshev").bounded().optional()));
        for (row, piece) in stress.rows.iter_mut().zip(listing.stress).filter(|_| has_series) {
            row.push(Cell::Numbers(piece.chebyshev));
        }
        HistoryTables {
            events,
            contacts,
            undefined,
            flights: listed(Table::Flights.quantities(), listing.flights, info),
            derivatives: Vec::new(),
            stress,
            is_curved: listing.is_curved,
            outline: Vec::new(),
            end: history.end(),
            ending: history.ending().clone(),
            error: history.error_estimate(),
            lost: history.digits_lost(),
        }
    }

    /// Adds the derivatives of events and contacts by a value of the scene.
    pub(crate) fn add_derivatives(&mut self, by: Parameter, events: Derivatives<Value>, contacts: Derivatives<Value>) {
        add_derivatives(&mut self.events, Table::Events.quantities(), (by, &events));
        add_derivatives(&mut self.contacts, Table::Contacts.quantities(), (by, &contacts));
        self.derivatives.push(HistoryDerivatives { by, events, contacts });
    }

    /// Returns the whole history as JSON, schema 1.
    pub(crate) fn json(&self, info: &RunInfo) -> Json {
        json!(HistoryJson {
            schema: SchemaVersion,
            title: info.title.as_deref(),
            number: &info.number,
            effects: &info.effects,
            units: info.units_json(),
            exact_until: info.exact_until_json(),
            events: self.events.objects(),
            contacts: self.contacts.objects(),
            flights: self.flights.objects(),
            stress: StressJson { pieces: self.stress.objects() },
            end: self.end_json(),
            error_estimate: self.error,
            digits_lost: self.lost.map(|(_, digits)| digits),
            warnings: info.warning_texts(),
        })
    }

    fn end_json(&self) -> EndJson<'_> {
        let exact_until = ExactUntil::new(&self.ending);
        let reason = if exact_until.is_some() { "exactness ends".into() } else { self.ending.to_string() };
        let bound = Cell::Number(self.end.clone()).bound_json();
        EndJson { t: &self.end, reason, uncertainty: TimeBound { t: bound }, exact_until }
    }

    /// Returns one part of the history; the stress with the `coefficients` of its Chebyshev series, or in straight
    /// pieces.
    pub(crate) fn part(&self, part: HistoryPart, coefficients: bool, info: &RunInfo) -> Dataset {
        let mut data = match part {
            HistoryPart::Events => self.events.clone(),
            HistoryPart::Contacts => self.contacts.clone(),
            HistoryPart::Stress | HistoryPart::Forces => self.stress.clone(),
        };
        data.notes = info.notes();
        if !matches!(self.ending, Ending::Time | Ending::NextImpact) {
            data.notes.push(self.ending.at(&self.end.to_string()));
        }
        if part == HistoryPart::Stress && coefficients {
            data.notes.push(format!("v_x(0,t) is linear from strain_start to strain_end, or {SERIES}"));
        } else if part == HistoryPart::Stress && self.is_curved {
            data.notes.push(format!(
                "straight lines from strain_start to strain_end are within {STRAIGHT_ERROR:e} of the greatest \
                 v_x(0,t); the coefficients give the exact form"
            ));
        }
        data
    }

    /// Returns the whole history but for the stress as text: facts, events, contacts, flights, end.
    pub(crate) fn table(&self, info: &RunInfo) -> String {
        let digits = table_digits(info.digits);
        let mut out = String::new();
        if let Some(title) = &info.title {
            out += &info.line(title);
        }
        out += &info.line(&format!("numbers: {}    effects: {}", info.number, info.effects.join(", ")));
        out += &info.line(&info.parameters);
        if let Some(end) = &info.exact_until {
            out += &info.line(&end.to_string());
        }
        out += "\n";
        if !self.outline.is_empty() {
            let place = Table::Contacts.quantities().iter().position(|quantity| *quantity == PeakStrain);
            let peaks = self.contacts.rows.iter().filter_map(|contact| Some(contact.get(place?)?.to_f64()));
            out += &sparkline(&self.outline, self.end.to_f64(), peaks.fold(0.0, f64::min), info);
        }
        if self.events.rows.is_empty() {
            out += "no event\n";
        }
        for table in [&self.events, &self.contacts].into_iter().filter(|table| !table.rows.is_empty()) {
            out += &format!("{}\n\n", table.table());
        }
        if !self.undefined.is_empty() {
            out += &info.unit_line(&[Measure::Impulse, Measure::Stress, Measure::Force, Measure::Energy]);
        }
        for (contact, reasons) in self.contacts.rows.iter().zip(&self.undefined) {
            let from = contact[0].text(digits, "");
            let mut reasons = reasons.to_vec();
            reasons.dedup();
            for reason in reasons.into_iter().flatten() {
                out += &info.line(&format!("contact from {from}: {reason}"));
            }
        }
        let mut flights = self.flights.clone();
        flights.rows.retain(|row| !row[2].is_empty());
        if !flights.rows.is_empty() {
            out += &format!("\n{}\n", flights.table());
        }
        out += &self.derivative_tables(info);
        out += &format!("\n{}", info.line(&self.ending.at(&info.text(&self.end))));
        if let Some((impacts, lost)) = self.lost
            && lost >= MANY_LOST
        {
            out += &format!("{impacts} impacts may have lost {lost:.1} of the digits carried, none of those printed\n");
        }
        out + &info.warning_lines()
    }

    /// Returns a table of the derivatives of events and one of contacts for each value of the scene.
    fn derivative_tables(&self, info: &RunInfo) -> String {
        let digits = table_digits(info.digits);
        let text = |cell: &Cell| cell.text(digits, "");
        let event = |row: &Vec<Cell>| format!("{} at {}", text(&row[0]), text(&row[1]));
        let contact = |row: &Vec<Cell>| format!("contact from {}", text(&row[0]));
        let symbols = |quantities: &[Quantity]| -> Vec<(usize, &'static str)> {
            let listed =
                |quantity: &Quantity| column(*quantity).head.is_some() && quantity.is_listed(info.units.has_material());
            let listed = quantities.iter().enumerate().filter(|(_, quantity)| listed(quantity));
            listed.map(|(k, quantity)| (k, quantity.symbol())).collect()
        };
        let table = |labels: Vec<String>, symbols: &[(usize, &str)], by: Parameter, rows: &Derivatives<Value>| {
            derivative_table(("derivatives", labels), symbols, (by, rows), (info.digits, info.wide))
        };
        let mut out = String::new();
        for HistoryDerivatives { by, events, contacts } in &self.derivatives {
            out +=
                &table(self.events.rows.iter().map(event).collect(), &symbols(Table::Events.quantities()), *by, events);
            // The beginning and the end of a contact are events, in the table above.
            out += &table(
                self.contacts.rows.iter().map(contact).collect(),
                &symbols(Table::Contacts.quantities())[2..],
                *by,
                contacts,
            );
        }
        out
    }
}

/// A history as JSON.
#[derive(JsonSchema, Serialize)]
#[schemars(rename = "history")]
pub(super) struct HistoryJson<'a> {
    schema: SchemaVersion,
    title: Option<&'a str>,
    /// The numbers of the answer, in words.
    number: &'a str,
    /// The effects that the scene calls for.
    effects: &'a [&'static str],
    /// The name of the unit of each measure, null where it is not known; "per ρS" where no material is given.
    #[schemars(with = "BTreeMap<String, Option<String>>")]
    units: Map<String, Json>,
    exact_until: Option<ExactUntil>,
    #[schemars(with = "Vec<EventRow>")]
    events: Vec<Json>,
    #[schemars(with = "Vec<ContactRow>")]
    contacts: Vec<Json>,
    #[schemars(with = "Vec<FlightRow>")]
    flights: Vec<Json>,
    stress: StressJson,
    end: EndJson<'a>,
    /// Bound of the error relative to the natural scales; 0 where all is exact or enclosed.
    error_estimate: f64,
    digits_lost: Option<f64>,
    warnings: Vec<String>,
}

/// The stress at the ground.
#[derive(JsonSchema, Serialize)]
struct StressJson {
    /// Pieces of v_x(0,t), linear in time from strain_start to strain_end where there are no Chebyshev coefficients.
    #[schemars(with = "Vec<StressRow>")]
    pieces: Vec<Json>,
}

/// The last time that is known.
#[derive(JsonSchema, Serialize)]
struct EndJson<'a> {
    #[schemars(with = "NumberSchema")]
    t: &'a Value,
    reason: String,
    uncertainty: TimeBound,
    #[serde(flatten)]
    exact_until: Option<ExactUntil>,
}

#[derive(JsonSchema, Serialize)]
struct TimeBound {
    #[schemars(with = "BoundSchema")]
    t: Json,
}

/// Least number of lost digits that the table mentions.
const MANY_LOST: f64 = 3.0;

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
e_E²           E_h(release)/E_h(impact): above 1 if the vibration gives back
E, E_h, E_z    energy at the end of the contact, of the centre, of the vibration
highest at     when the centre of mass is highest in a flight; h_max is its h
per ρS         divided by the linear density, known with a material only
c              wave speed
t₁ = 2L/c      round trip of a wave
R = r t₁       damping ratio: from π on an undriven rod never bounces
M = μ/(g t₁)   speed ratio: from 1 on an undamped rod bounces after t₁ exactly
";
