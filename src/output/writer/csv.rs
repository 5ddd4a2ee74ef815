//! CSV: comments, names with units, rows.

use crate::mapped::mapped;
use crate::number::DOUBLE_DIGITS;
use crate::output::dataset::{Cell, Column, Dataset};

impl Dataset {
    /// The rows below the names of their columns, the bounds of numbers in columns of their own after all others, and the
    /// notes in comments above, which readers of CSV skip.
    pub(crate) fn csv(&self) -> Result<String, csv::Error> {
        let digits = if self.digits == 0 { DOUBLE_DIGITS } else { self.digits };
        let named = |column: &&Column| column.name.is_some();
        let with_unit = |column: &Column, suffix: &str| {
            let name = column.name.as_deref().unwrap_or_default();
            if column.unit.is_empty() { format!("{name}{suffix}") } else { format!("{name}{suffix} [{}]", column.unit) }
        };
        let bounded = || self.columns.iter().filter(named).filter(|column| column.is_bounded);
        let names = self.columns.iter().filter(named).map(|column| with_unit(column, ""));
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(names.chain(bounded().map(|column| with_unit(column, "_uncertainty"))))?;
        for row in &self.rows {
            let cells = || self.columns.iter().zip(row).filter(|(column, _)| named(column));
            for (_, cell) in cells() {
                writer.write_field(cell.text(digits, ""))?;
            }
            for (_, cell) in cells().filter(|(column, _)| column.is_bounded) {
                writer.write_field(match cell {
                    Cell::Plain(_) => String::new(),
                    Cell::Number(x) => x.printed_bound(digits),
                    Cell::Numbers(all) => mapped(all, |x| x.printed_bound(digits)).join(" "),
                })?;
            }
            writer.write_record(None::<&[u8]>)?;
        }
        let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        let comments: String = mapped(&self.notes, |note| format!("# {note}\n")).concat();
        Ok(comments + &String::from_utf8_lossy(&bytes))
    }
}
