//! `campaign.json`, and a shard's manifest: which campaign the rows beside it are of, which of them, and a hash of them.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use ulna_study::Scenario;
use ulna_study::experiment::Shard;
use ulna_study::scenario::{Experiment, ScenarioArm};

use super::part::Part;
use crate::output::{refuse_special, write_whole};

/// What decides a row beside its number.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Identity {
    program: String,
    seed: u64,
    /// SHA-256 of the arm, the motion, the random variation, the rated torques, what a lock steps by and the projector.
    scenario: String,
}

impl Identity {
    /// That of a scenario's campaign. What has no part in a row is left out: the number of cases, texts, figures;
    /// the laws too, of which the columns' names tell.
    pub(super) fn of(scenario: &Scenario) -> Self {
        let arm = match scenario.arm() {
            ScenarioArm::Known(arm) => format!("{arm:?}"),
            ScenarioArm::Table { model, .. } => model.table_hash().to_owned(),
        };
        let campaign = scenario.campaign();
        let variation = (
            campaign.failure_times(),
            campaign.start_spread(),
            campaign.goal_spread(),
            campaign.force_spread(),
        );
        let first = scenario.experiments().first();
        let rated = first.map(Experiment::rated_torque);
        let step = first.map(|first| (first.step_time(), first.force().lock_step));
        let projector = scenario.servo().projector();
        let content = format!(
            "{arm}\n{:?}\n{variation:?}\n{rated:?}\n{step:?}\n{projector:?}",
            scenario.motion()
        );
        Self {
            program: concat!("ulna ", env!("CARGO_PKG_VERSION")).to_owned(),
            seed: campaign.seed(),
            scenario: hex(Sha256::new_with_prefix(content)),
        }
    }

    /// What keeps the rows of `other` from standing beside those of this.
    pub(super) fn difference(&self, other: &Self) -> Option<String> {
        if self.program != other.program {
            Some(format!(
                "was made by {}, not {}",
                other.program, self.program
            ))
        } else if self.seed != other.seed {
            Some(format!("has the seed {}, not {}", other.seed, self.seed))
        } else if self.scenario != other.scenario {
            Some("is of another scenario or another arm".to_owned())
        } else {
            None
        }
    }
}

/// Which cases of which campaign a shard has. With the campaign's identity it decides every byte of its rows.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct ShardRecord {
    /// How many cases the whole campaign has.
    pub(super) cases: u64,
    /// From 1.
    shard: u64,
    /// How many shards there are.
    shards: u64,
    /// The number of its first case, from 0.
    first: u64,
    /// That of its last.
    last: u64,
    /// The campaign's laws, in the order of their columns.
    pub(super) laws: Vec<String>,
}

impl ShardRecord {
    /// Of a part of the campaign of `scenario`; `None` for the whole.
    fn of(part: &Part, scenario: &Scenario) -> Option<Self> {
        let (shard, range) = (part.shard()?, part.range());
        let laws = scenario.campaign().laws();
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
    pub(super) fn shard(&self) -> Option<Shard> {
        let shard = Shard::new(self.shard, self.shards)?;
        let range = shard.range(self.cases);
        let all = range.start == self.first && range.end.checked_sub(1) == Some(self.last);
        (all && range.start < range.end).then_some(shard)
    }

    /// How many rows it has when it is complete.
    pub(super) fn rows(&self) -> u64 {
        self.last.saturating_sub(self.first).saturating_add(1)
    }
}

/// What is kept in the file.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Record {
    #[serde(flatten)]
    pub(super) identity: Identity,
    #[serde(flatten)]
    pub(super) shard: Option<ShardRecord>,
    pub(super) rows: u64,
    /// So many of the rows' file, its first line included, are hashed.
    pub(super) bytes: u64,
    pub(super) sha256: String,
}

impl Record {
    /// That of the rows in `csv`, which must be those of `recorder`.
    pub(super) fn read(recorder: &Recorder, csv: &Path) -> anyhow::Result<Self> {
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
    pub(super) fn is_of(&self, hash: Sha256) -> bool {
        hex(hash) == self.sha256
    }

    /// As the file has it.
    pub(super) fn text(&self) -> anyhow::Result<Vec<u8>> {
        let json = serde_json::to_vec_pretty(self);
        let mut json = json.context("the record of a campaign cannot be written")?;
        json.push(b'\n');
        Ok(json)
    }
}

/// Keeps the record of rows that grow.
pub(super) struct Recorder {
    path: PathBuf,
    identity: Identity,
    shard: Option<ShardRecord>,
    hash: Sha256,
    rows: u64,
    bytes: u64,
}

impl Recorder {
    /// Of a part of the campaign of `scenario`.
    pub(super) fn new(part: &Part, scenario: &Scenario) -> Self {
        Self {
            path: part.file("json"),
            identity: Identity::of(scenario),
            shard: ShardRecord::of(part, scenario),
            hash: Sha256::new(),
            rows: 0,
            bytes: 0,
        }
    }

    /// Takes in what has been added to the rows' file.
    pub(super) fn add(&mut self, text: &[u8], rows: u64) {
        self.hash.update(text);
        self.rows += rows;
        self.bytes += text.len() as u64;
    }

    /// Goes on where `record` stands, whose rows were hashed to `hash`.
    pub(super) fn go_on(&mut self, record: &Record, hash: Sha256) {
        self.hash = hash;
        self.rows = record.rows;
        self.bytes = record.bytes;
    }

    /// How many rows are recorded.
    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    pub(super) fn write(&self) -> anyhow::Result<()> {
        let record = Record {
            identity: self.identity.clone(),
            shard: self.shard.clone(),
            rows: self.rows,
            bytes: self.bytes,
            sha256: hex(self.hash.clone()),
        };
        write_whole(&self.path, &record.text()?)
    }
}

/// What to do about rows that cannot be gone on with.
pub(super) fn remedy() -> &'static str {
    "remove it, or choose another --output"
}

pub(super) fn hex(hash: Sha256) -> String {
    let bytes = hash.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
