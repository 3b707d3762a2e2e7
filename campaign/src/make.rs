//! Making the cases of a part, on all threads, into its file.

use std::fs;
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Context;
use rayon::ThreadPool;
use rayon::prelude::*;
use ulna_files::Lock;

use crate::file::CampaignFile;
use crate::{Campaign, Part, Row};

/// What whoever waits for cases is told meanwhile.
pub trait Watch: Sync {
    /// `rows` of `cases` are there already, in the file at `path`; said once, before any is made.
    fn begins(&self, rows: u64, cases: u64, path: &Path) {
        let _ = (rows, cases, path);
    }

    /// One more is made, by any thread.
    fn one_made(&self) {}

    /// `rows` are in the file, and will be found there whatever happens.
    ///
    /// # Errors
    /// To stop here; what is made by then stays.
    fn written(&self, rows: u64) -> anyhow::Result<()> {
        let _ = rows;
        Ok(())
    }
}

/// Nobody waits.
pub struct Silent;

impl Watch for Silent {}

/// A part that is whole.
pub struct Made {
    /// Its rows, if they were to be kept.
    pub rows: Vec<Row>,
    /// How many of them had to be made.
    pub made: u64,
    /// As long as it lives no other run works on these files.
    pub lock: Lock,
}

/// So many cases are made before they are written.
pub(crate) struct Chunk(u64);

impl Chunk {
    pub(crate) const FIRST: Self = Self(64);
    const MOST: u64 = 1 << 14;
    /// What is lost when the program is killed. Sooner written is slower: each time the disk is waited for, and a file
    /// system that a thousand shards share waits for all of them.
    const TIME: Duration = Duration::from_secs(2);

    /// The numbers of those that begin at `start`, of a range that ends at `end`.
    pub(crate) fn range(&self, start: u64, end: u64) -> Range<u64> {
        start..end.min(start.saturating_add(self.0))
    }

    /// After one that took so long.
    pub(crate) fn next(self, taken: Duration) -> Self {
        if taken < Self::TIME / 2 {
            Self((2 * self.0).min(Self::MOST))
        } else {
            self
        }
    }
}

/// Makes what there is not of `part`, in its folder, on the threads of `pool`; all rows are kept in memory if they are to be returned,
/// and otherwise none. What `watch` hears between chunks of cases, it hears on the thread that calls this.
///
/// # Errors
/// When another run makes the same part, when rows that are there are those of another campaign or have been changed, when files
/// cannot be read or written, and when `watch` stops it.
pub fn make(
    part: &Part,
    campaign: &Campaign<'_>,
    keep: bool,
    pool: &ThreadPool,
    watch: &dyn Watch,
) -> anyhow::Result<Made> {
    let folder = part.folder();
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let lock = Lock::take(&part.file("lock"), &part.to_string())?;
    let range = part.range();
    let cases = range.end - range.start;
    let mut file = CampaignFile::open(part, campaign, keep)?;
    let found = file.rows();
    watch.begins(found, cases, file.path());
    let mut chunk = Chunk::FIRST;
    let mut start = range.start + found;
    while start < range.end {
        let clock = Instant::now();
        let numbers = chunk.range(start, range.end);
        start = numbers.end;
        file.append(pool.install(|| rows(campaign, numbers, watch)))?;
        watch.written(start - range.start)?;
        chunk = chunk.next(clock.elapsed());
    }
    Ok(Made {
        rows: file.finish()?,
        made: cases - found,
        lock,
    })
}

/// In order of the number, whatever thread made them.
pub(crate) fn rows(campaign: &Campaign<'_>, numbers: Range<u64>, watch: &dyn Watch) -> Vec<Row> {
    let rows = numbers.into_par_iter().map(|index| {
        let row = campaign.row(index);
        watch.one_made();
        row
    });
    rows.collect()
}
