//! `results.json` and the CSV files: the same numbers for programs.

use serde::Serialize;
use ulna::experiment::{Case, Method, Study, Truth};
use ulna::search::SolveStatus;
use ulna::{Scenario, Status};

use super::Findings;
use crate::output::Files;

/// `results.json`. Its cases are the exact ones; those of the search in steps are in `search.csv` and `impact.csv`.
/// Every case has every key; every number is finite.
#[derive(Serialize)]
struct Results<'s> {
    arm: &'s str,
    scenario: &'s str,
    cases: Vec<ResultCase<'s>>,
}

/// Torques in N m (N), forces in N, times in s.
#[derive(Serialize)]
struct ResultCase<'s> {
    section: &'s str,
    law: &'static str,
    failed_joint: FailedJoint,
    failure_time: f64,
    /// `null` if no joint has one, and in the place of a joint without one.
    rated_torque: Option<&'s [f64]>,
    impact_before: &'s [f64],
    impact_after: &'s [f64],
    suppression_percent: Vec<f64>,
    /// k_d. The optimal law has none: for it those of Eq. 16 that would change each joint's step at the lock alike.
    coefficients: &'s [f64],
    max_force_error: f64,
    max_torque: &'s [f64],
    status: String,
}

/// Counted from 1.
#[derive(Serialize)]
#[serde(untagged)]
enum FailedJoint {
    One(usize),
    /// Those that lock together.
    Several(Vec<usize>),
}

impl FailedJoint {
    fn of(case: &Case) -> Self {
        let joints: Vec<_> = case.failed_joints.iter().map(|joint| joint + 1).collect();
        match joints[..] {
            [joint] => Self::One(joint),
            _ => Self::Several(joints),
        }
    }
}

/// All numbers of the studies.
pub(super) fn add(
    files: &mut Files,
    scenario: &Scenario,
    findings: &Findings,
) -> anyhow::Result<()> {
    let studies = &findings.studies;
    let cases = studies.iter().flat_map(|study| &study.cases);
    let exact = cases.clone().filter(|case| !case.method.is_stepwise());
    let results = Results {
        arm: scenario.arm.name(),
        scenario: &scenario.name,
        cases: exact.clone().map(result).collect(),
    };
    let mut json = serde_json::to_vec_pretty(&results)?;
    json.push(b'\n');
    files.add("results.json", json);
    files.add("impact.csv", impacts(cases.clone())?);
    files.add("search.csv", searches(cases)?);
    files.add("frontier.csv", frontiers(studies)?);
    if let Ok(truths) = &findings.truths {
        files.add("truth.csv", truth(truths)?);
        files.add("convergence.csv", convergence(truths)?);
    }
    for case in exact {
        let Case {
            section,
            failure_time,
            method,
            ..
        } = case;
        let name = format!("series/{section}_{failure_time}s_{}.csv", name(*method));
        files.add(name, series(case)?);
    }
    Ok(())
}

/// What a method is called in files.
pub(super) fn name(method: Method) -> &'static str {
    match method {
        Method::StepwisePerJoint => "eq16_steps",
        Method::PerJoint => "eq16",
        Method::StepwiseProjected => "eq20_steps",
        Method::Projected => "eq20",
        Method::Optimal => "optimal",
    }
}

/// How a case went: the worst cycle, or why there was no compensation.
pub(super) fn status(case: &Case) -> String {
    if let Err(error) = &case.search {
        return format!("infeasible: {error}");
    }
    let status = match case.flight.status {
        Status::Nominal => "nominal",
        Status::Saturated => "saturated",
        Status::NearSingular => "near_singular",
        Status::Overloaded => "overloaded",
        Status::NotFinite => "not_finite",
    };
    status.to_owned()
}

fn result(case: &Case) -> ResultCase<'_> {
    ResultCase {
        section: &case.section,
        law: name(case.method),
        failed_joint: FailedJoint::of(case),
        failure_time: case.failure_time,
        rated_torque: case.rated_torque.as_deref(),
        impact_before: &case.impact_before,
        impact_after: &case.impact_after,
        suppression_percent: case.suppression_percent(),
        coefficients: &case.coefficients,
        max_force_error: case.flight.max_force_error,
        max_torque: &case.flight.max_torque,
        status: status(case),
    }
}

/// One row for each case and joint.
fn impacts<'s>(cases: impl Iterator<Item = &'s Case>) -> anyhow::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "section",
        "failure_time",
        "method",
        "joint",
        "locks",
        "impact_before",
        "impact_after",
        "suppression_percent",
        "coefficient",
        "max_torque",
    ])?;
    for case in cases {
        let suppression = case.suppression_percent();
        for (joint, suppression) in suppression.iter().enumerate() {
            csv.serialize((
                &case.section,
                case.failure_time,
                name(case.method),
                joint + 1,
                case.failed_joints.contains(&joint),
                case.impact_before[joint],
                case.impact_after[joint],
                suppression,
                case.coefficients[joint],
                case.flight.max_torque[joint],
            ))?;
        }
    }
    Ok(csv.into_inner()?)
}

