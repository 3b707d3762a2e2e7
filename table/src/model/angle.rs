//! [`Angles`]: a table's angles, in radians and within a full turn.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::diagnostics::{Diagnostic, Sink};
use crate::lint::Lint;
use crate::table::{AngleUnit, Author};
use crate::toml_reader::Located;
use ulna::Angle;

/// How a table's angles are written.
#[derive(Clone, Copy)]
pub(super) struct Angles {
    pub(super) unit: AngleUnit,
    pub(super) author: Author,
}

impl Angles {
    /// The angle in radians, at most one turn either way.
    pub(super) fn admit(self, number: &Located<f64>, sink: &Sink) -> Option<Angle> {
        let value = number.value;
        let (turn, quarter, help) = match (self.unit, self.author) {
            (AngleUnit::Degrees, _) => (360.0, 90.0, "write an angle within a full turn"),
            (AngleUnit::Radians, Author::Person) => (
                TAU,
                FRAC_PI_2,
                "if angles are in degrees, write `angle_unit = \"deg\"`",
            ),
            (AngleUnit::Radians, Author::Program) => {
                (TAU, FRAC_PI_2, "give angles in radians, within a full turn")
            }
        };
        // A little over one turn is rounding.
        if value.abs() > turn * (1.0 + 1e-9) {
            let message = format!("{} is more than a full turn", number.name);
            sink.push(
                Diagnostic::error(number.span.clone(), message)
                    .label(format!("must be within -{turn} to {turn}"))
                    .help(help),
            );
            return None;
        }
        let quarters = (value / quarter).round();
        let degrees = self.unit == AngleUnit::Degrees;
        if degrees && value == quarters * quarter {
            return Some(Angle::from_radians(quarters * FRAC_PI_2));
        }
        let radians = if degrees { value.to_radians() } else { value };
        let exact = Angle::from_radians(radians).quarter_turns().1 == 0.0;
        if !exact && let Some(multiple) = rounded_quarter(value) {
            let (lint, message, help) = if degrees {
                (
                    Lint::OtherAngleUnit,
                    "looks like an angle in radians",
                    "if angles are in rad, write `angle_unit = \"rad\"`".to_owned(),
                )
            } else {
                (
                    Lint::RoundedAngle,
                    "is a rounded quarter turn, which stays inexact",
                    format!("write {multiple:?}"),
                )
            };
            let message = format!("{} {message}", number.name);
            let warning = Diagnostic::warning(number.span.clone(), message).help(help);
            sink.push(warning.lint(lint.name()));
        }
        Some(Angle::from_radians(radians))
    }
}

/// The multiple of π/2 that `value` is a decimal rounding of, such as 1.5708 or -3.14.
fn rounded_quarter(value: f64) -> Option<f64> {
    let multiple = (value / FRAC_PI_2).round() * FRAC_PI_2;
    let rounds = |digits: i32| {
        let scale = 10_f64.powi(digits);
        (multiple * scale).round() / scale == value
    };
    (multiple != 0.0 && (2..=14).any(rounds)).then_some(multiple)
}
