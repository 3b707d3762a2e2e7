//! Files, written whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use tempfile::NamedTempFile;

use crate::target::{cannot_write, folder_of, target};

/// Writes `bytes` under another name first, so that the file at `path` is never half of them.
/// Symbolic links are written through.
pub fn write_whole(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    Staged::write(path, bytes)?.persist()
}

/// Writes `bytes` to a new file: what stands at `path` already stays as it is, and is an error.
pub fn write_new(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    Staged::write(path, bytes)?.persist_new()
}

/// A file that is written, but has not got its name yet. Dropped, it leaves nothing.
pub struct Staged {
    file: NamedTempFile,
    path: PathBuf,
    target: PathBuf,
}

impl Staged {
    /// What `path` is to have: `bytes`.
    pub fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<Self> {
        let mut growing = Growing::new(path)?;
        growing.add(bytes)?;
        growing.finish()
    }

    /// A copy of the file at `from`, which may be larger than the memory.
    pub fn copy(path: &Path, from: &Path) -> anyhow::Result<Self> {
        let mut growing = Growing::new(path)?;
        let copied =
            fs::File::open(from).and_then(|mut from| io::copy(&mut from, &mut growing.out));
        copied.with_context(|| cannot_write(path))?;
        growing.finish()
    }

    /// Gives the file its name.
    pub fn persist(self) -> anyhow::Result<()> {
        let Self { file, path, target } = self;
        file.persist(target)
            .map(drop)
            .map_err(|failed| failed.error)
            .with_context(|| cannot_write(&path))
    }

    /// The same where no file may have that name yet.
    fn persist_new(self) -> anyhow::Result<()> {
        let Self { file, path, target } = self;
        file.persist_noclobber(target)
            .map(drop)
            .map_err(|failed| failed.error)
            .with_context(|| cannot_write(&path))
    }
}

/// A file that is written piece by piece, and has not got its name yet. Dropped, it leaves nothing.
pub struct Growing {
    // The file itself: errors of `NamedTempFile` name it, which nobody has asked for.
    out: BufWriter<fs::File>,
    file: NamedTempFile,
    path: PathBuf,
    target: PathBuf,
}

impl Growing {
    /// Nothing yet of what `path` is to have.
    pub fn new(path: &Path) -> anyhow::Result<Self> {
        let target = target(path)?;
        let opened = temporary(&target).and_then(|file| {
            let out = BufWriter::with_capacity(1 << 20, file.as_file().try_clone()?);
            Ok((out, file))
        });
        let (out, file) = opened.with_context(|| cannot_write(path))?;
        Ok(Self {
            out,
            file,
            path: path.to_path_buf(),
            target,
        })
    }

    /// The next piece.
    pub fn add(&mut self, bytes: &[u8]) -> anyhow::Result<()> {
        let added = self.out.write_all(bytes);
        added.with_context(|| cannot_write(&self.path))
    }

    /// There is no more to come.
    pub fn finish(mut self) -> anyhow::Result<Staged> {
        // A file system may find out only now that it is full.
        let written = self
            .out
            .flush()
            .and_then(|()| self.file.as_file().sync_all());
        written.with_context(|| cannot_write(&self.path))?;
        Ok(Staged {
            file: self.file,
            path: self.path,
            target: self.target,
        })
    }
}

/// A file beside `target`, with the rights of the file that stands there.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let old = fs::metadata(target)
        .ok()
        .map(|metadata| metadata.permissions());
    let mut options = fs::File::options();
    options.read(true).write(true).create_new(true);
    #[cfg(unix)]
    {
        // A new one is like any new file, and not only for its owner; the umask applies.
        use std::os::unix::fs::{OpenOptionsExt, PermissionsExt};
        options.mode(old.as_ref().map_or(0o666, PermissionsExt::mode));
    }
    let folder = folder_of(target);
    // Opened here: an error of `tempfile_in` would name the temporary file.
    let file = tempfile::Builder::new().make_in(folder, |path| options.open(path))?;
    if let Some(old) = old {
        file.as_file().set_permissions(old)?;
    }
    Ok(file)
}

