//! [`Found`]: the shards that a user names, each with its manifest.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use ulna_files::refuse_special;
use ulna_study::experiment::Shard;

use crate::part::is_stem;
use crate::record::{Record, ShardRecord};

/// A shard by its manifest.
pub(crate) struct Found {
    pub(crate) manifest: PathBuf,
    /// Its rows, once they are complete.
    pub(crate) rows: PathBuf,
    pub(crate) shard: Shard,
    pub(crate) about: ShardRecord,
    pub(crate) record: Record,
}

impl Found {
    /// Whether all rows are there, by the manifest and by the file's name.
    pub(crate) fn is_complete(&self) -> bool {
        self.record.rows == self.about.rows() && self.rows.exists()
    }
}

/// The shards at `paths`; those that cannot be read are errors. One that is named twice is found once.
pub(crate) fn find(paths: &[PathBuf], errors: &mut Vec<String>) -> Vec<Found> {
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for path in paths {
        let manifests = match manifests(path) {
            Ok(manifests) => manifests,
            Err(error) => {
                errors.push(error);
                continue;
            }
        };
        for manifest in manifests {
            let same = manifest.canonicalize().unwrap_or_else(|_| manifest.clone());
            if seen.insert(same) {
                match read(manifest) {
                    Ok(shard) => found.push(shard),
                    Err(error) => errors.push(error),
                }
            }
        }
    }
    found
}

/// What shards' files end in, the longest first.
const ENDS: [&str; 3] = [".csv.partial", ".csv", ".json"];

/// The manifests that `path` stands for, whether they are there or not.
fn manifests(path: &Path) -> Result<Vec<PathBuf>, String> {
    let cannot_read = |error| format!("cannot read {}: {error}", path.display());
    let metadata = fs::metadata(path).map_err(cannot_read)?;
    if !metadata.is_dir() {
        let stem = stem(path).ok_or_else(|| {
            format!(
                "{} is no shard: name its manifest (.json), its rows (.csv), or their folder",
                path.display()
            )
        })?;
        return Ok(vec![path.with_file_name(stem + ".json")]);
    }
    let mut stems = BTreeSet::new();
    for entry in fs::read_dir(path).map_err(cannot_read)? {
        let entry = entry.map_err(cannot_read)?;
        stems.extend(stem(&entry.path()).filter(|stem| is_stem(stem)));
    }
    if stems.is_empty() {
        return Err(format!(
            "no shard is in {}; `ulna campaign SCENARIO --shard I/N --output DIR` makes them",
            path.display()
        ));
    }
    let manifests = stems.into_iter();
    Ok(manifests.map(|stem| path.join(stem + ".json")).collect())
}

/// A file's name without what shards' files end in.
fn stem(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let stem = ENDS.iter().find_map(|end| name.strip_suffix(end));
    stem.map(str::to_owned)
}

fn read(manifest: PathBuf) -> Result<Found, String> {
    refuse_special(&manifest).map_err(|error| format!("{error:#}"))?;
    let text = fs::read(&manifest).map_err(|error| {
        format!(
            "{} is not there or cannot be read: without it nobody can tell which shard the rows beside it are ({error}); \
             make the shard again",
            manifest.display()
        )
    })?;
    let record: Option<Record> = serde_json::from_slice(&text).ok();
    let found = record.and_then(|record| {
        let about = record.shard.clone()?;
        let shard = about.shard()?;
        (record.rows <= about.rows()).then_some((record, about, shard))
    });
    let Some((record, about, shard)) = found else {
        return Err(format!(
            "{} is no manifest of a shard; make the shard again",
            manifest.display()
        ));
    };
    Ok(Found {
        rows: manifest.with_extension("csv"),
        manifest,
        shard,
        about,
        record,
    })
}
