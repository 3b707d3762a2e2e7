//! [`Value`]: one value of a table or an array, read as what it should be.

use std::ops::Range;

use toml::de::DeValue;

use super::amend::amend;
use super::describe::{either, quoted};
use super::key::{Choice, Key, Section};
use super::{Fields, closest};
use crate::diagnostics::{Diagnostic, Sink};

/// A value, the bytes of the text where it stands, and what messages call it.
#[derive(Clone, Debug)]
pub struct Located<T> {
    pub value: T,
    pub span: Range<usize>,
    pub name: String,
}

impl<T> Located<T> {
    /// The place alone.
    pub fn place(&self) -> Located<()> {
        Located {
            value: (),
            span: self.span.clone(),
            name: self.name.clone(),
        }
    }

    /// Another value from the same place.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Located<U> {
        Located {
            value: f(self.value),
            span: self.span,
            name: self.name,
        }
    }
}

/// One value of a table or an array.
#[derive(Clone)]
pub struct Value<'t> {
    pub(super) value: &'t DeValue<'t>,
    pub(super) span: Range<usize>,
    pub(super) name: String,
    pub(super) key: &'static Key,
    pub(super) root: &'static Section,
    pub(super) sink: &'t Sink,
}

impl<'t> Value<'t> {
    /// A finite number, written as an integer or a float.
    pub fn number(self) -> Option<Located<f64>> {
        let parsed = match self.value {
            DeValue::Integer(integer) => {
                // Beyond 128 bits a number is absurd anywhere; infinity says so below.
                i128::from_str_radix(integer.as_str(), integer.radix())
                    .map_or(f64::INFINITY, |number| number as f64)
            }
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            DeValue::String(string) if string.trim().parse::<f64>().is_ok() => {
                let help = format!("write it without quotes: {}", string.trim());
                return self.mismatch("a number", help);
            }
            DeValue::String(string) => {
                let help = amend(string).map_or_else(|| self.written(), |amendment| amendment.help);
                return self.mismatch("a number", help);
            }
            _ => return self.expected("a number"),
        };
        if parsed.is_finite() {
            return Some(self.located(parsed));
        }
        let message = format!("{} is not a finite number", self.name);
        self.error(
            message,
            "not finite",
            "write a finite number, or leave an optional key out",
        )
    }

    /// `K` items that should be finite numbers; those that are not have been reported.
    pub fn numbers<const K: usize>(self) -> Option<[Option<Located<f64>>; K]> {
        let items = self.clone().items(&format!("an array of {K} numbers"))?;
        let numbers: Vec<_> = items.into_iter().map(Value::number).collect();
        numbers
            .try_into()
            .or_else(|numbers: Vec<_>| {
                let count = numbers.len();
                let message = format!("{} must have {K} numbers, not {count}", self.name);
                let mut help = self.written();
                if count == 2 * K {
                    help += "; a decimal point is a point, not a comma";
                }
                self.error(message, format!("{count} here"), help).ok_or(())
            })
            .ok()
    }

    /// Any number of items that should be finite numbers; those that are not have been reported.
    pub fn list_of_numbers(self) -> Option<Located<Vec<Option<Located<f64>>>>> {
        let place = self.location();
        let items = self.items("an array of numbers")?;
        Some(place.map(|()| items.into_iter().map(Value::number).collect()))
    }

    /// A whole number that is not negative, such as a count.
    pub fn whole_number(self) -> Option<Located<u64>> {
        match self.value {
            DeValue::Integer(integer) => {
                let parsed = i128::from_str_radix(integer.as_str(), integer.radix());
                match parsed.ok().and_then(|number| u64::try_from(number).ok()) {
                    Some(number) => Some(self.located(number)),
                    None => {
                        let message = format!("{} is out of bounds", self.name);
                        self.error(message, "must be within 0 to 2^64 - 1", "write a count")
                    }
                }
            }
            _ => self.expected("a whole number"),
        }
    }

