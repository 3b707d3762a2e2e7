//! Numbers as Rust literals.

use std::f64::consts;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// A number as a literal that reads back to the same bits and that no lint takes for a constant of mathematics.
pub(super) fn literal(value: f64) -> TokenStream {
    if value.is_sign_negative() {
        let positive = literal(-value);
        return quote!(-#positive);
    }
    if value.is_infinite() {
        return quote!(::core::primitive::f64::INFINITY);
    }
    let constant = CONSTANTS.iter().find(|(_, constant)| *constant == value);
    if let Some((name, _)) = constant {
        let name = format_ident!("{name}");
        return quote!(::core::f64::consts::#name);
    }
    let digits = format!("{value:?}");
    // An exponent tells a measured 3.14 from a careless π.
    let mistaken = CONSTANTS.iter().any(|(_, constant)| {
        let places = digits.len().saturating_sub(2);
        constant.to_string().starts_with(&digits) || format!("{constant:.places$}") == digits
    });
    let literal = if mistaken && digits.len() > 3 {
        format!("{digits}e0")
    } else {
        digits
    };
    let literal: Literal = literal
        .parse()
        .unwrap_or_else(|_| Literal::f64_unsuffixed(value));
    quote!(#literal)
}

/// The constants of mathematics that have a name in `core`.
const CONSTANTS: [(&str, f64); 19] = [
    ("E", consts::E),
    ("FRAC_1_PI", consts::FRAC_1_PI),
    ("FRAC_1_SQRT_2", consts::FRAC_1_SQRT_2),
    ("FRAC_2_PI", consts::FRAC_2_PI),
    ("FRAC_2_SQRT_PI", consts::FRAC_2_SQRT_PI),
    ("FRAC_PI_2", consts::FRAC_PI_2),
    ("FRAC_PI_3", consts::FRAC_PI_3),
    ("FRAC_PI_4", consts::FRAC_PI_4),
    ("FRAC_PI_6", consts::FRAC_PI_6),
    ("FRAC_PI_8", consts::FRAC_PI_8),
    ("LN_2", consts::LN_2),
    ("LN_10", consts::LN_10),
    ("LOG2_E", consts::LOG2_E),
    ("LOG2_10", consts::LOG2_10),
    ("LOG10_2", consts::LOG10_2),
    ("LOG10_E", consts::LOG10_E),
    ("PI", consts::PI),
    ("SQRT_2", consts::SQRT_2),
    ("TAU", consts::TAU),
];

#[cfg(test)]
mod tests {
    use super::literal;

    fn text(value: f64) -> String {
        literal(value).to_string().replace(' ', "")
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        for value in [
            0.1,
            1.0 / 3.0,
            5e-324,
            1.7976931348623157e308,
            123456789.123,
            1e21,
        ] {
            assert_eq!(text(value).parse::<f64>(), Ok(value));
            assert_eq!(text(-value).parse::<f64>(), Ok(-value));
        }
    }

    #[test]
    fn constants_go_by_their_names_and_lookalikes_are_told_apart() {
        assert_eq!(
            text(std::f64::consts::FRAC_1_SQRT_2),
            "::core::f64::consts::FRAC_1_SQRT_2"
        );
        for measured in ["3.14159", "0.7071", "2.718"] {
            let value: f64 = measured.parse().unwrap();
            assert_eq!(text(value), format!("{measured}e0"));
        }
        assert_eq!(text(3.5), "3.5");
    }
}
