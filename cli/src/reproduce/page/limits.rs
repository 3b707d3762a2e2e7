//! Which rated torques bind, and whether the plan alone keeps them.

use std::fmt::{self, Write};

use ulna::JointKind;
use ulna_study::Scenario;
use ulna_study::experiment::{Case, SearchMethod, Study};

use crate::reproduce::words::{joints_named, significant};

/// By so much, relative, a torque may exceed a rated one before it counts: the numbers are rounded.
const ROUNDING: f64 = 1e-12;

/// Which rated torques bind.
pub(super) fn write(page: &mut String, scenario: &Scenario, studies: &[&Study]) -> fmt::Result {
    for study in studies {
        let case = study.case(SearchMethod::PerJoint);
        let Some(rated) = &case.rated_torque else {
            continue;
        };
        let beyond = |torques: &[f64], share: f64| -> Vec<usize> {
            let joints = torques.iter().zip(rated).enumerate();
            let beyond = joints.filter(|(_, (torque, rated))| **torque > **rated * share);
            beyond.map(|(joint, _)| joint).collect()
        };
        let exceeding = |case: &&Case| !beyond(&case.rollout.max_torque, 1.0 + ROUNDING).is_empty();
        let exceeded: Vec<_> = study
            .cases
            .iter()
            .filter(exceeding)
            .map(|case| case.method.name())
            .collect();
        let exceeded = if exceeded.is_empty() {
            "no law exceeds one".to_owned()
        } else {
            format!("exceeded by {}", exceeded.join(", "))
        };
        let rows = &case.rollout.series.planned;
        let locked = |time: f64, joint: usize| {
            time >= study.failure_time && case.failed_joints.contains(&joint)
        };
        // A locked joint's torque is its brake's.
        let plan: Vec<_> = (0..rated.len())
            .map(|joint| {
                let rows = rows.iter().zip(&case.rollout.series.time);
                let borne = rows.filter(|(_, time)| !locked(**time, joint));
                borne.map(|(row, _)| row[joint].abs()).fold(0.0, f64::max)
            })
            .collect();
        let texts = plan
            .iter()
            .zip(scenario.arm().joints())
            .map(|(torque, joint)| {
                let unit = match joint.kind {
                    JointKind::Revolute => "N·m",
                    JointKind::Prismatic => "N",
                };
                format!("{} {unit}", significant(*torque))
            });
        let law = match case.search {
            Ok(_) => "under Eq. 16",
            Err(_) => "without compensation and cut to them",
        };
        let too_much = beyond(&plan, 1.0 + ROUNDING);
        let too_much = if too_much.is_empty() {
            String::new()
        } else {
            format!(
                " That is more than the rated torque of {}: whatever compensation is added, the motion under this tool force \
                 cannot be executed as planned unless the compensation relieves them.",
                joints_named(&too_much)
            )
        };
        writeln!(
            page,
            "Rated torques, lock at {} s: {law} they bind at {}; {exceeded}. \
             The plan alone, motion and tool force, needs of joints 1 to {}: {}.{too_much}\n",
            study.failure_time,
            joints_named(&beyond(&case.rollout.max_torque, 1.0 - 1e-6)),
            rated.len(),
            texts.collect::<Vec<_>>().join(", "),
        )?;
    }
    Ok(())
}
