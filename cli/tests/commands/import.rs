//! `ulna import`.

use std::fs;

use crate::support::{stderr, stdout, ulna};

const URDF: &str = "urdf/tests/robots/arm_with_gripper.urdf";

#[test]
fn the_table_goes_to_stdout_and_what_was_done_to_stderr() {
    let run = ulna(&["import", URDF, "--tip", "hand"]).code(0);
    let (table, err) = (stdout(&run), stderr(&run));
    assert!(table.starts_with("# Imported by ulna from "), "{table}");
    assert_eq!(table.matches("\n[[joint]] #").count(), 3, "{table}");
    for said in [
        "note: counted with `forearm`: `hand`, `finger_left`, `finger_right` (line 52)",
        "note: beside the chain, frozen at 0 and counted with `forearm`: `finger_1`",
        "note: joint `finger_2` mimics `finger_1`",
    ] {
        assert!(err.contains(said), "{said} is missing in:\n{err}");
    }
    assert!(!err.contains('\u{1b}'), "colour in a pipe:\n{err}");
}

/// What it says is to be done next can be done.
#[test]
fn from_a_description_to_verified_code() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("arm.toml");
    let table = table.to_str().unwrap();
    let run = ulna(&["import", URDF, "--tip", "hand", "--output", table])
        .code(0)
        .stdout("");
    let err = stderr(&run);
    assert!(
        err.contains("the arm arm_with_gripper, 3 joints from base_link to hand, 11.140 kg"),
        "{err}"
    );
    assert!(
        err.contains("3 elbow moves forearm with flange, hand, finger_left, finger_right"),
        "{err}"
    );
    for command in ["check", "verify"] {
        assert!(err.contains(&format!("  ulna {command} {table}")), "{err}");
        ulna(&[command, table]).code(0);
    }
    let code = stdout(&ulna(&["generate", table]).code(0));
    assert!(code.contains("pub struct ArmWithGripper"), "{code:.2000}");
}

#[test]
fn several_chains_are_listed_with_what_to_type() {
    let run = ulna(&["import", URDF]).code(1).stdout("");
    let err = stderr(&run);
    for (tip, joints) in [("hand", 3), ("finger_left", 4)] {
        let line = err
            .lines()
            .find(|line| line.contains(&format!("--tip {tip} ")));
        assert!(
            line.is_some_and(|line| line.contains(&format!("{joints} joints"))),
            "{err}"
        );
    }
}

#[test]
fn nothing_is_written_of_what_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("arm.toml");
    let path = table.to_str().unwrap();
    ulna(&["import", URDF, "--output", path]).code(1).stdout("");
    assert!(!table.exists());
    fs::write(&table, "mine").unwrap();
    ulna(&["import", URDF, "--tip", "nowhere", "--output", path])
        .code(1)
        .stdout("");
    ulna(&["import", "arms/ssrms.toml", "--output", path])
        .code(1)
        .stdout("");
    assert_eq!(fs::read_to_string(&table).unwrap(), "mine");
    ulna(&[
        "import",
        URDF,
        "--tip",
        "hand",
        "--output",
        "nowhere/arm.toml",
    ])
    .code(1)
    .stdout("");
    ulna(&["import"]).code(2).stdout("");
}

#[test]
fn options_may_be_repeated() {
    let arguments = [
        "import",
        URDF,
        "--drop",
        "finger_left",
        "--drop",
        "finger_right",
        "--name",
        "plain",
        "--base",
        "column",
    ];
    let table = stdout(&ulna(&arguments).code(0));
    assert!(table.contains("\nname = \"plain\"\n"), "{table}");
    assert_eq!(table.matches("\n[[joint]] #").count(), 2, "{table}");
    let twice = [
        "import",
        URDF,
        "--tip",
        "hand",
        "--accept-inertia",
        "hand",
        "--accept-inertia",
        "column",
    ];
    let err = stderr(&ulna(&twice).code(0));
    assert_eq!(err.matches("is not needed").count(), 2, "{err}");
}
