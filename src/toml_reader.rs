//! Reading of a TOML text field by field: every wrong, missing or unknown key is reported, none stops the reading.
//!
//! A value that is wrong has been reported to the [`Sink`] by the time it is `None` here; readers only pass that on.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use crate::diagnostics::{Diagnostic, Diagnostics, Sink};

/// A value, the bytes of the text where it stands, and what messages call it.
#[derive(Clone, Debug)]
pub(crate) struct Located<T> {
    pub(crate) value: T,
    pub(crate) span: Range<usize>,
    pub(crate) name: String,
}

/// The text of the file at `path`, which may have `max_bytes`.
pub(crate) fn read_file(path: &Path, max_bytes: u64) -> Result<String, Diagnostics> {
    let name = path.display().to_string();
    let refuse = |message: String, help: Option<String>| {
        let error = Diagnostic::file_error(message);
        let error = help.into_iter().fold(error, Diagnostic::help);
        Diagnostics::of_file(&name, error)
    };
    if path.is_dir() {
        let help = format!("name a file in it, for example {name}/my_arm.toml");
        return Err(refuse(
            "this is a directory, not a file".to_owned(),
            Some(help),
        ));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(max_bytes + 1).read_to_end(&mut bytes))
        .map_err(|error| {
            let help = similar_file(path)
                .map(|path| format!("did you mean {}?", path.display()))
                .or_else(|| {
                    let here = std::env::current_dir()
                        .ok()
                        .filter(|_| path.is_relative())?;
                    Some(format!("the path starts in {}", here.display()))
                });
            refuse(format!("cannot read the file: {error}"), help)
        })?;
    if bytes.len() as u64 > max_bytes {
        let message = format!("the file is larger than {} KiB", max_bytes / 1024);
        let help = "an arm's table or a scenario is far smaller".to_owned();
        return Err(refuse(message, Some(help)));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let sink = Sink::new(&name, &text);
        let replacement = valid..valid + char::REPLACEMENT_CHARACTER.len_utf8();
        sink.push(
            Diagnostic::error(replacement, "the file is not UTF-8")
                .label("not a character")
                .help("save the file with the encoding UTF-8"),
        );
        sink.finish()
    })
}

/// The file beside `path` whose name is closest to its.
fn similar_file(path: &Path) -> Option<PathBuf> {
    let folder = match path.parent()? {
        here if here.as_os_str().is_empty() => Path::new("."),
        folder => folder,
    };
    let entries = folder.read_dir().ok()?.filter_map(Result::ok);
    let mut names: Vec<_> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    // A folder lists its files in no particular order.
    names.sort_unstable();
    let meant = closest(path.file_name()?.to_str()?, &names)?;
    Some(path.with_file_name(meant))
}

/// Reads `text` with `fields`. `None` if it is no TOML, with all syntax errors in the sink.
pub(crate) fn read<T>(
    text: &str,
    sink: &Sink,
    fields: impl FnOnce(&mut Fields<'_>) -> T,
) -> Option<T> {
    let (root, faults) = DeTable::parse_recoverable(text);
    if faults.is_empty() {
        // The text's first key: where a missing one of the top level belongs, before any [table].
        let first = root.get_ref().keys().map(toml::Spanned::span);
        let start = first.map(|span| span.start).min().unwrap_or(0);
        let first_line = start..start;
        return Some(Fields::read(root.get_ref(), sink, first_line, "", fields));
    }
    report_syntax(text, faults, sink);
    None
}

/// Reports one syntax error for each line, up to where the text has lost its shape.
fn report_syntax(text: &str, mut faults: Vec<toml::de::Error>, sink: &Sink) {
    let span = |fault: &toml::de::Error| fault.span().unwrap_or(0..0);
    // The parser runs in several passes over the text, each with its own errors.
    faults.sort_by_key(|fault| span(fault).start);
    let mut last_line = None;
    for fault in &faults {
        let span = span(fault);
        let line = sink.line(&span);
        // What follows on the same line is mostly the first error's echo.
        if last_line.replace(line.as_ptr()) == Some(line.as_ptr()) {
            continue;
        }
        let (message, expected) = fault
            .message()
            .split_once(", expected ")
            .filter(|(_, expected)| *expected != "nothing")
            .map_or((fault.message(), None), |(message, expected)| {
                (message, Some(expected))
            });
        let message = message.trim_end_matches(", expected nothing");
        let duplicate = message == "duplicate key";
        // A line that is sound by itself suffers from an array, table or string that was opened before it
        // and not closed. So do all lines after it: they would only bury the one that matters.
        let unclosed = !duplicate && span.end < text.len() && DeTable::parse(line).is_ok();
        let mut diagnostic = Diagnostic::error(span, format!("not TOML: {message}"));
        if let Some(expected) = expected {
            diagnostic = diagnostic.label(format!("expected {expected}"));
        }
        if unclosed {
            diagnostic = diagnostic.help("close the bracket or quote that was opened above");
        } else if duplicate {
            diagnostic = diagnostic.help("write each key once; `[[joint]]` begins a new joint");
        }
        sink.push(diagnostic);
        if unclosed {
            return;
        }
    }
}

/// The keys of one table.
pub(crate) struct Fields<'t> {
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
    pub(crate) fn required(
        &mut self,
        key: &'static str,
        example: &'static str,
    ) -> Option<Value<'t>> {
        let value = self.optional(key, example);
        if value.is_none() {
            self.missing.push((key, example));
        }
        value
    }

    /// The value of `key`, if the table has it.
    pub(crate) fn optional(
        &mut self,
        key: &'static str,
        example: &'static str,
    ) -> Option<Value<'t>> {
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

