//! CSV: one part of the history a file, with a header.

use super::record::{CONTACT, Column, Factors, Head, Quantity, Record, Sample, column, sampled};
use crate::number::{DOUBLE_DIGITS, Scalar, show, shown_bound_text};
use crate::quantity::Measure;

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
    let optional = |x: &Option<S>| x.as_ref().map_or_else(String::new, show);
    let names = |columns: &[Column]| columns.iter().map(|column| column.with_unit(&head.units)).collect::<Vec<_>>();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let header = match part {
        Part::Events => {
            for event in &record.events {
                let numbers = event.numbers().map(show).into_iter().chain(event.numbers().map(bound));
                rows.push(std::iter::once(event.kind.to_string()).chain(numbers).collect());
            }
            std::iter::once("kind".to_string()).chain(names(&EVENT)).collect()
        }
        Part::Contacts => {
            rows.extend(record.contacts.iter().map(|row| row.columns(&head.units).iter().map(optional).collect()));
            let present = CONTACT.iter().filter(|column| column.is_present(&head.units));
            names(&present.copied().collect::<Vec<_>>())
        }
        Part::Stress => {
            let columns: Vec<Column> = STRESS.into_iter().filter(|column| column.is_present(&head.units)).collect();
            for piece in &record.stress {
                let factors = Factors::new(columns.iter(), &head.units, &piece.from);
                let values = [&piece.from, &piece.to, &piece.left, &piece.right, &piece.left, &piece.right];
                let values = values.iter().take(columns.len()).enumerate();
                rows.push(values.map(|(k, value)| show(&factors.scale(k, value))).collect());
            }
            names(&columns)
        }
    };
    write(header, rows)
}

const EVENT: [Column; 8] = [
    column("time", Measure::Time),
    column("end_velocity", Measure::Velocity),
    column("centre", Measure::Length),
    column("centre_velocity", Measure::Velocity),
    column("time_uncertainty", Measure::Time),
    column("end_velocity_uncertainty", Measure::Velocity),
    column("centre_uncertainty", Measure::Length),
    column("centre_velocity_uncertainty", Measure::Velocity),
];

const STRESS: [Column; 6] = [
    column("from", Measure::Time),
    column("to", Measure::Time),
    column("left", Measure::Strain),
    column("right", Measure::Strain),
    column("left_stress", Measure::Stress),
    column("right_stress", Measure::Stress),
];

/// Samples.
pub fn samples_csv<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, head: &Head) -> Result<String, csv::Error> {
    let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
    let (show, bound) = (|x: &S| show(x, digits), |x: &S| shown_bound_text(x, digits));
    let (columns, values) = sampled(samples, quantity, &head.units);
    let units = &head.units;
    let place = [column("time", Measure::Time), column("point", Measure::Length)].map(|place| place.with_unit(units));
    let mut header: Vec<String> = place.into_iter().chain(["side".into()]).collect();
    header.extend(columns.iter().map(|column| column.with_unit(units)));
    header.extend(columns.iter().map(|column| column.with_suffix("_uncertainty", units)));
    let rows = samples.iter().zip(&values).map(|(sample, values)| {
        let place = [show(&sample.time), sample.point.as_ref().map_or_else(String::new, show), sample.side.to_string()];
        place.into_iter().chain(values.iter().map(show)).chain(values.iter().map(bound)).collect()
    });
    write(header, rows.collect())
}

pub(super) fn write(header: Vec<String>, rows: Vec<Vec<String>>) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
