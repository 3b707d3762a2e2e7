//! `ulna campaign --shard` and `ulna merge`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use assert_cmd::assert::Assert;
use serde_json::Value;

use crate::support::{edited_scenario, root, stderr, stdout, ulna};

const CASES: &str = "60";
const SCENARIO: &str = "scenarios/paper_like.toml";

fn campaign(output: &Path, arguments: &[&str]) -> Assert {
    let fixed = ["campaign", SCENARIO, "--output", text(output)];
    ulna(&[&fixed[..], arguments].concat())
}

/// The shards that are named, of a campaign of [`CASES`].
fn make(output: &Path, shards: &[&str]) {
    for shard in shards {
        campaign(output, &["--cases", CASES, "--shard", shard])
            .code(0)
            .stdout("");
    }
}

fn merge(shards: &[&Path], output: &Path) -> Assert {
    let shards: Vec<_> = shards.iter().map(|path| text(path)).collect();
    ulna(&[&["merge"], &shards[..], &["--output", text(output)]].concat())
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for name in names(from) {
        fs::copy(from.join(&name), to.join(&name)).unwrap();
    }
}

/// The errors of a merge that is refused, and writes nothing.
fn refused(shards: &[&Path], output: &Path) -> Vec<String> {
    let there = names(output.parent().unwrap());
    let err = stderr(&merge(shards, output).code(1).stdout(""));
    assert_eq!(names(output.parent().unwrap()), there, "{err}");
    let errors = err.lines().map(|line| {
        let error = line.strip_prefix("error: ");
        error.unwrap_or_else(|| panic!("{err}")).to_owned()
    });
    errors.collect()
}

/// What is wrong has one error each, in any order.
fn are(errors: &[String], expected: &[&str]) {
    assert_eq!(errors.len(), expected.len(), "{errors:#?}");
    for part in expected {
        let found = errors.iter().filter(|error| error.contains(part)).count();
        assert_eq!(found, 1, "{part:?} in {errors:#?}");
    }
}

#[test]
fn shards_together_are_the_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, shared, alone, merged] =
        ["whole", "shared", "alone", "merged"].map(|name| folder.path().join(name));
    campaign(&whole, &["--cases", CASES]).code(0);
    // At once, as on one machine; one of them on as many threads as it likes.
    std::thread::scope(|scope| {
        for shard in ["1/4", "2/4", "4/4"] {
            let run = || make(&shared, &[shard]);
            scope.spawn(run);
        }
    });
    make(&alone, &["3/4"]);
    let expected: Vec<_> = ["csv", "json", "lock"]
        .map(|end| format!("campaign-0003-of-0004.{end}"))
        .into();
    assert_eq!(names(&alone), expected);
    let manifest = fs::read_to_string(alone.join("campaign-0003-of-0004.json")).unwrap();
    let manifest: Value = serde_json::from_str(&manifest).unwrap();
    for (key, value) in [
        ("cases", 60),
        ("shard", 3),
        ("shards", 4),
        ("first", 30),
        ("last", 44),
        ("rows", 15),
        ("seed", 2026),
    ] {
        assert_eq!(manifest[key], value, "{key} of {manifest}");
    }
    assert_eq!(manifest["laws"][0], "eq16");

    // As folder, as rows, as manifest, and one of them twice over: it counts once.
    fs::create_dir(&merged).unwrap();
    let rows = alone.join("campaign-0003-of-0004.csv");
    let output = merged.join("campaign.csv");
    let again = alone.join("campaign-0003-of-0004.json");
    let err = stderr(&merge(&[&shared, &rows, &again], &output).code(0).stdout(""));
    assert!(
        err.contains("campaign.csv") && err.contains("campaign.json"),
        "{err}"
    );
    let retried = folder.path().join("retried");
    make(&retried, &["2/4"]);
    merge(&[&shared, &rows, &retried], &output).code(0);
    for name in ["campaign.csv", "campaign.json"] {
        let [merged, whole] = [&merged, &whole].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(merged == whole, "{name}");
    }

    // The campaign finds all cases there, and sums them up as its own.
    let summed_up = campaign(&merged, &["--cases", CASES]).code(0);
    let err = stderr(&summed_up);
    assert!(
        err.contains("60 of 60 cases are in") && !err.contains(" a second"),
        "{err}"
    );
    for name in [
        "campaign.md",
        "campaign-summary.json",
        "figures/campaign.svg",
    ] {
        let [merged, whole] = [&merged, &whole].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(merged == whole, "{name}");
    }
    // And goes on with more of them.
    campaign(&merged, &["--cases", "70"]).code(0);
    campaign(&whole, &["--cases", "70"]).code(0);
    let [merged, whole] =
        [merged, whole].map(|folder| fs::read(folder.join("campaign.csv")).unwrap());
    assert!(merged == whole);
}

