//! Tables on the console.

use comfy_table::{CellAlignment, Table, presets};

/// Without lines; the columns `left` to the left, numbers to the right.
pub(crate) fn plain(mut table: Table, left: &[usize]) -> String {
    table.load_style(presets::NOTHING);
    for (index, column) in table.column_iter_mut().enumerate() {
        if !left.contains(&index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt()
}
