//! [`Note`]: a liberty that an import has taken, or a choice that it has made.

use std::fmt;

/// What an import has made of a description that somebody should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What it is about.
    pub kind: NoteKind,
    /// In a sentence that stands by itself.
    pub message: String,
    /// The line of the description that it is about, from 1, if there is one.
    pub line: Option<usize>,
}

/// What a [`Note`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoteKind {
    /// The base, the tip or the task was chosen.
    Chosen,
    /// Links were counted with another that they hang on by fixed joints.
    Merged,
    /// A joint beside the chain was frozen, and its link counted.
    Frozen,
    /// A link was left out, because somebody asked for it or because it hangs on the base.
    Dropped,
    /// A name was changed.
    Renamed,
    /// A number was left out because it says nothing.
    LeftOut,
    /// An inertia that no rigid body can have was taken over.
    Accepted,
    /// What a description cannot say, and was assumed.
    Assumed,
}

impl fmt::Display for Note {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str(&self.message)?;
        match self.line {
            Some(line) => write!(text, " (line {line})"),
            None => Ok(()),
        }
    }
}
