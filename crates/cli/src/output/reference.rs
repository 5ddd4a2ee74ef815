//! Golden files: rows of named columns as CSV, JSON or NPZ, written as they come, below a header that says what they
//! are worth.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

use serde_json::{Value, json};

use super::json::number_json;
use super::npz::Npz;
use super::record::Head;
use super::write_filled;
use super::writer::Format;
use dalembert::number::{DOUBLE_DIGITS, Scalar, bound_of_log2, double_bound, show, shown_bound};
use dalembert::quantity::Quantity;
use dalembert::solve::Numbers;

/// A column of a golden file: what it is, and its unit.
pub(crate) type Described = (Quantity, &'static str);

/// Whether the values are −1, 0 and 1, which stand for the sides of a jump, or 0 and 1 for contact.
fn is_flag(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Side | Quantity::Contact)
}

/// What a golden file says of itself.
#[derive(Debug)]
pub(crate) struct Preamble<'a> {
    pub head: Head,
    pub scene: &'a str,
    pub numbers: Numbers,
    /// What has a bound.
    pub each: &'a str,
    /// Why the history ends, where its end is among the rows.
    pub ends: Option<String>,
    pub until: f64,
    /// Whether a CSV leaves out the comments.
    pub bare: bool,
}

const SIGNS: &str = "x and displacements upwards from the undeformed rod on the ground; strain and stress positive in \
                     tension, force positive in compression";
const SIDE: &str = "left is the limit from earlier times, right from later ones; both: they are the same";
const READ: &str = "pandas.read_csv(FILE, comment=\"#\"), or \
    numpy.genfromtxt((s for s in open(FILE) if s[0] != \"#\"), delimiter=\",\", names=True, dtype=None)";
const CITE: &str = concat!(
    "The dalembert developers, dalembert ",
    env!("CARGO_PKG_VERSION"),
    ": exact reference solutions for the bouncing elastic rod; with the scene above"
);

impl Preamble<'_> {
    fn promise(&self, npz: bool) -> String {
        let promise = match self.numbers {
            Numbers::Double(_) => return format!("{} within its bound, carried through the computation", self.each),
            Numbers::Exact => "fractions without any error".to_string(),
            Numbers::Certified(digits) => {
                format!("{digits} digits, proved by enclosures; fewer where no more are known")
            }
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => {
                format!("{digits} digits, rounded once from values known to more")
            }
        };
        if npz { format!("{promise}; here rounded to the nearest double") } else { promise }
    }

    fn scene_lines(&self) -> impl Iterator<Item = &str> {
        self.scene.lines().map(str::trim_end).filter(|line| !line.is_empty() && !line.trim_start().starts_with('#'))
    }

    fn json(&self, columns: &[Described], bounds: &[f64], npz: bool) -> Value {
        let columns = columns.iter().zip(bounds).map(|((column, unit), bound)| {
            let mut value = json!({
                "name": column.name(), "symbol": column.symbol(), "meaning": column.meaning(), "unit": unit,
            });
            if self.has_bounds() && !is_flag(*column) {
                let text = bound_of_log2(*bound);
                value["bound"] = match text.parse::<f64>() {
                    Ok(bound) if bound > 0.0 || text == "0" => bound.into(),
                    // Below the least double.
                    Ok(_) => text.into(),
                    Err(_) => Value::Null,
                };
            }
            value
        });
        json!({
            "schema": 1,
            "kind": "reference",
            "dalembert": env!("CARGO_PKG_VERSION"),
            "title": self.head.title,
            "scene": self.scene_lines().collect::<Vec<_>>().join("\n"),
            "effects": self.head.effects,
            "until": self.until,
            "numbers": self.head.number,
            "proved": self.proved(),
            "promise": self.promise(npz),
            "signs": SIGNS,
            "side": SIDE,
            "ends": self.ends,
            "warnings": self.head.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "cite": CITE,
            "columns": columns.collect::<Vec<_>>(),
        })
    }

    fn proved(&self) -> bool {
        matches!(self.numbers, Numbers::Exact | Numbers::Certified(_))
    }

    fn has_bounds(&self) -> bool {
        self.numbers != Numbers::Exact
    }

    /// What stands above a CSV or a function, line by line.
    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        let proved = if self.proved() { "" } else { " (not proved)" };
        let line = |key: &str, value: &str| format!("{key}: {value}");
        let mut lines = vec![format!("dalembert {}: reference", env!("CARGO_PKG_VERSION"))];
        lines.extend(self.head.title.iter().map(|title| line("title", title)));
        lines.extend(self.scene_lines().map(|scene| line("scene", scene)));
        lines.push(line("until", &format!("the history is followed to t = {}", self.until)));
        lines.push(line("numbers", &format!("{}: {}{proved}", self.head.number, self.promise(false))));
        lines.push(line("signs", SIGNS));
        lines.extend(self.head.exact_until.iter().map(|end| line("note", &format!("{end}; all is in digits"))));
        lines.extend(self.ends.clone());
        lines.extend(self.head.warnings.iter().map(|warning| line("warning", &warning.to_string().replace('\n', " "))));
        lines.push(line("cite", CITE));
        lines.into_iter()
    }

    fn comments(&self, columns: &[Described], bounds: &[f64]) -> String {
        if self.bare {
            return String::new();
        }
        let mut text: String = self.lines().map(|line| format!("# {line}\n")).collect();
        text += &format!("# read: {READ}\n");
        for ((column, unit), bound) in columns.iter().zip(bounds) {
            let within = match self.has_bounds() && !is_flag(*column) {
                true => format!("; within {}", bound_of_log2(*bound)),
                false => String::new(),
            };
            let symbol = if column.symbol().is_empty() { String::new() } else { format!("{}: ", column.symbol()) };
            let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
            text += &format!("# column {}: {symbol}{}{unit}{within}\n", column.name(), column.meaning());
        }
        text
    }
}

