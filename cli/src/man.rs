//! `ulna man`: manual pages.

use std::io::Write;

use clap::Args;
use clap_mangen::Man;

use crate::help::refuse;
use crate::{Verdict, command_line};

/// Print the manual page (roff) of the program, or of a command
#[derive(Args)]
#[command(after_help = "Examples:\n  ulna man\n  ulna man check\n\n\
    `ulna man | man -l -` shows it; as ulna.1 and ulna-check.1 in a folder man1 of MANPATH they are found by name.")]
pub(crate) struct Arguments {
    /// The command; without it the page is that of the program
    command: Option<String>,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let program = command_line();
    let command = match &arguments.command {
        None => program,
        Some(name) => match program.find_subcommand(name) {
            Some(command) => command.clone(),
            None => refuse(program, name, &[]),
        },
    };
    let source = concat!("ulna ", env!("CARGO_PKG_VERSION"));
    Man::new(command).source(source).render(out)?;
    Ok(Verdict::Pass)
}
