//! CSV: one part of the history a file, with a header.

use super::record::{CONTACT, Column, Factors, Head, Quantity, Record, Sample, column, sampled};
use super::straight::straight;
use crate::compare::{Compared, ComparedFile};
use crate::motion::{Ending, StressPiece};
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
    let optional = |x: &Option<S>| x.as_ref().map_or_else(String::new, show);
    let names = |columns: &[Column]| columns.iter().map(|column| column.with_unit(&head.units)).collect::<Vec<_>>();
    // The strain at both ends of a piece, and where there is a material the stress.
    let present: Vec<Column> = STRESS.into_iter().filter(|column| column.is_present(&head.units)).collect();
    let ends = |piece: &StressPiece<S>| {
        let factors = Factors::new(present.iter(), &head.units, &piece.from);
        let values = [&piece.from, &piece.to, &piece.left, &piece.right, &piece.left, &piece.right];
        let values = values.iter().take(present.len()).enumerate();
        values.map(|(k, value)| show(&factors.scale(k, value))).collect::<Vec<String>>()
    };
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut comments = comments(head);
    if !matches!(record.end.1, Ending::Time | Ending::NextImpact) {
        comments += &format!("# {}\n", record.end.1.at(&show(&record.end.0)));
    }
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
        Part::Stress if coefficients => {
            rows.extend(record.stress.iter().map(|piece| {
                let series: Vec<String> = piece.chebyshev.iter().map(show).collect();
                ends(piece).into_iter().chain([series.join(" ")]).collect()
            }));
            comments += "# v_x(0,t) is linear from strain_from to strain_to, or the sum of chebyshev[k] T_k(x), \
                x = 2(t - from)/(to - from) - 1\n";
            names(&present).into_iter().chain(["chebyshev".to_string()]).collect()
        }
        Part::Stress => {
            rows.extend(straight(&record.stress, STRAIGHT).iter().map(ends));
            if record.stress.iter().any(|piece| piece.chebyshev.len() > 2) {
                comments += &format!(
                    "# straight lines from strain_from to strain_to are within {STRAIGHT:e} of the greatest v_x(0,t); \
                     --coefficients gives the exact form\n"
                );
            }
            names(&present)
        }
    };
    write(&comments, header, rows)
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
    column("strain_from", Measure::Strain),
    column("strain_to", Measure::Strain),
    column("stress_from", Measure::Stress),
    column("stress_to", Measure::Stress),
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
    write(&comments(head), header, rows)
}

/// What the numbers do not say, in lines that begin with `#`, which readers of CSV skip.
fn comments(head: &Head) -> String {
    let end = head.exact_until.as_ref().map(|end| format!("# {end}; the numbers are {}\n", head.number));
    let warnings = head.warnings.iter().map(|warning| format!("# warning: {warning}\n"));
    end.into_iter().chain(warnings).collect()
}

/// Rows below a header, and comments above it.
pub(super) fn write(
    comments: &str,
    header: impl IntoIterator<Item = impl AsRef<[u8]>>,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(comments.to_string() + &String::from_utf8_lossy(&bytes))
}

/// Every sample: time, point of a field, and for each quantity ours, theirs and the difference.
pub(crate) fn compare_csv(ComparedFile { agreement, .. }: &ComparedFile) -> Result<String, csv::Error> {
    let points = agreement.grid.points.as_ref();
    let names = agreement.quantities.iter().map(|compared| compared.what.name());
    let columns = names.flat_map(|name| ["ours", "theirs", "difference"].map(|whose| format!("{name}_{whose}")));
    let place = ["t"].into_iter().chain(points.map(|_| "x")).map(String::from);
    let rows = agreement.grid.times.iter().enumerate().map(|(k, time)| {
        let place = [time.to_string()].into_iter().chain(points.map(|points| points[k].to_string()));
        let values = agreement.quantities.iter().flat_map(|Compared { ours, theirs, .. }| {
            [ours[k], theirs[k], theirs[k] - ours[k]].map(|value| format!("{value:e}"))
        });
        place.chain(values).collect()
    });
    write("", place.chain(columns), rows)
}
