//! Numbers and strings as TOML has them.

use std::fmt::{self, Write};

use crate::table::AngleUnit;

/// A number in TOML.
#[derive(Clone, Copy)]
pub(super) struct Number(pub(super) f64);

impl fmt::Display for Number {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_nan() {
            return text.write_str("nan");
        }
        write!(text, "{:?}", self.0 + 0.0)
    }
}

/// Three of them.
pub(super) struct Numbers(pub(super) [f64; 3]);

impl fmt::Display for Numbers {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(Number);
        write!(text, "[{x}, {y}, {z}]")
    }
}

/// A string in TOML, on one line.
pub(super) struct Quoted<'s>(pub(super) &'s str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_char('"')?;
        for c in self.0.chars() {
            match c {
                '"' | '\\' => write!(text, "\\{c}")?,
                c if c.is_control() => write!(text, "\\u{:04x}", u32::from(c))?,
                c => text.write_char(c)?,
            }
        }
        text.write_char('"')
    }
}

/// An angle, or an angle's rate, in `unit`: the number of the fewest digits that is read as these radians, or is off by no
/// more than `slack`. Whoever wrote 110.0 finds it again.
pub(super) fn in_unit(radians: f64, unit: AngleUnit, slack: f64) -> f64 {
    let near = |read: f64| (read - radians).abs() <= slack;
    match unit {
        AngleUnit::Radians => shortest(radians, near),
        AngleUnit::Degrees => shortest(radians.to_degrees(), |short| near(short.to_radians())),
    }
}

/// The number of the fewest decimal digits near `value` that is `good`; `value` itself if none is.
pub fn shortest(value: f64, good: impl Fn(f64) -> bool) -> f64 {
    /// As many as tell doubles apart, less one.
    const DIGITS: usize = 16;
    (0..=DIGITS)
        .filter_map(|digits| format!("{value:.digits$e}").parse().ok())
        .find(|short| good(*short))
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_come_back_as_they_were_written() {
        for written in [0.0, 110.0, -166.3, 12.345678, 1e-7, 359.9, 0.1] {
            let read = f64::to_radians(written);
            assert_eq!(in_unit(read, AngleUnit::Degrees, 0.0), written);
        }
        for written in [0.3, f64::NAN, f64::INFINITY] {
            let same = in_unit(written, AngleUnit::Radians, 0.0).to_bits();
            assert_eq!(same, written.to_bits());
        }
        assert!(in_unit(f64::NAN, AngleUnit::Degrees, 0.0).is_nan());
    }
}
