//! Base parameters as text: a line for each.

use std::fmt;

use ulna::Parameter;

use super::{BaseParameter, BaseParameters, Term};

/// Digits of a coefficient: those that every double has.
const DIGITS: usize = 15;

impl fmt::Display for BaseParameters {
    /// A line for each, `Izz1 + Iyy2 + 0.25 m2`: first the base parameter itself, then what is grouped into it; links count from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, base) in self.list.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{base}")?;
        }
        Ok(())
    }
}

impl fmt::Display for BaseParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        symbol(f, self.parameter, self.link)?;
        for Term {
            coefficient,
            link,
            parameter,
        } in &self.grouped
        {
            let sign = if *coefficient < 0.0 { "-" } else { "+" };
            write!(f, " {sign} ")?;
            let size = number(coefficient.abs());
            if size != "1" {
                write!(f, "{size} ")?;
            }
            symbol(f, *parameter, *link)?;
        }
        Ok(())
    }
}

fn symbol(f: &mut fmt::Formatter<'_>, parameter: Parameter, link: usize) -> fmt::Result {
    write!(f, "{}{}", parameter.name(), link + 1)
}

/// A number to [`DIGITS`] digits, without zeros at its end: what was computed from the table's decimals is a decimal again.
fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_read_as_they_were_meant() {
        let base = BaseParameter {
            link: 0,
            parameter: Parameter::Izz,
            grouped: [1.0, -1.0, 0.3 * 0.3, -25.0, 2e-7]
                .map(|coefficient| Term {
                    coefficient,
                    link: 1,
                    parameter: Parameter::Mass,
                })
                .to_vec(),
        };
        let expected = "Izz1 + m2 - m2 + 0.09 m2 - 25 m2 + 2e-7 m2";
        assert_eq!(base.to_string(), expected);
    }
}
