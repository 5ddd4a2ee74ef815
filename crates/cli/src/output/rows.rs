//! Rows of named columns, written as they are computed: a table, CSV, JSON or NPZ.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};

use schemars::JsonSchema;
use serde::Serialize;

use super::column::{Column, Kind};
use super::dataset::{Cell, greatest};
use super::header::Header;
use super::npz::Npz;
use super::schema_types::NumberSchema;
use super::table::{TextTable, table_digits};
use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format};
use dalembert::number::{DOUBLE_DIGITS, Scalar, double_bound};
use dalembert::{Bound, Value};

/// Options of the text of a file.
#[derive(Debug)]
pub(crate) struct Layout {
    /// Text below a table.
    pub(crate) below: String,
    /// Number of columns that each part of a table begins with that is too wide for a page; `None` to keep it wide.
    pub(crate) keys: Option<usize>,
}

/// Rows that are kept in temporary files until their bounds, which stand above them, are known.
#[derive(Debug)]
pub(crate) struct RowWriter {
    format: Format,
    /// Whether a CSV has no comments above it. Without columns of bounds, digits beyond the bound are then left out,
    /// but in keys.
    bare: bool,
    /// Whether each column of numbers has one of their bounds beside it, rather than the greatest above the rows alone.
    with_bounds: bool,
    /// Columns, each with the place of its values.
    columns: Vec<(Column, usize)>,
    /// Digits of a long number; 0 for doubles and fractions.
    digits: u32,
    /// One file with the text of all rows, or one with the doubles of each column.
    kept: Vec<BufWriter<File>>,
    table: Vec<Vec<String>>,
    /// Greatest bound of each column.
    bounds: Vec<Bound>,
    count: usize,
}

const BUFFER: usize = 1 << 16;

impl RowWriter {
    /// Returns a writer without rows, for columns of bounds or none, and for a CSV with comments or a bare one.
    pub(crate) fn new(
        format: Format,
        columns: &[Column],
        (with_bounds, bare): (bool, bool),
        digits: u32,
    ) -> Result<Self, Failure> {
        let mut all = Vec::new();
        for (place, column) in columns.iter().enumerate() {
            all.push((column.clone(), place));
            if with_bounds && column.kind == Kind::Number {
                all.push((column.bounds(), place));
            }
        }
        let files = if format == Format::Npz { all.len() } else { 1 };
        let kept = (0..files).map(|_| Ok(BufWriter::with_capacity(BUFFER, tempfile::tempfile()?)));
        let kept = kept.collect::<io::Result<_>>().map_err(cannot("keep the rows"))?;
        let bounds = vec![Bound::from_log2(f64::NEG_INFINITY); all.len()];
        Ok(RowWriter { format, bare, with_bounds, columns: all, digits, kept, table: Vec::new(), bounds, count: 0 })
    }

    /// Adds rows, given column by column.
    pub(crate) fn push(&mut self, cells: &[Vec<Cell>]) -> io::Result<()> {
        let count = cells.first().map_or(0, Vec::len);
        if count == 0 {
            return Ok(());
        }
        for (k, (column, place)) in self.columns.iter().enumerate() {
            for cell in cells[*place].iter().filter(|_| column.kind == Kind::Number) {
                let bound = if let Cell::Number(value) = cell { self.bound(value) } else { self.bounds[k] };
                self.bounds[k] = if bound > self.bounds[k] { bound } else { self.bounds[k] };
            }
        }
        match self.format {
            Format::Npz => {
                for ((column, place), file) in self.columns.iter().zip(&mut self.kept) {
                    for cell in &cells[*place] {
                        file.write_all(&double(self.format, self.digits, column.kind, cell).to_le_bytes())?;
                    }
                }
            }
            Format::Table => {
                let greatest: Vec<f64> = cells.iter().map(greatest).collect();
                let text = |(column, place): &(Column, usize), row: usize| {
                    self.text(column.kind, &cells[*place][row], greatest[*place])
                };
                let row = |row: usize| self.columns.iter().map(|column| text(column, row)).collect();
                let rows: Vec<Vec<String>> = (0..count).map(row).collect();
                self.table.extend(rows);
            }
            _ => {
                let mut text = Vec::with_capacity(BUFFER);
                for row in 0..count {
                    self.write_row(&mut text, cells, row);
                    if text.len() > BUFFER / 2 || row + 1 == count {
                        self.kept[0].write_all(&text)?;
                        text.clear();
                    }
                }
            }
        }
        self.count += count;
        Ok(())
    }

