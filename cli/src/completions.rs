//! `ulna completions`: scripts by which shells complete a command line.

use std::io::Write;

use clap::Args;
use clap_complete::{Shell, generate};

use crate::{Verdict, command_line};

/// Print the script by which a shell completes commands and options
#[derive(Args)]
#[command(after_help = "Example:\n  ulna completions bash\n\n\
    bash: put it into ~/.local/share/bash-completion/completions/ulna; zsh: into a folder of fpath, as _ulna;\n\
    fish: into ~/.config/fish/completions/ulna.fish")]
pub(crate) struct Arguments {
    /// The shell
    shell: Shell,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let mut script = Vec::new();
    // Into memory first: `generate` panics where it cannot write.
    generate(arguments.shell, &mut command_line(), "ulna", &mut script);
    out.write_all(&script)?;
    Ok(Verdict::Pass)
}
