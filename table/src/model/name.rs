//! Which names an arm may have: each becomes a file, a module and a type of generated code.

use heck::{ToSnakeCase, ToUpperCamelCase};

/// Longest name, in characters.
const MAX_LENGTH: usize = 64;

/// Names whose type would hide one that generated code or the module around it needs:
/// the prelude's types and traits, and those of this library.
const TAKEN_TYPES: &str = "AsMut AsRef Box Clone Copy Debug Default DoubleEndedIterator Drop Eq Err \
    ExactSizeIterator Extend Fn FnMut FnOnce From FromIterator Hash Into IntoIterator Iterator None Ok Option Ord \
    PartialEq PartialOrd Result Send Sized Some String Sync ToOwned ToString TryFrom TryInto Unpin Vec \
    Angle Arm ArmBatch Joint JointKind Link Model Placement Real SerialChain TaskRow TaskRows";

/// File names that Windows keeps for devices, whatever the extension.
const DEVICES: &str = "aux com0 com1 com2 com3 com4 com5 com6 com7 com8 com9 con lpt0 lpt1 lpt2 lpt3 lpt4 lpt5 lpt6 \
    lpt7 lpt8 lpt9 nul prn";

/// The type that an arm of this name becomes: `planar_2r` is `Planar2r`.
pub(super) fn type_name(name: &str) -> String {
    name.to_upper_camel_case()
}

/// What an arm can be called that is to be called `text`, such as the stem of a file's name: `text` itself, or else a name close to it,
/// together with what is wrong with `text`. For programs that write tables.
///
/// ```
/// assert_eq!(ulna_table::name_for("ur5e"), ("ur5e".to_owned(), None));
/// assert_eq!(ulna_table::name_for("fn"), ("arm_fn".to_owned(), Some("is a keyword of Rust")));
/// ```
pub fn name_for(text: &str) -> (String, Option<&'static str>) {
    match fault(text) {
        None => (text.to_owned(), None),
        Some(fault) => (proposal(text), Some(fault)),
    }
}

/// Why `name` cannot name an arm, and what to write instead.
pub(super) fn check(name: &str) -> Result<(), (&'static str, String)> {
    let fault = fault(name);
    match fault {
        None => Ok(()),
        Some(fault) => {
            let proposal = proposal(name);
            Err((fault, format!("write for example `name = \"{proposal}\"`")))
        }
    }
}

fn fault(name: &str) -> Option<&'static str> {
    let listed = |list: &str, word: &str| list.split_whitespace().any(|listed| listed == word);
    if name.is_empty() {
        Some("is empty")
    } else if name.len() > MAX_LENGTH {
        Some("is longer than 64 characters")
    } else if !is_snake_case(name) {
        Some(
            "must be snake_case: a to z, 0 to 9 and single underscores between them, a letter first",
        )
    } else if is_keyword(name) {
        Some("is a keyword of Rust")
    } else if listed(DEVICES, name) {
        Some("is a device on Windows, not a file name")
    } else if name == "arms" {
        Some("is the name of the generated file that lists all arms")
    } else if name.len() == 1 {
        Some("is one letter, which would clash with type parameters")
    } else if listed(TAKEN_TYPES, &type_name(name)) {
        Some("would become a type that Rust's prelude or ulna already has")
    } else {
        None
    }
}

/// Strict and reserved keywords of all editions, and what is no identifier. None of them may name a module or a crate.
pub fn is_keyword(name: &str) -> bool {
    // Reserved since edition 2024, and no keyword to `syn`.
    name == "gen" || syn::parse_str::<syn::Ident>(name).is_err()
}

fn is_snake_case(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        && !name.ends_with('_')
        && !name.contains("__")
}

/// A name close to `name` that passes.
fn proposal(name: &str) -> String {
    let ascii: String = name
        .chars()
        .filter(char::is_ascii)
        .take(MAX_LENGTH / 2)
        .collect();
    let snake = ascii.to_snake_case();
    let prefixed = match snake.as_str() {
        "arm" => "my_arm".to_owned(),
        snake => format!("arm_{snake}"),
    };
    let candidates = [snake, prefixed];
    let passing = candidates.into_iter().find(|name| fault(name).is_none());
    passing.unwrap_or_else(|| "my_arm".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_names_pass() {
        for name in [
            "ssrms",
            "planar_2r",
            "table1_literal",
            "ur5e",
            "arm2",
            "my_arm",
        ] {
            assert_eq!(check(name), Ok(()), "{name}");
            assert_eq!(name_for(name).0, name);
        }
    }

    #[test]
    fn each_refused_name_has_a_proposal_that_passes() {
        let cases = [
            ("", "my_arm"),
            ("SSRMS", "ssrms"),
            ("My Arm", "my_arm"),
            ("my-arm", "my_arm"),
            ("7dof", "arm_7dof"),
            ("r#fn", "r_fn"),
            ("fn", "arm_fn"),
            ("self", "arm_self"),
            ("gen", "arm_gen"),
            ("_arm2", "arm2"),
            ("arm__2", "arm_2"),
            ("arm_2_", "arm_2"),
            ("n", "arm_n"),
            ("vec", "arm_vec"),
            ("arm", "my_arm"),
            ("task_rows", "arm_task_rows"),
            ("nul", "arm_nul"),
            ("arms", "arm_arms"),
            ("\u{e9}arm2", "arm2"),
            ("\u{3b1}", "my_arm"),
            ("x; fn main() {}", "x_fn_main"),
        ];
        for (name, expected) in cases {
            assert!(check(name).is_err(), "{name}");
            assert_eq!(name_for(name).0, expected, "{name}");
            assert_eq!(check(expected), Ok(()), "{expected}");
        }
        assert!(check(&"a".repeat(65)).is_err());
        assert_eq!(check(&proposal(&"a".repeat(6500))), Ok(()));
    }

    #[test]
    fn type_names_are_upper_camel_case() {
        assert_eq!(type_name("ssrms"), "Ssrms");
        assert_eq!(type_name("planar_2r"), "Planar2r");
        assert_eq!(type_name("table1_literal"), "Table1Literal");
    }
}
