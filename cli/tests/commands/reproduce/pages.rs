//! What the page says follows from the numbers of the run.

use std::fs;

use serde_json::Value;

use super::{numbers, planar_scenario, quick_scenario, reproduce};
use crate::by_table::TOLD;
use crate::support::{stderr, stdout};

#[test]
fn a_table_runs_as_machine_code() {
    let folder = planar_scenario();
    let run = reproduce(&folder).code(0);
    let (out, told) = (stdout(&run), stderr(&run));
    assert!(!told.contains(TOLD), "{told}");
    assert!(
        out.starts_with("by_table: arm my_arm, joint 2 locks\n"),
        "{out}"
    );
    let text = fs::read_to_string(folder.path().join("out/results.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    // Two joints and a task of two rows: no torque leaves the tool force alone, and no law invents one from rounding.
    for case in results["cases"].as_array().unwrap() {
        assert_eq!(numbers(case, "rated_torque"), [40.0, 15.0]);
        let before = numbers(case, "impact_before");
        assert!(before.iter().all(|impact| *impact > 0.0), "{before:?}");
        assert_eq!(numbers(case, "impact_after"), before);
        assert_eq!(numbers(case, "coefficients"), [0.0, 0.0]);
        assert_eq!(case["max_force_error"], 0.0);
    }
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    the_page_tells_an_arm_without_a_null_space_so_first(&page);
}

/// What the page says of an arm follows from its numbers.
fn the_page_tells_an_arm_without_a_null_space_so_first(page: &str) {
    let spare = page.find("**This arm has no joint to spare.**");
    let spare = spare.unwrap_or_else(|| panic!("{page}"));
    assert!(spare < page.find("## a").unwrap(), "{page}");
    assert!(page.contains("has 1 of 2 independent rows left"), "{page}");
    for claim in ["95 %", "The paper argues", "trade off", "Its motion is"] {
        assert!(!page.contains(claim), "{claim:?} in:\n{page}");
    }
}

/// Of three joints one is to spare, and steps this small lead nowhere from this far.
#[test]
fn the_page_names_searches_that_stopped_early() {
    let folder = planar_scenario();
    let change = |name: &str, edits: &[(&str, &str)]| {
        let path = folder.path().join(name);
        let mut text = fs::read_to_string(&path).unwrap();
        for (from, to) in edits {
            assert!(text.contains(from), "{name} has no {from:?}");
            text = text.replacen(from, to, 1);
        }
        fs::write(path, text).unwrap();
    };
    let table = fs::read_to_string(folder.path().join("my_arm.toml")).unwrap();
    let (_, elbow) = table.split_once("[[joint]] # elbow").unwrap();
    let two = format!("[[joint]] # elbow{elbow}[[joint]]");
    change("my_arm.toml", &[("[[joint]] # elbow", &two)]);
    change(
        "quick.toml",
        &[
            ("start = [10, 60]", "start = [10, 60, 40]"),
            ("start = 0\nstep = 1e-3", "start = 1e6\nstep = 1e-6"),
            // Less to simulate: that is not what this is about.
            ("cycle = 0.1", "cycle = 0.45"),
            (
                "[search]",
                "[servo]\ngain = 0.0\nlead = 0.01\n[brake]\nduration = 0.01\n[search]",
            ),
        ],
    );
    reproduce(&folder).code(0);
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    let message =
        "**A search stopped at its step limit:** `eq16_steps` at 0.9 s after 1000000 steps";
    assert!(page.contains(message), "{page}");
    assert!(!page.contains("**The search in steps.**"), "{page}");
    let left = "**With joint 2 locked this arm has no joint to spare.**";
    assert!(page.contains(left), "{page}");
}

/// The paper's 300 N m cannot be kept: the plan alone needs more.
#[test]
fn the_page_says_where_the_plan_alone_needs_too_much() {
    let limits = ("rated_torque = \"none\"", "rated_torque = 300.0");
    let folder = quick_scenario(&[limits]);
    let out = stdout(&reproduce(&folder).code(0));
    assert!(out.contains("10 s  exactly"), "{out}");
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    for text in [
        "**No compensation was found** for `eq16_steps` at 10 s (no compensation keeps joint 4 within its rated torque",
        "405.4 N·m, 30.53 N·m",
        "That is more than the rated torque of joint 4:",
    ] {
        assert!(page.contains(text), "{text:?} is missing in:\n{page}");
    }
}

/// The paper's figures are for joint 2. Where a reference does not say so, as here the last one, that is said.
#[test]
fn references_for_another_lock_are_left_out_and_named() {
    let folder = quick_scenario(&[
        ("joints = [2]", "joints = [3]"),
        (
            "time = 10.0\nfailed_joints = [2]\ncoefficients",
            "time = 10.0\ncoefficients",
        ),
    ]);
    let out = stdout(&reproduce(&folder).code(0));
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    for text in [&out, &page] {
        let note = "The reference \"paper, Table 2\" for 3 s is left out: that is no failure time";
        assert!(text.contains(note), "{text}");
        let note = "for 10 s is left out: there joint 2 locks, here joint 3 locks.";
        assert_eq!(text.matches(note).count(), 2, "{text}");
        let note = "does not say which joint locks there; it stands beside the lock of joint 3.";
        assert_eq!(text.matches(note).count(), 1, "{text}");
    }
    assert!(!out.contains("beside it: "), "{out}");
    assert!(out.contains("10 s  paper, Table 4"), "{out}");
    let (of_52, _) = page.split_once("## 5.3").unwrap();
    for claim in ["The paper argues", "Left of the impact"] {
        assert!(!of_52.contains(claim), "{claim:?} in:\n{page}");
    }
}
