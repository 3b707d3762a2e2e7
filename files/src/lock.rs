//! [`Lock`]: one run at a time makes the same files in a folder.

use std::fs::{File, TryLockError};
use std::io::{Read, Write};
use std::path::Path;

use anyhow::{Context, bail};

use crate::target::{folder_of, target};

/// Held for as long as this lives; the system gives it back however the program ends.
///
/// The file that it is held on stays: were it removed, one run could hold the removed file and another a new one of the
/// same name. Without a run that holds it, it is in nobody's way.
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the file at `path`, whose folder must be there, or says who makes `what` there already.
    pub fn take(path: &Path, what: &str) -> anyhow::Result<Self> {
        let mut file = File::options()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(target(path)?)
            .with_context(|| format!("cannot open {}", path.display()))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                // Where a locked file cannot be read, the holder stays unnamed.
                let read = (&file).take(20).read_to_string(&mut holder);
                let holder = match (read, holder.trim().parse::<u32>()) {
                    (Ok(_), Ok(id)) => format!("process {id}"),
                    _ => "another process".to_owned(),
                };
                bail!(
                    "{holder} makes {what} in {}; wait for its end, or choose another --output",
                    folder_of(path).display()
                );
            }
            Err(TryLockError::Error(error)) => {
                return Err(error).with_context(|| {
                    format!(
                        "cannot lock {}; choose an --output on a file system that has locks",
                        path.display()
                    )
                });
            }
        }
        let named = file
            .set_len(0)
            .and_then(|()| writeln!(file, "{}", std::process::id()));
        named.with_context(|| format!("cannot write {}", path.display()))?;
        Ok(Self { _file: file })
    }
}
