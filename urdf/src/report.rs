//! [`Report`]: what is found on the way: errors and warnings with their places, and notes.

use ulna_table::diagnostics::{Diagnostic, Sink};

use crate::note::{Note, NoteKind};
use crate::robot::Span;

/// What an import has to say.
pub(crate) struct Report<'s> {
    text: &'s str,
    sink: &'s Sink,
    pub(crate) notes: Vec<Note>,
}

impl<'s> Report<'s> {
    pub(crate) fn new(text: &'s str, sink: &'s Sink) -> Self {
        Self {
            text,
            sink,
            notes: Vec::new(),
        }
    }

    pub(crate) fn sink(&self) -> &'s Sink {
        self.sink
    }

    /// An error or a warning.
    pub(crate) fn push(&self, diagnostic: Diagnostic) {
        self.sink.push(diagnostic);
    }

    /// A note about the element at `span`.
    pub(crate) fn note_at(&mut self, span: &Span, kind: NoteKind, message: String) {
        let line = self.line(span);
        self.notes.push(Note {
            kind,
            message,
            line: Some(line),
        });
    }

    /// A note about nothing in particular.
    pub(crate) fn note(&mut self, kind: NoteKind, message: String) {
        self.notes.push(Note {
            kind,
            message,
            line: None,
        });
    }

    /// The line of a place, from 1.
    pub(crate) fn line(&self, span: &Span) -> usize {
        let before = self.text.get(..span.start).unwrap_or(self.text);
        before.matches('\n').count() + 1
    }
}
