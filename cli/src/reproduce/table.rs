//! What `ulna reproduce` prints: impact torques and coefficients, with the scenario's references beside them.

use std::io::{self, Write};

use comfy_table::Table;
use ulna_study::experiment::{Case, SearchMethod, SimulatedLock, Study};
use ulna_study::scenario::{Reference, Scenario};

use super::coefficients::coefficients;
use super::force::Asked;
use super::references::{self, reference_at};
use super::words::{impact_unit, seconds, significant, solve_status, what_locks};
use super::{Findings, bounds, limited, lock_step, plan_steps, structure, verdict, worse};
use crate::columns::plain;

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
            let reference = reference_at(scenario, experiment, study.failure_time);
            // Some references have coefficients alone.
            let reference = reference.filter(|reference| {
                let mut figures = reference.before().iter().chain(reference.after());
                figures.any(Option::is_some)
            });
            writeln!(
                out,
                "\nimpact torque in {} at {} s{}",
                impact_unit(scenario.arm().joints()),
                study.failure_time,
                beside(reference)
            )?;
            let asked = findings.asked(experiment, study);
            writeln!(out, "{}", impacts(scenario, study, reference, asked))?;
            for (method, title) in METHODS {
                if let Err(error) = &study.case(method).search {
                    writeln!(
                        out,
                        " {title}: {error}; its column is the motion without compensation, cut to the rated torques"
                    )?;
                }
            }
            worse::write(study, &METHODS, out)?;
        }
        writeln!(out, "\ncoefficients k_d of Eq. 16")?;
        writeln!(out, "{}", coefficients(scenario, experiment, &studies))?;
        for note in references::notes(scenario, experiment) {
            writeln!(out, "{note}")?;
        }
        bounds::write(&studies, out)?;
        limited::write(scenario, experiment, &findings.limited, out)?;
    }
    if let Some(experiment) = scenario.experiments().first() {
        writeln!(out, "\nsearches for {}", experiment.section())?;
        writeln!(out, "{}", searches(&findings.of_section(experiment)))?;
    }
    plan_steps::write(&findings.plan_steps, out)?;
    if let Ok(sweeps) = &findings.sweeps {
        let (heading, table) = (verdict::heading(sweeps), verdict::table(sweeps));
        writeln!(out, "\n{heading}\n{table}")?;
    }
    for lock in &findings.locks {
        writeln!(
            out,
            "\nload of the structure by the lock at {} s (Eq. 8-11), after minus before, in joint axes",
            lock.failure_time
        )?;
        writeln!(out, "{}", structure::table(lock))?;
    }
    if let Ok(simulations) = &findings.simulations {
        writeln!(
            out,
            "\nthe lock as it is, with ever shorter brakes{}: impulse in N m s",
            verdict::drives(simulations)
        )?;
        writeln!(out, "{}", convergence(simulations))?;
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

fn beside(reference: Option<&Reference>) -> String {
    reference.map_or_else(String::new, |reference| {
        format!("; beside it: {}", reference.source())
    })
}

/// A row for each joint; below them what concerns all.
fn impacts(
    scenario: &Scenario,
    study: &Study,
    reference: Option<&Reference>,
    asked: Asked,
) -> String {
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
    let of_asked = |asked: f64| format!(", N ({} asked)", significant(asked));
    let (healthy, _) = study.case(SearchMethod::PerJoint).healthy_impact();
    table.add_row(row(
        "norm, healthy joints".into(),
        significant(healthy),
        [blank(), blank()],
        per_method(&|case| significant(case.healthy_impact().1)),
    ));
    table.add_row(row(
        format!("force error at the lock{}", of_asked(asked.at_lock)),
        significant(0.0),
        [blank(), blank()],
        per_method(&|case| significant(case.force_error)),
    ));
    table.add_row(row(
        format!("force error at worst{}", of_asked(asked.most)),
        significant(0.0),
        [blank(), blank()],
        per_method(&|case| significant(case.rollout.max_force_error)),
    ));
    plain(table, &[0])
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
        "force error at the lock, N",
        "at worst, N",
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
            case.method.name().to_owned(),
            ended,
            steps,
            time,
            significant(case.healthy_impact().1),
            significant(case.force_error),
            significant(case.rollout.max_force_error),
        ]);
    }
    plain(table, &[1, 2])
}

/// A row for each brake time.
fn convergence(simulations: &[SimulatedLock]) -> String {
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
    for simulated in simulations {
        for point in &simulated.convergence {
            for (i, joint) in simulated.failed_joints.iter().enumerate() {
                table.add_row([
                    format!("{} s", simulated.failure_time),
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
