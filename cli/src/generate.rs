//! `ulna generate`: a table in, Rust out.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;

use crate::methods::Methods;
use crate::output::{refuse_special, write_whole};
use crate::progress::Progress;
use crate::{Verdict, console};

/// Emit the Rust code of an arm
#[derive(Args)]
#[command(after_help = "Examples:\n  ulna generate arms/planar_2r.toml\n  \
                  ulna generate arms/ssrms.toml --methods mass_matrix,inverse_dynamics\n  \
                  ulna generate arms/planar_2r.toml --output target/planar_2r.rs")]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    #[command(flatten)]
    methods: Methods,
    /// The file to write, whole or not at all; without it the code goes to stdout.
    /// A symbolic link stays, and the file that it leads to is written; a device, pipe or socket is refused
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write nothing; fail if the file is not what would be written
    #[arg(long, requires = "output")]
    check: bool,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let model = console::load(&arguments.table)?;
    let progress = Progress::new()?;
    let generated = arguments.methods.generator().generate_watched(
        &model,
        &arguments.table.display().to_string(),
        &|stage| progress.says(stage),
    );
    progress.says("laying out");
    let code = generated.source();
    drop(progress);
    console::warnings(&arguments.table, generated.warnings());
    match &arguments.output {
        None => out.write_all(code.as_bytes())?,
        Some(file) if arguments.check => check(file, &code, arguments)?,
        Some(file) => write_whole(file, code.as_bytes())?,
    }
    Ok(Verdict::Pass)
}

fn check(file: &Path, code: &str, arguments: &Arguments) -> anyhow::Result<()> {
    refuse_special(file)?;
    let old = fs::read(file).with_context(|| format!("cannot read {}", file.display()))?;
    if old == code.as_bytes() {
        return Ok(());
    }
    let old = String::from_utf8_lossy(&old);
    let same = old
        .lines()
        .zip(code.lines())
        .take_while(|(old, new)| old == new);
    bail!(
        "{file} is out of date from line {line} on; `ulna generate {table}{methods} --output {file}` writes it anew",
        file = file.display(),
        line = same.count() + 1,
        table = arguments.table.display(),
        methods = arguments.methods.option(),
    )
}
