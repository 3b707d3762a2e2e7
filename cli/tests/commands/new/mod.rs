//! `ulna new`.

mod crates;
mod refusals;
mod table;

use std::path::Path;

use assert_cmd::Command;
use assert_cmd::assert::Assert;

use crate::support::{examples, root};

/// `ulna new` with `arguments`, in `folder`.
fn new_in(folder: &Path, arguments: &[&str]) -> Assert {
    let mut command = Command::cargo_bin("ulna").unwrap();
    let command = command.current_dir(folder).arg("new").args(arguments);
    command.assert().stdout("")
}

/// The names of everything in `folder`, those in folders below with the way to them.
fn files_of(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if entry.file_type().unwrap().is_dir() {
            let below = files_of(&entry.path());
            names.extend(below.iter().map(|file| format!("{name}/{file}")));
            if below.is_empty() {
                names.push(format!("{name}/"));
            }
        } else {
            names.push(name);
        }
    }
    names.sort();
    names
}

#[test]
fn every_example_works_one_after_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let examples = examples("new");
    assert_eq!(examples.len(), 2);
    for example in examples {
        let arguments: Vec<_> = example.split(' ').skip(1).collect();
        new_in(folder.path(), &arguments).code(0);
    }
    let found = files_of(folder.path());
    assert!(found.contains(&"my_arm.toml".to_owned()), "{found:?}");
    assert!(
        found.contains(&"my_robot/arms/my_arm.toml".to_owned()),
        "{found:?}"
    );
}

/// The template of the crate asks for what this workspace asks for.
#[test]
fn the_oldest_compiler_is_that_of_the_workspace() {
    let folder = tempfile::tempdir().unwrap();
    new_in(folder.path(), &["--crate", "robot", "my_arm.toml"]).code(0);
    let line = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines();
        let found = lines.find(|line| line.starts_with("rust-version = "));
        found.unwrap().to_owned()
    };
    assert_eq!(
        line(&folder.path().join("robot/Cargo.toml")),
        line(&root().join("Cargo.toml"))
    );
}
