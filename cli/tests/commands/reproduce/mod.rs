//! `ulna reproduce`.

mod output;
mod pages;
mod printed;
mod whole;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use serde_json::Value;
use tempfile::TempDir;

use crate::support::{edited_scenario, folder_with_my_arm, ulna};

/// A folder with `quick.toml`: the paper-like scenario with long control cycles and one failure time, and `edits`.
fn quick_scenario(edits: &[(&str, &str)]) -> TempDir {
    let quick = [
        ("cycle = 0.01", "cycle = 0.2"),
        ("times = [3.0, 10.0, 18.0]", "times = [10.0]"),
    ];
    edited_scenario("quick.toml", quick.iter().chain(edits))
}

/// A folder with `quick.toml` about an arm of two joints, and that arm's table.
fn planar_scenario() -> TempDir {
    let folder = folder_with_my_arm();
    let scenario = r#"
name = "by_table"
arm = "my_arm.toml"
angle_unit = "deg"
[motion]
kind = "tool"
angles = "q"
start = [10, 60]
displacement = [-0.3, 0.2, 0, 0, 0, 0]
duration = 2
blend = 0.5
[failure]
joints = [2]
times = [0.9]
[control]
cycle = 0.1
[search]
start = 0
step = 1e-3
[[experiment]]
section = "a"
force = [1, [0, 2], 0]
rated_torque = "table"
"#;
    fs::write(folder.path().join("quick.toml"), scenario).unwrap();
    folder
}

fn reproduce(folder: &TempDir) -> Assert {
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    ulna(&["reproduce", &path("quick.toml"), "--output", &path("out")])
}

/// All files below `folder`, by their paths in it.
fn files(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            let below = files(&entry.path());
            found.extend(below.iter().map(|file| format!("{name}/{file}")));
        } else {
            found.insert(name);
        }
    }
    found
}

/// The numbers under `key` of a case.
fn numbers(case: &Value, key: &str) -> Vec<f64> {
    let numbers = case[key].as_array();
    let numbers = numbers.unwrap_or_else(|| panic!("{key} of {case}"));
    numbers
        .iter()
        .map(|number| number.as_f64().unwrap())
        .collect()
}
