//! Reading of a TOML text field by field: every wrong, missing or unknown key is reported, none stops the reading.
//!
//! A value that is wrong has been reported to the [`Sink`] by the time it is `None` here; readers only pass that on.

mod bound;
mod file;
mod syntax;
mod value;

pub use bound::Bound;
pub use file::read_file;
pub use value::{Located, Value};

use std::ops::Range;

use toml::de::DeTable;

use crate::diagnostics::{Diagnostic, Sink};

/// Reads `text` with `fields`. `None` if it is no TOML, with all syntax errors in the sink.
pub fn read<T>(text: &str, sink: &Sink, fields: impl FnOnce(&mut Fields<'_>) -> T) -> Option<T> {
    let (root, faults) = DeTable::parse_recoverable(text);
    if faults.is_empty() {
        // The text's first key: where a missing one of the top level belongs, before any [table].
        let first = root.get_ref().keys().map(toml::Spanned::span);
        let start = first.map(|span| span.start).min().unwrap_or(0);
        let first_line = start..start;
        return Some(Fields::read(root.get_ref(), sink, first_line, "", fields));
    }
    syntax::report(text, faults, sink);
    None
}

/// The keys of one table.
pub struct Fields<'t> {
    entries: &'t DeTable<'t>,
    sink: &'t Sink,
    header: Range<usize>,
    owner: String,
    known: Vec<&'static str>,
    missing: Vec<(&'static str, &'static str)>,
}

impl<'t> Fields<'t> {
    /// Lets `reader` ask for keys, then reports those that are missing and those that it did not ask for.
    fn read<T>(
        entries: &'t DeTable<'t>,
        sink: &'t Sink,
        header: Range<usize>,
        owner: &str,
        reader: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let mut fields = Self {
            entries,
            sink,
            header,
            owner: owner.to_owned(),
            known: Vec::new(),
            missing: Vec::new(),
        };
        let read = reader(&mut fields);
        fields.report_keys();
        read
    }

    /// The value of `key`; reported as missing where there is none. `example` is what to write.
    pub fn required(&mut self, key: &'static str, example: &'static str) -> Option<Value<'t>> {
        let value = self.optional(key, example);
        if value.is_none() {
            self.missing.push((key, example));
        }
        value
    }

    /// The value of `key`, if the table has it.
    pub fn optional(&mut self, key: &'static str, example: &'static str) -> Option<Value<'t>> {
        self.known.push(key);
        let value = self.entries.get(key)?;
        Some(Value {
            value: value.get_ref(),
            span: value.span(),
            name: format!("`{key}`{}", self.of_owner()),
            example,
            sink: self.sink,
        })
    }

    fn of_owner(&self) -> String {
        if self.owner.is_empty() {
            String::new()
        } else {
            format!(" of {}", self.owner)
        }
    }

    fn report_keys(mut self) {
        let of_owner = self.of_owner();
        for key in self.entries.keys() {
            let name = key.get_ref().as_ref();
            if self.known.contains(&name) {
                continue;
            }
            let absent = |known: &&&str| !self.entries.contains_key(**known);
            let meant = closest(name, self.known.iter().filter(absent).copied());
            let help = match meant {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("known keys: {}", self.known.join(", ")),
            };
            // A misspelt key is one mistake, not an unknown key and a missing one.
            self.missing.retain(|(missing, _)| Some(*missing) != meant);
            let message = format!("unknown key `{}`{of_owner}", name.escape_debug());
            self.sink.push(
                Diagnostic::error(key.span(), message)
                    .label("unknown key")
                    .help(help),
            );
        }
        for (key, example) in self.missing {
            let message = format!("missing key `{key}`{of_owner}");
            self.sink.push(
                Diagnostic::error(self.header.clone(), message)
                    .label(format!("`{key}` is missing here"))
                    .help(format!("write `{example}`")),
            );
        }
    }
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
