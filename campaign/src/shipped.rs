//! [`Shipped`]: a shard that is made in one place and kept in another, with no file system in common.

use std::fs;
use std::time::Instant;

use anyhow::{Context, bail};
use rayon::ThreadPool;
use sha2::{Digest, Sha256};
use ulna_files::{Lock, Staged, rows};

use crate::make::{Chunk, rows as make_rows};
use crate::record::{Record, Recorder, ShardRecord, hex, remedy};
use crate::row;
use crate::{Campaign, Part, Watch};

/// A whole shard as bytes: its rows, and the record that vouches for them.
#[derive(Clone, Debug, PartialEq)]
pub struct Shipped {
    /// As its file will have them, with the columns' names.
    pub rows: Vec<u8>,
    /// Its manifest.
    pub record: Vec<u8>,
}

impl Shipped {
    /// Makes `part` in memory, on the threads of `pool`. The part's folder has no part in it.
    ///
    /// # Errors
    /// When `watch` stops it.
    pub fn make(
        part: &Part,
        campaign: &Campaign<'_>,
        pool: &ThreadPool,
        watch: &dyn Watch,
    ) -> anyhow::Result<Self> {
        let range = part.range();
        let mut recorder = Recorder::new(part, campaign);
        let mut all = row::header(campaign.laws())?.into_bytes();
        recorder.add(&all, 0);
        let mut chunk = Chunk::FIRST;
        let mut start = range.start;
        while start < range.end {
            let clock = Instant::now();
            let numbers = chunk.range(start, range.end);
            let count = numbers.end - numbers.start;
            start = numbers.end;
            let rows = pool.install(|| make_rows(campaign, numbers, watch));
            let text = rows::lines(rows)?;
            recorder.add(text.as_bytes(), count);
            all.extend_from_slice(text.as_bytes());
            watch.written(start - range.start)?;
            chunk = chunk.next(clock.elapsed());
        }
        Ok(Self {
            rows: all,
            record: recorder.record().text()?,
        })
    }

    /// Puts it into the folder of `part`, which must be the same shard of the same campaign.
    /// What was made of that shard in the folder, and is not whole, goes.
    ///
    /// # Errors
    /// When it is another shard or another campaign's, or has been changed on the way, and when the files cannot be written.
    pub fn store(&self, part: &Part, campaign: &Campaign<'_>) -> anyhow::Result<()> {
        let Ok(record) = serde_json::from_slice::<Record>(&self.record) else {
            bail!("what came for {part} has no record of a shard");
        };
        if let Some(difference) = campaign.identity().difference(&record.identity) {
            bail!("what came for {part} {difference}");
        }
        if record.shard != ShardRecord::of(part, campaign) {
            bail!(
                "what came for {part} is another shard, or one of another number of cases or other laws"
            );
        }
        let range = part.range();
        let whole = record.rows == range.end - range.start;
        if !whole || hex(Sha256::new_with_prefix(&self.rows)) != record.sha256 {
            bail!("what came for {part} is not what its record is of");
        }
        let folder = part.folder();
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        let _lock = Lock::take(&part.file("lock"), &part.to_string())?;
        let [csv, partial, json] = ["csv", "csv.partial", "json"].map(|end| part.file(end));
        if csv.exists() {
            bail!("{} is there already; {}", csv.display(), remedy());
        }
        let rows = Staged::write(&csv, &self.rows)?;
        let record = Staged::write(&json, &self.record)?;
        if partial.exists() {
            fs::remove_file(&partial)
                .with_context(|| format!("cannot remove {}", partial.display()))?;
        }
        // In this order: rows without their record would be refused.
        record.persist()?;
        rows.persist()
    }
}
