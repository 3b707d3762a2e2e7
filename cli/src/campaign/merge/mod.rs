//! `ulna merge`: the shards of a campaign put together.

mod found;
mod plan;
mod write;

use std::path::PathBuf;

use clap::Args;

use crate::output::target;
use crate::{Verdict, console};
use plan::Plan;

/// Put the shards of a campaign together: the file of the campaign in one go, byte for byte
#[derive(Args)]
#[command(
    after_help = "Example:\n  ulna merge target/shards --output target/shards/campaign.csv\n\n\
    Each shard must be there, complete and unchanged: its manifest has the SHA-256 of its rows. What is missing, incomplete,\n\
    changed or of another campaign is named, all of it, and then nothing is written. A shard that is there twice with the\n\
    same rows counts once; one that was not finished counts not at all if it is there complete as well.\n\n\
    The record goes beside the rows, as campaign.json beside campaign.csv. Named like this, `ulna campaign SCENARIO` with that\n\
    folder as its --output, and without --shard, finds all cases there, and writes campaign.md and the figures."
)]
pub(crate) struct Arguments {
    /// Manifests, files of rows, or folders with shards in them
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    /// Where the rows go
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<Verdict> {
    // Before the work that leads to it.
    target(&arguments.output)?;
    let mut errors = Vec::new();
    let found = found::find(&arguments.shards, &mut errors);
    let plan = Plan::new(found, &mut errors);
    write::check_output(&arguments.output, &plan, &mut errors);
    let written = write::merge(&plan, &arguments.output, &mut errors)?;
    if written.is_none() {
        errors.iter().for_each(|error| console::error(error));
        return Ok(Verdict::Fail);
    }
    plan.notes().iter().for_each(|note| console::note(note));
    for path in written.into_iter().flatten() {
        console::note(&format!("wrote {}", path.display()));
    }
    Ok(Verdict::Pass)
}
