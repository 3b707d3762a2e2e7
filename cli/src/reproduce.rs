//! `ulna reproduce`: the experiments of a scenario.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;

use crate::Verdict;

const SCENARIO: &str = "scenarios/paper_like.toml";
const OUTPUT: &str = "out";

/// Repeat the paper's experiments: its tables beside ours, figures, series and results.json
#[derive(Args)]
#[command(after_help = "Example:\n  ulna reproduce scenarios/paper_like.toml --output out")]
pub(crate) struct Arguments {
    /// The experiment (TOML)
    #[arg(default_value = SCENARIO)]
    scenario: PathBuf,
    /// Where figures, series and results go
    #[arg(long, value_name = "DIR", default_value = OUTPUT)]
    output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            scenario: SCENARIO.into(),
            output: OUTPUT.into(),
        }
    }
}

pub(crate) fn run(arguments: &Arguments, _out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let Arguments { scenario, output } = arguments;
    bail!(
        "{} -> {}: not implemented",
        scenario.display(),
        output.display()
    )
}
