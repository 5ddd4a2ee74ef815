//! CSV: one part of the history a file, with a header.

use super::record::{Head, Quantity, Record, Sample};
use crate::number::{DOUBLE_DIGITS, Scalar, show, shown_bound_text};

/// The part of a history that a CSV file holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    /// Impacts and releases.
    #[default]
    Events,
    /// Contacts.
    Contacts,
    /// The pieces of the stress at the ground.
    Stress,
}

/// One part of the history.
pub fn history_csv<S: Scalar>(record: &Record<S>, part: Part, head: &Head) -> Result<String, csv::Error> {
    let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
    let (show, bound) = (|x: &S| show(x, digits), |x: &S| shown_bound_text(x, digits));
    let optional = |x: Option<&S>| x.map_or_else(String::new, show);
    let mut rows: Vec<Vec<String>> = Vec::new();
    let header: &[&str] = match part {
        Part::Events => {
            for event in &record.events {
                let numbers = event.numbers().map(show).into_iter().chain(event.numbers().map(bound));
                rows.push(std::iter::once(event.kind.to_string()).chain(numbers).collect());
            }
            &[
                "kind",
                "time",
                "end_velocity",
                "centre",
                "centre_velocity",
                "time_uncertainty",
                "end_velocity_uncertainty",
                "centre_uncertainty",
                "centre_velocity_uncertainty",
            ]
        }
        Part::Contacts => {
            rows.extend(record.contacts.iter().map(|finished| finished.columns().map(optional).to_vec()));
            &[
                "from",
                "to",
                "impulse",
                "peak_stress",
                "restitution_momentum",
                "restitution_energy_squared",
                "total",
                "translational",
                "vibrational",
            ]
        }
        Part::Stress => {
            rows.extend(record.stress.iter().map(|p| [&p.from, &p.to, &p.left, &p.right].map(show).to_vec()));
            &["from", "to", "left", "right"]
        }
    };
    write(header, rows)
}

/// Samples.
pub fn samples_csv<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> Result<String, csv::Error> {
    let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
    let (show, bound) = (|x: &S| show(x, digits), |x: &S| shown_bound_text(x, digits));
    let mut header = vec!["time", "point", "side"];
    header.extend(quantity.names());
    let bounds: Vec<String> = quantity.names().iter().map(|name| format!("{name}_uncertainty")).collect();
    header.extend(bounds.iter().map(String::as_str));
    let rows = samples.iter().map(|sample| {
        let place = [show(&sample.time), sample.point.as_ref().map_or_else(String::new, show), sample.side.to_string()];
        place.into_iter().chain(sample.values.iter().map(show)).chain(sample.values.iter().map(bound)).collect()
    });
    write(&header, rows.collect())
}

pub(super) fn write(header: &[&str], rows: Vec<Vec<String>>) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
