//! Kinds of values and their limits in words: messages and the reference say the same.

use super::key::{Kind, Limit, Need};

/// Each in quotes.
pub(super) fn quoted(words: &[(&str, &str)]) -> Vec<String> {
    words.iter().map(|(word, _)| format!("{word:?}")).collect()
}

/// `a`, `a or b`, `a, b or c`.
pub(super) fn either(parts: &[String]) -> String {
    match parts.split_last() {
        Some((last, others @ [_, ..])) => format!("{} or {last}", others.join(", ")),
        _ => parts.concat(),
    }
}

impl Kind {
    /// Such as "a number".
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Text => "a string".to_owned(),
            Self::Flag => "true or false".to_owned(),
            Self::Number => "a number".to_owned(),
            Self::Whole => "a whole number".to_owned(),
            Self::Numbers(count) => format!("an array of {count} numbers"),
            Self::List(item, count) => {
                let comma = if count.is_empty() { "" } else { ", " };
                match item {
                    Self::Number => format!("an array of numbers{comma}{count}"),
                    Self::OneOf(_) => format!("an array {count}, each {}", item.describe()),
                    item => format!("an array of {}{comma}{count}", item.describe()),
                }
            }
            Self::Words(listed) => either(&quoted(&listed())),
            Self::OneOf(kinds) => {
                let parts = kinds.iter().flat_map(|kind| match kind {
                    Self::Words(listed) => quoted(&listed()),
                    kind => vec![kind.describe()],
                });
                either(&parts.collect::<Vec<_>>())
            }
            Self::Table(_) => "a table".to_owned(),
            Self::Tables(section) => {
                format!("a list of tables, each under its own {}", section.header)
            }
        }
    }

    /// What the value may be instead of one of `words`.
    pub(super) fn besides(&self, words: &[(&str, &str)]) -> Vec<String> {
        let Self::OneOf(kinds) = self else {
            return Vec::new();
        };
        let are_words = |kind: &&Self| matches!(kind, Self::Words(listed) if listed() == words);
        // An item of a list has words of its own, and nothing besides.
        if !kinds.iter().any(|kind| are_words(&kind)) {
            return Vec::new();
        }
        let others = kinds.iter().filter(|kind| !are_words(kind));
        others.map(Self::describe).collect()
    }

    /// Words with a meaning, of this kind and those in it.
    pub(super) fn explained_words(&self) -> Vec<(&'static str, &'static str)> {
        let mut words = match self {
            Self::Words(listed) => listed(),
            Self::List(item, _) => item.explained_words(),
            Self::OneOf(kinds) => kinds.iter().flat_map(Self::explained_words).collect(),
            _ => Vec::new(),
        };
        words.retain(|(_, meaning)| !meaning.is_empty());
        words
    }
}

impl Limit {
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Within(bound) => bound.describe_shortly(),
            Self::Count(most) => format!("1 to {most}"),
            Self::Said(words) => words(),
        }
    }
}

impl Need {
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Required => "required".to_owned(),
            Self::Default(value) => format!("default {}", value()),
            Self::Optional(absence) => format!("optional: without it {absence}"),
            Self::With(line) => format!("required with `{line}`, and only there"),
        }
    }
}
