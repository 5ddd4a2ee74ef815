//! Tables for a person.

use super::outline::sparkline;
use super::record::{CONTACT, Finished, Head, Quantity, Record, Sample, sampled};
use crate::aligned::table;
use crate::number::{Scalar, show, shown_bound_text};
use crate::quantity::{Measure, Units};

/// Characters that a table may be wide where nothing else is asked for.
pub(crate) const WIDTH: usize = 80;

/// A table of at most [`WIDTH`] characters: columns that do not fit follow in further tables, each with the first
/// `keys` columns again.
pub(super) fn fitted(header: &[&str], rows: &[Vec<String>], words: usize, keys: usize, wide: bool) -> String {
    let select = |columns: &[usize]| {
        let header: Vec<&str> = columns.iter().filter_map(|k| header.get(*k).copied()).collect();
        let pick = |row: &Vec<String>| columns.iter().filter_map(|k| row.get(*k).cloned()).collect();
        table(&header, rows.iter().map(pick).collect(), words)
    };
    if wide {
        return select(&(0..header.len()).collect::<Vec<_>>());
    }
    let mut parts = Vec::new();
    let keys: Vec<usize> = (0..keys).collect();
    let mut columns = keys.clone();
    for k in keys.len()..header.len() {
        columns.push(k);
        let widest = select(&columns).lines().map(|line| line.chars().count()).max().unwrap_or(0);
        if widest > WIDTH && columns.len() > keys.len() + 1 {
            columns.pop();
            parts.push(select(&columns));
            columns = [&keys[..], &[k]].concat();
        }
    }
    parts.push(select(&columns));
    // Numbers so long that hardly two columns stand side by side: a row is a block, with a line for each number.
    if parts.len() > 2 && 2 * parts.len() > header.len() {
        return blocks(header, rows);
    }
    parts.join("\n\n")
}

/// A block for each row, with a line for each of its numbers.
fn blocks(header: &[&str], rows: &[Vec<String>]) -> String {
    let widest = header.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let block = |row: &Vec<String>| {
        let lines = header.iter().zip(row).map(|(name, text)| {
            let space = " ".repeat(widest - name.chars().count());
            // Aligned at the first digit, so that signs stand out.
            let sign = if text.starts_with('-') { "" } else { " " };
            format!(" {name}{space}  {sign}{text}")
        });
        lines.collect::<Vec<_>>().join("\n")
    };
    rows.iter().map(block).collect::<Vec<_>>().join("\n\n")
}

/// Significant digits of a double in a table.
const TABLE_DIGITS: u32 = 12;

/// Significant digits of a number in a table.
fn digits(head: &Head) -> u32 {
    if head.digits == 0 { TABLE_DIGITS } else { head.digits }
}

