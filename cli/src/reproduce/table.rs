//! What `ulna reproduce` prints: impact torques and coefficients, with the scenario's references beside them.

use std::io::{self, Write};

use comfy_table::presets;
use comfy_table::{CellAlignment, Table};
use ulna::experiment::{Case, Method, Study, Truth};
use ulna::scenario::{Experiment, Reference, Scenario};

use super::Findings;
use super::results::{name, solve_status};

/// Columns of a table of impacts, one for each method.
const METHODS: [(Method, &str); 4] = [
    (Method::StepwisePerJoint, "Eq.16 steps"),
    (Method::PerJoint, "Eq.16"),
    (Method::Projected, "Eq.20"),
    (Method::Optimal, "optimal"),
];

/// All tables of a scenario.
pub(super) fn write(
    scenario: &Scenario,
    findings: &Findings,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{}", heading(scenario))?;
    for experiment in &scenario.experiments {
        writeln!(out, "\n{} {}", experiment.section, experiment.title)?;
        let studies = findings.of_section(experiment);
        for study in &studies {
            let reference = reference_at(experiment, study.failure_time);
            writeln!(
                out,
                "\nimpact torque in N m at {} s{}",
                study.failure_time,
                beside(reference)
            )?;
            writeln!(out, "{}", impacts(scenario, study, reference))?;
        }
        writeln!(out, "\ncoefficients k_d of Eq. 16, in 1e7")?;
        writeln!(out, "{}", coefficients(experiment, &studies))?;
    }
    if let Some(experiment) = scenario.experiments.first() {
        writeln!(out, "\nsearches for {}", experiment.section)?;
        writeln!(out, "{}", searches(&findings.of_section(experiment)))?;
    }
    if let Ok(truths) = &findings.truths {
        writeln!(
            out,
            "\nthe lock as it is, with ever shorter brakes: impulse in N m s"
        )?;
        writeln!(out, "{}", convergence(truths))?;
    }
    Ok(())
}

/// The joints that lock, counted from 1.
pub(super) fn failed_joints(scenario: &Scenario) -> String {
    let joints = scenario.failed_joints.iter();
    let names: Vec<_> = joints.map(|joint| (joint + 1).to_string()).collect();
    names.join(" and ")
}

fn heading(scenario: &Scenario) -> String {
    let description = match scenario.description.as_str() {
        "" => String::new(),
        description => format!(" ({description})"),
    };
    format!(
        "{}: arm {}, joint {} locks{description}",
        scenario.name,
        scenario.arm.name(),
        failed_joints(scenario)
    )
}

/// The reference for a failure time.
pub(super) fn reference_at(experiment: &Experiment, time: f64) -> Option<&Reference> {
    experiment
        .references
        .iter()
        .find(|reference| reference.time == time)
}

fn beside(reference: Option<&Reference>) -> String {
    reference.map_or_else(String::new, |reference| {
        format!("; beside it: {}", reference.source)
    })
}

/// A row for each joint; below them what concerns all.
fn impacts(scenario: &Scenario, study: &Study, reference: Option<&Reference>) -> Table {
    let reference = reference.filter(|reference| {
        let mut figures = reference.before.iter().chain(&reference.after);
        figures.any(Option::is_some)
    });
    let beside = |figure: fn(&Reference, usize) -> Option<f64>, joint: usize| {
        reference.map(|reference| figure(reference, joint).map_or_else(String::new, significant))
    };
    let row = |title: String, before: String, paper: [Option<String>; 2], after: [String; 4]| {
        let [paper_before, paper_after] = paper;
        let [steps, others @ ..] = after;
        let cells = [
            Some(title),
            Some(before),
            paper_before,
            Some(steps),
            paper_after,
        ];
        cells
            .into_iter()
            .flatten()
            .chain(others)
            .collect::<Vec<_>>()
    };
    let blank = || reference.map(|_| String::new());
    let per_method =
        |cell: &dyn Fn(&Case) -> String| METHODS.map(|(method, _)| cell(study.case(method)));

    let mut table = plain_table();
    let titles = METHODS.map(|(_, title)| title.to_owned());
    let there = || reference.map(|_| "there".to_owned());
    table.set_header(row(
        "joint".into(),
        "before".into(),
        [there(), there()],
        titles,
    ));
    let before = &study.case(Method::PerJoint).impact_before;
    for (joint, impact) in before.iter().enumerate() {
        let locked = if scenario.failed_joints.contains(&joint) {
            " (locks)"
        } else {
            ""
        };
        table.add_row(row(
            format!("{}{locked}", joint + 1),
            significant(*impact),
            [
                beside(|reference, joint| reference.before[joint], joint),
                beside(|reference, joint| reference.after[joint], joint),
            ],
            per_method(&|case| significant(case.impact_after[joint])),
        ));
    }
    let (healthy, _) = study.case(Method::PerJoint).healthy_impact();
    table.add_row(row(
        "norm, healthy joints".into(),
        significant(healthy),
        [blank(), blank()],
        per_method(&|case| significant(case.healthy_impact().1)),
    ));
    table.add_row(row(
        "force error at the lock, N".into(),
        significant(0.0),
        [blank(), blank()],
        per_method(&|case| significant(case.force_error)),
    ));
    table.add_row(row(
        "force error at worst, N".into(),
        significant(0.0),
        [blank(), blank()],
        per_method(&|case| significant(case.flight.max_force_error)),
    ));
    table
}

