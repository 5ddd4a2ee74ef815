//! Tables for a person.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};

use super::record::{Finished, Head, Quantity, Record, Sample, show};
use crate::history::Ending;
use crate::number::Scalar;

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

/// Significant digits of a double in a table.
const TABLE_DIGITS: u32 = 12;

/// A number in a table.
fn cell<S: Scalar>(x: &S, head: &Head) -> String {
    show(x, if head.digits == 0 { TABLE_DIGITS } else { head.digits })
}

/// The whole history but for the stress: head, events, contacts, flights, end.
pub fn history_table<S: Scalar>(record: &Record<S>, head: &Head) -> String {
    let show = |x: &S| cell(x, head);
    let optional = |x: Option<&S>| x.map_or_else(|| "–".to_string(), show);
    let mut out = String::new();
    if let Some(title) = &head.title {
        out += &format!("{title}\n");
    }
    out += &format!("numbers: {}    effects: {}\n", head.number, head.effects.join(", "));
    if let Some(ending) = &head.exact_until {
        out += &format!("{ending}\n");
    }
    out += "\n";

    let events = record
        .events
        .iter()
        .map(|event| std::iter::once(event.kind.to_string()).chain(event.numbers().map(show)).collect());
    out += &table(&["event", "time", "v_t(0,t)", "h", "h′"], events.collect(), 1);
    out += "\n\n";

    let mut header = vec!["contact from", "to", "impulse", "peak v_x(0,t)", "e_P", "e_E²", "E", "E_h", "E_z"];
    if record.forces.is_some() {
        header.extend(["peak force", "force impulse"]);
    }
    let contacts = record.contacts.iter().map(|Finished { contact, restitution, energy, .. }| {
        let energy = energy.as_ref();
        let mut row = vec![
            show(&contact.from),
            optional(contact.to.as_ref()),
            show(&contact.impulse),
            show(&contact.peak_stress),
            optional(restitution.momentum.as_ref().ok()),
            optional(restitution.energy_squared.as_ref().ok()),
            optional(energy.map(|e| &e.total)),
            optional(energy.map(|e| &e.translational)),
            optional(energy.map(|e| &e.vibrational)),
        ];
        if let Some((stiffness, line)) = &record.forces {
            row.push(show(&-(contact.peak_stress.clone() * stiffness)));
            row.push(show(&(contact.impulse.clone() * line)));
        }
        row
    });
    out += &table(&header, contacts.collect(), 0);
    out += "\n\n";
    if record.forces.is_some() && !record.contacts.is_empty() {
        out += "forces are in the units of the scene: newtons where it is written in SI\n";
    }
    for Finished { contact, restitution, .. } in &record.contacts {
        let from = show(&contact.from);
        let mut reasons = vec![restitution.momentum.as_ref().err(), restitution.energy_squared.as_ref().err()];
        reasons.dedup();
        for reason in reasons.into_iter().flatten() {
            out += &format!("contact from {from}: {reason}\n");
        }
    }
    for flight in &record.flights {
        if let Some((time, centre)) = &flight.highest {
            let (from, time, centre) = (show(&flight.from), show(time), show(centre));
            out += &format!("flight from {from}: highest at t* = {time}, h_max = {centre}\n");
        }
    }
    let end = match &record.end.1 {
        Ending::ExactnessEnds { .. } => record.end.1.to_string(),
        reason => format!("ends at t = {}: {reason}", show(&record.end.0)),
    };
    out += &format!("\n{end}\n");
    if record.error > 0.0 && head.digits == 0 {
        out += &format!("error estimate: {:.1e} of the scale of each quantity\n", record.error);
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
pub fn samples_table<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> String {
    let has_points = samples.iter().any(|sample| sample.point.is_some());
    let mut header = vec!["t"];
    if has_points {
        header.push("x");
    }
    header.push("side");
    header.extend(quantity.names());
    let rows = samples.iter().map(|sample| {
        let mut row = vec![cell(&sample.time, head)];
        row.extend(sample.point.as_ref().map(|x| cell(x, head)));
        row.push(sample.side.to_string());
        row.extend(sample.values.iter().map(|x| cell(x, head)));
        row
    });
    table(&header, rows.collect(), 0) + "\n"
}
