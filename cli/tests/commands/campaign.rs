//! `ulna campaign`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use serde_json::Value;

#[cfg(unix)]
use crate::support::{at, make_pipe};
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
    let names: Vec<_> = text.lines().next().unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|found| *found == name).unwrap();
    let rows: Vec<_> = text.lines().skip(1).collect();
    assert_eq!(rows.len(), 60);
    // Every joint in turn, and each case another motion.
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<_> = row.split(',').collect();
        assert_eq!(cells.len(), names.len());
        assert_eq!(cells[0], i.to_string());
        assert_eq!(cells[1], (i % 7 + 1).to_string());
        let number = |name: &str| cells[column(name)].parse::<f64>().unwrap();
        // No compensation that keeps the force leaves less than the limit, but for the rounding of torques of some hundred N·m.
        for law in ["eq20", "after_only", "on_line"] {
            assert!(
                number("limit") <= number(law) * (1.0 + 1e-9) + 1e-12,
                "{law}: {row}"
            );
            assert!(
                number(&format!("{law}_max_force_error")) < 1e-6,
                "{law}: {row}"
            );
        }
        assert!(number("eq20") <= number("before") * (1.0 + 1e-9), "{row}");
    }
    summary_is_of_the_rows(&one, &text);
    let befores: BTreeSet<_> = rows.iter().map(|row| row.split(',').nth(3)).collect();
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

