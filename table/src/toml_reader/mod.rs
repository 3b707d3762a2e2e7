//! Reading of a TOML text field by field: every wrong, missing or unknown key is reported, none stops the reading.
//!
//! A value that is wrong has been reported to the [`Sink`] by the time it is `None` here; readers only pass that on.

mod amend;
mod bound;
mod describe;
mod fields;
mod file;
mod file_kind;
mod headers;
mod key;
mod reference;
mod syntax;
mod value;

pub use bound::Bound;
pub use fields::Fields;
pub use file::read_file;
pub use file_kind::{ARM_TABLE, FileKind, SCENARIO};
pub use key::{Choice, Key, Kind, Limit, Need, Section, Word};
pub use reference::reference;
pub use value::{Located, Value};

use toml::de::DeTable;

use crate::diagnostics::Sink;

/// Reads `text`, of the `kind` whose keys before the first header are `root`, with `fields`.
/// `None` if it is no TOML, with all syntax errors in the sink, or a file of another kind.
pub fn read<T>(
    text: &str,
    kind: &FileKind,
    root: &'static Section,
    sink: &Sink,
    fields: impl FnOnce(&mut Fields<'_>) -> T,
) -> Option<T> {
    let (parsed, faults) = DeTable::parse_recoverable(text);
    if faults.is_empty() {
        // The text's first key: where a missing one of the top level belongs, before any [table].
        let entries = parsed.get_ref();
        if kind.refuses(entries, root, sink) {
            return None;
        }
        let first = entries.keys().map(toml::Spanned::span);
        let start = first.map(|span| span.start).min().unwrap_or(0);
        let first_line = start..start;
        let whole = Fields::new(entries, root, root, sink, first_line, "");
        return Some(whole.read(fields));
    }
    syntax::report(text, root, faults, sink);
    None
}

/// The word of `words` that `misspelt` most likely stands for.
pub fn closest<'w, W: AsRef<str> + ?Sized + 'w>(
    misspelt: &str,
    words: impl IntoIterator<Item = &'w W>,
) -> Option<&'w W> {
    /// Longer words are no slip of the pen, and comparing takes the product of the lengths.
    const LONGEST: usize = 256;
    if misspelt.len() > LONGEST {
        return None;
    }
    let misspelt = misspelt.to_lowercase();
    words
        .into_iter()
        .map(|word| (strsim::damerau_levenshtein(&misspelt, word.as_ref()), word))
        .filter(|(distance, word)| *distance <= 1.max(word.as_ref().chars().count() / 3))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
}
