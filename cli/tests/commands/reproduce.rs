//! `ulna reproduce`.

use crate::support::{stderr, stdout, ulna};

/// The paper-like scenario with long control cycles and one failure time, in a folder of its own.
fn quick_scenario(edits: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut text = include_str!("../../../scenarios/paper_like.toml").to_owned();
    let quick = [
        ("cycle = 0.01", "cycle = 0.2"),
        ("times = [3.0, 10.0, 18.0]", "times = [10.0]"),
    ];
    for (from, to) in quick.iter().chain(edits) {
        assert!(text.contains(from), "the scenario has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    std::fs::write(folder.path().join("quick.toml"), text).unwrap();
    folder
}

fn reproduce(folder: &tempfile::TempDir) -> assert_cmd::assert::Assert {
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    ulna(&["reproduce", &path("quick.toml"), "--output", &path("out")])
}

/// The cells of the first row that starts with `title`.
fn row<'t>(text: &'t str, title: &str) -> Vec<&'t str> {
    let line = text
        .lines()
        .find(|line| line.trim_start().starts_with(title));
    let line = line.unwrap_or_else(|| panic!("no row {title:?} in:\n{text}"));
    line.trim_start()[title.len()..]
        .split_whitespace()
        .collect()
}

#[test]
fn impacts_stand_beside_the_papers() {
    let run = reproduce(&quick_scenario(&[])).code(0);
    let out = stdout(&run);
    assert!(
        out.starts_with("paper_like: arm ssrms, joint 2 locks (fitted"),
        "{out}"
    );
    // Before, the paper's, after the paper's search, the paper's, after the exact search, Eq. 20, optimal.
    assert_eq!(
        row(&out, "1 "),
        ["35.97", "30.18", "0.1052", "0.1472", "0", "4.983", "3.896"]
    );
    assert_eq!(row(&out, "2 (locks)")[..2], ["61.95", "66.72"]);
    assert_eq!(
        row(&out, "norm, healthy joints"),
        ["42.87", "0.1173", "3.8e-4", "9.973", "6.591"]
    );
}

#[test]
fn bad_scenarios_are_refused_with_every_error_and_nothing_is_written() {
    let folder = quick_scenario(&[
        ("arm = \"ssrms\"", "arm = \"ssrm\""),
        ("step = 1e6", "step = 0"),
    ]);
    let run = reproduce(&folder).code(1).stdout("");
    let err = stderr(&run);
    for message in [
        "error: no arm is called `ssrm`",
        "help: did you mean \"ssrms\"?",
        "error: `step` of [search] is out of bounds",
        "quick.toml:27:8",
    ] {
        assert!(err.contains(message), "{message} is missing in:\n{err}");
    }
    assert!(!folder.path().join("out").exists());
}