/// The page and its numbers say of joint 1 what its rows say.
fn summary_is_of_the_rows(output: &Path, csv: &str) {
    let mut lines = csv.lines();
    let names: Vec<_> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|found| *found == name).unwrap();
    let rows: Vec<Vec<_>> = lines.map(|line| line.split(',').collect()).collect();
    let of_first = |name: &str| -> Vec<f64> {
        let rows = rows.iter().filter(|row| row[1] == "1");
        rows.map(|row| row[column(name)].parse().unwrap()).collect()
    };
    let text = fs::read_to_string(output.join("campaign-summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["cases"], 60);
    assert_eq!(summary["task"], 3);
    assert_eq!(summary["joints"].as_array().unwrap().len(), 7);
    let first = &summary["joints"][0];
    let worst = |values: Vec<f64>| values.into_iter().fold(0.0, f64::max);
    for (law, key, name) in [
        (0, "impact", "eq16"),
        (0, "force_error_at_lock", "eq16_force_error"),
        (0, "max_force_error", "eq16_max_force_error"),
        (1, "max_force_error", "eq20_max_force_error"),
        (2, "max_force_error", "kinematic_max_force_error"),
        (3, "impact", "after_only"),
        (4, "impact", "on_line"),
        (5, "impact", "limit"),
    ] {
        assert_eq!(
            first["laws"][law][key]["worst"],
            worst(of_first(name)),
            "{name}"
        );
    }
    let (before, after) = (of_first("before"), of_first("eq20"));
    let worse = before
        .iter()
        .zip(&after)
        .filter(|(before, after)| after > before);
    let share = |cases: usize| cases as f64 / before.len() as f64;
    assert_eq!(first["laws"][1]["made_worse"], share(worse.count()));
    let joints = of_first("eq20_worse_joints").into_iter();
    let cases = joints.filter(|joints| *joints > 0.0).count();
    assert!(cases > 0);
    assert_eq!(first["laws"][1]["a_joint_made_worse"], share(cases));
    // After the lock alone there is less to do than before and after it, and never harm.
    for row in &rows {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert!(number("limit") <= number("after_only") * (1.0 + 1e-9));
        assert!(number("after_only") <= number("before") * (1.0 + 1e-9));
        assert!(number("eq16_force_error") <= number("eq16_max_force_error") * (1.0 + 1e-9));
        assert!(number("eq20_max_force_error") < 1e-6);
    }
    let page = fs::read_to_string(output.join("campaign.md")).unwrap();
    assert!(page.contains("| 1 | `eq16` | "), "{page}");
    for law in [
        "eq16",
        "eq20",
        "kinematic",
        "after_only",
        "on_line",
        "limit",
    ] {
        let [sentence, legend] = [" leaves ", ": "].map(|then| format!("- `{law}`{then}"));
        assert!(page.contains(&sentence) && page.contains(&legend), "{page}");
    }
    assert!(
        page.contains("and the force errors of Eq. 16 and Eq. 16, kinematic"),
        "{page}"
    );
}

/// Laws that were not chosen have no columns, no lines and no panels; those of the others are the same, and no rows are mixed.
#[test]
fn chosen_laws_have_the_columns_and_are_those_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let [all, some] = ["all", "some"].map(|name| folder.path().join(name));
    let scenario = folder.path().join("some.toml");
    let text = include_str!("../../../scenarios/paper_like.toml");
    let chosen = text.replacen(
        "[campaign]\n",
        "[campaign]\nlaws = [\"on_line\", \"eq20\"]\n",
        1,
    );
    fs::write(&scenario, chosen).unwrap();
    let scenario = scenario.to_str().unwrap();
    let run = |output: &Path, cases: &str| {
        let output = output.to_str().unwrap();
        ulna(&["campaign", scenario, "--cases", cases, "--output", output])
    };
    campaign(&all, &["--cases", "20"]).code(0);
    let out = stdout(&run(&some, "20").code(0));
    let titles: Vec<_> = out.lines().nth(2).unwrap().split_whitespace().collect();
    assert_eq!(titles, ["joint", "before", "eq20", "on_line"], "{out}");
    assert!(!out.contains("force error"), "{out}");
    let columns = |text: &str| -> Vec<(String, Vec<String>)> {
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',');
        let rows: Vec<Vec<_>> = lines.map(|line| line.split(',').collect()).collect();
        let column = |(i, name): (usize, &str)| {
            let cells = rows.iter().map(|row| row[i].to_owned());
            (name.to_owned(), cells.collect())
        };
        names.enumerate().map(column).collect()
    };
    let (of_all, of_some) = (columns(&csv(&all)), columns(&csv(&some)));
    assert_eq!((of_all.len(), of_some.len()), (7 + 6 * 4, 7 + 2 * 4));
    for column in of_some {
        assert!(of_all.contains(&column), "{}", column.0);
    }
    let svg = fs::read_to_string(some.join("figures/campaign.svg")).unwrap();
    assert!(svg.contains("on line") && !svg.contains("Eq. 16"));
    let page = fs::read_to_string(some.join("campaign.md")).unwrap();
    assert!(
        page.contains("| all | `on_line` |") && !page.contains("eq16"),
        "{page}"
    );

    // It goes on as any other, and beside other laws' rows there is nothing to add.
    let err = stderr(&run(&some, "30").code(0));
    assert!(err.contains("20 of 30 cases are in"), "{err}");
    let before = csv(&all);
    let err = stderr(&run(&all, "30").code(1).stdout(""));
    assert!(err.contains("with other columns, by other `laws`"), "{err}");
    assert_eq!(csv(&all), before);
}

#[test]
fn a_file_with_the_columns_of_an_older_program_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    campaign(output, &["--cases", "10"]).code(0);
    let old = csv(output).replacen(",after_only", "", 1);
    fs::remove_file(output.join("campaign.csv")).unwrap();
    fs::write(output.join("campaign.csv.partial"), &old).unwrap();
    let err = stderr(&campaign(output, &["--cases", "10"]).code(1).stdout(""));
    let message = "campaign.csv.partial is no file of a campaign, or of one with other columns, by other `laws` or an older program; remove it";
    assert!(err.contains(message), "{err}");
}