#[test]
fn any_number_of_shards_is_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    campaign(&whole, &["--cases", "7"]).code(0);
    let whole = fs::read(whole.join("campaign.csv")).unwrap();
    for of in [1, 2, 3, 7] {
        let output = folder.path().join(of.to_string());
        for number in 1..=of {
            let shard = format!("{number}/{of}");
            campaign(&output, &["--cases", "7", "--shard", &shard]).code(0);
        }
        let file = output.join("rows.csv");
        merge(&[&output], &file).code(0);
        assert!(fs::read(&file).unwrap() == whole, "{of} shards");
        assert!(output.join("rows.json").exists());
    }
    let err = stderr(&campaign(folder.path(), &["--cases", "7", "--shard", "1/8"]).code(1));
    assert!(err.contains("8 shards of 7 cases"), "{err}");
}

/// With SIGKILL, in the middle: what is recorded is gone on from, and the rows are those of a shard that nobody killed.
#[test]
fn a_shard_that_is_killed_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let [killed, whole] = ["killed", "whole"].map(|name| folder.path().join(name));
    let arguments = |output: &Path, shard: &'static str| {
        let cases = ["--cases", "450", "--shard", shard, "--threads", "1"];
        let output = output.to_owned();
        (output, cases)
    };
    let (output, cases) = arguments(&killed, "2/3");
    let mut run = Command::new(assert_cmd::cargo::cargo_bin("ulna"))
        .current_dir(root())
        .args(["campaign", SCENARIO, "--output", text(&output)])
        .args(cases)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let manifest = killed.join("campaign-0002-of-0003.json");
    let rows = || -> u64 {
        let text = fs::read_to_string(&manifest).unwrap_or_default();
        let manifest: Value = serde_json::from_str(&text).unwrap_or_default();
        manifest["rows"].as_u64().unwrap_or(0)
    };
    let start = Instant::now();
    while rows() == 0 && start.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(2));
    }
    run.kill().unwrap();
    assert!(!run.wait().unwrap().success());
    let made = rows();
    assert!(made > 0 && made < 150, "{made}");

    // Until then it is named with what it has.
    let merged = folder.path().join("campaign.csv");
    let errors = refused(&[&killed], &merged);
    are(
        &errors,
        &[
            &format!("shard 2 of 3 is incomplete, {made} of 150 rows are made"),
            "missing of 3 shards: 1, 3; ",
        ],
    );
    let err = stderr(&campaign(&killed, &cases).code(0));
    assert!(
        err.contains(&format!("{made} of 150 cases are in")),
        "{err}"
    );
    assert!(err.contains(&format!("{} cases in", 150 - made)), "{err}");
    let (output, cases) = arguments(&whole, "2/3");
    campaign(&output, &cases).code(0);
    for end in ["csv", "json"] {
        let name = format!("campaign-0002-of-0003.{end}");
        let [killed, whole] = [&killed, &whole].map(|folder| fs::read(folder.join(&name)).unwrap());
        assert!(killed == whole, "{name}");
    }
}

