//! The crates and the arrows between them, as ARCHITECTURE.md has them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;

use serde_json::{Value, json};

/// Each crate of the product with those of the product that it may need, at run time or to be built.
const ARROWS: &[(&str, &[&str])] = &[
    ("ulna", &[]),
    ("ulna-table", &["ulna"]),
    ("ulna-urdf", &["ulna", "ulna-table"]),
    ("ulna-codegen", &["ulna", "ulna-table"]),
    ("ulna-macros", &["ulna-codegen", "ulna-table"]),
    ("ulna-generated", &["ulna", "ulna-codegen"]),
    ("ulna-jit", &["ulna", "ulna-codegen", "ulna-table"]),
    ("ulna-study", &["ulna", "ulna-table"]),
    ("ulna-verify", &["ulna", "ulna-codegen", "ulna-table"]),
    (
        "ulna-experiments",
        &["ulna", "ulna-jit", "ulna-study", "ulna-table"],
    ),
    ("ulna-files", &[]),
    (
        "ulna-campaign",
        &["ulna", "ulna-experiments", "ulna-files", "ulna-study"],
    ),
    (
        "ulna-cli",
        &[
            "ulna",
            "ulna-campaign",
            "ulna-codegen",
            "ulna-experiments",
            "ulna-files",
            "ulna-generated",
            "ulna-study",
            "ulna-table",
            "ulna-urdf",
            "ulna-verify",
        ],
    ),
    (
        "ulna-python",
        &[
            "ulna",
            "ulna-campaign",
            "ulna-codegen",
            "ulna-experiments",
            "ulna-files",
            "ulna-jit",
            "ulna-study",
            "ulna-table",
            "ulna-urdf",
            "ulna-verify",
        ],
    ),
];

/// What cargo says of the packages of the workspace.
fn packages() -> Vec<Value> {
    let metadata = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--no-deps",
            "--format-version=1",
            "--quiet",
            "--offline",
        ])
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&metadata.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

#[test]
fn arrows_go_one_way() {
    let packages = packages();
    for (name, allowed) in ARROWS {
        let package = packages.iter().find(|package| package["name"] == *name);
        let dependencies = package.unwrap()["dependencies"].as_array().unwrap();
        let mut own: Vec<&str> = dependencies
            .iter()
            .filter(|dependency| dependency["kind"] != "dev")
            .filter_map(|dependency| dependency["name"].as_str())
            .filter(|dependency| dependency.starts_with("ulna"))
            .collect();
        own.sort_unstable();
        own.dedup();
        assert_eq!(own, *allowed, "{name}");
    }
}

/// `ulna-generated` has a feature for each table of `arms/`, and the program passes it on.
#[test]
fn every_table_has_its_features() {
    let tables = fs::read_dir("../arms").unwrap();
    let tables = tables.map(|entry| entry.unwrap().path());
    let tables = tables.filter(|path| path.extension().is_some_and(|it| it == "toml"));
    let arms: BTreeSet<String> = tables
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    let packages = packages();
    let declared = |package: &str, besides: &[&str]| -> BTreeMap<String, Value> {
        let package = packages.iter().find(|found| found["name"] == package);
        let features = package.unwrap()["features"].as_object().unwrap().clone();
        let features = features.into_iter();
        features
            .filter(|(name, _)| !besides.contains(&name.as_str()))
            .collect()
    };
    let wanted = |of: &dyn Fn(&String) -> Value| -> BTreeMap<String, Value> {
        arms.iter().map(|arm| (arm.clone(), of(arm))).collect()
    };
    let faults = [
        features_to_change(
            "generated/Cargo.toml",
            &declared("ulna-generated", &["all", "default"]),
            &wanted(&|_| json!([])),
        ),
        features_to_change(
            "cli/Cargo.toml",
            &declared("ulna-cli", &["all-arms"]),
            &wanted(&|arm| json!([format!("ulna-generated/{arm}")])),
        ),
    ]
    .concat();
    assert!(
        faults.is_empty(),
        "features are not those of the tables in arms/{faults}"
    );
}

/// A line for each feature that is missing or has no table.
fn features_to_change(
    manifest: &str,
    found: &BTreeMap<String, Value>,
    wanted: &BTreeMap<String, Value>,
) -> String {
    let missing = wanted
        .iter()
        .filter(|(name, value)| found.get(*name) != Some(value))
        .map(|(name, value)| format!("\n{manifest}: write {name} = {value}"));
    let beyond = found
        .keys()
        .filter(|name| !wanted.contains_key(*name))
        .map(|name| format!("\n{manifest}: take out {name}, which has no table"));
    missing.chain(beyond).collect()
}

/// Without square roots and sines from anywhere, one message says what to write.
#[test]
fn neither_std_nor_libm_is_told_what_to_write() {
    let check = [
        "check",
        "--quiet",
        "--package",
        "ulna",
        "--no-default-features",
    ];
    let output = Command::new(env!("CARGO"))
        .args(check)
        .env("CARGO_TERM_COLOR", "never")
        .env("CARGO_TARGET_DIR", env!("CARGO_TARGET_TMPDIR"))
        .output()
        .unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success());
    assert!(stderr.contains("write `features = [\"libm\"]`"), "{stderr}");
}