/// One row for each case: the searches side by side. The only numbers that differ from run to run are the seconds.
fn searches<'s>(cases: impl Iterator<Item = &'s Case>) -> anyhow::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "section",
        "failure_time",
        "method",
        "search",
        "gap",
        "iterations",
        "seconds",
        "healthy_before",
        "healthy_after",
        "force_error_at_lock",
        "max_force_error",
        "status",
    ])?;
    for case in cases {
        let search = case.search.as_ref().ok();
        let (before, after) = case.healthy_impact();
        csv.serialize((
            &case.section,
            case.failure_time,
            name(case.method),
            search.map(|search| solve_status(search.status)),
            search.and_then(|search| search.gap),
            search.map(|search| search.iterations),
            search.map(|search| search.seconds),
            before,
            after,
            case.force_error,
            case.flight.max_force_error,
            status(case),
        ))?;
    }
    Ok(csv.into_inner()?)
}

/// How a search ended, in files.
pub(super) fn solve_status(status: SolveStatus) -> &'static str {
    match status {
        SolveStatus::ClosedForm => "closed_form",
        SolveStatus::Solved => "solved",
        SolveStatus::AlmostSolved => "almost_solved",
        SolveStatus::GridOptimum => "grid_optimum",
        SolveStatus::StepLimit => "step_limit",
    }
}

fn frontiers(studies: &[Study]) -> anyhow::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "section",
        "failure_time",
        "force_error_at_lock",
        "healthy_impact",
    ])?;
    for study in studies {
        for (force_error, impact) in study
            .tradeoff
            .iter()
            .flat_map(|tradeoff| &tradeoff.frontier)
        {
            csv.serialize((&study.section, study.failure_time, force_error, impact))?;
        }
    }
    Ok(csv.into_inner()?)
}

/// One row for each simulated lock and joint.
fn truth(truths: &[Truth]) -> anyhow::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "section",
        "failure_time",
        "brake_time",
        "method",
        "joint",
        "locks",
        "predicted_step",
        "torque_step",
        "peak_torque",
        "energy_error",
    ])?;
    for truth in truths {
        for run in &truth.runs {
            for (joint, step) in run.torque_step.iter().enumerate() {
                csv.serialize((
                    &truth.section,
                    truth.failure_time,
                    truth.brake_time,
                    run.method.map_or("none", name),
                    joint + 1,
                    truth.failed_joints.contains(&joint),
                    run.predicted_step[joint],
                    step,
                    run.peak_torque[joint],
                    run.energy_error,
                ))?;
            }
        }
    }
    Ok(csv.into_inner()?)
}

/// One row for each brake time and failed joint.
fn convergence(truths: &[Truth]) -> anyhow::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "section",
        "failure_time",
        "joint",
        "brake_time",
        "impulse",
        "ideal_impulse",
        "relative_difference",
        "peak_brake_torque",
        "energy_error",
        "momentum_error",
    ])?;
    for truth in truths {
        for point in &truth.convergence {
            for (i, joint) in truth.failed_joints.iter().enumerate() {
                csv.serialize((
                    &truth.section,
                    truth.failure_time,
                    joint + 1,
                    point.brake_time,
                    point.impulse[i],
                    point.ideal[i],
                    point.relative_difference,
                    point.peak_brake_torque,
                    point.energy_error,
                    point.momentum_error,
                ))?;
            }
        }
    }
    Ok(csv.into_inner()?)
}

/// One row for each time of the series. At the failure time there are two: before and after the lock.
fn series(case: &Case) -> anyhow::Result<Vec<u8>> {
    let series = &case.flight.series;
    let mut csv = csv::Writer::from_writer(Vec::new());
    let per_joint = |what: &str| {
        let joints = 1..=case.impact_before.len();
        joints
            .map(|joint| format!("{what}_{joint}"))
            .collect::<Vec<_>>()
    };
    let wrench = |what: &str| {
        ["fx", "fy", "fz", "nx", "ny", "nz"].map(|component| format!("{what}_{component}"))
    };
    csv.write_record(
        [
            vec!["time".to_owned()],
            per_joint("planned_torque"),
            per_joint("torque"),
            wrench("asked").into(),
            wrench("error").into(),
        ]
        .concat(),
    )?;
    for (i, time) in series.time.iter().enumerate() {
        let numbers = [time]
            .into_iter()
            .chain(&series.planned[i])
            .chain(&series.torque[i])
            .chain(&series.force[i])
            .chain(&series.force_error[i]);
        csv.write_record(numbers.map(f64::to_string))?;
    }
    Ok(csv.into_inner()?)
}
