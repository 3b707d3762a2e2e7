//! What is written where a number or a word should stand, and what its writer should have written.

use std::f64::consts::{PI, TAU};

/// What is wrong, and what to write instead.
pub(super) struct Amendment {
    pub(super) message: String,
    pub(super) help: String,
}

/// What is meant on a line that is no TOML from the byte `at` on. `is_word`: the parser takes it for a string.
pub(super) fn amend_line(line: &str, at: usize, is_word: bool) -> Option<Amendment> {
    let code = line.split('#').next().unwrap_or_default();
    let (before, after) = code.split_at_checked(at)?;
    if after.starts_with(':') {
        return Some(Amendment {
            message: "a colon stands between key and value".to_owned(),
            help: format!("write `{} = ...`", before.trim()),
        });
    }
    let bounds = ['[', ']', '{', '}', ',', '='];
    let start = before.rfind(bounds).map_or(0, |bound| bound + 1);
    let end = after.find(bounds).map_or(code.len(), |bound| at + bound);
    let value = code[start..end].trim();
    let ends_with = |bound| code[end..].starts_with(bound);
    // In an inline table the next key has become a part of the value.
    if let Some((value, key)) = value.rsplit_once(char::is_whitespace)
        && ends_with('=')
    {
        return Some(Amendment {
            message: "a comma is missing between entries".to_owned(),
            help: format!("write `{}, {key} = ...`", value.trim_end()),
        });
    }
    if let Some(parts) = numbers(value)
        && code[..start].ends_with('=')
    {
        return Some(Amendment {
            message: "no space stands in a number".to_owned(),
            help: format!("write `{}`", parts.concat()),
        });
    }
    // A comma may be a part of what was meant: of the whole line's value, or of one in an inline table.
    let whole = code.split_once('=').map(|(_, value)| value);
    let entry = before.rfind('=').map(|equals| &before[equals + 1..]);
    [whole, entry, Some(value)]
        .into_iter()
        .flatten()
        .find_map(amend)
        .or_else(|| quoteless(value).filter(|_| is_word))
}

/// A word without its quotes.
fn quoteless(value: &str) -> Option<Amendment> {
    let part = |c: char| c.is_alphanumeric() || "_-./".contains(c);
    let word = value.starts_with(char::is_alphabetic) && value.chars().all(part);
    let word = Some(value).filter(|value| word && value.len() <= LONGEST)?;
    Some(Amendment {
        message: "a word must be quoted".to_owned(),
        help: format!("write `\"{word}\"`"),
    })
}

const TYPESET_QUOTES: [char; 5] = ['\u{201c}', '\u{201d}', '\u{2018}', '\u{2019}', '\u{201e}'];

/// Longer values are no slip of the pen, in bytes.
const LONGEST: usize = 64;

/// What is meant by `text`, a value that TOML does not know. `None` if there is nothing to say about it.
pub(super) fn amend(text: &str) -> Option<Amendment> {
    let text = text.trim();
    if text.len() > LONGEST {
        return None;
    }
    let amendment = |message: &str, help: String| {
        let message = message.to_owned();
        Some(Amendment { message, help })
    };
    if let Some((value, comment)) = text.split_once("//") {
        let help = format!("write `{} # {}`", value.trim(), comment.trim());
        return amendment("a comment begins with `#`", help);
    }
    if let Some(value) = text.strip_suffix(';') {
        let help = format!("write `{}`", value.trim());
        return amendment("no semicolon ends a line", help);
    }
    if let Some(number) = decimal_comma(text) {
        return amendment("a comma is no decimal point", format!("write `{number}`"));
    }
    if let Some(formula) = Formula::read(text) {
        let help = formula.help();
        return amendment("formulas are not read, only numbers", help);
    }
    if let Some(number) = power(text) {
        let help = format!("write `{number:?}`");
        return amendment("formulas are not read, only numbers", help);
    }
    if let Some(number) = bare_point(text) {
        let help = format!("write `{number}`");
        return amendment("a decimal point stands between digits", help);
    }
    if text.contains('\u{2212}') {
        let help = format!("write `{}`", text.replace('\u{2212}', "-"));
        return amendment("this is a typeset minus sign, not the character `-`", help);
    }
    if text.contains(TYPESET_QUOTES) {
        let help = format!("write `{}`", text.replace(TYPESET_QUOTES, "\""));
        return amendment("these are typeset quotes, not the character `\"`", help);
    }
    if let Some(numbers) = numbers(text) {
        let help = format!("write a comma after each: `{}`", numbers.join(", "));
        return amendment("a comma is missing between numbers", help);
    }
    if let Some(number) = with_unit(text) {
        let help = format!("write the number alone, `{number}`; each key has its unit");
        return amendment("no unit follows a number", help);
    }
    None
}

/// `3,761` with a point.
fn decimal_comma(text: &str) -> Option<String> {
    let (whole, fraction) = text.split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let whole = whole.trim_end();
    let unsigned = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    (digits(unsigned) && digits(fraction)).then(|| format!("{whole}.{fraction}"))
}

/// The value of `10^4` or `10**4`.
fn power(text: &str) -> Option<f64> {
    let (base, exponent) = text.split_once("**").or_else(|| text.split_once('^'))?;
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = number(base)?.powf(number(exponent)?);
    value.is_finite().then_some(value)
}

