//! [`TaskPose`]: P, J and ∇w_D in one pose, and the compensation that they make.

use nalgebra::{SMatrix, SVector, Vector6};

use super::whitening::Whitening;
use super::{Compensation, FreeTorque};
use crate::control::failure::LockedJoints;
use crate::control::null_space::{NEAR_SINGULAR, NullSpace, SINGULAR};
use crate::{Arm, TaskRows};

/// The projector P on the torques that leave the task alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projector {
    /// `I − J†J`: no static tool wrench. The paper's, since J̃ = (Jᵀ)† gives `I − J̃†J̃ = I − J†J`.
    #[default]
    Static,
    /// `I − Jᵀ J̄ᵀ`, `J̄ = M⁻¹ Jᵀ (J M⁻¹ Jᵀ)⁻¹`: no acceleration of the tool (Khatib 1987). Its static wrench is not 0.
    DynamicallyConsistent,
}

/// What a compensation is made of in one pose.
#[derive(Clone, Copy, Debug)]
pub struct TaskPose<const N: usize> {
    /// J, all six rows, all joints.
    pub jacobian: SMatrix<f64, 6, N>,
    /// ∇w_D of Eq. 22, the locked joints' entries 0.
    pub gradient: SVector<f64, N>,
    /// The moving joints' J, taken apart.
    pub null_space: NullSpace<N>,
    /// [`NullSpace::conditioning`], or 0 where w_D counts as 0 ([`crate::arm::singular`]).
    pub conditioning: f64,
    task: TaskRows,
    locked: LockedJoints<N>,
    projector: Projector,
    whitening: Option<Whitening<N>>,
    /// What U is multiplied by: 1 but near singular poses.
    fade: f64,
}

impl<const N: usize> TaskPose<N> {
    /// Looks at `arm` in `q` with `locked` joints.
    #[inline]
    pub fn new(
        arm: &(impl Arm<N> + ?Sized),
        q: &SVector<f64, N>,
        locked: LockedJoints<N>,
        projector: Projector,
    ) -> Self {
        let (jacobian, manipulability, gradient) = arm.jacobian_and_gradient(q);
        let task = arm.task();
        let reduced = locked.reduce_jacobian(&jacobian);
        let null_space = NullSpace::new(&reduced, task);
        // Where w_D counts as 0 there is no gradient, whatever rounding leaves of the rows' independence.
        let conditioning = if manipulability == 0.0 {
            0.0
        } else {
            null_space.conditioning()
        };
        let distance = (conditioning - SINGULAR) / (NEAR_SINGULAR - SINGULAR);
        let whitening = match projector {
            Projector::Static => None,
            Projector::DynamicallyConsistent => {
                let mass_matrix = locked.reduce_mass_matrix(&arm.mass_matrix(q));
                Whitening::new(&mass_matrix, &reduced, task)
            }
        };
        Self {
            jacobian,
            gradient: locked.without(&gradient),
            null_space,
            conditioning,
            task,
            locked,
            projector,
            whitening,
            fade: distance.clamp(0.0, 1.0),
        }
    }

    /// The rows of J that make up the task.
    pub fn task(&self) -> TaskRows {
        self.task
    }

    /// P x for the moving joints, times the factor of the rule near singular poses; exactly 0 where the moving joints have no null space.
    #[inline]
    pub fn project(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        if self.has_no_null_space() {
            // No direction is left; what the products below would leave is rounding, and a coefficient could be made for it.
            return SVector::zeros();
        }
        let x = self.locked.without(x);
        let projected = match self.projector {
            Projector::Static => self.null_space.project(&x),
            Projector::DynamicallyConsistent => match &self.whitening {
                Some(whitening) => whitening.project(x),
                None => SVector::zeros(),
            },
        };
        projected * self.fade
    }

    /// `(I − J†J) x` for the moving joints, whatever the projector, times the factor of the rule near singular poses;
    /// exactly 0 where they have no null space: the part of x that leaves the static tool force alone.
    #[inline]
    pub fn project_static(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        if self.has_no_null_space() {
            return SVector::zeros();
        }
        self.null_space.project(&self.locked.without(x)) * self.fade
    }

    /// `P z + Jᵀ f` with the static projector, times the factor of the rule near singular poses: the static tool wrench is off by f.
    #[inline]
    pub fn free_torque(&self, free: &FreeTorque<N>) -> SVector<f64, N> {
        self.project_static(&free.torque) + self.static_torque(&free.wrench)
    }

    /// The factor of the rule near singular poses: 1 but there, 0 on the singular set.
    pub fn fade(&self) -> f64 {
        self.fade
    }

    /// Whether the moving joints have as many independent rows of J as there are of them.
    pub(super) fn has_no_null_space(&self) -> bool {
        self.null_space.rank() + self.locked.len() >= N
    }

    /// Jᵀ f for the moving joints and the task's rows of f, times the factor of the rule near singular poses.
    #[inline]
    pub fn static_torque(&self, wrench: &Vector6<f64>) -> SVector<f64, N> {
        let mut of_task = Vector6::zeros();
        for row in self.task.iter() {
            of_task[row.index()] = wrench[row.index()];
        }
        let torque = self.jacobian.tr_mul(&of_task);
        self.locked.without(&torque) * self.fade
    }

    /// U of Eq. 16 or 20, or of the optimal law.
    #[inline]
    pub fn compensation(&self, compensation: &Compensation<N>) -> SVector<f64, N> {
        match compensation {
            Compensation::PerJoint(k) => self.project(&self.gradient).component_mul(k),
            Compensation::Projected(k) => self.project(&self.gradient.component_mul(k)),
            Compensation::Optimal { before, after } => {
                let free = if self.locked.is_empty() {
                    before
                } else {
                    after
                };
                self.project(&free.torque) + self.static_torque(&free.wrench)
            }
        }
    }
}
