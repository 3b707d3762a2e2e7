//! The crates and the arrows between them, as ARCHITECTURE.md has them.

use std::process::Command;

use serde_json::Value;

/// Each crate of the product with those of the product that it may need, at run time or to be built.
const ARROWS: &[(&str, &[&str])] = &[
    ("ulna", &[]),
    ("ulna-table", &["ulna"]),
    ("ulna-urdf", &["ulna", "ulna-table"]),
    ("ulna-codegen", &["ulna", "ulna-table"]),
    ("ulna-macros", &["ulna-codegen", "ulna-table"]),
    ("ulna-generated", &["ulna", "ulna-codegen"]),
    ("ulna-study", &["ulna", "ulna-table"]),
    (
        "ulna-cli",
        &[
            "ulna",
            "ulna-codegen",
            "ulna-generated",
            "ulna-study",
            "ulna-table",
            "ulna-urdf",
        ],
    ),
];

#[test]
fn arrows_go_one_way() {
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
    let packages = metadata["packages"].as_array().unwrap();
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
