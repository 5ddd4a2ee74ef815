//! NPZ: an array for each column of numbers.

use std::io::{self, Cursor};

use super::Npz;
use crate::mapped::{CollectVec, mapped};
use crate::output::dataset::{Cell, Column, Dataset};

impl Dataset {
    /// Whole numbers where all are, doubles otherwise, not a number where there is none; and the shape of the grid.
    pub(crate) fn npz(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Cursor::new(Vec::new());
        let mut npz = Npz::new(&mut bytes, true);
        let count = &[self.rows.len()];
        if !self.shape.is_empty() {
            npz.add("shape", &[self.shape.len()], mapped(&self.shape, |n| *n as i64))?;
        }
        for (k, column) in self.columns.iter().enumerate() {
            let (Column { name: Some(name), is_text: false, .. }, cells) =
                (column, self.rows.iter().map(|row| &row[k]))
            else {
                continue;
            };
            let whole = |cell: &Cell| if let Cell::Plain(value) = cell { value.as_i64() } else { None };
            match cells.clone().map(whole).collect::<Option<Vec<i64>>>().filter(|all| !all.is_empty()) {
                Some(whole) => npz.add(name, count, whole)?,
                None => npz.add(name, count, cells.map(Cell::double).collect_vec())?,
            }
        }
        npz.finish()?;
        Ok(bytes.into_inner())
    }
}
