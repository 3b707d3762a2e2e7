//! `ulna help`: a command, or the format of a file that the program reads.

use std::io::Write;

use clap::Args;
use clap::error::ErrorKind;
use ulna_table::toml_reader::closest;

use crate::{Verdict, command_line};

/// Explain a command, or the format of the files: `table` for an arm's, `scenario` for experiments
#[derive(Args)]
#[command(after_help = "Examples:\n  ulna help table\n  ulna help scenario\n  ulna help check")]
pub(crate) struct Arguments {
    /// A command, `table` or `scenario`; without it the program
    topic: Option<String>,
}

/// A format's name, and what prints its reference.
type Format = (&'static str, fn() -> String);

const FORMATS: [Format; 2] = [
    ("table", ulna_table::reference),
    ("scenario", ulna_study::scenario::reference),
];

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let topic = arguments.topic.as_deref();
    let format = FORMATS.iter().find(|(name, _)| Some(*name) == topic);
    if let Some((_, reference)) = format {
        out.write_all(reference().as_bytes())?;
        return Ok(Verdict::Pass);
    }
    let mut command = command_line();
    if let Some(name) = topic
        && command.find_subcommand(name).is_none()
    {
        let formats = FORMATS.map(|(name, _)| name);
        refuse(command, name, &formats);
    }
    // What `--help` prints comes as an error that is none.
    let line = ["ulna"].into_iter().chain(topic).chain(["--help"]);
    if let Err(help) = command.try_get_matches_from_mut(line) {
        write!(out, "{}", help.render())?;
    }
    Ok(Verdict::Pass)
}

/// Ends the program over a `name` that is no command and none of `others`.
pub(crate) fn refuse(mut command: clap::Command, name: &str, others: &[&str]) -> ! {
    let commands = command.get_subcommands().map(clap::Command::get_name);
    let names: Vec<_> = commands.chain(others.iter().copied()).collect();
    let help = match closest(name, names.iter().copied()) {
        Some(meant) => format!("did you mean '{meant}'?"),
        None => format!("write one of {}", names.join(", ")),
    };
    let message = format!("'{}' is not known here; {help}", name.escape_debug());
    // On stderr, with the exit code of a wrong command line.
    command.error(ErrorKind::InvalidValue, message).exit()
}
