//! CSV: one part of the history a file, with a header.

use super::record::{Head, Quantity, Record, Sample};
use super::straight::straight;
use crate::motion::StressPiece;
use crate::number::{DOUBLE_DIGITS, Scalar, show, shown_bound_text};

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

/// One part of the history; the stress in straight pieces, or with the `coefficients` of its Chebyshev series.
pub fn history_csv<S: Scalar>(
    record: &Record<S>,
    part: Part,
    coefficients: bool,
    head: &Head,
) -> Result<String, csv::Error> {
    let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
    let (show, bound) = (|x: &S| show(x, digits), |x: &S| shown_bound_text(x, digits));
    let optional = |x: Option<&S>| x.map_or_else(String::new, show);
    let ends = |piece: &StressPiece<S>| [&piece.from, &piece.to, &piece.left, &piece.right].map(show).to_vec();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut comments = comments(head);
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
        Part::Stress if coefficients => {
            rows.extend(record.stress.iter().map(|piece| {
                let series: Vec<String> = piece.chebyshev.iter().map(show).collect();
                ends(piece).into_iter().chain([series.join(" ")]).collect()
            }));
            comments += "# v_x(0,t) is linear from left to right, or the sum of chebyshev[k] T_k(x), \
                x = 2(t - from)/(to - from) - 1\n";
            &["from", "to", "left", "right", "chebyshev"]
        }
        Part::Stress => {
            rows.extend(straight(&record.stress, STRAIGHT).iter().map(ends));
            if record.stress.iter().any(|piece| piece.chebyshev.len() > 2) {
                comments += &format!(
                    "# straight lines from left to right are within {STRAIGHT:e} of the greatest v_x(0,t); \
                     --coefficients gives the exact form\n"
                );
            }
            &["from", "to", "left", "right"]
        }
    };
    write(&comments, header, rows)
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
    write(&comments(head), &header, rows.collect())
}

/// What the numbers do not say, in lines that begin with `#`, which readers of CSV skip.
fn comments(head: &Head) -> String {
    let end = head.exact_until.as_ref().map(|end| format!("# {end}; the numbers are {}\n", head.number));
    let warnings = head.warnings.iter().map(|warning| format!("# warning: {warning}\n"));
    end.into_iter().chain(warnings).collect()
}

fn write(comments: &str, header: &[&str], rows: Vec<Vec<String>>) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(comments.to_string() + &String::from_utf8_lossy(&bytes))
}