#[test]
fn an_interrupted_file_is_continued_and_a_whole_one_left() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    let partial = output.join("campaign.csv.partial");
    campaign(output, &["--cases", "70"]).code(0);
    let all = csv(output);
    for name in ["campaign.csv", "campaign.json"] {
        fs::remove_file(output.join(name)).unwrap();
    }
    campaign(output, &["--cases", CASES]).code(0);
    let whole = csv(output);
    assert!(all.starts_with(&whole));
    // Killed while rows were added: what is behind the record is cut off somewhere, and may be anything.
    for tail in [
        &all[whole.len()..all.len() - 200],
        "59,2,0.5,1\n",
        "\0\0\0\0",
        "",
    ] {
        let _ = fs::remove_file(output.join("campaign.csv"));
        fs::write(&partial, format!("{whole}{tail}")).unwrap();
        let record = fs::read(output.join("campaign.json")).unwrap();
        let err = stderr(&campaign(output, &["--cases", "70"]).code(0));
        assert!(err.contains("60 of 70 cases are in"), "{err}");
        assert!(err.contains("10 cases in "), "{err}");
        assert_eq!(csv(output), all);
        assert!(!partial.exists());
        fs::write(output.join("campaign.json"), record).unwrap();
    }
    // A record without rows is that of none.
    fs::remove_file(output.join("campaign.csv")).unwrap();
    campaign(output, &["--cases", CASES]).code(0);
    assert_eq!(csv(output), whole);

    let modified = || {
        let modified = |name| fs::metadata(output.join(name)).unwrap().modified().unwrap();
        ["campaign.csv", "campaign.json"].map(modified)
    };
    let before = modified();
    let err = stderr(&campaign(output, &["--cases", CASES]).code(0));
    assert!(
        err.contains("60 of 60 cases are in") && !err.contains(" a second"),
        "{err}"
    );
    assert_eq!(modified(), before);

    // More cases go on from there; those that are there stay as they are.
    campaign(output, &["--cases", "70"]).code(0);
    assert_eq!(csv(output), all);
    // Fewer are read, and no row is lost.
    let out = stdout(&campaign(output, &["--cases", "10"]).code(0));
    assert!(out.contains(", 10 cases, "), "{out}");
    assert_eq!(csv(output), all);
}

#[test]
fn another_campaigns_file_is_refused_and_left() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out");
    campaign(&output, &["--cases", "10"]).code(0);
    let before = csv(&output);
    let refused = |arguments: &[&str], message: &str| {
        let err = stderr(&campaign(&output, arguments).code(1).stdout(""));
        assert!(err.contains(message), "{message} is missing in:\n{err}");
        assert!(err.contains("choose another --output"), "{err}");
    };
    refused(
        &["--cases", "20", "--seed", "7"],
        "campaign.csv has the seed 2026, not 7; remove it",
    );
    // A case that is made again comes out alike by most of such changes.
    let scenario = folder.path().join("other.toml");
    for (from, to) in [
        ("goal = [1.474", "goal = [1.475"),
        ("force_spread = 20.0", "force_spread = 20.1"),
        ("rated_torque = \"none\"", "rated_torque = 1e6"),
        ("failure_times = 20 ", "failure_times = 21 "),
        ("step_time = 0.0 ", "step_time = 1e-9 "),
        (
            "projector = \"static\" ",
            "projector = \"dynamically_consistent\" ",
        ),
        ("arm = \"ssrms\"", "arm = \"my_arm.toml\""),
    ] {
        let text = include_str!("../../../scenarios/paper_like.toml");
        assert!(text.contains(from), "{from}");
        fs::write(&scenario, text.replacen(from, to, 1)).unwrap();
        let arm = include_str!("../../../arms/ssrms.toml");
        let arm = arm.replacen("mass = 42.5", "mass = 42.6", 1);
        fs::write(folder.path().join("my_arm.toml"), arm).unwrap();
        let [scenario, output] = [&scenario, &output].map(|path| path.to_str().unwrap());
        let run = ulna(&["campaign", scenario, "--output", output, "--cases", "20"]);
        let err = stderr(&run.code(1).stdout(""));
        assert!(
            err.contains("is of another scenario or another arm; remove it"),
            "{to}: {err}"
        );
    }
    assert_eq!(csv(&output), before);

    let record = output.join("campaign.json");
    let text = fs::read_to_string(&record).unwrap();
    let older = text.replace("\"ulna ", "\"ulna 0.0.0-");
    assert_ne!(older, text);
    fs::write(&record, older).unwrap();
    refused(&["--cases", "20"], "campaign.csv was made by ulna 0.0.0-");
    fs::write(&record, "{}").unwrap();
    refused(
        &["--cases", "20"],
        "campaign.json is no record of one; remove it",
    );
    fs::remove_file(&record).unwrap();
    refused(
        &["--cases", "20"],
        "campaign.json is not there or cannot be read; remove it",
    );
    assert_eq!(csv(&output), before);
    fs::write(output.join("campaign.csv"), "time,torque\n1,2\n").unwrap();
    refused(&["--cases", "10"], "is no file of a campaign");
    assert_eq!(csv(&output), "time,torque\n1,2\n");
}

