//! The reference of the format: what is printed is what is read, and what is checked in.

use std::path::Path;
use ulna_study::Scenario;
use ulna_study::scenario::reference;

const CHECKED_IN: &str = "../docs/scenario.md";

/// The file that stands at the end of the reference.
fn example() -> String {
    let reference = reference();
    let (_, example) = reference.rsplit_once("```toml\n").unwrap();
    example.trim_end_matches("```\n").to_owned()
}

#[test]
fn the_example_is_a_sound_scenario_with_every_key() {
    let example = example();
    // Of an arm with two joints.
    let text = example.replace("my_arm.toml", "../arms/planar_2r.toml");
    let read = Scenario::parse(&text, "example.toml", Path::new("../scenarios"), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}"));
    let reference = reference();
    // A motion of the tool is another variant of [motion].
    let keys = reference
        .lines()
        .filter_map(|line| line.strip_prefix("- `"));
    let keys = keys.filter(|line| !line.contains("kind = \"tool\""));
    let keys: Vec<_> = keys.map(|line| line.split('`').next().unwrap()).collect();
    assert!(keys.len() > 40, "{keys:?}");
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
            "docs/scenario.md was out of date. It has been written anew: read the change and commit it."
        );
    }
}
