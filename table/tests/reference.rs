//! The reference of the format: what is printed is what is read, and what is checked in.

use ulna_table::Model;
use ulna_table::reference;

const CHECKED_IN: &str = "../docs/table.md";

/// The file that stands at the end of the reference.
fn example() -> String {
    let reference = reference();
    let (_, example) = reference.rsplit_once("```toml\n").unwrap();
    example.trim_end_matches("```\n").to_owned()
}

#[test]
fn the_example_is_a_sound_table_with_every_key() {
    let example = example();
    Model::parse(&example, "example.toml").unwrap_or_else(|errors| panic!("{errors}"));
    let reference = reference();
    let keys = reference
        .lines()
        .filter_map(|line| line.strip_prefix("- `"));
    let keys: Vec<_> = keys.map(|line| line.split('`').next().unwrap()).collect();
    assert!(keys.len() > 20, "{keys:?}");
    for key in keys {
        let (value, header) = (format!("{key} ="), format!("{key}]"));
        assert!(
            example.contains(&value) || example.contains(&header),
            "{key} is not in the example"
        );
    }
}

#[test]
fn the_checked_in_reference_is_up_to_date() {
    let new = reference();
    if std::fs::read_to_string(CHECKED_IN).ok().as_ref() != Some(&new) {
        std::fs::write(CHECKED_IN, new).unwrap();
        panic!(
            "docs/table.md was out of date. It has been written anew: read the change and commit it."
        );
    }
}
