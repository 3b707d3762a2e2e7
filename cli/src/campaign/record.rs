//! `campaign.json`: which campaign the rows beside it are of, and a hash of them.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use ulna_study::Scenario;
use ulna_study::scenario::{Experiment, ScenarioArm};

use crate::output::{refuse_special, write_whole};

/// What decides a row beside its number.
#[derive(Clone, Debug, Deserialize, Serialize)]
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
    fn difference(&self, other: &Self) -> Option<String> {
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

/// What is kept in the file.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Record {
    #[serde(flatten)]
    identity: Identity,
    pub(super) rows: u64,
    /// So many of the rows' file, its first line included, are hashed.
    pub(super) bytes: u64,
    sha256: String,
}

impl Record {
    /// The one beside the rows in `csv`, which must be of `identity`.
    pub(super) fn read(folder: &Path, csv: &Path, identity: &Identity) -> anyhow::Result<Self> {
        let path = file(folder);
        refuse_special(&path)?;
        let Ok(text) = fs::read(&path) else {
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
        if let Some(difference) = identity.difference(&record.identity) {
            bail!("{} {difference}; {}", csv.display(), remedy());
        }
        Ok(record)
    }

    /// Whether `text` is what was hashed.
    pub(super) fn is_of(&self, text: &[u8]) -> bool {
        hex(Sha256::new_with_prefix(text)) == self.sha256
    }
}

/// Keeps the record of rows that grow.
pub(super) struct Recorder {
    path: PathBuf,
    identity: Identity,
    hash: Sha256,
    rows: u64,
    bytes: u64,
}

impl Recorder {
    pub(super) fn new(folder: &Path, identity: Identity) -> Self {
        Self {
            path: file(folder),
            identity,
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

    pub(super) fn write(&self) -> anyhow::Result<()> {
        let mut json = serde_json::to_vec_pretty(&Record {
            identity: self.identity.clone(),
            rows: self.rows,
            bytes: self.bytes,
            sha256: hex(self.hash.clone()),
        })
        .context("the record of a campaign cannot be written")?;
        json.push(b'\n');
        write_whole(&self.path, &json)
    }
}

fn file(folder: &Path) -> PathBuf {
    folder.join("campaign.json")
}

/// What to do about rows that cannot be gone on with.
pub(super) fn remedy() -> &'static str {
    "remove it, or choose another --output"
}

fn hex(hash: Sha256) -> String {
    let bytes = hash.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
