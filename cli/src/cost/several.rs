//! The operations of several arms side by side.

use std::io::Write;
use std::path::PathBuf;

use comfy_table::Table;
use ulna_table::Model;

use super::{Arguments, generate};
use crate::columns;

/// A row for each method, a column for each arm.
pub(super) fn write(
    arguments: &Arguments,
    tables: &[PathBuf],
    models: &[Model],
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let arms = tables.iter().zip(models);
    let arms: Vec<_> = arms
        .map(|(table, model)| generate(arguments, table, model))
        .collect::<anyhow::Result<_>>()?;
    let mut table = Table::new();
    let names = models.iter().map(Model::name);
    table.set_header(["method"].into_iter().chain(names));
    // Every arm has the same methods in the same order.
    let methods = arms.first().map_or(&[][..], |arm| arm.counts());
    for (row, (method, _)) in methods.iter().enumerate() {
        let cells = arms.iter().map(|arm| {
            let (_, counts) = &arm.counts()[row];
            format!("{} + {}", counts.total, counts.sin_cos)
        });
        table.add_row([method.name().to_owned()].into_iter().chain(cells));
    }
    writeln!(
        out,
        "operations + pairs of a sine and a cosine, a call\n{}",
        columns::plain(table, &[0])
    )?;
    Ok(())
}
