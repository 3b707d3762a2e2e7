//! What is legal in a table and rarely meant: [`Lint`], a rule each.
//!
//! A table without an error is a [`Model`](crate::Model). The rules look at that model and at where its numbers stand in the text;
//! what they find is a warning at every door, unless the table's `allow` names the lint.
//!
//! What is usual was taken from some 300 chains in public robot descriptions: thresholds stand beyond all of them that are not
//! placeholders or slips themselves. A rule compares with the arm's own size, never with a robot that it knows.

mod angle_unit;
mod body;
mod extent;
mod far_centroid;
mod gravity;
mod heavy_link;
mod inertia_about_origin;
mod inertia_across;
mod inertia_size;
mod names;
mod other_convention;
mod places;
mod subject;

pub use names::Lint;
pub(crate) use places::Places;

use crate::Model;
use crate::diagnostics::{Diagnostic, Sink};
use subject::Subject;

/// What a lint finds in a table.
type Rule = fn(&Subject<'_>) -> Vec<Diagnostic>;

/// The rule of a lint whose finding is said where it comes up: while angles are read, or by the generator.
fn found_elsewhere(_: &Subject<'_>) -> Vec<Diagnostic> {
    Vec::new()
}

/// Warns of everything in `model` that is rarely meant. The numbers of the table stand at `places`.
pub(crate) fn examine(model: &Model, places: &Places, sink: &Sink) {
    let subject = Subject::new(model, places);
    for lint in Lint::ALL {
        if model.allows(*lint) {
            continue;
        }
        for found in lint.rule()(&subject) {
            sink.push(found.lint(lint.name()));
        }
    }
}

/// A length, a radius or a ratio as messages give it: three digits.
fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let digits = 2 - number.abs().log10().floor() as i32;
    if !(-2..=6).contains(&digits) {
        return format!("{number:.1e}");
    }
    let text = format!("{number:.*}", usize::try_from(digits).unwrap_or(0));
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        for (number, text) in [
            (0.0, "0"),
            (0.4321, "0.432"),
            (25.0, "25"),
            (1234.5, "1234"),
            (1.0, "1"),
            (0.000_012, "1.2e-5"),
            (-0.50, "-0.5"),
            (538_038.0, "5.4e5"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}
