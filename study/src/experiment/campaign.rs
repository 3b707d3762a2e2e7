//! [`Campaign`]: a scenario with every joint failing at many times, from random starts to random goals, under random forces.

use std::fmt;

use nalgebra::{SVector, Vector6};

use super::{AnyArm, ExperimentError};
use crate::scenario::{Experiment, Scenario};
use crate::search::{
    Assessment, ForcePriority, Objective, Operation, OperationOptions, SearchError,
    cancel_per_joint, least_impact, optimal,
};
use ulna::Trajectory;
use ulna::control::compensation::{Compensation, FreeTorque};
use ulna::control::failure::{Failure, LockedJoints};
use ulna::proof::random::SplitMix64;

/// The cases of a campaign. Each is a function of the seed and its number alone.
#[derive(Clone, Copy)]
pub struct Campaign<'a, const N: usize> {
    arm: &'a AnyArm<N>,
    scenario: &'a Scenario,
}

/// One case: a joint that locks in a random motion under a random force.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignCase {
    /// Its number, from 0.
    pub index: u64,
    /// The joint that locks, counted from 0.
    pub failed_joint: usize,
    /// When, s.
    pub failure_time: f64,
    /// What came of it; `Err` if the random motion cannot be executed or the limits leave no compensation.
    pub outcome: Result<CampaignResult, ExperimentError>,
}

/// What the laws do in a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CampaignResult {
    /// The norm of the impact over the healthy joints without compensation, N·m (N).
    pub before: f64,
    /// The locked joint's own step without compensation, N·m (N).
    pub locked_before: f64,
    /// The norm of the wrench that the tool is to exert, N (with the moments' N·m, if the task has any); constant in a case.
    pub asked_force: f64,
    /// Eq. 16.
    pub per_joint: CampaignOutcome,
    /// Eq. 20.
    pub projected: CampaignOutcome,
    /// The least impact that keeps the tool force.
    pub optimal: CampaignOutcome,
    /// A compensation that only knows of the lock when it has fallen: [`after_only`].
    pub after_only: CampaignOutcome,
}

/// What a law leaves, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CampaignOutcome {
    /// The norm of the impact over the healthy joints, N·m (N).
    pub impact: f64,
    /// h of Eq. 13 at the lock, N (with the moments' N·m, if the task has any).
    pub force_error: f64,
    /// The largest h over the whole motion.
    pub max_force_error: f64,
    /// How many healthy joints bear a larger step than without compensation; growth below 1e-9 of the largest step is rounding.
    pub worse_joints: usize,
}

impl CampaignOutcome {
    fn of<const N: usize>(operation: &Operation<N>, assessment: &Assessment<N>) -> Self {
        /// Relative to the largest step.
        const ROUNDING: f64 = 1e-9;
        let step = operation.step();
        let rounding = ROUNDING * step.amax();
        let worse = operation
            .healthy()
            .filter(|joint| assessment.impact[*joint].abs() > step[*joint].abs() + rounding);
        Self {
            impact: assessment.healthy_impact,
            force_error: assessment.force_error(),
            max_force_error: assessment.max_force_error,
            worse_joints: worse.count(),
        }
    }
}

impl<const N: usize> fmt::Debug for Campaign<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Campaign")
            .field("scenario", self.scenario)
            .finish_non_exhaustive()
    }
}

impl<'a, const N: usize> Campaign<'a, N> {
    /// At so many times a motion is looked at, for the limits.
    const SAMPLES: f64 = 100.0;

    /// The campaign of `scenario`, whose motion and first experiment are varied; Δt (Eq. 18) and ΔF_e (Eq. 8) are that experiment's.
    ///
    /// # Errors
    /// When the scenario's own motion cannot be executed, as by another arm.
    pub fn new(arm: &'a AnyArm<N>, scenario: &'a Scenario) -> Result<Self, ExperimentError> {
        scenario.motion().plan(arm, super::KNOT_PERIOD)?;
        Ok(Self { arm, scenario })
    }

