//! The references of the formats: what is printed is what is read, and what is checked in.

use std::fs;
use std::path::Path;

use ulna_study::Scenario;
use ulna_study::scenario::reference as scenario_reference;
use ulna_table::{Model, reference as table_reference};

/// The file that stands at the end of a reference.
fn example(reference: &str) -> String {
    let (_, example) = reference.rsplit_once("```toml\n").unwrap();
    example.trim_end_matches("```\n").to_owned()
}

/// Fails if the example has not every key that the reference lists, but those on lines with `variant`: at least `least` keys.
fn assert_every_key(reference: &str, variant: Option<&str>, least: usize) {
    let example = example(reference);
    let keys = reference
        .lines()
        .filter_map(|line| line.strip_prefix("- `"));
    let keys = keys.filter(|line| variant.is_none_or(|variant| !line.contains(variant)));
    let keys: Vec<_> = keys.map(|line| line.split('`').next().unwrap()).collect();
    assert!(keys.len() > least, "{keys:?}");
    for key in keys {
        let (value, header) = (format!("{key} ="), format!("{key}]"));
        assert!(
            example.contains(&value) || example.contains(&header),
            "{key} is not in the example"
        );
    }
}

#[test]
fn the_example_is_a_sound_table_with_every_key() {
    let reference = table_reference();
    Model::parse(&example(&reference), "example.toml").unwrap_or_else(|errors| panic!("{errors}"));
    assert_every_key(&reference, None, 20);
}

#[test]
fn the_example_is_a_sound_scenario_with_every_key() {
    let reference = scenario_reference();
    // Of an arm with two joints.
    let text = example(&reference).replace("my_arm.toml", "../arms/planar_2r.toml");
    let read = Scenario::parse(&text, "example.toml", Path::new("../scenarios"), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}"));
    // A motion of the tool is another variant of [motion].
    assert_every_key(&reference, Some("kind = \"tool\""), 40);
}

fn assert_checked_in(file: &str, new: &str) {
    let path = Path::new("..").join(file);
    if fs::read_to_string(&path).ok().as_deref() != Some(new) {
        fs::write(path, new).unwrap();
        panic!("{file} was out of date. It has been written anew: read the change and commit it.");
    }
}

#[test]
fn the_checked_in_reference_of_tables_is_up_to_date() {
    assert_checked_in("docs/table.md", &table_reference());
}

#[test]
fn the_checked_in_reference_of_scenarios_is_up_to_date() {
    assert_checked_in("docs/scenario.md", &scenario_reference());
}
