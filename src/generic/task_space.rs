//! The arm as its tool feels it: Λ and the dynamically consistent inverse of J (Khatib 1987).

use nalgebra::{Matrix6, SMatrix};

use super::SerialChain;
use super::kinematics::JointInput;
use super::manipulability::task_columns;
use super::mass_matrix::factor;
use super::orthogonal::ThinQr;

/// Rows and columns outside the task are 0; so is all of it where the task is singular.
pub(super) struct TaskDynamics<const N: usize> {
    /// `Λ = (J M⁻¹ Jᵀ)⁻¹` over the task's rows.
    pub(super) inertia: Matrix6<f64>,
    /// `J̄ = M⁻¹ Jᵀ Λ`: of all motions with a given tool velocity, the one of least kinetic energy.
    pub(super) inverse: SMatrix<f64, N, 6>,
}

impl<const N: usize> SerialChain<N> {
    /// With `M = L Lᵀ` and `A = L⁻¹ Jᵀ`: `Λ = (AᵀA)⁻¹ = A† A†ᵀ` and `J̄ = L⁻ᵀ A†ᵀ`, by A's orthogonal factorisation.
    ///
    /// Forming `J M⁻¹ Jᵀ = AᵀA` would square A's condition number.
    pub(super) fn task_dynamics(&self, inputs: &[JointInput; N]) -> TaskDynamics<N> {
        let mut inertia = Matrix6::zeros();
        let mut inverse = SMatrix::<f64, N, 6>::zeros();
        let jacobian = self.tool_jacobian(inputs);
        if !self.counts_as_singular(inputs, &jacobian) {
            let mass = factor(self.mass_matrix_at(inputs));
            let lower = mass.l_dirty();
            let mut columns = task_columns(self.task, &jacobian);
            lower.solve_lower_triangular_unchecked_mut(&mut columns);
            let duals = ThinQr::new(columns, self.task.len()).duals();
            let mut joint_rates = duals;
            lower.tr_solve_lower_triangular_unchecked_mut(&mut joint_rates);
            for (c, column) in self.task.iter().enumerate() {
                inverse.set_column(column.index(), &joint_rates.column(c));
                for (r, row) in self.task.iter().enumerate() {
                    inertia[(row.index(), column.index())] = duals.column(r).dot(&duals.column(c));
                }
            }
        }
        TaskDynamics { inertia, inverse }
    }
}
