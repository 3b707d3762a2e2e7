//! Section 5 of the paper as a library: a [`Scenario`](crate::Scenario) in, the cases with their series out.
//!
//! A *case* is one experiment, one failure time, one way to find a compensation. The impact is that of Eq. 18, by default with
//! Δt = 0; extremes and series are those of a [`Controller`](ulna::Controller) that executes the whole motion cycle by cycle.
//! Results carry plain lists, one entry for each joint, so that tables and figures need not know how many there are.

mod ablation;
mod bound;
mod campaign;
mod case;
mod force_kept;
mod limited;
mod lock;
mod mechanics;
mod plan_steps;
mod rollout;
mod runner;
mod shard;
mod simulated;
mod sweep;
mod trial;
mod verdict;

use nalgebra::SVector;

use crate::scenario::{Experiment, PlanError};
use crate::search::SearchError;
use crate::simulation::{Ending, SimulationError};
use ulna::Arm;

pub use ablation::{Ablation, AblationOutcome, AblationRow, Variant};
pub use bound::{BoundSide, CoefficientBound};
pub use campaign::{Campaign, CampaignCase, CampaignResult};
pub use case::{Case, Search, SearchMethod, Study, Tradeoff};
pub use force_kept::{ForceKept, Lowerable};
pub use limited::{LimitedJoint, LimitedSuppression};
pub(crate) use lock::COARSE;
pub use mechanics::{
    ArmPose, JointFrame, LockMechanics, Redundancy, StructureLoad, lock_mechanics,
};
pub use plan_steps::{PlanSteps, PlannedTorques, ProfileSteps, TorqueStep};
pub use rollout::{Rollout, Series};
pub use runner::ExperimentRunner;
pub use shard::Shard;
pub use simulated::{BrakeImpulse, SimulatedLock, SimulatedRun};
pub use sweep::{Felt, Rotors, Sweep, SweepPoint};
pub use trial::{CampaignOutcome, after_only};
pub use verdict::{LockVerdict, Verdict};

/// Why a scenario cannot be tried out.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ExperimentError {
    /// The motion cannot be executed.
    #[error("the motion cannot be executed: {0}")]
    Motion(#[from] PlanError),
    /// A joint that the arm does not have, counted from 0.
    #[error("joint {} fails, the arm has {joints}", joint + 1)]
    Joint {
        /// Counted from 0.
        joint: usize,
        /// How many there are.
        joints: usize,
    },
    /// An experiment of a scenario for another number of joints.
    #[error("the experiment is for {experiment} joints, the arm has {arm}")]
    Joints {
        /// The joints of the experiment.
        experiment: usize,
        /// The joints of the arm.
        arm: usize,
    },
    /// A scenario without experiments.
    #[error("the scenario has no experiment")]
    NoExperiment,
    /// The operation cannot be looked at.
    #[error(transparent)]
    Operation(#[from] SearchError),
    /// The operation cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// A simulation did not come to its end.
    #[error("the simulated lock at {time} s did not come to its end: {ending}")]
    Unfinished {
        /// The failure time, s.
        time: f64,
        /// How it ended.
        ending: Ending,
    },
}

/// An arm of `N` joints, whatever its backend: experiments are compiled once for each number of joints.
pub type AnyArm<const N: usize> = dyn Arm<N> + Sync;

/// The largest time between two knots of a tool path, s.
pub(crate) const KNOT_PERIOD: f64 = 0.02;

/// Infinite where there is no limit.
fn rated_torque<const N: usize>(
    experiment: &Experiment,
) -> Result<SVector<f64, N>, ExperimentError> {
    rated_torque_of(experiment.rated_torque())
}

/// Infinite where there is no limit.
pub(crate) fn rated_torque_of<const N: usize>(
    rated: Option<&[f64]>,
) -> Result<SVector<f64, N>, ExperimentError> {
    let Some(rated) = rated else {
        return Ok(SVector::repeat(f64::INFINITY));
    };
    for_each_joint(rated)
}

pub(crate) fn for_each_joint<const N: usize>(
    numbers: &[f64],
) -> Result<SVector<f64, N>, ExperimentError> {
    let numbers = <[f64; N]>::try_from(numbers).map_err(|_| ExperimentError::Joints {
        experiment: numbers.len(),
        arm: N,
    })?;
    Ok(numbers.into())
}

fn list<const N: usize>(vector: &SVector<f64, N>) -> Vec<f64> {
    vector.as_slice().to_vec()
}
