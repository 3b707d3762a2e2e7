//! [`Key`] and [`Section`]: what a file may say, declared once. The readers ask for these keys, and the
//! [reference](super::reference) prints them, so that neither can know a key, a word, a bound or a default that the other does not.

use super::Bound;

/// One key of a table.
pub struct Key {
    pub name: &'static str,
    pub kind: Kind,
    pub need: Need,
    pub limits: &'static [Limit],
    /// What it is, in a sentence without its full stop.
    pub meaning: &'static str,
    /// What a message tells to write: code in backticks, words around it.
    pub write: &'static str,
}

impl Key {
    /// A key that must be there.
    pub const fn required(
        name: &'static str,
        kind: Kind,
        meaning: &'static str,
        write: &'static str,
    ) -> Self {
        Self {
            name,
            kind,
            need: Need::Required,
            limits: &[],
            meaning,
            write,
        }
    }

    /// The same key, needed otherwise.
    pub const fn need(self, need: Need) -> Self {
        Self { need, ..self }
    }

    /// The same key with limits.
    pub const fn limits(self, limits: &'static [Limit]) -> Self {
        Self { limits, ..self }
    }
}

/// What a value is.
pub enum Kind {
    Text,
    /// `true` or `false`.
    Flag,
    Number,
    /// Not negative and without a fraction.
    Whole,
    /// So many numbers.
    Numbers(usize),
    /// Any number of values; the words say how many are meant, and may be empty.
    List(&'static Self, &'static str),
    /// One of some words, which [`Choice::listed`] gives.
    Words(fn() -> Vec<(&'static str, &'static str)>),
    /// What it is tells the value's type.
    OneOf(&'static [Self]),
    Table(&'static Section),
    /// A table each, under headers in double brackets.
    Tables(&'static Section),
}

/// What is without the key.
pub enum Need {
    Required,
    /// What counts in its place.
    Default(fn() -> String),
    /// What the absence means, in words.
    Optional(&'static str),
    /// Required in one variant of the table, which has this line, and unknown in the others.
    With(&'static str),
}

/// What a number or a list may be.
pub enum Limit {
    Within(&'static Bound),
    /// From 1 to so much.
    Count(u64),
    /// A rule of its own, in words.
    Said(fn() -> String),
}

/// The keys of one table.
pub struct Section {
    /// As it stands in the text, such as `[task]`; empty for the keys before the first header.
    pub header: &'static str,
    /// What the table is about, and how often it may be there.
    pub meaning: &'static str,
    /// The section written out. All of them one after the other are a sound file.
    pub example: &'static str,
    pub keys: &'static [&'static Key],
}

impl Section {
    /// The key called `name`.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().copied().find(|key| key.name == name)
    }

    /// This section and all below it, in the order of a file.
    pub fn all(&'static self) -> Vec<&'static Self> {
        let below = self.keys.iter().filter_map(|key| key.kind.section());
        let below = below.flat_map(Self::all);
        std::iter::once(self).chain(below).collect()
    }
}

impl Kind {
    /// The keys of the table that the value is.
    pub fn section(&self) -> Option<&'static Section> {
        match self {
            Self::Table(section) | Self::Tables(section) => Some(section),
            _ => None,
        }
    }
}

/// A word that stands for a value.
pub struct Word<T: 'static> {
    pub word: &'static str,
    pub value: T,
    /// What it stands for; empty where the word says it.
    pub meaning: &'static str,
}

/// A type whose values are written as words.
pub trait Choice: Copy + 'static {
    /// Every word.
    const WORDS: &'static [Word<Self>];

    /// The words and their meanings.
    fn listed() -> Vec<(&'static str, &'static str)> {
        let words = Self::WORDS.iter();
        words.map(|word| (word.word, word.meaning)).collect()
    }

    /// As the value is written.
    fn quoted(self) -> String
    where
        Self: PartialEq,
    {
        let word = Self::WORDS.iter().find(|word| word.value == self);
        word.map(|word| format!("{:?}", word.word))
            .unwrap_or_default()
    }
}

impl<T: Copy> Word<T> {
    /// A word with its meaning.
    pub const fn new(word: &'static str, value: T, meaning: &'static str) -> Self {
        Self {
            word,
            value,
            meaning,
        }
    }
}
