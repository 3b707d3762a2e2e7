//! All that is printed and written of the paper-like scenario.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::printed::tables_stand_beside_the_papers;
use super::{files, numbers, quick_scenario, reproduce};
use crate::support::{stderr, stdout};

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
            "worse_joints",
            "certificate_margin",
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
    // Eq. 16, which bends the force, lowers every joint; nothing that keeps it can.
    assert!(cases[0]["worse_joints"].as_array().unwrap().is_empty());
    assert!(cases[0]["certificate_margin"].is_null());
    assert_eq!(numbers(&cases[1], "worse_joints"), [4.0, 5.0, 6.0]);
    let margin = cases[1]["certificate_margin"].as_f64().unwrap();
    assert!((margin - 0.5564).abs() < 1e-3, "{margin}");
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
