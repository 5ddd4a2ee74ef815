//! Columns in text: separated by commas, semicolons, tabs or spaces, with comments and a header or without.

use std::io::{BufRead, BufReader, Read};

use super::{DataError, DataErrorKind, Lines};
use crate::number::Number;

/// A text, read up to its first row.
pub(super) struct Text {
    reader: BufReader<Box<dyn Read + Send>>,
    separator: Option<char>,
    /// The names of the columns; empty where there are none.
    pub(super) names: Vec<String>,
    /// The line that was read last, and its number.
    line: Vec<u8>,
    number: usize,
    width: usize,
}

impl std::fmt::Debug for Text {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Text").field("names", &self.names).field("width", &self.width).finish_non_exhaustive()
    }
}

/// What a comment begins with.
const COMMENTS: [char; 3] = ['#', '%', '!'];

/// The fields of a row; a separator at its end begins no other field.
fn fields(row: &str, separator: Option<char>) -> impl Iterator<Item = &str> {
    let (separated, spaced) = match separator {
        Some(separator) => (Some(row.strip_suffix(separator).unwrap_or(row).split(separator).map(str::trim)), None),
        None => (None, Some(row.split_ascii_whitespace())),
    };
    separated.into_iter().flatten().chain(spaced.into_iter().flatten())
}

/// A number as any language prints it: Fortran's `1.5D-3` too, and fractions.
fn number(text: &str) -> Option<f64> {
    let fraction = || text.contains('/').then(|| text.parse::<Number>().ok()).flatten();
    let number = text.parse().ok().or_else(|| text.replace(['d', 'D'], "e").parse().ok());
    number.or_else(|| fraction().map(|number| number.to_f64()))
}

/// Which limit a row holds, as a word or a number.
fn side(text: &str) -> Option<f64> {
    match text.trim_matches('"') {
        "left" => Some(-1.0),
        "both" => Some(0.0),
        "right" => Some(1.0),
        other => number(other),
    }
}

fn separator(row: &str) -> Option<char> {
    [';', ','].into_iter().find(|separator| row.contains(*separator))
}

fn names(header: &str, separator: Option<char>) -> Vec<String> {
    fields(header, separator).map(|name| name.trim_matches(['"', '\'']).trim().to_string()).collect()
}

impl Text {
    /// Reads up to the first row. A first line that holds a word is the header; so is the last comment before the first
    /// row where it has as many words as the row has numbers.
    ///
    /// **Errors**: a file that cannot be read, is not text, or holds no row.
    pub(super) fn open(reader: BufReader<Box<dyn Read + Send>>, file: &str) -> Result<Self, DataError> {
        let (line, number) = (Vec::new(), 0);
        let mut text = Text { reader, separator: None, names: Vec::new(), line, number, width: 0 };
        let mut comment = String::new();
        let mut header: Option<String> = None;
        while text.next(file)? {
            let row = text.row(file)?.to_string();
            if let Some(words) = row.strip_prefix(COMMENTS) {
                comment = words.trim_start_matches(COMMENTS).trim().to_string();
                continue;
            }
            text.separator = separator(&row);
            if header.is_none() && fields(&row, text.separator).any(|field| side(field).is_none()) {
                header = Some(row);
                continue;
            }
            text.width = fields(&row, text.separator).count();
            text.names = match header {
                Some(header) => names(&header, separator(&header)),
                None => names(&comment, separator(&comment)),
            };
            if text.names.len() != text.width {
                text.names.clear();
            }
            return Ok(text);
        }
        Err(DataErrorKind::Empty.at(file, None))
    }

    /// How many columns there are.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Reads the next line that is not empty; `false` at the end.
    fn next(&mut self, file: &str) -> Result<bool, DataError> {
        loop {
            self.line.clear();
            let read = self.reader.read_until(b'\n', &mut self.line);
            self.number += 1;
            match read {
                Ok(0) => return Ok(false),
                Ok(_) if self.line.trim_ascii().is_empty() => {}
                Ok(_) => return Ok(true),
                Err(error) => return Err(DataErrorKind::Unreadable(error.to_string()).at(file, None)),
            }
        }
    }

    fn row(&self, file: &str) -> Result<&str, DataError> {
        let place = || Some(format!("line {}", self.number));
        let text = std::str::from_utf8(&self.line).map_err(|_| DataErrorKind::NotText.at(file, place()))?;
        Ok(text.trim_start_matches('\u{feff}').trim())
    }

    /// Reads all rows, of each the fields at `which`, and that at `words` as a side.
    ///
    /// **Errors**: a row of another width, a field that is no number.
    pub(super) fn read(
        mut self,
        which: &[usize],
        words: Option<usize>,
        file: &str,
    ) -> Result<(Vec<Vec<f64>>, Lines), DataError> {
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); which.len()];
        let mut lines = Lines::default();
        let mut rows = 0;
        // Of each field, the columns that take it.
        let takers: Vec<Vec<usize>> =
            (0..self.width).map(|place| (0..which.len()).filter(|k| which[*k] == place).collect()).collect();
        loop {
            let row = self.row(file)?;
            if !row.starts_with(COMMENTS) {
                lines.note(rows, self.number);
                let mut found = 0;
                for field in fields(row, self.separator) {
                    for taker in takers.get(found).into_iter().flatten() {
                        let is_side = words == Some(found);
                        let Some(value) = (if is_side { side(field) } else { number(field) }) else {
                            let place = Some(format!("line {}, column {}", self.number, found + 1));
                            let kind = if is_side { DataErrorKind::Side } else { DataErrorKind::NotANumber };
                            return Err(kind(field.into()).at(file, place));
                        };
                        values[*taker].push(value);
                    }
                    found += 1;
                }
                if found != self.width {
                    let (place, expected) = (Some(format!("line {}", self.number)), self.width);
                    return Err(DataErrorKind::Ragged { found, expected }.at(file, place));
                }
                rows += 1;
            }
            if !self.next(file)? {
                return Ok((values, lines));
            }
        }
    }
}
