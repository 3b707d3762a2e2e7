//! The gradient of w_D as the paper prints it: Eq. 23–27, with the determinant expansion of Eq. 25.

use nalgebra::{Matrix6, SMatrix, SVector};

use super::mass_matrix::factor;
use crate::{TaskRow, TaskRows};

/// ∇w_D (Eq. 22) from w_D, J, M and their derivatives by each joint; the zero vector where `w` is 0.
///
/// `jacobian` and its derivatives have all six rows; those of `task` are used.
/// For reading and comparing, not for use: `H Hᵀ` squares H's condition number and the determinants' sum
/// cancels besides, so that near a singular pose few digits are left.
pub fn manipulability_gradient<const N: usize>(
    task: TaskRows,
    w: f64,
    jacobian: &SMatrix<f64, 6, N>,
    mass_matrix: &SMatrix<f64, N, N>,
    jacobian_derivatives: &[SMatrix<f64, 6, N>; N],
    mass_matrix_derivatives: &[SMatrix<f64, N, N>; N],
) -> SVector<f64, N> {
    if w == 0.0 {
        return SVector::zeros();
    }
    let j = of_task(task, jacobian);
    let m_inverse = factor(*mass_matrix).inverse();
    let h = j * m_inverse;
    // The rows outside the task are 0 in H. A 1 on their diagonal leaves the task's determinant.
    let mut g = h * h.transpose();
    for row in TaskRow::ALL.into_iter().filter(|row| !task.contains(*row)) {
        g[(row.index(), row.index())] = 1.0;
    }
    SVector::from_fn(|i, _| {
        let dj = of_task(task, &jacobian_derivatives[i]);
        let dm_inverse = -m_inverse * mass_matrix_derivatives[i] * m_inverse;
        let dh = dj * m_inverse + j * dm_inverse; // Eq. 27
        let dg = dh * h.transpose() + h * dh.transpose(); // Eq. 26
        let ddet: f64 = task // Eq. 25: one row after the other replaced by its derivative
            .iter()
            .map(|row| with_row(g, row.index(), &dg).determinant())
            .sum();
        ddet / (2.0 * w) // Eq. 23, 24
    })
}

/// J with the rows outside the task set to 0.
fn of_task<const N: usize>(task: TaskRows, jacobian: &SMatrix<f64, 6, N>) -> SMatrix<f64, 6, N> {
    let mut rows = SMatrix::<f64, 6, N>::zeros();
    for row in task.iter().map(TaskRow::index) {
        rows.set_row(row, &jacobian.row(row));
    }
    rows
}

/// `matrix` with row `row` taken from `other`.
fn with_row(mut matrix: Matrix6<f64>, row: usize, other: &Matrix6<f64>) -> Matrix6<f64> {
    matrix.set_row(row, &other.row(row));
    matrix
}
