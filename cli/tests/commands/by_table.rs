//! Scenarios whose arm is a table: the program was not compiled with it.

use std::fs;

use tempfile::TempDir;

use crate::support::{folder_with_my_arm, short_scenario, stderr, ulna};

/// What is said of an arm that is not compiled.
pub(crate) const TOLD: &str = "is not compiled into the program: it runs by the textbook formulas";

/// A folder with `short.toml`, a short motion of the `arm`, and the table `my_arm.toml`.
fn scenario(arm: &str) -> TempDir {
    let folder = folder_with_my_arm();
    let scenario = short_scenario(arm, "[10, 60]", "[40, 20]");
    fs::write(folder.path().join("short.toml"), scenario).unwrap();
    folder
}

/// What `ulna campaign` writes to stderr about `arm`.
fn told(arm: &str) -> String {
    let folder = scenario(arm);
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scenario, output) = (path("short.toml"), path("out"));
    let run = ulna(&["campaign", &scenario, "--output", &output, "--cases", "4"]);
    stderr(&run.code(0))
}

#[test]
fn an_arm_that_is_not_compiled_runs_and_is_told_once() {
    let told = told("my_arm.toml");
    assert_eq!(told.matches(TOLD).count(), 1, "{told}");
    assert!(told.contains("my_arm.toml"), "{told}");
}

#[test]
fn of_a_compiled_arm_nothing_is_told() {
    let told = told("planar_2r");
    assert!(!told.contains(TOLD), "{told}");
}
