//! As much of a text as is shown of it.

use std::ops::Range;

/// The line that holds the start of `span`, without its end, and the part of `span` that lies in it.
pub(super) fn line_around<'t>(text: &'t str, span: &Range<usize>) -> (&'t str, Range<usize>) {
    let start = floor_char(text, span.start);
    let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
    let rest = &text[line_start..];
    let line = rest.lines().next().unwrap_or_default();
    let end = floor_char(text, span.end.max(start));
    let marked = (start - line_start).min(line.len())..(end - line_start).min(line.len());
    (line, marked)
}

/// `text` without its middle, if it is far too long to be read: it quotes what a file says, and that may be anything.
pub(super) fn shortened(text: String) -> String {
    /// In characters.
    const START: usize = 400;
    const END: usize = 200;
    let Some((from, _)) = text.char_indices().nth(START) else {
        return text;
    };
    match text[from..].char_indices().rev().nth(END - 1) {
        Some((to, _)) if to > 0 => format!("{} ... {}", &text[..from], &text[from + to..]),
        _ => text,
    }
}

/// So much of `marked` that it can be shown: the renderer cuts a long line around what is marked in it, and not the mark.
pub(super) fn start_of(line: &str, marked: Range<usize>) -> Range<usize> {
    /// In characters.
    const SHOWN: usize = 100;
    let end = line[marked.clone()].char_indices().nth(SHOWN);
    marked.start..end.map_or(marked.end, |(end, _)| marked.start + end)
}

/// The last character boundary of `text` at or before `byte`.
pub(super) fn floor_char(text: &str, byte: usize) -> usize {
    (0..=byte.min(text.len()))
        .rev()
        .find(|&byte| text.is_char_boundary(byte))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_loses_its_middle() {
        for length in [1, 400, 600] {
            let whole = "\u{e9}".repeat(length);
            assert_eq!(shortened(whole.clone()), whole);
        }
        for length in [601, 200_000] {
            let cut = shortened(format!("a{}b", "\u{e9}".repeat(length)));
            assert_eq!(cut.chars().count(), 605, "{cut}");
            assert!(cut.starts_with('a') && cut.ends_with('b'), "{cut}");
        }
    }
}
