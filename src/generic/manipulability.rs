//! Dynamic manipulability and its gradient, and the rule for where they are 0.

use nalgebra::{SMatrix, SVector};

use super::SerialChain;
use super::kinematics::JointInput;
use super::mass_matrix::factor;
use super::orthogonal::ThinQr;
use crate::TaskRows;

impl<const N: usize> SerialChain<N> {
    /// `w_D = √det(H Hᵀ)`, `H = J M⁻¹` over the task's rows (Eq. 15), as the product of H's singular values.
    ///
    /// The determinant of `H Hᵀ` would square H's condition number and lose twice the digits near a singular pose.
    pub(super) fn manipulability(&self, inputs: &[JointInput; N]) -> f64 {
        let jacobian = self.tool_jacobian(inputs);
        if self.counts_as_singular(inputs, &jacobian) {
            return 0.0;
        }
        let mass_matrix = factor(self.mass_matrix_at(inputs));
        let h_transposed = mass_matrix.solve(&task_columns(self.task, &jacobian));
        ThinQr::new(h_transposed, self.task.len())
            .heights()
            .product()
    }

    /// w_D and ∇w_D. Eq. 23–26 by Jacobi's formula for the derivative of a determinant:
    /// `∂w_D/∂q_i = w_D tr(H† ∂H/∂q_i)`, which like w_D itself avoids the square of H's condition number;
    /// `∂H/∂q_i` by Eq. 27. [`super::literal`] has the equations as printed.
    pub(super) fn manipulability_and_gradient(
        &self,
        inputs: &[JointInput; N],
    ) -> (f64, SVector<f64, N>) {
        let jacobian = self.tool_jacobian(inputs);
        if self.counts_as_singular(inputs, &jacobian) {
            return (0.0, SVector::zeros());
        }
        let mass_matrix = factor(self.mass_matrix_at(inputs));
        let h_transposed = mass_matrix.solve(&task_columns(self.task, &jacobian));
        let qr = ThinQr::new(h_transposed, self.task.len());
        let w: f64 = qr.heights().product();
        let pseudoinverse = qr.duals();
        let dj = self.derivatives(inputs, |shifted| self.tool_jacobian(shifted));
        let dm = self.derivatives(inputs, |shifted| self.links_mass_matrix_at(shifted));
        let gradient = SVector::from_fn(|i, _| {
            // Eq. 27 transposed, with ∂M⁻¹ = −M⁻¹ ∂M M⁻¹.
            let dh_transposed =
                mass_matrix.solve(&(task_columns(self.task, &dj[i]) - dm[i] * h_transposed));
            w * pseudoinverse.dot(&dh_transposed)
        });
        (w, gradient)
    }

    /// Whether w_D counts as 0: [`crate::arm::singular`].
    pub(super) fn counts_as_singular(
        &self,
        inputs: &[JointInput; N],
        jacobian: &SMatrix<f64, 6, N>,
    ) -> bool {
        let rows = task_columns(self.task, jacobian);
        let volume: f64 = ThinQr::new(rows, self.task.len()).heights().product();
        !volume.is_nan() && self.is_singular(&Self::offsets(inputs), volume * volume)
    }
}

/// The task's rows of J as the first columns; the others are 0.
pub(crate) fn task_columns<const N: usize>(
    task: TaskRows,
    jacobian: &SMatrix<f64, 6, N>,
) -> SMatrix<f64, N, 6> {
    let mut columns = SMatrix::<f64, N, 6>::zeros();
    for (column, row) in task.iter().enumerate() {
        columns.set_column(column, &jacobian.row(row.index()).transpose());
    }
    columns
}
