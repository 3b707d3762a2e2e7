//! `ulna generate`: a table in, Rust or C out.

mod c;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use clap::error::ErrorKind;

use crate::methods::Methods;
use crate::output::{refuse_special, write_whole};
use crate::progress::Progress;
use crate::{Verdict, command_line, console};

/// Emit the code of an arm, in Rust or in C
#[derive(Args)]
#[command(after_help = "Examples:\n  ulna generate arms/planar_2r.toml\n  \
                  ulna generate arms/ssrms.toml --methods mass_matrix,inverse_dynamics\n  \
                  ulna generate arms/planar_2r.toml --output target/planar_2r.rs\n  \
                  ulna generate arms/planar_2r.toml --language c --output target/c\n  \
                  ulna generate arms/planar_2r.toml --language c --precision float --output target/c")]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    /// The language
    #[arg(long, value_enum, default_value_t, hide_default_value = true)]
    language: Language,
    #[command(flatten)]
    methods: Methods,
    /// Rust: the file to write, whole or not at all; without it the code goes to stdout.
    /// A symbolic link stays, and the file that it leads to is written; a device, pipe or socket is refused.
    /// C: the folder for NAME.h and NAME.c, which is made if need be
    #[arg(long, short, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Write nothing; fail if a file is not what would be written
    #[arg(long, requires = "output")]
    check: bool,
    #[command(flatten)]
    c: c::Options,
}

/// A language to emit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Language {
    /// A type that implements the trait Arm (what is written unless another language is asked for)
    #[default]
    Rust,
    /// A header and a source file, C99
    C,
}

impl Arguments {
    /// The command that writes the code anew.
    fn again(&self, options: &str, output: &Path) -> String {
        format!(
            "ulna generate {table}{options}{methods} --output {output}",
            table = self.table.display(),
            methods = self.methods.option(),
            output = output.display(),
        )
    }
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    match (arguments.language, &arguments.output) {
        (Language::C, Some(folder)) => c::run(arguments, folder)?,
        (Language::C, None) => usage(
            ErrorKind::MissingRequiredArgument,
            "C is a header and a source file: name their folder with `--output DIR`",
        ),
        (Language::Rust, _) => {
            if let Some(option) = arguments.c.given() {
                usage(
                    ErrorKind::ArgumentConflict,
                    &format!("`{option}` is about C: it needs `--language c`"),
                );
            }
            rust(arguments, out)?;
        }
    }
    Ok(Verdict::Pass)
}

/// Ends the program: what was asked for makes no sense.
fn usage(kind: ErrorKind, message: &str) -> ! {
    let mut command = command_line();
    let command = match command.find_subcommand_mut("generate") {
        Some(generate) => generate,
        None => &mut command,
    };
    command.error(kind, message).exit()
}

fn rust(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<()> {
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
        Some(file) if arguments.check => check(file, &code, &arguments.again("", file))?,
        Some(file) => write_whole(file, code.as_bytes())?,
    }
    Ok(())
}

/// Fails if the file is not `code`; `again` is the command that makes it so.
fn check(file: &Path, code: &str, again: &str) -> anyhow::Result<()> {
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
        "{file} is out of date from line {line} on; `{again}` writes it anew",
        file = file.display(),
        line = same.count() + 1,
    )
}