    /// The failure times, s: the middles of equal parts of the motion.
    pub fn failure_times(&self) -> Vec<f64> {
        let count = self.scenario.campaign().failure_times();
        let part = self.scenario.motion().duration() / count as f64;
        (0..count).map(|i| (i as f64 + 0.5) * part).collect()
    }

    /// Case number `index`: joints change fastest, failure times next.
    pub fn case(&self, index: u64) -> CampaignCase {
        let times = self.failure_times();
        let failed_joint = (index % N as u64) as usize;
        let time = (index / N as u64) % times.len() as u64;
        let failure_time = times[time as usize];
        CampaignCase {
            index,
            failed_joint,
            failure_time,
            outcome: self.outcome(index, failed_joint, failure_time),
        }
    }

    fn outcome(
        &self,
        index: u64,
        failed_joint: usize,
        time: f64,
    ) -> Result<CampaignResult, ExperimentError> {
        let campaign = self.scenario.campaign();
        let task = self.arm.task();
        let mut random = SplitMix64::stream(campaign.seed(), index);
        let motion = self.scenario.motion();
        let motion = motion.varied(&campaign, task, &mut random);
        let mut force = Vector6::zeros();
        for row in task.iter() {
            force[row.index()] = campaign.force_spread() * random.symmetric();
        }
        let motion = motion.plan(self.arm, super::KNOT_PERIOD)?;
        let no_joint = ExperimentError::Joint {
            joint: failed_joint,
            joints: N,
        };
        let joints = LockedJoints::new(&[failed_joint]).ok_or(no_joint)?;
        let rated = self.scenario.experiments().first();
        let no_limit = SVector::repeat(f64::INFINITY);
        let options = OperationOptions {
            sample_period: motion.duration() / Self::SAMPLES,
            rated_torque: rated.map_or(Ok(no_limit), super::rated_torque)?,
            step_time: rated.map_or(0.0, Experiment::step_time),
            wrench_step: rated.map_or(Vector6::zeros(), |first| first.force().lock_step),
            projector: self.scenario.servo().projector(),
            ..OperationOptions::default()
        };
        let failure = Failure { joints, time };
        let operation = Operation::new(self.arm, &motion, |_| force, &failure, &options)?;
        Ok(assess(&operation, failed_joint, &force)?)
    }
}

/// The torque that takes as much of the step away after the lock as it can without a force at the tool, and none before it:
/// `U' = −P' step`, P' the projector of the locked arm. Without limits it leaves `‖(I − P') step‖` over the healthy joints.
///
/// What a controller can do that does not prepare for a lock.
pub fn after_only<const N: usize>(operation: &Operation<N>) -> Compensation<N> {
    let nothing = FreeTorque {
        torque: SVector::zeros(),
        wrench: Vector6::zeros(),
    };
    Compensation::Optimal {
        before: nothing,
        after: FreeTorque {
            torque: -operation.step(),
            ..nothing
        },
    }
}

fn assess<const N: usize>(
    operation: &Operation<N>,
    failed_joint: usize,
    asked: &Vector6<f64>,
) -> Result<CampaignResult, SearchError> {
    let step = operation.step();
    let per_joint = cancel_per_joint(operation)?.assessment;
    let projected = least_impact(operation, Objective::LeastSquares)?.assessment;
    let optimal = optimal(operation, ForcePriority::Exact)?.assessment;
    let after_only = operation.assess(&after_only(operation));
    let outcome = |assessment: &Assessment<N>| CampaignOutcome::of(operation, assessment);
    Ok(CampaignResult {
        before: operation.failure().joints.without(&step).norm(),
        locked_before: step[failed_joint].abs(),
        asked_force: asked.norm(),
        per_joint: outcome(&per_joint),
        projected: outcome(&projected),
        optimal: outcome(&optimal),
        after_only: outcome(&after_only),
    })
}
