//! What joints are called: by the table, or by their numbers.

use crate::diagnostics::{Diagnostic, Sink};
use crate::table::JointTable;

/// Longest name, in characters.
const MAX_LENGTH: usize = 64;

/// What a joint is called that has no name: no name that a table can give.
pub(super) fn numbered(index: usize) -> String {
    format!("joint {}", index + 1)
}

/// A joint as messages call it: by its number and, where it has one, its name.
pub(crate) fn called(index: usize, name: Option<&str>) -> String {
    let number = numbered(index);
    match name {
        Some(name) if name != number => format!("{number} ({name})"),
        _ => number,
    }
}

/// Whether `name` can name a joint: a word that is an identifier in most languages.
pub(crate) fn is_word(name: &str) -> bool {
    name.len() <= MAX_LENGTH
        && name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// `name`, if a joint can be called so, or else a word close to it.
pub fn joint_name(name: &str) -> String {
    if is_word(name) {
        name.to_owned()
    } else {
        proposal(name)
    }
}

/// What the joints are called, base first. `None` if something has been reported.
pub(super) fn joint_names(rows: &[JointTable], sink: &Sink) -> Option<Vec<String>> {
    let mut names: Vec<String> = Vec::new();
    let mut sound = true;
    for (index, row) in rows.iter().enumerate() {
        let called = match &row.name {
            None => numbered(index),
            Some(name) => {
                let fault = if !is_word(&name.value) {
                    Some((
                        format!("{} is no word", name.name),
                        format!(
                            "write for example `name = \"{}\"`: {RULE}",
                            proposal(&name.value)
                        ),
                    ))
                } else {
                    let first = names.iter().position(|other| *other == name.value);
                    first.map(|first| {
                        (
                            format!("{} is that of joint {} too", name.name, first + 1),
                            "write a name that no other joint has".to_owned(),
                        )
                    })
                };
                if let Some((message, help)) = fault {
                    sink.push(Diagnostic::error(name.span.clone(), message).help(help));
                    sound = false;
                }
                name.value.clone()
            }
        };
        names.push(called);
    }
    sound.then_some(names)
}

/// What a name may be.
pub(crate) const RULE: &str =
    "a letter first, then letters of ASCII, digits and underscores, at most 64 of them";

/// A word close to `name`.
fn proposal(name: &str) -> String {
    let part = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let word: String = name.trim().chars().map(part).take(MAX_LENGTH / 2).collect();
    let word = word.trim_matches('_');
    let candidates = [word.to_owned(), format!("joint_{word}")];
    let passing = candidates.into_iter().find(|word| is_word(word));
    passing
        .filter(|_| !word.is_empty())
        .unwrap_or_else(|| "shoulder_pan".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_refused_name_has_a_proposal_that_passes() {
        for (name, expected) in [
            ("", "shoulder_pan"),
            ("shoulder pan", "shoulder_pan"),
            ("7", "joint_7"),
            ("joint-1", "joint_1"),
            ("_a", "a"),
            ("\u{e9}", "shoulder_pan"),
        ] {
            assert!(!is_word(name), "{name}");
            assert_eq!(joint_name(name), expected);
            assert!(is_word(expected));
        }
        for name in ["J1", "shoulder_pan", "panda_joint1", "a"] {
            assert_eq!(joint_name(name), name);
        }
        assert!(!is_word(&numbered(3)));
        assert!(!is_word(&"a".repeat(65)));
        assert!(is_word(&proposal(&"-a".repeat(650))));
    }
}
