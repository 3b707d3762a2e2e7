//! `campaign.csv`, or a shard's rows: grows under a name that ends in `.partial`, and gets its own when it is whole.
//!
//! After each addition the record beside it says how far the rows are good. What stands behind that, as after a loss of
//! power, is made again; before it no byte may have changed.

use std::fs::{self, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow, bail};
use ulna_files::{Staged, rows, target, write_whole};

use crate::hashed::Hashed;
use crate::record::{Record, Recorder, remedy};
use crate::row::{self, Row};
use crate::{Campaign, Part};

/// The file under way, or complete.
pub(crate) struct CampaignFile {
    whole: PathBuf,
    partial: PathBuf,
    recorder: Recorder,
    /// The first line.
    header: String,
    /// The number of its first case.
    first: u64,
    /// How many cases are asked for.
    cases: u64,
    /// The rows that are asked for and there; `None` if nobody will ask for them.
    kept: Option<Vec<Row>>,
    complete: bool,
}

impl CampaignFile {
    /// Takes up what there is of `part`: rows of another campaign, or of none, are refused.
    /// Some of them are made again, because a program may change without its version.
    /// Only where rows are to be kept are they in memory.
    pub(crate) fn open(part: &Part, campaign: &Campaign<'_>, keep: bool) -> anyhow::Result<Self> {
        // Beside what it becomes, wherever a link leads.
        let whole = target(&part.file("csv"))?;
        let partial = target(&whole.with_extension("csv.partial"))?;
        let mut file = Self::nothing_yet(part, campaign, [whole, partial], keep)?;
        // A whole file that is being continued is whole still, but the other has more rows.
        let paths = [file.partial.clone(), file.whole.clone()];
        let Some(path) = paths.iter().find(|path| path.exists()) else {
            file.recorder.add(file.header.as_bytes(), 0);
            // In this order: rows without their record would be refused.
            file.recorder.write()?;
            write_whole(&file.partial, file.header.as_bytes())?;
            return Ok(file);
        };
        let recorded = file.take_up(path, campaign)?;
        file.complete = *path == file.whole && file.rows() >= file.cases;
        if *path == file.partial {
            // Without what was added and not recorded.
            let opened = OpenOptions::new().write(true).open(path);
            let cut = opened.and_then(|file| {
                file.set_len(recorded)?;
                file.sync_data()
            });
            cut.with_context(|| format!("cannot write {}", path.display()))?;
        } else if !file.complete {
            Staged::copy(&file.partial, path)?.persist()?;
        }
        Ok(file)
    }

    fn nothing_yet(
        part: &Part,
        campaign: &Campaign<'_>,
        [whole, partial]: [PathBuf; 2],
        keep: bool,
    ) -> anyhow::Result<Self> {
        let range = part.range();
        Ok(Self {
            whole,
            partial,
            recorder: Recorder::new(part, campaign),
            header: row::header(campaign.laws())?,
            first: range.start,
            cases: range.end - range.start,
            kept: keep.then(Vec::new),
            complete: false,
        })
    }

    /// Reads the rows at `path`, and returns how many bytes of the file are good.
    fn take_up(&mut self, path: &Path, campaign: &Campaign<'_>) -> anyhow::Result<u64> {
        let cannot_read = || format!("cannot read {}", path.display());
        let mut file = Hashed::open(path)?;
        let mut header = Vec::new();
        let length = self.header.len() as u64;
        let read = file.by_ref().take(length).read_to_end(&mut header);
        read.with_context(cannot_read)?;
        if header != self.header.as_bytes() {
            bail!(
                "{} is no file of a campaign, or of one with other columns, by other `laws` or an older program; {}",
                path.display(),
                remedy()
            );
        }
        let record = Record::read(&self.recorder, path)?;
        let changed = || anyhow!("{} has been changed; {}", path.display(), remedy());
        let found = fs::metadata(path).with_context(cannot_read)?.len();
        // Only the file under way has more in it than is recorded.
        if found < record.bytes || (*path == self.whole && found > record.bytes) {
            bail!(changed());
        }
        let mut lines = file.take(record.bytes.saturating_sub(length));
        let wanted = record.rows.min(self.cases);
        let looked_at = [0, wanted / 3, wanted / 2, wanted.saturating_sub(1)];
        let mut looked_at_rows = Vec::new();
        let mut count = 0;
        for row in row::read(&mut lines, self.first) {
            let row = row.map_err(|_| changed())?;
            if looked_at.contains(&count) {
                looked_at_rows.push(row.clone());
            }
            if count < wanted
                && let Some(kept) = &mut self.kept
            {
                kept.push(row);
            }
            count += 1;
            // Of rows that nobody asked for the hash alone is looked at.
            if count == wanted && wanted < record.rows {
                break;
            }
        }
        io::copy(&mut lines, &mut io::sink()).with_context(cannot_read)?;
        let hash = lines.into_inner().hash();
        if count != wanted || !record.is_of(hash.clone()) {
            bail!(changed());
        }
        for row in &looked_at_rows {
            let index = row.case.case;
            if rows::lines([&campaign.row(index)])? != rows::lines([row])? {
                bail!(
                    "case {index} of {} comes out otherwise by this program; {}",
                    path.display(),
                    remedy()
                );
            }
        }
        self.recorder.go_on(&record, hash);
        Ok(record.bytes)
    }

    /// How many of the cases that are asked for are in it.
    pub(crate) fn rows(&self) -> u64 {
        self.cases.min(self.recorder.rows())
    }

    /// Where it is, or will be.
    pub(crate) fn path(&self) -> &Path {
        &self.whole
    }

    /// Adds the next cases.
    pub(crate) fn append(&mut self, rows: Vec<Row>) -> anyhow::Result<()> {
        let text = rows::lines(&rows)?;
        let opened = OpenOptions::new().append(true).open(&self.partial);
        let written = opened.and_then(|mut file| {
            file.write_all(text.as_bytes())?;
            // On the disk before the record that vouches for them.
            file.sync_data()
        });
        written.with_context(|| format!("cannot write {}", self.partial.display()))?;
        self.recorder.add(text.as_bytes(), rows.len() as u64);
        self.recorder.write()?;
        if let Some(kept) = &mut self.kept {
            kept.extend(rows);
        }
        Ok(())
    }

    /// Gives the file its name, and returns the rows that were asked for, if they were kept.
    pub(crate) fn finish(self) -> anyhow::Result<Vec<Row>> {
        if !self.complete {
            fs::rename(&self.partial, &self.whole)
                .with_context(|| format!("cannot write {}", self.whole.display()))?;
        }
        Ok(self.kept.unwrap_or_default())
    }
}

/// Whether all rows of `part` are there under their name, and good. Makes and changes nothing; what is under way is none of it.
///
/// # Errors
/// When the rows that are there are those of another campaign, or have been changed: nobody may write over them.
pub fn is_there(part: &Part, campaign: &Campaign<'_>) -> anyhow::Result<bool> {
    let [whole, partial] = ["csv", "csv.partial"].map(|end| part.file(end));
    // The record is that of the file under way, if there is one.
    if !whole.exists() || partial.exists() {
        return Ok(false);
    }
    let paths = [whole.clone(), partial];
    let mut file = CampaignFile::nothing_yet(part, campaign, paths, false)?;
    file.take_up(&whole, campaign)?;
    Ok(file.rows() >= file.cases)
}