/// It is the arm that counts and not its text or what computes it: code that was compiled in and code made of the table now have the same bits.
#[test]
fn an_own_table_of_the_same_arm_is_the_same_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let [known, own] = ["known", "own"].map(|name| folder.path().join(name));
    let scenario = folder.path().join("other.toml");
    let text = include_str!("../../../scenarios/paper_like.toml");
    let text = text.replacen("arm = \"ssrms\"", "arm = \"my_arm.toml\"", 1);
    fs::write(&scenario, text).unwrap();
    let arm = include_str!("../../../arms/ssrms.toml");
    fs::write(folder.path().join("my_arm.toml"), format!("# Mine.\n{arm}")).unwrap();
    let run = |output: &Path, cases: &str| {
        let [scenario, output] = [scenario.as_path(), output].map(|path| path.to_str().unwrap());
        ulna(&["campaign", scenario, "--output", output, "--cases", cases])
    };
    campaign(&known, &["--cases", CASES]).code(0);
    run(&own, CASES).code(0);
    for name in ["campaign.csv", "campaign.json"] {
        let [known, own] = [&known, &own].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(known == own, "{name}");
    }
    let err = stderr(&run(&known, "70").code(0));
    assert!(err.contains("60 of 70 cases are in"), "{err}");

    // Other machines may round otherwise, and the textbook does.
    let record = known.join("campaign.json");
    let text = fs::read_to_string(&record).unwrap();
    let arithmetic: Value = serde_json::from_str(&text).unwrap();
    let arithmetic = arithmetic["arithmetic"].as_str().unwrap();
    for (from, to, message) in [
        (
            arithmetic,
            "none",
            "was computed with other arithmetic (none, not ",
        ),
        (
            "\"generated\"",
            "\"textbook\"",
            "was computed by the textbook's formulas, not generated code",
        ),
    ] {
        assert!(text.contains(from), "{from} in {text}");
        fs::write(&record, text.replace(from, to)).unwrap();
        let err = stderr(&campaign(&known, &["--cases", "80"]).code(1).stdout(""));
        assert!(err.contains(message), "{err}");
    }
}

#[test]
fn a_changed_row_is_found_wherever_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    campaign(output, &["--cases", "20"]).code(0);
    let whole = csv(output);
    let lines: Vec<_> = whole.split_inclusive('\n').collect();
    let changed = |edit: &dyn Fn(&mut Vec<String>)| {
        let mut lines: Vec<_> = lines.iter().map(ToString::to_string).collect();
        edit(&mut lines);
        lines.concat()
    };
    let mut texts = vec![
        changed(&|lines| lines.swap(5, 6)),
        changed(&|lines| drop(lines.remove(9))),
        changed(&|lines| lines.push(lines[20].clone())),
        changed(&|lines| lines[12] = "not a row\n".to_owned()),
        whole[..whole.len() / 2].to_owned(),
    ];
    // One digit of each row.
    texts.extend((1..=20).map(|row| {
        changed(&|lines| {
            let digit = lines[row].rfind(|c: char| c.is_ascii_digit()).unwrap();
            let other = if &lines[row][digit..=digit] == "1" {
                "2"
            } else {
                "1"
            };
            lines[row].replace_range(digit..=digit, other);
        })
    }));
    for text in texts {
        fs::write(output.join("campaign.csv"), &text).unwrap();
        let err = stderr(&campaign(output, &["--cases", "20"]).code(1).stdout(""));
        assert!(
            err.contains("campaign.csv has been changed; remove it, or choose"),
            "{err}"
        );
        assert_eq!(csv(output), text);
    }
    // In the file under way as well.
    fs::remove_file(output.join("campaign.csv")).unwrap();
    let partial = output.join("campaign.csv.partial");
    fs::write(&partial, changed(&|lines| lines.swap(5, 6))).unwrap();
    let err = stderr(&campaign(output, &["--cases", "30"]).code(1).stdout(""));
    assert!(
        err.contains("campaign.csv.partial has been changed"),
        "{err}"
    );
}

