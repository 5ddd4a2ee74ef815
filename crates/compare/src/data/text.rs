//! Columns of text, separated by commas, semicolons, tabs or spaces, with comments and a header or without.

use std::io::{BufRead, BufReader, Read};

use super::error::{DataError, DataErrorKind};
use dalembert::number::{Number, short};

/// A line that is not empty, with its number.
type NumberedLine = Result<(usize, String), DataError>;

/// The rows of a text, of `width` fields each.
pub(super) struct Text {
    lines: Box<dyn Iterator<Item = NumberedLine> + Send>,
    separator: Option<char>,
    width: usize,
}

/// Returns the lines of a text; a `\r` before the end of a line is white space.
fn lines(reader: impl BufRead, end: u8, file: String) -> impl Iterator<Item = NumberedLine> {
    reader.split(end).zip(1..).filter_map(move |(line, number)| {
        let line = match line {
            Ok(line) if line.trim_ascii().is_empty() => return None,
            Ok(line) => line,
            Err(error) => return Some(Err(DataErrorKind::Unreadable(error.to_string()).at(&file, None))),
        };
        // A zero is half of a character of UTF-16.
        let text = String::from_utf8(line).ok().filter(|text| !text.contains('\0'));
        let not_text = || DataErrorKind::NotText.at(&file, Some(format!("line {number}")));
        Some(text.map(|text| (number, text)).ok_or_else(not_text))
    })
}

fn trimmed(line: &str) -> &str {
    line.trim_start_matches('\u{feff}').trim()
}

const COMMENTS: [char; 3] = ['#', '%', '!'];

/// Returns the fields of a row; a separator at its end begins no further field.
fn fields(row: &str, separator: Option<char>) -> impl Iterator<Item = &str> {
    let (separated, spaced) = match separator {
        Some(separator) => (Some(row.strip_suffix(separator).unwrap_or(row).split(separator).map(str::trim)), None),
        None => (None, Some(row.split_ascii_whitespace())),
    };
    separated.into_iter().flatten().chain(spaced.into_iter().flatten())
}

/// Reads a number as any language prints it, such as Fortran's `1.5D-3` and `1.5-103`, in quotes, or as a fraction.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| {
        let text = text.trim_matches('"').trim();
        let fraction = || text.contains('/').then(|| text.parse::<Number>().ok()).flatten();
        let number = text.replace(['d', 'D'], "e").parse().ok().or_else(|| without_letter(text));
        number.or_else(|| fraction().map(|number| number.to_f64()))
    })
}

/// Reads `1.5-103`: Fortran leaves out the letter before three digits of an exponent.
fn without_letter(text: &str) -> Option<f64> {
    let (mantissa, exponent) = text.split_at_checked(text.len().checked_sub(4)?)?;
    let has_sign = exponent.starts_with(['+', '-']) && mantissa.contains('.');
    has_sign.then(|| format!("{mantissa}e{exponent}").parse().ok()).flatten()
}

/// Reads the limit that a row holds, as a word or a number.
fn side(text: &str) -> Option<f64> {
    match text.trim_matches('"') {
        "left" => Some(-1.0),
        "both" => Some(0.0),
        "right" => Some(1.0),
        other => number(other),
    }
}

/// Returns the separator of the fields; `None` for white space. Commas that all stand between two digits, in a row with
/// white space, are decimal commas.
fn separator(row: &str) -> Option<char> {
    let bytes = row.as_bytes();
    let digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
    let decimal = |(at, _): (usize, &str)| digit(at.checked_sub(1)) && digit(Some(at + 1));
    let decimals = || row.contains([' ', '\t']) && row.match_indices(',').all(decimal);
    [';', ','].into_iter().find(|separator| row.contains(*separator)).filter(|found| *found == ';' || !decimals())
}

/// Returns the number of columns in a line `rows columns`.
fn sizes(row: &str, separator: Option<char>) -> Option<usize> {
    let whole: Vec<usize> = fields(row, separator).map(|field| field.parse().ok()).collect::<Option<_>>()?;
    whole.get(1).copied()
}

/// Returns the names of a header; where white space separates them, a unit in brackets belongs to the name before it.
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

