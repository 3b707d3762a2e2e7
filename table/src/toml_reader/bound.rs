//! [`Bound`]: what a number may be.

use std::ops::RangeInclusive;

use super::Located;
use crate::diagnostics::{Diagnostic, Sink};

/// Numbers outside are a slip of the pen or of the unit.
pub struct Bound {
    pub range: RangeInclusive<f64>,
    pub unit: &'static str,
    pub help: &'static str,
}

impl Bound {
    /// The number, if it is within the bound; reported otherwise.
    pub fn admit(&self, number: &Located<f64>, sink: &Sink) -> Option<f64> {
        if self.range.contains(&number.value) {
            return Some(number.value);
        }
        let (least, most) = (self.range.start(), self.range.end());
        let range = format!("must be within {least:?} to {most:?} {}", self.unit);
        let message = format!("{} is out of bounds", number.name);
        sink.push(
            Diagnostic::error(number.span.clone(), message)
                .label(range.trim_end())
                .help(self.help),
        );
        None
    }

    /// All `numbers`, if none is missing or out of bounds.
    pub fn admit_all(&self, numbers: &[Option<Located<f64>>], sink: &Sink) -> Option<Vec<f64>> {
        let admitted = numbers
            .iter()
            .map(|number| self.admit(number.as_ref()?, sink));
        // Each is looked at before the first fault ends the reading.
        admitted.collect::<Vec<_>>().into_iter().collect()
    }
}
