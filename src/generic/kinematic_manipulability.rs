//! Kinematic manipulability w (Yoshikawa 1985) and its gradient.

use nalgebra::SVector;

use super::SerialChain;
use super::kinematics::JointInput;
use super::manipulability::task_columns;
use super::orthogonal::ThinQr;

impl<const N: usize> SerialChain<N> {
    /// `w = √det(J Jᵀ)` over the task's rows, as the product of J's singular values; and ∇w by Jacobi's formula for the
    /// derivative of a determinant, `∂w/∂q_i = w tr(J† ∂J/∂q_i)`. Both are 0 where the task is singular.
    pub(super) fn volume_and_gradient(&self, inputs: &[JointInput; N]) -> (f64, SVector<f64, N>) {
        let jacobian = self.tool_jacobian(inputs);
        if self.counts_as_singular(inputs, &jacobian) {
            return (0.0, SVector::zeros());
        }
        let qr = ThinQr::new(task_columns(self.task, &jacobian), self.task.len());
        let w: f64 = qr.heights().product();
        let pseudoinverse = qr.duals();
        let derivatives = self.derivatives(inputs, |shifted| self.tool_jacobian(shifted));
        let gradient = SVector::from_fn(|i, _| {
            w * pseudoinverse.dot(&task_columns(self.task, &derivatives[i]))
        });
        (w, gradient)
    }
}