/// The rows of a golden file, kept aside until their bounds are known.
#[derive(Debug)]
pub(crate) struct Rows {
    format: Format,
    columns: Vec<Described>,
    digits: u32,
    /// One file with the text of all rows, or one with the doubles of each column.
    kept: Vec<BufWriter<File>>,
    /// `log₂` of the bound of each column.
    bounds: Vec<f64>,
    count: usize,
}

const BUFFER: usize = 1 << 16;

impl Rows {
    /// No rows yet. `digits` is how many a long number has, 0 for doubles and fractions.
    pub(crate) fn new(format: Format, columns: Vec<Described>, digits: u32) -> io::Result<Self> {
        let files = if format == Format::Npz { columns.len() } else { 1 };
        let kept = (0..files).map(|_| tempfile::tempfile().map(|file| BufWriter::with_capacity(BUFFER, file)));
        let (kept, bounds) = (kept.collect::<Result<_, _>>()?, vec![f64::NEG_INFINITY; columns.len()]);
        Ok(Rows { format, columns, digits, kept, bounds, count: 0 })
    }

    /// Adds rows, given column by column.
    pub(crate) fn push<S: Scalar>(&mut self, table: &[Vec<S>]) -> io::Result<()> {
        for (k, values) in table.iter().enumerate() {
            for value in values {
                self.bounds[k] = self.bounds[k].max(self.bound(value));
            }
        }
        let count = table.first().map_or(0, Vec::len);
        if self.format == Format::Npz {
            for (file, values) in self.kept.iter_mut().zip(table) {
                values.iter().try_for_each(|value| file.write_all(&written(value).to_le_bytes()))?;
            }
        } else {
            let mut text = Vec::with_capacity(BUFFER);
            for row in 0..count {
                self.row(&mut text, table, row);
                if text.len() > BUFFER / 2 || row + 1 == count {
                    self.kept.iter_mut().try_for_each(|file| file.write_all(&text))?;
                    text.clear();
                }
            }
        }
        self.count += count;
        Ok(())
    }

