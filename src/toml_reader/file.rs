//! The text of a file, or why there is none.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::closest;
use crate::diagnostics::{Diagnostic, Diagnostics, Sink};

/// The text of the file at `path`, which may have `max_bytes`.
pub(crate) fn read_file(path: &Path, max_bytes: u64) -> Result<String, Diagnostics> {
    let name = path.display().to_string();
    let refuse = |message: String, help: Option<String>| {
        let error = Diagnostic::file_error(message);
        let error = help.into_iter().fold(error, Diagnostic::help);
        Diagnostics::of_file(&name, error)
    };
    if path.is_dir() {
        let help = format!("name a file in it, for example {name}/my_arm.toml");
        return Err(refuse(
            "this is a directory, not a file".to_owned(),
            Some(help),
        ));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(max_bytes + 1).read_to_end(&mut bytes))
        .map_err(|error| {
            let help = similar_file(path)
                .map(|path| format!("did you mean {}?", path.display()))
                .or_else(|| {
                    let here = std::env::current_dir()
                        .ok()
                        .filter(|_| path.is_relative())?;
                    Some(format!("the path starts in {}", here.display()))
                });
            refuse(format!("cannot read the file: {error}"), help)
        })?;
    if bytes.len() as u64 > max_bytes {
        let message = format!("the file is larger than {} KiB", max_bytes / 1024);
        let help = "an arm's table or a scenario is far smaller".to_owned();
        return Err(refuse(message, Some(help)));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let sink = Sink::new(&name, &text);
        let replacement = valid..valid + char::REPLACEMENT_CHARACTER.len_utf8();
        sink.push(
            Diagnostic::error(replacement, "the file is not UTF-8")
                .label("not a character")
                .help("save the file with the encoding UTF-8"),
        );
        sink.finish()
    })
}

/// The file beside `path` whose name is closest to its.
fn similar_file(path: &Path) -> Option<PathBuf> {
    let folder = match path.parent()? {
        here if here.as_os_str().is_empty() => Path::new("."),
        folder => folder,
    };
    let entries = folder.read_dir().ok()?.filter_map(Result::ok);
    let mut names: Vec<_> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    // A folder lists its files in no particular order.
    names.sort_unstable();
    let meant = closest(path.file_name()?.to_str()?, &names)?;
    Some(path.with_file_name(meant))
}
