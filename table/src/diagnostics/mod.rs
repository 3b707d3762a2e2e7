//! [`Diagnostics`]: what is wrong with a TOML text, where, and what to write instead.

mod excerpt;

use std::cell::RefCell;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{
    AnnotationKind, Level, Origin, Renderer, Snippet, normalize_untrusted_str,
};

use excerpt::{floor_char, line_around, shortened, start_of};

/// How grave a [`Diagnostic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The text is refused.
    Error,
    /// The text is accepted, but says something that is rarely meant.
    Warning,
}

/// A place in a text, counted as editors and rustc count: from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the text is refused for it.
    pub severity: Severity,
    /// What is wrong, in a sentence that stands by itself.
    pub message: String,
    /// A few words for the marked place; empty if the message says it all.
    pub label: String,
    /// What to write instead.
    pub help: Option<String>,
    /// The [lint](crate::Lint) that a warning is of, by the name that switches it off.
    pub lint: Option<&'static str>,
    /// Where; `None` if it is about the file as a whole.
    pub position: Option<Position>,
    span: Option<Range<usize>>,
}

impl Diagnostic {
    fn new(severity: Severity, span: Option<Range<usize>>, message: String) -> Self {
        Self {
            severity,
            message: shortened(message),
            label: String::new(),
            help: None,
            lint: None,
            position: None,
            span,
        }
    }

    /// An error at the bytes `span` of the text.
    pub fn error(span: Range<usize>, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, Some(span), message.into())
    }

    /// A warning at the bytes `span` of the text.
    pub fn warning(span: Range<usize>, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, Some(span), message.into())
    }

    /// An error about the file as a whole.
    pub fn file_error(message: impl Into<String>) -> Self {
        Self::new(Severity::Error, None, message.into())
    }

    /// With words at the place itself.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// As a finding of the lint `name`.
    pub fn lint(mut self, name: &'static str) -> Self {
        self.lint = Some(name);
        self
    }

    /// With what to write instead.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shortened(help.into()));
        self
    }
}

/// Collects diagnostics while a text is read. Shared by all readers of one text, hence the interior mutability.
#[doc(hidden)]
pub struct Sink {
    source_name: String,
    text: Arc<str>,
    found: RefCell<Vec<Diagnostic>>,
    allowed: RefCell<Vec<&'static str>>,
}

impl Sink {
    pub fn new(source_name: &str, text: &str) -> Self {
        Self {
            source_name: source_name.to_owned(),
            text: text.into(),
            found: RefCell::default(),
            allowed: RefCell::default(),
        }
    }

    pub fn push(&self, diagnostic: Diagnostic) {
        self.found.borrow_mut().push(diagnostic);
    }

    /// Leaves out what the lint `name` finds, from here on and before.
    pub fn allow(&self, name: &'static str) {
        self.allowed.borrow_mut().push(name);
    }

    /// Whether an error has been found.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.found.borrow())
    }

    /// The line of the text that holds the start of `span`, and the part of `span` that lies in it.
    pub fn line(&self, span: &Range<usize>) -> (&str, Range<usize>) {
        line_around(&self.text, span)
    }

    /// Everything found, in the order of the text.
    pub fn finish(self) -> Diagnostics {
        let allowed = self.allowed.into_inner();
        let mut list = self.found.into_inner();
        list.retain(|found| found.lint.is_none_or(|lint| !allowed.contains(&lint)));
        list.sort_by_key(|diagnostic| diagnostic.span.as_ref().map(|span| span.start));
        let lines = LineIndex::new(&self.text);
        for diagnostic in &mut list {
            diagnostic.position = diagnostic
                .span
                .as_ref()
                .map(|span| lines.position(span.start));
        }
        Diagnostics {
            source_name: self.source_name,
            text: self.text,
            list,
        }
    }
}

/// Everything found in one text. As an error ([`TableErrors`]) it holds at least one error.
///
/// `Display` and `Debug` give the full text without colour: each finding with its file, line, column,
/// the line itself, the place marked in it, and what to write instead.
#[derive(Clone)]
pub struct Diagnostics {
    source_name: String,
    text: Arc<str>,
    list: Vec<Diagnostic>,
}

/// Why a table was refused: every error in it at once, and the warnings beside them.
pub type TableErrors = Diagnostics;

impl Diagnostics {
    /// So many are written out; a text with more of them is not an arm's table.
    const SHOWN: usize = 100;

    /// One error about the file as a whole.
    pub fn of_file(source_name: &str, error: Diagnostic) -> Self {
        let sink = Sink::new(source_name, "");
        sink.push(error);
        sink.finish()
    }

    /// The name of the text, usually its path.
    pub fn source_name(&self) -> &str {
        &self.source_name
    }

