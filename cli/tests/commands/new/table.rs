//! The table that is written: sound, with every key, and called after its file.

use std::fs;

use super::{files_of, new_in};
use crate::support::{stderr, stdout, ulna};

#[test]
fn a_new_table_passes_every_command_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let said = stderr(&new_in(folder.path(), &["bench_arm.toml"]).code(0));
    assert!(
        said.starts_with("written: bench_arm.toml, the arm `bench_arm`\n"),
        "{said}"
    );
    assert_eq!(files_of(folder.path()), ["bench_arm.toml"]);
    let table = folder.path().join("bench_arm.toml");
    let table = table.to_str().unwrap();
    let checked = stdout(&ulna(&["check", table]).code(0).stderr(""));
    assert!(
        checked.contains("bench_arm, as a type BenchArm"),
        "{checked}"
    );
    let code = stdout(&ulna(&["generate", table]).code(0).stderr(""));
    assert!(code.contains("pub struct BenchArm;"), "{code:.300}");
    let verify = ["verify", table, "--samples", "20"];
    ulna(&verify).code(0).stderr("");
}

#[test]
fn a_new_table_has_every_key_with_a_word_about_it() {
    let folder = tempfile::tempdir().unwrap();
    new_in(folder.path(), &["my_arm.toml"]).code(0);
    let table = fs::read_to_string(folder.path().join("my_arm.toml")).unwrap();
    let reference = stdout(&ulna(&["help", "table"]));
    let keys = reference
        .lines()
        .filter_map(|line| line.strip_prefix("- `")?.split('`').next());
    let keys: Vec<_> = keys.collect();
    assert!(keys.len() > 30, "{keys:?}");
    for key in keys {
        let has_key =
            |line: &str| line.contains(&format!("{key} =")) || line.contains(&format!("{key}]"));
        let first = table.lines().position(has_key);
        let first = first.unwrap_or_else(|| panic!("{key} is not in the template"));
        // In its line, or in the lines before it up to the next empty one.
        let explained = table.lines().take(first + 1).collect::<Vec<_>>();
        let explained = explained.iter().rev().take_while(|line| !line.is_empty());
        assert!(
            explained.clone().any(|line| line.contains('#')),
            "{key} is not explained"
        );
    }
}

#[test]
fn an_arm_is_called_after_its_file_as_far_as_it_can_be() {
    for (file, name, why) in [
        ("ur5e.toml", "ur5e", ""),
        ("bench arm.toml", "bench_arm", "must be snake_case"),
        ("7dof.toml", "arm_7dof", "must be snake_case"),
        ("fn.toml", "arm_fn", "is a keyword of Rust"),
        ("arm.toml", "my_arm", "would become a type"),
        ("\u{3b1}.toml", "my_arm", "must be snake_case"),
        ("noextension", "noextension", ""),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let said = stderr(&new_in(folder.path(), &[file]).code(0));
        assert_eq!(
            said.contains("the arm is called"),
            !why.is_empty(),
            "{said}"
        );
        assert!(said.contains(why), "{said}");
        let table = folder.path().join(file);
        let checked = stdout(&ulna(&["check", table.to_str().unwrap()]).code(0).stderr(""));
        assert!(checked.contains(&format!(" {name}, as")), "{checked}");
    }
}
