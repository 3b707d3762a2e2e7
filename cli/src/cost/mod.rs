//! `ulna cost`: what arms' code costs.

mod several;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use comfy_table::presets;
use comfy_table::{CellAlignment, Table};
use serde_json::{Map, Value, json};
use ulna_codegen::{Counts, Generated};
use ulna_table::Model;

use crate::methods::Methods;
use crate::progress::Progress;
use crate::{Verdict, base_parameters, console};

/// Count the operations of an arm's code, or of several arms' side by side
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna cost arms/ssrms.toml\n  ulna cost arms/ssrms.toml --json\n  \
                  ulna cost arms/ssrms.toml arms/oblique_6.toml\n  \
                  ulna cost arms/ssrms.toml --base-parameters"
)]
pub(crate) struct Arguments {
    /// Arm tables (TOML)
    #[arg(required = true, value_name = "TABLE")]
    tables: Vec<PathBuf>,
    #[command(flatten)]
    methods: Methods,
    /// Print JSON: the operations of each method of the trait Arm; for several arms a list of that
    #[arg(long)]
    json: bool,
    /// Print the base (minimal) inertial parameters instead, and what is grouped into each
    #[arg(long)]
    base_parameters: bool,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let Some(models) = models(&arguments.tables) else {
        return Ok(Verdict::Fail);
    };
    if arguments.base_parameters && arguments.json {
        print(models.iter().map(base_parameters::json).collect(), out)?;
    } else if arguments.base_parameters {
        for model in &models {
            base_parameters::write(model, out)?;
        }
    } else if arguments.json {
        let arms = arguments.tables.iter().zip(&models);
        let costs = arms.map(|(table, model)| Ok(json(model, &generate(arguments, table, model)?)));
        print(costs.collect::<anyhow::Result<_>>()?, out)?;
    } else {
        match (&*arguments.tables, &*models) {
            ([table], [model]) => write(arguments, table, model, out)?,
            (tables, models) => several::write(arguments, tables, models, out)?,
        }
        if let Some(absent) = arguments.methods.absent() {
            writeln!(out, "by the textbook formulas: {absent}")?;
        }
    }
    Ok(Verdict::Pass)
}

/// What is in the tables; none if one has errors, after those of all of them have been reported.
fn models(tables: &[PathBuf]) -> Option<Vec<Model>> {
    let models = tables.iter().map(|table| {
        console::load(table)
            .map_err(|errors| console::report(&errors))
            .ok()
    });
    // All of them are read, whatever is wrong with the first.
    let models: Vec<_> = models.collect();
    models.into_iter().collect()
}

fn generate(arguments: &Arguments, table: &Path, model: &Model) -> anyhow::Result<Generated> {
    let progress = Progress::new()?;
    let generated = arguments.methods.generator().generate_watched(
        model,
        &table.display().to_string(),
        &|stage| progress.says(format_args!("{}: {stage}", model.name())),
    );
    drop(progress);
    console::warnings(table, generated.warnings());
    Ok(generated)
}

/// What was asked of one arm, or a list for several.
fn print(mut values: Vec<Value>, out: &mut dyn Write) -> io::Result<()> {
    let value = match values.len() {
        1 => values.remove(0),
        _ => values.into(),
    };
    writeln!(out, "{value:#}")
}

/// One arm, with each kind of operation.
fn write(
    arguments: &Arguments,
    path: &Path,
    model: &Model,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let start = Instant::now();
    let generated = generate(arguments, path, model)?;
    let lines = generated.source().lines().count();
    let seconds = start.elapsed().as_secs_f64();
    writeln!(
        out,
        "{}: {lines} lines, generated in {seconds:.3} s",
        model.name()
    )?;
    writeln!(out, "{}", table(&generated))?;
    Ok(())
}

fn json(model: &Model, generated: &Generated) -> Value {
    let counts = |counts: &Counts| {
        let operations = counts.operations.iter().copied();
        let sums = [("sin_cos", counts.sin_cos), ("total", counts.total)];
        let entries = operations.chain(sums);
        Value::Object(
            entries
                .map(|(name, count)| (name.to_owned(), count.into()))
                .collect(),
        )
    };
    let quantities: Map<_, _> = generated
        .counts()
        .iter()
        .map(|(method, count)| (method.name().to_owned(), counts(count)))
        .collect();
    json!({ "arm": model.name(), "quantities": quantities })
}

/// One row for each method, one column for each operation; `total` is without `sin_cos`.
fn table(generated: &Generated) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    let names = generated
        .counts()
        .first()
        .map(|(_, counts)| &counts.operations);
    let names = names.into_iter().flatten().map(|(name, _)| *name);
    table.set_header(
        ["method"]
            .into_iter()
            .chain(names)
            .chain(["total", "sin_cos"]),
    );
    for (method, counts) in generated.counts() {
        let operations = counts.operations.iter().map(|(_, count)| count);
        let cells = operations.chain([&counts.total, &counts.sin_cos]);
        let cells = cells.map(ToString::to_string);
        table.add_row([method.name().to_owned()].into_iter().chain(cells));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