/// Everything at once, and each by its name.
#[test]
fn what_is_wrong_with_shards_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let good = at("good");
    make(&good, &["1/4", "2/4", "3/4", "4/4"]);
    let output = at("campaign.csv");
    let named =
        |number: u64, end: &str| PathBuf::from(format!("campaign-000{number}-of-0004.{end}"));

    // Some are missing: not one after the other, and in a row.
    let some = at("some");
    make(&some, &["4/7"]);
    are(
        &refused(&[&some], &output),
        &["missing of 7 shards: 1-3, 5-7; `ulna campaign SCENARIO --shard I/7` makes them"],
    );

    // A digit of a row, in the one that is needed and in one that is there twice.
    let changed = at("changed");
    copy(&good, &changed);
    let rows = changed.join(named(3, "csv"));
    let text = fs::read_to_string(&rows).unwrap();
    let digit = text
        .rfind(|c: char| c.is_ascii_digit() && c != '1')
        .unwrap();
    let mut other = text.clone();
    other.replace_range(digit..=digit, "1");
    fs::write(&rows, &other).unwrap();
    let message = "campaign-0003-of-0004.csv has been changed";
    are(&refused(&[&changed], &output), &[message]);
    are(&refused(&[&good, &changed], &output), &[message]);
    // A row more, a row less.
    fs::write(&rows, format!("{text}45,4,0.5,,,,ok\n")).unwrap();
    are(&refused(&[&changed], &output), &[message]);
    fs::write(&rows, &text[..text.len() / 2]).unwrap();
    are(&refused(&[&changed], &output), &[message]);

    // The same shard with other rows, each with a manifest that is right: as by another build.
    fs::write(&rows, &other).unwrap();
    let manifest = changed.join(named(3, "json"));
    let json = fs::read_to_string(&manifest).unwrap();
    let old: Value = serde_json::from_str(&json).unwrap();
    let sum = sha256(&rows);
    fs::write(
        &manifest,
        json.replace(old["sha256"].as_str().unwrap(), &sum),
    )
    .unwrap();
    are(
        &refused(&[&good, &changed], &output),
        &["shard 3 of 4 is there twice with different rows, "],
    );

    // Of another campaign: seed, scenario, cases, shards, laws, program.
    let foreign = at("foreign");
    let run = |name: &str, scenario: &str, arguments: &[&str]| {
        let output = foreign.join(name);
        let fixed = ["campaign", scenario, "--output", output.to_str().unwrap()];
        ulna(&[&fixed[..], arguments].concat()).code(0);
        output
    };
    let scenario = edited_scenario(
        "other.toml",
        [&("force_spread = 20.0", "force_spread = 20.1")],
    );
    let laws = edited_scenario(
        "laws.toml",
        [&("[campaign]\n", "[campaign]\nlaws = [\"eq20\", \"limit\"]\n")],
    );
    let [scenario, laws] = [
        scenario.path().join("other.toml"),
        laws.path().join("laws.toml"),
    ];
    let [scenario, laws] = [&scenario, &laws].map(|path| path.to_str().unwrap());
    let mut folders = vec![
        run(
            "seed",
            SCENARIO,
            &["--cases", CASES, "--shard", "1/4", "--seed", "7"],
        ),
        run("scenario", scenario, &["--cases", CASES, "--shard", "1/4"]),
        run("cases", SCENARIO, &["--cases", "61", "--shard", "1/4"]),
        run("shards", SCENARIO, &["--cases", CASES, "--shard", "1/3"]),
        run("laws", laws, &["--cases", CASES, "--shard", "1/4"]),
        foreign.join("program"),
    ];
    fs::create_dir(&folders[5]).unwrap();
    let json = fs::read_to_string(good.join(named(1, "json"))).unwrap();
    let older = json.replace("\"ulna ", "\"ulna 0.0.0-");
    assert_ne!(older, json);
    fs::write(folders[5].join(named(1, "json")), older).unwrap();
    fs::copy(good.join(named(1, "csv")), folders[5].join(named(1, "csv"))).unwrap();
    let differences = [
        "it has the seed 7, not 2026",
        "it is of another scenario or another arm",
        "it is of one with 61 cases, not 60 cases",
        "it is of one with 3 shards, not 4 shards",
        "it is of one with the laws eq20, limit, not the laws eq16, ",
        "it was made by ulna 0.0.0-",
    ];
    // Whichever comes first: most of them are right.
    folders.push(good.clone());
    let paths: Vec<_> = folders.iter().map(PathBuf::as_path).collect();
    let errors = refused(&paths, &output);
    are(&errors, &differences);
    assert!(
        errors
            .iter()
            .all(|error| error.contains(" is a shard of another campaign than "))
    );

    // All at once, with what is no shard.
    let bad = at("bad");
    copy(&good, &bad);
    fs::remove_file(bad.join(named(1, "json"))).unwrap();
    fs::write(bad.join(named(2, "json")), "{}").unwrap();
    fs::write(bad.join(named(3, "csv")), &other).unwrap();
    fs::rename(bad.join(named(4, "csv")), bad.join(named(4, "csv.partial"))).unwrap();
    let empty = at("empty");
    fs::create_dir(&empty).unwrap();
    let errors = refused(
        &[
            &bad,
            &empty,
            &folders[0],
            Path::new("Cargo.toml"),
            &at("nowhere"),
        ],
        &output,
    );
    are(
        &errors,
        &[
            "campaign-0001-of-0004.json is not there or cannot be read",
            "campaign-0002-of-0004.json is no manifest of a shard",
            "missing of 4 shards: 1-2; ",
            "campaign-0003-of-0004.csv has been changed",
            "shard 4 of 4 is incomplete, ",
            "it has the seed 7, not 2026",
            "no shard is in ",
            "Cargo.toml is no shard: name its manifest",
            "nowhere",
        ],
    );
    assert!(!output.exists());
}

