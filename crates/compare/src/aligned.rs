//! Tables of text with aligned columns.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};

/// Formats a table with a header; the first `words` columns are aligned to the left, the others to the right.
pub fn table(header: &[&str], rows: Vec<Vec<String>>, words: usize) -> String {
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING.header_separator(LineStyle::none().fill('─').junction('─')))
        .set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header.to_vec());
    for row in rows {
        table.add_row(row);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        column.set_cell_alignment(if k < words { CellAlignment::Left } else { CellAlignment::Right });
    }
    table.trim_fmt()
}