    /// A string on one line, without characters that a terminal would obey.
    pub fn string(self) -> Option<Located<&'t str>> {
        match self.value {
            DeValue::String(string) if string.chars().any(char::is_control) => {
                let message = format!("{} has a control character in it", self.name);
                self.error(message, "not plain text", "write plain text on one line")
            }
            DeValue::String(string) => Some(self.located(string.as_ref())),
            _ => self.expected("a string"),
        }
    }

    /// One of the words that stand for a `T`.
    pub fn choice<T: Choice>(self) -> Option<Located<T>> {
        let word = self.clone().string()?.value;
        if let Some(chosen) = T::WORDS.iter().find(|choice| choice.word == word) {
            return Some(self.located(chosen.value));
        }
        let words = T::listed();
        let mut parts = quoted(&words);
        parts.extend(self.key.kind.besides(&words));
        let expected = either(&parts);
        let help = match closest(word, words.iter().map(|(word, _)| *word)) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("write {expected}"),
        };
        let message = format!("{} cannot be {word:?}", self.name);
        self.error(message, format!("expected {expected}"), help)
    }

    /// `true` or `false`.
    pub fn flag(self) -> Option<Located<bool>> {
        match self.value {
            DeValue::Boolean(flag) => Some(self.located(*flag)),
            _ => self.expected("true or false"),
        }
    }

    /// The items of an array; `expected` names it in the message.
    pub fn items(self, expected: &str) -> Option<Vec<Value<'t>>> {
        let DeValue::Array(array) = self.value else {
            return self.expected(expected);
        };
        let item = |(i, value): (usize, &'t toml::Spanned<DeValue<'t>>)| Value {
            value: value.get_ref(),
            span: value.span(),
            name: format!("item {} of {}", i + 1, self.name),
            ..self
        };
        Some(array.iter().enumerate().map(item).collect())
    }

    /// The keys of a table, which messages call `owner`.
    pub fn table<T>(self, owner: &str, fields: impl FnOnce(&mut Fields<'t>) -> T) -> Option<T> {
        match self.value {
            DeValue::Table(table) => {
                let section = self.key.kind.section()?;
                let keys = Fields::new(table, section, self.root, self.sink, self.span, owner);
                Some(keys.read(fields))
            }
            _ => self.expected("a table"),
        }
    }

    /// Tables under a common heading, in order; messages call each by `owner` of its number, from 1. `None` if one is no table.
    pub fn tables<T>(
        rows: Vec<Self>,
        owner: impl Fn(usize) -> String,
        fields: impl Fn(&mut Fields<'t>, &str) -> T,
    ) -> Option<Vec<T>> {
        let read = (1..).zip(rows).map(|(number, row)| {
            let owner = owner(number);
            row.table(&owner, |row| fields(row, &owner))
        });
        // Each is read before the first that is none ends the reading.
        read.collect::<Vec<_>>().into_iter().collect()
    }

    /// What a table has under `key`, if that is a string; nothing is reported.
    pub fn word_of(&self, key: &Key) -> Option<&'t str> {
        self.value.get(key.name)?.get_ref().as_str()
    }

    /// Whether the value is a string.
    pub fn is_string(&self) -> bool {
        self.value.is_str()
    }

    /// Whether the value is an array.
    pub fn is_array(&self) -> bool {
        self.value.is_array()
    }

    /// The value's place and name.
    pub fn location(&self) -> Located<()> {
        self.clone().located(())
    }

    fn located<T>(self, value: T) -> Located<T> {
        Located {
            value,
            span: self.span,
            name: self.name,
        }
    }

    fn written(&self) -> String {
        format!("write {}", self.key.write)
    }

    fn expected<T>(self, expected: &str) -> Option<T> {
        let help = self.written();
        self.mismatch(expected, help)
    }

    fn mismatch<T>(self, expected: &str, help: String) -> Option<T> {
        let found = match self.value.type_str() {
            found @ ("integer" | "array") => format!("an {found}"),
            found => format!("a {found}"),
        };
        let message = format!("{} must be {expected}, not {found}", self.name);
        self.error(message, format!("expected {expected}"), help)
    }

    fn error<T>(
        self,
        message: String,
        label: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.sink.push(
            Diagnostic::error(self.span, message)
                .label(label)
                .help(help),
        );
        None
    }
}