    /// Writes all rows to `destination`.
    pub(crate) fn finish(self, header: &Header, destination: &Destination, layout: &Layout) -> Result<(), Failure> {
        let RowWriter { format, bare, columns, kept, table, bounds, count, .. } = self;
        let columns: Vec<Column> = columns.into_iter().map(|(column, _)| column).collect();
        let names = || columns.iter().map(|column| column.csv_name()).collect::<Vec<&str>>();
        let rewound = |file: BufWriter<File>| {
            let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
            file.rewind()?;
            Ok(file)
        };
        let mut kept =
            kept.into_iter().map(rewound).collect::<io::Result<Vec<File>>>().map_err(cannot("keep the rows"))?;
        destination.write_with(|file| match format {
            Format::Table => {
                let table = TextTable { head: &names(), rows: table, words: 0, keys: layout.keys };
                write!(file, "{}{}", table.format(), layout.below)
            }
            Format::Json => {
                let document = Document { header: header.with_columns(&columns, &bounds, false), rows: [] };
                let text = serde_json::to_string_pretty(&document)?;
                // The rows are as they are read: to parse each again would take as long as to write them all.
                let before = text.strip_suffix(JSON_END).unwrap_or(&text);
                file.write_all(before.as_bytes())?;
                io::copy(&mut kept[0], file)?;
                writeln!(file, "{}{JSON_END}", if count > 0 { "\n  " } else { "" })
            }
            Format::Npz => {
                let mut npz = Npz::new(file, false);
                let header = serde_json::to_vec_pretty(&header.with_columns(&columns, &bounds, true))?;
                npz.add("header", &[header.len()], header)?;
                for (column, values) in columns.iter().zip(kept) {
                    let mut values = BufReader::new(values);
                    let mut next = || {
                        let mut bytes = [0; 8];
                        values.read_exact(&mut bytes).map(|()| f64::from_le_bytes(bytes))
                    };
                    let values = (0..count).map(|_| next()).collect::<Result<Vec<_>, _>>()?;
                    match column.kind {
                        Kind::Side | Kind::Flag => {
                            npz.add(column.csv_name(), &[count], values.iter().map(|x| *x as i8).collect::<Vec<_>>())
                        }
                        Kind::Number | Kind::Bound | Kind::Word => npz.add(column.csv_name(), &[count], values),
                    }?;
                }
                npz.finish()
            }
            _ => {
                let comments = if bare { String::new() } else { header.comments(&columns, &bounds) };
                writeln!(file, "{comments}{}", names().join(","))?;
                io::copy(&mut kept[0], file).map(drop)
            }
        })
    }

    fn bound(&self, value: &Value) -> Bound {
        match self.format {
            Format::Table => value.bound_to_digits(self.table_digits()),
            format => bound(format, self.digits, value),
        }
    }

    /// Returns the greatest number of digits in a table: beside bounds all that a double has.
    fn table_digits(&self) -> u32 {
        if self.with_bounds { shown_digits(self.digits) } else { table_digits(self.digits) }
    }

    /// Returns the text of a cell of a table in a column with numbers up to `greatest`.
    fn text(&self, kind: Kind, cell: &Cell, greatest: f64) -> String {
        match (cell, kind) {
            (Cell::Number(value), Kind::Number | Kind::Word) => value.to_digits_beside(self.table_digits(), greatest),
            (Cell::Number(value), Kind::Bound) => self.bound(value).to_string(),
            (Cell::Number(value), Kind::Side) => side_word(value).into(),
            (Cell::Number(value), Kind::Flag) => flag(value).into(),
            (Cell::Plain(_) | Cell::Numbers(_), _) => cell.text(self.digits, "–"),
        }
    }

    /// Adds the text of a row of CSV or JSON.
    fn write_row(&self, text: &mut Vec<u8>, cells: &[Vec<Cell>], row: usize) {
        let [begin, between, end] = match self.format {
            Format::Json if self.count + row == 0 => ["\n    [", ", ", "]"],
            Format::Json => [",\n    [", ", ", "]"],
            _ => ["", ",", "\n"],
        };
        text.extend_from_slice(begin.as_bytes());
        for (k, (column, place)) in self.columns.iter().enumerate() {
            text.extend_from_slice(if k > 0 { between.as_bytes() } else { b"" });
            self.write_cell(text, column, &cells[*place][row]);
        }
        text.extend_from_slice(end.as_bytes());
    }