    /// Writes the file, or to standard output.
    pub(crate) fn finish(self, preamble: &Preamble<'_>, path: Option<&Path>) -> io::Result<()> {
        let Rows { format, columns, kept, bounds, count, .. } = self;
        let mut kept = kept.into_iter().map(|file| {
            let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
            file.rewind()?;
            Ok::<_, io::Error>(file)
        });
        write_filled(path, |file| match format {
            Format::Json => {
                let header = format!("{:#}", preamble.json(&columns, &bounds, false));
                write!(file, "{},\n  \"rows\": [", header.trim_end_matches("\n}"))?;
                kept.try_for_each(|rows| io::copy(&mut rows?, file).map(|_| ()))?;
                file.write_all(b"\n  ]\n}\n")
            }
            Format::Npz => {
                let mut npz = Npz::new(file, false);
                let header = format!("{:#}", preamble.json(&columns, &bounds, true)).into_bytes();
                npz.add("header", &[header.len()], header)?;
                for ((column, _), values) in columns.iter().zip(kept) {
                    let mut values = BufReader::new(values?);
                    let mut next = || {
                        let mut bytes = [0; 8];
                        values.read_exact(&mut bytes).map(|()| f64::from_le_bytes(bytes))
                    };
                    let values = (0..count).map(|_| next()).collect::<Result<Vec<_>, _>>()?;
                    match is_flag(*column) {
                        true => npz.add(column.name(), &[count], values.iter().map(|x| *x as i8).collect::<Vec<_>>()),
                        false => npz.add(column.name(), &[count], values),
                    }?;
                }
                npz.finish()
            }
            _ => {
                let names: Vec<&str> = columns.iter().map(|(column, _)| column.name()).collect();
                writeln!(file, "{}{}", preamble.comments(&columns, &bounds), names.join(","))?;
                kept.try_for_each(|rows| io::copy(&mut rows?, file).map(|_| ()))
            }
        })
    }

    /// `log₂` of how far the number meant may lie from what is written.
    fn bound<S: Scalar>(&self, value: &S) -> f64 {
        match value.as_double() {
            // What is zero within its bound is at most that bound.
            Some(_) if value.vanishes() == Ok(true) => value.log2_error() + 1.0,
            Some(_) => value.log2_error(),
            None if self.format == Format::Npz => double_bound(value),
            None => shown_bound(value, self.shown()),
        }
    }

    fn shown(&self) -> u32 {
        if self.digits == 0 { DOUBLE_DIGITS } else { self.digits }
    }

    fn row<S: Scalar>(&self, text: &mut Vec<u8>, table: &[Vec<S>], row: usize) {
        let [begin, between, end] = match self.format {
            Format::Json if self.count + row == 0 => ["\n    [", ", ", "]"],
            Format::Json => [",\n    [", ", ", "]"],
            _ => ["", ",", "\n"],
        };
        text.extend_from_slice(begin.as_bytes());
        for (k, ((column, _), values)) in self.columns.iter().zip(table).enumerate() {
            if k > 0 {
                text.extend_from_slice(between.as_bytes());
            }
            self.value(text, *column, &values[row]);
        }
        text.extend_from_slice(end.as_bytes());
    }

    fn value<S: Scalar>(&self, text: &mut Vec<u8>, column: Quantity, value: &S) {
        let json = self.format == Format::Json;
        if column == Quantity::Side {
            let quote = if json { "\"" } else { "" };
            let word = ["left", "both", "right"][(value.to_f64() + 1.0) as usize];
            return [quote, word, quote].iter().for_each(|part| text.extend_from_slice(part.as_bytes()));
        }
        if is_flag(column) {
            return text.push(if value.to_f64() > 0.0 { b'1' } else { b'0' });
        }
        match value.as_double() {
            // The shortest text that reads as the same double; no negative zero.
            Some(_) => text.extend_from_slice(ryu::Buffer::new().format(written(value)).as_bytes()),
            None if json => text.extend_from_slice(number_json(value, self.digits).to_string().as_bytes()),
            None => text.extend_from_slice(show(value, self.shown()).as_bytes()),
        }
    }
}

/// The double that is written: zero for what is zero within its bound, and never a negative zero.
fn written<S: Scalar>(value: &S) -> f64 {
    if value.vanishes() == Ok(true) { 0.0 } else { value.to_f64() }
}
