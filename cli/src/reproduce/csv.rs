//! The CSV files.

use ulna_study::experiment::{Case, Study, Truth};

use super::words::{name, solve_status, status};

/// One row for each case and joint.
pub(super) fn impacts<'s>(cases: impl Iterator<Item = &'s Case>) -> anyhow::Result<Vec<u8>> {
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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
pub(super) fn searches<'s>(cases: impl Iterator<Item = &'s Case>) -> anyhow::Result<Vec<u8>> {
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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

pub(super) fn frontiers(studies: &[Study]) -> anyhow::Result<Vec<u8>> {
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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
pub(super) fn truth(truths: &[Truth]) -> anyhow::Result<Vec<u8>> {
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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
pub(super) fn convergence(truths: &[Truth]) -> anyhow::Result<Vec<u8>> {
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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
pub(super) fn series(case: &Case) -> anyhow::Result<Vec<u8>> {
    let series = &case.flight.series;
    let mut csv = ::csv::Writer::from_writer(Vec::new());
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
