//! The text of a file, or why there is none.

use std::fs::{File, metadata};
use std::io::Read;
use std::path::Path;

use super::closest;
use crate::diagnostics::{Diagnostic, Diagnostics, Sink};

/// The text of the file at `path` in `folder`, which may have `max_bytes`. Errors call it `path`.
pub fn read_file(folder: &Path, path: &Path, max_bytes: u64) -> Result<String, Diagnostics> {
    let name = path.display().to_string();
    let file = folder.join(path);
    let refuse = |message: String, help: Option<String>| {
        let error = Diagnostic::file_error(message);
        let error = help.into_iter().fold(error, Diagnostic::help);
        Diagnostics::of_file(&name, error)
    };
    // Asked of the path: to open a pipe is to wait for its writer, and a device may have no end.
    match metadata(&file) {
        Ok(found) if found.is_dir() => {
            let help = format!("name a file in it, such as {name}/my.toml");
            let message = "this is a directory, not a file".to_owned();
            return Err(refuse(message, Some(help)));
        }
        Ok(found) if !found.is_file() => {
            let help = "save the text in a file, and name that".to_owned();
            let message = "this is no regular file, but a pipe, a socket or a device".to_owned();
            return Err(refuse(message, Some(help)));
        }
        // Why there is none, opening it says.
        _ => {}
    }
    let mut bytes = Vec::new();
    File::open(&file)
        .and_then(|file| file.take(max_bytes + 1).read_to_end(&mut bytes))
        .map_err(|error| {
            let help = similar_name(&file)
                .map(|name| format!("did you mean {}?", path.with_file_name(name).display()))
                .or_else(|| {
                    let absolute = std::path::absolute(&file).ok();
                    let absolute = absolute.filter(|_| path.is_relative())?;
                    Some(format!("no file can be read at {}", absolute.display()))
                });
            refuse(format!("cannot read the file: {error}"), help)
        })?;
    if bytes.len() as u64 > max_bytes {
        let message = format!("the file is larger than {} KiB", max_bytes / 1024);
        let help = "what describes an arm or an experiment is far smaller".to_owned();
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

/// The name of the file beside `file` that is closest to its own.
fn similar_name(file: &Path) -> Option<String> {
    let folder = match file.parent()? {
        here if here.as_os_str().is_empty() => Path::new("."),
        folder => folder,
    };
    let entries = folder.read_dir().ok()?.filter_map(Result::ok);
    let mut names: Vec<_> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    // A folder lists its files in no particular order.
    names.sort_unstable();
    closest(file.file_name()?.to_str()?, &names).cloned()
}
