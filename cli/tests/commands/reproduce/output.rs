//! Where results are written, and what is refused before or after the work.

use std::fs;

use serde_json::Value;

use super::{files, numbers, planar_scenario, quick_scenario, reproduce};
use crate::support::{examples, root, stderr, stdout, ulna};

#[test]
fn the_example_of_the_help_works_and_names_the_joints_that_lock_together() {
    let examples = examples("reproduce");
    assert_eq!(examples.len(), 1);
    let out = stdout(&ulna(&examples[0].split(' ').collect::<Vec<_>>()).code(0));
    assert!(
        out.starts_with("tool_path: arm ssrms, joints 2 and 4 lock ("),
        "{out}"
    );
    let text = fs::read_to_string(root().join("target/reproduce/results.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    let cases = results["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 6);
    for case in cases {
        assert_eq!(numbers(case, "failed_joint"), [2.0, 4.0]);
    }
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = quick_scenario(&[]);
    fs::write(folder.path().join("out"), "a file").unwrap();
    // Before the work, not after it.
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    assert!(err.contains("error: cannot make the folder"), "{err}");
    assert!(err.contains("/out is a file"), "{err}");
}

#[test]
#[cfg(unix)]
fn an_output_that_is_a_dangling_link_is_refused_before_the_work() {
    let folder = planar_scenario();
    std::os::unix::fs::symlink("absent", folder.path().join("out")).unwrap();
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    let message =
        "/out is a symbolic link to absent, which is not there; make that folder, or choose";
    assert!(err.contains(message), "{err}");
    assert!(!folder.path().join("absent").exists());
    // With the folder there, the link is a folder like any other.
    fs::create_dir(folder.path().join("absent")).unwrap();
    reproduce(&folder).code(0);
    assert!(folder.path().join("absent/results.json").exists());
}

#[test]
fn files_are_replaced_all_or_none() {
    let folder = planar_scenario();
    let output = folder.path().join("out");
    fs::create_dir(&output).unwrap();
    fs::write(output.join("README.md"), "precious").unwrap();
    // In the way of the last file.
    let blocked = output.join("figures/ever-shorter-brakes.png");
    fs::create_dir_all(&blocked).unwrap();
    let err = stderr(&reproduce(&folder).code(1));
    let message = "ever-shorter-brakes.png: it is a folder, no regular file";
    assert!(err.contains(message), "{err}");
    assert_eq!(files(&output), ["README.md".to_owned()].into());
    assert_eq!(
        fs::read_to_string(output.join("README.md")).unwrap(),
        "precious"
    );
    fs::remove_dir(blocked).unwrap();
    // `series` has been made by then, and goes again.
    let figures = output.join("figures");
    fs::remove_dir(&figures).unwrap();
    fs::write(&figures, "a file").unwrap();
    let err = stderr(&reproduce(&folder).code(1));
    assert!(
        err.contains("cannot make the folder") && err.contains("/figures"),
        "{err}"
    );
    assert_eq!(
        files(&output),
        ["README.md", "figures"].map(str::to_owned).into()
    );
    assert!(!output.join("series").exists());
    assert_eq!(
        fs::read_to_string(output.join("README.md")).unwrap(),
        "precious"
    );
}

#[test]
fn a_motion_that_cannot_be_executed_is_refused() {
    let slow = "blend = 4.455\nmax_velocity = [1, 1, 0.2, 1, 1, 1, 1]";
    let folder = quick_scenario(&[("blend = 4.455", slow)]);
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    let message = "error: the motion cannot be executed: joint 3 would need 0.283";
    assert!(err.contains(message), "{err}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn bad_scenarios_are_refused_with_every_error_and_nothing_is_written() {
    let edits = [
        ("arm = \"ssrms\"", "arm = \"ssrm\""),
        ("step = 1e6", "step = 0"),
    ];
    let folder = quick_scenario(&edits);
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    for message in [
        "error: no arm is called `ssrm`",
        "quick.toml:6:7",
        "help: did you mean \"ssrms\"?",
        "error: `step` of [search] is out of bounds",
    ] {
        assert!(err.contains(message), "{message} is missing in:\n{err}");
    }
    assert!(!folder.path().join("out").exists());
}
