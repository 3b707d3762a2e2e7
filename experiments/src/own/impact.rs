//! [`LockImpact`]: what happens at the joints when some of them stop (Eq. 1–12).

use nalgebra::Vector6;
use ulna::SerialChain;
use ulna::control::failure::impact_torque;
use ulna_study::experiment::ExperimentError;

use crate::StateList;
use crate::lists::{list, locked, state};

/// The impact torque of a lock, and what the structure bears. Differences are before minus after, as in the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct LockImpact {
    /// Δτ of Eq. 12 for each joint, N·m (N): what the motors feel.
    pub torque: Vec<f64>,
    /// Eq. 8–11 for each joint.
    pub loads: Vec<JointLoadList>,
}

/// All that a link transmits to the next at its joint, in the joint's frame, whose z is the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLoadList {
    /// N.
    pub force: [f64; 3],
    /// About the frame's origin, N·m.
    pub moment: [f64; 3],
}

pub(crate) fn of<const N: usize>(
    chain: &SerialChain<N>,
    at: &StateList,
    joints: &[usize],
    wrench_step: &Vector6<f64>,
) -> Result<LockImpact, ExperimentError> {
    let impact = impact_torque(chain, &state(at)?, locked(joints)?, wrench_step);
    let loads = impact.loads.iter().map(|load| JointLoadList {
        force: load.force.into(),
        moment: load.moment.into(),
    });
    Ok(LockImpact {
        torque: list(&impact.torque),
        loads: loads.collect(),
    })
}