    /// The findings, in the order of the text.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether there is an error among the findings.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.list)
    }

    /// The full text with ANSI colours, for a terminal.
    pub fn to_coloured_string(&self) -> String {
        self.render(&Renderer::styled())
    }

    fn render(&self, renderer: &Renderer) -> String {
        let mut blocks: Vec<String> = self
            .list
            .iter()
            .take(Self::SHOWN)
            .map(|diagnostic| self.render_one(diagnostic, renderer))
            .collect();
        if let Some(hidden @ 1..) = self.list.len().checked_sub(Self::SHOWN) {
            blocks.push(format!("... and {hidden} more in {}", self.source_name));
        }
        blocks.join("\n\n")
    }

    fn render_one(&self, diagnostic: &Diagnostic, renderer: &Renderer) -> String {
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let title = level.primary_title(&diagnostic.message);
        let path = normalize_untrusted_str(&self.source_name);
        let mut group = match (&diagnostic.span, diagnostic.position) {
            (Some(span), Some(position)) => {
                // Only the marked line goes out: it is all that is shown, and rendering stays linear in the text.
                let (line, marked) = line_around(&self.text, span);
                let marked = start_of(line, marked);
                let mut annotation = AnnotationKind::Primary.span(marked);
                if !diagnostic.label.is_empty() {
                    annotation = annotation.label(&diagnostic.label);
                }
                title.element(
                    Snippet::source(line)
                        .path(path)
                        .line_start(position.line)
                        .annotation(annotation),
                )
            }
            _ => title.element(Origin::path(path)),
        };
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(normalize_untrusted_str(help)));
        }
        if let Some(lint) = diagnostic.lint {
            let note = format!("`allow = [{lint:?}]` before the first header switches this off");
            group = group.element(Level::NOTE.message(note));
        }
        renderer.render(&[group])
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(&Renderer::plain()))
    }
}

/// The same text as `Display`: `main` prints the error that it returns by `Debug`.
impl fmt::Debug for Diagnostics {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} is refused\n\n{self}", self.source_name)
    }
}

impl std::error::Error for Diagnostics {}

fn has_errors(list: &[Diagnostic]) -> bool {
    let mut found = list.iter();
    found.any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// Where the lines of a text begin.
struct LineIndex<'t> {
    text: &'t str,
    starts: Vec<usize>,
}

impl<'t> LineIndex<'t> {
    fn new(text: &'t str) -> Self {
        let starts = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(newline, _)| newline + 1))
            .collect();
        Self { text, starts }
    }

    fn position(&self, byte: usize) -> Position {
        let byte = floor_char(self.text, byte);
        let line = self.starts.partition_point(|&start| start <= byte);
        let line_start = self.starts[line - 1];
        Position {
            line,
            column: self.text[line_start..byte].chars().count() + 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, span: Range<usize>) -> Diagnostics {
        let sink = Sink::new("a.toml", text);
        sink.push(Diagnostic::error(span, "wrong").label("here").help("right"));
        sink.finish()
    }

    #[test]
    fn positions_count_characters_from_one() {
        let position = |byte| at("é = 1\nb = 2\n", byte..byte + 1).list()[0].position;
        assert_eq!(position(0), Some(Position { line: 1, column: 1 }));
        assert_eq!(position(3), Some(Position { line: 1, column: 3 }));
        assert_eq!(position(7), Some(Position { line: 2, column: 1 }));
        assert_eq!(position(99), Some(Position { line: 3, column: 1 }));
    }

    #[test]
    fn a_span_over_lines_is_marked_to_the_end_of_its_first() {
        let text = at("x = [\r\n1,\n]\n", 4..12).to_string();
        assert!(text.contains("a.toml:1:5"), "{text}");
        assert!(text.contains("1 | x = [\n"), "{text}");
        assert!(text.contains("|     ^ here"), "{text}");
    }

    #[test]
    fn a_long_line_is_cut_around_the_mark() {
        let long = format!("{}\u{e9}", "\u{e9}x ".repeat(50_000));
        for (text, span) in [
            (format!("x = \"{long}\"\n"), 4..long.len() + 6),
            (format!("# {long} # {long}"), long.len() + 3..long.len() + 4),
            (format!("{}x = 1", " ".repeat(200_000)), 200_004..200_005),
            ("\t".repeat(200_000), 100_000..200_000),
        ] {
            let column = text[..span.start].chars().count() + 1;
            let shown = at(&text, span).to_string();
            assert!(shown.contains(&format!("a.toml:1:{column}\n")), "{shown}");
            assert!(shown.contains("^ here"), "{shown}");
            assert!(shown.lines().all(|line| line.len() < 800), "{shown}");
        }
    }

    #[test]
    fn no_escape_sequence_reaches_a_terminal_from_the_text() {
        let text = at("x = \u{1b}[31m1\u{202e}", 4..6).to_string();
        assert!(
            !text.contains('\u{1b}') && !text.contains('\u{202e}'),
            "{text}"
        );
    }

    #[test]
    fn colour_only_on_request() {
        let found = at("x = 1", 4..5);
        assert!(!found.to_string().contains('\u{1b}'));
        assert!(found.to_coloured_string().contains('\u{1b}'));
    }
}
