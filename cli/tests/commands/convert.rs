//! `ulna convert`.

use crate::support::{stderr, stdout, ulna};

#[test]
fn a_table_goes_there_and_back_with_where_its_numbers_are_from() {
    let folder = tempfile::tempdir().unwrap();
    let standard = folder.path().join("standard.toml");
    let standard = standard.to_str().unwrap();
    ulna(&[
        "convert",
        "arms/geared_6.toml",
        "--to",
        "standard",
        "--output",
        standard,
    ])
    .code(0)
    .stdout("")
    .stderr("");
    let text = std::fs::read_to_string(standard).unwrap();
    for part in [
        "# A made-up arm with all that a table can say",
        "from geared_6.toml in modified form; com and inertia are in the frames of these rows in standard form.",
        "convention = \"standard\"\nangle_unit = \"deg\"",
        "name = \"lift\"",
        "a = 0.52\n",
    ] {
        assert!(text.contains(part), "{part} is missing in:\n{text}");
    }
    let checked = stdout(&ulna(&["check", standard]).code(0).stderr(""));
    assert!(checked.contains("6: R P R R R R"), "{checked}");
    let back = stdout(
        &ulna(&["convert", standard, "--to", "modified"])
            .code(0)
            .stderr(""),
    );
    assert!(
        back.contains("from standard.toml in standard form"),
        "{back}"
    );
    assert!(back.contains("convention = \"modified\""), "{back}");
}

#[test]
fn what_has_the_form_already_is_written_anew_and_said() {
    let run = ulna(&["convert", "arms/ssrms.toml", "--to", "modified"]).code(0);
    assert!(stdout(&run).contains("name = \"ssrms\"\nconvention = \"modified\""));
    assert!(stderr(&run).contains("arms/ssrms.toml is in modified form already"));
}

#[test]
fn a_bad_table_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out.toml");
    let run = ulna(&[
        "convert",
        "tests/bad_arm.toml",
        "--to",
        "standard",
        "--output",
        output.to_str().unwrap(),
    ])
    .code(1);
    assert!(stderr(&run).contains("tests/bad_arm.toml:"));
    assert!(!output.exists());
    ulna(&["convert", "arms/ssrms.toml", "--to", "classic"]).code(2);
}
