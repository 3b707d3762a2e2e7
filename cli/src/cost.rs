//! `ulna cost`: what an arm's code costs.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use comfy_table::presets;
use comfy_table::{CellAlignment, Table};
use serde_json::{Map, Value, json};
use ulna::Method;
use ulna_codegen::{Counts, Generated};
use ulna_table::Model;

use crate::methods::Methods;
use crate::progress::Progress;
use crate::{Verdict, base_parameters, console};

/// Count the operations of an arm's code
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna cost arms/ssrms.toml\n  ulna cost arms/ssrms.toml --json\n  \
                  ulna cost arms/ssrms.toml --base-parameters"
)]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    #[command(flatten)]
    methods: Methods,
    /// Print JSON: the operations of each method of the trait Arm
    #[arg(long)]
    json: bool,
    /// Print the arm's base (minimal) inertial parameters instead, and what is grouped into each
    #[arg(long)]
    base_parameters: bool,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let model = console::load(&arguments.table)?;
    if arguments.base_parameters {
        base_parameters::print(&model, arguments.json, out)?;
        return Ok(Verdict::Pass);
    }
    let start = Instant::now();
    let progress = Progress::new()?;
    let generated = arguments.methods.generator().generate_watched(
        &model,
        &arguments.table.display().to_string(),
        &|stage| progress.says(stage),
    );
    progress.says("laying out");
    let lines = generated.source().lines().count();
    let seconds = start.elapsed().as_secs_f64();
    drop(progress);
    console::warnings(&arguments.table, generated.warnings());
    if arguments.json {
        writeln!(out, "{:#}", json(&model, &generated))?;
    } else {
        writeln!(
            out,
            "{}: {lines} lines, generated in {seconds:.3} s",
            model.name()
        )?;
        writeln!(out, "{}", table(&generated))?;
        let absent: Vec<&str> = arguments
            .methods
            .absent()
            .iter()
            .map(Method::name)
            .collect();
        if !absent.is_empty() {
            writeln!(out, "by the textbook formulas: {}", absent.join(", "))?;
        }
    }
    Ok(Verdict::Pass)
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
