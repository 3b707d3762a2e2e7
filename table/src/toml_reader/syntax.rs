//! What the TOML parser found, for a reader who wants to mend it.

use toml::de::DeTable;

use super::amend::amend_line;
use super::headers;
use super::key::Section;
use crate::diagnostics::{Diagnostic, Sink};

/// The parser's words for a key that is there twice.
const DUPLICATE: &str = "duplicate key";

/// Its words for a value without quotes, by the first letter: of a string, of `nan` and `inf`, of `true` and `false`.
const WORDS: [&str; 3] = [
    "string values must be quoted",
    "invalid float",
    "invalid boolean",
];

/// Reports one syntax error for each line, up to where the text has lost its shape.
pub(super) fn report(
    text: &str,
    root: &'static Section,
    mut faults: Vec<toml::de::Error>,
    sink: &Sink,
) {
    let is_duplicate = |fault: &toml::de::Error| fault.message() == DUPLICATE;
    if faults.iter().any(is_duplicate) && headers::report(text, root, sink) {
        // They follow from the headers.
        faults.retain(|fault| !is_duplicate(fault));
    }
    if text.trim_start().starts_with('{') {
        let start = text.len() - text.trim_start().len();
        let error = Diagnostic::error(start..start + 1, "not TOML: this looks like JSON");
        return sink.push(
            error.help("write `key = value` on a line each, without braces around all of it"),
        );
    }
    if text.trim_start().starts_with('<') {
        let start = text.len() - text.trim_start().len();
        let error = Diagnostic::error(start..start + 1, "not TOML: this looks like XML");
        return sink.push(error.help(
            "a robot description (URDF) becomes a table by `ulna import FILE --output my_arm.toml`",
        ));
    }
    let span = |fault: &toml::de::Error| fault.span().unwrap_or(0..0);
    // The parser runs in several passes over the text, each with its own errors.
    faults.sort_by_key(|fault| span(fault).start);
    let mut last_line = None;
    for fault in &faults {
        let span = span(fault);
        let (line, marked) = sink.line(&span);
        // What follows on the same line is mostly the first error's echo.
        if last_line.replace(line.as_ptr()) == Some(line.as_ptr()) {
            continue;
        }
        let (message, expected) = fault
            .message()
            .split_once(", expected ")
            .filter(|(_, expected)| *expected != "nothing")
            .map_or((fault.message(), None), |(message, expected)| {
                (message, Some(expected))
            });
        let message = message.trim_end_matches(", expected nothing");
        let duplicate = message == DUPLICATE;
        // A line that is sound by itself suffers from an array, table or string that was opened before it
        // and not closed. So do all lines after it: they would only bury the one that matters.
        let unclosed = !duplicate && span.end < text.len() && DeTable::parse(line).is_ok();
        let amendment = Some(marked.start).filter(|_| !duplicate && !unclosed);
        let amendment = amendment.and_then(|at| amend_line(line, at, WORDS.contains(&message)));
        let message = amendment.as_ref().map_or(message, |meant| &meant.message);
        let mut diagnostic = Diagnostic::error(span, format!("not TOML: {message}"));
        if let Some(expected) = expected.filter(|_| amendment.is_none()) {
            diagnostic = diagnostic.label(format!("expected {expected}"));
        }
        if let Some(amendment) = amendment {
            diagnostic = diagnostic.help(amendment.help);
        } else if unclosed {
            diagnostic = diagnostic.help("close the bracket or quote that was opened above");
        } else if duplicate {
            diagnostic = diagnostic
                .help("write each key once; a header in `[[ ]]` begins another entry of a list");
        }
        sink.push(diagnostic);
        if unclosed {
            return;
        }
    }
}
