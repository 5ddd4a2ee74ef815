//! Columns in text: separated by commas, semicolons, tabs or spaces, with comments and a header or without.

use std::io::{BufRead, BufReader, Read};

use super::error::{DataError, DataErrorKind};
use crate::number::{Number, short};

/// A text, read up to its first row.
pub(super) struct Text {
    reader: BufReader<Box<dyn Read + Send>>,
    /// What a line ends with: `\n`, before which a `\r` is white space, or `\r` alone.
    end: u8,
    separator: Option<char>,
    /// The names of the columns; empty where there are none.
    pub(super) names: Vec<String>,
    /// How many names a header has, where they are not as many as the columns.
    pub(super) misnamed: Option<usize>,
    /// Whether a first line `rows columns` was skipped.
    pub(super) sized: bool,
    /// A line that was read ahead, and its number.
    held: Option<(Vec<u8>, usize)>,
    /// The line that was read last, and its number.
    line: Vec<u8>,
    number: usize,
    pub(super) width: usize,
}

/// Where rows stand in a text: the first row of every stretch without empty lines and comments, with its line. Empty
/// where rows have no lines.
#[derive(Debug, Default)]
pub(super) struct Lines(Vec<(usize, usize)>);

impl Lines {
    pub(super) fn note(&mut self, row: usize, line: usize) {
        if self.of(row) != Some(line) {
            self.0.push((row, line));
        }
    }

    /// The line of a row, counted from 1, the row from 0.
    pub(super) fn of(&self, row: usize) -> Option<usize> {
        let k = self.0.partition_point(|(first, _)| *first <= row).checked_sub(1)?;
        self.0.get(k).map(|(first, line)| line + row - first)
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

/// A number as any language prints it: Fortran's `1.5D-3` and `1.5-103` too, in quotes, and fractions.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| {
        let text = text.trim_matches('"').trim();
        let fraction = || text.contains('/').then(|| text.parse::<Number>().ok()).flatten();
        let number = text.replace(['d', 'D'], "e").parse().ok().or_else(|| without_letter(text));
        number.or_else(|| fraction().map(|number| number.to_f64()))
    })
}

/// `1.5-103`: beside three digits of an exponent Fortran has no room for its letter.
fn without_letter(text: &str) -> Option<f64> {
    let (mantissa, exponent) = text.split_at_checked(text.len().checked_sub(4)?)?;
    let has_sign = exponent.starts_with(['+', '-']) && mantissa.contains('.');
    has_sign.then(|| format!("{mantissa}e{exponent}").parse().ok()).flatten()
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

/// What separates the fields; `None` for white space. Commas that all stand between two digits, in a row with white
/// space, are those of decimals.
fn separator(row: &str) -> Option<char> {
    let bytes = row.as_bytes();
    let digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
    let decimal = |(at, _): (usize, &str)| digit(at.checked_sub(1)) && digit(Some(at + 1));
    let decimals = || row.contains([' ', '\t']) && row.match_indices(',').all(decimal);
    [';', ','].into_iter().find(|separator| row.contains(*separator)).filter(|found| *found == ';' || !decimals())
}

/// The columns of a line `rows columns`.
fn sizes(row: &str, separator: Option<char>) -> Option<usize> {
    let whole: Vec<usize> = fields(row, separator).map(|field| field.parse().ok()).collect::<Option<_>>()?;
    whole.get(1).copied()
}

/// The names of a header; where white space separates them, a unit in brackets belongs to the name before it.
fn names(header: &str, separator: Option<char>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let open = |name: &str| name.matches(['[', '(']).count() > name.matches([']', ')']).count();
    for name in fields(header, separator).map(|name| name.trim_matches(['"', '\'']).trim()) {
        match names.last_mut() {
            Some(last) if separator.is_none() && (name.starts_with(['[', '(']) || open(last)) => {
                *last += &format!(" {name}")
            }
            _ => names.push(name.to_string()),
        }
    }
    names
}

impl Text {
    /// Reads up to the first row. A first line that begins with a word is the header; so is the last comment before
    /// the first row where it has as many words as the row has numbers.
    pub(super) fn open(mut reader: BufReader<Box<dyn Read + Send>>, file: &str) -> Result<Self, DataError> {
        let start = reader.fill_buf().map_err(|error| DataErrorKind::Unreadable(error.to_string()).at(file, None))?;
        let end = if start.contains(&b'\r') && !start.contains(&b'\n') { b'\r' } else { b'\n' };
        let (line, none) = (Vec::new(), Vec::new());
        let mut text = Text {
            reader,
            end,
            separator: None,
            names: none,
            misnamed: None,
            sized: false,
            held: None,
            line,
            number: 0,
            width: 0,
        };
        let mut comment = String::new();
        let mut header: Option<String> = None;
        while text.next(file)? {
            let row = text.row(file)?.to_string();
            if let Some(words) = row.strip_prefix(COMMENTS) {
                comment = words.trim_start_matches(COMMENTS).trim().to_string();
                continue;
            }
            text.separator = separator(&row);
            let first = fields(&row, text.separator).find(|field| !field.is_empty());
            if header.is_none() && first.is_some_and(|field| side(field).is_none()) {
                header = Some(row);
                continue;
            }
            text.width = fields(&row, text.separator).count();
            // A line `rows columns` above as many columns, as NumPy's writers and Siconos have it.
            if let (None, 2, Some(width)) = (&header, text.width, sizes(&row, text.separator)) {
                let (line, number) = (text.line.clone(), text.number);
                if text.next(file)? && fields(text.row(file)?, text.separator).count() == width && width > 2 {
                    text.width = width;
                    text.sized = true;
                } else {
                    text.held = Some((std::mem::replace(&mut text.line, line), text.number));
                    text.number = number;
                }
            }
            let words = header.as_ref().unwrap_or(&comment);
            text.names = names(words, separator(words));
            if text.names.len() != text.width {
                text.misnamed = header.map(|_| text.names.len());
                text.names.clear();
            }
            return Ok(text);
        }
        Err(DataErrorKind::Empty.at(file, None))
    }

    /// Reads the next line that is not empty; `false` at the end.
    fn next(&mut self, file: &str) -> Result<bool, DataError> {
        if let Some((line, number)) = self.held.take() {
            (self.line, self.number) = (line, number);
            return Ok(!self.line.is_empty());
        }
        loop {
            self.line.clear();
            let read = self.reader.read_until(self.end, &mut self.line);
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
        // A zero is half of a character of UTF-16.
        let text = std::str::from_utf8(&self.line).ok().filter(|text| !text.contains('\0'));
        let text = text.ok_or_else(|| DataErrorKind::NotText.at(file, place()))?;
        Ok(text.trim_start_matches('\u{feff}').trim())
    }

    /// Reads all rows, of each the fields at `which`, and that at `words` as a side.
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
                            let kind = match is_side {
                                true => DataErrorKind::Side(short(field)),
                                false => DataErrorKind::not_a_number(field),
                            };
                            return Err(kind.at(file, place));
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
