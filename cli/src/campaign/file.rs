//! `campaign.csv`: grows as `campaign.csv.partial`, and gets its name when it is whole.
//!
//! After each addition `campaign.json` says how far the rows are good. What stands behind that, as after a loss of power,
//! is made again; before it no byte may have changed.

use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

use super::record::{Identity, Record, Recorder, remedy};
use super::row::{self, Row};
use crate::output::{target, write_whole};
use crate::rows;

/// The file under way, or complete.
pub(super) struct CampaignFile {
    whole: PathBuf,
    partial: PathBuf,
    recorder: Recorder,
    /// The first line.
    header: String,
    rows: Vec<Row>,
    cases: u64,
    complete: bool,
}

impl CampaignFile {
    /// Takes up what is in `folder`: rows of another campaign, or of none, are refused.
    /// Some of them are made again with `remake`, because a program may change without its version.
    pub(super) fn open(
        folder: &Path,
        cases: u64,
        header: String,
        identity: &Identity,
        remake: impl Fn(u64) -> Row,
    ) -> anyhow::Result<Self> {
        // Beside what it becomes, wherever a link leads.
        let whole = target(&folder.join("campaign.csv"))?;
        let partial = target(&whole.with_extension("csv.partial"))?;
        let mut file = Self {
            whole,
            partial,
            recorder: Recorder::new(folder, identity.clone()),
            header,
            rows: Vec::new(),
            cases,
            complete: false,
        };
        // A whole file that is being continued is whole still, but the other has more rows.
        let paths = [file.partial.clone(), file.whole.clone()];
        let Some(path) = paths.iter().find(|path| path.exists()) else {
            file.recorder.add(file.header.as_bytes(), 0);
            // In this order: rows without their record would be refused.
            file.recorder.write()?;
            write_whole(&file.partial, file.header.as_bytes())?;
            return Ok(file);
        };
        let text = file.take_up(path, folder, identity, remake)?;
        file.complete = *path == file.whole && file.rows() >= cases;
        if !file.complete {
            // Without what was added and not recorded.
            write_whole(&file.partial, &text)?;
        }
        Ok(file)
    }

    /// Reads the rows at `path`, and returns what of the file is good.
    fn take_up(
        &mut self,
        path: &Path,
        folder: &Path,
        identity: &Identity,
        remake: impl Fn(u64) -> Row,
    ) -> anyhow::Result<Vec<u8>> {
        let mut text = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        if !text.starts_with(self.header.as_bytes()) {
            bail!(
                "{} is no file of a campaign, or of one with other columns, by other `laws` or an older program; {}",
                path.display(),
                remedy()
            );
        }
        let record = Record::read(folder, path, identity)?;
        let changed = || format!("{} has been changed; {}", path.display(), remedy());
        let recorded = usize::try_from(record.bytes).unwrap_or(usize::MAX);
        // Only the file under way has more in it than is recorded.
        if text.len() < recorded || (*path == self.whole && text.len() > recorded) {
            bail!(changed());
        }
        text.truncate(recorded);
        let rows = Some(&text).filter(|text| record.is_of(text));
        let rows = rows
            .and_then(|text| row::read(text).ok())
            .with_context(changed)?;
        if rows.len() as u64 != record.rows {
            bail!(changed());
        }
        for index in [
            0,
            rows.len() / 3,
            rows.len() / 2,
            rows.len().saturating_sub(1),
        ] {
            let Some(row) = rows.get(index) else {
                continue;
            };
            if rows::lines([&remake(index as u64)])? != rows::lines([row])? {
                bail!(
                    "case {index} of {} comes out otherwise by this program; {}",
                    path.display(),
                    remedy()
                );
            }
        }
        self.recorder.add(&text, record.rows);
        self.rows = rows;
        Ok(text)
    }

    /// How many cases are in it.
    pub(super) fn rows(&self) -> u64 {
        self.cases.min(self.rows.len() as u64)
    }

    /// Where it is, or will be.
    pub(super) fn path(&self) -> &Path {
        &self.whole
    }

    /// Adds the next cases.
    pub(super) fn append(&mut self, rows: Vec<Row>) -> anyhow::Result<()> {
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
        self.rows.extend(rows);
        Ok(())
    }

    /// Gives the file its name, and returns the rows that were asked for.
    pub(super) fn finish(mut self) -> anyhow::Result<Vec<Row>> {
        if !self.complete {
            fs::rename(&self.partial, &self.whole)
                .with_context(|| format!("cannot write {}", self.whole.display()))?;
        }
        self.rows.truncate(self.rows().try_into()?);
        Ok(self.rows)
    }
}
