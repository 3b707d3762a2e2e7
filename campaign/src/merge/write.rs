//! The rows of all shards, one after the other: hashed while they are copied, so that none is ever in memory.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use sha2::{Digest, Sha256};
use ulna_files::{Growing, Lock, Staged};

use super::found::Found;
use super::plan::Plan;
use crate::hashed::Hashed;
use crate::record::{Record, hex};

/// Looks at all rows, and writes those of the plan to `output` and their record beside it, if nothing is or was wrong.
/// Returns what was written.
pub(crate) fn merge(
    plan: &Plan,
    output: &Path,
    watch: &mut dyn FnMut(u64, u64) -> anyhow::Result<()>,
    errors: &mut Vec<String>,
) -> anyhow::Result<Option<[PathBuf; 2]>> {
    let files = (plan.shards.len() + plan.others.len()) as u64;
    let mut numbers = 0..=files;
    let mut one_done = || watch(numbers.next().unwrap_or(files), files);
    one_done()?;
    let mut merged = match errors.is_empty() {
        true => Some(Merged::new(output)?),
        false => None,
    };
    let mut header = None;
    for found in &plan.shards {
        let mut add = |bytes: &[u8]| merged.as_mut().map_or(Ok(()), |merged| merged.add(bytes));
        if let Err(error) = read(found, &mut header, &mut add) {
            errors.push(format!("{error:#}"));
            merged = None;
        }
        one_done()?;
    }
    for found in &plan.others {
        // Its first line is its own affair: of the same shard it is the same, by the sum of all.
        let read = read(found, &mut None, &mut |_| Ok(()));
        errors.extend(read.err().map(|error| format!("{error:#}")));
        one_done()?;
    }
    match (merged, plan.shards.first()) {
        (Some(merged), Some(first)) if errors.is_empty() => merged.finish(output, first).map(Some),
        _ => Ok(None),
    }
}

/// The file under way.
struct Merged {
    file: Growing,
    hash: Sha256,
    bytes: u64,
}

impl Merged {
    fn new(output: &Path) -> anyhow::Result<Self> {
        Ok(Self {
            file: Growing::new(output)?,
            hash: Sha256::new(),
            bytes: 0,
        })
    }

    fn add(&mut self, bytes: &[u8]) -> anyhow::Result<()> {
        self.hash.update(bytes);
        self.bytes += bytes.len() as u64;
        self.file.add(bytes)
    }

    /// Gives the rows their name, and a record beside them as a campaign of one run writes it.
    fn finish(self, output: &Path, one: &Found) -> anyhow::Result<[PathBuf; 2]> {
        let paths = [output.to_path_buf(), output.with_extension("json")];
        let record = Record {
            identity: one.record.identity.clone(),
            shard: None,
            rows: one.about.cases,
            bytes: self.bytes,
            sha256: hex(self.hash),
        };
        let rows = self.file.finish()?;
        let record = Staged::write(&paths[1], &record.text()?)?;
        let _lock = Lock::take(&output.with_extension("lock"), "a campaign")?;
        // In this order: rows without their record would be refused.
        record.persist()?;
        rows.persist()?;
        Ok(paths)
    }
}

/// Reads the rows of `found` to their end and gives them to `take`; the `header` only if it is the first.
///
/// # Errors
/// When they cannot be read, cannot be taken, or are not those that its manifest is of.
fn read(
    found: &Found,
    header: &mut Option<Vec<u8>>,
    take: &mut dyn FnMut(&[u8]) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let (path, record) = (&found.rows, &found.record);
    let cannot_read = || format!("cannot read {}", path.display());
    let bytes = fs::metadata(path).with_context(cannot_read)?.len();
    let mut file = BufReader::with_capacity(1 << 20, Hashed::open(path)?.take(record.bytes));
    let mut line = Vec::new();
    file.read_until(b'\n', &mut line)
        .with_context(cannot_read)?;
    if header.is_none() {
        take(&line)?;
    }
    let alike = *header.get_or_insert_with(|| line.clone()) == line;
    loop {
        let piece = file.fill_buf().with_context(cannot_read)?;
        let length = piece.len();
        if length == 0 {
            break;
        }
        take(piece)?;
        file.consume(length);
    }
    let hash = file.into_inner().into_inner().hash();
    if bytes != record.bytes || !record.is_of(hash) {
        bail!(
            "{} has been changed: it is not what {} is of; make {} again",
            path.display(),
            found.manifest.display(),
            found.shard
        );
    }
    if !alike {
        bail!(
            "{} has other columns than the shards before it; make {} again",
            path.display(),
            found.shard
        );
    }
    Ok(())
}

/// Refuses an `output` that something else stands in the way of.
pub(crate) fn check_output(output: &Path, plan: &Plan, errors: &mut Vec<String>) {
    let record = output.with_extension("json");
    if record == output {
        errors.push(format!(
            "the record goes to {}: name another file for the rows, such as campaign.csv",
            output.display()
        ));
    }
    let inputs = plan.shards.iter().chain(&plan.others);
    let same = |a: &Path, b: &Path| {
        a.canonicalize()
            .is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
    };
    for input in inputs.flat_map(|found| [&found.rows, &found.manifest]) {
        if [output, &record].iter().any(|path| same(path, input)) {
            errors.push(format!(
                "{} would be overwritten: it is a shard's; choose another --output",
                input.display()
            ));
        }
    }
    let partial = output.with_extension("csv.partial");
    if partial.exists() {
        errors.push(format!(
            "a campaign is under way in {}: remove that file, or choose another --output",
            partial.display()
        ));
    }
}
