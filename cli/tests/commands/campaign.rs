//! `ulna campaign`.

use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;

use crate::support::{stderr, stdout, ulna};

const CASES: &str = "60";

fn campaign(output: &Path, arguments: &[&str]) -> Assert {
    let output = output.to_str().unwrap();
    let fixed = ["campaign", "scenarios/paper_like.toml", "--output", output];
    ulna(&[&fixed[..], arguments].concat())
}

fn csv(output: &Path) -> String {
    fs::read_to_string(output.join("campaign.csv")).unwrap()
}

#[test]
fn the_file_does_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
    let first = campaign(&one, &["--cases", CASES, "--threads", "1"]).code(0);
    let second = campaign(&two, &["--cases", CASES, "--threads", "2"]).code(0);
    assert_eq!(csv(&one), csv(&two));
    assert_eq!(stdout(&first), stdout(&second));
    let text = csv(&one);
    let rows: Vec<_> = text.lines().skip(1).collect();
    assert_eq!(rows.len(), 60);
    // Every joint in turn, and each case another motion.
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<_> = row.split(',').collect();
        assert_eq!(cells[0], i.to_string());
        assert_eq!(cells[1], (i % 7 + 1).to_string());
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap();
        // No compensation that keeps the force leaves less than the optimal one.
        assert!(number(6) <= number(5) * (1.0 + 1e-9), "{row}");
        assert!(number(5) <= number(3) * (1.0 + 1e-9), "{row}");
    }
    let befores: std::collections::BTreeSet<_> =
        rows.iter().map(|row| row.split(',').nth(3)).collect();
    assert_eq!(befores.len(), 60);
    for kind in ["svg", "png"] {
        assert!(one.join(format!("figures/campaign.{kind}")).exists());
    }
    let err = stderr(&first);
    assert!(
        err.contains("60 cases in ") && err.contains(" a second"),
        "{err}"
    );
    assert!(!err.contains('\u{1b}'), "a progress bar in a pipe:\n{err}");
}

#[test]
fn an_interrupted_file_is_continued_and_a_whole_one_left() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    campaign(output, &["--cases", CASES]).code(0);
    let whole = csv(output);
    // Cut off in the middle of a row, as by a loss of power.
    fs::remove_file(output.join("campaign.csv")).unwrap();
    let cut = &whole[..whole.len() / 2];
    fs::write(output.join("campaign.csv.partial"), cut).unwrap();
    let run = campaign(output, &["--cases", CASES]).code(0);
    let kept = cut.lines().count() - 2;
    let err = stderr(&run);
    assert!(err.contains(&format!("{kept} of 60 cases are in")), "{err}");
    assert!(err.contains(&format!("{} cases in ", 60 - kept)), "{err}");
    assert_eq!(csv(output), whole);
    assert!(!output.join("campaign.csv.partial").exists());

    let modified = fs::metadata(output.join("campaign.csv"))
        .unwrap()
        .modified()
        .unwrap();
    let err = stderr(&campaign(output, &["--cases", CASES]).code(0));
    assert!(
        err.contains("60 of 60 cases are in") && !err.contains(" a second"),
        "{err}"
    );
    assert_eq!(
        fs::metadata(output.join("campaign.csv"))
            .unwrap()
            .modified()
            .unwrap(),
        modified
    );

    // More cases go on from there; those that are there stay as they are.
    campaign(output, &["--cases", "70"]).code(0);
    assert!(csv(output).starts_with(&whole));
    assert_eq!(csv(output).lines().count(), 71);
}

#[test]
fn another_campaigns_file_is_refused_and_left() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    campaign(output, &["--cases", "10"]).code(0);
    let before = csv(output);
    let err = stderr(
        &campaign(output, &["--cases", "20", "--seed", "7"])
            .code(1)
            .stdout(""),
    );
    assert!(
        err.contains("error: case 0 of") && err.contains("choose another --output"),
        "{err}"
    );
    assert_eq!(csv(output), before);
    fs::write(output.join("campaign.csv"), "time,torque\n1,2\n").unwrap();
    let err = stderr(&campaign(output, &["--cases", "10"]).code(1));
    assert!(err.contains("is no file of a campaign"), "{err}");
    assert_eq!(csv(output), "time,torque\n1,2\n");
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    for arguments in [
        &["campaign"][..],
        &["campaign", "x.toml", "--cases", "0"],
        &["campaign", "x.toml", "--threads", "0"],
    ] {
        ulna(arguments).code(2).stdout("");
    }
}
