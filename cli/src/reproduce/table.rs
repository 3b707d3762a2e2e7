//! What `ulna reproduce` prints: impact torques and coefficients, with the scenario's references beside them.

use std::io::{self, Write};

use comfy_table::presets;
use comfy_table::{CellAlignment, Table};
use ulna_study::experiment::{Case, SearchMethod, Study, Truth};
use ulna_study::scenario::{Experiment, Reference, Scenario};

use super::words::{name, seconds, significant, solve_status, what_locks};
use super::{Findings, bounds, limited, lock_step, plan_steps};

/// Columns of a table of impacts, one for each method.
const METHODS: [(SearchMethod, &str); 4] = [
    (SearchMethod::StepwisePerJoint, "Eq.16 steps"),
    (SearchMethod::PerJoint, "Eq.16"),
    (SearchMethod::Projected, "Eq.20"),
    (SearchMethod::Optimal, "optimal"),
];

/// All tables of a scenario.
pub(super) fn write(
    scenario: &Scenario,
    findings: &Findings,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{}", heading(scenario))?;
    for experiment in scenario.experiments() {
        writeln!(out, "\n{} {}", experiment.section(), experiment.title())?;
        lock_step::write(experiment, out)?;
        let studies = findings.of_section(experiment);
        for study in &studies {
            let reference = reference_at(experiment, study.failure_time);
            // Some references have coefficients alone.
            let reference = reference.filter(|reference| {
                let mut figures = reference.before().iter().chain(reference.after());
                figures.any(Option::is_some)
            });
            writeln!(
                out,
                "\nimpact torque in N m at {} s{}",
                study.failure_time,
                beside(reference)
            )?;
            writeln!(out, "{}", impacts(scenario, study, reference))?;
            for (method, title) in METHODS {
                if let Err(error) = &study.case(method).search {
                    writeln!(out, " {title}: {error}")?;
                }
            }
        }
        let exponent = exponent(&studies);
        writeln!(out, "\ncoefficients k_d of Eq. 16, in 1e{exponent}")?;
        writeln!(out, "{}", coefficients(experiment, &studies, exponent))?;
        bounds::write(&studies, out)?;
        limited::write(experiment, &findings.limited, out)?;
    }
    if let Some(experiment) = scenario.experiments().first() {
        writeln!(out, "\nsearches for {}", experiment.section())?;
        writeln!(out, "{}", searches(&findings.of_section(experiment)))?;
    }
    plan_steps::write(&findings.plan_steps, out)?;
    if let Ok(truths) = &findings.truths {
        writeln!(
            out,
            "\nthe lock as it is, with ever shorter brakes: impulse in N m s"
        )?;
        writeln!(out, "{}", convergence(truths))?;
    }
    Ok(())
}

fn heading(scenario: &Scenario) -> String {
    let description = match scenario.description() {
        "" => String::new(),
        description => format!(" ({description})"),
    };
    format!(
        "{}: arm {}, {}{description}",
        scenario.name(),
        scenario.arm().name(),
        what_locks(scenario)
    )
}

/// The reference for a failure time.
pub(super) fn reference_at(experiment: &Experiment, time: f64) -> Option<&Reference> {
    experiment
        .references()
        .iter()
        .find(|reference| reference.time() == time)
}

fn beside(reference: Option<&Reference>) -> String {
    reference.map_or_else(String::new, |reference| {
        format!("; beside it: {}", reference.source())
    })
}

/// A row for each joint; below them what concerns all.
fn impacts(scenario: &Scenario, study: &Study, reference: Option<&Reference>) -> String {
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

    let mut table = Table::new();
    let titles = METHODS.map(|(_, title)| title.to_owned());
    let there = || reference.map(|_| "there".to_owned());
    table.set_header(row(
        "joint".into(),
        "before".into(),
        [there(), there()],
        titles,
    ));
    let before = &study.case(SearchMethod::PerJoint).impact_before;
    for (joint, impact) in before.iter().enumerate() {
        let locked = if scenario.failed_joints().contains(&joint) {
            " (locks)"
        } else {
            ""
        };
        table.add_row(row(
            format!("{}{locked}", joint + 1),
            significant(*impact),
            [
                beside(|reference, joint| reference.before()[joint], joint),
                beside(|reference, joint| reference.after()[joint], joint),
            ],
            per_method(&|case| significant(case.impact_after[joint])),
        ));
    }
    let (healthy, _) = study.case(SearchMethod::PerJoint).healthy_impact();
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
        per_method(&|case| significant(case.rollout.max_force_error)),
    ));
    plain(table, &[0])
}

/// The power of ten that leaves the largest coefficient of Eq. 16 one digit before the point.
fn exponent(studies: &[&Study]) -> i32 {
    let coefficients = studies
        .iter()
        .flat_map(|study| &study.case(SearchMethod::PerJoint).coefficients);
    let largest = coefficients.fold(0.0_f64, |largest, k| largest.max(k.abs()));
    if largest > 0.0 {
        largest.log10().floor() as i32
    } else {
        0
    }
}

/// A row for each failure time and source, a column for each joint; in units of 10 to the `exponent`.
fn coefficients(experiment: &Experiment, studies: &[&Study], exponent: i32) -> String {
    let mut table = Table::new();
    let joints = studies.first().map_or(0, |study| {
        study.case(SearchMethod::PerJoint).coefficients.len()
    });
    let titles = (1..=joints).map(|joint| format!("k_d{joint}"));
    table.set_header(
        ["at".to_owned(), "found".to_owned()]
            .into_iter()
            .chain(titles),
    );
    let cell = |value: f64| {
        let text = format!("{:.2}", value / 10_f64.powi(exponent));
        if text == "-0.00" {
            "0.00".to_owned()
        } else {
            text
        }
    };
    for study in studies {
        let time = format!("{} s", study.failure_time);
        for (method, title) in [
            (SearchMethod::StepwisePerJoint, "in steps"),
            (SearchMethod::PerJoint, "exactly"),
        ] {
            let values = study.case(method).coefficients.iter();
            let cells = values.map(|value| cell(*value));
            table.add_row([time.clone(), title.to_owned()].into_iter().chain(cells));
        }
        if let Some(reference) = reference_at(experiment, study.failure_time)
            && reference.coefficients().iter().any(Option::is_some)
        {
            let values = reference.coefficients().iter();
            let cells = values.map(|value| value.map_or_else(String::new, cell));
            table.add_row(
                [time, reference.source().to_owned()]
                    .into_iter()
                    .chain(cells),
            );
        }
    }
    plain(table, &[1])
}

/// A row for each search: what it took, and what it left.
fn searches(studies: &[&Study]) -> String {
    let mut table = Table::new();
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
    plain(table, &[1, 2])
}

/// A row for each brake time.
fn convergence(truths: &[Truth]) -> String {
    let mut table = Table::new();
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
                    seconds(point.brake_time),
                    format!("{:.6}", point.impulse[i]),
                    format!("{:.6}", point.ideal[i]),
                    format!("{:.1e}", point.relative_difference),
                    significant(point.peak_brake_torque),
                ]);
            }
        }
    }
    plain(table, &[])
}

/// Without lines; the columns `left` to the left, numbers to the right.
pub(super) fn plain(mut table: Table, left: &[usize]) -> String {
    table.load_style(presets::NOTHING);
    for (index, column) in table.column_iter_mut().enumerate() {
        if !left.contains(&index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt()
}