#[test]
fn one_run_at_a_time_works_in_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    campaign(output, &["--cases", "10"]).code(0);
    let before = csv(output);
    let lock = output.join("campaign.lock");
    // The file alone is in nobody's way.
    let held = fs::File::options()
        .read(true)
        .write(true)
        .open(&lock)
        .unwrap();
    held.try_lock().unwrap();
    fs::write(&lock, "4711\n").unwrap();
    let err = stderr(&campaign(output, &["--cases", "20"]).code(1).stdout(""));
    let message = "error: process 4711 makes a campaign in ";
    assert!(err.starts_with(message), "{err}");
    assert!(
        err.contains("wait for its end, or choose another --output"),
        "{err}"
    );
    assert_eq!(csv(output), before);
    drop(held);
    campaign(output, &["--cases", "20"]).code(0);
}

/// Two at once: whichever comes second is refused, or has come late enough to find all rows.
#[test]
fn two_runs_at_once_do_not_mix_their_rows() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    let runs = std::thread::scope(|scope| {
        let run = || campaign(output, &["--cases", CASES]);
        let runs = [scope.spawn(run), scope.spawn(run)];
        runs.map(|run| run.join().unwrap())
    });
    let codes: BTreeSet<_> = runs
        .iter()
        .map(|run| run.get_output().status.code())
        .collect();
    assert!(codes.contains(&Some(0)), "{codes:?}");
    for run in &runs {
        let err = stderr(run);
        let said = err.contains("makes a campaign in ");
        assert_eq!(
            run.get_output().status.code(),
            Some(i32::from(said)),
            "{err}"
        );
    }
    let alone = folder.path().join("alone");
    campaign(&alone, &["--cases", CASES]).code(0);
    assert_eq!(csv(output), csv(&alone));
}

#[test]
#[cfg(unix)]
fn links_and_pipes_in_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let [output, store] = ["out", "store"].map(|name| folder.path().join(name));
    for folder in [&output, &store] {
        fs::create_dir(folder).unwrap();
    }
    // The rows are where the link leads.
    std::os::unix::fs::symlink("../store/rows.csv", output.join("campaign.csv")).unwrap();
    campaign(&output, &["--cases", "10"]).code(0);
    assert_eq!(at(&output.join("campaign.csv")), "../store/rows.csv");
    assert_eq!(at(&store), "rows.csv");
    for name in [
        "campaign.csv",
        "campaign.csv.partial",
        "campaign.json",
        "campaign.lock",
    ] {
        let output = folder.path().join(name);
        fs::create_dir(&output).unwrap();
        make_pipe(&output.join(name));
        let err = stderr(&campaign(&output, &["--cases", "10"]).code(1).stdout(""));
        assert!(
            err.contains("it is a pipe, no regular file"),
            "{name}: {err}"
        );
    }
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    for arguments in [
        &["campaign"][..],
        &["campaign", "x.toml", "--cases", "0"],
        &["campaign", "x.toml", "--cases", "1000000000001"],
        &["campaign", "x.toml", "--threads", "0"],
    ] {
        ulna(arguments).code(2).stdout("");
    }
}
