//! `ulna reproduce`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use serde_json::Value;
use tempfile::TempDir;

use crate::support::{examples, root, stderr, stdout, ulna};

/// A folder with `quick.toml`: the paper-like scenario with long control cycles and one failure time, and `edits`.
fn quick_scenario(edits: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut text = include_str!("../../../scenarios/paper_like.toml").to_owned();
    let quick = [
        ("cycle = 0.01", "cycle = 0.2"),
        ("times = [3.0, 10.0, 18.0]", "times = [10.0]"),
    ];
    for (from, to) in quick.iter().chain(edits) {
        assert!(text.contains(from), "the scenario has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    fs::write(folder.path().join("quick.toml"), text).unwrap();
    folder
}

/// A folder with `quick.toml` about an arm of two joints, and that arm's table.
fn planar_scenario() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let table = include_str!("../../../arms/planar_2r.toml").replace("planar_2r", "my_arm");
    fs::write(folder.path().join("my_arm.toml"), table).unwrap();
    let scenario = r#"
name = "by_table"
arm = "my_arm.toml"
angle_unit = "deg"
[motion]
kind = "tool"
angles = "q"
start = [10, 60]
displacement = [-0.3, 0.2, 0, 0, 0, 0]
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
force = [1, [0, 2], 0]
rated_torque = "table"
"#;
    fs::write(folder.path().join("quick.toml"), scenario).unwrap();
    folder
}

fn reproduce(folder: &TempDir) -> Assert {
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    ulna(&["reproduce", &path("quick.toml"), "--output", &path("out")])
}

/// The cells of the first row that starts with `title`.
fn row<'t>(text: &'t str, title: &str) -> Vec<&'t str> {
    let line = text
        .lines()
        .find(|line| line.trim_start().starts_with(title));
    let line = line.unwrap_or_else(|| panic!("no row {title:?} in:\n{text}"));
    line.trim_start()[title.len()..]
        .split_whitespace()
        .collect()
}

/// All files below `folder`, by their paths in it.
fn files(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            let below = files(&entry.path());
            found.extend(below.iter().map(|file| format!("{name}/{file}")));
        } else {
            found.insert(name);
        }
    }
    found
}

