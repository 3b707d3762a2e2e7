//! How far experiments go.

use std::fs;

use crate::support::{long_arm, short_scenario, stderr, stdout, ulna};

const COMMANDS: [&str; 3] = ["reproduce", "assess", "campaign"];

#[test]
fn experiments_say_how_far_they_go() {
    let folder = tempfile::tempdir().unwrap();
    long_arm(folder.path(), 13);
    let scenario = folder.path().join("long.toml");
    let [start, goal] = [10, 20].map(|angle| format!("{:?}", [angle; 13]));
    fs::write(&scenario, short_scenario("long_13.toml", &start, &goal)).unwrap();
    let output = folder.path().join("out");
    for command in COMMANDS {
        let [from, to] = [&scenario, &output].map(|path| path.to_str().unwrap());
        let run = ulna(&[command, from, "--output", to]).code(1).stdout("");
        let err = stderr(&run);
        for said in ["13 joints", "up to 12", "`ulna verify`", "up to 32"] {
            assert!(err.contains(said), "{command}: {err}");
        }
        assert!(!output.exists(), "{command}");
    }
}

#[test]
fn help_says_how_far_experiments_go() {
    for command in COMMANDS {
        let help = stdout(&ulna(&[command, "--help"]).code(0));
        assert!(help.contains("arms of up to 12 joints"), "{help}");
    }
}
