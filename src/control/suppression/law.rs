//! [`SuppressionLaw`]: where a loop's compensation comes from.

use nalgebra::SVector;

use super::Schedule;
use crate::Arm;
use crate::control::compensation::{Compensation, Law, OnLine, TaskPose};
use crate::control::failure::LockedJoints;
use crate::control::trajectory::JointState;

/// Where U comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SuppressionLaw<'a, const N: usize> {
    /// Nowhere: U = 0.
    None,
    /// Coefficients of Eq. 16 or 20, or a constant torque and force.
    Coefficients(Compensation<N>),
    /// Samples computed beforehand.
    Schedule(Schedule<'a, N>),
    /// The state alone.
    OnLine(OnLine<N>),
}

impl<const N: usize> SuppressionLaw<'_, N> {
    /// Whether the static tool force is off by what is commanded, and by nothing else: all laws but Eq. 16.
    pub fn keeps_force(&self) -> bool {
        self.kind() != Law::PerJoint
    }

    /// How rated torques cut it.
    pub(super) fn kind(&self) -> Law {
        match self {
            Self::Coefficients(compensation) => compensation.law(),
            Self::None | Self::OnLine(_) => Law::Projected,
            Self::Schedule(_) => Law::Optimal,
        }
    }

    /// U at `time`, for the locked joints' `state` at rest.
    #[inline]
    pub(super) fn compensation(
        &self,
        arm: &(impl Arm<N> + ?Sized),
        time: f64,
        state: &JointState<N>,
        pose: &TaskPose<N>,
        locked: LockedJoints<N>,
    ) -> SVector<f64, N> {
        match self {
            Self::None => SVector::zeros(),
            Self::Coefficients(compensation) => pose.compensation(compensation),
            Self::Schedule(schedule) => pose.free_torque(&schedule.at(time)),
            Self::OnLine(law) => law.compensation(arm, state, pose, locked),
        }
    }
}