/// Refuses a `folder` that no file can be written to, before the work that leads to the files. Makes nothing.
pub fn check_folder(folder: &Path) -> anyhow::Result<()> {
    let cannot_make = || format!("cannot make the folder {}", folder.display());
    for there in folder.ancestors() {
        // The last ancestor of a relative path is empty: the folder that the program runs in.
        let there = if there.as_os_str().is_empty() {
            Path::new(".")
        } else {
            there
        };
        match fs::metadata(there) {
            Ok(metadata) if metadata.is_dir() => {
                return tempfile::tempfile_in(there)
                    .map(drop)
                    .with_context(|| format!("cannot write to the folder {}", there.display()));
            }
            Ok(_) => bail!("{}: {} is a file", cannot_make(), there.display()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if let Ok(to) = fs::read_link(there) {
                    bail!(
                        "{}: {} is a symbolic link to {}, which is not there; make that folder, or choose another --output",
                        cannot_make(),
                        there.display(),
                        to.display()
                    );
                }
            }
            // Of a path through a file; that file is further up.
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {}
            Err(error) => return Err(error).with_context(cannot_make),
        }
    }
    Ok(())
}

/// The files of a folder before they are written: what fails on the way leaves nothing behind.
#[derive(Default)]
pub struct Files(Vec<(PathBuf, Vec<u8>)>);

impl Files {
    /// Adds a file; `name` may have folders in it.
    pub fn add(&mut self, name: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) {
        self.0.push((name.into(), bytes.into()));
    }

    /// Writes all of them into `folder`, which is made if need be, and returns their paths.
    ///
    /// None gets its name before all are written: where there is no room for one, those that stand there stay as they are.
    pub fn write_to(self, folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
        // Dropped last: after the files in them.
        let mut made = MadeFolders(Vec::new());
        let mut paths = Vec::new();
        for file in self.stage(folder, &mut made)? {
            paths.push(file.path.clone());
            file.persist()?;
            made.keep();
        }
        Ok(paths)
    }

    /// Writes all of them as new files into `folder`, which is made if need be, and returns their paths.
    ///
    /// Whatever fails, a file that is there already among it: none of them is left, and none of the folders made for them.
    pub fn write_new_to(self, folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
        let mut made = MadeFolders(Vec::new());
        let mut written = WrittenFiles(Vec::new());
        for file in self.stage(folder, &mut made)? {
            let path = file.path.clone();
            file.persist_new()?;
            written.0.push(path);
        }
        made.keep();
        Ok(written.keep())
    }

    /// Writes all of them, but none under its name yet.
    fn stage(self, folder: &Path, made: &mut MadeFolders) -> anyhow::Result<Vec<Staged>> {
        let mut staged = Vec::new();
        for (name, bytes) in self.0 {
            let path = folder.join(name);
            let parent = path.parent().unwrap_or(folder);
            made.make(parent)
                .with_context(|| format!("cannot make the folder {}", parent.display()))?;
            staged.push(Staged::write(&path, &bytes)?);
        }
        Ok(staged)
    }
}

/// New files that have their names while others wait for theirs. Dropped before they are kept, they are removed again.
struct WrittenFiles(Vec<PathBuf>);

impl WrittenFiles {
    fn keep(mut self) -> Vec<PathBuf> {
        std::mem::take(&mut self.0)
    }
}

impl Drop for WrittenFiles {
    fn drop(&mut self) {
        for file in &self.0 {
            let _ = fs::remove_file(file);
        }
    }
}

/// Folders made for files that are under way. Dropped before they are kept, they are removed again.
struct MadeFolders(Vec<PathBuf>);

impl MadeFolders {
    fn make(&mut self, folder: &Path) -> io::Result<()> {
        let missing: Vec<_> = folder
            .ancestors()
            .take_while(|path| !path.as_os_str().is_empty() && !path.is_dir())
            .collect();
        for path in missing.into_iter().rev() {
            match fs::create_dir(path) {
                Ok(()) => self.0.push(path.to_path_buf()),
                // `a/..` is there once `a` is, and another program may have made it meanwhile.
                Err(_) if path.is_dir() => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    fn keep(&mut self) {
        self.0.clear();
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            // It fails, as it should, if somebody else has put something there.
            let _ = fs::remove_dir(folder);
        }
    }
}
