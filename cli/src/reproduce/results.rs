//! `results.json`, and the CSV files beside it.

use serde::Serialize;
use ulna_study::Scenario;
use ulna_study::experiment::Case;

use super::force::Asked;
use super::words::status;
use super::{Findings, csv, limited, plan_steps, structure, worse};
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
    /// The healthy joints whose own step grows, counted from 1.
    worse_joints: Vec<usize>,
    /// Where the law keeps the tool force: the margin of the proof that no such law lowers every joint, N m per N; `null` without one.
    certificate_margin: Option<f64>,
    force_error_at_lock: f64,
    max_force_error: f64,
    /// What the tool is to exert, in the components of the task.
    asked_force_at_lock: f64,
    max_asked_force: f64,
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
    let cases = scenario.experiments().iter().flat_map(|experiment| {
        let studies = findings.of_section(experiment).into_iter();
        studies.flat_map(|study| {
            let asked = findings.asked(experiment, study);
            let margin = worse::margin(study);
            study.cases.iter().map(move |case| (case, asked, margin))
        })
    });
    let exact = cases
        .clone()
        .filter(|(case, ..)| !case.method.is_stepwise());
    let results = Results {
        arm: scenario.arm().name(),
        scenario: scenario.name(),
        cases: exact
            .clone()
            .map(|(case, asked, margin)| result(case, asked, margin))
            .collect(),
    };
    let beside = cases.map(|(case, asked, _)| (case, asked));
    let mut json = serde_json::to_vec_pretty(&results)?;
    json.push(b'\n');
    files.add("results.json", json);
    files.add("impact.csv", csv::impacts(beside.clone())?);
    files.add("search.csv", csv::searches(beside)?);
    files.add("frontier.csv", csv::frontiers(studies)?);
    files.add("limits.csv", limited::csv(&findings.limited)?);
    files.add("plan_steps.csv", plan_steps::csv(&findings.plan_steps)?);
    files.add("structure.csv", structure::csv(&findings.locks)?);
    if let Ok(simulations) = &findings.simulations {
        files.add("simulation.csv", csv::simulations(simulations)?);
        files.add("convergence.csv", csv::convergence(simulations)?);
    }
    for (case, ..) in exact {
        let Case {
            section,
            failure_time,
            method,
            ..
        } = case;
        let name = format!("series/{section}_{failure_time}s_{}.csv", method.name());
        files.add(name, csv::series(case)?);
    }
    Ok(())
}

fn result(case: &Case, asked: Asked, margin: Option<f64>) -> ResultCase<'_> {
    let worse = case.worse_joints();
    ResultCase {
        worse_joints: worse.iter().map(|worse| worse.joint + 1).collect(),
        certificate_margin: margin.filter(|_| worse::keeps_force(case.method)),
        section: &case.section,
        law: case.method.name(),
        failed_joint: FailedJoint::of(case),
        failure_time: case.failure_time,
        rated_torque: case.rated_torque.as_deref(),
        impact_before: &case.impact_before,
        impact_after: &case.impact_after,
        suppression_percent: case.suppression_percent(),
        coefficients: &case.coefficients,
        force_error_at_lock: case.force_error,
        max_force_error: case.rollout.max_force_error,
        asked_force_at_lock: asked.at_lock,
        max_asked_force: asked.most,
        max_torque: &case.rollout.max_torque,
        status: status(case),
    }
}