    fn write_cell(&self, text: &mut Vec<u8>, &Column { kind, is_key, .. }: &Column, cell: &Cell) {
        let is_json = self.format == Format::Json;
        let quote = if is_json { "\"" } else { "" };
        let mut add = |quote: &str, word: &str| {
            [quote, word, quote].iter().for_each(|part| text.extend_from_slice(part.as_bytes()))
        };
        match (cell, kind) {
            (Cell::Number(value), Kind::Side) => add(quote, side_word(value)),
            (Cell::Number(value), Kind::Flag) => add("", flag(value)),
            (Cell::Number(value), Kind::Bound) => {
                let bound = self.bound(value).to_string();
                // A bound below the least double is a text.
                let is_double = bound.parse::<f64>().is_ok_and(|double| double > 0.0 || bound == "0");
                add(if is_double { "" } else { quote }, &bound);
            }
            // Keys keep the digits that tell rows apart.
            (Cell::Number(value), Kind::Number | Kind::Word)
                if value.is_double() && self.bare && !self.with_bounds && !is_key && !value.is_exact() =>
            {
                add("", &value.to_digits(DOUBLE_DIGITS));
            }
            // The shortest text that reads as the same double.
            (Cell::Number(value), Kind::Number | Kind::Word) if value.is_double() => {
                add("", ryu::Buffer::new().format(written_double(value)));
            }
            (Cell::Number(value), Kind::Number | Kind::Word) if is_json => {
                add("", &serde_json::json!(value).to_string())
            }
            (Cell::Number(value), Kind::Number | Kind::Word) => add("", &value.to_digits(shown_digits(self.digits))),
            (Cell::Plain(_) | Cell::Numbers(_), _) if is_json => add("", &cell.json().to_string()),
            (Cell::Plain(_) | Cell::Numbers(_), _) => (),
        }
    }
}

/// Returns the bound of the error of a number as it is written.
fn bound(format: Format, digits: u32, value: &Value) -> Bound {
    let double_bound = || {
        let float = value.as_float().map(double_bound);
        float.or_else(|| value.as_rational().map(double_bound)).or_else(|| value.as_interval().map(double_bound))
    };
    match value.as_double() {
        // A number that is zero within its bound is written as zero, and is at most that bound.
        Some(double) if double.vanishes() == Ok(true) => Bound::from_log2(double.log2_error() + 1.0),
        Some(double) => Bound::from_log2(double.log2_error()),
        None => match double_bound().filter(|_| format == Format::Npz) {
            Some(log2) => Bound::from_log2(log2),
            None => value.bound_to_digits(shown_digits(digits)),
        },
    }
}

fn shown_digits(digits: u32) -> u32 {
    if digits == 0 { DOUBLE_DIGITS } else { digits }
}

/// Returns the double of an array.
fn double(format: Format, digits: u32, kind: Kind, cell: &Cell) -> f64 {
    match (cell, kind) {
        (Cell::Number(value), Kind::Bound) => bound(format, digits, value).to_string().parse().unwrap_or(f64::NAN),
        (Cell::Number(value), _) => written_double(value),
        (Cell::Plain(_) | Cell::Numbers(_), _) => f64::NAN,
    }
}

fn side_word(value: &Value) -> &'static str {
    ["left", "both", "right"][(value.to_f64() + 1.0).clamp(0.0, 2.0) as usize]
}

fn flag(value: &Value) -> &'static str {
    if value.to_f64() > 0.0 { "1" } else { "0" }
}

/// Returns the double that is written: zero for a number that is zero within its bound, and never a negative zero.
fn written_double(value: &Value) -> f64 {
    let is_zero = match (value.as_double(), value.as_float()) {
        (Some(double), _) => double.vanishes() == Ok(true),
        (None, Some(float)) => float.vanishes() == Ok(true),
        (None, None) => false,
    };
    if is_zero { 0.0 } else { value.to_f64() + 0.0 }
}

/// Rows of named columns, without the rows: they follow as they are kept.
#[derive(JsonSchema, Serialize)]
#[schemars(rename = "reference")]
pub(super) struct Document {
    #[serde(flatten)]
    header: Header,
    /// A value for each column: left, right or both for a side, 0 or 1 for contact. A derivative that does not exist is
    /// null, or the reason on its side.
    #[schemars(with = "Vec<Vec<Option<NumberSchema>>>")]
    rows: [(); 0],
}

/// End of a [`Document`].
const JSON_END: &str = "]\n}";