/// The numbers under `key` of a case.
fn numbers(case: &Value, key: &str) -> Vec<f64> {
    let numbers = case[key].as_array();
    let numbers = numbers.unwrap_or_else(|| panic!("{key} of {case}"));
    numbers
        .iter()
        .map(|number| number.as_f64().unwrap())
        .collect()
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

const FIGURES: [&str; 14] = [
    "arm-healthy",
    "arm-locked",
    "search-in-steps",
    "structure",
    "figure_4",
    "figure_5",
    "figure_6",
    "figure_7",
    "frontier-5.2",
    "frontier-5.3",
    "frontier-5.4",
    "simulated-lock",
    "ever-shorter-brakes",
    "felt-steps",
];

#[test]
fn everything_is_printed_and_written() {
    let folder = quick_scenario(&[]);
    let run = reproduce(&folder).code(0);
    tables_stand_beside_the_papers(&stdout(&run));
    let output = folder.path().join("out");
    let written = files(&output);
    let err = stderr(&run);
    let count = format!("wrote {} files to ", written.len());
    assert!(err.starts_with(&count), "{err}");
    assert!(
        err.ends_with("/out; README.md says what was found\n"),
        "{err}"
    );
    let tables = [
        "README.md",
        "results.json",
        "impact.csv",
        "search.csv",
        "frontier.csv",
        "limits.csv",
        "plan_steps.csv",
        "simulation.csv",
        "structure.csv",
        "convergence.csv",
        "ablation.csv",
        "sweep.csv",
        "verdict.csv",
    ];
    let mut expected: BTreeSet<String> = tables.map(str::to_owned).into();
    for section in ["5.2", "5.3", "5.4"] {
        let laws = ["eq16", "eq20", "optimal"];
        expected.extend(laws.map(|law| format!("series/{section}_10s_{law}.csv")));
    }
    for figure in FIGURES {
        expected.extend(["svg", "png"].map(|kind| format!("figures/{figure}.{kind}")));
    }
    assert_eq!(written, expected);
    results_are_as_promised(&output);
    figures_are_whole(&output);
    // Whatever the page points to is there.
    let page = fs::read_to_string(output.join("README.md")).unwrap();
    let (_, plan) = page.split_once("## The plan's own steps\n").unwrap();
    for sentence in [
        "by up to 483.2 N·m (norm over all joints, at 20 s), 6.4 times the largest step of a lock, 75.34 N·m at 10 s.",
        "takes the plan's steps away, for steeper slopes within the blends",
        "at 10 s 75.34 N·m becomes 75.34 with `quintic` and 75.34 with `s_curve`.",
    ] {
        assert!(plan.contains(sentence), "{sentence} is missing in:\n{plan}");
    }
    // With cycles as long as these.
    assert!(
        page.contains("servo is not stable with this cycle"),
        "{page}"
    );
    verdicts_are_those_of_the_sweep(&output);
    let links = page.split("](").skip(1);
    let links: Vec<_> = links.filter_map(|rest| rest.split(')').next()).collect();
    assert_eq!(links.len(), FIGURES.len());
    for link in links {
        assert!(output.join(link).exists(), "{link}");
    }
}

fn tables_stand_beside_the_papers(out: &str) {
    assert!(
        out.starts_with("paper_like: arm ssrms, joint 2 locks (fitted"),
        "{out}"
    );
    // Before, the paper's, after the paper's search, the paper's, after the exact search, Eq. 20, optimal.
    assert_eq!(
        row(out, "1 "),
        ["35.97", "30.18", "0.1052", "0.1472", "0", "4.983", "3.896"]
    );
    assert_eq!(row(out, "2 (locks)")[..2], ["61.95", "66.72"]);
    assert_eq!(
        row(out, "norm, healthy joints"),
        ["42.87", "0.1173", "3.8e-4", "9.973", "6.591"]
    );
    assert_eq!(
        row(out, "10 s  paper, Table 4"),
        ["-9e7", "-8.5e7", "-9e7", "-8.5e7", "-1.2e8", "-1e8", "0"]
    );
    // Each with its own power of ten: a small one loses no digits to a large one.
    assert_eq!(
        row(out, "10 s  in steps"),
        ["5.1e7", "-8.1e7", "3.9e7", "-3.8e7", "1.1e7", "8e6", "0"]
    );
    assert_eq!(row(out, "10 s  exactly")[5], "7.770e6");
    // What the tool is asked to exert stands beside what it is off by.
    assert_eq!(
        row(out, "force error at the lock, N (34.64 asked)"),
        ["0", "13.57", "13.71", "0", "0"]
    );
    assert_eq!(
        row(out, "4               1.237 N m")[..3],
        ["80.89", "-3.827", "80.80"]
    );
    assert!(out.contains("with ever shorter brakes"), "{out}");
    let delta = "the first torque after the lock is taken 0.01 s after it (Delta t of Eq. 18)\n";
    assert_eq!(out.matches(delta).count(), 1);
    what_rated_torques_cut_is_printed(out);
    the_plans_steps_stand_beside_the_locks(out);
    // No norm without the joints that pay for it, and what proves that some have to.
    for line in [
        " Eq.16: no healthy joint is worse off\n",
        " Eq.20: worse off: joint 4 at 2.17 times its step, joint 5 at 3.10 times its step, joint 6 at 4.67 times its step; certificate 0.5564 N m per N\n",
        " optimal: worse off: joint 4 at 2.50 times its step; certificate 0.5564 N m per N\n",
        " certificate: no law that keeps the tool force lowers joints 1, 2, 3, 4, 5 and 6 all at once; a wrench",
        " tool force kept and no healthy joint worse off: 39.21 of 42.87 N m, or each of them at 95.1 % of its step at most; the locked joints no worse off either: 42.87 N m\n",
    ] {
        assert!(out.contains(line), "{line} is missing in:\n{out}");
    }
    // The field decides nothing but the force error, and what acts after the lock alone little.
    let ablation = |law: &str, what: &str| {
        let (_, table) = out.split_once("what it is due to, 5.2").unwrap();
        let mut lines = table.lines().map(str::trim_start);
        let line = lines.find(|line| line.contains(law) && line.contains(what));
        let (_, figures) = line.unwrap().split_once(what).unwrap();
        figures
            .split_whitespace()
            .next()
            .unwrap()
            .parse::<f64>()
            .unwrap()
    };
    for field in ["grad w_D", "grad w, kinematic", "ones", "random"] {
        assert!(ablation("Eq.16", field) < 1e-3 && ablation("Eq.20", field) == 9.973);
    }
    assert_eq!(ablation("optimal", "before only"), 6.591);
    assert_eq!(ablation("optimal", "after only"), 42.22);
    assert!(!out.contains(" \n"), "blanks at the end of a line:\n{out}");
}

/// Of Section 5.3, with the paper's Table 3 below each joint of it.
fn what_rated_torques_cut_is_printed(out: &str) {
    let (_, cut) = out.split_once("that rated torques cut\n").unwrap();
    assert_eq!(row(cut, "10 s      4")[4..], ["s", "75.6", "%"]);
    assert_eq!(row(cut, "10 s      6")[2], "upper");
    let (_, cost) = out
        .split_once("what the rated torques cost at 10 s")
        .unwrap();
    assert!(cost.starts_with(": Eq. 16 without and with them; below: paper, Table 3"));
    let ours = row(cost, "4 ");
    assert_eq!(ours[ours.len() - 4..], ["75.63", "%", "24.37", "%"]);
    let theirs = row(cost, "there ");
    assert_eq!(
        theirs.join(" "),
        "1.240 0.00580 99.53 % 0.2684 78.35 % 21.58 %"
    );
    let mean = row(cost, "mean tau^e of joints 4, 5 and 6:").join(" ");
    assert!(
        mean.starts_with("10") && mean.ends_with(" N m, of 160.7 N m rated; there 254.2"),
        "{mean}"
    );
}

fn the_plans_steps_stand_beside_the_locks(out: &str) {
    let (_, steps) = out.split_once("steps of the planned torque").unwrap();
    assert_eq!(row(steps, "trapezoid ")[..3], ["483.2", "20", "s"]);
    for profile in ["quintic ", "s_curve "] {
        assert_eq!(row(steps, profile)[0], "0");
    }
    assert_eq!(row(steps, "quintic ").last(), Some(&"75.34"));
}

fn results_are_as_promised(output: &Path) {
    let text = fs::read_to_string(output.join("results.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(keys(&results), ["arm", "scenario", "cases"].into());
    assert_eq!(results["arm"], "ssrms");
    assert_eq!(results["scenario"], "paper_like");
    let cases = results["cases"].as_array().unwrap();
    let found: Vec<_> = cases
        .iter()
        .map(|case| (case["section"].as_str().unwrap(), &case["law"]))
        .collect();
    let expected: Vec<_> = ["5.2", "5.3", "5.4"]
        .into_iter()
        .flat_map(|section| ["eq16", "eq20", "optimal"].map(|law| (section, Value::from(law))))
        .collect();
    let expected: Vec<_> = expected
        .iter()
        .map(|(section, law)| (*section, law))
        .collect();
    assert_eq!(found, expected);
    for case in cases {
        let expected = [
            "section",
            "law",
            "failed_joint",
            "failure_time",
            "rated_torque",
            "impact_before",
            "impact_after",
            "suppression_percent",
            "coefficients",
            "force_error_at_lock",
            "max_force_error",
            "asked_force_at_lock",
            "max_asked_force",
            "max_torque",
            "status",
        ];
        assert_eq!(keys(case), expected.into());
        assert_eq!(case["failed_joint"], 2);
        assert_eq!(case["failure_time"], 10.0);
        for key in ["coefficients", "max_torque"] {
            assert_eq!(numbers(case, key).len(), 7, "{key}");
        }
        assert_eq!(case["rated_torque"].is_null(), case["section"] == "5.2");
        let before = numbers(case, "impact_before");
        let after = numbers(case, "impact_after");
        let percent = numbers(case, "suppression_percent");
        assert_eq!((before.len(), after.len(), percent.len()), (7, 7, 7));
        for joint in 0..7 {
            let expected = 100.0 * (1.0 - after[joint] / before[joint]);
            assert!((percent[joint] - expected).abs() < 1e-9);
        }
    }
    let after = numbers(&cases[0], "impact_after");
    assert!(after[..6].iter().all(|after| *after < 1e-6), "{after:?}");
    assert!(cases[0]["max_force_error"].as_f64().unwrap() > 100.0);
    let at_lock = cases[0]["force_error_at_lock"].as_f64().unwrap();
    assert!((at_lock - 13.71).abs() < 0.01, "{at_lock}");
    let asked = cases[0]["asked_force_at_lock"].as_f64().unwrap();
    assert!((asked - 1200_f64.sqrt()).abs() < 1e-9, "{asked}");
    assert!(cases[1]["max_force_error"].as_f64().unwrap() < 1e-6);
    let peaks = numbers(&cases[3], "max_torque");
    let rated = numbers(&cases[3], "rated_torque");
    let peaks = peaks.iter().zip(&rated);
    assert!(peaks.clone().all(|(peak, rated)| peak <= rated));
    assert!(
        peaks
            .clone()
            .any(|(peak, rated)| *peak > rated * (1.0 - 1e-9))
    );
    assert_eq!(cases[0]["status"], "nominal");
}

/// The rows of a CSV file by their columns.
fn csv_rows(path: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let names: Vec<_> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells = names.iter().zip(line.split(','));
        cells
            .map(|(name, cell)| ((*name).to_owned(), cell.to_owned()))
            .collect()
    };
    lines.map(row).collect()
}

fn verdicts_are_those_of_the_sweep(output: &Path) {
    let (points, verdicts) = (
        csv_rows(&output.join("sweep.csv")),
        csv_rows(&output.join("verdict.csv")),
    );
    // Gains of 0 and 1, and the scenario's 5; 20 is too much for the cycle. Rotors of five weights, and four compensations.
    assert_eq!((points.len(), verdicts.len()), (3 * 5 * 4, 3 * 5));
    let own: Vec<_> = verdicts.iter().filter(|row| row["own"] == "true").collect();
    assert_eq!(own.len(), 1);
    assert_eq!(
        (
            own[0]["gain"].as_str(),
            own[0]["reflected_inertia"].as_str()
        ),
        ("5.0", "0")
    );
    for verdict in &verdicts {
        let same = |key: &str, point: &std::collections::BTreeMap<String, String>| {
            point[key] == verdict[key]
        };
        let steps = points.iter().filter(|point| {
            ["gain", "reflected_inertia", "failure_time"]
                .iter()
                .all(|key| same(key, point))
        });
        let steps: Vec<(&str, f64)> = steps
            .map(|point| (point["method"].as_str(), point["step"].parse().unwrap()))
            .collect();
        let without = steps
            .iter()
            .find(|(method, _)| *method == "none")
            .unwrap()
            .1;
        let least = steps.iter().filter(|(method, _)| *method != "none");
        let least = least.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert_eq!(verdict["best"], least.0);
        let relative: f64 = verdict["best_relative"].parse().unwrap();
        assert!((relative - least.1 / without).abs() < 1e-12);
        assert_eq!(verdict["lowered"] == "true", relative < 0.99);
    }
}

/// A PNG of twice the SVG's size, and an SVG with axes, units and a legend in it.
fn figures_are_whole(output: &Path) {
    for figure in FIGURES {
        let svg = fs::read_to_string(output.join(format!("figures/{figure}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        let units = [" in s", " in N", " m each", "k_di"];
        let unit = units.iter().any(|unit| svg.contains(unit));
        assert!(unit && svg.matches("<text").count() > 10, "{figure}");
        // Whoever finds the figure alone knows what it is of.
        let footer = "arm ssrms, scenario paper_like, joint 2 locks";
        assert!(svg.contains(footer), "{figure}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{figure}");
        let number = |key: &str| -> u32 {
            let (_, rest) = svg.split_once(&format!("{key}=\"")).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let png = fs::read(output.join(format!("figures/{figure}.png"))).unwrap();
        let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info();
        let size = reader.unwrap().info().size();
        assert_eq!(
            size,
            (2 * number("width"), 2 * number("height")),
            "{figure}"
        );
    }
}

#[test]
fn a_table_runs_on_the_generic_path() {
    let folder = planar_scenario();
    let out = stdout(&reproduce(&folder).code(0));
    assert!(
        out.starts_with("by_table: arm my_arm, joint 2 locks\n"),
        "{out}"
    );
    let text = fs::read_to_string(folder.path().join("out/results.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    // Two joints and a task of two rows: no torque leaves the tool force alone, and no law invents one from rounding.
    for case in results["cases"].as_array().unwrap() {
        assert_eq!(numbers(case, "rated_torque"), [40.0, 15.0]);
        let before = numbers(case, "impact_before");
        assert!(before.iter().all(|impact| *impact > 0.0), "{before:?}");
        assert_eq!(numbers(case, "impact_after"), before);
        assert_eq!(numbers(case, "coefficients"), [0.0, 0.0]);
        assert_eq!(case["max_force_error"], 0.0);
    }
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    the_page_tells_an_arm_without_a_null_space_so_first(&page);
}

/// What the page says of an arm follows from its numbers.
fn the_page_tells_an_arm_without_a_null_space_so_first(page: &str) {
    let spare = page.find("**This arm has no joint to spare.**");
    let spare = spare.unwrap_or_else(|| panic!("{page}"));
    assert!(spare < page.find("## a").unwrap(), "{page}");
    assert!(page.contains("has 1 of 2 independent rows left"), "{page}");
    for claim in ["95 %", "The paper argues", "trade off", "Its motion is"] {
        assert!(!page.contains(claim), "{claim:?} in:\n{page}");
    }
}

/// Of three joints one is to spare, and steps this small lead nowhere from this far.
#[test]
fn the_page_names_searches_that_stopped_early() {
    let folder = planar_scenario();
    let change = |name: &str, edits: &[(&str, &str)]| {
        let path = folder.path().join(name);
        let mut text = fs::read_to_string(&path).unwrap();
        for (from, to) in edits {
            assert!(text.contains(from), "{name} has no {from:?}");
            text = text.replacen(from, to, 1);
        }
        fs::write(path, text).unwrap();
    };
    let table = fs::read_to_string(folder.path().join("my_arm.toml")).unwrap();
    let (_, elbow) = table.split_once("[[joint]] # elbow").unwrap();
    let two = format!("[[joint]] # elbow{elbow}[[joint]]");
    change("my_arm.toml", &[("[[joint]] # elbow", &two)]);
    change(
        "quick.toml",
        &[
            ("start = [10, 60]", "start = [10, 60, 40]"),
            ("start = 0\nstep = 1e-3", "start = 1e6\nstep = 1e-6"),
            // Less to simulate: that is not what this is about.
            ("cycle = 0.1", "cycle = 0.45"),
            (
                "[search]",
                "[servo]\ngain = 0.0\nlead = 0.01\n[brake]\nduration = 0.01\n[search]",
            ),
        ],
    );
    reproduce(&folder).code(0);
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    let message =
        "**A search stopped at its step limit:** `eq16_steps` at 0.9 s after 1000000 steps";
    assert!(page.contains(message), "{page}");
    assert!(!page.contains("**The search in steps.**"), "{page}");
    let left = "**With joint 2 locked this arm has no joint to spare.**";
    assert!(page.contains(left), "{page}");
}

/// The paper's 300 N m cannot be kept: the plan alone needs more.
#[test]
fn the_page_says_where_the_plan_alone_needs_too_much() {
    let limits = ("rated_torque = \"none\"", "rated_torque = 300.0");
    let folder = quick_scenario(&[limits]);
    let out = stdout(&reproduce(&folder).code(0));
    assert!(out.contains("10 s  exactly"), "{out}");
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    for text in [
        "**No compensation was found** for `eq16_steps` at 10 s (no compensation keeps joint 4 within its rated torque",
        "405.4 N·m, 30.53 N·m",
        "That is more than the rated torque of joint 4:",
    ] {
        assert!(page.contains(text), "{text:?} is missing in:\n{page}");
    }
}

/// The paper's figures are for joint 2. Where a reference does not say so, as here the last one, that is said.
#[test]
fn references_for_another_lock_are_left_out_and_named() {
    let folder = quick_scenario(&[
        ("joints = [2]", "joints = [3]"),
        (
            "time = 10.0\nfailed_joints = [2]\ncoefficients",
            "time = 10.0\ncoefficients",
        ),
    ]);
    let out = stdout(&reproduce(&folder).code(0));
    let page = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    for text in [&out, &page] {
        let note = "The reference \"paper, Table 2\" for 3 s is left out: that is no failure time";
        assert!(text.contains(note), "{text}");
        let note = "for 10 s is left out: there joint 2 locks, here joint 3 locks.";
        assert_eq!(text.matches(note).count(), 2, "{text}");
        let note = "does not say which joint locks there; it stands beside the lock of joint 3.";
        assert_eq!(text.matches(note).count(), 1, "{text}");
    }
    assert!(!out.contains("beside it: "), "{out}");
    assert!(out.contains("10 s  paper, Table 4"), "{out}");
    let (of_52, _) = page.split_once("## 5.3").unwrap();
    for claim in ["The paper argues", "Left of the impact"] {
        assert!(!of_52.contains(claim), "{claim:?} in:\n{page}");
    }
}

#[test]
fn the_example_of_the_help_works_and_names_the_joints_that_lock_together() {
    let examples = examples("reproduce");
    assert_eq!(examples.len(), 1);
    let out = stdout(&ulna(&examples[0].split(' ').collect::<Vec<_>>()).code(0));
    assert!(
        out.starts_with("tool_path: arm ssrms, joints 2 and 4 lock ("),
        "{out}"
    );
    let text = fs::read_to_string(root().join("target/reproduce/results.json")).unwrap();
    let results: Value = serde_json::from_str(&text).unwrap();
    let cases = results["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 6);
    for case in cases {
        assert_eq!(numbers(case, "failed_joint"), [2.0, 4.0]);
    }
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = quick_scenario(&[]);
    fs::write(folder.path().join("out"), "a file").unwrap();
    // Before the work, not after it.
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    assert!(err.contains("error: cannot make the folder"), "{err}");
    assert!(err.contains("/out is a file"), "{err}");
}

#[test]
#[cfg(unix)]
fn an_output_that_is_a_dangling_link_is_refused_before_the_work() {
    let folder = planar_scenario();
    std::os::unix::fs::symlink("absent", folder.path().join("out")).unwrap();
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    let message =
        "/out is a symbolic link to absent, which is not there; make that folder, or choose";
    assert!(err.contains(message), "{err}");
    assert!(!folder.path().join("absent").exists());
    // With the folder there, the link is a folder like any other.
    fs::create_dir(folder.path().join("absent")).unwrap();
    reproduce(&folder).code(0);
    assert!(folder.path().join("absent/results.json").exists());
}

#[test]
fn files_are_replaced_all_or_none() {
    let folder = planar_scenario();
    let output = folder.path().join("out");
    fs::create_dir(&output).unwrap();
    fs::write(output.join("README.md"), "precious").unwrap();
    // In the way of the last file.
    let blocked = output.join("figures/ever-shorter-brakes.png");
    fs::create_dir_all(&blocked).unwrap();
    let err = stderr(&reproduce(&folder).code(1));
    let message = "ever-shorter-brakes.png: it is a folder, no regular file";
    assert!(err.contains(message), "{err}");
    assert_eq!(files(&output), ["README.md".to_owned()].into());
    assert_eq!(
        fs::read_to_string(output.join("README.md")).unwrap(),
        "precious"
    );
    fs::remove_dir(blocked).unwrap();
    // `series` has been made by then, and goes again.
    let figures = output.join("figures");
    fs::remove_dir(&figures).unwrap();
    fs::write(&figures, "a file").unwrap();
    let err = stderr(&reproduce(&folder).code(1));
    assert!(
        err.contains("cannot make the folder") && err.contains("/figures"),
        "{err}"
    );
    assert_eq!(
        files(&output),
        ["README.md", "figures"].map(str::to_owned).into()
    );
    assert!(!output.join("series").exists());
    assert_eq!(
        fs::read_to_string(output.join("README.md")).unwrap(),
        "precious"
    );
}

#[test]
fn a_motion_that_cannot_be_executed_is_refused() {
    let slow = "blend = 4.455\nmax_velocity = [1, 1, 0.2, 1, 1, 1, 1]";
    let folder = quick_scenario(&[("blend = 4.455", slow)]);
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    let message = "error: the motion cannot be executed: joint 3 would need 0.283";
    assert!(err.contains(message), "{err}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn bad_scenarios_are_refused_with_every_error_and_nothing_is_written() {
    let edits = [
        ("arm = \"ssrms\"", "arm = \"ssrm\""),
        ("step = 1e6", "step = 0"),
    ];
    let folder = quick_scenario(&edits);
    let err = stderr(&reproduce(&folder).code(1).stdout(""));
    for message in [
        "error: no arm is called `ssrm`",
        "quick.toml:6:7",
        "help: did you mean \"ssrms\"?",
        "error: `step` of [search] is out of bounds",
    ] {
        assert!(err.contains(message), "{message} is missing in:\n{err}");
    }
    assert!(!folder.path().join("out").exists());
}
