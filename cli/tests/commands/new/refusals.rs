//! What is refused, with what to do, and leaves everything as it was.

use std::fs;

use super::{files_of, new_in};
use crate::support::{folder_with_bad_table, stderr};

#[test]
fn what_is_there_stays() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("my_arm.toml"), "precious").unwrap();
    fs::create_dir(folder.path().join("folder.toml")).unwrap();
    for name in ["my_arm.toml", "folder.toml"] {
        let said = stderr(&new_in(folder.path(), &[name]).code(1));
        let remedy = format!(
            "error: {name} is there already, and stays as it is: name a new file, or `ulna check {name}`"
        );
        assert!(said.contains(&remedy), "{said}");
    }
    assert_eq!(
        fs::read_to_string(folder.path().join("my_arm.toml")).unwrap(),
        "precious"
    );
    assert_eq!(files_of(folder.path()), ["folder.toml/", "my_arm.toml"]);
}

#[test]
#[cfg(unix)]
fn a_link_that_leads_nowhere_is_there_too() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("my_arm.toml");
    std::os::unix::fs::symlink("elsewhere.toml", link).unwrap();
    let said = stderr(&new_in(folder.path(), &["my_arm.toml"]).code(1));
    assert!(said.contains("is there already"), "{said}");
    assert!(!folder.path().join("elsewhere.toml").exists());
}

#[test]
fn a_path_that_no_file_can_have_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let said = stderr(&new_in(folder.path(), &["no/my_arm.toml"]).code(1));
    assert!(
        said.contains("the folder no is not there; make it"),
        "{said}"
    );
    let said = stderr(&new_in(folder.path(), &[".."]).code(1));
    assert!(said.contains("is there already"), "{said}");
    let said = stderr(&new_in(folder.path(), &["no/.."]).code(1));
    assert!(said.contains("names no file"), "{said}");
    assert!(files_of(folder.path()).is_empty());
}

#[test]
fn a_bad_table_makes_no_crate() {
    let folder = folder_with_bad_table();
    let said = stderr(&new_in(folder.path(), &["--crate", "robot", "bad.toml"]).code(1));
    assert!(said.contains("missing key `alpha` of joint 2"), "{said}");
    assert!(
        said.contains("`mass` of joint 2 is out of bounds"),
        "{said}"
    );
    assert_eq!(files_of(folder.path()), ["bad.toml"]);
}

#[test]
fn a_folder_with_something_in_it_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("robot")).unwrap();
    fs::write(folder.path().join("robot/.hidden"), "precious").unwrap();
    fs::write(folder.path().join("file"), "precious").unwrap();
    let said = stderr(&new_in(folder.path(), &["--crate", "robot", "my_arm.toml"]).code(1));
    let remedy = "error: the folder robot is not empty, and stays as it is: name a new folder";
    assert!(said.contains(remedy), "{said}");
    let said = stderr(&new_in(folder.path(), &["--crate", "file", "my_arm.toml"]).code(1));
    assert!(
        said.contains("error: file is a file: name a new folder"),
        "{said}"
    );
    let said = stderr(&new_in(folder.path(), &["--crate", "file/in", "my_arm.toml"]).code(1));
    assert!(said.contains("cannot make the folder file/in"), "{said}");
    assert_eq!(files_of(folder.path()), ["file", "robot/.hidden"]);
}

#[test]
fn a_path_that_is_no_checkout_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["--crate", "robot", "my_arm.toml", "--path", "."];
    let said = stderr(&new_in(folder.path(), &arguments).code(1));
    assert!(said.contains("error: . is no checkout of ulna: "), "{said}");
    assert!(
        said.contains("name the root folder of its repository"),
        "{said}"
    );
    assert!(files_of(folder.path()).is_empty());
    // It is of a crate alone.
    new_in(folder.path(), &["my_arm.toml", "--path", "."]).code(2);
    assert!(files_of(folder.path()).is_empty());
}

/// Every file above half a KiB fails, after shorter ones have been written.
#[test]
#[cfg(unix)]
fn where_there_is_no_room_nothing_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let program = assert_cmd::cargo::cargo_bin("ulna");
    for arguments in ["my_arm.toml", "--crate deep/robot my_arm.toml"] {
        let line = format!(
            "trap '' XFSZ; ulimit -f 1; exec '{}' new {arguments}",
            program.display()
        );
        let mut shell = assert_cmd::Command::new("sh");
        let run = shell
            .current_dir(folder.path())
            .args(["-c", &line])
            .assert();
        let said = stderr(&run.code(1).stdout(""));
        assert!(said.contains("error: cannot write "), "{said}");
        assert!(
            files_of(folder.path()).is_empty(),
            "{:?}",
            files_of(folder.path())
        );
    }
}
