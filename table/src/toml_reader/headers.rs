//! Headers that make one table of what should be a list, or a list of nothing that the format knows.
//!
//! TOML takes them for what they say, and complains of all that follows: each key of the second joint is there already.
//! Here the header itself is found, so that one mistake is one error.

use std::ops::Range;

use super::closest;
use super::key::{Kind, Section};
use crate::diagnostics::{Diagnostic, Sink};

/// A header as it stands in the text.
struct Header<'t> {
    path: &'t str,
    in_list: bool,
    span: Range<usize>,
}

/// A header of the format.
struct Known {
    path: String,
    in_list: bool,
}

/// Reports the headers of `text` that are not those of the format, each once, and returns whether there are any.
pub(super) fn report(text: &str, root: &'static Section, sink: &Sink) -> bool {
    let known = known(root, "");
    let mut begun: Vec<&str> = Vec::new();
    let mut told: Vec<&str> = Vec::new();
    for header in headers(text) {
        let Some(meant) = meant(header.path, &known) else {
            continue;
        };
        let list = list_above(&meant.path, &known);
        let fault = fault(&header, meant, list.filter(|list| !begun.contains(list)));
        begun.push(&meant.path);
        begun.extend(list);
        if let Some((message, help)) = fault
            && !told.contains(&header.path)
        {
            told.push(header.path);
            let error = Diagnostic::error(header.span, message);
            sink.push(error.label("this header").help(help));
        }
    }
    !told.is_empty()
}

/// What is wrong with a header that means `meant`, and what to write. `missing` is the list above it, if that has not begun.
fn fault(header: &Header<'_>, meant: &Known, missing: Option<&str>) -> Option<(String, String)> {
    let path = header.path;
    if path != meant.path {
        let message = format!("unknown header `{path}`");
        return Some((message, format!("did you mean `{}`?", meant.written())));
    }
    if meant.in_list && !header.in_list {
        let message = format!("`[{path}]` begins a table, but `{path}` is a list of them");
        return Some((message, format!("write `[[{path}]]`, every time")));
    }
    let list = missing?;
    let message = format!("`{}` stands before the first `[[{list}]]`", meant.written());
    Some((message, format!("write `[[{list}]]` and its keys above it")))
}

impl Known {
    fn written(&self) -> String {
        if self.in_list {
            format!("[[{}]]", self.path)
        } else {
            format!("[{}]", self.path)
        }
    }

    fn last(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or_default()
    }
}

/// The headers of all tables below `section`.
fn known(section: &'static Section, prefix: &str) -> Vec<Known> {
    let mut headers = Vec::new();
    for key in section.keys {
        if let Some(below) = key.kind.section() {
            let path = format!("{prefix}{}", key.name);
            let deeper = known(below, &format!("{path}."));
            headers.push(Known {
                path,
                in_list: matches!(key.kind, Kind::Tables(_)),
            });
            headers.extend(deeper);
        }
    }
    headers
}

/// The header of the format that `path` is, or most likely stands for: `Joint` for `joint`, `link` for `joint.link`.
fn meant<'k>(path: &str, known: &'k [Known]) -> Option<&'k Known> {
    let find = |wanted: &str| known.iter().find(|known| known.path == wanted);
    find(path)
        .or_else(|| {
            find(closest(
                path,
                known.iter().map(|known| known.path.as_str()),
            )?)
        })
        .or_else(|| {
            let last = closest(path, known.iter().map(Known::last))?;
            known.iter().find(|known| known.last() == last)
        })
}

/// The list that the table at `path` is a part of.
fn list_above<'k>(path: &str, known: &'k [Known]) -> Option<&'k str> {
    let (above, _) = path.rsplit_once('.')?;
    let list = known
        .iter()
        .find(|known| known.in_list && known.path == above)?;
    Some(&list.path)
}

/// Lines that are headers. One in the middle of an array or a string may look like it, but hardly like one of the format.
fn headers(text: &str) -> impl Iterator<Item = Header<'_>> {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |line| {
        let at = start + (line.len() - line.trim_start().len());
        start += line.len();
        let code = line.split('#').next().unwrap_or_default().trim();
        let inner = code.strip_prefix('[')?.strip_suffix(']')?;
        let list = inner
            .strip_prefix('[')
            .and_then(|inner| inner.strip_suffix(']'));
        let path = list.unwrap_or(inner).trim();
        let bare = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        let is_path = !path.is_empty() && path.chars().all(bare);
        is_path.then(|| Header {
            path,
            in_list: list.is_some(),
            span: at..at + code.len(),
        })
    })
}
