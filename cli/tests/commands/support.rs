//! The program, run as a user runs it.

use std::path::Path;

use assert_cmd::Command;
use assert_cmd::assert::Assert;

/// The repository's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// `ulna` with `arguments`, in the repository's root.
pub(crate) fn ulna(arguments: &[&str]) -> Assert {
    let mut command = Command::cargo_bin("ulna").unwrap();
    command
        .current_dir(root())
        .env_remove("NO_COLOR")
        .args(arguments)
        .assert()
}

pub(crate) fn stdout(run: &Assert) -> String {
    String::from_utf8(run.get_output().stdout.clone()).unwrap()
}

pub(crate) fn stderr(run: &Assert) -> String {
    String::from_utf8(run.get_output().stderr.clone()).unwrap()
}

/// A folder with `name`: the paper-like scenario with each of `edits`, from one text to another.
pub(crate) fn edited_scenario<'e>(
    name: &str,
    edits: impl IntoIterator<Item = &'e (&'e str, &'e str)>,
) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut text = include_str!("../../../scenarios/paper_like.toml").to_owned();
    for (from, to) in edits {
        assert!(text.contains(from), "the scenario has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    std::fs::write(folder.path().join(name), text).unwrap();
    folder
}

/// A folder with `bad.toml`, whose joint 2 has neither a sensible mass nor an `alpha`.
pub(crate) fn folder_with_bad_table() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let good = include_str!("../../../arms/planar_2r.toml");
    let (first, second) = good.split_once("[[joint]] # elbow").unwrap();
    let second = second
        .replace("mass = 1.0", "mass = -1.0")
        .replace("alpha = 0.0\n", "");
    let bad = format!("{first}[[joint]]{second}");
    std::fs::write(folder.path().join("bad.toml"), bad).unwrap();
    folder
}

/// A table in `folder` of an arm of `joints` joints, the elbow of `planar_2r` again and again.
pub(crate) fn long_arm(folder: &Path, joints: usize) -> String {
    let planar = include_str!("../../../arms/planar_2r.toml");
    let (head, joint) = planar.rsplit_once("[[joint]]").unwrap();
    let long = format!(
        "{head}{}",
        format!("[[joint]]{joint}").repeat(joints.saturating_sub(1))
    );
    let table = folder.join(format!("long_{joints}.toml"));
    std::fs::write(&table, long).unwrap();
    table.to_str().unwrap().to_owned()
}

/// What stands at a path: a file's text, where a link leads, or the names in a folder.
#[cfg(unix)]
pub(crate) fn at(path: &Path) -> String {
    let found = std::fs::symlink_metadata(path).unwrap();
    if found.is_symlink() {
        std::fs::read_link(path).unwrap().display().to_string()
    } else if found.is_dir() {
        let entries = std::fs::read_dir(path).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names.join(" ")
    } else {
        std::fs::read_to_string(path).unwrap()
    }
}

/// A pipe at `path`, which nobody writes to.
#[cfg(unix)]
pub(crate) fn make_pipe(path: &Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status();
    assert!(made.unwrap().success());
}

/// The lines of the help of `command`, or without one of the program, that show how it is called.
pub(crate) fn examples(command: &str) -> Vec<String> {
    let arguments = match command {
        "" => vec!["--help"],
        command => vec![command, "--help"],
    };
    let help = stdout(&ulna(&arguments).code(0).stderr(""));
    let (_, examples) = help
        .split_once("Example")
        .unwrap_or_else(|| panic!("no example:\n{help}"));
    let calls = examples
        .lines()
        .filter_map(|line| line.trim().strip_prefix("ulna "));
    calls.map(str::to_owned).collect()
}

/// A scenario of one short motion from `start` to `goal` (degrees, as lists) of the arm `arm`, a joint of which locks on the way.
/// What is to be below it in the file can be added.
pub(crate) fn short_scenario(arm: &str, start: &str, goal: &str) -> String {
    format!(
        r#"
name = "short"
arm = "{arm}"
angle_unit = "deg"
[motion]
kind = "joint"
angles = "q"
start = {start}
goal = {goal}
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
    )
}

/// A folder with `my_arm.toml`, the table of `planar_2r` under another name: an arm that the program is not compiled with.
pub(crate) fn folder_with_my_arm() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let table = include_str!("../../../arms/planar_2r.toml").replace("planar_2r", "my_arm");
    std::fs::write(folder.path().join("my_arm.toml"), table).unwrap();
    folder
}
