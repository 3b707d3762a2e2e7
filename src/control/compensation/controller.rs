//! [`Controller`]: the torques of one control cycle.

use nalgebra::{SVector, Vector6};

use super::limits::Limits;
use super::{Compensation, Projector, Status, TaskPose};
use crate::Arm;
use crate::control::failure::LockedJoints;
use crate::control::null_space::NEAR_SINGULAR;
use crate::control::trajectory::JointState;

/// What one control cycle gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle<const N: usize> {
    /// τ, N·m (N): what motors give, and for a locked joint what its brake bears.
    pub torque: SVector<f64, N>,
    /// `ID + Jᵀ F_e`: τ without compensation, N·m (N).
    pub planned: SVector<f64, N>,
    /// U as it acts, after all cuts: `torque − planned`, N·m (N).
    pub compensation: SVector<f64, N>,
    /// h of Eq. 13, `(Jᵀ)† U`: the static tool wrench realised minus the one asked for, N and N·m; 0 outside the task.
    pub force_error: Vector6<f64>,
    /// −g of Eq. 14, taken on both sides: `τ_rated − |τ|`, N·m (N).
    pub margins: SVector<f64, N>,
    /// [`TaskPose::conditioning`]: how independent the rows of the moving joints' J are, 0 to 1.
    pub conditioning: f64,
    /// How it went.
    pub status: Status,
}

/// The suppression controller of one arm: constant data, and a [`cycle`](Self::cycle) without allocation in bounded time.
#[derive(Clone, Copy, Debug)]
pub struct Controller<'a, A: ?Sized, const N: usize> {
    arm: &'a A,
    compensation: Compensation<N>,
    projector: Projector,
    rated_torque: SVector<f64, N>,
}

impl<'a, A: Arm<N> + ?Sized, const N: usize> Controller<'a, A, N> {
    /// A controller with the static projector and the arm's own rated torques.
    pub fn new(arm: &'a A, compensation: Compensation<N>) -> Self {
        Self {
            arm,
            compensation,
            projector: Projector::Static,
            rated_torque: arm.rated_torque(),
        }
    }

    /// The same with another projector.
    #[must_use]
    pub fn with_projector(mut self, projector: Projector) -> Self {
        self.projector = projector;
        self
    }

    /// The same with other rated torques, N·m (N). One that is negative or no number counts as 0.
    #[must_use]
    pub fn with_rated_torque(mut self, rated_torque: SVector<f64, N>) -> Self {
        self.rated_torque = rated_torque.map(|rated| rated.max(0.0));
        self
    }

    /// One control cycle: the torques for `state`, measured or planned, of an arm whose tool is to exert `wrench`
    /// (`[f; n]`, world axes, at the tool point) and whose `locked` joints stand still whatever `state` says.
    ///
    /// Where the compensation would break Eq. 14, [`Compensation::PerJoint`] is cut joint by joint, as its coefficients are;
    /// the other two are scaled as a whole, so that the tool force stays as it is, and left out if no scale will do.
    /// A locked joint's torque is its brake's and is never cut.
    #[inline]
    pub fn cycle(
        &self,
        state: &JointState<N>,
        wrench: &Vector6<f64>,
        locked: LockedJoints<N>,
    ) -> Cycle<N> {
        let state = locked.hold(state);
        let pose = TaskPose::new(self.arm, &state.q, locked, self.projector);
        let planned = self.arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
            + pose.jacobian.tr_mul(wrench);
        let limits = Limits {
            rated_torque: self.rated_torque,
            locked,
        };
        let wanted = pose.compensation(&self.compensation);
        let (torque, cut) = limits.cut(&planned, &wanted, self.compensation.law());
        if !(state.is_finite() && wrench.iter().all(|x| x.is_finite())) {
            return Cycle::nothing(self.rated_torque);
        }
        Cycle::close(&pose, planned, torque, cut, self.rated_torque)
    }
}

impl<const N: usize> Cycle<N> {
    /// What `torque` amounts to in `pose`; [`nothing`](Self::nothing) if it is not finite. `cut`: what rated torques made of it.
    #[inline]
    pub(crate) fn close(
        pose: &TaskPose<N>,
        planned: SVector<f64, N>,
        torque: SVector<f64, N>,
        cut: Status,
        rated_torque: SVector<f64, N>,
    ) -> Self {
        let compensation = torque - planned;
        let force_error = pose.null_space.static_wrench(&compensation);
        let singular = if pose.conditioning < NEAR_SINGULAR {
            Status::NearSingular
        } else {
            Status::Nominal
        };
        let mut results = torque.iter().chain(&planned).chain(&force_error);
        if !results.all(|x| x.is_finite()) {
            return Self::nothing(rated_torque);
        }
        Self {
            torque,
            planned,
            compensation,
            force_error,
            margins: rated_torque - torque.abs(),
            conditioning: pose.conditioning,
            status: cut.max(singular),
        }
    }

    /// [`Status::NotFinite`].
    pub(crate) fn nothing(rated_torque: SVector<f64, N>) -> Self {
        Self {
            torque: SVector::zeros(),
            planned: SVector::zeros(),
            compensation: SVector::zeros(),
            force_error: Vector6::zeros(),
            margins: rated_torque,
            conditioning: 0.0,
            status: Status::NotFinite,
        }
    }
}
