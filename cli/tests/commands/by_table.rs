//! Scenarios whose arm is a table: the program was not compiled with it.

use std::fs;

use tempfile::TempDir;

use crate::support::{stderr, ulna};

/// What is said of an arm that is not compiled.
pub(crate) const TOLD: &str = "is not compiled into the program: it runs by the textbook formulas";

/// A folder with `short.toml`, a short motion of the `arm`, and the table `my_arm.toml`.
fn scenario(arm: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let table = include_str!("../../../arms/planar_2r.toml").replace("planar_2r", "my_arm");
    fs::write(folder.path().join("my_arm.toml"), table).unwrap();
    let scenario = format!(
        r#"
name = "short"
arm = "{arm}"
angle_unit = "deg"
[motion]
kind = "joint"
angles = "q"
start = [10, 60]
goal = [40, 20]
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
force = [1, 2, 0]
rated_torque = "none"
"#
    );
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
