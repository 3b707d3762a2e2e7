//! [`Part`]: which cases of a campaign a run makes, and where its files are.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use ulna_study::experiment::Shard;

/// What a shard's files are called, but for what they end in: in a list of names shards stand in order.
pub(crate) fn stem(shard: Shard) -> String {
    let width = shard.of().to_string().len().max(4);
    format!(
        "campaign-{:0width$}-of-{:0width$}",
        shard.number(),
        shard.of()
    )
}

/// Whether a shard's files may be called `name`, but for what they end in.
pub(crate) fn is_stem(name: &str) -> bool {
    let numbers = name
        .strip_prefix("campaign-")
        .and_then(|numbers| numbers.split_once("-of-"));
    let shard = numbers.and_then(|(number, of)| Shard::new(number.parse().ok()?, of.parse().ok()?));
    shard.is_some_and(|shard| stem(shard) == name)
}

/// All cases of a campaign or one shard of them, in a folder.
#[derive(Clone, Debug)]
pub struct Part {
    folder: PathBuf,
    shard: Option<Shard>,
    cases: u64,
}

impl Part {
    /// Of a campaign of `cases`.
    pub fn new(folder: PathBuf, shard: Option<Shard>, cases: u64) -> Self {
        Self {
            folder,
            shard,
            cases,
        }
    }

    /// Where its files are.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Which of the shards it is; `None` for all cases.
    pub fn shard(&self) -> Option<Shard> {
        self.shard
    }

    /// How many cases the whole campaign has.
    pub fn cases(&self) -> u64 {
        self.cases
    }

    /// The numbers of its own.
    pub fn range(&self) -> Range<u64> {
        self.shard
            .map_or(0..self.cases, |shard| shard.range(self.cases))
    }

    /// Its rows, its record or its lock, by what the name ends in.
    pub fn file(&self, end: &str) -> PathBuf {
        let stem = self.shard.map_or_else(|| "campaign".to_owned(), stem);
        self.folder.join(format!("{stem}.{end}"))
    }
}

/// As a run that makes it is told of.
impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.shard {
            Some(shard) => shard.fmt(f),
            None => f.write_str("a campaign"),
        }
    }
}
