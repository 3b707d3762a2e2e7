//! What stands at a path, before it is written or read.

use std::fs::{self, FileType};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// As many links follow each other in a path that Linux still opens.
const MOST_LINKS: usize = 40;

/// The file that writing to `path` is about: symbolic links stay what they are, and the file that they lead to is
/// replaced, or made. What is no regular file is refused: a device that is replaced by a file is a broken device.
pub fn target(path: &Path) -> anyhow::Result<PathBuf> {
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => bail!(
            "{}: it is {}, no regular file; name another file",
            cannot_write(path),
            kind(found.file_type())
        ),
        Ok(found) if found.permissions().readonly() => bail!(
            "{}: it is write-protected; name another file, or permit writing to it",
            cannot_write(path)
        ),
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            return Err(error).with_context(|| cannot_write(path));
        }
        _ => {}
    }
    let mut target = path.to_path_buf();
    // Of a chain that never ends the system has said so above.
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = folder_of(&target).join(next),
            Err(_) => break,
        }
    }
    let folder = folder_of(&target);
    if !folder.is_dir() {
        bail!(
            "{}: the folder {} is not there; make it, or name a file elsewhere",
            cannot_write(path),
            folder.display()
        );
    }
    Ok(target)
}

/// Refuses to read what is no regular file: a pipe would be waited for, and a device might never end.
pub fn refuse_special(path: &Path) -> anyhow::Result<()> {
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => bail!(
            "cannot read {}: it is {}, no regular file",
            path.display(),
            kind(found.file_type())
        ),
        // That there is none is for whoever reads it to say.
        _ => Ok(()),
    }
}

fn kind(file_type: FileType) -> &'static str {
    if file_type.is_dir() {
        return "a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file_type.is_fifo() {
            return "a pipe";
        } else if file_type.is_socket() {
            return "a socket";
        }
    }
    "a device"
}

pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

pub(crate) fn cannot_write(path: &Path) -> String {
    format!("cannot write {}", path.display())
}
