//! The reference of a format, printed from the keys that its reader asks for: Markdown that can be read as it is.

use std::fmt::Write;

use super::key::{Key, Kind, Section};

/// The reference of the format whose keys before the first header are `root`. `introduction` stands before it.
pub fn reference(introduction: &str, root: &'static Section) -> String {
    let mut text = introduction.trim().to_owned() + "\n";
    let sections = root.all();
    for section in &sections {
        write_section(&mut text, section);
    }
    let _ = write!(text, "\n## A whole file\n\n```toml\n{}```\n", example(root));
    text
}

/// A file in which every section is written out, in order.
fn example(root: &'static Section) -> String {
    let sections = root.all();
    let examples = sections.iter().map(|section| section.example);
    let examples: Vec<_> = examples.filter(|example| !example.is_empty()).collect();
    examples.join("\n")
}

fn write_section(text: &mut String, section: &Section) {
    let title = match section.header {
        "" => "Before the first header".to_owned(),
        header => format!("`{header}`"),
    };
    let _ = write!(text, "\n## {title}\n\n{}.\n\n", section.meaning);
    for key in section.keys {
        write_key(text, key);
    }
}

fn write_key(text: &mut String, key: &Key) {
    let Key {
        name,
        kind,
        need,
        limits,
        meaning,
        ..
    } = key;
    // What a table holds is told under its own header.
    let what = match kind {
        Kind::Table(section) | Kind::Tables(section) => format!("`{}`", section.header),
        kind => kind.describe(),
    };
    let limits: String = limits
        .iter()
        .map(|limit| format!("; {}", limit.describe()))
        .collect();
    let _ = writeln!(
        text,
        "- `{name}`: {what}{limits}; {}.\n  {meaning}.",
        need.describe()
    );
    for (word, meaning) in kind.explained_words() {
        let _ = writeln!(text, "  - {word:?}: {meaning}.");
    }
}
