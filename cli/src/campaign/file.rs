//! `campaign.csv`: grows as `campaign.csv.partial`, and gets its name when it is whole.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use ulna::experiment::CampaignCase;

/// One case. Norms over the healthy joints, N m (N); forces in N; `None` where there is no outcome.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Row {
    pub(crate) case: u64,
    /// Counted from 1.
    pub(crate) failed_joint: usize,
    pub(crate) failure_time: f64,
    pub(crate) before: Option<f64>,
    pub(crate) eq16: Option<f64>,
    pub(crate) eq20: Option<f64>,
    pub(crate) optimal: Option<f64>,
    pub(crate) eq16_force_error: Option<f64>,
    pub(crate) locked_before: Option<f64>,
    pub(crate) status: String,
}

/// A case as a row.
pub(super) fn row(case: &CampaignCase) -> Row {
    let outcome = case.outcome.as_ref().ok();
    Row {
        case: case.index,
        failed_joint: case.failed_joint + 1,
        failure_time: case.failure_time,
        before: outcome.map(|outcome| outcome.before),
        eq16: outcome.map(|outcome| outcome.per_joint),
        eq20: outcome.map(|outcome| outcome.projected),
        optimal: outcome.map(|outcome| outcome.optimal),
        eq16_force_error: outcome.map(|outcome| outcome.per_joint_force_error),
        locked_before: outcome.map(|outcome| outcome.locked_before),
        status: match &case.outcome {
            Ok(_) => "ok".to_owned(),
            Err(error) => error.to_string(),
        },
    }
}

/// The file under way, or complete.
pub(super) struct CampaignFile {
    whole: PathBuf,
    partial: PathBuf,
    text: String,
    rows: u64,
    cases: u64,
    complete: bool,
}

impl CampaignFile {
    /// Takes up what is in `folder`. Some of the rows there are made again with `remake`: a file of another campaign is refused.
    pub(super) fn open(
        folder: &Path,
        cases: u64,
        remake: impl Fn(u64) -> Row,
    ) -> anyhow::Result<Self> {
        let whole = folder.join("campaign.csv");
        let partial = folder.join("campaign.csv.partial");
        let mut file = Self {
            text: header()?,
            rows: 0,
            complete: false,
            whole,
            partial,
            cases,
        };
        for (path, complete) in [(file.whole.clone(), true), (file.partial.clone(), false)] {
            if path.exists() {
                let text = fs::read_to_string(&path)
                    .with_context(|| format!("cannot read {}", path.display()))?;
                file.take_up(&text, &path, remake)?;
                file.complete = complete && file.rows >= cases;
                break;
            }
        }
        if !file.complete {
            // Without what was cut off in the middle of a row.
            fs::write(&file.partial, &file.text)
                .with_context(|| format!("cannot write {}", file.partial.display()))?;
        }
        Ok(file)
    }

    fn take_up(
        &mut self,
        text: &str,
        path: &Path,
        remake: impl Fn(u64) -> Row,
    ) -> anyhow::Result<()> {
        let header = header()?;
        let Some(body) = text.strip_prefix(&header) else {
            // Cut off in its first line, it holds nothing yet.
            if header.starts_with(text) {
                return Ok(());
            }
            bail!(
                "{} is no file of a campaign; choose another --output",
                path.display()
            );
        };
        let lines: Vec<_> = body
            .split_inclusive('\n')
            .filter(|line| line.ends_with('\n'))
            .collect();
        let count = lines.len();
        for index in [0, count / 3, count / 2, count.saturating_sub(1)] {
            let Some(line) = lines.get(index) else {
                continue;
            };
            if *line != csv_text(&[remake(index as u64)])? {
                bail!(
                    "case {index} of {} is not this campaign's; remove the file, or choose another --output",
                    path.display()
                );
            }
        }
        self.rows = count as u64;
        self.text = header + &lines.concat();
        Ok(())
    }

    /// How many cases are in it.
    pub(super) fn rows(&self) -> u64 {
        self.rows.min(self.cases)
    }

    /// Where it is, or will be.
    pub(super) fn path(&self) -> &Path {
        &self.whole
    }

    /// Adds the next cases.
    pub(super) fn append(&mut self, rows: &[Row]) -> anyhow::Result<()> {
        let text = csv_text(rows)?;
        let opened = OpenOptions::new().append(true).open(&self.partial);
        let written = opened.and_then(|mut file: File| file.write_all(text.as_bytes()));
        written.with_context(|| format!("cannot write {}", self.partial.display()))?;
        self.text += &text;
        self.rows += rows.len() as u64;
        Ok(())
    }

    /// Gives the file its name, and all its rows.
    pub(super) fn finish(self) -> anyhow::Result<Vec<Row>> {
        if !self.complete {
            fs::rename(&self.partial, &self.whole)
                .with_context(|| format!("cannot write {}", self.whole.display()))?;
        }
        let mut reader = csv::Reader::from_reader(self.text.as_bytes());
        let rows = reader.deserialize().take(self.cases as usize);
        rows.collect::<Result<_, _>>()
            .with_context(|| format!("{} cannot be read", self.whole.display()))
    }
}

fn header() -> anyhow::Result<String> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "case",
        "failed_joint",
        "failure_time",
        "before",
        "eq16",
        "eq20",
        "optimal",
        "eq16_force_error",
        "locked_before",
        "status",
    ])?;
    Ok(String::from_utf8(csv.into_inner()?)?)
}

fn csv_text(rows: &[Row]) -> anyhow::Result<String> {
    let mut csv = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    for row in rows {
        csv.serialize(row)?;
    }
    Ok(String::from_utf8(csv.into_inner()?)?)
}
