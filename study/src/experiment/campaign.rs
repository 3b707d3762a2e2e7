//! [`Campaign`]: a scenario with every joint failing at many times, from random starts to random goals, under random forces.

use std::fmt;

use nalgebra::{SVector, Vector6};

use super::trial::{CampaignOutcome, Trial};
use super::{AnyArm, ExperimentError};
use crate::laws::LawName;
use crate::scenario::{Experiment, Scenario};
use crate::search::{OperationOptions, SearchError};
use ulna::Trajectory;
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
    /// What came of it; `Err` if the random motion cannot be executed.
    pub outcome: Result<CampaignResult, ExperimentError>,
}

/// What the laws do in a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignResult {
    /// The norm of the impact over the healthy joints without compensation, N·m (N).
    pub before: f64,
    /// The locked joint's own step without compensation, N·m (N).
    pub locked_before: f64,
    /// The norm of the wrench that the tool is to exert, N (with the moments' N·m, if the task has any); constant in a case.
    pub asked_force: f64,
    /// What each of the scenario's laws did, in the order of [`LawName::ALL`]; `Err` where the limits leave it nothing.
    /// No law's outcome depends on which others there are.
    pub laws: Vec<(LawName, Result<CampaignOutcome, SearchError>)>,
}

impl CampaignResult {
    /// What `law` did; `None` if it was not chosen.
    pub fn law(&self, law: LawName) -> Option<&Result<CampaignOutcome, SearchError>> {
        let mut laws = self.laws.iter();
        laws.find(|(name, _)| *name == law)
            .map(|(_, outcome)| outcome)
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
        let laws = campaign.laws();
        let trial = Trial::new(self.arm, &motion, force, &failure, &options, laws)?;
        let step = trial.step();
        Ok(CampaignResult {
            before: joints.without(&step).norm(),
            locked_before: step[failed_joint].abs(),
            asked_force: force.norm(),
            laws: laws.iter().map(|law| (law, trial.meet(law))).collect(),
        })
    }
}