fn sha256(path: &Path) -> String {
    let run = Command::new("sha256sum").arg(path).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    text.split(' ').next().unwrap().to_owned()
}

/// A shard that was given up in one folder and made in another counts where it is complete.
#[test]
fn a_shard_given_up_is_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let [good, given_up] = ["good", "given_up"].map(|name| folder.path().join(name));
    make(&good, &["1/2", "2/2"]);
    copy(&good, &given_up);
    let rows = given_up.join("campaign-0002-of-0002.csv");
    fs::rename(&rows, rows.with_extension("csv.partial")).unwrap();
    let err = stderr(&merge(&[&given_up, &good], &folder.path().join("campaign.csv")).code(0));
    assert!(
        err.contains("is passed over: shard 2 of 2 is not complete there, and is in "),
        "{err}"
    );
}

#[test]
fn what_stands_in_the_way_of_the_merged_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let shards = folder.path().join("shards");
    make(&shards, &["1/2", "2/2"]);
    let there = |output: &str, message: &str| {
        let errors = refused(&[&shards], &shards.join(output));
        assert!(
            errors.iter().any(|error| error.contains(message)),
            "{errors:#?}"
        );
    };
    let first = fs::read(shards.join("campaign-0001-of-0002.csv")).unwrap();
    there(
        "campaign-0001-of-0002.csv",
        "would be overwritten: it is a shard's",
    );
    there(
        "campaign-0002-of-0002.txt",
        "would be overwritten: it is a shard's",
    );
    there("rows.json", "name another file for the rows");
    assert!(fs::read(shards.join("campaign-0001-of-0002.csv")).unwrap() == first);
    fs::write(shards.join("campaign.csv.partial"), "case\n").unwrap();
    there("campaign.csv", "a campaign is under way in ");
    let nowhere = shards.join("nowhere/campaign.csv");
    let err = stderr(&merge(&[&shards], &nowhere).code(1).stdout(""));
    assert!(err.contains("is not there; make it"), "{err}");
}

#[test]
fn one_run_at_a_time_makes_a_shard() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    let lock = output.join("campaign-0001-of-0002.lock");
    fs::write(&lock, "4711\n").unwrap();
    let held = fs::File::open(&lock).unwrap();
    held.try_lock().unwrap();
    let err = stderr(
        &campaign(output, &["--cases", "10", "--shard", "1/2"])
            .code(1)
            .stdout(""),
    );
    assert!(
        err.starts_with("error: process 4711 makes shard 1 of 2 in "),
        "{err}"
    );
    // The other is another's.
    campaign(output, &["--cases", "10", "--shard", "2/2"]).code(0);
    drop(held);
    // A shard is no shard of a longer campaign.
    let err = stderr(
        &campaign(output, &["--cases", "20", "--shard", "2/2"])
            .code(1)
            .stdout(""),
    );
    assert!(
        err.contains("is of a campaign of 10 cases, not of a campaign of 20 cases; remove it"),
        "{err}"
    );
}

#[test]
fn more_cases_than_memory_takes_are_for_shards() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path();
    let err = stderr(
        &campaign(output, &["--cases", "10000001"])
            .code(1)
            .stdout(""),
    );
    assert!(err.contains("make the campaign in shards"), "{err}");
    assert!(names(output).is_empty());
    // One case of a campaign that no machine makes alone.
    let shard = [
        "--cases",
        "1000000000000",
        "--shard",
        "1000000000000/1000000000000",
    ];
    campaign(output, &shard).code(0);
    let rows = output.join("campaign-1000000000000-of-1000000000000.csv");
    let rows = fs::read_to_string(rows).unwrap();
    assert!(
        rows.lines().nth(1).unwrap().starts_with("999999999999,"),
        "{rows}"
    );
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    for arguments in [
        &["--shard", "0/4"][..],
        &["--shard", "5/4"],
        &["--shard", "1"],
        &["--shard", "1/2", "--slurm"],
        &["--shards", "4"],
        &["--slurm", "--shards", "0"],
    ] {
        campaign(Path::new("nowhere"), arguments).code(2).stdout("");
    }
    let err = stderr(&campaign(Path::new("nowhere"), &["--shard", "5/4"]).code(2));
    assert!(err.contains("counted from 1, such as 3/16"), "{err}");
    ulna(&["merge", "shards"]).code(2).stdout("");
    ulna(&["merge", "--output", "campaign.csv"])
        .code(2)
        .stdout("");
    let help = stdout(&ulna(&["merge", "--help"]).code(0));
    assert!(help.contains("finds all cases there"), "{help}");
}
