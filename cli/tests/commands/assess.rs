//! `ulna assess`.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::by_table::TOLD;
use crate::support::{edited_scenario, folder_with_my_arm, short_scenario, stderr, stdout, ulna};

/// A folder with `coarse.toml`: the paper-like scenario on a grid of few failures, and `edits`.
fn coarse_scenario(edits: &[(&str, &str)]) -> TempDir {
    let coarse = [
        ("failure_times = 79", "failure_times = 3"),
        ("locks_at_once = 2", "locks_at_once = 1"),
    ];
    edited_scenario("coarse.toml", coarse.iter().chain(edits))
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

#[test]
fn every_law_meets_every_failure() {
    let folder = coarse_scenario(&[]);
    let output = path(&folder, "out");
    let run = ulna(&["assess", &path(&folder, "coarse.toml"), "--output", &output]).code(0);
    let out = stdout(&run);
    assert!(out.starts_with(
        "paper_like: arm ssrms; each of 7 joints locks at each of 3 times, 5 to 15 s"
    ));
    assert!(out.contains("tuned for joint 2 at 10 s"), "{out}");

    let text = fs::read_to_string(folder.path().join("out/assess.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    let laws = results["laws"].as_array().unwrap();
    let names: Vec<_> = laws
        .iter()
        .map(|law| law["law"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "none",
            "eq16",
            "eq20",
            "kinematic",
            "eq16_constant",
            "eq20_constant",
            "after_only",
            "after_only",
            "after_only",
            "after_only",
            "on_line",
            "on_line",
            "on_line",
            "on_line",
            "robust",
            "robust",
            "robust",
            "robust",
            "limit"
        ]
    );
    for law in laws {
        let cases = law["cases"].as_array().unwrap();
        assert_eq!(cases.len(), 21, "{}", law["law"]);
        // What stands over the cases is what is in them; joint 7 makes no step.
        let number = |case: &Value, key: &str| case[key].as_f64().unwrap();
        let six = cases.iter().filter(|case| case["joint"] != 7);
        let ratios = six.map(|case| number(case, "after") / number(case, "before"));
        let worst = ratios.fold(0.0, f64::max);
        assert!((number(law, "worst_ratio") - worst).abs() <= 1e-12 * worst);
        let forces = cases.iter().map(|case| number(case, "force_error"));
        assert_eq!(number(law, "worst_force_error"), forces.fold(0.0, f64::max));
        let tuned = ["eq16", "eq20", "kinematic"].contains(&law["law"].as_str().unwrap());
        assert_eq!(law["tuned"].is_null(), !tuned);
        let budgeted = ["after_only", "on_line", "robust"].contains(&law["law"].as_str().unwrap());
        assert_eq!(law["force_budget"].is_null(), !budgeted);
    }
    let robust = laws.iter().filter(|law| law["law"] == "robust");
    let budgets = robust.filter_map(|law| law["force_budget"].as_f64());
    assert_eq!(budgets.collect::<Vec<_>>(), [0.0, 2.0, 5.0, 10.0]);
    assert_eq!(laws[1]["tuned"]["joint"], 2);

    let page = fs::read_to_string(folder.path().join("out/assess.md")).unwrap();
    for name in ["assess.svg", "assess.png"] {
        assert!(folder.path().join("out/figures").join(name).exists());
    }
    assert!(page.contains("](figures/assess.png)"));
    assert!(!page.contains("pairs"), "there are none: {page}");
}

/// Two joints and a task of two rows: nothing is left, and the page does not pretend.
#[test]
fn an_arm_without_redundancy_is_told_what_it_can_have() {
    let folder = folder_with_my_arm();
    let scenario = short_scenario("my_arm.toml", "[10, 60]", "[40, 20]")
        + "[assess]\nfailure_times = 3\nforce_budgets = [0]\n";
    fs::write(folder.path().join("two.toml"), scenario).unwrap();
    let output = path(&folder, "out");
    let run = ulna(&["assess", &path(&folder, "two.toml"), "--output", &output]);
    let told = stderr(&run.code(0));
    assert!(!told.contains(TOLD), "{told}");
    let text = fs::read_to_string(folder.path().join("out/assess.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    for law in results["laws"].as_array().unwrap() {
        let worst = law["worst_ratio"].as_f64().unwrap();
        assert!((worst - 1.0).abs() < 1e-6, "{}: {worst}", law["law"]);
    }
    let page = fs::read_to_string(folder.path().join("out/assess.md")).unwrap();
    assert!(page.contains("no null space"), "{page}");
}

#[test]
fn what_is_wrong_with_assess_is_said_at_once() {
    let folder = coarse_scenario(&[
        (
            "force_budgets = [0.0, 2.0, 5.0, 10.0]",
            "force_budgets = [0.0, -2.0]",
        ),
        ("rate_limit = 100.0", "rate_limit = 0.0"),
        ("locks_at_once = 1", "locks_at_once = 3"),
    ]);
    let output = path(&folder, "out");
    let run = ulna(&["assess", &path(&folder, "coarse.toml"), "--output", &output]).code(1);
    let err = stderr(&run);
    for part in ["force_budgets", "rate_limit", "locks_at_once"] {
        assert!(err.contains(part), "{part}: {err}");
    }
    assert!(!folder.path().join("out").exists());
}
