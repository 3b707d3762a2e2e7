//! `ulna check`.

#[cfg(unix)]
use crate::support::make_pipe;
use crate::support::{folder_with_bad_table, stderr, stdout, ulna};

#[test]
fn good_tables_give_a_summary_each() {
    let run = ulna(&["check", "arms/ssrms.toml", "arms/oblique_6.toml"])
        .code(0)
        .stderr("");
    let out = stdout(&run);
    assert!(out.contains("arms/ssrms.toml: ok"), "{out}");
    assert!(out.contains("ssrms, as a type Ssrms"), "{out}");
    assert!(out.contains("7: R R R R R R R"), "{out}");
    assert!(out.contains("6: R R P R R R"), "{out}");
    assert!(out.contains("x y z rx ry\n"), "{out}");
    assert!(!out.contains("joint names"), "{out}");

    let out = stdout(&ulna(&["check", "arms/geared_6.toml"]).code(0).stderr(""));
    assert!(
        out.contains("  joint names    1 turntable, 2 lift, 3 shoulder, "),
        "{out}"
    );
    assert!(out.contains("  limits         6 of 6 joints\n"), "{out}");
    assert!(out.contains("  motors         5 of 6 joints\n"), "{out}");
    assert!(out.contains("  friction       6 of 6 joints\n"), "{out}");
}

#[test]
fn bad_tables_give_every_error_and_good_ones_beside_them_their_summary() {
    let folder = folder_with_bad_table();
    let bad = folder.path().join("bad.toml");
    let bad = bad.to_str().unwrap();
    let run = ulna(&["check", bad, "arms/planar_2r.toml", "arms/absent.toml"]).code(1);
    let out = stdout(&run);
    assert!(out.starts_with("arms/planar_2r.toml: ok\n"), "{out}");
    let err = stderr(&run);
    for message in [
        "error: missing key `alpha` of joint 2",
        "error: `mass` of joint 2 is out of bounds",
        &format!("{bad}:28:1"),
        "error: cannot read the file",
        "arms/absent.toml",
    ] {
        assert!(err.contains(message), "{message} is missing in:\n{err}");
    }
    assert!(!err.contains('\u{1b}'), "colour in a pipe:\n{err}");
}

#[test]
fn a_file_of_the_other_kind_is_told_by_whom_it_is_taken() {
    for (command, file, message) in [
        (
            "check",
            "scenarios/tool_path.toml",
            "`ulna reproduce` and `ulna campaign` take a scenario",
        ),
        (
            "reproduce",
            "arms/ssrms.toml",
            "`ulna check`, `ulna generate`, `ulna verify` and `ulna cost` take an arm's table",
        ),
        (
            "campaign",
            "arms/ssrms.toml",
            "this looks like an arm's table, not a scenario",
        ),
    ] {
        let err = stderr(&ulna(&[command, file]).code(1).stdout(""));
        assert!(err.contains(message), "{err}");
        assert_eq!(err.matches("error: ").count(), 1, "{err}");
    }
}

#[test]
fn the_mass_is_printed_as_it_would_be_added_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sum.toml");
    // In doubles 15.062032 + 1.0000000000000002 is 16.062032000000002.
    let text = include_str!("../../../arms/planar_2r.toml")
        .replacen("mass = 1.0", "mass = 15.062032", 1)
        .replace("mass = 1.0\n", "mass = 1.0000000000000002\n");
    std::fs::write(&path, text).unwrap();
    let out = stdout(&ulna(&["check", path.to_str().unwrap()]).code(0));
    assert!(out.contains("moving mass    16.062032 kg\n"), "{out}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_stdout_is_told() {
    use std::process::Command;
    let full = std::fs::File::options().write(true).open("/dev/full");
    let output = Command::new(assert_cmd::cargo::cargo_bin("ulna"))
        .args(["help", "table"])
        .stdout(full.unwrap())
        .output()
        .unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert!(
        err.contains("error: cannot write to the standard output: "),
        "{err}"
    );
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn a_task_of_dependent_rows_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let flat =
        include_str!("../../../arms/planar_2r.toml").replace("[\"x\", \"y\"]", "[\"x\", \"z\"]");
    let path = folder.path().join("flat.toml");
    std::fs::write(&path, flat).unwrap();
    let run = ulna(&["check", path.to_str().unwrap()]).code(0);
    let err = stderr(&run);
    assert!(
        err.starts_with("warning: ") && err.contains("w_D is 0 in every configuration"),
        "{err}"
    );
}

