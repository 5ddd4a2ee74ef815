//! Tables for a person.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};

use super::json::side_name;
use super::record::{Head, Quantity, Record, Sample, Show};
use crate::history::{Ending, EventKind};

/// A table with a header; numbers stand to the right.
pub fn table(header: &[&str], rows: Vec<Vec<String>>, words: usize) -> String {
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING.header_separator(LineStyle::none().fill('─').junction('─')))
        .set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header.to_vec());
    for row in rows {
        table.add_row(row);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        column.set_cell_alignment(if k < words { CellAlignment::Left } else { CellAlignment::Right });
    }
    table.trim_fmt()
}

/// A number in a table: twelve digits of a double, and zero where it is below what rounding leaves of its scale.
fn cell<S: Show>(x: &S, scale: f64, digits: u32) -> String {
    if digits > 0 || S::RIGOROUS {
        return x.show(digits);
    }
    let value = x.to_f64();
    if value.abs() <= 1e-13 * scale {
        return "0".into();
    }
    twelve_digits(value)
}

/// Twelve significant digits, without trailing zeros.
fn twelve_digits(value: f64) -> String {
    let text = format!("{value:.11e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-5..12).contains(&exponent) {
        let places = usize::try_from(11 - exponent).unwrap_or(0);
        let plain = format!("{value:.places$}");
        return if plain.contains('.') { plain.trim_end_matches('0').trim_end_matches('.').into() } else { plain };
    }
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    format!("{mantissa}e{exponent}")
}

/// The whole history but for the stress: head, events, contacts, flights, end.
pub fn history_table<S: Show>(record: &Record<S>, head: &Head) -> String {
    let speed = record.events.iter().map(|e| e.centre_velocity.to_f64().abs()).fold(0.0, f64::max);
    let rise = speed * record.end.0.to_f64().abs();
    let show = |x: &S, scale: f64| cell(x, scale, head.digits);
    let optional = |x: Option<&S>, scale: f64| x.map_or_else(|| "–".to_string(), |x| show(x, scale));
    let mut out = String::new();
    if let Some(title) = &head.title {
        out += &format!("{title}\n");
    }
    out += &format!("numbers: {}    effects: {}\n", head.number, head.effects.join(", "));
    if let Some(ending) = &head.exact_until {
        out += &format!("{ending}\n");
    }
    out += "\n";

    let events = record.events.iter().map(|event| {
        let kind = if event.kind == EventKind::Impact { "impact" } else { "release" };
        vec![
            kind.to_string(),
            show(&event.time, 0.0),
            show(&event.end_velocity, speed),
            show(&event.centre, rise),
            show(&event.centre_velocity, speed),
        ]
    });
    out += &table(&["event", "time", "v_t(0,t)", "h", "h′"], events.collect(), 1);
    out += "\n\n";

    let mut header = vec!["contact from", "to", "impulse", "peak v_x(0,t)", "e_P", "e_E²", "E", "E_h", "E_z"];
    if record.forces.is_some() {
        header.extend(["peak force", "force impulse"]);
    }
    let contacts = record.contacts.iter().map(|(contact, restitution, energy)| {
        let energy = energy.as_ref();
        let mut row = vec![
            show(&contact.from, 0.0),
            optional(contact.to.as_ref(), 0.0),
            show(&contact.impulse, 0.0),
            show(&contact.peak_stress, 0.0),
            optional(restitution.momentum.as_ref().ok(), 1.0),
            optional(restitution.energy_squared.as_ref().ok(), 1.0),
            optional(energy.map(|e| &e.total), 0.0),
            optional(energy.map(|e| &e.translational), 0.0),
            optional(energy.map(|e| &e.vibrational), energy.map_or(0.0, |e| 1e-3 * e.total.to_f64())),
        ];
        if let Some((stiffness, line)) = &record.forces {
            row.push(show(&-(contact.peak_stress.clone() * stiffness), 0.0));
            row.push(show(&(contact.impulse.clone() * line), 0.0));
        }
        row
    });
    out += &table(&header, contacts.collect(), 0);
    out += "\n\n";
    if record.forces.is_some() && !record.contacts.is_empty() {
        out += "forces are in the units of the scene: newtons where it is written in SI\n";
    }
    for (contact, restitution, _) in &record.contacts {
        let from = show(&contact.from, 0.0);
        let mut reasons = vec![restitution.momentum.as_ref().err(), restitution.energy_squared.as_ref().err()];
        reasons.dedup();
        for reason in reasons.into_iter().flatten() {
            out += &format!("contact from {from}: {reason}\n");
        }
    }
    for flight in &record.flights {
        if let Some((time, centre)) = &flight.highest {
            let (from, time, centre) = (show(&flight.from, 0.0), show(time, 0.0), show(centre, rise));
            out += &format!("flight from {from}: highest at t* = {time}, h_max = {centre}\n");
        }
    }
    let end = match &record.end.1 {
        Ending::ExactnessEnds { .. } => record.end.1.to_string(),
        reason => format!("ends at t = {}: {reason}", show(&record.end.0, 0.0)),
    };
    out += &format!("\n{end}\n");
    if let Some(error) = &record.error
        && head.digits == 0
    {
        out += &format!("error estimate: {:.1e} of the scale of each quantity\n", error.to_f64());
    }
    if let Some((impacts, lost)) = record.lost
        && lost >= MANY_LOST
    {
        let each = lost / f64::from(impacts.max(1));
        out += &format!("{impacts} impacts may have lost {lost:.1} digits to rounding, {each:.2} each\n");
    }
    out
}

/// Below so many digits lost, nobody need be told.
const MANY_LOST: f64 = 3.0;

/// Samples.
pub fn samples_table<S: Show>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> String {
    let has_points = samples.iter().any(|sample| sample.point.is_some());
    let mut header = vec!["t"];
    if has_points {
        header.push("x");
    }
    header.push("side");
    header.extend(quantity.names());
    let rows = samples.iter().map(|sample| {
        let scale = sample.values.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        let mut row = vec![cell(&sample.time, 0.0, head.digits)];
        row.extend(sample.point.as_ref().map(|x| cell(x, 0.0, head.digits)));
        row.push(side_name(sample.side).into());
        row.extend(sample.values.iter().map(|x| cell(x, 1e-3 * scale, head.digits)));
        row
    });
    table(&header, rows.collect(), 0) + "\n"
}
