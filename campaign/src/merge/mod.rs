//! [`merge`]: the shards of a campaign put together.

mod found;
mod plan;
mod write;

use std::path::{Path, PathBuf};

use plan::Plan;

/// A campaign whose shards have been put together.
#[derive(Clone, Debug)]
pub struct Merged {
    /// The rows.
    pub rows: PathBuf,
    /// Their record.
    pub record: PathBuf,
    /// What is well to know, though nothing was wrong.
    pub notes: Vec<String>,
}

/// Puts `shards`, manifests, files of rows or folders with shards in them, together at `output`: the file of one run, byte for byte, and
/// its record beside it. `watch` is told how many files are done, of how many, first of none.
///
/// The inner `Err` has everything that is wrong with them, a sentence each; then nothing has been written. A shard that is there
/// twice with the same rows counts once.
///
/// # Errors
/// When `output` cannot be written, and when `watch` stops it.
pub fn merge(
    shards: &[PathBuf],
    output: &Path,
    watch: &mut dyn FnMut(u64, u64) -> anyhow::Result<()>,
) -> anyhow::Result<Result<Merged, Vec<String>>> {
    let mut errors = Vec::new();
    let found = found::find(shards, &mut errors);
    let plan = Plan::new(found, &mut errors);
    write::check_output(output, &plan, &mut errors);
    let Some([rows, record]) = write::merge(&plan, output, watch, &mut errors)? else {
        return Ok(Err(errors));
    };
    Ok(Ok(Merged {
        rows,
        record,
        notes: plan.notes().to_vec(),
    }))
}