#[test]
#[cfg(unix)]
fn no_name_of_a_file_moves_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a\u{1b}[31m.toml");
    let flat =
        include_str!("../../../arms/planar_2r.toml").replace("[\"x\", \"y\"]", "[\"x\", \"z\"]");
    std::fs::write(&path, flat).unwrap();
    let err = stderr(&ulna(&["check", path.to_str().unwrap()]).code(0));
    assert!(err.contains("a\\u{1b}[31m.toml: w_D is 0"), "{err}");
    assert!(!err.contains('\u{1b}'), "{err}");
}

#[test]
#[cfg(unix)]
fn a_pipe_is_refused_and_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.toml");
    make_pipe(&pipe);
    let pipe = pipe.to_str().unwrap();
    for command in [
        "check",
        "generate",
        "cost",
        "verify",
        "reproduce",
        "campaign",
    ] {
        let err = stderr(&ulna(&[command, pipe]).code(1).stdout(""));
        assert!(err.contains("this is no regular file"), "{command}: {err}");
    }
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    for arguments in [
        &["check"][..],
        &["chekc", "arms/ssrms.toml"],
        &["check", "--colour", "x"],
    ] {
        ulna(arguments).code(2).stdout("");
    }
}

#[test]
#[cfg(unix)]
fn a_reader_that_hangs_up_is_no_error() {
    use std::process::{Command, Stdio};
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("ulna"))
        .current_dir(root)
        .args(["check", "arms/ssrms.toml"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
}

#[test]
fn what_a_data_sheet_says_is_printed() {
    let out = stdout(&ulna(&["check", "arms/planar_2r.toml"]).code(0).stderr(""));
    for line in [
        "  tool at q = 0  2 0 0 m, rpy 0 0 0 deg, in the world\n",
        "  reach          2 m, the farthest found of the tool from the origin of frame 1\n",
        // Two rods of 1 kg, and one.
        "  held at q = 0  joint 1 19.62 N m, joint 2 4.905 N m\n",
    ] {
        assert!(out.contains(line), "{out}");
    }
    let out = stdout(&ulna(&["check", "arms/geared_6.toml"]).code(0));
    // All masses but the turntable's hang on the lift, upright but for a base that leans.
    assert!(out.contains(", lift 538.2069 N, shoulder "), "{out}");
    let out = stdout(&ulna(&["check", "arms/ssrms.toml"]).code(0));
    assert!(out.contains("  reach ") && !out.contains("held"), "{out}");
}

#[test]
fn what_is_suspicious_is_a_warning_until_the_table_allows_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rods.toml");
    let rods = include_str!("../../../arms/planar_2r.toml")
        .replace("0.0834895833333333", "83489.5833333333")
        .replace("[\"x\", \"y\"]", "[\"x\", \"z\"]");
    std::fs::write(&path, &rods).unwrap();
    let run = ulna(&["check", path.to_str().unwrap()]).code(0);
    let err = stderr(&run);
    assert_eq!(err.matches("warning: ").count(), 3, "{err}");
    assert!(err.contains("kg mm^2 (1 is 1e-6 kg m^2)"), "{err}");
    assert!(stdout(&run).contains("rods.toml: ok\n"));

    let allowed = format!("allow = [\"large_inertia\", \"singular_task\"]\n{rods}");
    std::fs::write(&path, allowed).unwrap();
    for command in ["check", "generate", "cost"] {
        ulna(&[command, path.to_str().unwrap()]).code(0).stderr("");
    }
}
