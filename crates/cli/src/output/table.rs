//! Tables for a person.

use super::column::{Column, Kind};
use super::dataset::{Cell, Dataset, greatest};
use crate::terminal;
use dalembert_compare::aligned::table as aligned;

/// Significant digits of a double in a table.
const TABLE_DIGITS: u32 = 12;

impl Dataset {
    /// Returns the columns that have a head as a table; without rows only the text around them.
    pub(crate) fn table(&self) -> String {
        let [above, below] = &self.around;
        if self.rows.is_empty() {
            return format!("{above}{below}");
        }
        let digits = table_digits(self.digits);
        let shown = |column: &&Column| column.head.is_some();
        let columns: Vec<&Column> = self.columns.iter().filter(shown).collect();
        let head: Vec<&str> = columns.iter().filter_map(|column| column.head.as_deref()).collect();
        let places = (0..self.columns.len()).filter(|place| self.columns[*place].head.is_some());
        let greatest: Vec<f64> = places.map(|place| greatest(self.rows.iter().map(|row| &row[place]))).collect();
        let row = |row: &Vec<Cell>| {
            let cells = self.columns.iter().zip(row).filter(|(column, _)| shown(column));
            cells.zip(&greatest).map(|((_, cell), greatest)| cell.table_text(digits, *greatest)).collect()
        };
        let rows = self.rows.iter().map(row).collect();
        let words = columns.iter().take_while(|column| column.kind == Kind::Word).count();
        let table = TextTable { head: &head, rows, words, keys: self.keys }.format();
        format!("{above}{table}{below}")
    }
}

/// Returns the significant digits of a number in a table, where a long number has `digits`, or 0.
pub(crate) fn table_digits(digits: u32) -> u32 {
    if digits == 0 { TABLE_DIGITS } else { digits }
}

/// A table of texts.
pub(super) struct TextTable<'a> {
    pub(super) head: &'a [&'a str],
    pub(super) rows: Vec<Vec<String>>,
    /// Number of columns, from the first, that stand to the left.
    pub(super) words: usize,
    /// Number of columns that each part begins with where the table is wider than the page; `None` to keep it wide.
    pub(super) keys: Option<usize>,
}

impl TextTable<'_> {
    /// Returns the table. Columns that do not fit follow in further tables, each with the key columns again.
    pub(super) fn format(self) -> String {
        let TextTable { head, rows, words, keys } = self;
        let Some(keys) = keys else { return aligned(head, rows, words) };
        let select = |columns: &[usize]| {
            let head: Vec<&str> = columns.iter().filter_map(|k| head.get(*k).copied()).collect();
            let pick = |row: &Vec<String>| columns.iter().filter_map(|k| row.get(*k).cloned()).collect();
            aligned(&head, rows.iter().map(pick).collect(), words)
        };
        let mut parts = Vec::new();
        let keys: Vec<usize> = (0..keys).collect();
        let mut columns = keys.clone();
        for k in keys.len()..head.len() {
            columns.push(k);
            let widest = select(&columns).lines().map(|line| line.chars().count()).max().unwrap_or(0);
            if widest > terminal::width() && columns.len() > keys.len() + 1 {
                columns.pop();
                parts.push(select(&columns));
                columns = [&keys[..], &[k]].concat();
            }
        }
        parts.push(select(&columns));
        // Numbers so long that hardly two columns stand side by side: a row is a block, with a line for each number.
        if parts.len() > 2 && 2 * parts.len() > head.len() {
            return blocks(head, &rows);
        }
        parts.join("\n\n")
    }
}

/// Returns a block for each row, with a line for each of its numbers.
fn blocks(head: &[&str], rows: &[Vec<String>]) -> String {
    let widest = head.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let block = |row: &Vec<String>| {
        let lines = head.iter().zip(row).map(|(name, text)| {
            let space = " ".repeat(widest - name.chars().count());
            // Aligned at the first digit, so that signs stand out.
            let sign = if text.starts_with('-') { "" } else { " " };
            format!(" {name}{space}  {sign}{text}")
        });
        lines.collect::<Vec<_>>().join("\n")
    };
    rows.iter().map(block).collect::<Vec<_>>().join("\n\n")
}

/// Returns a text in lines of at most `width` characters, the lines after the first indented.
pub(crate) fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let options = textwrap::Options::new(width)
        .subsequent_indent(indent)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    textwrap::fill(text, options)
}
