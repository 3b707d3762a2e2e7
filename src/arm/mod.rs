//! [`Arm`]: what every backend offers, generic or generated.

mod angle;
pub mod bounds;
pub mod coordinates;
mod description;
pub mod singular;
mod task;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

pub use angle::Angle;
pub use description::{Joint, JointKind, Link, Placement};
pub use task::{TaskRow, TaskRows};

/// An arm of `N` joints: its kinematics, its dynamics, and their derivatives by the joint coordinates.
///
/// SI units and radians; for a prismatic joint read metres for radians and newtons for newton metres.
/// Twists and wrenches are linear first, `[v; ω]` and `[f; n]`, in world axes, at the tool point.
/// `q` is measured from the table's configuration.
///
/// For finite arguments of any size that a mechanism can have, no method returns NaN and none panics; for a `q` that is not finite,
/// results are NaN where they depend on it. A prismatic joint farther out than [`PRISMATIC_LIMIT`](coordinates::PRISMATIC_LIMIT)
/// is read as if it stood there.
pub trait Arm<const N: usize> {
    /// The rows of the Jacobian that make up the task of w_D.
    fn task(&self) -> TaskRows;

    /// Rated torque of each joint, N·m (N); infinite where the table states none.
    fn rated_torque(&self) -> SVector<f64, N>;

    /// `world_from_tool`.
    fn forward_kinematics(&self, q: &SVector<f64, N>) -> IsometryMatrix3<f64>;

    /// Geometric Jacobian J, 6×N: `[v; ω] = J q̇`. All six rows, whatever the task.
    fn geometric_jacobian(&self, q: &SVector<f64, N>) -> SMatrix<f64, 6, N>;

    /// ∂J/∂q_i, one 6×N matrix for each i.
    fn jacobian_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, 6, N>; N];

    /// Mass matrix M, N×N, full and symmetric, kg·m².
    fn mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N>;

    /// ∂M/∂q_i, one N×N matrix for each i.
    fn mass_matrix_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, N, N>; N];

    /// Dynamic manipulability `w_D = √det((JM⁻¹)(JM⁻¹)ᵀ)` over the task's rows of J (Eq. 15).
    fn dynamic_manipulability(&self, q: &SVector<f64, N>) -> f64;

    /// w_D and its gradient ∇w_D (Eq. 22–27).
    ///
    /// Where w_D is 0, Eq. 23 has no value; the gradient returned there is the zero vector. [`singular`] says where that is.
    fn dynamic_manipulability_gradient(&self, q: &SVector<f64, N>) -> (f64, SVector<f64, N>);

    /// Inverse dynamics τ = M q̈ + c(q, q̇) + g(q), N·m, without a tool wrench.
    fn inverse_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N>;

    /// Bias force c(q, q̇) + g(q): the inverse dynamics at q̈ = 0.
    fn bias_force(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> SVector<f64, N>;

    /// Gravity torque g(q): the inverse dynamics at q̇ = 0, q̈ = 0.
    fn gravity_torque(&self, q: &SVector<f64, N>) -> SVector<f64, N>;

    /// Forward dynamics q̈ = M⁻¹(τ − c(q, q̇) − g(q)), without a tool wrench.
    fn forward_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> SVector<f64, N>;

    /// M and all ∂M/∂q_i in one call.
    fn mass_matrix_and_derivatives(
        &self,
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) {
        (self.mass_matrix(q), self.mass_matrix_derivatives(q))
    }

    /// J (six rows), w_D and ∇w_D in one call: what a cycle of the suppression controller needs.
    fn jacobian_and_gradient(
        &self,
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
        let (w, gradient) = self.dynamic_manipulability_gradient(q);
        (self.geometric_jacobian(q), w, gradient)
    }
}
