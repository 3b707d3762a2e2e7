//! `campaign.json`, and a shard's manifest: which campaign the rows beside it are of, which of them, and a hash of them.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use ulna_files::{refuse_special, write_whole};
use ulna_study::experiment::Shard;

use crate::{Campaign, Identity, Part};

/// Which cases of which campaign a shard has. With the campaign's identity it decides every byte of its rows.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct ShardRecord {
    /// How many cases the whole campaign has.
    pub(crate) cases: u64,
    /// From 1.
    shard: u64,
    /// How many shards there are.
    shards: u64,
    /// The number of its first case, from 0.
    first: u64,
    /// That of its last.
    last: u64,
    /// The campaign's laws, in the order of their columns.
    pub(crate) laws: Vec<String>,
}

impl ShardRecord {
    /// Of a part of `campaign`; `None` for the whole.
    pub(crate) fn of(part: &Part, campaign: &Campaign<'_>) -> Option<Self> {
        let (shard, range) = (part.shard()?, part.range());
        let laws = campaign.laws();
        Some(Self {
            cases: part.cases(),
            shard: shard.number(),
            shards: shard.of(),
            first: range.start,
            last: range.end.checked_sub(1)?,
            laws: laws.iter().map(|law| law.name().to_owned()).collect(),
        })
    }

    /// `None` if what it says of itself is not so of any shard.
    pub(crate) fn shard(&self) -> Option<Shard> {
        let shard = Shard::new(self.shard, self.shards)?;
        let range = shard.range(self.cases);
        let all = range.start == self.first && range.end.checked_sub(1) == Some(self.last);
        (all && range.start < range.end).then_some(shard)
    }

    /// How many rows it has when it is complete.
    pub(crate) fn rows(&self) -> u64 {
        self.last.saturating_sub(self.first).saturating_add(1)
    }
}

/// What is kept in the file.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Record {
    #[serde(flatten)]
    pub(crate) identity: Identity,
    #[serde(flatten)]
    pub(crate) shard: Option<ShardRecord>,
    pub(crate) rows: u64,
    /// So many of the rows' file, its first line included, are hashed.
    pub(crate) bytes: u64,
    pub(crate) sha256: String,
}

impl Record {
    /// That of the rows in `csv`, which must be those of `recorder`.
    pub(crate) fn read(recorder: &Recorder, csv: &Path) -> anyhow::Result<Self> {
        let path = &recorder.path;
        refuse_special(path)?;
        let Ok(text) = fs::read(path) else {
            bail!(
                "cannot tell which campaign {} is of: {} is not there or cannot be read; {}",
                csv.display(),
                path.display(),
                remedy()
            );
        };
        let Ok(record) = serde_json::from_slice::<Self>(&text) else {
            bail!(
                "cannot tell which campaign {} is of: {} is no record of one; {}",
                csv.display(),
                path.display(),
                remedy()
            );
        };
        let identity = &recorder.identity;
        if let Some(difference) = identity.difference(&record.identity) {
            bail!("{} {difference}; {}", csv.display(), remedy());
        }
        if recorder.shard != record.shard {
            let cases = |shard: &Option<ShardRecord>| match shard {
                Some(shard) => format!("of a campaign of {} cases", shard.cases),
                None => "no shard".to_owned(),
            };
            bail!(
                "{} is {}, not {}; {}",
                csv.display(),
                cases(&record.shard),
                cases(&recorder.shard),
                remedy()
            );
        }
        Ok(record)
    }

    /// Whether what `hash` took in is what was hashed.
    pub(crate) fn is_of(&self, hash: Sha256) -> bool {
        hex(hash) == self.sha256
    }

    /// As the file has it.
    pub(crate) fn text(&self) -> anyhow::Result<Vec<u8>> {
        let json = serde_json::to_vec_pretty(self);
        let mut json = json.context("the record of a campaign cannot be written")?;
        json.push(b'\n');
        Ok(json)
    }
}

/// Keeps the record of rows that grow.
pub(crate) struct Recorder {
    path: PathBuf,
    identity: Identity,
    shard: Option<ShardRecord>,
    hash: Sha256,
    rows: u64,
    bytes: u64,
}

impl Recorder {
    /// Of a part of `campaign`.
    pub(crate) fn new(part: &Part, campaign: &Campaign<'_>) -> Self {
        Self {
            path: part.file("json"),
            identity: campaign.identity().clone(),
            shard: ShardRecord::of(part, campaign),
            hash: Sha256::new(),
            rows: 0,
            bytes: 0,
        }
    }

    /// Takes in what has been added to the rows' file.
    pub(crate) fn add(&mut self, text: &[u8], rows: u64) {
        self.hash.update(text);
        self.rows += rows;
        self.bytes += text.len() as u64;
    }

    /// Goes on where `record` stands, whose rows were hashed to `hash`.
    pub(crate) fn go_on(&mut self, record: &Record, hash: Sha256) {
        self.hash = hash;
        self.rows = record.rows;
        self.bytes = record.bytes;
    }

    /// How many rows are recorded.
    pub(crate) fn rows(&self) -> u64 {
        self.rows
    }

    /// What is to be kept.
    pub(crate) fn record(&self) -> Record {
        Record {
            identity: self.identity.clone(),
            shard: self.shard.clone(),
            rows: self.rows,
            bytes: self.bytes,
            sha256: hex(self.hash.clone()),
        }
    }

    pub(crate) fn write(&self) -> anyhow::Result<()> {
        write_whole(&self.path, &self.record().text()?)
    }
}

/// What to do about rows that cannot be gone on with.
pub(crate) fn remedy() -> &'static str {
    "remove it, or choose another --output"
}

pub(crate) fn hex(hash: Sha256) -> String {
    let bytes = hash.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
