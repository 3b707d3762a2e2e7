//! The generic path: textbook formulas on nalgebra, for any table at run time. The specification of every backend.
//!
//! Written to be read beside the books, not for speed:
//! Siciliano, Sciavicco, Villani, Oriolo, *Robotics* (2009): Jacobian 3.1, mass matrix 7.2;
//! Craig, *Introduction to Robotics* (3rd ed.): frames 3.4, inverse dynamics 6.5;
//! Khatib, *A unified approach for motion and force control of robot manipulators* (1987), for Λ and its inverse of J;
//! and the paper on joint impact torque, Eq. 15 and 22–27, for w_D and its gradient.

mod base_columns;
mod coriolis;
mod dynamics_derivatives;
mod energy;
mod finite_difference;
mod friction;
mod kinematic_manipulability;
mod kinematics;
mod links;
pub mod literal;
mod lock;
mod manipulability;
mod mass_matrix;
mod newton_euler;
mod orthogonal;
mod rates;
mod regressor;
mod task_space;

use nalgebra::{IsometryMatrix3, Matrix6, SMatrix, SVector, Vector3, Vector6};

use crate::{Arm, Joint, Placement, TaskRows};

pub(crate) use manipulability::task_columns;
pub(crate) use mass_matrix::factor;
pub use newton_euler::JointLoad;
pub(crate) use orthogonal::ThinQr;

/// A serial chain of `N` joints, evaluated by textbook formulas.
///
/// All of it is plain data, so that generated code can carry its own chain as a constant. No method allocates.
///
/// For finite q no method returns NaN: angles of any size enter by their sines and cosines only, offsets are held within
/// ±[`PRISMATIC_LIMIT`](crate::arm::PRISMATIC_LIMIT). w_D and its gradient are exactly 0 where the task's rows of J
/// span no volume but rounding ([`crate::arm::singular`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SerialChain<const N: usize> {
    /// The joints, base first.
    pub joints: [Joint; N],
    /// `world_from_base`.
    pub base: Placement,
    /// `frame_N_from_tool`.
    pub tool: Placement,
    /// Gravity, m/s², world axes.
    pub gravity: [f64; 3],
    /// The rows of J in w_D.
    pub task: TaskRows,
}

impl<const N: usize> Arm<N> for SerialChain<N> {
    fn task(&self) -> TaskRows {
        self.task
    }

    fn rated_torque(&self) -> SVector<f64, N> {
        SVector::from_fn(|i, _| self.joints[i].rated_torque.unwrap_or(f64::INFINITY))
    }

    fn forward_kinematics(&self, q: &SVector<f64, N>) -> IsometryMatrix3<f64> {
        self.frames(&self.inputs(q)).world_from_tool
    }

    fn geometric_jacobian(&self, q: &SVector<f64, N>) -> SMatrix<f64, 6, N> {
        self.tool_jacobian(&self.inputs(q))
    }

    fn jacobian_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, 6, N>; N] {
        self.derivatives(&self.inputs(q), |shifted| self.tool_jacobian(shifted))
    }

    fn mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        self.mass_matrix_at(&self.inputs(q))
    }

    fn mass_matrix_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, N, N>; N] {
        self.derivatives(&self.inputs(q), |shifted| {
            self.links_mass_matrix_at(shifted)
        })
    }

    fn inverse_mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        let mut inverse = mass_matrix::factor(self.mass_matrix(q)).inverse();
        // Equal but for rounding; the contract is a symmetric matrix.
        inverse.fill_lower_triangle_with_upper_triangle();
        inverse
    }

    fn dynamic_manipulability(&self, q: &SVector<f64, N>) -> f64 {
        self.manipulability(&self.inputs(q))
    }

    fn dynamic_manipulability_gradient(&self, q: &SVector<f64, N>) -> (f64, SVector<f64, N>) {
        self.manipulability_and_gradient(&self.inputs(q))
    }

    fn inverse_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        self.frictionless_torque(q, qd, qdd) + self.friction(qd)
    }

    fn bias_force(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> SVector<f64, N> {
        self.frictionless_torque(q, qd, &SVector::zeros())
    }

    fn gravity_torque(&self, q: &SVector<f64, N>) -> SVector<f64, N> {
        self.bias_force(q, &SVector::zeros())
    }

    fn forward_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let driving = tau - self.bias_force(q, qd) - self.friction(qd);
        mass_matrix::factor(self.mass_matrix(q)).solve(&driving)
    }

    fn inverse_dynamics_with_wrench(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
        wrench: &Vector6<f64>,
    ) -> SVector<f64, N> {
        // Siciliano 7.3, Eq. 7.42; there the wrench is what the tool exerts.
        self.inverse_dynamics(q, qd, qdd) - self.geometric_jacobian(q).tr_mul(wrench)
    }

    fn forward_dynamics_with_wrench(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
        wrench: &Vector6<f64>,
    ) -> SVector<f64, N> {
        let torque_of_wrench = self.geometric_jacobian(q).tr_mul(wrench);
        self.forward_dynamics(q, qd, &(tau + torque_of_wrench))
    }
    fn friction_torque(&self, qd: &SVector<f64, N>) -> SVector<f64, N> {
        self.friction(qd)
    }

    fn lock_impacts(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SMatrix<f64, N, N> {
        self.impacts_of_each_lock(q, qd, qdd)
    }

    fn regressor(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [SMatrix<f64, N, 10>; N] {
        self.regressor_at(q, qd, qdd)
    }

    fn base_regressor(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [SMatrix<f64, N, 10>; N] {
        self.base_regressor_at(q, qd, qdd)
    }

    fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> (SMatrix<f64, N, N>, SMatrix<f64, N, N>) {
        self.torque_derivatives(q, qd, qdd)
    }

    fn forward_dynamics_derivatives(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> (SMatrix<f64, N, N>, SMatrix<f64, N, N>, SMatrix<f64, N, N>) {
        self.acceleration_derivatives(q, qd, tau)
    }

    fn link_poses(&self, q: &SVector<f64, N>) -> [IsometryMatrix3<f64>; N] {
        self.link_frames(q)
    }

    fn link_jacobians(&self, q: &SVector<f64, N>) -> [SMatrix<f64, 6, N>; N] {
        self.jacobians_at_origins(&self.inputs(q))
    }

    fn center_of_mass(&self, q: &SVector<f64, N>) -> Vector3<f64> {
        self.first_moment(&self.inputs(q)) / self.mass()
    }

    fn jacobian_rate(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> SMatrix<f64, 6, N> {
        self.rate_of_jacobian(&self.inputs(q), qd)
    }

    fn bias_acceleration(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> Vector6<f64> {
        self.rate_of_jacobian(&self.inputs(q), qd) * qd
    }

    fn kinetic_energy(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> f64 {
        self.energy_of_motion(&self.inputs(q), qd)
    }

    fn potential_energy(&self, q: &SVector<f64, N>) -> f64 {
        self.energy_of_position(&self.inputs(q))
    }

    fn task_space_inertia(&self, q: &SVector<f64, N>) -> Matrix6<f64> {
        self.task_dynamics(&self.inputs(q)).inertia
    }

    fn dynamically_consistent_inverse(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, 6> {
        self.task_dynamics(&self.inputs(q)).inverse
    }

    fn coriolis_matrix(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        self.christoffel_matrix(&self.inputs(q), qd)
    }

    fn manipulability_gradient(&self, q: &SVector<f64, N>) -> (f64, SVector<f64, N>) {
        self.volume_and_gradient(&self.inputs(q))
    }
}
