//! [`FileKind`]: the kinds of files, so that one which is given for another is told in one sentence.

use toml::de::DeTable;

use super::key::Section;
use crate::diagnostics::{Diagnostic, Sink};

/// A kind of file.
pub struct FileKind {
    /// With its article.
    pub name: &'static str,
    /// Keys before the first header that the other kind has not.
    pub marks: &'static [&'static str],
    /// Which commands take it.
    pub taken_by: &'static str,
    /// How the program shows one.
    pub shown_by: &'static str,
}

/// What [`Model`](crate::Model) is read from.
pub static ARM_TABLE: FileKind = FileKind {
    name: "an arm's table",
    marks: &["convention", "task", "joint"],
    taken_by: "`ulna check`, `ulna generate`, `ulna verify` and `ulna cost`",
    shown_by: "`ulna help table`",
};

/// What the crate `ulna-study` reads.
pub static SCENARIO: FileKind = FileKind {
    name: "a scenario",
    marks: &[
        "arm",
        "motion",
        "failure",
        "control",
        "search",
        "experiment",
    ],
    taken_by: "`ulna reproduce` and `ulna campaign`",
    shown_by: "`ulna help scenario`",
};

impl FileKind {
    /// So many keys of another kind are no accident.
    const ENOUGH: usize = 2;

    /// Reports a text that is nothing of this kind. Without anything else to say of it, one sentence is enough.
    pub(super) fn refuses(&self, entries: &DeTable<'_>, root: &Section, sink: &Sink) -> bool {
        debug_assert!(self.marks.iter().all(|mark| root.key(mark).is_some()));
        let marks = |kind: &Self| {
            kind.marks
                .iter()
                .filter(|mark| entries.contains_key(**mark))
                .count()
        };
        let first = entries
            .keys()
            .map(toml::Spanned::span)
            .min_by_key(|span| span.start);
        let Some(first) = first else {
            let help = format!("{} shows {}", self.shown_by, self.name);
            sink.push(Diagnostic::error(0..0, "there is no key in the file").help(help));
            return true;
        };
        let others = [&ARM_TABLE, &SCENARIO];
        let other = others
            .into_iter()
            .find(|other| marks(other) >= Self::ENOUGH);
        let Some(other) = other.filter(|_| marks(self) == 0) else {
            return false;
        };
        let message = format!("this looks like {}, not {}", other.name, self.name);
        let help = format!(
            "{} take {}; {} shows {}",
            other.taken_by, other.name, self.shown_by, self.name
        );
        sink.push(Diagnostic::error(first, message).help(help));
        true
    }
}
