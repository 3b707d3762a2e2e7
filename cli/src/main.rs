//! The program `ulna`. Data goes to stdout, everything else to stderr.
//!
//! Exit codes: 0, or 1 for what is wrong with the input or with what was checked, or 2 for a wrong command line.

mod arms;
mod assess;
mod base_parameters;
mod campaign;
mod check;
mod columns;
mod completions;
mod console;
mod convert;
mod cost;
mod figures;
mod generate;
mod help;
mod import;
mod man;
mod methods;
mod new;
mod numbers;
mod output;
mod progress;
mod reproduce;
mod setting;
mod stdout;
mod verify;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use output::Stdout;
use ulna_files::rows;
use ulna_study::scenario::ScenarioErrors;
use ulna_table::TableErrors;

/// A table of a robot arm in, unrolled Rust dynamics out
///
/// Without a command: `ulna reproduce`.
#[derive(Parser)]
#[command(
    name = "ulna",
    version,
    disable_help_subcommand = true,
    after_help = "Examples:\n  ulna check arms/ssrms.toml\n  ulna help table"
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Reproduce(reproduce::Arguments),
    Assess(assess::Arguments),
    Campaign(campaign::Arguments),
    Merge(campaign::merge::Arguments),
    New(new::Arguments),
    Check(check::Arguments),
    Import(import::Arguments),
    Convert(convert::Arguments),
    Generate(generate::Arguments),
    Verify(verify::Arguments),
    Cost(cost::Arguments),
    Help(help::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// What a command that ran to its end found.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// All is well: exit code 0.
    Pass,
    /// It has said on stderr what is not: exit code 1.
    Fail,
}

impl Command {
    fn run(self, out: &mut dyn Write) -> anyhow::Result<Verdict> {
        match self {
            Self::Reproduce(arguments) => reproduce::run(&arguments, out),
            Self::Assess(arguments) => assess::run(&arguments, out),
            Self::Campaign(arguments) => campaign::run(&arguments, out),
            Self::Merge(arguments) => campaign::merge::run(&arguments),
            Self::New(arguments) => new::run(&arguments),
            Self::Check(arguments) => check::run(&arguments, out),
            Self::Import(arguments) => import::run(&arguments, out),
            Self::Convert(arguments) => convert::run(&arguments, out),
            Self::Generate(arguments) => generate::run(&arguments, out),
            Self::Verify(arguments) => verify::run(&arguments, out),
            Self::Cost(arguments) => cost::run(&arguments, out),
            Self::Help(arguments) => help::run(&arguments, out),
            Self::Completions(arguments) => completions::run(&arguments, out),
            Self::Man(arguments) => man::run(&arguments, out),
        }
    }
}

/// The whole command line, with every name and usage line filled in.
fn command_line() -> clap::Command {
    let mut command = Cli::command();
    command.build();
    command
}

fn main() -> ExitCode {
    let Cli { command } = Cli::parse();
    let command = command.unwrap_or_else(|| Command::Reproduce(reproduce::Arguments::default()));
    let mut out = Stdout::lock();
    let outcome = command
        .run(&mut out)
        .and_then(|verdict| Ok(out.flush().map(|()| verdict)?));
    match outcome {
        Ok(Verdict::Pass) => ExitCode::SUCCESS,
        Ok(Verdict::Fail) => ExitCode::FAILURE,
        // Whoever reads stdout has seen enough, as in `ulna cost TABLE | head -3`.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            if let Some(errors) = error.downcast_ref::<TableErrors>() {
                console::report(errors);
            } else if let Some(errors) = error.downcast_ref::<ScenarioErrors>() {
                errors.texts().iter().for_each(console::report);
            } else {
                console::error(&format!("{error:#}"));
            }
            ExitCode::FAILURE
        }
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let io = error.downcast_ref::<io::Error>();
    io.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
