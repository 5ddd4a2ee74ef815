//! Tables for a person.

use super::dataset::{Cell, Column, Dataset};
use dalembert_compare::aligned::table as aligned;

/// Characters that a table may be wide where nothing else is asked for.
pub(crate) const WIDTH: usize = 80;
/// Significant digits of a double in a table.
const TABLE_DIGITS: u32 = 12;

impl Dataset {
    /// The columns that have a head; without rows only what stands around them.
    pub(crate) fn table(&self) -> String {
        let [above, below] = &self.around;
        if self.rows.is_empty() {
            return format!("{above}{below}");
        }
        let digits = table_digits(self.digits);
        let shown = |column: &&Column| column.head.is_some();
        let columns: Vec<&Column> = self.columns.iter().filter(shown).collect();
        let header: Vec<&str> = columns.iter().filter_map(|column| column.head.as_deref()).collect();
        let row = |row: &Vec<Cell>| {
            let cells = self.columns.iter().zip(row).filter(|(column, _)| shown(column));
            cells.map(|(_, cell)| cell.text(digits, "–")).collect()
        };
        let rows: Vec<Vec<String>> = self.rows.iter().map(row).collect();
        let words = columns.iter().take_while(|column| column.is_text).count();
        let table = match self.keys {
            Some(keys) => fitted(&header, &rows, words, keys),
            None => aligned(&header, rows, words),
        };
        format!("{above}{table}{below}")
    }
}

/// Significant digits of a number in a table, where a long one has so many, or 0.
pub(super) fn table_digits(digits: u32) -> u32 {
    if digits == 0 { TABLE_DIGITS } else { digits }
}

/// A table of at most [`WIDTH`] characters: columns that do not fit follow in further tables, each with the first
/// `keys` columns again.
fn fitted(header: &[&str], rows: &[Vec<String>], words: usize, keys: usize) -> String {
    let select = |columns: &[usize]| {
        let header: Vec<&str> = columns.iter().filter_map(|k| header.get(*k).copied()).collect();
        let pick = |row: &Vec<String>| columns.iter().filter_map(|k| row.get(*k).cloned()).collect();
        aligned(&header, rows.iter().map(pick).collect(), words)
    };
    let mut parts = Vec::new();
    let keys: Vec<usize> = (0..keys).collect();
    let mut columns = keys.clone();
    for k in keys.len()..header.len() {
        columns.push(k);
        let widest = select(&columns).lines().map(|line| line.chars().count()).max().unwrap_or(0);
        if widest > WIDTH && columns.len() > keys.len() + 1 {
            columns.pop();
            parts.push(select(&columns));
            columns = [&keys[..], &[k]].concat();
        }
    }
    parts.push(select(&columns));
    // Numbers so long that hardly two columns stand side by side: a row is a block, with a line for each number.
    if parts.len() > 2 && 2 * parts.len() > header.len() {
        return blocks(header, rows);
    }
    parts.join("\n\n")
}

/// A block for each row, with a line for each of its numbers.
fn blocks(header: &[&str], rows: &[Vec<String>]) -> String {
    let widest = header.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let block = |row: &Vec<String>| {
        let lines = header.iter().zip(row).map(|(name, text)| {
            let space = " ".repeat(widest - name.chars().count());
            // Aligned at the first digit, so that signs stand out.
            let sign = if text.starts_with('-') { "" } else { " " };
            format!(" {name}{space}  {sign}{text}")
        });
        lines.collect::<Vec<_>>().join("\n")
    };
    rows.iter().map(block).collect::<Vec<_>>().join("\n\n")
}

/// A text in lines of so many characters, those after the first indented.
pub(crate) fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let options = textwrap::Options::new(width)
        .subsequent_indent(indent)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    textwrap::fill(text, options)
}