/// The names and the number of the columns, known before the rows are read.
pub(crate) struct Head {
    /// The names of the columns; empty where they have none.
    pub(crate) names: Vec<String>,
    pub(crate) width: usize,
    /// The number of names of a header, where it differs from that of the columns.
    pub(crate) misnamed: Option<usize>,
    /// Whether a first line `rows columns` was skipped.
    pub(crate) is_sized: bool,
}

impl Text {
    /// Reads up to the first row. A first line that begins with a word is the header; so is the last comment before
    /// the first row where it has as many words as the row has numbers.
    pub(super) fn open(mut reader: BufReader<Box<dyn Read + Send>>, file: &str) -> Result<(Self, Head), DataError> {
        let start = reader.fill_buf().map_err(|error| DataErrorKind::Unreadable(error.to_string()).at(file, None))?;
        let end = if start.contains(&b'\r') && !start.contains(&b'\n') { b'\r' } else { b'\n' };
        let mut lines = lines(reader, end, file.into());
        let (mut comment, mut header) = (String::new(), None);
        while let Some((number, line)) = lines.next().transpose()? {
            let row = trimmed(&line);
            if let Some(words) = row.strip_prefix(COMMENTS) {
                comment = words.trim_start_matches(COMMENTS).trim().to_string();
                continue;
            }
            let separator = separator(row);
            let first = fields(row, separator).find(|field| !field.is_empty());
            if header.is_none() && first.is_some_and(|field| side(field).is_none()) {
                header = Some(row.to_string());
                continue;
            }
            let (mut width, sizes) = (fields(row, separator).count(), sizes(row, separator));
            let (mut first, mut sized) = (vec![(number, line)], false);
            // Siconos writes a line `rows columns` above its rows.
            if let (None, 2, Some(columns)) = (&header, width, sizes) {
                first.extend(lines.next().transpose()?);
                sized = columns > 2
                    && first.get(1).is_some_and(|(_, line)| fields(trimmed(line), separator).count() == columns);
                if sized {
                    width = columns;
                    first.remove(0);
                }
            }
            let words = header.as_ref().unwrap_or(&comment);
            let mut names = names(words, self::separator(words));
            let misnamed = header.filter(|_| names.len() != width).map(|_| names.len());
            if names.len() != width {
                names.clear();
            }
            let lines = Box::new(first.into_iter().map(Ok).chain(lines));
            return Ok((Text { lines, separator, width }, Head { names, width, misnamed, is_sized: sized }));
        }
        Err(DataErrorKind::Empty.at(file, None))
    }

    /// Reads the fields at `which` of all rows, the one at `words` as a side, and returns the columns and the line
    /// number of each row.
    pub(super) fn read(
        self,
        which: &[usize],
        words: Option<usize>,
        file: &str,
    ) -> Result<(Vec<Vec<f64>>, Vec<usize>), DataError> {
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); which.len()];
        let mut numbers = Vec::new();
        // The columns that each field goes to.
        let takers: Vec<Vec<usize>> =
            (0..self.width).map(|place| (0..which.len()).filter(|k| which[*k] == place).collect()).collect();
        for line in self.lines {
            let (line_number, line) = line?;
            let row = trimmed(&line);
            if row.starts_with(COMMENTS) {
                continue;
            }
            numbers.push(line_number);
            let mut found = 0;
            for field in fields(row, self.separator) {
                for taker in takers.get(found).into_iter().flatten() {
                    let is_side = words == Some(found);
                    let Some(value) = (if is_side { side(field) } else { number(field) }) else {
                        let place = Some(format!("line {line_number}, column {}", found + 1));
                        let kind = match field.contains(',') {
                            _ if is_side => DataErrorKind::Side,
                            true => DataErrorKind::DecimalComma,
                            false => DataErrorKind::NotANumber,
                        };
                        return Err(kind(short(field)).at(file, place));
                    };
                    values[*taker].push(value);
                }
                found += 1;
            }
            if found != self.width {
                let (place, expected) = (Some(format!("line {line_number}")), self.width);
                return Err(DataErrorKind::Ragged { found, expected }.at(file, place));
            }
        }
        Ok((values, numbers))
    }
}