/// `.5` or `5.` with the digit that TOML wants.
fn bare_point(text: &str) -> Option<String> {
    text.parse::<f64>().ok()?;
    let (whole, fraction) = text.split_once('.')?;
    let whole = match whole {
        "" | "-" | "+" => format!("{whole}0"),
        whole => whole.to_owned(),
    };
    let fraction = if fraction.starts_with(|c: char| c.is_ascii_digit()) {
        fraction.to_owned()
    } else {
        format!("0{fraction}")
    };
    let amended = format!("{whole}.{fraction}");
    (amended != text).then_some(amended)
}

/// Two numbers or more, with spaces between them.
fn numbers(text: &str) -> Option<Vec<&str>> {
    let words: Vec<_> = text.split_whitespace().collect();
    let all = words.iter().all(|word| is_number(word));
    (all && words.len() > 1).then_some(words)
}

/// The number of `90 deg` or `1.0kg`.
fn with_unit(text: &str) -> Option<&str> {
    if is_number(text) {
        return None;
    }
    let units = |c: char| c.is_alphabetic() || "\u{b0}^/%*\u{b7} 123".contains(c);
    let starts = (1..text.len())
        .rev()
        .filter(|&at| text.is_char_boundary(at));
    let mut splits = starts.map(|at| text.split_at(at));
    let (number, _) = splits.find(|(number, unit)| {
        let unit = unit.trim_start();
        is_number(number.trim_end())
            && unit.chars().all(units)
            && !["e", "E"].contains(&unit)
            && unit.starts_with(|c: char| c.is_alphabetic() || c == '\u{b0}' || c == '%')
    })?;
    Some(number.trim_end())
}

fn is_number(text: &str) -> bool {
    let digit = text.bytes().any(|byte| byte.is_ascii_digit());
    digit && text.parse::<f64>().is_ok()
}

/// A product or quotient of numbers and π.
struct Formula {
    value: f64,
    /// With π read as 180.
    degrees: f64,
    has_pi: bool,
}

impl Formula {
    fn read(text: &str) -> Option<Self> {
        let (sign, mut rest) = match text.strip_prefix('-') {
            Some(rest) => (-1.0, rest),
            None => (1.0, text.strip_prefix('+').unwrap_or(text)),
        };
        let mut formula = Self {
            value: sign,
            degrees: sign,
            has_pi: false,
        };
        let mut divides = false;
        let mut factors = 0;
        loop {
            let end = rest.find(['*', '/']).unwrap_or(rest.len());
            formula.take(rest[..end].trim(), divides)?;
            factors += 1;
            let Some(operator) = rest[end..].chars().next() else {
                break;
            };
            divides = operator == '/';
            rest = &rest[end + 1..];
        }
        let is_formula = formula.has_pi || factors > 1;
        (is_formula && formula.value.is_finite()).then_some(formula)
    }

    fn take(&mut self, factor: &str, divides: bool) -> Option<()> {
        let pi = match factor {
            "pi" | "PI" | "Pi" | "\u{3c0}" | "math.pi" | "np.pi" | "numpy.pi" | "M_PI" => {
                Some((PI, 180.0))
            }
            "tau" | "\u{3c4}" | "math.tau" => Some((TAU, 360.0)),
            _ => None,
        };
        let (value, degrees) = match pi {
            Some(both) => {
                self.has_pi = true;
                both
            }
            None => {
                let number = Some(factor).filter(|factor| is_number(factor))?;
                let number = number.parse().ok()?;
                (number, number)
            }
        };
        if divides {
            self.value /= value;
            self.degrees /= degrees;
        } else {
            self.value *= value;
            self.degrees *= degrees;
        }
        Some(())
    }

    fn help(&self) -> String {
        let Self {
            value,
            degrees,
            has_pi,
        } = self;
        if *has_pi {
            format!(
                "write `{value:?}`, or `{degrees:?}` where the file says `angle_unit = \"deg\"`"
            )
        } else {
            format!("write `{value:?}`")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::amend;

    #[test]
    fn what_is_meant_is_told() {
        for (written, meant) in [
            ("pi/2", "write `1.5707963267948966`, or `90.0` where"),
            (
                "-3 * np.pi / 4",
                "write `-2.356194490192345`, or `-135.0` where",
            ),
            ("1/2", "write `0.5`"),
            ("3,761", "write `3.761`"),
            ("-0,5", "write `-0.5`"),
            ("10^4", "write `10000.0`"),
            (".5", "write `0.5`"),
            ("-.5", "write `-0.5`"),
            ("5.", "write `5.0`"),
            ("0.5 0.0", "write a comma after each: `0.5, 0.0`"),
            ("90deg", "write the number alone, `90`"),
            ("90\u{b0}", "write the number alone, `90`"),
            ("1.5e3 kg m^2", "write the number alone, `1.5e3`"),
            ("1.0 // kg", "write `1.0 # kg`"),
            ("1.0;", "write `1.0`"),
            ("\u{2212}1.0", "write `-1.0`"),
            ("\u{201c}deg\u{201d}", "write `\"deg\"`"),
        ] {
            let help = amend(written).map(|amendment| amendment.help);
            let help = help.unwrap_or_else(|| panic!("nothing is said of {written}"));
            assert!(help.starts_with(meant), "{written}: {help}");
        }
        for sound in [
            "1.0", "-1", "deg", "ssrms", "", "1e5", "nan", "1/0", "1.0e", "7dof_arm",
        ] {
            assert!(amend(sound).is_none(), "{sound}");
        }
    }
}
