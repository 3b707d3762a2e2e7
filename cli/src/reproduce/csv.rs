//! The CSV files of `ulna reproduce`.

use serde::Serialize;
use ulna_study::experiment::{Case, SearchMethod, SimulatedLock, Study};

use super::force::Asked;
use super::words::{solve_status, status};
use crate::rows::file;

/// A case and a joint.
#[derive(Default, Serialize)]
struct Impact<'s> {
    section: &'s str,
    failure_time: f64,
    method: &'static str,
    joint: usize,
    locks: bool,
    impact_before: f64,
    impact_after: f64,
    suppression_percent: f64,
    coefficient: f64,
    max_torque: f64,
    force_error_at_lock: f64,
    max_force_error: f64,
    asked_force_at_lock: f64,
    max_asked_force: f64,
}

pub(super) fn impacts<'s>(
    cases: impl Iterator<Item = (&'s Case, Asked)>,
) -> anyhow::Result<String> {
    file(cases.flat_map(|(case, asked)| {
        let suppression = case.suppression_percent().into_iter().enumerate();
        suppression.map(move |(joint, suppression_percent)| Impact {
            section: &case.section,
            failure_time: case.failure_time,
            method: case.method.name(),
            joint: joint + 1,
            locks: case.failed_joints.contains(&joint),
            impact_before: case.impact_before[joint],
            impact_after: case.impact_after[joint],
            suppression_percent,
            coefficient: case.coefficients[joint],
            max_torque: case.rollout.max_torque[joint],
            force_error_at_lock: case.force_error,
            max_force_error: case.rollout.max_force_error,
            asked_force_at_lock: asked.at_lock,
            max_asked_force: asked.most,
        })
    }))
}

/// A case: the searches side by side. The only numbers that differ from run to run are the seconds.
#[derive(Default, Serialize)]
struct Search<'s> {
    section: &'s str,
    failure_time: f64,
    method: &'static str,
    search: Option<&'static str>,
    gap: Option<f64>,
    iterations: Option<usize>,
    seconds: Option<f64>,
    healthy_before: f64,
    healthy_after: f64,
    force_error_at_lock: f64,
    max_force_error: f64,
    asked_force_at_lock: f64,
    max_asked_force: f64,
    status: String,
}

pub(super) fn searches<'s>(
    cases: impl Iterator<Item = (&'s Case, Asked)>,
) -> anyhow::Result<String> {
    file(cases.map(|(case, asked)| {
        let search = case.search.as_ref().ok();
        let (healthy_before, healthy_after) = case.healthy_impact();
        Search {
            section: &case.section,
            failure_time: case.failure_time,
            method: case.method.name(),
            search: search.map(|search| solve_status(search.status)),
            gap: search.and_then(|search| search.gap),
            iterations: search.map(|search| search.iterations),
            seconds: search.map(|search| search.seconds),
            healthy_before,
            healthy_after,
            force_error_at_lock: case.force_error,
            max_force_error: case.rollout.max_force_error,
            asked_force_at_lock: asked.at_lock,
            max_asked_force: asked.most,
            status: status(case),
        }
    }))
}

/// A point of what force error buys.
#[derive(Default, Serialize)]
struct Frontier<'s> {
    section: &'s str,
    failure_time: f64,
    force_error_at_lock: f64,
    healthy_impact: f64,
}

pub(super) fn frontiers(studies: &[Study]) -> anyhow::Result<String> {
    file(studies.iter().flat_map(|study| {
        let points = study.tradeoff.iter().flat_map(|found| &found.frontier);
        points.map(|(force_error, impact)| Frontier {
            section: &study.section,
            failure_time: study.failure_time,
            force_error_at_lock: *force_error,
            healthy_impact: *impact,
        })
    }))
}

/// A simulated lock and a joint.
#[derive(Default, Serialize)]
struct SimulatedStep<'s> {
    section: &'s str,
    failure_time: f64,
    brake_time: f64,
    detection: f64,
    lead: f64,
    gain: f64,
    method: &'static str,
    tool_acceleration: f64,
    joint: usize,
    reflected_inertia: f64,
    locks: bool,
    predicted_step: f64,
    braking_step: f64,
    torque_step: f64,
    peak_torque: f64,
    energy_error: f64,
}

pub(super) fn simulations(simulations: &[SimulatedLock]) -> anyhow::Result<String> {
    let runs = simulations
        .iter()
        .flat_map(|simulated| simulated.runs.iter().map(move |run| (simulated, run)));
    file(runs.flat_map(|(simulated, run)| {
        let steps = run.torque_step.iter().enumerate();
        steps.map(move |(joint, torque_step)| SimulatedStep {
            section: &simulated.section,
            failure_time: simulated.failure_time,
            brake_time: simulated.brake_time,
            detection: simulated.detection,
            lead: simulated.lead,
            gain: simulated.gain,
            tool_acceleration: run.tool_acceleration,
            reflected_inertia: simulated.reflected_inertia[joint],
            braking_step: simulated.braking_step[joint],
            method: run.method.map_or("none", SearchMethod::name),
            joint: joint + 1,
            locks: simulated.failed_joints.contains(&joint),
            predicted_step: run.predicted_step[joint],
            torque_step: *torque_step,
            peak_torque: run.peak_torque[joint],
            energy_error: run.energy_error,
        })
    }))
}

/// A brake time and a failed joint.
#[derive(Default, Serialize)]
struct Convergence<'s> {
    section: &'s str,
    failure_time: f64,
    joint: usize,
    brake_time: f64,
    impulse: f64,
    ideal_impulse: f64,
    relative_difference: f64,
    peak_brake_torque: f64,
    energy_error: f64,
    momentum_error: f64,
}

pub(super) fn convergence(simulations: &[SimulatedLock]) -> anyhow::Result<String> {
    let points = simulations.iter().flat_map(|simulated| {
        simulated
            .convergence
            .iter()
            .map(move |point| (simulated, point))
    });
    file(points.flat_map(|(simulated, point)| {
        let joints = simulated.failed_joints.iter().enumerate();
        joints.map(move |(i, joint)| Convergence {
            section: &simulated.section,
            failure_time: simulated.failure_time,
            joint: joint + 1,
            brake_time: point.brake_time,
            impulse: point.impulse[i],
            ideal_impulse: point.ideal[i],
            relative_difference: point.relative_difference,
            peak_brake_torque: point.peak_brake_torque,
            energy_error: point.energy_error,
            momentum_error: point.momentum_error,
        })
    }))
}

/// One row for each time of the series, with columns for each joint. At the failure time there are two: before and after the lock.
pub(super) fn series(case: &Case) -> anyhow::Result<String> {
    let series = &case.rollout.series;
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
    Ok(String::from_utf8(csv.into_inner()?)?)
}
