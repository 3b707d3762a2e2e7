//! What the TOML parser found, for a reader who wants to mend it.

use toml::de::DeTable;

use crate::diagnostics::{Diagnostic, Sink};

/// Reports one syntax error for each line, up to where the text has lost its shape.
pub(super) fn report(text: &str, mut faults: Vec<toml::de::Error>, sink: &Sink) {
    let span = |fault: &toml::de::Error| fault.span().unwrap_or(0..0);
    // The parser runs in several passes over the text, each with its own errors.
    faults.sort_by_key(|fault| span(fault).start);
    let mut last_line = None;
    for fault in &faults {
        let span = span(fault);
        let line = sink.line(&span);
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
        let duplicate = message == "duplicate key";
        // A line that is sound by itself suffers from an array, table or string that was opened before it
        // and not closed. So do all lines after it: they would only bury the one that matters.
        let unclosed = !duplicate && span.end < text.len() && DeTable::parse(line).is_ok();
        let mut diagnostic = Diagnostic::error(span, format!("not TOML: {message}"));
        if let Some(expected) = expected {
            diagnostic = diagnostic.label(format!("expected {expected}"));
        }
        if unclosed {
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