/// One value of a table or an array.
#[derive(Clone)]
pub(crate) struct Value<'t> {
    value: &'t DeValue<'t>,
    span: Range<usize>,
    name: String,
    example: &'static str,
    sink: &'t Sink,
}

impl<'t> Value<'t> {
    /// A finite number, written as an integer or a float.
    pub(crate) fn number(self) -> Option<Located<f64>> {
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
    pub(crate) fn numbers<const K: usize>(self) -> Option<[Option<Located<f64>>; K]> {
        let items = self.clone().items(&format!("an array of {K} numbers"))?;
        let numbers: Vec<_> = items.into_iter().map(Value::number).collect();
        numbers
            .try_into()
            .or_else(|numbers: Vec<_>| {
                let count = numbers.len();
                let message = format!("{} must have {K} numbers, not {count}", self.name);
                let help = format!("write `{}`", self.example);
                self.error(message, format!("{count} here"), help).ok_or(())
            })
            .ok()
    }

    /// A string.
    pub(crate) fn string(self) -> Option<Located<&'t str>> {
        match self.value {
            DeValue::String(string) => Some(self.located(string.as_ref())),
            _ => self.expected("a string"),
        }
    }

    /// One of the words in `choices`.
    pub(crate) fn choice<T: Copy>(self, choices: &[(&'static str, T)]) -> Option<Located<T>> {
        let word = self.clone().string()?.value;
        if let Some((_, chosen)) = choices.iter().find(|(choice, _)| *choice == word) {
            return Some(self.located(*chosen));
        }
        let quoted: Vec<_> = choices
            .iter()
            .map(|(word, _)| format!("{word:?}"))
            .collect();
        let quoted = match quoted.split_last() {
            Some((last, others @ [_, ..])) => format!("{} or {last}", others.join(", ")),
            _ => quoted.concat(),
        };
        let help = match closest(word, choices.iter().map(|(word, _)| word)) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("write {quoted}"),
        };
        let message = format!("{} cannot be {word:?}", self.name);
        self.error(message, format!("expected {quoted}"), help)
    }

    /// The items of an array; `expected` names it in the message.
    pub(crate) fn items(self, expected: &str) -> Option<Vec<Value<'t>>> {
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
    pub(crate) fn table<T>(
        self,
        owner: &str,
        fields: impl FnOnce(&mut Fields<'t>) -> T,
    ) -> Option<T> {
        match self.value {
            DeValue::Table(table) => Some(Fields::read(table, self.sink, self.span, owner, fields)),
            _ => self.expected("a table"),
        }
    }

    /// Whether the value is a string.
    pub(crate) fn is_string(&self) -> bool {
        self.value.is_str()
    }

    /// The value's place and name.
    pub(crate) fn location(&self) -> Located<()> {
        self.clone().located(())
    }

    fn located<T>(self, value: T) -> Located<T> {
        Located {
            value,
            span: self.span,
            name: self.name,
        }
    }

    fn expected<T>(self, expected: &str) -> Option<T> {
        let help = format!("write `{}`", self.example);
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

/// The word of `words` that `misspelt` most likely stands for.
pub(crate) fn closest<'w, W: AsRef<str> + ?Sized + 'w>(
    misspelt: &str,
    words: impl IntoIterator<Item = &'w W>,
) -> Option<&'w W> {
    let misspelt = misspelt.to_lowercase();
    words
        .into_iter()
        .map(|word| (strsim::damerau_levenshtein(&misspelt, word.as_ref()), word))
        .filter(|(distance, word)| *distance <= 1.max(word.as_ref().chars().count() / 3))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
}
