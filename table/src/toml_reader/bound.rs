//! [`Bound`]: what a number may be.

use std::ops::RangeInclusive;

use super::Located;
use super::key::{Key, Limit};
use crate::diagnostics::{Diagnostic, Sink};

/// Numbers outside are a slip of the pen or of the unit.
pub struct Bound {
    pub range: RangeInclusive<f64>,
    pub unit: &'static str,
    pub help: &'static str,
}

impl Bound {
    /// Such as "1e-6 to 100.0 kg".
    pub(super) fn describe(&self) -> String {
        let (least, most) = (self.range.start(), self.range.end());
        let range = format!("{least:?} to {most:?} {}", self.unit);
        range.trim_end().to_owned()
    }

    /// The same in few characters, such as "-1e9 to 1e9 kg m^2".
    pub(super) fn describe_shortly(&self) -> String {
        let short = |number: f64| match number.abs() {
            size if size >= 1e5 || (size > 0.0 && size < 1e-2) => format!("{number:e}"),
            _ => format!("{number}"),
        };
        let (least, most) = (short(*self.range.start()), short(*self.range.end()));
        let range = format!("{least} to {most} {}", self.unit);
        range.trim_end().to_owned()
    }

    /// The number, if it is within the bound; reported otherwise.
    pub fn admit(&self, number: &Located<f64>, sink: &Sink) -> Option<f64> {
        if self.range.contains(&number.value) {
            return Some(number.value);
        }
        let range = format!("must be within {}", self.describe());
        let message = format!("{} is out of bounds", number.name);
        sink.push(
            Diagnostic::error(number.span.clone(), message)
                .label(range)
                .help(self.help),
        );
        None
    }

    /// All `numbers`, if none is missing or out of bounds.
    pub fn admit_all(&self, numbers: &[Option<Located<f64>>], sink: &Sink) -> Option<Vec<f64>> {
        all(numbers, |number| self.admit(number, sink))
    }
}

impl Key {
    /// The number, if it is within all bounds of the key; reported otherwise.
    pub fn admit(&self, number: &Located<f64>, sink: &Sink) -> Option<f64> {
        for limit in self.limits {
            if let Limit::Within(bound) = limit {
                bound.admit(number, sink)?;
            }
        }
        Some(number.value)
    }

    /// All `numbers`, if none is missing or out of the key's bounds.
    pub fn admit_all(&self, numbers: &[Option<Located<f64>>], sink: &Sink) -> Option<Vec<f64>> {
        all(numbers, |number| self.admit(number, sink))
    }
}

/// All `numbers`, if none is missing or refused. Each is looked at before the first fault ends the reading.
fn all(
    numbers: &[Option<Located<f64>>],
    admit: impl Fn(&Located<f64>) -> Option<f64>,
) -> Option<Vec<f64>> {
    let admitted = numbers.iter().map(|number| admit(number.as_ref()?));
    admitted.collect::<Vec<_>>().into_iter().collect()
}
