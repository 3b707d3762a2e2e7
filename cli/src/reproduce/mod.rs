//! `ulna reproduce`: the experiments of a scenario.

mod table;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use ulna::Arm;
use ulna::experiment::{ExperimentError, Laboratory, Study};
use ulna::scenario::Scenario;

use crate::Verdict;
use crate::arms::{ForArm, GENERATED, with_arm};

/// The scenario that is repeated when none is named; compiled in, so that the program needs no repository.
const PAPER_LIKE: &str = include_str!("../../../scenarios/paper_like.toml");
const OUTPUT: &str = "out";

/// Repeat the paper's experiments: its tables beside ours, figures, series and results.json
#[derive(Args)]
#[command(after_help = "Example:\n  ulna reproduce scenarios/paper_like.toml --output out")]
pub(crate) struct Arguments {
    /// The experiments (TOML); without it the paper's, as far as they can be repeated
    scenario: Option<PathBuf>,
    /// Where figures, series and results go
    #[arg(long, short, value_name = "DIR", default_value = OUTPUT)]
    output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            scenario: None,
            output: OUTPUT.into(),
        }
    }
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let scenario = match &arguments.scenario {
        Some(path) => Scenario::load(path, GENERATED)?,
        None => Scenario::parse(
            PAPER_LIKE,
            "scenarios/paper_like.toml",
            Path::new("scenarios"),
            GENERATED,
        )?,
    };
    let studies = with_arm(&scenario.arm, Studies(&scenario))??;
    table::write(&scenario, &studies, out)?;
    Ok(Verdict::Pass)
}

/// Every experiment of a scenario.
struct Studies<'s>(&'s Scenario);

impl ForArm for Studies<'_> {
    type Output = Result<Vec<Study>, ExperimentError>;

    fn run<A: Arm<N> + Sync, const N: usize>(self, arm: &A) -> Self::Output {
        Laboratory::new(arm, self.0)?.run()
    }
}
