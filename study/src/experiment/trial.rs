//! [`Trial`]: one failure in one motion, met by laws that are tuned for it.

use nalgebra::{SVector, Vector6};

use super::AnyArm;
use crate::laws::{LawName, LawSet};
use crate::search::{
    Assessment, Field, ForcePriority, Objective, OperatingPoint, Operation, OperationOptions,
    SearchError, cancel_per_joint, least_impact, optimal,
};
use ulna::Trajectory;
use ulna::control::compensation::{self, Compensation, FreeTorque, OnLine, Projector};
use ulna::control::failure::{Failure, LockedJoints};

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

/// A failure in a motion, looked at as often as the laws need it.
///
/// At the lock alone for what is decided there: the impact, and without rated torques the coefficients. The whole motion for laws that
/// bend the static tool force, and for all of them where a rated torque or the dynamic projector may make them bend it.
pub(super) struct Trial<'a, T, const N: usize> {
    arm: &'a AnyArm<N>,
    motion: &'a T,
    /// As much of the motion as any law needs.
    whole: Operation<N>,
    lock: Operation<N>,
    /// Whether every law may bend the force somewhere.
    all_bend: bool,
}

impl<'a, T: Trajectory<N>, const N: usize> Trial<'a, T, N> {
    /// The motion of `arm` with `failure` in it, under a constant `wrench` of the tool, for `laws` to meet.
    ///
    /// # Errors
    /// When a torque is no finite number.
    pub(super) fn new(
        arm: &'a AnyArm<N>,
        motion: &'a T,
        wrench: Vector6<f64>,
        failure: &Failure<N>,
        options: &OperationOptions<N>,
        laws: LawSet,
    ) -> Result<Self, SearchError> {
        let limited = options.rated_torque.iter().any(|rated| rated.is_finite());
        let all_bend = limited || options.projector != Projector::Static;
        let mut options = *options;
        if !all_bend && !laws.iter().any(LawName::bends_force) {
            options.sample_period = motion.duration();
        }
        let whole = Operation::new(arm, motion, |_| wrench, failure, &options)?;
        Ok(Self {
            arm,
            motion,
            lock: whole.at_lock(),
            whole,
            all_bend,
        })
    }

    /// The torque step without compensation, N·m (N).
    pub(super) fn step(&self) -> SVector<f64, N> {
        self.lock.step()
    }

    /// What `law` makes of the failure.
    ///
    /// # Errors
    /// When the limits leave it nothing.
    pub(super) fn meet(&self, law: LawName) -> Result<CampaignOutcome, SearchError> {
        let searched = self.searched();
        let compensation = match law {
            LawName::PerJoint => cancel_per_joint(searched)?.compensation,
            LawName::Projected => least_impact(searched, Objective::LeastSquares)?.compensation,
            LawName::Limit => optimal(searched, ForcePriority::Exact)?.compensation,
            LawName::AfterOnly => after_only(searched),
            LawName::Kinematic => return self.kinematic(),
            LawName::OnLine => return Ok(self.on_line()),
            // A scenario refuses the others, which are planned for many failures of one motion.
            LawName::None
            | LawName::ConstantPerJoint
            | LawName::ConstantProjected
            | LawName::Robust => Compensation::none(),
        };
        let seen = self.seen(law);
        Ok(CampaignOutcome::of(seen, &seen.assess(&compensation)))
    }

    /// What decides on coefficients and torques.
    fn searched(&self) -> &Operation<N> {
        if self.all_bend {
            &self.whole
        } else {
            &self.lock
        }
    }

    /// Where what `law` does has to be looked at.
    fn seen(&self, law: LawName) -> &Operation<N> {
        if self.all_bend || law.bends_force() {
            &self.whole
        } else {
            &self.lock
        }
    }

    /// Eq. 16 along another field.
    fn kinematic(&self) -> Result<CampaignOutcome, SearchError> {
        let (arm, motion) = (self.arm, self.motion);
        let field = Field::KinematicManipulability;
        let along = self.searched().with_field(arm, motion, field);
        let compensation = cancel_per_joint(&along)?.compensation;
        let assessment = self.whole.assess_along(arm, motion, field, &compensation);
        Ok(CampaignOutcome::of(&self.whole, &assessment))
    }

    /// [`OnLine::equal`] at every state before the lock, and the nearest torque after it.
    fn on_line(&self) -> CampaignOutcome {
        let law = OnLine::equal();
        let operation = self.seen(LawName::OnLine);
        let none = LockedJoints::NONE;
        let before = |point: &OperatingPoint<N>| {
            let state = self.motion.state(point.time);
            law.compensation(self.arm, &state, &point.pose, none)
        };
        let after = operation.recourse(&before(operation.before()), law.force_budget);
        let assessment = operation.assess_torque(compensation::Law::Optimal, |point| {
            if point.locked.is_empty() {
                before(point)
            } else {
                point.pose.free_torque(&after)
            }
        });
        CampaignOutcome::of(operation, &assessment)
    }
}

/// The torque that takes as much of the step away after the lock as it can without a force at the tool, and none before it:
/// `U' = −P' step`, P' the projector of the locked arm. Without limits it leaves `‖(I − P') step‖` over the healthy joints.
///
/// What a controller can do that does not prepare for a lock.
pub fn after_only<const N: usize>(operation: &Operation<N>) -> Compensation<N> {
    Compensation::Optimal {
        before: FreeTorque::none(),
        after: FreeTorque {
            torque: -operation.step(),
            ..FreeTorque::none()
        },
    }
}