/// A number in a table.
pub(super) fn cell<S: Scalar>(x: &S, head: &Head) -> String {
    show(x, digits(head))
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
pub fn history_table<S: Scalar>(record: &Record<S>, head: &Head) -> String {
    let show = |x: &S| cell(x, head);
    let optional = |x: Option<&S>| x.map_or_else(|| "–".to_string(), show);
    let mut out = String::new();
    if let Some(title) = &head.title {
        out += &line(title, head);
    }
    out += &line(&format!("numbers: {}    effects: {}", head.number, head.effects.join(", ")), head);
    out += &line(&head.parameters, head);
    if let Some(ending) = &head.exact_until {
        out += &line(&ending.to_string(), head);
    }
    out += "\n";
    if !record.outline.is_empty() {
        let peaks = record.contacts.iter().map(|finished| finished.contact.peak_strain.to_f64());
        out += &sparkline(&record.outline, record.end.0.to_f64(), peaks.fold(0.0, f64::min), head);
    }

    let uncertain =
        record.events.iter().any(|event| event.time.ends(1).is_none() && event.time.log2_error().is_finite());
    let mut header = vec!["event", "time", "v_t(0,t)", "h", "h′"];
    if uncertain {
        header.insert(2, "±");
    }
    let events = record.events.iter().map(|event| {
        let mut row: Vec<String> = std::iter::once(event.kind.to_string()).chain(event.numbers().map(show)).collect();
        if uncertain {
            row.insert(2, shown_bound_text(&event.time, digits(head)));
        }
        row
    });
    out += &fitted(&header, &events.collect::<Vec<_>>(), 1, 1, head.wide);
    out += "\n\n";

    let units = &head.units;
    let header: Vec<&str> =
        CONTACT.iter().filter(|column| column.is_present(units)).map(|column| column.head).collect();
    let row = |finished: &Finished<S>| finished.columns(units).iter().map(|x| optional(x.as_ref())).collect();
    let contacts = record.contacts.iter().map(row);
    out += &fitted(&header, &contacts.collect::<Vec<_>>(), 0, 1, head.wide);
    out += "\n\n";
    if !record.contacts.is_empty() {
        let measures = [Measure::Impulse, Measure::Stress, Measure::Force, Measure::Energy];
        out += &named_units(&measures, units);
    }
    for Finished { contact, restitution, .. } in &record.contacts {
        let from = show(&contact.from);
        let mut reasons = vec![restitution.momentum.as_ref().err(), restitution.energy_squared.as_ref().err()];
        reasons.dedup();
        for reason in reasons.into_iter().flatten() {
            out += &line(&format!("contact from {from}: {reason}"), head);
        }
    }
    let flights = record.flights.iter().filter_map(|flight| {
        let (time, centre) = flight.highest.as_ref()?;
        Some([&flight.from, time, centre].map(show).to_vec())
    });
    let flights: Vec<Vec<String>> = flights.collect();
    if !flights.is_empty() {
        let header = ["flight from", "highest at", "h_max"];
        out += &format!("\n{}\n", fitted(&header, &flights, 0, 1, head.wide));
    }
    out += &format!("\n{}", line(&record.end.1.at(&show(&record.end.0)), head));
    if let Some((impacts, lost)) = record.lost
        && lost >= MANY_LOST
    {
        out += &format!("{impacts} impacts may have lost {lost:.1} of the digits carried, none of those printed\n");
    }
    out += &warnings(head);
    out
}

/// A line of prose, in several where it is wider than a table may be.
fn line(text: &str, head: &Head) -> String {
    if head.wide { format!("{text}\n") } else { wrapped(text, WIDTH, "    ") + "\n" }
}

/// A text in lines of so many characters, those after the first indented.
pub(crate) fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let options = textwrap::Options::new(width)
        .subsequent_indent(indent)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    textwrap::fill(text, options)
}

/// The units of what the scene's own do not tell, in a line: `impulse in N s, energies in J`.
fn named_units(measures: &[Measure], units: &Units) -> String {
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

/// A line for each warning.
fn warnings(head: &Head) -> String {
    head.warnings.iter().map(|warning| line(&format!("warning: {warning}"), head)).collect()
}

/// Below so many digits lost the table does not mention them.
const MANY_LOST: f64 = 3.0;

/// Samples.
pub fn samples_table<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> String {
    let has_points = samples.iter().any(|sample| sample.point.is_some());
    let mut header = vec!["t"];
    if has_points {
        header.push("x");
    }
    header.push("side");
    let keys = header.len();
    let (columns, values) = sampled(samples, quantity, &head.units);
    header.extend(columns.iter().map(|column| column.head));
    let rows = samples.iter().zip(&values).map(|(sample, values)| {
        let mut row = vec![cell(&sample.time, head)];
        row.extend(sample.point.as_ref().map(|x| cell(x, head)));
        row.push(sample.side.to_string());
        row.extend(values.iter().map(|x| cell(x, head)));
        row
    });
    let end = head.exact_until.as_ref().map_or_else(String::new, |end| format!("{end}; these are {}\n", head.number));
    let measures: Vec<Measure> = columns.iter().filter_map(|column| column.measure).collect();
    let below = end + &named_units(&measures, &head.units) + &warnings(head);
    let space = if below.is_empty() { "" } else { "\n" };
    fitted(&header, &rows.collect::<Vec<_>>(), 0, keys, head.wide) + "\n" + space + &below
}
