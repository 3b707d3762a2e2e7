//! Files, written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// Writes `bytes` under another name first, so that `path` is never half of them.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // Like any new file, and not only for its owner; the umask applies.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

/// Refuses a `folder` that no file can be written to, before the work that leads to the files. Makes nothing.
pub(crate) fn check_folder(folder: &Path) -> anyhow::Result<()> {
    // The last ancestor of a relative path is empty: the folder that the program runs in.
    let there = folder.ancestors().find(|path| path.exists());
    let there = there.unwrap_or(Path::new("."));
    if !there.is_dir() {
        bail!(
            "cannot make the folder {}: {} is a file",
            folder.display(),
            there.display()
        );
    }
    tempfile::tempfile_in(there)
        .map(drop)
        .with_context(|| format!("cannot write to the folder {}", there.display()))
}

/// The files of a folder before they are written: what fails on the way leaves nothing behind.
#[derive(Default)]
pub(crate) struct Files(Vec<(PathBuf, Vec<u8>)>);

impl Files {
    /// Adds a file; `name` may have folders in it.
    pub(crate) fn add(&mut self, name: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) {
        self.0.push((name.into(), bytes.into()));
    }

    /// Writes all of them into `folder`, which is made if need be, and returns their paths.
    pub(crate) fn write_to(self, folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
        let write = |(name, bytes): (PathBuf, Vec<u8>)| {
            let path = folder.join(name);
            let parent = path.parent().unwrap_or(folder);
            fs::create_dir_all(parent)
                .with_context(|| format!("cannot make the folder {}", parent.display()))?;
            write_whole(&path, &bytes)
                .with_context(|| format!("cannot write {}", path.display()))?;
            Ok(path)
        };
        self.0.into_iter().map(write).collect()
    }
}