/// A row for each failure time and source, a column for each joint.
fn coefficients(experiment: &Experiment, studies: &[&Study]) -> Table {
    let mut table = plain_table();
    let joints = studies
        .first()
        .map_or(0, |study| study.case(Method::PerJoint).coefficients.len());
    let titles = (1..=joints).map(|joint| format!("k_d{joint}"));
    table.set_header(
        ["at".to_owned(), "found".to_owned()]
            .into_iter()
            .chain(titles),
    );
    for study in studies {
        let time = format!("{} s", study.failure_time);
        for (method, title) in [
            (Method::StepwisePerJoint, "in steps"),
            (Method::PerJoint, "exactly"),
        ] {
            let values = study.case(method).coefficients.iter();
            let cells = values.map(|value| format!("{:.2}", value / 1e7));
            table.add_row([time.clone(), title.to_owned()].into_iter().chain(cells));
        }
        if let Some(reference) = reference_at(experiment, study.failure_time)
            && reference.coefficients.iter().any(Option::is_some)
        {
            let values = reference.coefficients.iter();
            let cells = values
                .map(|value| value.map_or_else(String::new, |value| format!("{:.2}", value / 1e7)));
            table.add_row([time, reference.source.clone()].into_iter().chain(cells));
        }
    }
    if let Some(column) = table.column_mut(1) {
        column.set_cell_alignment(CellAlignment::Left);
    }
    table
}

/// A row for each search: what it took, and what it left.
fn searches(studies: &[&Study]) -> Table {
    let mut table = plain_table();
    table.set_header([
        "at",
        "law",
        "ended",
        "steps",
        "microseconds",
        "norm left, N m",
    ]);
    for case in studies.iter().flat_map(|study| &study.cases) {
        let (ended, steps, time) = match &case.search {
            Ok(search) => (
                solve_status(search.status).to_owned(),
                search.iterations.to_string(),
                format!("{:.0}", 1e6 * search.seconds),
            ),
            Err(error) => (error.to_string(), String::new(), String::new()),
        };
        table.add_row([
            format!("{} s", case.failure_time),
            name(case.method).to_owned(),
            ended,
            steps,
            time,
            significant(case.healthy_impact().1),
        ]);
    }
    table
}

/// A row for each brake time.
fn convergence(truths: &[Truth]) -> Table {
    let mut table = plain_table();
    table.set_header([
        "at",
        "joint",
        "brake time, s",
        "brake's impulse",
        "ideal lock",
        "rel. difference",
        "peak torque, N m",
    ]);
    for truth in truths {
        for point in &truth.convergence {
            for (i, joint) in truth.failed_joints.iter().enumerate() {
                table.add_row([
                    format!("{} s", truth.failure_time),
                    (joint + 1).to_string(),
                    format!("{:e}", point.brake_time),
                    format!("{:.6}", point.impulse[i]),
                    format!("{:.6}", point.ideal[i]),
                    format!("{:.1e}", point.relative_difference),
                    significant(point.peak_brake_torque),
                ]);
            }
        }
    }
    table
}

/// Without lines; numbers to the right.
fn plain_table() -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table
}

/// Four digits; what is rounding is 0.
pub(super) fn significant(value: f64) -> String {
    let size = value.abs();
    if size < 1e-9 {
        "0".to_owned()
    } else if size < 1e-3 {
        format!("{value:.1e}")
    } else if size >= 1e5 {
        format!("{value:.3e}")
    } else {
        let decimals = (3.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
        format!("{value:.decimals$}")
    }
}
