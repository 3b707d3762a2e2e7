//! `ulna merge`: the shards of a campaign put together.

use std::path::PathBuf;

use clap::Args;
use ulna_campaign::merge;
use ulna_files::target;

use crate::progress::Progress;
use crate::{Verdict, console};

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
    let progress = Progress::new()?;
    let mut said = false;
    let merged = merge(&arguments.shards, &arguments.output, &mut |_, files| {
        if said {
            progress.one_done();
            return Ok(());
        }
        said = true;
        progress.counts(files, "shards merged")
    })?;
    drop(progress);
    match merged {
        Err(errors) => {
            errors.iter().for_each(|error| console::error(error));
            Ok(Verdict::Fail)
        }
        Ok(merged) => {
            merged.notes.iter().for_each(|note| console::note(note));
            for path in [merged.rows, merged.record] {
                console::note(&format!("wrote {}", path.display()));
            }
            Ok(Verdict::Pass)
        }
    }
}
