//! [`Fields`]: the keys of one table, and what is said of those that are missing or unknown.

use std::ops::Range;
use std::ptr;

use toml::de::DeTable;

use super::closest;
use super::describe::either;
use super::key::{Key, Need, Section};
use super::value::Value;
use crate::diagnostics::{Diagnostic, Sink};

/// The keys of one table.
pub struct Fields<'t> {
    entries: &'t DeTable<'t>,
    section: &'static Section,
    root: &'static Section,
    sink: &'t Sink,
    header: Range<usize>,
    owner: String,
    known: Vec<&'static Key>,
    /// Those that belong to another variant of the table.
    left: Vec<&'static Key>,
    missing: Vec<&'static Key>,
}

impl<'t> Fields<'t> {
    /// Those of `entries`, which should be the keys of `section` in a file of the format `root`.
    pub(super) fn new(
        entries: &'t DeTable<'t>,
        section: &'static Section,
        root: &'static Section,
        sink: &'t Sink,
        header: Range<usize>,
        owner: &str,
    ) -> Self {
        Self {
            entries,
            section,
            root,
            sink,
            header,
            owner: owner.to_owned(),
            known: Vec::new(),
            left: Vec::new(),
            missing: Vec::new(),
        }
    }

    /// Lets `reader` ask for keys, then reports those that are missing and those that it did not ask for.
    pub(super) fn read<T>(mut self, reader: impl FnOnce(&mut Self) -> T) -> T {
        let read = reader(&mut self);
        self.report_keys();
        read
    }

    /// The value of `key`; reported as missing where there is none and must be one.
    pub fn value(&mut self, key: &'static Key) -> Option<Value<'t>> {
        self.known.push(key);
        let Some(value) = self.entries.get(key.name) else {
            if matches!(key.need, Need::Required | Need::With(_)) {
                self.missing.push(key);
            }
            return None;
        };
        Some(Value {
            value: value.get_ref(),
            span: value.span(),
            name: format!("`{}`{}", key.name, self.of_owner()),
            key,
            root: self.root,
            sink: self.sink,
        })
    }

    /// The value of `key` where the table is of the variant that has it; elsewhere the key is unknown.
    pub fn value_if(&mut self, key: &'static Key, applies: bool) -> Option<Value<'t>> {
        if applies {
            return self.value(key);
        }
        self.left.push(key);
        None
    }

    /// Lets `key` be there or not: the variant of the table is not known.
    pub fn permit(&mut self, key: &'static Key) {
        self.known.push(key);
    }

    fn of_owner(&self) -> String {
        if self.owner.is_empty() {
            String::new()
        } else {
            format!(" of {}", self.owner)
        }
    }

    fn report_keys(mut self) {
        self.assert_all_asked();
        let of_owner = self.of_owner();
        for key in self.entries.keys() {
            let name = key.get_ref().as_ref();
            if self.known.iter().any(|known| known.name == name) {
                continue;
            }
            let names = self.known.iter().map(|known| known.name);
            let absent = names
                .clone()
                .filter(|known| !self.entries.contains_key(*known));
            let meant = closest(name, absent);
            // Of one letter or two, every other is a neighbour.
            let present = closest(name, names.clone().filter(|known| known.len() > 2));
            let help = match (meant, present) {
                (Some(meant), _) => format!("did you mean `{meant}`?"),
                (None, Some(meant)) => format!("did you mean `{meant}`, which is there too?"),
                (None, None) => {
                    let names: Vec<_> = names.collect();
                    let elsewhere = self.elsewhere(name);
                    format!("known keys: {}{elsewhere}", names.join(", "))
                }
            };
            // A misspelt key is one mistake, not an unknown key and a missing one.
            self.missing.retain(|missing| Some(missing.name) != meant);
            let message = format!("unknown key `{}`{of_owner}", name.escape_debug());
            self.sink.push(
                Diagnostic::error(key.span(), message)
                    .label("unknown key")
                    .help(help),
            );
        }
        for Key { name, write, .. } in self.missing {
            let message = format!("missing key `{name}`{of_owner}");
            self.sink.push(
                Diagnostic::error(self.header.clone(), message)
                    .label(format!("`{name}` is missing here"))
                    .help(format!("write {write}")),
            );
        }
    }

    /// Where a key that is unknown here would be known.
    fn elsewhere(&mut self, name: &str) -> String {
        if let Some(Key {
            need: Need::With(line),
            ..
        }) = self.left.iter().find(|left| left.name == name)
        {
            return format!("; `{name}` goes with `{line}`");
        }
        let sections = self.root.all().into_iter();
        let places: Vec<_> = sections
            .filter(|section| section.key(name).is_some())
            .collect();
        if let [place] = places[..] {
            // A header that is missing is one mistake, not an unknown key and a missing table.
            let holds = |key: &Key| key.kind.section().is_some_and(|held| ptr::eq(held, place));
            self.missing.retain(|missing| !holds(missing));
        }
        let places: Vec<_> = places
            .iter()
            .map(|section| match section.header {
                "" => "before the first header".to_owned(),
                header => format!("below `{header}`"),
            })
            .collect();
        if places.is_empty() {
            return String::new();
        }
        format!("; `{name}` belongs {}", either(&places))
    }

    /// A reader asks for every key that its section declares, and for no other: whatever test reads a table finds a
    /// reader and a reference that have come apart.
    fn assert_all_asked(&self) {
        let sorted = |keys: &mut dyn Iterator<Item = &&'static Key>| {
            let mut names: Vec<_> = keys.map(|key| key.name).collect();
            names.sort_unstable();
            names
        };
        debug_assert_eq!(
            sorted(&mut self.known.iter().chain(&self.left)),
            sorted(&mut self.section.keys.iter()),
            "asked for, and declared for {:?}",
            self.section.header
        );
    }
}
